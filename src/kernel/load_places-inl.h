// Places as vectors of x, y, z and inverse mass; included by kernels once for every instruction set.
#if defined(TETSOUP_KERNEL_LOAD_PLACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETSOUP_KERNEL_LOAD_PLACES_INL_H
#undef TETSOUP_KERNEL_LOAD_PLACES_INL_H
#else
#define TETSOUP_KERNEL_LOAD_PLACES_INL_H
#endif

#include <array>
#include <cstdint>
#include <hwy/highway.h>

#include "kernel/places.h"

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kPlaceBlock>;
using Floats = hn::Vec<Lanes>;

HWY_INLINE Floats set(float v) {
  return hn::Set(Lanes(), v);
}

struct Places {
  Floats x, y, z, inverse_mass;
};
using Corners = Places[4];

#if HWY_HAVE_SCALABLE || HWY_TARGET == HWY_SCALAR

template <class P>
HWY_INLINE Places load_places(const P* places, const std::uint32_t* at) {
  const Lanes d;
  alignas(64) std::array<P, kPlaceBlock> copy;
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) copy[i] = places[at[i]];
  Places p;
  hn::LoadInterleaved4(d, &copy[0].x, p.x, p.y, p.z, p.inverse_mass);
  return p;
}
template <class P>
HWY_INLINE void store_places(const Places& p, P* places, const std::uint32_t* at) {
  const Lanes d;
  alignas(64) std::array<P, kPlaceBlock> copy;
  hn::StoreInterleaved4(p.x, p.y, p.z, p.inverse_mass, d, &copy[0].x);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) places[at[i]] = copy[i];
}

#else

/// Turns rows (x y z w) of four places in each block of four lanes into columns, and back.
HWY_INLINE void transpose(Floats& a, Floats& b, Floats& c, Floats& e) {
  const Lanes d;
  const hn::Repartition<double, Lanes> pairs;
  const auto ab = hn::BitCast(pairs, hn::InterleaveLower(d, a, b)),
             ab_upper = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto ce = hn::BitCast(pairs, hn::InterleaveLower(d, c, e)),
             ce_upper = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  a = hn::BitCast(d, hn::InterleaveLower(pairs, ab, ce));
  b = hn::BitCast(d, hn::InterleaveUpper(pairs, ab, ce));
  c = hn::BitCast(d, hn::InterleaveLower(pairs, ab_upper, ce_upper));
  e = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_upper, ce_upper));
}

using Four = hn::FixedTag<float, 4>;

/// A row of every fourth place, one in each block.
template <class D, class P>
HWY_INLINE hn::Vec<D> load_rows([[maybe_unused]] D d, const P* places, const std::uint32_t* at) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::Load(Four(), &places[at[0]].x);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load_rows(half, places, at + hn::MaxLanes(half)), load_rows(half, places, at));
  }
}
template <class D, class P>
HWY_INLINE void store_rows([[maybe_unused]] D d, hn::Vec<D> rows, P* places, const std::uint32_t* at) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    hn::Store(rows, Four(), &places[at[0]].x);
  } else {
    const hn::Half<D> half;
    store_rows(half, hn::LowerHalf(half, rows), places, at);
    store_rows(half, hn::UpperHalf(half, rows), places, at + hn::MaxLanes(half));
  }
}

/// The places at[0], at[1], ... one a lane.
template <class P>
HWY_INLINE Places load_places(const P* places, const std::uint32_t* at) {
  const Lanes d;
  Places p{load_rows(d, places, at), load_rows(d, places, at + 1), load_rows(d, places, at + 2),
           load_rows(d, places, at + 3)};
  transpose(p.x, p.y, p.z, p.inverse_mass);
  return p;
}
template <class P>
HWY_INLINE void store_places(Places p, P* places, const std::uint32_t* at) {
  const Lanes d;
  transpose(p.x, p.y, p.z, p.inverse_mass);
  store_rows(d, p.x, places, at);
  store_rows(d, p.y, places, at + 1);
  store_rows(d, p.z, places, at + 2);
  store_rows(d, p.inverse_mass, places, at + 3);
}

#endif

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
