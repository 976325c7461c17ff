#include "base/eigen_settings.h"
#include "base/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace tetsoup {

SymmetricEigen symmetric_eigen(const std::vector<double>& matrix, std::size_t n) {
  if (n == 0) return {};
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(matrix.data(),
                                                                                                      size, size);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rows);
  SymmetricEigen eigen;
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::VectorXd vector = solver.eigenvectors().col(i);
    eigen.values.push_back(solver.eigenvalues()[i]);
    eigen.vectors.insert(eigen.vectors.end(), vector.begin(), vector.end());
  }
  return eigen;
}

}  // namespace tetsoup
