#include "lattice/flat_sides.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/elementary.h"
#include "base/soup_planes.h"

namespace tetsoup {

namespace {

constexpr double kSameWay = 0.9993, kAcross = 0.026;  // Cosines: within 2 degrees, and within 1.5 of a right angle.
constexpr double kUpright = 0.9998;                   // Within a degree of the soup's own axes a lattice is not turned.
constexpr double kLeastShare = 0.5;                   // Of the soup's area in planes along the axes.
constexpr double kLeastSide = 0.05;   // Of the area of an axis' planes: less is no side worth a cell's end.
constexpr double kMostStretch = 1.3;  // Longest over shortest edge of a cell,
constexpr double kLeastLayer = 0.41;  // but a layer of one cell may be so thin: its tets keep the limits of smoothing.
constexpr double kStep = 0.01, kLeastSize = -0.7, kMostSize = 1.5;  // Of the cell size searched through, logarithms.
constexpr double kOfStretch = 0.5;  // What a stretch counts beside planes that no cell ends at.

struct Direction {
  Vec3d normal;
  double area = 0;
};

/// Directions that planes face, by area.
std::vector<Direction> directions_of(const std::vector<SoupPlane>& planes) {
  std::vector<Direction> directions;
  for (const SoupPlane& plane : planes) {
    const auto same = std::find_if(directions.begin(), directions.end(), [&](const Direction& d) {
      return std::abs(dot(d.normal, plane.normal)) > kSameWay;
    });
    if (same == directions.end()) {
      directions.push_back({plane.normal, plane.area});
    } else {
      same->area += plane.area;
    }
  }
  std::stable_sort(directions.begin(), directions.end(),
                   [](const Direction& a, const Direction& b) { return a.area > b.area; });
  return directions;
}

double component(const Vec3d& v, std::size_t i) {
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

/// The three axes, each where it is nearest to the soup's own, right-handed.
std::array<Vec3d, 3> sorted_axes(std::array<Vec3d, 3> axes) {
  std::array<Vec3d, 3> sorted;
  std::array<bool, 3> used{};
  for (std::size_t i = 0; i < 2; ++i) {
    std::size_t best = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      if (used[k]) continue;
      if (best == 3 || std::abs(component(axes[k], i)) > std::abs(component(axes[best], i))) best = k;
    }
    used[best] = true;
    sorted[i] = axes[best] * (component(axes[best], i) < 0 ? -1 : 1);
  }
  sorted[2] = cross(sorted[0], sorted[1]);
  return sorted;
}

Vec3d angles_of(const std::array<Vec3d, 3>& axes) {
  const auto& [x, y, z] = axes;
  if (x.x > kUpright && y.y > kUpright && z.z > kUpright) return {};
  return {elementary::atan2(y.z, z.z), elementary::asin(std::clamp(-x.z, -1.0, 1.0)), elementary::atan2(x.y, x.x)};
}

/// At a right angle to `first`: what most of the area faces that is too narrow for planes, as the rim of a plate does.
std::optional<Vec3d> rim_of(const TriangleSoup& soup, const Vec3d& first) {
  constexpr double kSteps = 64;  // a unit vector's components are rounded to
  std::map<std::array<int, 3>, Vec3d> rims;
  for (const Triangle& t : soup.triangles) {
    const Vec3d a = to_double(soup.vertices[t[0]]);
    Vec3d n = cross(to_double(soup.vertices[t[1]]) - a, to_double(soup.vertices[t[2]]) - a);
    const double size = length(n);
    if (!(size > 0) || std::abs(dot(n, first)) > kAcross * size) continue;
    const auto step = [&](double c) { return static_cast<int>(std::floor(c / size * kSteps + 0.5)); };
    std::array<int, 3> key{step(n.x), step(n.y), step(n.z)}, other{step(-n.x), step(-n.y), step(-n.z)};
    if (other < key) key = other, n = n * -1;
    rims[key] += n;
  }
  const auto larger = [](const auto& a, const auto& b) { return squared_length(a.second) < squared_length(b.second); };
  const auto most = std::max_element(rims.begin(), rims.end(), larger);
  if (most == rims.end() || !(length(most->second) > 0)) return {};
  return most->second;
}

FlatSides::Axis axis_along(const Vec3d& direction, const std::vector<SoupPlane>& planes, const TriangleSoup& soup) {
  FlatSides::Axis axis{direction, 0, 0, {}};
  double area = 0, own = 0;
  for (const SoupPlane& plane : planes) {
    area += plane.area;
    if (std::abs(dot(plane.normal, direction)) > kSameWay) own += plane.area;
  }
  for (const SoupPlane& plane : planes) {
    const double along = dot(plane.normal, direction);
    if (std::abs(along) > kSameWay && plane.area >= kLeastSide * own) {
      axis.sides.push_back({along < 0 ? -plane.offset : plane.offset, plane.area / area});
    }
  }
  std::stable_sort(axis.sides.begin(), axis.sides.end(),
                   [](const auto& a, const auto& b) { return a.offset < b.offset; });
  if (axis.sides.size() > 1) {
    axis.lo = axis.sides.front().offset, axis.hi = axis.sides.back().offset;
    return axis;
  }
  axis.lo = 1e300, axis.hi = -1e300;
  for (const Triangle& t : soup.triangles) {
    for (const std::uint32_t v : t) {
      const double along = dot(direction, to_double(soup.vertices[v]));
      axis.lo = std::min(axis.lo, along), axis.hi = std::max(axis.hi, along);
    }
  }
  return axis;
}

/// Cells of one size, and what is known of them on the way to a place.
struct Cells {
  std::array<double, 3> edge{};
  std::array<int, 3> count{};     ///< Between the outermost sides.
  std::array<bool, 3> is_thin{};  ///< What lies between them is thinner than a cell, which is as thin as may be.
};

/// With edges of about `size`, and one cell more along the axes whose bits are set.
Cells cells_of(const FlatSides& sides, double size, unsigned up) {
  Cells cells;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = sides.axes[i].hi - sides.axes[i].lo;
    cells.count[i] = static_cast<int>(std::floor(way / size)) + ((up >> i & 1U) != 0 ? 1 : 0);
    cells.is_thin[i] = cells.count[i] == 0;
    if (cells.is_thin[i]) continue;
    cells.edge[i] = way / cells.count[i];
    most = std::max(most, cells.edge[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (cells.is_thin[i]) cells.edge[i] = kLeastLayer * most;
  }
  return cells;
}

/// Longest over shortest edge, layers of one cell aside; nothing where cells are not what smoothing could live with.
std::optional<double> stretch_of(const FlatSides& sides, const Cells& cells) {
  const double most = *std::max_element(cells.edge.begin(), cells.edge.end());
  double least = most;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = sides.axes[i].hi - sides.axes[i].lo;
    if (cells.edge[i] < (cells.is_thin[i] ? way : kLeastLayer * most)) return {};
    if (cells.count[i] > 1) least = std::min(least, cells.edge[i]);
  }
  if (!(most > 0) || most > kMostStretch * least) return {};
  return most / least;
}

AlignedPlace place_along(const FlatSides& sides, const Cells& cells, const Vec3d& centre) {
  AlignedPlace aligned;
  aligned.volume = 1;
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    const FlatSides::Axis& axis = sides.axes[i];
    const double edge = cells.edge[i], begin = cells.is_thin[i] ? (axis.lo + axis.hi - edge) / 2 : axis.lo;
    at[i] = (dot(axis.direction, centre) - begin) / edge;
    aligned.volume *= cells.is_thin[i] ? axis.hi - axis.lo : edge;
    aligned.is_layer |= cells.is_thin[i];
    for (const auto& [offset, share] : axis.sides) {
      const double place = (offset - axis.lo) / edge, away = cells.is_thin[i] ? 0 : place - std::round(place);
      aligned.unfit += share * away * away;
    }
  }
  const auto [x, y, z] = cells.edge;
  aligned.place.cell_size = elementary::cbrt(x * y * z);
  aligned.place.rotate = sides.rotate;
  aligned.place.centre_cell = {at[0], at[1], at[2]};
  aligned.place.stretch = Vec3d{x, y, z} * (1 / aligned.place.cell_size);
  return aligned;
}

}  // namespace

std::optional<FlatSides> find_flat_sides(const TriangleSoup& soup, double width, StageWatch& watch) {
  const SoupPlanes found = find_planes(soup, width, watch);
  const std::vector<Direction> directions = directions_of(found.planes);
  if (directions.empty()) return {};
  const Vec3d first = directions[0].normal;
  const auto across = std::find_if(directions.begin(), directions.end(),
                                   [&](const Direction& d) { return std::abs(dot(d.normal, first)) < kAcross; });
  const std::optional<Vec3d> beside = across != directions.end() ? across->normal : rim_of(soup, first);
  if (!beside) return {};
  Vec3d second = *beside - first * dot(first, *beside);
  second = second * (1 / length(second));
  FlatSides sides;
  const std::array<Vec3d, 3> axes = sorted_axes({first, second, cross(first, second)});
  double along = 0;
  for (const Direction& d : directions) {
    for (const Vec3d& axis : axes) along += std::abs(dot(axis, d.normal)) > kSameWay ? d.area : 0;
  }
  if (along < kLeastShare * found.area) return {};
  for (std::size_t i = 0; i < 3; ++i) sides.axes[i] = axis_along(axes[i], found.planes, soup);
  sides.rotate = angles_of(axes);
  return sides;
}

std::vector<AlignedPlace> aligned_places(const FlatSides& sides, double cell_size, const Vec3d& centre) {
  std::vector<AlignedPlace> places;
  std::array<int, 3> last{-1, -1, -1};
  for (double by = kLeastSize; by <= kMostSize; by += kStep) {
    const double size = cell_size * elementary::exp(by);
    for (unsigned up = 0; up < 8; ++up) {
      const Cells cells = cells_of(sides, size, up);
      const std::optional<double> stretch = cells.count == last ? std::nullopt : stretch_of(sides, cells);
      last = cells.count;
      if (!stretch) continue;
      places.push_back(place_along(sides, cells, centre));
      places.back().unfit += kOfStretch * (*stretch - 1) * (*stretch - 1);
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const AlignedPlace& a, const AlignedPlace& b) { return a.unfit < b.unfit; });
  return places;
}

}  // namespace tetsoup
