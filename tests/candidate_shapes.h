// Candidates by formula: a block of lattice cells of which some tets are kept.
#pragma once

#include <algorithm>
#include <functional>

#include "lattice/candidates.h"
#include "lattice_shapes.h"
#include "shapes.h"

namespace tetsoup::test {

/// Every tet of a block of whole cells, none kept.
inline Candidates block_candidates(const std::array<int, 3>& cells) {
  Candidates c;
  c.mesh = block_mesh(cells);
  c.density.assign(c.mesh.tets.size(), 0);
  c.kept.assign(c.mesh.tets.size(), 0);
  return c;
}

/// The same with six tets a cell, one for every order of the three axes: up to 24 tets meet at a vertex.
inline Candidates six_tet_candidates(int cells) {
  Candidates c;
  const auto n = static_cast<std::uint32_t>(cells), row = n + 1;
  for (std::uint32_t z = 0; z <= n; ++z)
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x)
        c.mesh.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  for (std::uint32_t i = 0; i < n * n * n; ++i) {
    const std::uint32_t base = i % n + row * (i / n % n + row * (i / n / n));
    std::array<std::uint32_t, 3> steps{1, row, row * row};
    std::sort(steps.begin(), steps.end());
    do {
      Tet tet{base, base + steps[0], base + steps[0] + steps[1], base + 1 + row + row * row};
      const auto at = [&](std::size_t k) { return to_double(c.mesh.vertices[tet[k]]); };
      if (signed_volume(at(0), at(1), at(2), at(3)) < 0) std::swap(tet[1], tet[2]);
      c.mesh.tets.push_back(tet);
    } while (std::next_permutation(steps.begin(), steps.end()));
  }
  c.density.assign(c.mesh.tets.size(), 0);
  c.kept.assign(c.mesh.tets.size(), 0);
  return c;
}

/// Keeps the tets whose centre lies inside, with density 1.
inline void keep_inside(Candidates& c, const std::function<bool(const Vec3d&)>& inside) {
  for (std::size_t t = 0; t < c.mesh.tets.size(); ++t) {
    Vec3d centre;
    for (const std::uint32_t v : c.mesh.tets[t]) centre += to_double(c.mesh.vertices[v]) * 0.25;
    c.kept[t] = inside(centre);
    c.density[t] = c.kept[t];
  }
}

/// Gives every tet a density at random, those of 0.5 and more are kept: about `share` of them.
inline void keep_at_random(Candidates& c, std::uint64_t seed, double share) {
  Random random(seed);
  for (std::size_t t = 0; t < c.mesh.tets.size(); ++t) {
    const bool kept = random.uniform() < share;
    c.density[t] = static_cast<float>(kept ? random.uniform(0.5, 1) : random.uniform(0, 0.5));
    c.kept[t] = kept;
  }
}

}  // namespace tetsoup::test
