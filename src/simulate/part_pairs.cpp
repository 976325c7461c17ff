#include "simulate/part_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/box_hierarchy.h"
#include "base/elementary.h"
#include "simulate/contact_constants.h"

namespace tetsoup::simulate {
namespace {

constexpr std::int64_t kGrain = 256;  ///< Parts a task.

/// How the vertices of a part's surface move: with a common velocity, and at most so much faster than it.
struct Drift {
  Vec3d velocity;
  double spread = 0;
};

Vec3d velocity_of(const kernel::Motion& m) {
  return {m.x, m.y, m.z};
}

Drift drift_of(const World& world, const Part& part) {
  const std::vector<std::uint32_t>& vertices = world.surfaces[part.surface].vertices;
  Drift drift;
  for (const std::uint32_t v : vertices) drift.velocity += velocity_of(world.motions[part.begin + v]);
  drift.velocity = drift.velocity * (1 / static_cast<double>(vertices.size()));
  for (const std::uint32_t v : vertices)
    drift.spread = std::max(drift.spread, squared_length(velocity_of(world.motions[part.begin + v]) - drift.velocity));
  drift.spread = std::sqrt(drift.spread);
  return drift;
}

/// The mean of the rotations of a part's tets.
kernel::Motion mean_rotation(const Part& part) {
  std::array<float, 4> sum{};
  for (const kernel::TetRotations& r : part.rotations) {
    // q and -q are the same rotation: all are taken on the side of the first.
    float side = 0;
    for (int i = 0; i < 4; ++i) side += r.q[i][0] * part.rotations[0].q[i][0];
    for (std::size_t i = 0; i < 4; ++i) sum[i] += side < 0 ? -r.q[i][0] : r.q[i][0];
  }
  const float size = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2] + sum[3] * sum[3]);
  if (!(size > 0)) return {0, 0, 0, 1};
  return {sum[0] / size, sum[1] / size, sum[2] / size, sum[3] / size};
}

/// Whether a part has left its shape at rest, turned and shifted, so far that it may touch itself elsewhere than where
/// that does not count: by more than half of what counts as neighbours.
bool may_touch_itself(const World& world, const Part& part) {
  if (world.options.solver != Solver::Implicit) return true;
  const Rest& rest = world.rest_of(part);
  const RestSurface& surface = world.surfaces[part.surface];
  const kernel::Motion q = mean_rotation(part);
  const Vec3d axis{q.x, q.y, q.z};
  const auto turned = [&](const Vec3d& p) {
    return p + cross(axis, cross(axis, p) + p * static_cast<double>(q.mass)) * 2;
  };
  Vec3d shift;
  const auto left = [&](std::uint32_t v) {
    return to_double(to_vec(world.places[part.begin + v])) - turned(rest.piece.places[v]);
  };
  for (const std::uint32_t v : surface.vertices) shift += left(v);
  shift = shift * (1 / static_cast<double>(surface.vertices.size()));
  const double most = elementary::square(kNeighbours * rest.piece.mean_edge / 2);
  return std::any_of(surface.vertices.begin(), surface.vertices.end(),
                     [&](std::uint32_t v) { return squared_length(left(v) - shift) > most; });
}

/// All that may come within the bounds. A little more, since it is rounded otherwise than Bounds::meets() is.
BoxHierarchy::Box box_around(const Bounds& b, double ahead) {
  constexpr double kRounding = 1e-6;
  const Vec3d lo = to_double(b.lo), hi = to_double(b.hi);
  const double farthest = std::max({-lo.x, -lo.y, -lo.z, hi.x, hi.y, hi.z, hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
  const double most = ahead + kRounding * (ahead + farthest);
  return {to_float(lo - Vec3d{most, most, most}), to_float(hi + Vec3d{most, most, most})};
}

BoxHierarchy tree_over(std::span<const BoxHierarchy::Box> boxes, StageWatch& watch) {
  if (boxes.empty()) return {};
  Box3 all{to_double(boxes[0].lo), to_double(boxes[0].hi)};
  for (const BoxHierarchy::Box& box : boxes) all = {min(all.lo, to_double(box.lo)), max(all.hi, to_double(box.hi))};
  return make_box_hierarchy(
      boxes.size(), 1, all, [&](std::size_t i) { return boxes[i]; }, watch);
}

template <class Visit>
void visit_meeting(const BoxHierarchy& tree, const BoxHierarchy::Box& box, const Visit& visit) {
  std::array<std::uint32_t, BoxHierarchy::kMaxDepth + 1> open{};
  for (std::size_t depth = tree.nodes.empty() ? 0 : 1; depth > 0;) {
    const std::uint32_t number = open[--depth];
    const BoxHierarchy::Node& node = tree.nodes[number];
    if (!Bounds{node.lo, node.hi}.meets({box.lo, box.hi}, 0)) continue;
    for (std::uint32_t i = 0; i < node.count; ++i) visit(tree.order[node.next + i]);
    if (node.count > 0) continue;
    open[depth++] = node.next;
    open[depth++] = number + 1;
  }
}

}  // namespace

PartPairs find_part_pairs(const World& world, double horizon, StageWatch& watch) {
  const std::size_t count = world.parts.size();
  PartPairs pairs{std::vector<Bounds>(count), std::vector<float>(count), std::vector<std::vector<Partner>>(count)};
  std::vector<Drift> drifts(count);
  std::vector<std::uint8_t> bent(count, 0);
  const double gained = length(world.options.gravity) * horizon;
  const auto most_ahead = [&](std::size_t p) { return kMostAhead * world.rest_of(world.parts[p]).piece.mean_edge; };
  parallel_for(static_cast<std::int64_t>(count), 1, watch, [&](std::int64_t begin, std::int64_t) {
    const auto p = static_cast<std::size_t>(begin);
    const Part& part = world.parts[p];
    for (const std::uint32_t v : world.surfaces[part.surface].vertices)
      pairs.bounds[p].add(to_vec(world.places[part.begin + v]));
    drifts[p] = drift_of(world, part);
    const double speed = length(drifts[p].velocity) + drifts[p].spread + gained;
    pairs.ahead[p] = static_cast<float>(std::min(speed * horizon, most_ahead(p)));
    bent[p] = world.options.contacts == Contacts::All && may_touch_itself(world, part) ? 1 : 0;
  });
  std::vector<BoxHierarchy::Box> widened(count);
  for (std::size_t p = 0; p < count; ++p) widened[p] = box_around(pairs.bounds[p], most_ahead(p));
  const BoxHierarchy tree = tree_over(widened, watch);
  // Of two, what the first in number has counts as the first, so that both find the same.
  const auto meet = [&](std::uint32_t p, std::uint32_t q) -> std::optional<float> {
    const bool wanted = world.options.contacts == Contacts::All || world.parts[p].body != world.parts[q].body;
    if (p == q ? bent[p] == 0 : !wanted) return {};
    const double closing =
        length(drifts[p].velocity - drifts[q].velocity) + drifts[p].spread + drifts[q].spread + gained;
    const auto ahead = static_cast<float>(std::min(closing * horizon, most_ahead(p) + most_ahead(q)));
    return pairs.bounds[p].meets(pairs.bounds[q], ahead) ? std::optional(ahead) : std::nullopt;
  };
  parallel_for(static_cast<std::int64_t>(count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto p = static_cast<std::uint32_t>(begin); p < static_cast<std::uint32_t>(end); ++p) {
      std::vector<Partner>& partners = pairs.partners[p];
      visit_meeting(tree, widened[p], [&](std::uint32_t q) {
        if (const auto ahead = meet(std::min(p, q), std::max(p, q))) partners.push_back({q, *ahead});
      });
      std::sort(partners.begin(), partners.end(), [](const Partner& a, const Partner& b) { return a.part < b.part; });
    }
  });
  return pairs;
}

}  // namespace tetsoup::simulate
