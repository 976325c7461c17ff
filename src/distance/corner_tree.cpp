#include "distance/corner_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "distance/triangle_tree.h"
#include "kernel/triangle_distance.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kGrain = 16384;

float dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Seen along its normal the point lies beside the triangle for sure: the face need not be planned.
bool is_beside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  constexpr float kRounding = 1e-4F, kSliver = 1e-3F;
  const Vec3 u = minus(b, a), v = minus(c, a), n = cross(u, v), w = minus(p, a);
  const float uu = dot(u, u), vv = dot(v, v), square = dot(n, n);
  if (square < kSliver * uu * vv) return false;
  const float along_u = dot(cross(w, v), n), along_v = dot(cross(u, w), n);
  const float slack = kRounding * square * (1 + std::sqrt(dot(w, w) * std::max(uu, vv) / square));
  return along_u < -slack || along_v < -slack || along_u + along_v > square + slack;
}

/// Of the sides and the face; the corners have been asked.
float square_between_corners(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  float best = kernel::kBeyond;
  for (const kernel::EdgePlan& edge : {kernel::plan_edge(a, b), kernel::plan_edge(b, c), kernel::plan_edge(a, c)})
    best = std::min(best, kernel::edge_square(edge, p.x, p.y, p.z));
  if (is_beside(a, b, c, p)) return best;
  const kernel::FacePlan face = kernel::plan_face(a, b, c);
  return face.has_area ? std::min(best, kernel::face_square(face, p.x, p.y, p.z)) : best;
}

}  // namespace

/// A question, and the corners around which the nearest point may lie.
struct CornerTree::Query {
  struct Found {
    float square, reach;
    std::uint32_t corner;
  };
  Vec3 at;
  float best = 0;
  std::array<Found, 128> found;
  std::size_t count = 0;
  std::array<std::uint32_t, 64> asked;  ///< Triangles, at the last digits of their numbers.

  bool may_beat(float square, float reach) const { return square <= (best + reach) * kSlack + kSlackAbsolute; }
};

CornerTree::CornerTree(std::span<const Triangle> triangles, std::span<const Vec3> corners, StageWatch& watch)
    : triangles_(triangles),
      corners_(corners),
      fans_(corners.size(),
            [&](const auto& put) {
              for (std::uint32_t t = 0; t < triangles.size(); ++t)
                for (const std::uint32_t v : triangles[t]) put(v, t);
            }),
      tree_(make_box_hierarchy(
          corners.size(), kLeafSize, box_of(corners),
          [&](std::size_t i) {
            return BoxHierarchy::Box{corners[i], corners[i]};
          },
          watch)) {
  find_reaches(watch);
}

void CornerTree::find_reaches(StageWatch& watch) {
  std::vector<float> longest(corners_.size());  // in the order of the triangles, which is kind to caches
  for (const auto& [j, k, l] : triangles_) {
    const Vec3 &a = corners_[j], &b = corners_[k], &c = corners_[l];
    const float square = std::max({kernel::corner_square(a, b.x, b.y, b.z), kernel::corner_square(b, c.x, c.y, c.z),
                                   kernel::corner_square(c, a.x, a.y, a.z)});
    for (const std::uint32_t v : {j, k, l}) longest[v] = std::max(longest[v], square);
  }
  watch.step(0);
  const std::size_t count = tree_.order.size();
  for (std::vector<float>* column : {&x_, &y_, &z_, &reach_}) column->resize(count);
  parallel_for(static_cast<std::int64_t>(count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3& at = corners_[tree_.order[i]];
      x_[i] = at.x, y_[i] = at.y, z_[i] = at.z;
      reach_[i] = longest[tree_.order[i]] * (1.001F / 3);
    }
  });
  node_reach_.resize(tree_.nodes.size());
  for (std::size_t n = tree_.nodes.size(); n-- > 0;) {
    const BoxHierarchy::Node& node = tree_.nodes[n];
    node_reach_[n] = node.count > 0
                         ? *std::max_element(reach_.begin() + node.next, reach_.begin() + node.next + node.count)
                         : std::max(node_reach_[n + 1], node_reach_[node.next]);
  }
}

void CornerTree::look_at_leaf(const BoxHierarchy::Node& node, Query& query) const {
  std::array<float, kLeafSize> squares;
  const float *x = &x_[node.next], *y = &y_[node.next], *z = &z_[node.next], *reach = &reach_[node.next];
  float least = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < node.count; ++i) {
    squares[i] = kernel::corner_square({x[i], y[i], z[i]}, query.at.x, query.at.y, query.at.z);
    least = std::min(least, squares[i]);
  }
  query.best = std::min(query.best, least);
  for (std::uint32_t i = 0; i < node.count; ++i) {
    if (!query.may_beat(squares[i], reach[i])) continue;
    if (query.count == query.found.size()) ask_found(query);
    query.found[query.count++] = {squares[i], reach[i], tree_.order[node.next + i]};
  }
}

void CornerTree::ask_found(Query& query) const {
  for (std::size_t i = 0; i < query.count; ++i) {
    const Query::Found& found = query.found[i];
    if (!query.may_beat(found.square, found.reach)) continue;
    for (const std::uint32_t t : fans_[found.corner]) {
      std::uint32_t& asked = query.asked[t % query.asked.size()];
      if (asked == t) continue;
      asked = t;
      const auto [j, k, l] = triangles_[t];
      query.best = std::min(query.best, square_between_corners(corners_[j], corners_[k], corners_[l], query.at));
    }
  }
  query.count = 0;
}

float CornerTree::nearest_squared(float x, float y, float z, float bound) const {
  struct Pending {
    std::uint32_t node;
    float square;
  };
  std::array<Pending, BoxHierarchy::kMaxDepth> stack;
  std::size_t depth = 0;
  Query query;
  query.at = {x, y, z};
  query.best = bound;
  query.asked.fill(0xFFFFFFFFU);
  const auto look = [&](std::uint32_t node) {
    return Pending{node, squared_distance_to(tree_.nodes[node].lo, tree_.nodes[node].hi, x, y, z)};
  };
  stack[depth++] = look(0);
  while (depth > 0) {
    const Pending at = stack[--depth];
    if (!query.may_beat(at.square, node_reach_[at.node])) continue;
    const BoxHierarchy::Node& node = tree_.nodes[at.node];
    if (node.count > 0) {
      look_at_leaf(node, query);
      continue;
    }
    Pending near = look(at.node + 1), far = look(node.next);
    if (far.square < near.square) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  ask_found(query);
  return query.best;
}

}  // namespace tetsoup
