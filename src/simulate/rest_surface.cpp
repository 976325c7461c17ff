#include "simulate/rest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/tet_faces.h"
#include "base/vec.h"

namespace tetsoup::simulate {
namespace {

using Weights = std::array<double, 3>;

/// What rounding to float may change a length by.
constexpr double kRounded = 1 + 1e-5;

Weights nearest_on_edge(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d edge = b - a;
  const double square = squared_length(edge);
  const double t = square > 0 ? std::clamp(dot(p - a, edge) / square, 0.0, 1.0) : 0;
  return {1 - t, t, 0};
}

Vec3d at(const std::array<Vec3d, 3>& corners, const Weights& w) {
  return corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
}

/// Within the triangle if the foot of p lies there, else on the nearest of its edges.
Weights nearest_on_triangle(const Vec3d& p, const std::array<Vec3d, 3>& c) {
  const Vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
  const double square = squared_length(normal);
  Weights w{};
  if (square > 0) {
    for (std::size_t i = 0; i < 3; ++i) w[i] = dot(cross(c[(i + 1) % 3] - p, c[(i + 2) % 3] - p), normal) / square;
    if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) return w;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Weights along = nearest_on_edge(p, c[i], c[j]);
    Weights candidate{};
    candidate[i] = along[0];
    candidate[j] = along[1];
    const double distance = squared_length(at(c, candidate) - p);
    if (!(distance < least)) continue;
    least = distance;
    w = candidate;
  }
  return w;
}

std::array<Vec3d, 3> corners_of_triangle(const RestSurface& surface, const Piece& piece, std::size_t t) {
  const Triangle& triangle = surface.triangles[t];
  return {piece.places[triangle[0]], piece.places[triangle[1]], piece.places[triangle[2]]};
}

double distance_to(const RestSurface& surface, const Piece& piece, std::size_t t, const Vec3d& p) {
  const std::array<Vec3d, 3> corners = corners_of_triangle(surface, piece, t);
  return length(at(corners, nearest_on_triangle(p, corners)) - p);
}

/// With their distances, ascending.
std::vector<std::pair<double, std::uint32_t>> triangles_within(const RestSurface& surface, const Piece& piece,
                                                               const Vec3d& p, double reach) {
  std::vector<kernel::PointInBox> boxes;
  const kernel::NumberedPoint point{to_float(p), 0, {}};
  kernel::find_boxes_around(surface.boxes, std::span(&point, 1), static_cast<float>(reach * kRounded), {}, boxes);
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const kernel::PointInBox& b : boxes) {
    const Ball& ball = surface.balls[b.box];
    if (length(p - ball.centre) > (reach + ball.radius) * kRounded) continue;
    const double distance = distance_to(surface, piece, b.box, p);
    if (distance <= reach) found.emplace_back(distance, b.box);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Vec3d middle_of(const TetCorners& p) {
  return (p[0] + p[1] + p[2] + p[3]) * 0.25;
}

/// Orders items so that every aligned group of the tree, on every level, is near in space: halves across the longest
/// side, down to a group. The boxes around such groups overlap less than those along a curve.
void halve(std::span<std::uint32_t> items, const std::vector<Vec3d>& middles) {
  if (items.size() <= kernel::kBoxGroup) return;
  Vec3d lo = middles[items[0]], hi = lo;
  for (const std::uint32_t i : items) {
    lo = min(lo, middles[i]);
    hi = max(hi, middles[i]);
  }
  const Vec3d size = hi - lo;
  const auto along = [&](std::uint32_t i) {
    const Vec3d& m = middles[i];
    return size.x >= size.y && size.x >= size.z ? m.x : size.y >= size.z ? m.y : m.z;
  };
  std::size_t group = kernel::kBoxGroup;
  while (group * kernel::kBoxGroup < items.size()) group *= kernel::kBoxGroup;
  const std::size_t half = std::max<std::size_t>(1, items.size() / group / 2) * group;
  const auto middle = items.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(items.begin(), middle, items.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return std::pair(along(i), i) < std::pair(along(j), j); });
  halve(items.first(half), middles);
  halve(items.subspan(half), middles);
}

void order_tets(RestSurface& surface, const Piece& piece) {
  std::vector<Vec3d> middles;
  for (const Tet& tet : piece.tets) middles.push_back(middle_of(corners_at(piece.places, tet)));
  surface.tet_order.resize(middles.size());
  std::iota(surface.tet_order.begin(), surface.tet_order.end(), 0U);
  halve(surface.tet_order, middles);
  surface.middles.resize((middles.size() + kernel::kBoxGroup - 1) / kernel::kBoxGroup);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const auto [x, y, z] = to_float(middles[surface.tet_order[i]]);
    kernel::MiddleGroup& group = surface.middles[i / kernel::kBoxGroup];
    const std::size_t place = i % kernel::kBoxGroup;
    group.at[0][place] = x, group.at[1][place] = y, group.at[2][place] = z;
  }
}

/// Edges that can get into another body with both ends outside: where it is flat or hollow, a body meets others with
/// its vertices, or with theirs.
void find_sharp_edges(RestSurface& surface, const Piece& piece) {
  constexpr double kFlat = 0.7;  // cosine of 45 degrees
  struct Side {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t triangle, opposite;
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Triangle& c = surface.triangles[t];
      const std::uint32_t a = c[i], b = c[(i + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t, c[(i + 2) % 3]});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::pair(a.ends, a.triangle) < std::pair(b.ends, b.triangle); });
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    if (a.ends != b.ends || (!surface.sharp_edges.empty() && surface.sharp_edges.back() == a.ends)) continue;
    const Vec3d& normal = surface.normals[a.triangle];
    const bool is_ridge = dot(piece.places[b.opposite] - piece.places[a.ends[0]], normal) < 0;
    if (is_ridge && dot(normal, surface.normals[b.triangle]) < kFlat) surface.sharp_edges.push_back(a.ends);
  }
}

void fit_triangle_boxes(RestSurface& surface, const Piece& piece) {
  surface.boxes = kernel::make_box_tree(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = corners_of_triangle(surface, piece, t);
    kernel::set_box(surface.boxes, t, to_float(min(a, min(b, c))), to_float(max(a, max(b, c))));
  }
  kernel::fit_upper_levels(surface.boxes);
}

}  // namespace

RestSurface make_rest_surface(const Piece& piece) {
  TetMesh topology;
  topology.vertices.resize(piece.places.size());
  topology.tets = piece.tets;
  const std::vector<TetFace> faces = sorted_faces(topology);
  RestSurface surface;
  surface.triangles = lone_faces(topology, faces);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = corners_of_triangle(surface, piece, t);
    const Vec3d normal = cross(b - a, c - a);
    const double size = length(normal);
    surface.normals.push_back(size > 0 ? normal * (1 / size) : Vec3d{});
    const Vec3d centre = (a + b + c) * (1.0 / 3);
    surface.balls.push_back({centre, std::sqrt(std::max({squared_length(a - centre), squared_length(b - centre),
                                                         squared_length(c - centre)}))});
  }
  fit_triangle_boxes(surface, piece);
  find_sharp_edges(surface, piece);
  surface.open_faces.assign(piece.tets.size(), 0);
  for (std::size_t begin = 0; begin < faces.size();) {
    const std::size_t end = face_run_end(faces, begin);
    if (end - begin == 1)
      surface.open_faces[faces[begin].slot / 4] |= static_cast<std::uint8_t>(1U << faces[begin].slot % 4);
    begin = end;
  }
  for (const Triangle& t : surface.triangles) surface.vertices.insert(surface.vertices.end(), t.begin(), t.end());
  std::sort(surface.vertices.begin(), surface.vertices.end());
  surface.vertices.erase(std::unique(surface.vertices.begin(), surface.vertices.end()), surface.vertices.end());
  surface.near.resize(piece.tets.size());
  order_tets(surface, piece);
  return surface;
}

void find_near_triangles(RestSurface& surface, const Piece& piece, std::uint32_t tet) {
  if (!surface.near[tet].triangles.empty()) return;
  const TetCorners p = corners_at(piece.places, piece.tets[tet]);
  const Vec3d middle = middle_of(p);
  double radius = 0;
  for (const Vec3d& corner : p) radius = std::max(radius, 1.5 * length(corner - middle));
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::uint32_t>> found;
  // Distance is 1-Lipschitz: what is nearest somewhere in the ball is at most so much farther from its middle; what
  // faces some way counts up to a mean edge from the ball. How far the nearest is, is not known at first, nor in the
  // middle of a large piece after one look.
  for (double reach = radius + piece.mean_edge;; reach = found.empty() ? 2 * reach : least + 2 * radius) {
    found = triangles_within(surface, piece, middle, reach);
    if (!found.empty()) least = found.front().first;
    if (reach >= least + 2 * radius) break;
  }
  const double farthest = std::max(least + 2 * radius, radius + piece.mean_edge);
  NearTriangles& near = surface.near[tet];
  near.middle = middle;
  for (const auto& [distance, triangle] : found) {
    if (distance > farthest) break;
    near.triangles.push_back(triangle);
    near.distances.push_back(distance);
  }
}

SurfacePoint nearest_surface_point(const RestSurface& surface, const Piece& piece, std::uint32_t tet, const Vec3d& p,
                                   const std::optional<Vec3d>& facing) {
  constexpr double kSameSide = 0.5;  // cosine
  SurfacePoint nearest;
  double least = facing ? piece.mean_edge * piece.mean_edge : std::numeric_limits<double>::infinity();
  bool found = false;
  const NearTriangles& near = surface.near[tet];
  const double from_middle = length(p - near.middle);
  for (std::size_t i = 0; i < near.triangles.size(); ++i) {
    // Distance is 1-Lipschitz: from here on all are farther.
    const double at_least = near.distances[i] - from_middle;
    if (at_least > 0 && at_least * at_least >= least) break;
    const std::uint32_t t = near.triangles[i];
    if (facing && dot(surface.normals[t], *facing) < kSameSide) continue;
    const std::array<Vec3d, 3> corners = corners_of_triangle(surface, piece, t);
    const double to_plane = dot(p - corners[0], surface.normals[t]);
    if (to_plane * to_plane >= least) continue;
    const double to_ball = length(p - surface.balls[t].centre) - surface.balls[t].radius;
    if (to_ball > 0 && to_ball * to_ball >= least) continue;
    const Weights w = nearest_on_triangle(p, corners);
    const double distance = squared_length(at(corners, w) - p);
    if (!(distance < least)) continue;
    least = distance;
    nearest = {t, w};
    found = true;
  }
  return found || !facing ? nearest : nearest_surface_point(surface, piece, tet, p, {});
}

}  // namespace tetsoup::simulate
