#include "quality/surface_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/unions.h"

namespace tetsoup {

namespace {

constexpr int kBits = 21;
constexpr double kMostCells = 1000;  ///< Along a side: the work stays bounded.
constexpr double kStep = 0.7;        ///< Of a cell, from point to point.
constexpr std::uint64_t kBias = 2;   ///< Neighbours of the lowest cell have keys too.

std::uint64_t key_of(const Vec3d& p, const Vec3d& lo, double cell) {
  const auto number = [&](double x, double from) { return static_cast<std::uint64_t>((x - from) / cell) + kBias; };
  return number(p.x, lo.x) | number(p.y, lo.y) << kBits | number(p.z, lo.z) << (2 * kBits);
}

/// Points over a triangle, at most `step` apart: in rows along its longest side.
template <class Visit>
void visit_points(std::array<Vec3d, 3> p, double step, const Visit& visit) {
  const std::array<double, 3> sides{squared_length(p[1] - p[0]), squared_length(p[2] - p[1]),
                                    squared_length(p[0] - p[2])};
  const auto longest = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(longest), p.end());
  const double base = std::sqrt(sides[longest]);
  if (base <= step) return visit((p[0] + p[1] + p[2]) * (1.0 / 3));
  const double height = length(cross(p[1] - p[0], p[2] - p[0])) / base;
  const double rows = std::ceil(height / step);
  for (double r = 0; r <= rows; ++r) {
    const double up = rows > 0 ? r / rows : 0;
    const Vec3d from = p[0] + (p[2] - p[0]) * up, to = p[1] + (p[2] - p[1]) * up;
    const double columns = std::ceil(base * (1 - up) / step);
    for (double c = 0; c <= columns; ++c) visit(columns > 0 ? from + (to - from) * (c / columns) : from);
  }
}

/// Which cells a part has a point in already: a table with open places, at most half full.
class PlacesTaken {
 public:
  bool add(std::uint64_t key, std::uint32_t part) {
    if (key == last_key_ && part == last_part_) return false;
    last_key_ = key, last_part_ = part;
    if (2 * (count_ + 1) > places_.size()) grow();
    Place& place = find(key, part);
    if (place.key != 0) return false;
    place = {key, part};
    ++count_;
    return true;
  }

 private:
  struct Place {
    std::uint64_t key = 0;  ///< Of no cell: open.
    std::uint32_t part = 0;
  };
  Place& find(std::uint64_t key, std::uint32_t part) {
    constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15U;
    const std::uint64_t mixed = (key ^ (std::uint64_t{part} << 40)) * kMix;
    std::size_t i = static_cast<std::size_t>(mixed ^ (mixed >> 29)) & (places_.size() - 1);
    while (places_[i].key != 0 && (places_[i].key != key || places_[i].part != part))
      i = (i + 1) & (places_.size() - 1);
    return places_[i];
  }
  void grow() {
    std::vector<Place> old(2 * places_.size());
    old.swap(places_);
    for (const Place& place : old)
      if (place.key != 0) find(place.key, place.part) = place;
  }

  std::vector<Place> places_{1U << 14U};
  std::size_t count_ = 0;
  std::uint64_t last_key_ = 0;
  std::uint32_t last_part_ = 0;
};

}  // namespace

std::vector<SurfaceCell> find_surface_cells(const TriangleSoup& soup, const std::vector<std::uint32_t>& part,
                                            double& cell) {
  const Box3 box = box_of(soup.vertices);
  const double size = std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
  cell = std::max(cell, size / kMostCells);
  std::vector<SurfaceCell> cells;
  if (!(cell > 0) || std::isinf(cell)) return cells;
  PlacesTaken taken;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto [a, b, c] = soup.triangles[t];
    visit_points({to_double(soup.vertices[a]), to_double(soup.vertices[b]), to_double(soup.vertices[c])}, kStep * cell,
                 [&](const Vec3d& p) {
                   const std::uint64_t key = key_of(p, box.lo, cell);
                   if (taken.add(key, part[t])) cells.push_back({key, p, t});
                 });
  }
  std::sort(cells.begin(), cells.end(), [&](const auto& a, const auto& b) {
    return a.key != b.key ? a.key < b.key : part[a.triangle] < part[b.triangle];
  });
  return cells;
}

std::vector<std::uint32_t> label_cells(const std::vector<SurfaceCell>& cells, std::uint32_t& groups) {
  Unions sets(cells.size());
  // The thirteen neighbours that come before a cell lie in four rows of three and one of one: a finger runs along each.
  constexpr std::array<std::array<int, 2>, 5> kRows{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (const auto& [dy, dz] : kRows) {
    std::size_t finger = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::uint64_t row = cells[i].key + (static_cast<std::uint64_t>(static_cast<std::int64_t>(dy)) << kBits) +
                                (static_cast<std::uint64_t>(static_cast<std::int64_t>(dz)) << (2 * kBits));
      while (finger < cells.size() && cells[finger].key + 1 < row) ++finger;
      for (std::size_t j = finger; j < i && cells[j].key <= row + 1; ++j) sets.join(i, j);
    }
  }
  groups = 0;
  std::vector<std::uint32_t> label(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) label[i] = sets.find(i) == i ? groups++ : label[sets.find(i)];
  return label;
}

}  // namespace tetsoup
