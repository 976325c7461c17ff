// Shapes with a known answer, random numbers by seed, and the few helpers that several tests share.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup::test {

/// splitmix64: the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  double uniform(double lo = 0, double hi = 1) { return lo + (hi - lo) * static_cast<double>(next() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }

 private:
  std::uint64_t state_;
};

/// A closed surface over the unit sphere's latitudes and longitudes, moved by `place`.
inline TriangleSoup make_globe(int rings, int segments, const std::function<Vec3d(Vec3d)>& place) {
  TriangleSoup soup;
  const auto add = [&](const Vec3d& p) { soup.vertices.push_back(to_float(place(p))); };
  add({0, 0, 1});
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      const double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * j / segments;
      add({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  add({0, 0, -1});
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(1 + (i - 1) * segments + j % segments); };
  const auto last = static_cast<std::uint32_t>(soup.vertices.size() - 1);
  for (int j = 0; j < segments; ++j) {
    soup.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      soup.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      soup.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    soup.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
  }
  return soup;
}

inline TriangleSoup make_ball(double radius = 1, Vec3d centre = {}) {
  return make_globe(24, 48, [=](Vec3d p) { return centre + p * radius; });
}

/// A box of twelve triangles, wound outwards.
inline TriangleSoup make_box(Vec3d lo, Vec3d hi) {
  TriangleSoup soup;
  for (unsigned i = 0; i < 8; ++i)
    soup.vertices.push_back(to_float({i & 1U ? hi.x : lo.x, i & 2U ? hi.y : lo.y, i & 4U ? hi.z : lo.z}));
  soup.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return soup;
}

inline TriangleSoup joined(const TriangleSoup& a, const TriangleSoup& b) {
  TriangleSoup both = a;
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) both.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return both;
}

/// The same soup with its triangles shuffled, their corners rotated and their windings turned at random.
inline TriangleSoup scrambled(const TriangleSoup& soup, std::uint64_t seed) {
  TriangleSoup out = soup;
  Random random(seed);
  for (std::size_t i = out.triangles.size(); i > 1; --i)
    std::swap(out.triangles[i - 1], out.triangles[random.below(i)]);
  for (Triangle& t : out.triangles) {
    if (random.below(2) == 0) std::swap(t[0], t[1]);
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
  }
  return out;
}

/// Loose triangles in the unit cube.
inline TriangleSoup make_confetti(std::size_t count, double size, std::uint64_t seed) {
  TriangleSoup soup;
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d centre{random.uniform(), random.uniform(), random.uniform()};
    for (int k = 0; k < 3; ++k)
      soup.vertices.push_back(to_float(
          centre + Vec3d{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)}));
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

inline double overlap(const BitGrid& a, const BitGrid& b) {
  std::size_t both = 0, either = 0;
  for (std::size_t w = 0; w < a.words.size(); ++w) {
    both += static_cast<std::size_t>(std::popcount(a.words[w] & b.words[w]));
    either += static_cast<std::size_t>(std::popcount(a.words[w] | b.words[w]));
  }
  return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either);
}

inline Vec3d voxel_centre(const GridFrame& frame, int x, int y, int z) {
  return frame.origin +
         Vec3d{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)} * frame.voxel_size;
}

/// Share of voxels on which `inside` and a known solid agree: intersection over union.
inline double overlap(const BitGrid& inside, const std::function<bool(Vec3d)>& solid) {
  std::size_t both = 0, either = 0;
  const auto [nx, ny, nz] = inside.frame.size;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const bool a = inside.test(x, y, z), b = solid(voxel_centre(inside.frame, x, y, z));
        both += a && b;
        either += a || b;
      }
    }
  }
  return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either);
}

}  // namespace tetsoup::test
