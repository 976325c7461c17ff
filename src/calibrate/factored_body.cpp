#include "calibrate/factored_body.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernel/dense_product.h"

namespace tetsoup {

namespace {

constexpr std::size_t kPanel = 48;         ///< Columns eliminated before the rest is updated: they stay in the cache.
constexpr std::size_t kUpdate = 64;        ///< Columns updated at once by one thread.
constexpr std::size_t kSolveColumns = 16;  ///< Right sides that one thread carries through the factor.
constexpr std::size_t kSolvePanel = 24;    ///< Rows solved before the rest is updated.

/// The first `own` columns of a matrix of n rows, in place: its lower half becomes the factor's, the rest what is left.
bool factor_columns(std::vector<double>& matrix, std::size_t n, std::size_t own) {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  bool positive = true;
  for (std::size_t panel = 0; panel < own; panel += kPanel) {
    const std::size_t end = std::min(own, panel + kPanel);
    for (std::size_t c = panel; c < end; ++c) {
      double* column = &matrix[c * n];
      kernel::subtract_product(column + c, n, n - c, 1, &matrix[panel * n + c], n, {&matrix[panel * n + c], n, 1},
                               c - panel);
      if (!(column[c] > 0)) positive = false;
      const double pivot = positive ? std::sqrt(column[c]) : 1, inverse = 1 / pivot;
      column[c] = pivot;
      for (std::size_t i = c + 1; i < n; ++i) column[i] *= inverse;
    }
    const auto left = static_cast<std::int64_t>(n - end);
    parallel_for(left, static_cast<std::int64_t>(kUpdate), watch, [&](std::int64_t from, std::int64_t to) {
      const std::size_t c = end + static_cast<std::size_t>(from);
      const double* rows = &matrix[panel * n + c];
      kernel::subtract_product(&matrix[c * n + c], n, n - c, static_cast<std::size_t>(to - from), rows, n, {rows, n, 1},
                               end - panel);
    });
  }
  return positive;
}

/// Where a place of the elimination lies among a front's rows.
std::size_t row_of(const Front& front, std::uint32_t place) {
  if (place < front.first + front.count) return place - front.first;
  const auto found = std::lower_bound(front.boundary.begin(), front.boundary.end(), place);
  return front.count + static_cast<std::size_t>(found - front.boundary.begin());
}

}  // namespace

FactoredBody::FactoredBody(const ElasticBody& body, const Dissection& dissection, double shift, StageWatch& watch)
    : dissection_(dissection),
      blocks_(dissection.fronts.size()),
      updates_(dissection.fronts.size()),
      bad_(dissection.fronts.size(), 0) {
  std::map<std::size_t, std::vector<std::size_t>, std::greater<>> levels;
  for (std::size_t f = 0; f < dissection.fronts.size(); ++f) levels[dissection.fronts[f].depth].push_back(f);
  for (const auto& level : levels) {
    const std::vector<std::size_t>& fronts = level.second;
    watch.poll();
    watch.throw_if_stopped();
    const Progress nobody;
    StageWatch own(nobody, "calibrate");
    const auto factor = [&](std::size_t i) { factor_front(body, fronts[i], shift); };
    // Fronts of a level know nothing of each other; the few large ones share the threads among themselves.
    if (fronts.size() < 4) {
      for (std::size_t i = 0; i < fronts.size(); ++i) factor(i);
    } else {
      parallel_for(static_cast<std::int64_t>(fronts.size()), 1, own,
                   [&](std::int64_t i, std::int64_t) { factor(static_cast<std::size_t>(i)); });
    }
  }
  positive_ = std::none_of(bad_.begin(), bad_.end(), [](std::uint8_t bad) { return bad != 0; });
}

std::size_t FactoredBody::entry_count() const {
  std::size_t count = 0;
  for (const Block& block : blocks_) count += block.factor.size();
  return count;
}

void FactoredBody::factor_front(const ElasticBody& body, std::size_t index, double shift) {
  const Front& front = dissection_.fronts[index];
  const std::size_t n = 3 * (front.count + front.boundary.size()), own = 3 * front.count;
  std::vector<double> matrix(n * n, 0.0);
  for (std::size_t c = 0; c < front.count; ++c) {
    const std::size_t vertex = dissection_.order[front.first + c];
    const auto beside = body.neighbours(vertex);
    for (std::size_t i = 0; i < beside.size(); ++i) {
      const std::uint32_t place = dissection_.places[beside[i]];
      if (place < front.first) continue;
      const std::size_t r = row_of(front, place);
      const auto& block = body.stiffness_block(vertex, i);
      const double mass = shift * body.mass_entry(vertex, i);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          matrix[(3 * c + a) * n + 3 * r + b] += block[3 * a + b] + (a == b ? mass : 0.0);
    }
  }
  for (const std::size_t child : front.children) {
    const Front& below = dissection_.fronts[child];
    const std::vector<double>& update = updates_[child];
    const std::size_t count = below.boundary.size(), stride = 3 * count;
    std::vector<std::size_t> rows;
    for (const std::uint32_t place : below.boundary) rows.push_back(3 * row_of(front, place));
    for (std::size_t c = 0; c < count; ++c)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t r = c; r < count; ++r)
          for (std::size_t b = 0; b < 3; ++b)
            matrix[(rows[c] + a) * n + rows[r] + b] += update[(3 * c + a) * stride + 3 * r + b];
    updates_[child] = {};
  }
  if (!factor_columns(matrix, n, own)) bad_[index] = 1;
  blocks_[index].factor.assign(matrix.begin(), matrix.begin() + static_cast<std::ptrdiff_t>(n * own));
  std::vector<double>& update = updates_[index];
  update.resize((n - own) * (n - own));
  for (std::size_t c = own; c < n; ++c)
    std::copy(matrix.begin() + static_cast<std::ptrdiff_t>(c * n + own),
              matrix.begin() + static_cast<std::ptrdiff_t>((c + 1) * n),
              update.begin() + static_cast<std::ptrdiff_t>((c - own) * (n - own)));
}

NodalFields FactoredBody::solve(const NodalFields& right_sides) const {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  NodalFields result(right_sides.rows(), right_sides.columns);
  parallel_for(static_cast<std::int64_t>(right_sides.columns), static_cast<std::int64_t>(kSolveColumns), watch,
               [&](std::int64_t begin, std::int64_t end) {
                 solve_columns(right_sides, result, static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
               });
  return result;
}

namespace {

/// Rows of a front's part of the right sides, side by side; rows of `all` are `width` long.
void gather(const Front& front, const std::vector<double>& all, std::size_t width, std::vector<double>& local) {
  local.resize(3 * width * (front.count + front.boundary.size()));
  const std::size_t row = 3 * width;
  std::copy_n(&all[front.first * row], front.count * row, local.data());
  for (std::size_t i = 0; i < front.boundary.size(); ++i)
    std::copy_n(&all[front.boundary[i] * row], row, &local[(front.count + i) * row]);
}
void scatter(const Front& front, const std::vector<double>& local, std::size_t width, std::vector<double>& all) {
  const std::size_t row = 3 * width;
  std::copy_n(local.data(), front.count * row, &all[front.first * row]);
  for (std::size_t i = 0; i < front.boundary.size(); ++i)
    std::copy_n(&local[(front.count + i) * row], row, &all[front.boundary[i] * row]);
}

/// L x = b for a front's own rows; what they leave to its boundary is subtracted there.
void solve_down(const std::vector<double>& factor, std::size_t n, std::size_t own, std::size_t width, double* x) {
  for (std::size_t panel = 0; panel < own; panel += kSolvePanel) {
    const std::size_t end = std::min(own, panel + kSolvePanel);
    for (std::size_t c = panel; c < end; ++c) {
      const double inverse = 1 / factor[c * n + c];
      for (std::size_t k = 0; k < width; ++k) x[c * width + k] *= inverse;
      for (std::size_t i = c + 1; i < end; ++i)
        for (std::size_t k = 0; k < width; ++k) x[i * width + k] -= factor[c * n + i] * x[c * width + k];
    }
    kernel::subtract_product(x + end * width, width, width, n - end, x + panel * width, width,
                             {factor.data() + panel * n + end, n, 1}, end - panel);
  }
}

/// L^T x = b for a front's own rows, those of its boundary being solved.
void solve_up(const std::vector<double>& factor, std::size_t n, std::size_t own, std::size_t width, double* x) {
  for (std::size_t end = own; end > 0;) {
    const std::size_t panel = (end - 1) / kSolvePanel * kSolvePanel;
    kernel::subtract_product(x + panel * width, width, width, end - panel, x + end * width, width,
                             {factor.data() + panel * n + end, 1, n}, n - end);
    for (std::size_t c = end; c-- > panel;) {
      for (std::size_t i = c + 1; i < end; ++i)
        for (std::size_t k = 0; k < width; ++k) x[c * width + k] -= factor[c * n + i] * x[i * width + k];
      const double inverse = 1 / factor[c * n + c];
      for (std::size_t k = 0; k < width; ++k) x[c * width + k] *= inverse;
    }
    end = panel;
  }
}

}  // namespace

void FactoredBody::solve_columns(const NodalFields& from, NodalFields& to, std::size_t begin, std::size_t end) const {
  const std::size_t width = end - begin, vertices = dissection_.order.size();
  std::vector<double> all(3 * vertices * width), local;
  for (std::size_t place = 0; place < vertices; ++place)
    for (std::size_t a = 0; a < 3; ++a)
      std::copy_n(from.row(3 * std::size_t{dissection_.order[place]} + a) + begin, width,
                  &all[(3 * place + a) * width]);
  const auto pass = [&](std::size_t f, const auto& solve_front) {
    const Front& front = dissection_.fronts[f];
    if (front.count == 0) return;
    gather(front, all, width, local);
    solve_front(blocks_[f].factor, 3 * (front.count + front.boundary.size()), 3 * front.count, width, local.data());
    scatter(front, local, width, all);
  };
  for (std::size_t f = 0; f < dissection_.fronts.size(); ++f) pass(f, solve_down);
  for (std::size_t f = dissection_.fronts.size(); f-- > 0;) pass(f, solve_up);
  for (std::size_t place = 0; place < vertices; ++place)
    for (std::size_t a = 0; a < 3; ++a)
      std::copy_n(&all[(3 * place + a) * width], width, to.row(3 * std::size_t{dissection_.order[place]} + a) + begin);
}

}  // namespace tetsoup
