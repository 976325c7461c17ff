#include "smooth/fairing.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>

#include "base/vec.h"

namespace tetsoup {

namespace {

constexpr double kResidual = 1e-9;   // Of the right side's length: below what a float position can tell apart.
constexpr int kMaxIterations = 300;  // A time step of 1 takes about 15; only absurdly long steps end here, unconverged.

/// Solves (weight K + diagonal) x = right_side.
Eigen::MatrixXd solve(const Eigen::SparseMatrix<double>& stiffness, double weight, const Eigen::VectorXd& diagonal,
                      const Eigen::MatrixXd& right_side) {
  Eigen::SparseMatrix<double> system = weight * stiffness;
  system.diagonal() += diagonal;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(system);
  solver.setTolerance(kResidual);
  solver.setMaxIterations(kMaxIterations);
  return solver.solve(right_side);
}

}  // namespace

BoundaryFlow::BoundaryFlow(const Connectivity& links) {
  const auto count = static_cast<Eigen::Index>(links.boundary.size());
  valence_.resize(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < count; ++row) {
    const auto neighbours = links.boundary_neighbours[links.boundary[static_cast<std::size_t>(row)]];
    valence_[row] = static_cast<double>(neighbours.size());
    entries.emplace_back(row, row, valence_[row]);
    for (const std::uint32_t neighbour : neighbours) {
      const auto found = std::lower_bound(links.boundary.begin(), links.boundary.end(), neighbour);
      entries.emplace_back(row, found - links.boundary.begin(), -1.0);
    }
  }
  stiffness_.resize(count, count);
  stiffness_.setFromTriplets(entries.begin(), entries.end());
}

std::vector<Vec3d> BoundaryFlow::fair(const std::vector<Vec3d>& positions, double time) const {
  if (positions.empty()) return {};
  // Solved for x' - x, whose right side -t K x does not change with the origin: no digits are lost far away from it.
  Eigen::MatrixXd from(static_cast<Eigen::Index>(positions.size()), 3);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3d p = positions[i] - positions[0];
    from.row(static_cast<Eigen::Index>(i)) << p.x, p.y, p.z;
  }
  const double weight = time / (1 + time);  // The equation divided by 1 + t, so that no time step overflows.
  const Eigen::MatrixXd moves = solve(stiffness_, weight, valence_ / (1 + time), -weight * (stiffness_ * from));
  std::vector<Vec3d> result(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    result[i] = {moves(row, 0), moves(row, 1), moves(row, 2)};
  }
  return result;
}

std::vector<double> BoundaryFlow::spread(const std::vector<double>& volumes, const std::vector<double>& areas,
                                         double time) const {
  const auto count = static_cast<Eigen::Index>(volumes.size());
  const Eigen::Map<const Eigen::VectorXd> volume(volumes.data(), count), area(areas.data(), count);
  const double total = area.sum();
  if (!(total > 0)) return std::vector<double>(volumes.size(), 0.0);
  const Eigen::VectorXd layer = solve(stiffness_, time * total / valence_.sum(), area, volume).col(0);
  return {layer.data(), layer.data() + count};
}

}  // namespace tetsoup
