#include "smooth/planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "smooth/facets.h"

namespace tetsoup {

namespace {

// In mean edges.
constexpr double kLeastWidth = 1;  // Of a plane: what is narrower than a tet cannot be followed by whole triangles.
constexpr double kFarthest = 0.6;  // A triangle's corner from its plane,
constexpr double kFarthestOfLayer = 0.15;  // and where the mesh is one tet thick, so that it fits the wall in it.

constexpr double kFacing = 0.2;   // Least cosine between a plane's normal and that of the aim which found it.
constexpr double kCreased = 0.9;  // Cosine between two sides of an edge of the boundary that is to stay.
constexpr std::uint32_t kNone = SoupPlanes::kNone;

// What a triangle's label costs.
constexpr double kAstray = 1;    // Times the share of its samples that found another plane.
constexpr double kTurn = 1;      // Times 1 - the cosine of the angle by which it has to turn.
constexpr double kBorder = 0.3;  // For every neighbour in another plane.
constexpr int kRounds = 6;       // Of asking every triangle once more; few change after three.
constexpr std::int64_t kTrianglesPerChunk = 128;

/// The three triangles across the edges of each.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const Connectivity& links) {
  std::vector<std::array<std::uint32_t, 3>> beside(links.triangles.size(), {kNone, kNone, kNone});
  std::vector<std::array<std::uint32_t, 4>> sides;  // ends of the edge, triangle, which of its edges
  for (std::uint32_t t = 0; t < links.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(links.triangles[t][i], links.triangles[t][(i + 1) % 3]);
      sides.push_back({a, b, t, i});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const auto &s = sides[i], &other = sides[i + 1];
    if (s[0] != other[0] || s[1] != other[1]) continue;
    beside[s[2]][s[3]] = other[2], beside[other[2]][other[3]] = s[2];
    ++i;
  }
  return beside;
}

/// Whether it belongs to a layer of one tet, which both faces of a thin wall draw at.
bool is_bare(const Connectivity& links, const Triangle& t) {
  return (links.is_bare[t[0]] & links.is_bare[t[1]] & links.is_bare[t[2]]) != 0;
}

}  // namespace

PlaneFit::PlaneFit(const TriangleSoup& soup, const Connectivity& links, double edge, StageWatch& watch)
    : links_(&links), edge_(edge) {
  SoupPlanes found = find_planes(soup, kLeastWidth * edge, watch);
  planes_ = std::move(found.planes);
  if (planes_.empty()) return;
  soup_.vertices = soup.vertices;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (found.plane_of[t] == kNone) continue;
    soup_.triangles.push_back(soup.triangles[t]);
    plane_of_.push_back(found.plane_of[t]);
  }
  boxes_.emplace(soup_, watch);
  beside_ = neighbours_of(links);
}

/// That of the nearest triangle within reach that faces along the normal, to either side.
std::uint32_t PlaneFit::plane_near(const Vec3d& p, const Vec3d& normal, double reach) const {
  const Vec3d at = boxes_->to_unit(p);
  double least = reach * reach * boxes_->scale() * boxes_->scale();
  float bound = TriangleBoxes::bound_above(least);
  std::uint32_t nearest = kNone;
  boxes_->visit_near(to_float(at), bound, [&](std::uint32_t t) {
    const double square = squared_length(closest_on_triangle(boxes_->corners_in_unit(t), at) - at);
    if (square > least || (square == least && t >= nearest)) return;
    if (std::abs(dot(planes_[plane_of_[t]].normal, normal)) < kFacing) return;
    least = square, bound = TriangleBoxes::bound_above(least), nearest = t;
  });
  return nearest == kNone ? kNone : plane_of_[nearest];
}

/// The planes that the places of a triangle's aims lie in.
PlaneFit::Found PlaneFit::find(std::size_t t, const TriangleAim& aim, const GuardedMesh& mesh, double reach,
                               double level) const {
  const TriangleCorners p = corners_at(mesh.mesh(), links_->triangles[t]);
  const Vec3d twice = cross(p[1] - p[0], p[2] - p[0]);
  Found found{{}, twice * (1 / length(twice)), aim.normal};
  found.planes.fill(kNone);
  const double farthest = edge_ * (is_bare(*links_, links_->triangles[t]) ? kFarthestOfLayer : kFarthest);
  for (std::size_t s = 0; s < kSamples; ++s) {
    const Aim& sample = aim.samples[s];
    if (!sample.in_reach) continue;
    const auto& w = kSampleWeights[s];
    const Vec3d at = p[0] * w[0] + p[1] * w[1] + p[2] * w[2];
    const Vec3d place = at + sample.normal * (sample.offset - level - dot(sample.normal, at));
    const std::uint32_t plane = plane_near(place, sample.normal, reach);
    if (plane == kNone) continue;
    const auto is_far = [&](const Vec3d& corner) {
      return std::abs(dot(planes_[plane].normal, corner) - planes_[plane].offset) > farthest;
    };
    if (std::none_of(p.begin(), p.end(), is_far)) found.planes[s] = plane;
  }
  return found;
}

/// Facing out, as the triangle would on a smooth boundary.
SoupPlane PlaneFit::outwards(std::uint32_t plane, const Found& found) const {
  const SoupPlane& p = planes_[plane];
  return dot(p.normal, found.smooth_normal) < 0 ? SoupPlane{p.normal * -1, -p.offset, p.area} : p;
}

double PlaneFit::cost(std::size_t t, std::uint32_t plane, const std::vector<Found>& found,
                      const std::vector<std::uint32_t>& label) const {
  const auto& planes = found[t].planes;
  const auto agree = static_cast<double>(std::count(planes.begin(), planes.end(), plane));
  double sum = kAstray * (1 - agree / static_cast<double>(kSamples));
  if (plane != kNone) sum += kTurn * (1 - dot(outwards(plane, found[t]).normal, found[t].normal));
  for (const std::uint32_t other : beside_[t]) sum += other != kNone && label[other] != plane ? kBorder : 0;
  return sum;
}

/// The plane of every triangle, or none, by asking one after the other for its cheapest.
std::vector<std::uint32_t> PlaneFit::settle(const std::vector<Found>& found) const {
  constexpr double kWorth = 1e-9;
  std::vector<std::uint32_t> label(found.size(), kNone);
  bool changed = true;
  for (int round = 0; round < kRounds && changed; ++round) {
    changed = false;
    for (std::size_t t = 0; t < found.size(); ++t) {
      std::uint32_t best = label[t];
      double least = cost(t, best, found, label) - kWorth;
      const auto offer = [&](std::uint32_t plane) {
        if (const double c = cost(t, plane, found, label); c < least) least = c - kWorth, best = plane;
      };
      offer(kNone);
      for (const std::uint32_t plane : found[t].planes) offer(plane);
      changed |= best != label[t];
      label[t] = best;
    }
  }
  return label;
}

std::vector<std::uint8_t> PlaneFit::lay(const GuardedMesh& mesh, double reach, double level,
                                        std::vector<TriangleAim>& aims, StageWatch& watch) const {
  if (planes_.empty()) return {};
  std::vector<Found> found(aims.size());
  parallel_for(static_cast<std::int64_t>(aims.size()), kTrianglesPerChunk, watch,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
                   found[t] = find(t, aims[t], mesh, reach, level);
                 }
               });
  const std::vector<std::uint32_t> label = settle(found);
  std::vector<Vec3d> facing(aims.size());
  for (std::size_t t = 0; t < aims.size(); ++t) {
    facing[t] = found[t].normal;
    if (label[t] == kNone) continue;
    const SoupPlane plane = outwards(label[t], found[t]);
    aims[t].normal = facing[t] = plane.normal;
    aims[t].samples.fill({plane.normal, plane.offset + level, true});
  }
  std::vector<std::uint8_t> creased(mesh.mesh().vertices.size(), 0);
  for (std::size_t t = 0; t < aims.size(); ++t) {
    for (std::size_t i = 0; i < 3 && label[t] != kNone; ++i) {
      const std::uint32_t other = beside_[t][i];
      if (other == kNone || label[other] == label[t] || dot(facing[t], facing[other]) > kCreased) continue;
      creased[links_->triangles[t][i]] = creased[links_->triangles[t][(i + 1) % 3]] = 1;
    }
  }
  return creased;
}

}  // namespace tetsoup
