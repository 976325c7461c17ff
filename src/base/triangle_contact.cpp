#include "base/triangle_contact.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "base/orientation.h"
#include "base/triangle_boxes.h"
#include "base/vec.h"

namespace tetsoup {
namespace {

using Signs = std::array<int, 3>;

/// Of the corners, seen from the plane of `triangle`.
Signs sides_of(const TriangleCorners& triangle, const TriangleCorners& corners) {
  const auto& [a, b, c] = triangle;
  return {orientation(a, b, c, corners[0]), orientation(a, b, c, corners[1]), orientation(a, b, c, corners[2])};
}
bool all_beyond(const Signs& s) {
  return s[0] != 0 && s[0] == s[1] && s[0] == s[2];
}
bool all_zero(const Signs& s) {
  return s[0] == 0 && s[1] == 0 && s[2] == 0;
}

/// Without the coordinate `axis`.
PlanePoint flat(const Vec3& p, int axis) {
  return axis == 0 ? PlanePoint{p.y, p.z} : axis == 1 ? PlanePoint{p.z, p.x} : PlanePoint{p.x, p.y};
}

/// An axis along which the triangle is seen with an area; 3 where it has none.
int axis_with_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  int axis = 0;
  while (axis < 3 && orientation(flat(a, axis), flat(b, axis), flat(c, axis)) == 0) ++axis;
  return axis;
}

bool boxes_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const auto meet = [](float a, float b, float c, float d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
  };
  return meet(p.x, q.x, r.x, s.x) && meet(p.y, q.y, r.y, s.y) && meet(p.z, q.z, r.z, s.z);
}

/// Segments in one plane, seen along an axis along which it has an area.
bool segments_meet_in_plane(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, int axis) {
  const PlanePoint a = flat(p, axis), b = flat(q, axis), c = flat(r, axis), d = flat(s, axis);
  const int of_c = orientation(a, b, c), of_d = orientation(a, b, d);
  const int of_a = orientation(c, d, a), of_b = orientation(c, d, b);
  if (of_c * of_d > 0 || of_a * of_b > 0) return false;
  return boxes_meet(p, q, r, s);  // decides where all are on one line, and holds where they cross
}

bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  if (!boxes_meet(p, q, r, s) || orientation(p, q, r, s) != 0) return false;
  for (const auto& [a, b, c] : {std::tuple{p, q, r}, std::tuple{p, q, s}, std::tuple{r, s, p}, std::tuple{r, s, q}}) {
    const int axis = axis_with_area(a, b, c);
    if (axis < 3) return segments_meet_in_plane(p, q, r, s, axis);
  }
  return true;  // on one line, where the boxes decide
}

/// A point of the triangle's plane lies in it, seen along `axis`.
bool holds(const TriangleCorners& triangle, const Vec3& p, int axis) {
  const PlanePoint a = flat(triangle[0], axis), b = flat(triangle[1], axis), c = flat(triangle[2], axis),
                   at = flat(p, axis);
  const int ab = orientation(a, b, at), bc = orientation(b, c, at), ca = orientation(c, a, at);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// The segment's ends lie on different sides of the triangle's plane, or one in it.
bool line_hits(const Vec3& p, const Vec3& q, const TriangleCorners& triangle) {
  const auto& [a, b, c] = triangle;
  const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool meet_in_plane(const Vec3& p, const Vec3& q, const TriangleCorners& triangle, int axis) {
  if (holds(triangle, p, axis)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (segments_meet_in_plane(p, q, triangle[i], triangle[(i + 1) % 3], axis)) return true;
  return false;
}

bool segment_meets(const Vec3& p, const Vec3& q, const TriangleCorners& triangle, int axis) {
  const auto& [a, b, c] = triangle;
  const int of_p = orientation(a, b, c, p), of_q = orientation(a, b, c, q);
  if (of_p * of_q > 0) return false;
  if (of_p == 0 && of_q == 0) return meet_in_plane(p, q, triangle, axis);
  return line_hits(p, q, triangle);
}

/// The ends of a triangle that is a segment or a point.
std::pair<Vec3, Vec3> ends_of(const TriangleCorners& triangle) {
  const auto before = [](const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); };
  return {*std::min_element(triangle.begin(), triangle.end(), before),
          *std::max_element(triangle.begin(), triangle.end(), before)};
}

/// An edge of one goes through the other, whose plane is another. What lies in that plane needs no question: where such
/// an edge meets the other triangle, an end of it does, or an edge of that one goes through this.
bool edge_goes_through(const TriangleCorners& from, const Signs& sides, const TriangleCorners& through) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (sides[i] * sides[j] > 0 || (sides[i] == 0 && sides[j] == 0)) continue;
    if (line_hits(from[i], from[j], through)) return true;
  }
  return false;
}

double segment_square(const Vec3d& p, const Vec3d& q, const Vec3d& r, const Vec3d& s) {
  const Vec3d u = q - p, v = s - r, w = p - r;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  const double area = uu * vv - uv * uv;
  double along_u = area > 0 ? std::clamp((uv * vw - uw * vv) / area, 0.0, 1.0) : 0;
  const double along_v = vv > 0 ? std::clamp((uv * along_u + vw) / vv, 0.0, 1.0) : 0;
  along_u = uu > 0 ? std::clamp((uv * along_v - uw) / uu, 0.0, 1.0) : 0;
  return squared_length(w + u * along_u - v * along_v);
}

}  // namespace

bool triangles_meet(const TriangleCorners& a, const TriangleCorners& b) {
  const Signs of_a = sides_of(b, a);
  if (all_beyond(of_a)) return false;
  const Signs of_b = sides_of(a, b);
  if (all_beyond(of_b)) return false;
  if (!all_zero(of_a) && !all_zero(of_b)) return edge_goes_through(a, of_a, b) || edge_goes_through(b, of_b, a);
  const int axis_a = axis_with_area(a[0], a[1], a[2]), axis_b = axis_with_area(b[0], b[1], b[2]);
  if (axis_a < 3 && axis_b < 3) {
    for (std::size_t i = 0; i < 3; ++i)
      if (meet_in_plane(a[i], a[(i + 1) % 3], b, axis_b)) return true;
    return holds(a, b[0], axis_b);
  }
  const auto [p, q] = ends_of(a);
  const auto [r, s] = ends_of(b);
  if (axis_b < 3) return segment_meets(p, q, b, axis_b);
  if (axis_a < 3) return segment_meets(r, s, a, axis_a);
  return segments_meet(p, q, r, s);
}

double squared_distance(const TriangleCorners& a, const TriangleCorners& b) {
  std::array<Vec3d, 3> p, q;
  for (std::size_t i = 0; i < 3; ++i) p[i] = to_double(a[i]), q[i] = to_double(b[i]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, squared_length(p[i] - closest_on_triangle(q, p[i])));
    least = std::min(least, squared_length(q[i] - closest_on_triangle(p, q[i])));
    for (std::size_t j = 0; j < 3; ++j)
      least = std::min(least, segment_square(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]));
  }
  return least;
}

bool crosses_ahead(const TriangleCorners& triangle, const Vec3& p) {
  // As if p lay a little lower in y, and higher in z by much less.
  bool inside = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 *low = &triangle[i], *high = &triangle[(i + 1) % 3];
    if ((low->z > p.z) == (high->z > p.z)) continue;
    if (low->z > high->z) std::swap(low, high);
    if (orientation(flat(*low, 0), flat(*high, 0), flat(p, 0)) >= 0) inside = !inside;
  }
  if (!inside) return false;
  const auto& [a, b, c] = triangle;
  const int turn = orientation(flat(a, 0), flat(b, 0), flat(c, 0));  // the plane's normal leads along x
  return orientation(a, b, c, p) * turn < 0;
}

}  // namespace tetsoup
