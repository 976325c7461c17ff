#include "base/box_hierarchy.h"

namespace tetsoup {
namespace {

constexpr double kCodeRange = 8000;  // Morton codes tell an eighth of a unit up to 8191.

using Node = BoxHierarchy::Node;

std::uint32_t build(std::span<const MortonEntry> sorted, std::span<const BoxHierarchy::Box> boxes, std::uint32_t begin,
                    std::uint32_t end, std::vector<Node>& nodes) {
  const auto self = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back({boxes[begin].lo, boxes[begin].hi, begin, end - begin});
  if (end - begin <= BoxHierarchy::kLeafSize) {
    for (const auto& [lo, hi] : boxes.subspan(begin, end - begin)) {
      nodes[self].lo = min(nodes[self].lo, lo);
      nodes[self].hi = max(nodes[self].hi, hi);
    }
    return self;
  }
  const std::uint32_t middle = morton_split(sorted, begin, end);
  const std::uint32_t first = build(sorted, boxes, begin, middle, nodes),
                      second = build(sorted, boxes, middle, end, nodes);
  nodes[self] = {min(nodes[first].lo, nodes[second].lo), max(nodes[first].hi, nodes[second].hi), second, 0};
  return self;
}

}  // namespace

std::vector<Node> detail::make_box_nodes(std::span<const MortonEntry> sorted,
                                         std::span<const BoxHierarchy::Box> boxes) {
  std::vector<Node> nodes;
  nodes.reserve(sorted.size());
  build(sorted, boxes, 0, static_cast<std::uint32_t>(sorted.size()), nodes);
  return nodes;
}

BoxHierarchy make_triangle_hierarchy(const TriangleSoup& soup, StageWatch& watch) {
  const Box3 all = box_of(soup.vertices);
  const Vec3d sides = all.hi - all.lo;
  const double longest = std::max({sides.x, sides.y, sides.z}), scale = longest > 0 ? kCodeRange / longest : 0;
  const auto box = [&](std::size_t i) {
    const auto [a, b, c] = soup.triangles[i];
    const Vec3 &p = soup.vertices[a], &q = soup.vertices[b], &r = soup.vertices[c];
    return BoxHierarchy::Box{min(p, min(q, r)), max(p, max(q, r))};
  };
  const auto place = [&](std::size_t i) {
    const auto [lo, hi] = box(i);
    return to_float(((to_double(lo) + to_double(hi)) * 0.5 - all.lo) * scale);
  };
  return make_box_hierarchy(soup.triangles.size(), box, place, watch);
}

}  // namespace tetsoup
