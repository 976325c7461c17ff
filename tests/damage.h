// What happens to models on their way: faces lost, patches missing, everything detached and shaken.
#pragma once

#include <vector>

#include "shapes.h"
#include "tetsoup/types.h"

namespace tetsoup::test {

inline double longest_side(const TriangleSoup& soup) {
  Vec3 lo = soup.vertices.at(0), hi = lo;
  for (const Vec3& v : soup.vertices) lo = min(lo, v), hi = max(hi, v);
  const Vec3d size = to_double(hi) - to_double(lo);
  return std::max({size.x, size.y, size.z});
}

inline std::array<Vec3d, 3> corners_of(const TriangleSoup& soup, const Triangle& t) {
  return {to_double(soup.vertices[t[0]]), to_double(soup.vertices[t[1]]), to_double(soup.vertices[t[2]])};
}

/// Removes the triangles whose centre lies in one of many balls about random points of the surface, until a share of
/// the area is gone.
inline TriangleSoup remove_patches(const TriangleSoup& soup, double share, double radius, std::uint64_t seed) {
  std::vector<double> area_before{0};
  std::vector<Vec3d> centres;
  for (const Triangle& t : soup.triangles) {
    const auto [a, b, c] = corners_of(soup, t);
    area_before.push_back(area_before.back() + length(cross(b - a, c - a)) / 2);
    centres.push_back((a + b + c) * (1.0 / 3));
  }
  const double total = area_before.back();
  Random random(seed);
  std::vector<bool> gone(centres.size());
  for (double removed = 0; removed < share * total;) {
    const auto above = std::upper_bound(area_before.begin() + 1, area_before.end() - 1, random.uniform(0, total));
    const Vec3d& centre = centres[static_cast<std::size_t>(above - area_before.begin()) - 1];
    for (std::size_t i = 0; i < centres.size(); ++i) {
      if (gone[i] || squared_length(centres[i] - centre) > radius * radius) continue;
      gone[i] = true;
      removed += area_before[i + 1] - area_before[i];
    }
  }
  TriangleSoup rest{soup.vertices, {}};
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) rest.triangles.push_back(soup.triangles[i]);
  return rest;
}

/// Gives every triangle corners of its own and moves each by up to `amount` along every axis.
inline TriangleSoup detached(const TriangleSoup& soup, double amount, std::uint64_t seed) {
  TriangleSoup loose;
  Random random(seed);
  const auto shake = [&] { return random.uniform(-amount, amount); };
  for (const Triangle& t : soup.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.vertices.size());
    for (const Vec3d& p : corners_of(soup, t)) {
      const double x = shake(), y = shake(), z = shake();
      loose.vertices.push_back(to_float(p + Vec3d{x, y, z}));
    }
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  return loose;
}

}  // namespace tetsoup::test
