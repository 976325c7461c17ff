#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/elementary.h"
#include "base/vec.h"
#include "bodies/thin_spaces.h"
#include "tetsoup/bodies.h"

namespace tetsoup {
namespace {

/// Of a body's area: what takes less decides nothing. Beside open parts what faces each other may be anything.
constexpr double kWallShare = 0.01, kGapShare = 0.02, kUnknownShare = 0.05;
/// Voxels across a wall or a gap: with fewer some rows of voxels may miss it.
constexpr double kVoxelsAcross = 1.7;
/// Where the volume is unknown: of the box.
constexpr double kGuessedFill = 0.3;
constexpr double kDefaultVoxels = 128;
/// Along the longest side: of what walls and gaps may ask for, of what the tets may, of the smallest grid.
constexpr double kMostVoxels = 400, kMostForTets = 256, kLeastVoxels = 24;
/// Voxels to an edge of a tet: of a body alone at the least, of a body among others.
constexpr double kLeastToEdge = 5, kToEdge = 8;
/// Volume of a tet with edge e is e^3 over this.
constexpr double kTetShape = 8.49;

double edge_for(double volume, double tets) {
  return elementary::cbrt(kTetShape * volume / tets);
}

/// What the samples of the whole soup say of one body.
ThinSpaces of_body(const ThinSpaces& all, const std::vector<std::uint32_t>& body_of, std::uint32_t body, double area) {
  ThinSpaces own;
  for (const FacingSample& sample : all.samples)
    if (body_of[sample.triangle] == body && body_of[sample.opposite] == body) own.samples.push_back(sample);
  own.area = area;
  own.point_count = all.area > 0 ? static_cast<std::size_t>(static_cast<double>(all.point_count) * area / all.area) : 0;
  return own;
}

/// Bodies with so many rims for each triangle are loose: what faces each other there is chance.
constexpr double kLooseRims = 0.25;

std::vector<std::size_t> count_rims(const CleanSoup& soup, const std::vector<std::uint32_t>& body_of,
                                    std::size_t count) {
  std::vector<std::uint32_t> body_of_vertex(soup.soup.vertices.size(), 0xFFFFFFFFU);
  for (std::size_t t = 0; t < body_of.size(); ++t)
    for (const std::uint32_t v : soup.soup.triangles[t]) body_of_vertex[v] = body_of[t];
  std::vector<std::size_t> rims(count);
  for (const auto& [a, b] : soup.parts.odd_edges)
    if (body_of_vertex[a] < count) ++rims[body_of_vertex[a]];
  return rims;
}

std::optional<double> least(std::optional<double> a, std::optional<double> b) {
  if (!a || (b && *b < *a)) return b;
  return a;
}

void measure_triangle(const CleanSoup& soup, std::uint32_t t, Box3& box, BodySize& size) {
  const auto [a, b, c] = soup.soup.triangles[t];
  const Vec3d pa = to_double(soup.soup.vertices[a]), pb = to_double(soup.soup.vertices[b]),
              pc = to_double(soup.soup.vertices[c]);
  size.area += length(cross(pb - pa, pc - pa)) / 2;
  box = {min(box.lo, min(pa, min(pb, pc))), max(box.hi, max(pa, max(pb, pc)))};
}

/// The volume of a body's closed and oriented parts, hollows taken off; a guess for the others.
double volume_of(const CleanSoup& soup, const std::vector<std::uint8_t>& in_body, const Box3& box) {
  double known = 0;
  bool guess = false;
  for (std::size_t p = 0; p < in_body.size(); ++p) {
    if (in_body[p] == 0) continue;
    const SoupPart& part = soup.parts.parts[p];
    const std::uint32_t holder = soup.parts.around.empty() ? SoupParts::kNone : soup.parts.around[p];
    if (!part.oriented) {
      guess = true;
    } else if (holder == SoupParts::kNone) {
      known += std::abs(part.volume);
    } else if ((soup.parts.parts[holder].volume < 0) != (part.volume < 0)) {
      known -= std::abs(part.volume);
    }
  }
  const Vec3d e = box.hi - box.lo;
  return guess ? std::max(known, kGuessedFill * e.x * e.y * e.z) : known;
}

}  // namespace

std::vector<BodySize> measure_bodies(const CleanSoup& soup, const Bodies& bodies, const Progress& progress) {
  StageWatch watch(progress, "bodies");
  const std::size_t count = bodies.triangles.size();
  constexpr std::size_t kMostForPoints = 8;
  std::vector<std::uint8_t> closed(soup.parts.parts.size());
  for (std::size_t p = 0; p < closed.size(); ++p) closed[p] = soup.parts.parts[p].sound;
  const ThinSpaces spaces = measure_thin_spaces(soup.soup, soup.parts.part_of_triangle, closed,
                                                kThinPoints * std::min(count, kMostForPoints), watch);
  std::vector<std::uint32_t> body_of(soup.soup.triangles.size(), 0xFFFFFFFFU);
  for (std::uint32_t b = 0; b < count; ++b)
    for (const std::uint32_t t : bodies.triangles[b]) body_of[t] = b;
  const std::vector<std::size_t> rims = count_rims(soup, body_of, count);
  std::vector<BodySize> sizes(count);
  for (std::uint32_t b = 0; b < count; ++b) {
    Box3 box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
    std::vector<std::uint8_t> in_body(soup.parts.parts.size());
    for (const std::uint32_t t : bodies.triangles[b]) {
      measure_triangle(soup, t, box, sizes[b]);
      in_body[soup.parts.part_of_triangle[t]] = 1;
    }
    const Vec3d e = box.hi - box.lo;
    sizes[b].longest = std::max({e.x, e.y, e.z});
    sizes[b].volume = volume_of(soup, in_body, box);
    sizes[b].rims = rims[b] > 0;
    if (spaces.samples.empty()) continue;
    const ThinSpaces own = count == 1 ? spaces : of_body(spaces, body_of, b, sizes[b].area);
    const bool loose = static_cast<double>(rims[b]) > kLooseRims * static_cast<double>(bodies.triangles[b].size());
    const auto unknown = loose ? std::nullopt : own.thinnest(SpaceKind::Unknown, kUnknownShare);
    sizes[b].wall = least(own.thinnest(SpaceKind::Wall, kWallShare), unknown);
    sizes[b].gap = own.thinnest(SpaceKind::Gap, kGapShare);
  }
  return sizes;
}

std::vector<std::size_t> share_tets(std::span<const BodySize> bodies, std::size_t tets) {
  double volume = 0, area = 0;
  for (const BodySize& body : bodies) {
    volume += body.volume;
    area += body.area;
  }
  const auto wanted = static_cast<double>(tets), count = static_cast<double>(bodies.size());
  const double edge = std::max(edge_for(volume, wanted), std::sqrt(area / wanted) / 2);
  std::vector<double> weight(bodies.size());
  double all = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) all += weight[b] = bodies[b].volume + bodies[b].area * edge / 8;
  const auto floor_count = static_cast<std::size_t>(std::clamp(wanted / (4 * count), 5.0, 24.0));
  std::vector<std::size_t> order(bodies.size()), shares(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return weight[a] < weight[b]; });
  // From the smallest to the largest: what the floor gives to the small ones the large ones lack.
  std::size_t left = tets, rest = bodies.size();
  for (const std::size_t b : order) {
    const double share = all > 0 ? static_cast<double>(left) * weight[b] / all : 0;
    std::size_t own = std::max(floor_count, static_cast<std::size_t>(share));
    if (left < rest) {
      own = 0;
    } else if (left < rest * floor_count) {
      own = 1;
    }
    shares[b] = own = std::min(own, left);
    left -= own;
    all -= weight[b];
    --rest;
  }
  return shares;
}

double wanted_voxel_size(const BodySize& body, std::size_t tets, bool alone) {
  const double edge = edge_for(body.volume, static_cast<double>(std::max<std::size_t>(tets, 1)));
  const double across = edge > 0 ? body.longest / edge : 0;
  double voxels = alone ? std::max(kDefaultVoxels, std::min(kMostForTets, kLeastToEdge * across))
                        : std::clamp(kToEdge * across, kLeastVoxels, kDefaultVoxels);
  const std::optional<double> thin = least(body.wall, body.gap);
  if (thin && *thin > 0) voxels = std::max(voxels, std::min(kMostVoxels, kVoxelsAcross * body.longest / *thin));
  return body.longest / std::ceil(voxels);
}

}  // namespace tetsoup
