// Lattices over solids given by formula, as the lattice stage hands them to the steps that mend them.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "base/bits.h"
#include "lattice/candidates.h"
#include "lattice_shapes.h"

namespace tetsoup::test {

/// A grid of `voxels` along the longest axis of the box, two more on every side, with the bits of a solid.
inline BitGrid make_solid(const Box3& box, int voxels, const std::function<bool(Vec3d)>& solid) {
  const Vec3d edge = box.hi - box.lo;
  GridFrame frame;
  frame.voxel_size = std::max({edge.x, edge.y, edge.z}) / voxels;
  frame.pad = 2;
  const auto count = [&](double length) { return static_cast<int>(std::ceil(length / frame.voxel_size - 1e-9)) + 4; };
  frame.size = {count(edge.x), count(edge.y), count(edge.z)};
  frame.origin = box.lo - Vec3d{1.5, 1.5, 1.5} * frame.voxel_size;
  BitGrid grid = make_bit_grid(frame);
  for (int z = 0; z < frame.size[2]; ++z)
    for (int y = 0; y < frame.size[1]; ++y)
      for (int x = 0; x < frame.size[0]; ++x)
        if (solid(frame.origin + Vec3d{1.0 * x, 1.0 * y, 1.0 * z} * frame.voxel_size))
          grid.words[grid.row(y, z) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
  return grid;
}

/// All tets of a five-tet lattice over the grid, kept where at least `rho_min` of their voxels are inside.
inline Candidates make_candidates(const BitGrid& inside, double cell, double rho_min = 0.5, Vec3d shift = {}) {
  const GridFrame& grid = inside.frame;
  const Vec3d lo = grid.origin - Vec3d{1.5, 1.5, 1.5} * cell + shift * cell;
  std::array<int, 3> cells{};
  for (std::size_t i = 0; i < 3; ++i) cells[i] = static_cast<int>(grid.size[i] * grid.voxel_size / cell) + 4;
  Candidates all;
  all.mesh = lattice_mesh(lo, cells, cell, [](const TetCorners&) { return true; });
  std::vector<double> voxels(all.mesh.tets.size(), 0), in(voxels);
  const auto owner = [&](const Vec3d& p) {
    const Vec3d q = (p - lo) * (1 / cell);
    const std::array<int, 3> at{static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z)};
    const std::size_t first = 5 * static_cast<std::size_t>(at[0] + cells[0] * (at[1] + cells[1] * at[2]));
    std::size_t best = first;
    double most = -1e300;
    for (std::size_t t = first; t < first + 5; ++t) {
      double least = 1e300;
      for (std::size_t i = 0; i < 4; ++i) {
        TetCorners c;
        for (std::size_t k = 0; k < 4; ++k) c[k] = k == i ? p : to_double(all.mesh.vertices[all.mesh.tets[t][k]]);
        least = std::min(least, signed_volume(c));
      }
      if (least > most) most = least, best = t;
    }
    return best;
  };
  for (int z = 0; z < grid.size[2]; ++z) {
    for (int y = 0; y < grid.size[1]; ++y) {
      for (int x = 0; x < grid.size[0]; ++x) {
        const std::size_t t = owner(grid.origin + Vec3d{1.0 * x, 1.0 * y, 1.0 * z} * grid.voxel_size);
        ++voxels[t];
        in[t] += inside.test(x, y, z);
      }
    }
  }
  for (std::size_t t = 0; t < voxels.size(); ++t) {
    all.density.push_back(voxels[t] == 0 ? 0 : static_cast<float>(in[t] / voxels[t]));
    all.kept.push_back(voxels[t] > 0 && in[t] >= rho_min * voxels[t]);
  }
  return all;
}

/// Vertices - edges + faces - tets: 1 for a ball, 0 for a solid torus, and added up over parts.
inline int euler_characteristic(const TetMesh& mesh) {
  std::set<std::uint32_t> vertices;
  std::set<std::array<std::uint32_t, 2>> edges;
  std::set<std::array<std::uint32_t, 3>> faces;
  for (const Tet& tet : mesh.tets) {
    Tet t = tet;
    std::sort(t.begin(), t.end());
    vertices.insert(t.begin(), t.end());
    for (const auto& e : kTetEdges)
      edges.insert({t[static_cast<std::size_t>(e[0])], t[static_cast<std::size_t>(e[1])]});
    for (std::size_t skip = 0; skip < 4; ++skip) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t i = 0, n = 0; i < 4; ++i)
        if (i != skip) face[n++] = t[i];
      faces.insert(face);
    }
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.size()) -
         static_cast<int>(mesh.tets.size());
}

}  // namespace tetsoup::test
