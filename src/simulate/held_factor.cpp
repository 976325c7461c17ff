#include "base/eigen_settings.h"

#include <Eigen/SparseCholesky>
#include <limits>

#include "simulate/held_solver.h"

namespace tetsoup::simulate {
namespace {

constexpr std::uint32_t kHeld = std::numeric_limits<std::uint32_t>::max();
using Sparse = Eigen::SparseMatrix<double>;
using Entry = Eigen::Triplet<double>;

/// mu V (g_i.g_j I + g_j g_i^T) + lambda V g_i g_j^T: of unturned linear elasticity.
Matrix3 stiffness(const Rest& rest, const HeldTet& tet, std::size_t i, std::size_t j) {
  const Vec3d &a = tet.gradients[i], &b = tet.gradients[j];
  const double mu = rest.shear_modulus() * tet.volume, lame = rest.lame() * tet.volume, both = mu * dot(a, b);
  Matrix3 k{{a * (mu * b.x) + b * (lame * a.x), a * (mu * b.y) + b * (lame * a.y), a * (mu * b.z) + b * (lame * a.z)}};
  k.rows[0].x += both;
  k.rows[1].y += both;
  k.rows[2].z += both;
  return k;
}

}  // namespace

struct HeldFactor::Factors {
  Eigen::SimplicialLDLT<Sparse> ldlt;
};

HeldFactor::HeldFactor(const Rest& rest, std::span<const HeldTet> tets, double h, double stiffer)
    : held_(rest.held), h_(h), stiffer_(stiffer), factors_(std::make_unique<Factors>()) {
  std::uint32_t count = 0;
  for (const std::uint8_t held : held_) numbers_.push_back(held != 0 ? kHeld : count++);
  std::vector<Entry> entries;
  const auto add = [&](std::uint32_t i, std::uint32_t j, const Matrix3& m) {
    for (int r = 0; r < 3; ++r) {
      const Vec3d& row = m.rows[static_cast<std::size_t>(r)];
      const int at = static_cast<int>(3 * i) + r, from = static_cast<int>(3 * j);
      entries.emplace_back(at, from, row.x);
      entries.emplace_back(at, from + 1, row.y);
      entries.emplace_back(at, from + 2, row.z);
    }
  };
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const Tet& tet = rest.piece.tets[t];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const std::uint32_t a = numbers_[tet[i]], b = numbers_[tet[j]];
        if (a == kHeld || b == kHeld || a < b) continue;  // the lower half
        Matrix3 k = stiffness(rest, tets[t], i, j);
        for (Vec3d& row : k.rows) row = row * stiffer;
        add(a, b, k);
      }
  }
  for (std::size_t v = 0; v < numbers_.size(); ++v) {
    if (numbers_[v] == kHeld) continue;
    const double m = 4 * rest.masses[v] / (h * h);
    add(numbers_[v], numbers_[v], {{{{m, 0, 0}, {0, m, 0}, {0, 0, m}}}});
  }
  Sparse matrix(static_cast<int>(3 * count), static_cast<int>(3 * count));
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (count > 0) factors_->ldlt.compute(matrix);
}

HeldFactor::~HeldFactor() = default;

bool HeldFactor::is_for(const Rest& rest, double h, double stiffer) const {
  return h == h_ && stiffer == stiffer_ && rest.held == held_;
}

void HeldFactor::solve(std::span<const Matrix3> turns, std::span<const Vec3d> right, std::span<Vec3d> left) const {
  Eigen::VectorXd values(factors_->ldlt.rows());
  for (std::size_t v = 0; v < numbers_.size(); ++v) {
    if (numbers_[v] == kHeld) continue;
    const Vec3d r = turns[v].column_times(right[v]);
    values.segment<3>(3 * static_cast<int>(numbers_[v])) << r.x, r.y, r.z;
  }
  if (values.size() > 0) values = factors_->ldlt.solve(values).eval();
  for (std::size_t v = 0; v < numbers_.size(); ++v) {
    left[v] = {};
    if (numbers_[v] == kHeld) continue;
    const auto at = values.segment<3>(3 * static_cast<int>(numbers_[v]));
    left[v] = turns[v] * Vec3d{at[0], at[1], at[2]};
  }
}

}  // namespace tetsoup::simulate
