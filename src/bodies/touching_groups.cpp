#include "bodies/touching_groups.h"

#include <algorithm>
#include <limits>

#include "base/unions.h"
#include "bodies/rays.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kMixed = kNoPart;  ///< Of a node that holds parts of several sets.

/// Every vertex joins the parts of its triangles.
void join_at_vertices(const TriangleSoup& soup, std::span<const std::uint32_t> parts, Unions& sets) {
  std::vector<std::uint32_t> first(soup.vertices.size(), kNoPart);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (const std::uint32_t v : soup.triangles[t]) {
      if (first[v] == kNoPart) first[v] = parts[t];
      if (first[v] != parts[t]) sets.join(first[v], parts[t]);
    }
  }
}

/// Asks pairs of triangles whose boxes meet, neighbours in the tree first: they join most parts, and what is joined
/// already is not asked.
class Joiner {
 public:
  Joiner(const TriangleSoup& soup, std::span<const std::uint32_t> parts, double near, Unions& sets, StageWatch& watch)
      : parts_(parts),
        near_(near),
        sets_(sets),
        watch_(watch),
        tree_(make_box_hierarchy(soup.triangles, soup.vertices, watch)) {
    node_parts_.assign(tree_.nodes.size(), kMixed);
    corners_.reserve(tree_.order.size());
    for (const std::uint32_t t : tree_.order) corners_.push_back(corners_of(soup, t));
  }
  void join() {
    if (!tree_.nodes.empty()) join_within(0);
  }

 private:
  using Node = BoxHierarchy::Node;
  static constexpr std::uint32_t kOften = 0xFFFF;  ///< Pairs of nodes between two questions whether to go on.

  void join_within(std::uint32_t n) {
    const Node& node = tree_.nodes[n];
    if (node.count > 0) {
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        for (std::uint32_t k = i + 1; k < node.next + node.count; ++k) ask(i, k);
      node_parts_[n] = part_of(node.next);
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        if (!is_one(node_parts_[n], part_of(i))) node_parts_[n] = kMixed;
      return;
    }
    join_within(n + 1);
    join_within(node.next);
    join_between(n + 1, node.next);
    if (is_one(node_parts_[n + 1], node_parts_[node.next])) node_parts_[n] = node_parts_[n + 1];
  }

  void join_between(std::uint32_t a, std::uint32_t b) {
    if (is_one(node_parts_[a], node_parts_[b])) return;
    const Node &p = tree_.nodes[a], &q = tree_.nodes[b];
    if (are_apart(p.lo, p.hi, q.lo, q.hi)) return;
    if ((++visited_ & kOften) == 0) watch_.step(0);
    if (p.count > 0 && q.count > 0) {
      for (std::uint32_t i = p.next; i < p.next + p.count; ++i)
        for (std::uint32_t k = q.next; k < q.next + q.count; ++k) ask(i, k);
    } else if (p.count > 0 || (q.count == 0 && extent(q) > extent(p))) {
      join_between(a, b + 1);
      join_between(a, q.next);
    } else {
      join_between(a + 1, b);
      join_between(p.next, b);
    }
  }

  /// Places in the tree's order.
  void ask(std::uint32_t i, std::uint32_t k) {
    const std::uint32_t a = part_of(i), b = part_of(k);
    if (is_one(a, b)) return;
    const TriangleCorners &p = corners_[i], &q = corners_[k];
    if (are_apart(min(p[0], min(p[1], p[2])), max(p[0], max(p[1], p[2])), min(q[0], min(q[1], q[2])),
                  max(q[0], max(q[1], q[2]))))
      return;
    if (triangles_meet(p, q) || (near_ > 0 && squared_distance(p, q) < near_ * near_)) sets_.join(a, b);
  }

  std::uint32_t part_of(std::uint32_t place) const { return parts_[tree_.order[place]]; }
  bool is_one(std::uint32_t a, std::uint32_t b) {
    return a == b ? a != kMixed : a != kMixed && b != kMixed && sets_.find(a) == sets_.find(b);
  }
  bool are_apart(const Vec3& lo_a, const Vec3& hi_a, const Vec3& lo_b, const Vec3& hi_b) const {
    const auto apart = [this](float from, float to) {
      return static_cast<double>(from) - static_cast<double>(to) > near_;
    };
    return apart(lo_a.x, hi_b.x) || apart(lo_b.x, hi_a.x) || apart(lo_a.y, hi_b.y) || apart(lo_b.y, hi_a.y) ||
           apart(lo_a.z, hi_b.z) || apart(lo_b.z, hi_a.z);
  }
  static float extent(const Node& node) {
    return node.hi.x - node.lo.x + node.hi.y - node.lo.y + node.hi.z - node.lo.z;
  }

  std::span<const std::uint32_t> parts_;
  double near_;
  Unions& sets_;
  StageWatch& watch_;
  BoxHierarchy tree_;
  std::vector<std::uint32_t> node_parts_;  ///< A part that stands for all of the node's; or kMixed.
  std::vector<TriangleCorners> corners_;   ///< In the tree's order.
  std::uint32_t visited_ = 0;
};

/// The boxes of the parts.
std::vector<BoxHierarchy::Box> part_boxes(const TriangleSoup& soup, std::span<const std::uint32_t> parts,
                                          std::size_t part_count) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<BoxHierarchy::Box> boxes(part_count, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    auto& [lo, hi] = boxes[parts[t]];
    for (const std::uint32_t v : soup.triangles[t]) lo = min(lo, soup.vertices[v]), hi = max(hi, soup.vertices[v]);
  }
  return boxes;
}

double volume_of(const BoxHierarchy::Box& box) {
  const Vec3d sides = to_double(box.hi) - to_double(box.lo);
  return sides.x * sides.y * sides.z;
}

}  // namespace

std::vector<std::uint32_t> touching_groups(const TriangleSoup& soup, std::span<const std::uint32_t> part_of_triangle,
                                           std::size_t part_count, double near, StageWatch& watch) {
  Unions sets(part_count);
  join_at_vertices(soup, part_of_triangle, sets);
  Joiner(soup, part_of_triangle, near, sets, watch).join();
  std::vector<std::uint32_t> groups(part_count);
  std::uint32_t count = 0;
  for (std::size_t p = 0; p < part_count; ++p) groups[p] = sets.find(p) == p ? count++ : groups[sets.find(p)];
  return groups;
}

std::vector<std::uint32_t> part_inside(const TriangleSoup& soup, std::span<const std::uint32_t> part_of_triangle,
                                       std::span<const std::uint32_t> groups, std::span<const std::uint8_t> is_closed,
                                       StageWatch& watch) {
  std::vector<std::uint32_t> around(groups.size(), kNoPart);
  if (std::all_of(is_closed.begin(), is_closed.end(), [](std::uint8_t closed) { return closed == 0; })) return around;
  const BoxHierarchy tree = make_box_hierarchy(soup.triangles, soup.vertices, watch);
  const std::vector<BoxHierarchy::Box> boxes = part_boxes(soup, part_of_triangle, groups.size());
  std::vector<std::uint32_t> vertex(groups.size(), kNoPart);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) vertex[part_of_triangle[t]] = soup.triangles[t][0];
  parallel_for(static_cast<std::int64_t>(groups.size()), 16, watch, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint32_t> crossed;
    for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
      if (vertex[p] == kNoPart) continue;
      crossed.clear();
      visit_crossed(soup, tree, soup.vertices[vertex[p]], [&](std::uint32_t t) {
        const std::uint32_t other = part_of_triangle[t];
        if (is_closed[other] != 0 && groups[other] != groups[p]) crossed.push_back(other);
      });
      keep_odd(crossed);
      // Of those that hold the same point and do not touch, each lies in all larger ones.
      for (const std::uint32_t other : crossed)
        if (around[p] == kNoPart || volume_of(boxes[other]) < volume_of(boxes[around[p]])) around[p] = other;
    }
  });
  return around;
}

}  // namespace tetsoup
