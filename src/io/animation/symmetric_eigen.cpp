#include "io/animation/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace tetsoup::animation {

EigenSystem symmetric_eigen(const std::vector<double>& matrix, std::size_t n) {
  if (n == 0) return {};
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::Map<const Eigen::MatrixXd>(matrix.data(), size, size));
  EigenSystem system;
  for (Eigen::Index i = size - 1; i >= 0; --i) {  // Eigen's ascend.
    const Eigen::VectorXd vector = solver.eigenvectors().col(i);
    system.values.push_back(solver.eigenvalues()[i]);
    system.vectors.insert(system.vectors.end(), vector.begin(), vector.end());
  }
  return system;
}

}  // namespace tetsoup::animation
