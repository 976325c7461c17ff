#include "simulate/edge_contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/vec.h"
#include "simulate/contact_constants.h"

namespace tetsoup::simulate {
namespace {

/// The stretch of an edge that lies in a tet, and the barycentric coordinates of its ends there.
struct Stretch {
  double begin = 0, end = 1;
  std::uint32_t tet = 0;
  std::array<double, 4> from{}, to{};

  double middle() const { return (begin + end) / 2; }
  EdgePlace place(double along) const {
    EdgePlace p{static_cast<float>(along), tet, {}};
    for (std::size_t i = 0; i < 4; ++i) p.weights[i] = static_cast<float>(from[i] + (to[i] - from[i]) * along);
    return p;
  }
};

std::optional<Stretch> stretch_in(const World& world, const Part& part, std::uint32_t t, const Vec3d& a,
                                  const Vec3d& b) {
  TetCorners corners;
  const Tet& tet = world.rest_of(part).piece.tets[t];
  for (std::size_t i = 0; i < 4; ++i) corners[i] = world.place(part.begin + tet[i]);
  const double six_volumes = 6 * signed_volume(corners);
  if (!(six_volumes > 0)) return {};
  Stretch s;
  s.tet = t;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d normal = inward_normal(corners, i), &corner = corners[(i + 1) % 4];
    s.from[i] = dot(normal, a - corner) / six_volumes;
    s.to[i] = dot(normal, b - corner) / six_volumes;
    if (s.from[i] < 0 && s.to[i] < 0) return {};
    const double zero = s.from[i] / (s.from[i] - s.to[i]);
    if (s.from[i] < 0) s.begin = std::max(s.begin, zero);
    if (s.to[i] < 0) s.end = std::min(s.end, zero);
  }
  if (!(s.begin < s.end)) return {};
  return s;
}

/// Nothing if an end of the edge is in: then a vertex tells.
std::optional<EdgeHit> hit_of(const std::vector<Stretch>& stretches) {
  if (stretches.empty()) return {};
  const Stretch *first = &stretches[0], *last = first, *longest = first, *middle = nullptr;
  for (const Stretch& s : stretches) {
    if (s.begin < first->begin) first = &s;
    if (s.end > last->end) last = &s;
    if (s.end - s.begin > longest->end - longest->begin) longest = &s;
  }
  if (!(first->begin > 0 && last->end < 1)) return {};
  const double along = (first->begin + last->end) / 2;
  for (const Stretch& s : stretches)
    if (middle == nullptr && s.begin <= along && along <= s.end) middle = &s;
  EdgeHit hit;
  hit.in = first->place(first->begin);
  hit.out = last->place(last->end);
  // Over a hollow the middle may be outside.
  hit.middle = middle != nullptr ? middle->place(along) : longest->place(longest->middle());
  return hit;
}

Vec3d rest_place_of(const Piece& piece, const EdgePlace& p) {
  Vec3d at;
  for (std::size_t i = 0; i < 4; ++i) at += piece.places[piece.tets[p.tet][i]] * static_cast<double>(p.weights[i]);
  return at;
}

}  // namespace

std::vector<EdgeHit> find_edge_hits(const World& world, const PartPairs& pairs, std::uint32_t part, std::uint32_t other,
                                    std::size_t begin, std::size_t end) {
  const Part &owner = world.parts[part], &from = world.parts[other];
  const RestSurface& skin = world.surfaces[owner.surface];
  const std::vector<std::array<std::uint32_t, 2>>& edges = world.surfaces[from.surface].sharp_edges;
  const auto place = [&](std::uint32_t v) { return to_vec(world.places[from.begin + v]); };
  std::vector<kernel::NumberedPoint> boxes;
  for (std::size_t e = begin; e < end; ++e) {
    Bounds box;
    for (const std::uint32_t v : edges[e]) box.add(place(v));
    if (!pairs.bounds[part].meets(box, 0)) continue;
    const Vec3d lo = to_double(box.lo), hi = to_double(box.hi);
    boxes.push_back({to_float((lo + hi) * 0.5), static_cast<std::uint32_t>(e), {}, to_float((hi - lo) * 0.5)});
  }
  std::vector<kernel::PointInBox> found;
  kernel::find_boxes_around(owner.boxes, boxes, 0, {}, found);
  std::vector<EdgeHit> hits;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::array<std::uint32_t, 2>& ends = edges[found[i].point];
    if (const auto s = stretch_in(world, owner, skin.tet_order[found[i].box], to_double(place(ends[0])),
                                  to_double(place(ends[1]))))
      stretches.push_back(*s);
    if (i + 1 < found.size() && found[i + 1].point == found[i].point) continue;
    if (auto hit = hit_of(stretches)) {
      hit->part = part;
      hit->ends = {from.begin + ends[0], from.begin + ends[1]};
      hits.push_back(*hit);
    }
    stretches.clear();
  }
  return hits;
}

void add_edge_contacts(World& world, const EdgeHit& hit) {
  constexpr double kOpposite = -0.5;  // cosine between two sides of which not both can push
  constexpr double kAlike = 1.5;      // nor if one is so many times as deep as the other
  const Part& owner = world.parts[hit.part];
  const Rest& rest = world.rest_of(owner);
  const RestSurface& skin = world.surfaces[owner.surface];
  const auto nearest = [&](const EdgePlace& p) {
    return nearest_surface_point(skin, rest.piece, p.tet, rest_place_of(rest.piece, p), {});
  };
  const double other_friction = world.rest_of(world.parts[world.owners[hit.ends[0]]]).material.friction;
  const auto friction = static_cast<float>(std::sqrt(other_friction * rest.material.friction));
  const auto reach = static_cast<float>(kReach * rest.piece.mean_edge);
  const auto slack = static_cast<float>(kEdgeSlack * rest.piece.mean_edge);
  const auto add = [&](const SurfacePoint& point) {
    EdgeContact e{
        {hit.ends[0], {}, {}, friction, reach, hit.part, point.triangle}, hit.ends[1], hit.middle.along, slack};
    for (std::size_t i = 0; i < 3; ++i) {
      e.contact.corners[i] = owner.begin + skin.triangles[point.triangle][i];
      e.contact.weights[i] = static_cast<float>(point.weights[i]);
    }
    world.contacts.across.push_back(e);
  };
  const SurfacePoint in = nearest(hit.in), out = nearest(hit.out), middle = nearest(hit.middle);
  const Vec3d at = rest_place_of(rest.piece, hit.middle);
  const auto depth = [&](const SurfacePoint& p) {
    return std::abs(dot(rest.piece.places[skin.triangles[p.triangle][0]] - at, skin.normals[p.triangle]));
  };
  const double most = kAlike * std::min({depth(in), depth(out), depth(middle)});
  const bool is_ridge =
      dot(skin.normals[in.triangle], skin.normals[out.triangle]) > kOpposite && depth(in) <= most && depth(out) <= most;
  if (!is_ridge || in.triangle == out.triangle) return add(middle);
  add(in);
  add(out);
}

}  // namespace tetsoup::simulate
