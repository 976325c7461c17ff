// The inner loop of dense factorisations and of solves with many right sides: C -= A B.
#pragma once

#include <cstddef>

namespace tetsoup::kernel {

/// Where numbers of a matrix lie: entry (i, j) at data[i * down + j * across].
struct DenseView {
  const double* data;
  std::size_t down, across;
};

/// C -= A B. The entries of a column of C, and of A, lie side by side. Every entry subtracts its products in the order
/// of the depth, one rounding each: the same bits on every instruction set, however C is divided.
///
/// @param c     rows x columns, columns `c_stride` apart.
/// @param a     rows x depth, columns `a_stride` apart; may not overlap c.
/// @param b     depth x columns.
void subtract_product(double* c, std::size_t c_stride, std::size_t rows, std::size_t columns, const double* a,
                      std::size_t a_stride, const DenseView& b, std::size_t depth);

}  // namespace tetsoup::kernel
