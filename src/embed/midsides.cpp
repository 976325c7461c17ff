#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/require.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "base/triangle_boxes.h"
#include "tetsoup/embed.h"

namespace tetsoup {
namespace {

using Edge = std::array<std::uint32_t, 2>;

constexpr double kReach = 0.25;      // Of the edge: a circle's arc of 90 degrees is farther from its chord.
constexpr double kLeastShare = 0.3;  // Of a tet's determinant with straight edges.
// What is too crooked is drawn back so far and so often; then its nodes go back into the middle, one after the other.
constexpr double kDrawnBack = 0.7;
constexpr int kTimes = 6;
constexpr std::int64_t kGrain = 64;  // edges
constexpr int kSteps = 3;            // The determinant is cubic: at these 20 places it is known everywhere.

std::vector<Edge> edges_of(const TetMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(6 * mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    for (const auto& [i, j] : kTetEdges) {
      const std::uint32_t a = tet[static_cast<std::size_t>(i)], b = tet[static_cast<std::size_t>(j)];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::size_t place_of(const std::vector<Edge>& edges, std::uint32_t a, std::uint32_t b) {
  const Edge wanted{std::min(a, b), std::max(a, b)};
  return static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), wanted) - edges.begin());
}

Vec3d nearest_point(const TriangleBoxes& boxes, const Vec3d& at) {
  const Vec3d p = boxes.to_unit(at);
  Vec3d nearest = p;
  double square = std::numeric_limits<double>::infinity();
  float bound = std::numeric_limits<float>::infinity();
  boxes.visit_near(to_float(p), bound, [&](std::uint32_t t) {
    const Vec3d there = closest_on_triangle(boxes.corners_in_unit(t), p);
    const double to_t = squared_length(p - there);
    if (to_t >= square) return;
    square = to_t;
    nearest = there;
    bound = TriangleBoxes::bound_above(square);
  });
  return at + (nearest - p) * (1 / boxes.scale());
}

/// From the middle of every edge of the boundary to the surface.
class SurfaceWays {
 public:
  SurfaceWays(const TetMesh& mesh, const std::vector<Edge>& edges, const TriangleSoup& soup, StageWatch& watch)
      : mesh_(mesh), edges_(edges), ways_(edges.size()) {
    const TriangleBoxes boxes(soup, watch);
    if (boxes.empty()) return;
    const Vec3d shift = mesh.origin - soup.origin;
    const std::vector<std::size_t> wanted = boundary_edges();
    parallel_for(static_cast<std::int64_t>(wanted.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const auto [a, b] = edges_[wanted[i]];
        const Vec3d middle = (at(a) + at(b)) * 0.5 + shift;
        const Vec3d way = nearest_point(boxes, middle) - middle;
        if (length(way) <= kReach * length(at(b) - at(a))) ways_[wanted[i]] = way;
      }
    });
  }

  std::vector<Vec3d>& ways() { return ways_; }
  std::vector<std::size_t> boundary_edges() const {
    std::vector<std::size_t> places;
    for (const Triangle& t : lone_faces(mesh_, sorted_faces(mesh_)))
      for (std::size_t i = 0; i < 3; ++i) places.push_back(place_of(edges_, t[i], t[(i + 1) % 3]));
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

 private:
  Vec3d at(std::uint32_t v) const { return to_double(mesh_.vertices[v]); }

  const TetMesh& mesh_;
  const std::vector<Edge>& edges_;
  std::vector<Vec3d> ways_;
};

/// Least determinant of the map from a straight tet over that of straight edges. @param middles  Of kTetEdges.
double least_determinant(const TetCorners& p, const std::array<Vec3d, 6>& middles) {
  const double straight = 6 * signed_volume(p);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      for (int k = 0; i + j + k <= kSteps; ++k) {
        const std::array<double, 4> w{static_cast<double>(kSteps - i - j - k) / kSteps, static_cast<double>(i) / kSteps,
                                      static_cast<double>(j) / kSteps, static_cast<double>(k) / kSteps};
        std::array<Vec3d, 4> by_weight;
        for (std::size_t c = 0; c < 4; ++c) by_weight[c] = p[c] * (4 * w[c] - 1);
        for (std::size_t e = 0; e < 6; ++e) {
          const auto a = static_cast<std::size_t>(kTetEdges[e][0]), b = static_cast<std::size_t>(kTetEdges[e][1]);
          by_weight[a] += middles[e] * (4 * w[b]);
          by_weight[b] += middles[e] * (4 * w[a]);
        }
        const Vec3d x = by_weight[1] - by_weight[0], y = by_weight[2] - by_weight[0], z = by_weight[3] - by_weight[0];
        least = std::min(least, dot(cross(x, y), z) / straight);
      }
    }
  }
  return least;
}

/// In tets that are too crooked the nodes that are farthest from the middle. @return  Whether there was one.
bool draw_back(const TetMesh& mesh, const std::vector<Edge>& edges, const std::vector<Vec3d>& middles, double to,
               std::vector<Vec3d>& ways) {
  std::vector<std::uint8_t> too_far(ways.size(), 0);
  for (const Tet& tet : mesh.tets) {
    std::array<std::size_t, 6> own{};
    std::array<Vec3d, 6> nodes;
    double longest = 0;
    for (std::size_t e = 0; e < 6; ++e) {
      own[e] = place_of(edges, tet[static_cast<std::size_t>(kTetEdges[e][0])],
                        tet[static_cast<std::size_t>(kTetEdges[e][1])]);
      nodes[e] = middles[own[e]] + ways[own[e]];
      longest = std::max(longest, length(ways[own[e]]));
    }
    if (longest == 0 || least_determinant(corners_of(mesh, tet), nodes) >= kLeastShare) continue;
    for (const std::size_t edge : own)
      if (length(ways[edge]) > longest / 2) too_far[edge] = 1;
  }
  bool any = false;
  for (std::size_t e = 0; e < ways.size(); ++e) {
    if (too_far[e] == 0) continue;
    ways[e] = ways[e] * to;
    any = true;
  }
  return any;
}

}  // namespace

Midsides place_midsides(const TetMesh& mesh, const TriangleSoup& soup, const Progress& progress) {
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t v : tet)
      require(v < mesh.vertices.size(), "vertex of a tet", v, "below the number of vertices");
  StageWatch watch(progress, "midsides");
  Midsides result;
  result.edges = edges_of(mesh);
  SurfaceWays surface(mesh, result.edges, soup, watch);
  std::vector<Vec3d>& ways = surface.ways();
  const std::vector<Vec3d> wanted = ways;
  std::vector<Vec3d> middles;
  for (const auto& [a, b] : result.edges)
    middles.push_back((to_double(mesh.vertices[a]) + to_double(mesh.vertices[b])) * 0.5);
  for (int round = 0; draw_back(mesh, result.edges, middles, round < kTimes ? kDrawnBack : 0, ways); ++round)
    watch.step(0.5);
  for (std::size_t e = 0; e < ways.size(); ++e) {
    result.places.push_back(to_float(middles[e] + ways[e]));
    if (!(ways[e] == Vec3d{})) ++result.moved;
    if (!(ways[e] == wanted[e])) ++result.held_back;
  }
  return result;
}

}  // namespace tetsoup
