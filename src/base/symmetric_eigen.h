// Eigenvalues and eigenvectors of small symmetric matrices.
#pragma once

#include <cstddef>
#include <vector>

namespace tetsoup {

struct SymmetricEigen {
  std::vector<double> values;   ///< (n) ascending.
  std::vector<double> vectors;  ///< (n, n), one a row, of length 1, in the order of the values.
};

/// O(n^3).
///
/// @param matrix  (n, n), of which the lower half is read.
SymmetricEigen symmetric_eigen(const std::vector<double>& matrix, std::size_t n);

}  // namespace tetsoup
