#include "simulate/part_pairs.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "simulate/contact_constants.h"

namespace tetsoup::simulate {
namespace {

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
  for (std::uint32_t p = 0; p < count; ++p) {
    for (std::uint32_t q = p; q < count; ++q) {
      const bool wanted = world.options.contacts == Contacts::All || world.parts[p].body != world.parts[q].body;
      if (p == q ? bent[p] == 0 : !wanted) continue;
      const double closing =
          length(drifts[p].velocity - drifts[q].velocity) + drifts[p].spread + drifts[q].spread + gained;
      const auto ahead = static_cast<float>(std::min(closing * horizon, most_ahead(p) + most_ahead(q)));
      if (!pairs.bounds[p].meets(pairs.bounds[q], ahead)) continue;
      pairs.partners[p].push_back({q, ahead});
      if (p != q) pairs.partners[q].push_back({p, ahead});
    }
  }
  for (auto& some : pairs.partners)
    std::sort(some.begin(), some.end(), [](const Partner& a, const Partner& b) { return a.part < b.part; });
  return pairs;
}

}  // namespace tetsoup::simulate
