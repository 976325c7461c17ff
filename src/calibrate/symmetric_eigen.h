// All eigenvalues and eigenvectors of a small symmetric matrix.
#pragma once

#include <cstddef>
#include <vector>

namespace tetsoup {

struct SymmetricEigen {
  std::vector<double> values;   ///< (n) ascending.
  std::vector<double> vectors;  ///< (n, n), one a row, of length 1.
};

/// Householder's reduction to three diagonals, then QL with Wilkinson's shifts. O(n^3); no elementary function but
/// sqrt.
///
/// @param matrix  (n, n), of which the lower half is read.
SymmetricEigen symmetric_eigen(std::vector<double> matrix, std::size_t n);

}  // namespace tetsoup
