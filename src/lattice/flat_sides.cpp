#include "lattice/flat_sides.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/soup_planes.h"

namespace tetsoup {

namespace {

constexpr double kSameWay = 0.9993, kAcross = 0.026;  // Cosines: within 2 degrees, and within 1.5 of a right angle.
constexpr double kUpright = 0.9998;                   // Within a degree of the soup's own axes a lattice is not turned.
constexpr double kLeastShare = 0.5;                   // Of the soup's area in planes along the axes.
constexpr double kLeastSide = 0.05;   // Of the area of an axis' planes: less is no side worth a cell's end.
constexpr double kMostStretch = 1.3;  // Longest over shortest edge of a cell,
constexpr double kLeastLayer = 0.45;  // but a layer of one cell may be so thin: its tets keep the limits of smoothing.
constexpr double kStep = 0.01, kRange = 0.7;  // Of the cell size searched through, logarithms.
constexpr double kOfStretch = 0.5;            // What a stretch counts beside planes that no cell ends at.

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
  if (axis.sides.empty()) {
    axis.lo = 1e300, axis.hi = -1e300;
    for (const Triangle& t : soup.triangles) {
      for (const std::uint32_t v : t) {
        const double along = dot(direction, to_double(soup.vertices[v]));
        axis.lo = std::min(axis.lo, along), axis.hi = std::max(axis.hi, along);
      }
    }
    return axis;
  }
  const auto [lo, hi] = std::minmax_element(axis.sides.begin(), axis.sides.end(),
                                            [](const auto& a, const auto& b) { return a.offset < b.offset; });
  axis.lo = lo->offset, axis.hi = hi->offset;
  return axis;
}

}  // namespace

std::optional<FlatSides> find_flat_sides(const TriangleSoup& soup, double width, StageWatch& watch) {
  const SoupPlanes found = find_planes(soup, width, watch);
  const std::vector<Direction> directions = directions_of(found.planes);
  if (directions.empty()) return {};
  const Vec3d first = directions[0].normal;
  const auto across = std::find_if(directions.begin(), directions.end(),
                                   [&](const Direction& d) { return std::abs(dot(d.normal, first)) < kAcross; });
  if (across == directions.end()) return {};
  Vec3d second = across->normal - first * dot(first, across->normal);
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
  for (double by = -kRange; by <= kRange; by += kStep) {
    const double size = cell_size * elementary::exp(by);
    for (unsigned up = 0; up < 8; ++up) {
      std::array<double, 3> edge{}, cells{};
      std::array<int, 3> count{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double way = sides.axes[i].hi - sides.axes[i].lo;
        cells[i] = std::floor(way / size) + ((up >> i & 1U) != 0 ? 1 : 0);
        edge[i] = way > 0 && cells[i] > 0 ? way / cells[i] : size;
        count[i] = static_cast<int>(cells[i]);
      }
      if (count == last) continue;
      last = count;
      const double most = *std::max_element(edge.begin(), edge.end());
      double least = most;
      bool is_regular = true;
      for (std::size_t i = 0; i < 3; ++i) {
        if (count[i] != 1) least = std::min(least, edge[i]);
        is_regular = is_regular && edge[i] > kLeastLayer * most;
      }
      if (!is_regular || most > kMostStretch * least) continue;
      AlignedPlace aligned;
      aligned.volume = edge[0] * edge[1] * edge[2];
      aligned.place.cell_size = elementary::cbrt(aligned.volume);
      aligned.place.rotate = sides.rotate;
      std::array<double, 3> at{};
      for (std::size_t i = 0; i < 3; ++i) {
        const FlatSides::Axis& axis = sides.axes[i];
        at[i] = (dot(axis.direction, centre) - axis.lo) / edge[i];
        for (const auto& [offset, share] : axis.sides) {
          const double place = (offset - axis.lo) / edge[i], away = place - std::round(place);
          aligned.unfit += share * away * away;
        }
      }
      aligned.unfit += kOfStretch * (most / least - 1) * (most / least - 1);
      aligned.place.centre_cell = {at[0], at[1], at[2]};
      aligned.place.stretch = Vec3d{edge[0], edge[1], edge[2]} * (1 / aligned.place.cell_size);
      places.push_back(aligned);
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const AlignedPlace& a, const AlignedPlace& b) { return a.unfit < b.unfit; });
  return places;
}

}  // namespace tetsoup
