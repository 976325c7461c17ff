// Eigenvectors of small symmetric matrices.
#pragma once

#include <cstddef>
#include <vector>

namespace tetsoup::animation {

struct EigenSystem {
  std::vector<double> values;   ///< Descending.
  std::vector<double> vectors;  ///< Unit vectors, one after the other, in the order of the values.
};

/// @param matrix  n x n.
EigenSystem symmetric_eigen(const std::vector<double>& matrix, std::size_t n);

}  // namespace tetsoup::animation
