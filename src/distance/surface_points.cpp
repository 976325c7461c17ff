#include "distance/surface_points.h"

#include <cmath>

namespace tetsoup {
namespace {

constexpr std::uint32_t kLeafSize = 8;

Vec3 mix(const Vec3& a, const Vec3& b, const Vec3& c, float wb, float wc) {
  return {a.x + wb * (b.x - a.x) + wc * (c.x - a.x), a.y + wb * (b.y - a.y) + wc * (c.y - a.y),
          a.z + wb * (b.z - a.z) + wc * (c.z - a.z)};
}

int pieces(const Vec3& a, const Vec3& b) {
  return std::max(1, static_cast<int>(std::ceil(length(to_double(b) - to_double(a)) / double{kPointSpacing})));
}

}  // namespace

std::vector<Vec3> surface_points(const SoupFeatures& features) {
  std::vector<Vec3> points = features.corners;
  for (const SoupFeatures::Edge& e : features.edges) {
    const Vec3 &a = features.corners[e.from], &b = features.corners[e.to];
    const int n = pieces(a, b);
    for (int i = 1; i < n; ++i) points.push_back(mix(a, b, b, static_cast<float>(i) / static_cast<float>(n), 0));
  }
  for (const Triangle& t : features.triangles) {
    const Vec3 &a = features.corners[t[0]], &b = features.corners[t[1]], &c = features.corners[t[2]];
    const int n = std::max({pieces(a, b), pieces(b, c), pieces(a, c)});
    const float step = 1 / static_cast<float>(n);
    for (int i = 1; i < n; ++i)
      for (int j = 1; i + j < n; ++j)
        points.push_back(mix(a, b, c, step * static_cast<float>(i), step * static_cast<float>(j)));
  }
  return points;
}

PointTree::PointTree(const std::vector<Vec3>& points, StageWatch& watch) {
  const std::vector<MortonEntry> sorted = morton_order(
      points.size(), [&](std::size_t i) { return points[i]; }, watch);
  points_.reserve(points.size());
  for (const MortonEntry& m : sorted) points_.push_back(points[m.index]);
  nodes_.reserve(points.size() / 2);
  build(sorted, 0, static_cast<std::uint32_t>(points.size()));
  watch.step(0);
}

std::uint32_t PointTree::build(const std::vector<MortonEntry>& sorted, std::uint32_t begin, std::uint32_t end) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({points_[begin], points_[begin], begin, end - begin});
  if (end - begin <= kLeafSize) {
    kernel::PointNode& leaf = nodes_[self];
    for (std::uint32_t i = begin; i < end; ++i) {
      leaf.lo = min(leaf.lo, points_[i]);
      leaf.hi = max(leaf.hi, points_[i]);
    }
    return self;
  }
  const std::uint32_t middle = morton_split(sorted, begin, end);
  const std::uint32_t first = build(sorted, begin, middle), second = build(sorted, middle, end);
  nodes_[self] = {min(nodes_[first].lo, nodes_[second].lo), max(nodes_[first].hi, nodes_[second].hi), second, 0};
  return self;
}

}  // namespace tetsoup
