#include "kernel/clip_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/clip_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void clip_rows(const RowBounds& bounds, int rows, int layers, std::int32_t* begin, std::int32_t* end,
               std::uint8_t* some) {
  const hn::CappedTag<float, kRowGroup> f;
  const hn::RebindToSigned<decltype(f)> i;
  const auto lanes = static_cast<int>(hn::Lanes(f)), padded = kRowGroup * row_groups(rows);
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
      const auto low = hn::ConvertTo(i, lo);
      const auto rest = hn::VecFromMask(i, hn::RebindMask(i, hn::Lt(hn::ConvertTo(f, low), lo)));  // -1: round up
      const auto first = hn::Sub(low, rest), past = hn::Add(hn::ConvertTo(i, hi), hn::Set(i, 1));
      const auto left = hn::And(hn::RebindMask(i, hn::Le(lo, hi)), hn::Lt(first, past));
      hn::StoreU(hn::IfThenElseZero(left, first), i, begin);
      hn::StoreU(hn::IfThenElseZero(left, past), i, end);
      std::uint8_t bits = 0;
      hn::StoreMaskBits(i, left, &bits);
      const int offset = row % kRowGroup;
      some[row / kRowGroup] = static_cast<std::uint8_t>(offset == 0 ? bits : some[row / kRowGroup] | bits << offset);
    }
    some += row_groups(rows);
  }
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(clip_rows);

void clip_rows(const RowBounds& bounds, int rows, int layers, std::int32_t* begin, std::int32_t* end,
               std::uint8_t* some) {
  HWY_DYNAMIC_DISPATCH(clip_rows)(bounds, rows, layers, begin, end, some);
}

}  // namespace tetsoup::kernel
#endif
