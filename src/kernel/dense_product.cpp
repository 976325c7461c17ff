#include "kernel/dense_product.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/dense_product.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_HAVE_FLOAT64  // vectors of WebAssembly have none
using Doubles = hn::ScalableTag<double>;

/// Rows of kVectors vectors from `c` on, kColumns columns: held in registers over the whole depth.
template <std::size_t kVectors, std::size_t kColumns>
HWY_INLINE void subtract_tile(double* c, std::size_t c_stride, const double* a, std::size_t a_stride,
                              const DenseView& b, std::size_t depth) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<Doubles> sums[kColumns][kVectors];
  for (std::size_t j = 0; j < kColumns; ++j)
    for (std::size_t v = 0; v < kVectors; ++v) sums[j][v] = hn::LoadU(d, c + j * c_stride + v * lanes);
  for (std::size_t k = 0; k < depth; ++k) {
    hn::Vec<Doubles> left[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) left[v] = hn::LoadU(d, a + k * a_stride + v * lanes);
    for (std::size_t j = 0; j < kColumns; ++j) {
      const auto right = hn::Set(d, b.data[k * b.down + j * b.across]);
      for (std::size_t v = 0; v < kVectors; ++v) sums[j][v] = hn::Sub(sums[j][v], hn::Mul(left[v], right));
    }
  }
  for (std::size_t j = 0; j < kColumns; ++j)
    for (std::size_t v = 0; v < kVectors; ++v) hn::StoreU(sums[j][v], d, c + j * c_stride + v * lanes);
}
#endif

template <std::size_t kColumns>
HWY_INLINE void subtract_columns(double* c, std::size_t c_stride, std::size_t rows, const double* a,
                                 std::size_t a_stride, const DenseView& b, std::size_t depth) {
  std::size_t i = 0;
#if HWY_HAVE_FLOAT64
  const std::size_t lanes = hn::Lanes(Doubles());
  for (; i + 2 * lanes <= rows; i += 2 * lanes) subtract_tile<2, kColumns>(c + i, c_stride, a + i, a_stride, b, depth);
  for (; i + lanes <= rows; i += lanes) subtract_tile<1, kColumns>(c + i, c_stride, a + i, a_stride, b, depth);
#endif
  for (; i < rows; ++i)
    for (std::size_t j = 0; j < kColumns; ++j) {
      double sum = c[i + j * c_stride];
      for (std::size_t k = 0; k < depth; ++k) sum -= a[i + k * a_stride] * b.data[k * b.down + j * b.across];
      c[i + j * c_stride] = sum;
    }
}

void subtract_product(double* c, std::size_t c_stride, std::size_t rows, std::size_t columns, const double* a,
                      std::size_t a_stride, const DenseView& b, std::size_t depth) {
  std::size_t j = 0;
  for (; j + 4 <= columns; j += 4)
    subtract_columns<4>(c + j * c_stride, c_stride, rows, a, a_stride, {b.data + j * b.across, b.down, b.across},
                        depth);
  for (; j < columns; ++j)
    subtract_columns<1>(c + j * c_stride, c_stride, rows, a, a_stride, {b.data + j * b.across, b.down, b.across},
                        depth);
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(subtract_product);

void subtract_product(double* c, std::size_t c_stride, std::size_t rows, std::size_t columns, const double* a,
                      std::size_t a_stride, const DenseView& b, std::size_t depth) {
  HWY_DYNAMIC_DISPATCH(subtract_product)(c, c_stride, rows, columns, a, a_stride, b, depth);
}

}  // namespace tetsoup::kernel
#endif
