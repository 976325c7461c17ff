#include "kernel/clip_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/clip_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void clip_rows(const RowBounds& bounds, int rows, int layers, std::int32_t* begin, std::int32_t* end) {
  const hn::CappedTag<float, kRowGroup> f;
  const hn::RebindToSigned<decltype(f)> i;
  const auto lanes = static_cast<int>(hn::Lanes(f)), padded = padded_rows(rows);
  const auto last = hn::Set(f, static_cast<float>(bounds.width - 1));
  for (int z = 0; z < layers; ++z) {
    const auto fz = static_cast<float>(z);
    for (int row = 0; row < padded; row += lanes, begin += lanes, end += lanes) {
      const auto y = hn::ConvertTo(f, hn::Iota(i, row));
      const auto at = [&](const RowBound& b) {
        return hn::Add(hn::Set(f, b.at + b.z * fz), hn::Mul(hn::Set(f, b.y), y));
      };
      auto lo = hn::Zero(f), hi = last;
      for (const RowBound& b : bounds.lower) lo = hn::Max(lo, at(b));
      for (const RowBound& b : bounds.upper) hi = hn::Min(hi, at(b));
      const auto some = hn::RebindMask(i, hn::Le(lo, hi));
      const auto low = hn::ConvertTo(i, lo);
      const auto rest = hn::VecFromMask(i, hn::RebindMask(i, hn::Lt(hn::ConvertTo(f, low), lo)));  // -1: round up
      hn::StoreU(hn::IfThenElseZero(some, hn::Sub(low, rest)), i, begin);
      hn::StoreU(hn::IfThenElseZero(some, hn::Add(hn::ConvertTo(i, hi), hn::Set(i, 1))), i, end);
    }
  }
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(clip_rows);

void clip_rows(const RowBounds& bounds, int rows, int layers, std::int32_t* begin, std::int32_t* end) {
  HWY_DYNAMIC_DISPATCH(clip_rows)(bounds, rows, layers, begin, end);
}

}  // namespace tetsoup::kernel
#endif
