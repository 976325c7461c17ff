#include "kernel/cone_reach.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/cone_reach.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::array<float, 4> cone_reach(const UpDown& directions, std::span<const HalfSpace> half_spaces, float radius) {
  constexpr int kRounds = 3;
  const hn::CappedTag<float, 4> f;
  std::array<float, 4> out{};
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(f)) {
    auto rx = hn::LoadU(f, directions.x.data() + lane), ry = hn::LoadU(f, directions.y.data() + lane),
         rz = hn::LoadU(f, directions.z.data() + lane);
    auto reached = hn::Zero(f);
    for (int round = 0; round < kRounds; ++round) {
      auto weight = hn::Zero(f), x = weight, y = weight, z = weight, limit = weight;  // of the normal nearest the rest
      for (const HalfSpace& h : half_spaces) {
        const auto nx = hn::Set(f, h.normal.x), ny = hn::Set(f, h.normal.y), nz = hn::Set(f, h.normal.z);
        const auto w = hn::Add(hn::Add(hn::Mul(rx, nx), hn::Mul(ry, ny)), hn::Mul(rz, nz));
        const auto nearer = hn::Gt(w, weight);
        weight = hn::IfThenElse(nearer, w, weight);
        x = hn::IfThenElse(nearer, nx, x);
        y = hn::IfThenElse(nearer, ny, y);
        z = hn::IfThenElse(nearer, nz, z);
        limit = hn::IfThenElse(nearer, hn::Set(f, h.limit), limit);
      }
      reached = hn::Add(reached, hn::Mul(weight, limit));
      rx = hn::Sub(rx, hn::Mul(weight, x));
      ry = hn::Sub(ry, hn::Mul(weight, y));
      rz = hn::Sub(rz, hn::Mul(weight, z));
    }
    const auto rest = hn::Sqrt(hn::Add(hn::Add(hn::Mul(rx, rx), hn::Mul(ry, ry)), hn::Mul(rz, rz)));
    hn::StoreU(hn::Add(reached, hn::Mul(rest, hn::Set(f, radius))), f, out.data() + lane);
  }
  return out;
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(cone_reach);

std::array<float, 4> cone_reach(const UpDown& directions, std::span<const HalfSpace> half_spaces, float radius) {
  return HWY_DYNAMIC_DISPATCH(cone_reach)(directions, half_spaces, radius);
}

}  // namespace tetsoup::kernel
#endif
