#include "kernel/event_masks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/event_masks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;  // so that 64 values are whole vectors everywhere
constexpr std::size_t kMargin = 16, kBlock = 64;
/// A row with its neighbours' nearest values, such that voxel i is at kMargin + i.
using PaddedRow = float[kMargin + kBlock + kMargin];

/// Bits of mask_at(x), the mask of the vector of voxels that begins at x, into word bytes x / 8 and on, for 8 voxels or
/// a vector, whichever is more.
template <class MaskAt>
HWY_INLINE void store_bits(Floats d, std::size_t x, std::uint8_t* word, const MaskAt& mask_at) {
  const std::size_t lanes = hn::Lanes(d);
  if (lanes >= 8) {
    hn::StoreMaskBits(d, mask_at(x), word + x / 8);
    return;
  }
  std::uint8_t byte = 0;
  for (std::size_t i = 0; i < 8; i += lanes) {
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(d, mask_at(x + i), part);
    byte = static_cast<std::uint8_t>(byte | part[0] << i);
  }
  word[x / 8] = byte;
}

HWY_INLINE void find_axis_events(Floats d, std::size_t x, const float* here, const float* next, const float* previous,
                                 AxisEvents& events) {
  store_bits(d, x, reinterpret_cast<std::uint8_t*>(&events.ahead), [&](std::size_t i) HWY_ATTR {
    return hn::Ge(hn::LoadU(d, next + i), hn::Max(hn::LoadU(d, here + i), hn::LoadU(d, previous + i)));
  });
  store_bits(d, x, reinterpret_cast<std::uint8_t*>(&events.behind), [&](std::size_t i) HWY_ATTR {
    return hn::Ge(hn::LoadU(d, previous + i), hn::Max(hn::LoadU(d, here + i), hn::LoadU(d, next + i)));
  });
  store_bits(d, x, reinterpret_cast<std::uint8_t*>(&events.lowest), [&](std::size_t i) HWY_ATTR {
    return hn::Ge(hn::Min(hn::LoadU(d, next + i), hn::LoadU(d, previous + i)), hn::LoadU(d, here + i));
  });
}

HWY_ATTR void find_events(const BlockNeighbours& around, WordEvents& events) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d), step = lanes < 8 ? 8 : lanes;
  HWY_ALIGN PaddedRow rows[9];
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t x = 0; x < kBlock; x += lanes)
      hn::StoreU(hn::LoadU(d, around.rows[r] + x), d, rows[r] + kMargin + x);
    rows[r][kMargin - 1] = around.before[r];
    rows[r][kMargin + kBlock] = around.after[r];
  }
  const float* here = rows[4] + kMargin;
  for (std::size_t x = 0; x < kBlock; x += step) {
    find_axis_events(d, x, here, here + 1, here - 1, events.along_x);
    for (std::size_t kind = 0; kind < kSheetKinds; ++kind) {
      const int stride = 3 * kSheetSteps[kind][1] + kSheetSteps[kind][0];
      const float *next = rows[4 + stride] + kMargin, *previous = rows[4 - stride] + kMargin;
      for (int dx = -1; dx <= 1; ++dx)
        find_axis_events(d, x, here, next + dx, previous - dx, events.sheets[kind][static_cast<std::size_t>(dx + 1)]);
    }
  }
}

HWY_ATTR void find_below(const float* block, const float* limits, std::size_t count, std::uint64_t* bits) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d), step = lanes < 8 ? 8 : lanes;
  for (std::size_t x = 0; x < kBlock; x += step) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto limit = hn::Set(d, limits[i]);
      store_bits(d, x, reinterpret_cast<std::uint8_t*>(bits + i),
                 [&](std::size_t at) HWY_ATTR { return hn::Lt(hn::LoadU(d, block + at), limit); });
    }
  }
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <bit>

namespace tetsoup::kernel {

static_assert(std::endian::native == std::endian::little, "bits of a mask are stored byte by byte");

HWY_EXPORT(find_events);
HWY_EXPORT(find_below);

WordEvents find_events(const BlockNeighbours& around) {
  WordEvents events;
  HWY_DYNAMIC_DISPATCH(find_events)(around, events);
  return events;
}

void find_below(const float* block, const float* limits, std::size_t count, std::uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(find_below)(block, limits, count, bits);
}

}  // namespace tetsoup::kernel

#endif
