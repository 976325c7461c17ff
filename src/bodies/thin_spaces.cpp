#include "bodies/thin_spaces.h"

#include <cmath>
#include <limits>

#include "bodies/rays.h"

namespace tetsoup {
namespace {

constexpr double kFacing = 0.5;     ///< Square of the cosine between two planes that face each other.
constexpr double kSameFace = 1e-4;  ///< Of the soup's size: faces nearer than this are one sheet.
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kGrain = 64;  ///< Points.

/// A point of the surface.
struct Point {
  std::uint32_t triangle;
  Vec3d at;
};

Vec3d normal_of(const TriangleSoup& soup, std::uint32_t triangle) {
  const TriangleCorners c = corners_of(soup, triangle);
  const Vec3d a = to_double(c[0]);
  return cross(to_double(c[1]) - a, to_double(c[2]) - a);
}

/// Two numbers in [0, 1) for every index, evenly spread: multiples of the powers of the plastic number [Roberts18].
std::array<double, 2> spread(std::uint64_t index) {
  const auto fraction = [](std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; };
  return {fraction(index * 0xC13FA9A902A6328FU), fraction(index * 0x91E10DA5C79E7B1DU)};
}

/// Points as far apart along the sum of the areas, so that a triangle has as many as its share, one more or less.
std::vector<Point> spread_points(const TriangleSoup& soup, std::size_t wanted, double& area) {
  std::vector<double> sums;
  sums.reserve(soup.triangles.size());
  area = 0;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) sums.push_back(area += length(normal_of(soup, t)) / 2);
  std::vector<Point> points;
  if (!(area > 0)) return points;
  points.reserve(wanted);
  std::uint32_t t = 0;
  for (std::size_t i = 0; i < wanted; ++i) {
    const double place = area * ((static_cast<double>(i) + 0.5) / static_cast<double>(wanted));
    while (t + 1 < sums.size() && sums[t] <= place) ++t;
    auto [u, v] = spread(i + 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const TriangleCorners c = corners_of(soup, t);
    const Vec3d a = to_double(c[0]), b = to_double(c[1]) - a, d = to_double(c[2]) - a;
    points.push_back({t, a + b * u + d * v});
  }
  return points;
}

bool share_a_corner(const Triangle& s, const Triangle& t) {
  for (const std::uint32_t v : s)
    if (v == t[0] || v == t[1] || v == t[2]) return true;
  return false;
}

/// What a point sees to both sides.
struct View {
  std::array<FacingSample, 2> seen;
  std::size_t count = 0;
  bool doubled = false, free = true;
};

class Looker {
 public:
  Looker(const TriangleSoup& soup, std::span<const std::uint32_t> parts, std::span<const std::uint8_t> is_closed,
         StageWatch& watch)
      : soup_(soup),
        parts_(parts),
        is_closed_(is_closed),
        tree_(make_box_hierarchy(soup.triangles, soup.vertices, watch)) {
    const Box3 box = box_of(soup.vertices);
    size_ = length(box.hi - box.lo);
    any_closed_ = std::any_of(is_closed.begin(), is_closed.end(), [](std::uint8_t closed) { return closed != 0; });
  }

  View look(const Point& point) const {
    View view;
    const Vec3d normal = normal_of(soup_, point.triangle), along = normal * (1 / length(normal));
    for (const double side : {1.0, -1.0}) look_along(point, along * side, view);
    return view;
  }

 private:
  void look_along(const Point& point, const Vec3d& along, View& view) const {
    double nearest = 2 * size_;
    std::uint32_t opposite = kNone;
    double slope = 0;
    visit_met(soup_, tree_, Ray(point.at, along), nearest, [&](std::uint32_t t, double distance) {
      if (t == point.triangle) return;
      const Vec3d n = normal_of(soup_, t);
      const double cosine = dot(n, along), square = cosine * cosine, full = squared_length(n);
      if (distance < kSameFace * size_) {
        view.doubled |= square > kFacing * full;
        return;
      }
      if (distance == nearest && t > opposite) return;
      nearest = distance, opposite = t;
      slope = square > kFacing * full ? std::sqrt(std::max(0.0, full / square - 1)) : kInfinity;
    });
    if (opposite == kNone) return;
    view.free = false;
    if (slope > 1 || share_a_corner(soup_.triangles[point.triangle], soup_.triangles[opposite])) return;
    view.seen[view.count++] = {point.triangle, opposite, static_cast<float>(nearest), static_cast<float>(slope),
                               kind_at(to_float(point.at + along * (nearest / 2)), point.triangle, opposite)};
  }

  /// Of the space in the middle between two triangles.
  SpaceKind kind_at(const Vec3& middle, std::uint32_t s, std::uint32_t t) const {
    if (!any_closed_) return SpaceKind::Unknown;
    std::vector<std::uint32_t> around;
    visit_crossed(soup_, tree_, middle, [&](std::uint32_t crossed) {
      if (is_closed_[parts_[crossed]] != 0) around.push_back(parts_[crossed]);
    });
    keep_odd(around);
    if (around.size() == 1) return SpaceKind::Wall;
    const bool closed = is_closed_[parts_[s]] != 0 && is_closed_[parts_[t]] != 0;
    return around.empty() && closed ? SpaceKind::Gap : SpaceKind::Unknown;
  }

  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  const TriangleSoup& soup_;
  std::span<const std::uint32_t> parts_;
  std::span<const std::uint8_t> is_closed_;
  BoxHierarchy tree_;
  double size_ = 0;
  bool any_closed_ = false;
};

/// Distances of one kind, ascending.
std::vector<float> distances_of(const ThinSpaces& spaces, SpaceKind kind) {
  std::vector<float> distances;
  for (const FacingSample& s : spaces.samples)
    if (s.kind == kind) distances.push_back(s.distance);
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace

ThinSpaces measure_thin_spaces(const TriangleSoup& soup, std::span<const std::uint32_t> part_of_triangle,
                               std::span<const std::uint8_t> is_closed, std::size_t points, StageWatch& watch) {
  ThinSpaces spaces;
  const std::vector<Point> places = spread_points(soup, points, spaces.area);
  if (places.empty()) return spaces;
  const Looker looker(soup, part_of_triangle, is_closed, watch);
  std::vector<View> views(places.size());
  parallel_for(static_cast<std::int64_t>(places.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      views[i] = looker.look(places[i]);
  });
  spaces.point_count = places.size();
  for (const View& view : views) {
    spaces.samples.insert(spaces.samples.end(), view.seen.begin(),
                          view.seen.begin() + static_cast<std::ptrdiff_t>(view.count));
    spaces.doubled_share += view.doubled ? 1 : 0;
    spaces.free_share += view.free ? 1 : 0;
  }
  spaces.doubled_share /= static_cast<double>(places.size());
  spaces.free_share /= static_cast<double>(places.size());
  return spaces;
}

std::optional<double> ThinSpaces::distance_below(SpaceKind kind, double share) const {
  const std::vector<float> distances = distances_of(*this, kind);
  const double wanted = std::ceil(share * static_cast<double>(point_count));
  if (wanted > static_cast<double>(distances.size()) || distances.empty()) return std::nullopt;
  return distances[static_cast<std::size_t>(std::max(1.0, wanted)) - 1];
}

std::optional<double> ThinSpaces::thinnest(SpaceKind kind, double share) const {
  constexpr double kNearlySame = 1.4;  ///< The ratio of the ends of a window of distances.
  constexpr double kMost = 0.6;        ///< Of what is as thin or thinner; of a wedge it is 1 - 1 / 1.4.
  const std::vector<float> distances = distances_of(*this, kind);
  const double wanted = std::max(1.0, share * static_cast<double>(point_count));
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= distances.size(); ++end) {
    while (distances[begin] * kNearlySame < distances[end - 1]) ++begin;
    const auto inside = static_cast<double>(end - begin);
    if (inside >= wanted && inside >= kMost * static_cast<double>(end)) return distances[begin + (end - begin) / 2];
  }
  return std::nullopt;
}

}  // namespace tetsoup
