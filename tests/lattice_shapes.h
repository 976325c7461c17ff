// Tet meshes by formula: pieces of the five-tet lattice, as the lattice stage would cut them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>

#include "base/tet_geometry.h"
#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Five positive tets of the cube with corners 0..7 (x + 2 y + 4 z); odd cells are mirrored so that faces match.
inline constexpr std::array<std::array<int, 4>, 5> kEvenCell{
    {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 6, 3, 5}}};

/// The tets of a cell, corners as (x, y, z) in 0..1.
inline std::array<std::array<std::array<int, 3>, 4>, 5> cell_tets(bool odd) {
  std::array<std::array<std::array<int, 3>, 4>, 5> tets{};
  for (std::size_t t = 0; t < 5; ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      const int c = kEvenCell[t][i];
      tets[t][i] = {odd ? 1 - (c & 1) : c & 1, (c >> 1) & 1, (c >> 2) & 1};
    }
    if (odd) std::swap(tets[t][2], tets[t][3]);
  }
  return tets;
}

/// Cells of edge `cell` over [lo, hi); keeps a tet if `keep` says so for its four corners.
inline TetMesh lattice_mesh(const Vec3d& lo, const std::array<int, 3>& cells, double cell,
                            const std::function<bool(const TetCorners&)>& keep) {
  TetMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> ids;
  const auto place = [&](const std::array<int, 3>& p) { return lo + Vec3d{p[0] * cell, p[1] * cell, p[2] * cell}; };
  for (int z = 0; z < cells[2]; ++z) {
    for (int y = 0; y < cells[1]; ++y) {
      for (int x = 0; x < cells[0]; ++x) {
        for (const auto& corners : cell_tets((x + y + z) % 2 != 0)) {
          std::array<std::array<int, 3>, 4> points{};
          TetCorners p;
          for (std::size_t i = 0; i < 4; ++i) {
            points[i] = {x + corners[i][0], y + corners[i][1], z + corners[i][2]};
            p[i] = place(points[i]);
          }
          if (!keep(p)) continue;
          Tet tet{};
          for (std::size_t i = 0; i < 4; ++i) {
            const auto [at, is_new] = ids.try_emplace(points[i], static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(to_float(p[i]));
            tet[i] = at->second;
          }
          mesh.tets.push_back(tet);
        }
      }
    }
  }
  return mesh;
}

/// The lattice's piece of a solid given by its inside test: a tet stays if at least half of 35 points in it are inside.
inline TetMesh lattice_of(const Vec3d& lo, const Vec3d& hi, double cell,
                          const std::function<bool(const Vec3d&)>& inside) {
  const Vec3d size = hi - lo;
  const auto count = [&](double length_of_side) { return static_cast<int>(std::ceil(length_of_side / cell)); };
  return lattice_mesh(lo, {count(size.x), count(size.y), count(size.z)}, cell, [&](const TetCorners& p) {
    int samples = 0, hits = 0;
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; i + j <= 4; ++j) {
        for (int k = 0; i + j + k <= 4; ++k) {
          const int l = 4 - i - j - k;
          const Vec3d q = (p[0] * (i + 0.25) + p[1] * (j + 0.25) + p[2] * (k + 0.25) + p[3] * (l + 0.25)) * 0.2;
          ++samples;
          hits += inside(q) ? 1 : 0;
        }
      }
    }
    return 2 * hits >= samples;
  });
}

/// A block of whole cells.
inline TetMesh block_mesh(const std::array<int, 3>& cells, double cell = 1) {
  return lattice_mesh({0, 0, 0}, cells, cell, [](const TetCorners&) { return true; });
}

}  // namespace tetsoup
