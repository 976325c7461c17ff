#include "smooth/soup_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/triangle_boxes.h"
#include "smooth/facets.h"

namespace tetsoup {

namespace {

// In mean edges.
constexpr double kSpacing = 0.3;
constexpr double kReach = 0.75;       // A point that is farther from the boundary at the start has no part in it.
constexpr double kAllowed = 0.25;     // So far the boundary may draw back from a point.
constexpr std::int64_t kGrain = 256;  // points
constexpr std::size_t kTrianglesPerPoll = 1024;
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// One point of the soup for every cube of a box that it comes to: the first found.
class Thinning {
 public:
  Thinning(const Box3& box, double size) : box_(box), size_(size) {
    const Vec3d e = box.hi - box.lo;
    const auto cells = [&](double l) { return static_cast<std::size_t>(l / size) + 1; };
    count_ = {cells(e.x), cells(e.y), cells(e.z)};
    taken_.assign(count_[0] * count_[1] * count_[2], false);
  }

  double size() const { return size_; }
  bool meets(const Vec3d& lo, const Vec3d& hi) const {
    return lo.x <= box_.hi.x && lo.y <= box_.hi.y && lo.z <= box_.hi.z && hi.x >= box_.lo.x && hi.y >= box_.lo.y &&
           hi.z >= box_.lo.z;
  }

  void add(const Vec3d& p) {
    if (!meets(p, p)) return;
    const auto along = [&](double way, std::size_t count) {
      return std::min(static_cast<std::size_t>(way / size_), count - 1);
    };
    const std::size_t x = along(p.x - box_.lo.x, count_[0]), y = along(p.y - box_.lo.y, count_[1]),
                      z = along(p.z - box_.lo.z, count_[2]), cell = (z * count_[1] + y) * count_[0] + x;
    if (taken_[cell]) return;
    taken_[cell] = true;
    points.push_back(p);
  }

  std::vector<Vec3d> points;

 private:
  Box3 box_;
  double size_;
  std::array<std::size_t, 3> count_{};
  std::vector<bool> taken_;
};

/// Points of a triangle. One that is far larger than the box is halved, so that what lies beyond the box costs nothing.
void add_inside(const TriangleCorners& p, Thinning& thinning) {
  constexpr double kMostSteps = 1024;
  if (!thinning.meets(min(min(p[0], p[1]), p[2]), max(max(p[0], p[1]), p[2]))) return;
  const std::array<double, 3> sides{squared_length(p[1] - p[0]), squared_length(p[2] - p[1]),
                                    squared_length(p[0] - p[2])};
  const auto side = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const double longest = std::sqrt(sides[side]);
  if (longest <= thinning.size()) return;
  const double wanted = std::ceil(longest / thinning.size());
  if (wanted > kMostSteps) {
    const Vec3d &a = p[side], &b = p[(side + 1) % 3], &c = p[(side + 2) % 3], middle = (a + b) * 0.5;
    add_inside({a, middle, c}, thinning);
    add_inside({middle, b, c}, thinning);
    return;
  }
  const auto steps = static_cast<int>(wanted);
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      thinning.add(p[0] + (p[1] - p[0]) * u + (p[2] - p[0]) * v);
    }
  }
}

/// Weights of the corners for a point of the triangle.
std::array<double, 3> weights_of(const TriangleCorners& t, const Vec3d& p) {
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  const double area = squared_length(normal);
  if (!(area > 0)) return {1, 0, 0};
  const double b = dot(cross(p - t[0], t[2] - t[0]), normal) / area,
               c = dot(cross(t[1] - t[0], p - t[0]), normal) / area;
  return {1 - b - c, b, c};
}

/// From the triangle to whichever of those around its corners is nearer, until none is or one is near enough.
std::uint32_t walk_to_nearest(const Connectivity& links, const TetMesh& mesh, std::uint32_t start, const Vec3d& p,
                              double enough, Vec3d& nearest) {
  nearest = closest_on_triangle(corners_at(mesh, links.triangles[start]), p);
  double least = squared_length(nearest - p);
  if (least <= enough * enough) return start;
  for (std::uint32_t best = start;; start = best) {
    for (const std::uint32_t v : links.triangles[start]) {
      for (const std::uint32_t t : links.boundary_triangles[v]) {
        const Vec3d q = closest_on_triangle(corners_at(mesh, links.triangles[t]), p);
        if (const double square = squared_length(q - p); square < least) least = square, nearest = q, best = t;
      }
    }
    if (best == start) return best;
  }
}

}  // namespace

SoupPoints::SoupPoints(const TriangleSoup& soup, const Connectivity& links, const TetMesh& mesh, double edge,
                       StageWatch& watch)
    : edge_(edge) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const std::uint32_t v : links.boundary) {
    const Vec3d p = to_double(mesh.vertices[v]);
    box = {min(box.lo, p), max(box.hi, p)};
  }
  const Vec3d reach = Vec3d{1, 1, 1} * (kReach * edge);
  Thinning thinning({box.lo - reach, box.hi + reach}, kSpacing * edge);
  for (const Vec3& v : soup.vertices) thinning.add(to_double(v));
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    if (i % kTrianglesPerPoll == 0) watch.poll();
    const auto corner = [&](std::size_t k) { return to_double(soup.vertices[soup.triangles[i][k]]); };
    add_inside({corner(0), corner(1), corner(2)}, thinning);
  }
  watch.throw_if_stopped();
  for (const Vec3d& p : thinning.points) points_.push_back({p, kNone});
  find_nearest(links, mesh, watch);
}

void SoupPoints::find_nearest(const Connectivity& links, const TetMesh& mesh, StageWatch& watch) {
  const TriangleSoup boundary{mesh.vertices, links.triangles};
  const TriangleBoxes boxes(boundary, watch);
  const double reach = kReach * edge_ * boxes.scale();
  parallel_for(static_cast<std::int64_t>(points_.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3d p = boxes.to_unit(points_[i].at);
      double least = reach * reach;
      float bound = TriangleBoxes::bound_above(least);
      boxes.visit_near(to_float(p), bound, [&](std::uint32_t t) {
        const double square = squared_length(closest_on_triangle(boxes.corners_in_unit(t), p) - p);
        if (square > least || (square == least && t >= points_[i].triangle)) return;
        least = square, bound = TriangleBoxes::bound_above(least), points_[i].triangle = t;
      });
    }
  });
  std::erase_if(points_, [](const Point& point) { return point.triangle == kNone; });
}

Groups<Pull> SoupPoints::pulls(const Connectivity& links, const TetMesh& mesh, std::span<const Vec3d> normals,
                               StageWatch& watch) {
  const double allowed = kAllowed * edge_;
  std::vector<Pull> found(points_.size());
  parallel_for(static_cast<std::int64_t>(points_.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      Point& point = points_[i];
      Vec3d nearest;
      point.triangle = walk_to_nearest(links, mesh, point.triangle, point.at, allowed, nearest);
      const Vec3d way = point.at - nearest;
      const double distance = length(way);
      if (!(distance > allowed)) continue;
      const Triangle& t = links.triangles[point.triangle];
      const auto weights = weights_of(corners_at(mesh, t), nearest);
      Vec3d outwards;
      for (std::size_t k = 0; k < 3; ++k) outwards += normals[t[k]] * weights[k];
      if (!(dot(outwards, way) > 0)) continue;  // it lies inside
      const Vec3d normal = way * (1 / distance);
      found[i] = {weights, normal, dot(normal, point.at) - allowed};
    }
  });
  return Groups<Pull>(links.triangles.size(), [&](const auto& put) {
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!(found[i].normal == Vec3d{})) put(points_[i].triangle, found[i]);
  });
}

}  // namespace tetsoup
