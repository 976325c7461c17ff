#include "regions/label_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/groups.h"
#include "base/orientation.h"
#include "base/vec.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles

int sign_of(double x) {
  return (x > 0) - (x < 0);
}

/// On which side of the line from a to b, as seen along x, a point lies that is moved from p by nearly nothing along z
/// and far less along y: never on it, and the same for both triangles of an edge.
int side_of_line(const Vec3& a, const Vec3& b, const Vec3& p) {
  const int side = orientation(PlanePoint{a.y, a.z}, PlanePoint{b.y, b.z}, PlanePoint{p.y, p.z});
  if (side != 0) return side;
  return a.y != b.y ? (b.y > a.y ? 1 : -1) : sign_of(static_cast<double>(a.z) - static_cast<double>(b.z));
}

/// How a ray from p along x crosses the triangle: 1 or -1 by its winding, 0 where it does not. A point of the triangle
/// itself lies beyond it.
int crossing(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const int side = side_of_line(a, b, p);
  if (side == 0 || side_of_line(b, c, p) != side || side_of_line(c, a, p) != side) return 0;
  return orientation(a, b, c, p) * side < 0 ? side : 0;
}

/// Some triangles of a soup, with no other vertices than theirs.
TriangleSoup taken_out(const TriangleSoup& soup, std::span<const std::uint32_t> triangles) {
  TriangleSoup some;
  some.origin = soup.origin;
  for (const std::uint32_t t : triangles) {
    Triangle corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = soup.triangles[t][i];
      corners[i] = static_cast<std::uint32_t>(some.vertices.size());
      // Beyond the vertices stays beyond them: the part's own diagnosis drops it.
      constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
      some.vertices.push_back(v < soup.vertices.size() ? soup.vertices[v] : Vec3{kNowhere, kNowhere, kNowhere});
    }
    some.triangles.push_back(corners);
  }
  return some;
}

double volume_of(const Box3& box) {
  const Vec3d size = box.hi - box.lo;
  return size.x * size.y * size.z;
}

}  // namespace

LabelPlaces::LabelPlaces(const TriangleSoup& soup, std::span<const std::uint32_t> labels, StageWatch& watch) {
  soup_.origin = soup.origin;
  std::vector<std::uint32_t> names(labels.begin(), labels.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const Groups<std::uint32_t> by_label(names.size(), [&](const auto& put) {
    for (std::uint32_t t = 0; t < labels.size(); ++t) {
      const auto place = std::lower_bound(names.begin(), names.end(), labels[t]) - names.begin();
      put(static_cast<std::size_t>(place), t);
    }
  });
  for (std::size_t i = 0; i < names.size(); ++i) add(soup, by_label[i], names[i], watch);
  if (soup_.triangles.empty()) return;
  hierarchy_ = make_box_hierarchy(
      soup_.triangles.size(), kLeaf, box_of(soup_.vertices),
      [&](std::size_t t) { return triangle_box(soup_.vertices, soup_.triangles[t]); }, watch);
  boxes_.emplace(soup_, watch);
}

void LabelPlaces::add(const TriangleSoup& soup, std::span<const std::uint32_t> triangles, std::uint32_t label,
                      StageWatch& watch) {
  const auto goes_on = [&](std::string_view, double) {
    watch.poll();
    return !watch.stopped();
  };
  const CleanSoup clean = clean_soup(taken_out(soup, triangles), goes_on);
  const auto first_part = static_cast<std::uint32_t>(parts_.size());
  const auto first_vertex = static_cast<std::uint32_t>(soup_.vertices.size());
  for (const SoupPart& part : clean.parts.parts) {
    const double volume = part.oriented ? std::abs(part.volume) : volume_of(part.box);
    parts_.push_back({label, part.sound, part.oriented, volume});
    (part.sound ? has_closed_ : has_open_) = true;
  }
  soup_.vertices.insert(soup_.vertices.end(), clean.soup.vertices.begin(), clean.soup.vertices.end());
  for (std::size_t t = 0; t < clean.soup.triangles.size(); ++t) {
    const auto [a, b, c] = clean.soup.triangles[t];
    soup_.triangles.push_back({a + first_vertex, b + first_vertex, c + first_vertex});
    of_triangle_.push_back(clean.parts.part_of_triangle[t] + first_part);
    turns_.push_back(clean.parts.turned[t] != 0 ? -1 : 1);
  }
}

std::uint32_t LabelPlaces::at(const Vec3d& place) const {
  if (empty()) return 0;
  std::optional<std::uint32_t> around;
  if (has_closed_) around = innermost(to_float(place));
  if (around && !has_open_) return *around;
  const std::uint32_t triangle = nearest(place).triangle;
  return around && parts_[of_triangle_[triangle]].sound ? *around : label_of(triangle);
}

std::optional<std::uint32_t> LabelPlaces::innermost(const Vec3& p) const {
  std::vector<Hit> hits;
  std::array<std::uint32_t, BoxHierarchy::kMaxDepth + 1> waiting{};
  std::size_t count = 1;  // of those that wait: the root
  while (count > 0) {
    const std::uint32_t at = waiting[--count];
    const BoxHierarchy::Node& node = hierarchy_.nodes[at];
    if (p.x > node.hi.x || p.y < node.lo.y || p.y > node.hi.y || p.z < node.lo.z || p.z > node.hi.z) continue;
    if (node.count == 0) {
      waiting[count++] = node.next;
      waiting[count++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
      const std::uint32_t t = hierarchy_.order[i];
      if (!parts_[of_triangle_[t]].sound) continue;
      const auto [a, b, c] = soup_.triangles[t];
      const int sign = crossing(soup_.vertices[a], soup_.vertices[b], soup_.vertices[c], p);
      if (sign != 0) hits.push_back({of_triangle_[t], sign * turns_[t]});
    }
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.part < b.part; });
  return innermost_of(hits);
}

/// A label holds what the windings of its oriented parts together, or the crossings of another one, say is inside; it
/// is as deep as the smallest of its parts around. Hits ascend by part.
std::optional<std::uint32_t> LabelPlaces::innermost_of(std::span<const Hit> hits) const {
  std::optional<std::uint32_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hits.size();) {
    const std::uint32_t label = parts_[hits[i].part].label;
    int all = 0;
    bool odd = false;
    double smallest = std::numeric_limits<double>::infinity();
    while (i < hits.size() && parts_[hits[i].part].label == label) {
      const std::uint32_t part = hits[i].part;
      int winding = 0, crossings = 0;
      for (; i < hits.size() && hits[i].part == part; ++i) winding += hits[i].sign, ++crossings;
      const bool oriented = parts_[part].oriented, around = oriented ? winding != 0 : crossings % 2 != 0;
      if (oriented) all += winding;
      odd = odd || (!oriented && around);
      if (around) smallest = std::min(smallest, parts_[part].volume);
    }
    if ((all == 0 && !odd) || smallest >= least) continue;
    least = smallest;
    best = label;
  }
  return best;
}

LabelPlaces::Nearest LabelPlaces::nearest(const Vec3d& place) const {
  const Vec3d p = boxes_->to_unit(place);
  Nearest found{boxes_->any(), std::numeric_limits<double>::infinity()};
  float bound = std::numeric_limits<float>::infinity();
  boxes_->visit_near(to_float(p), bound, [&](std::uint32_t t) {
    const double square = squared_length(p - closest_on_triangle(boxes_->corners_in_unit(t), p));
    // Parts lie in the order of their labels: of equally near triangles the lowest label counts.
    if (square > found.square || (square == found.square && t >= found.triangle)) return;
    found = {t, square};
    bound = TriangleBoxes::bound_above(square);
  });
  return found;
}

bool LabelPlaces::is_clear(const Vec3d& place, double radius) const {
  if (has_open_ || empty()) return empty();
  const Vec3d p = boxes_->to_unit(place);
  const double reach = radius * boxes_->scale();
  bool clear = true;
  float bound = TriangleBoxes::bound_above(reach * reach);
  boxes_->visit_near(to_float(p), bound, [&](std::uint32_t t) {
    if (squared_length(p - closest_on_triangle(boxes_->corners_in_unit(t), p)) > reach * reach) return;
    clear = false;
    bound = -1;
  });
  return clear;
}

std::optional<Vec3d> LabelPlaces::normal_near(const Vec3d& place) const {
  const std::array<Vec3d, 3> p = boxes_->corners_in_unit(nearest(place).triangle);
  const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
  const double size = length(normal);
  if (!(size > 0)) return std::nullopt;
  return normal * (1 / size);
}

}  // namespace tetsoup
