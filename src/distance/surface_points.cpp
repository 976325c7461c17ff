#include "distance/surface_points.h"

#include <cmath>

namespace tetsoup {
namespace {

Vec3 mix(const Vec3& a, const Vec3& b, const Vec3& c, float wb, float wc) {
  return {a.x + wb * (b.x - a.x) + wc * (c.x - a.x), a.y + wb * (b.y - a.y) + wc * (c.y - a.y),
          a.z + wb * (b.z - a.z) + wc * (c.z - a.z)};
}

int pieces(const Vec3& a, const Vec3& b) {
  return std::max(1, static_cast<int>(std::ceil(length(to_double(b) - to_double(a)) / double{kPointSpacing})));
}

}  // namespace

kernel::PointColumns surface_points(const SoupFeatures& features) {
  kernel::PointColumns points;
  const auto add = [&](const Vec3& p) {
    points.x.push_back(p.x);
    points.y.push_back(p.y);
    points.z.push_back(p.z);
  };
  for (const Vec3& corner : features.corners) add(corner);
  for (const SoupFeatures::Edge& e : features.edges) {
    const Vec3 &a = features.corners[e.from], &b = features.corners[e.to];
    const int n = pieces(a, b);
    for (int i = 1; i < n; ++i) add(mix(a, b, b, static_cast<float>(i) / static_cast<float>(n), 0));
  }
  for (const Triangle& t : features.triangles) {
    const Vec3 &a = features.corners[t[0]], &b = features.corners[t[1]], &c = features.corners[t[2]];
    const int n = std::max({pieces(a, b), pieces(b, c), pieces(a, c)});
    const float step = 1 / static_cast<float>(n);
    for (int i = 1; i < n; ++i)
      for (int j = 1; i + j < n; ++j) add(mix(a, b, c, step * static_cast<float>(i), step * static_cast<float>(j)));
  }
  return points;
}

}  // namespace tetsoup
