#include <algorithm>
#include <bit>
#include <cmath>

#include "base/tet_geometry.h"
#include "lattice/densities.h"

namespace tetsoup {
namespace {

/// In cells: shapes that come this close count as touching, so that a triangle within a shared face keeps both tets.
constexpr double kTouching = 1e-9;

using Corners3 = std::array<Vec3d, 3>;

template <std::size_t N>
std::array<double, 2> project(const std::array<Vec3d, N>& points, const Vec3d& axis) {
  std::array<double, 2> range{dot(points[0], axis), dot(points[0], axis)};
  for (const Vec3d& p : points) {
    range[0] = std::min(range[0], dot(p, axis));
    range[1] = std::max(range[1], dot(p, axis));
  }
  return range;
}

template <std::size_t N, std::size_t M>
bool separates(const Vec3d& axis, const std::array<Vec3d, N>& a, const std::array<Vec3d, M>& b) {
  const double size = length(axis);
  if (size == 0) return false;
  const auto ra = project(a, axis), rb = project(b, axis);
  return ra[0] > rb[1] + kTouching * size || rb[0] > ra[1] + kTouching * size;
}

/// Separating axes of a triangle (or what is left of a degenerate one) and a tet.
bool touches(const Corners3& triangle, const TetCorners& tet) {
  const auto at = [&](int i) { return tet[static_cast<std::size_t>(i)]; };
  for (const auto& f : kTetFaces)
    if (separates(cross(at(f[1]) - at(f[0]), at(f[2]) - at(f[0])), triangle, tet)) return false;
  if (separates(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]), triangle, tet)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d side = triangle[(i + 1) % 3] - triangle[i];
    for (const auto& e : kTetEdges)
      if (separates(cross(side, at(e[1]) - at(e[0])), triangle, tet)) return false;
  }
  return true;
}

/// Finds the tets that one triangle touches by halving its box of cells.
class CrossedTets {
 public:
  CrossedTets(const Corners3& triangle, const LatticeTable& table, std::vector<FilledCell>& found)
      : triangle_(triangle),
        table_(table),
        overhang_(static_cast<double>(table.reach) / kStepsPerCell - 1),
        found_(found) {
    normal_ = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double size = length(normal_);
    if (size > 0) normal_ = normal_ * (1 / size);
  }

  void search() {
    const Vec3d lo = min(min(triangle_[0], triangle_[1]), triangle_[2]);
    const Vec3d hi = max(max(triangle_[0], triangle_[1]), triangle_[2]);
    const auto first = [&](double v) { return static_cast<int>(std::floor(v - overhang_ - kTouching)); };
    const auto last = [](double v) { return static_cast<int>(std::floor(v + kTouching)) + 1; };
    halve({first(lo.x), first(lo.y), first(lo.z)}, {last(hi.x), last(hi.y), last(hi.z)});
  }

 private:
  void halve(const Cell& begin, const Cell& end) {
    if (is_off_plane(begin, end)) return;
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (end[i] - begin[i] > end[axis] - begin[axis]) axis = i;
    if (end[axis] - begin[axis] == 1) {
      test_cell(begin);
      return;
    }
    Cell middle_end = end, middle_begin = begin;
    middle_end[axis] = middle_begin[axis] = begin[axis] + (end[axis] - begin[axis]) / 2;
    halve(begin, middle_end);
    halve(middle_begin, end);
  }

  bool is_off_plane(const Cell& begin, const Cell& end) const {
    Vec3d lo{static_cast<double>(begin[0]), static_cast<double>(begin[1]), static_cast<double>(begin[2])};
    Vec3d hi{static_cast<double>(end[0]), static_cast<double>(end[1]), static_cast<double>(end[2])};
    hi += Vec3d{overhang_, overhang_, overhang_};
    const Vec3d half = (hi - lo) * 0.5;
    const double reach = std::abs(normal_.x) * half.x + std::abs(normal_.y) * half.y + std::abs(normal_.z) * half.z;
    return std::abs(dot(normal_, lo + half - triangle_[0])) > reach + kTouching;
  }

  void test_cell(const Cell& cell) {
    const Vec3d base{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    const bool odd = is_odd(cell);
    unsigned kept = 0;
    for (std::size_t t = 0; t < table_.tet_count; ++t) {
      TetCorners corners = table_.corners(t, odd);
      for (Vec3d& p : corners) p += base;
      kept |= static_cast<unsigned>(touches(triangle_, corners)) << t;
    }
    if (kept != 0) found_.push_back({cell, static_cast<std::uint16_t>(kept)});
  }

  Corners3 triangle_;
  Vec3d normal_;
  const LatticeTable& table_;
  double overhang_;  ///< How far a cell's tets reach beyond its upper faces, in cells.
  std::vector<FilledCell>& found_;
};

bool in_lattice_order(const FilledCell& a, const FilledCell& b) {
  return std::array{a.cell[2], a.cell[1], a.cell[0]} < std::array{b.cell[2], b.cell[1], b.cell[0]};
}

/// One entry a cell, in order.
void merge_cells(std::vector<FilledCell>& cells) {
  std::stable_sort(cells.begin(), cells.end(), in_lattice_order);
  std::size_t count = 0;
  for (const FilledCell& c : cells) {
    if (count > 0 && cells[count - 1].cell == c.cell) {
      cells[count - 1].kept |= c.kept;
    } else {
      cells[count++] = c;
    }
  }
  cells.resize(count);
}

std::vector<FilledCell> crossed_cells(const CleanSoup& soup, const LatticeFrame& frame, const LatticeTable& table,
                                      StageWatch& watch) {
  constexpr std::size_t kMergeAt = 1 << 20;  // cells found before duplicates are merged
  const auto& vertices = soup.soup.vertices;
  std::vector<FilledCell> cells;
  std::size_t done = 0, merge_at = kMergeAt;
  for (const Triangle& t : soup.soup.triangles) {
    CrossedTets({frame.to_cell(to_double(vertices[t[0]])), frame.to_cell(to_double(vertices[t[1]])),
                 frame.to_cell(to_double(vertices[t[2]]))},
                table, cells)
        .search();
    if (cells.size() > merge_at) {
      merge_cells(cells);
      merge_at = 2 * cells.size() + kMergeAt;
    }
    if (++done % 256 == 0) watch.step(static_cast<double>(done) / static_cast<double>(soup.soup.triangles.size()));
  }
  merge_cells(cells);
  return cells;
}

}  // namespace

void keep_crossed_tets(const CleanSoup& soup, const LatticeFrame& frame, const LatticeTable& table, FilledCells& filled,
                       StageWatch& watch) {
  const std::vector<FilledCell> crossed = crossed_cells(soup, frame, table, watch);
  FilledCells all;
  all.sampled_tets = filled.sampled_tets;
  const std::size_t tets = table.tet_count;
  std::size_t f = 0, c = 0;
  while (f < filled.cells.size() || c < crossed.size()) {
    const bool takes_filled =
        f < filled.cells.size() && (c == crossed.size() || !in_lattice_order(crossed[c], filled.cells[f]));
    const bool takes_crossed =
        c < crossed.size() && (f == filled.cells.size() || !in_lattice_order(filled.cells[f], crossed[c]));
    const Cell cell = takes_filled ? filled.cells[f].cell : crossed[c].cell;
    all.cells.push_back({cell, takes_crossed ? crossed[c].kept : std::uint16_t{0}});
    all.kept_tets += static_cast<std::size_t>(std::popcount(all.cells.back().kept));
    const auto known = filled.densities.begin() + static_cast<std::ptrdiff_t>(f * tets);
    if (takes_filled) {
      all.densities.insert(all.densities.end(), known, known + static_cast<std::ptrdiff_t>(tets));
    } else {
      all.densities.insert(all.densities.end(), tets, 0.0F);
    }
    f += takes_filled;
    c += takes_crossed;
  }
  filled = std::move(all);
}

}  // namespace tetsoup
