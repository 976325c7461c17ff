#include "quality/line_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/groups.h"
#include "base/vec.h"

namespace tetsoup {

namespace {

constexpr int kLines = 112;           ///< Along the longer side of the shadow that both throw.
constexpr std::uint32_t kSoup = ~0U;  ///< Whose surface was crossed: the soup's, or that of a piece.

/// Turned by a quaternion that favours no axis, plane or diagonal.
Vec3d turned(const Vec3d& p) {
  constexpr double w = 0.7931, x = 0.3119, y = -0.2713, z = 0.4481;
  constexpr double n = w * w + x * x + y * y + z * z;
  const Vec3d q{x, y, z};
  return (p * (w * w - dot(q, q)) + q * (2 * dot(q, p)) + cross(q, p) * (2 * w)) * (1 / n);
}

Vec3d turned_back(const Vec3d& p) {
  constexpr double w = 0.7931, x = 0.3119, y = -0.2713, z = 0.4481;
  constexpr double n = w * w + x * x + y * y + z * z;
  const Vec3d q{x, y, z};
  return (p * (w * w - dot(q, q)) + q * (2 * dot(q, p)) - cross(q, p) * (2 * w)) * (1 / n);
}

struct Crossing {
  double height;
  std::uint32_t owner;
  std::int32_t step;  ///< What it adds to the winding number on the way up.
};

struct LineGrid {
  Vec3d lo;
  double spacing = 1;
  int columns = 0, rows = 0;
  int column_above(double x) const { return static_cast<int>(std::ceil((x - lo.x) / spacing - 0.5)); }
  int row_above(double y) const { return static_cast<int>(std::ceil((y - lo.y) / spacing - 0.5)); }
  double x(int column) const { return lo.x + (column + 0.5) * spacing; }
  double y(int row) const { return lo.y + (row + 0.5) * spacing; }
};

std::vector<Vec3d> turned_all(const std::vector<Vec3>& vertices, Vec3d& lo, Vec3d& hi) {
  std::vector<Vec3d> points;
  points.reserve(vertices.size());
  for (const Vec3& v : vertices) {
    points.push_back(turned(to_double(v)));
    if (!is_finite(v)) continue;
    lo = min(lo, points.back()), hi = max(hi, points.back());
  }
  return points;
}

/// Crossings of lines with triangles, gathered line by line.
class Gatherer {
 public:
  explicit Gatherer(const LineGrid& grid) : grid_(grid) {}

  void add(const std::vector<Vec3d>& points, const Triangle& t, std::uint32_t owner, int turn) {
    const Vec3d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const int first = std::max(0, grid_.column_above(std::min({a.x, b.x, c.x})));
    const int end = std::min(grid_.columns, grid_.column_above(std::max({a.x, b.x, c.x})));
    if (first >= end) return;
    const int first_row = std::max(0, grid_.row_above(std::min({a.y, b.y, c.y})));
    const int end_row = std::min(grid_.rows, grid_.row_above(std::max({a.y, b.y, c.y})));
    if (first_row >= end_row) return;
    const Vec3d n = cross(b - a, c - a);
    for (int row = first_row; row < end_row; ++row) {
      for (int column = first; column < end; ++column) {
        const double x = grid_.x(column), y = grid_.y(row);
        const bool side = is_left(points, t[0], t[1], x, y);
        if (is_left(points, t[1], t[2], x, y) != side || is_left(points, t[2], t[0], x, y) != side || n.z == 0)
          continue;
        lines_.push_back(static_cast<std::uint32_t>(row * grid_.columns + column));
        crossings_.push_back({a.z - (n.x * (x - a.x) + n.y * (y - a.y)) / n.z, owner, side ? -turn : turn});
      }
    }
  }

  Groups<Crossing> by_line() const {
    Groups<Crossing> lines(static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows),
                           [&](const auto& put) {
                             for (std::size_t i = 0; i < lines_.size(); ++i) put(lines_[i], crossings_[i]);
                           });
    for (std::size_t line = 0; line < lines.size(); ++line) {
      std::sort(lines[line].begin(), lines[line].end(), [](const Crossing& a, const Crossing& b) {
        return a.height != b.height ? a.height < b.height : a.owner != b.owner ? a.owner < b.owner : a.step < b.step;
      });
    }
    return lines;
  }

 private:
  /// The point lies to the left of the way from `from` to `to`; both triangles of an edge ask for the same difference.
  static bool is_left(const std::vector<Vec3d>& points, std::uint32_t from, std::uint32_t to, double x, double y) {
    const Vec3d &a = points[std::min(from, to)], &b = points[std::max(from, to)];
    const bool left = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0;
    return left == (from < to);
  }

  const LineGrid& grid_;
  std::vector<std::uint32_t> lines_;
  std::vector<Crossing> crossings_;
};

/// Adds up one line, from below.
class Sweep {
 public:
  Sweep(LineSurvey& survey, std::uint32_t pieces, bool closed, double far)
      : survey_(survey), within_(pieces, 0), closed_(closed), far_(far) {}

  void run(std::span<const Crossing> line, double x, double y) {
    double soup_below = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i > 0) add(line, i, soup_below, x, y);
      const Crossing& at = line[i];
      if (at.owner == kSoup) {
        winding_ += at.step;
        soup_below = at.height;
      } else {
        int& count = within_[at.owner];
        pieces_ -= count > 0, twice_ -= count > 1;
        count += at.step;
        pieces_ += count > 0, twice_ += count > 1;
      }
    }
    winding_ = pieces_ = twice_ = 0;
    std::fill(within_.begin(), within_.end(), 0);
  }

 private:
  void add(std::span<const Crossing> line, std::size_t above, double soup_below, double x, double y) {
    const double from = line[above - 1].height, to = line[above].height, length = to - from;
    if (pieces_ > 0) survey_.mesh += length;
    if (pieces_ > 1) survey_.apart += length;
    if (twice_ > 0) survey_.overlap += length;
    if (winding_ != 0) survey_.soup += length;
    if (winding_ != 0 && winding_ != 1) survey_.nested += length;
    if (pieces_ == 0 || winding_ != 0 || !closed_) return;
    double soup_above = std::numeric_limits<double>::infinity();
    for (std::size_t i = above; i < line.size() && soup_above > to + far_; ++i)
      if (line[i].owner == kSoup) soup_above = line[i].height;
    const double low = std::max(from, soup_below + far_), high = std::min(to, soup_above - far_);
    if (!(low < high)) return;
    const double parts = std::ceil((high - low) / far_);
    for (double i = 0; i < parts; ++i)
      survey_.outside.push_back({turned_back({x, y, low + (high - low) * (i + 0.5) / parts}), (high - low) / parts});
  }

  LineSurvey& survey_;
  std::vector<int> within_;
  int winding_ = 0, pieces_ = 0, twice_ = 0;
  bool closed_;
  double far_;
};

}  // namespace

LineSurvey survey_lines(const TetMesh& mesh, const MeshSkin& skin, const TriangleSoup& soup, const SoupFacts& facts,
                        double far) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d lo{kInfinity, kInfinity, kInfinity}, hi = lo * -1;
  const std::vector<Vec3d> of_mesh = turned_all(mesh.vertices, lo, hi);
  std::vector<Vec3d> of_soup;
  if (facts.closed) of_soup = turned_all(soup.vertices, lo, hi);
  LineGrid grid;
  grid.lo = lo;
  grid.spacing = std::max(hi.x - lo.x, hi.y - lo.y) / kLines;
  if (!(grid.spacing > 0) || std::isinf(grid.spacing)) return {};
  grid.columns = std::min(kLines, grid.column_above(hi.x));
  grid.rows = std::min(kLines, grid.row_above(hi.y));
  Gatherer gatherer(grid);
  for (std::size_t t = 0; t < skin.triangles.size(); ++t)
    gatherer.add(of_mesh, skin.triangles[t], skin.piece[skin.triangle_tet[t]], 1);
  if (facts.closed)
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      if (facts.turn[t] != 0) gatherer.add(of_soup, soup.triangles[t], kSoup, facts.turn[t]);
  const Groups<Crossing> lines = gatherer.by_line();
  LineSurvey survey;
  Sweep sweep(survey, skin.pieces, facts.closed, far);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      sweep.run(lines[static_cast<std::size_t>(row * grid.columns + column)], grid.x(column), grid.y(row));
  return survey;
}

}  // namespace tetsoup
