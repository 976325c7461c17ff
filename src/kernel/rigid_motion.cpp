#include "kernel/rigid_motion.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/rigid_motion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernel/load_places-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct Columns {
  Floats x, y, z, w;
};
HWY_INLINE Columns load_block(const float* from) {
  Columns c;
  hn::LoadInterleaved4(Lanes(), from, c.x, c.y, c.z, c.w);
  return c;
}
HWY_INLINE void store_block(const Columns& c, float* to) {
  hn::StoreInterleaved4(c.x, c.y, c.z, c.w, Lanes(), to);
}

/// body(i): for the vertices from i on, as many as there are lanes.
template <class Body>
HWY_INLINE void for_lanes(std::size_t count, const Body& body) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(Lanes())) body(i);
}

/// a + b, and what that lacks in `lost` [Knuth].
HWY_INLINE Floats sum_of(Floats a, Floats b, Floats& lost) {
  const Floats sum = hn::Add(a, b), added = hn::Sub(sum, a);
  lost = hn::Add(hn::Sub(a, hn::Sub(sum, added)), hn::Sub(b, added));
  return sum;
}

/// Places and remainders from i on.
HWY_INLINE Columns arrive_at(const Movers& m, std::size_t i) {
  Columns p = load_block(&m.places[i].x), r = load_block(&m.remainders[i].x);
  const Columns u = load_block(&m.moves[i].x);
  p.x = sum_of(p.x, hn::Add(u.x, r.x), r.x);
  p.y = sum_of(p.y, hn::Add(u.y, r.y), r.y);
  p.z = sum_of(p.z, hn::Add(u.z, r.z), r.z);
  store_block(p, &m.places[i].x);
  store_block(r, &m.remainders[i].x);
  return p;
}

void arrive(const Movers& m) {
  for_lanes(m.places.size(), [&](std::size_t i) {
    const Floats none = hn::Zero(Lanes());
    store_block({none, none, none, arrive_at(m, i).w}, &m.moves[i].x);
  });
}

void predict(const Movers& m, const Vec3& kick, float h) {
  const Floats kx = set(kick.x), ky = set(kick.y), kz = set(kick.z), step = set(h);
  for_lanes(m.places.size(), [&](std::size_t i) {
    const Columns p = arrive_at(m, i);
    Columns v = load_block(&m.motions[i].x);
    const auto held = hn::Eq(p.w, set(0));
    v.x = hn::IfThenZeroElse(held, hn::Add(v.x, kx));
    v.y = hn::IfThenZeroElse(held, hn::Add(v.y, ky));
    v.z = hn::IfThenZeroElse(held, hn::Add(v.z, kz));
    store_block(v, &m.motions[i].x);
    store_block({hn::Mul(step, v.x), hn::Mul(step, v.y), hn::Mul(step, v.z), p.w}, &m.moves[i].x);
  });
}

std::size_t hold_back(std::span<Offset> moves, std::span<const Motion> motions, float most, float h) {
  const Lanes d;
  const Floats step = set(h), farthest = set(most);
  std::size_t count = 0;
  for_lanes(moves.size(), [&](std::size_t i) {
    Columns u = load_block(&moves[i].x);
    const Columns v = load_block(&motions[i].x);
    const Floats px = hn::Mul(step, v.x), py = hn::Mul(step, v.y), pz = hn::Mul(step, v.z);
    const Floats x = hn::Sub(u.x, px), y = hn::Sub(u.y, py), z = hn::Sub(u.z, pz);
    const Floats square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    const auto near = hn::Le(square, hn::Mul(farthest, farthest));  // false where it is no number
    if (hn::AllTrue(d, near)) return;
    count += hn::Lanes(d) - hn::CountTrue(d, near);
    // Of what is no number, or beyond the range of numbers, nothing is left.
    const auto known = hn::Le(square, set(std::numeric_limits<float>::max()));
    const Floats scale = hn::IfThenElseZero(known, hn::Div(farthest, hn::Sqrt(square)));
    const auto held = [&](Floats at, Floats predicted, Floats off) {
      const Floats back = hn::Add(predicted, hn::IfThenElseZero(known, hn::Mul(scale, off)));
      return hn::IfThenElse(near, at, back);
    };
    u.x = held(u.x, px, x);
    u.y = held(u.y, py, y);
    u.z = held(u.z, pz, z);
    store_block(u, &moves[i].x);
  });
  return count;
}

/// Adds mass times d, and mass times r x d, to six sums.
HWY_INLINE void add_moments(Floats mass, const Columns& r, Floats dx, Floats dy, Floats dz, Floats* sums) {
  dx = hn::Mul(mass, dx);
  dy = hn::Mul(mass, dy);
  dz = hn::Mul(mass, dz);
  sums[0] = hn::Add(sums[0], dx);
  sums[1] = hn::Add(sums[1], dy);
  sums[2] = hn::Add(sums[2], dz);
  sums[3] = hn::Add(sums[3], hn::Sub(hn::Mul(r.y, dz), hn::Mul(r.z, dy)));
  sums[4] = hn::Add(sums[4], hn::Sub(hn::Mul(r.z, dx), hn::Mul(r.x, dz)));
  sums[5] = hn::Add(sums[5], hn::Sub(hn::Mul(r.x, dy), hn::Mul(r.y, dx)));
}
HWY_INLINE void add_inertia(Floats mass, const Columns& r, Floats* sums) {
  const Floats x = hn::Mul(mass, r.x), y = hn::Mul(mass, r.y), z = hn::Mul(mass, r.z);
  const Floats terms[10] = {
      mass,           x, y, z, hn::Mul(x, r.x), hn::Mul(y, r.y), hn::Mul(z, r.z), hn::Mul(x, r.y), hn::Mul(x, r.z),
      hn::Mul(y, r.z)};
  for (int i = 0; i < 10; ++i) sums[i] = hn::Add(sums[i], terms[i]);
}

MotionSums sum_motion(const Movers& m, const Vec3& centre, float h) {
  const Lanes d;
  const Floats step = set(h);
  MotionSums total;
  // Lane l of sixteen takes the vertices l, l + 16, ..., however many lanes a register has.
  for (std::size_t lane = 0; lane < kPlaceBlock; lane += hn::Lanes(d)) {
    Floats sums[MotionSums::kCount];
    for (Floats& s : sums) s = hn::Zero(d);
    for (std::size_t i = lane; i < m.places.size(); i += kPlaceBlock) {
      const Columns u = load_block(&m.moves[i].x), v = load_block(&m.motions[i].x);
      Columns r = load_block(&m.places[i].x);
      r = {hn::Sub(r.x, set(centre.x)), hn::Sub(r.y, set(centre.y)), hn::Sub(r.z, set(centre.z)), r.w};
      add_inertia(v.w, r, sums);
      add_moments(v.w, r, hn::Sub(hn::Mul(step, v.x), u.x), hn::Sub(hn::Mul(step, v.y), u.y),
                  hn::Sub(hn::Mul(step, v.z), u.z), sums + MotionSums::Dx);
    }
    alignas(64) std::array<float, kPlaceBlock> lanes;
    for (int s = 0; s < MotionSums::kCount; ++s) {
      hn::Store(sums[s], d, lanes.data());
      for (std::size_t l = 0; l < hn::Lanes(d); ++l)
        total.values[static_cast<std::size_t>(s)] += static_cast<double>(lanes[l]);
    }
  }
  return total;
}

/// t + turn x r, by components.
HWY_INLINE Columns rigid(const RigidDisplacement& m, const Columns& r) {
  const auto entry = [](float t, float a, Floats v, float b, Floats w) {
    return hn::Add(set(t), hn::Sub(hn::Mul(set(a), v), hn::Mul(set(b), w)));
  };
  return {entry(m.t.x, m.turn.y, r.z, m.turn.z, r.y), entry(m.t.y, m.turn.z, r.x, m.turn.x, r.z),
          entry(m.t.z, m.turn.x, r.y, m.turn.y, r.x), r.w};
}

void correct_motion(const Movers& m, const Vec3& centre, const RigidDisplacement& correction, float h) {
  const Floats step = set(h);
  for_lanes(m.places.size(), [&](std::size_t i) {
    const Columns at = load_block(&m.places[i].x), u = load_block(&m.moves[i].x), v = load_block(&m.motions[i].x);
    const Columns add = rigid(
        correction, {hn::Sub(at.x, set(centre.x)), hn::Sub(at.y, set(centre.y)), hn::Sub(at.z, set(centre.z)), at.w});
    const auto held = hn::Eq(at.w, set(0));
    const auto change = [&](Floats to, Floats velocity, Floats more) {
      return hn::IfThenZeroElse(held, hn::Add(hn::Sub(to, hn::Mul(step, velocity)), more));
    };
    const Floats x = change(u.x, v.x, add.x), y = change(u.y, v.y, add.y), z = change(u.z, v.z, add.z);
    store_block({hn::Add(hn::Mul(step, v.x), x), hn::Add(hn::Mul(step, v.y), y), hn::Add(hn::Mul(step, v.z), z), at.w},
                &m.moves[i].x);
    store_block({hn::Add(v.x, hn::Div(x, step)), hn::Add(v.y, hn::Div(y, step)), hn::Add(v.z, hn::Div(z, step)), v.w},
                &m.motions[i].x);
  });
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(arrive);
HWY_EXPORT(predict);
HWY_EXPORT(hold_back);
HWY_EXPORT(sum_motion);
HWY_EXPORT(correct_motion);

void arrive(const Movers& movers) {
  HWY_DYNAMIC_DISPATCH(arrive)(movers);
}

void predict(const Movers& movers, const Vec3& kick, float h) {
  HWY_DYNAMIC_DISPATCH(predict)(movers, kick, h);
}

std::size_t hold_back(std::span<Offset> moves, std::span<const Motion> motions, float most, float h) {
  return HWY_DYNAMIC_DISPATCH(hold_back)(moves, motions, most, h);
}

MotionSums sum_motion(const Movers& movers, const Vec3& centre, float h) {
  return HWY_DYNAMIC_DISPATCH(sum_motion)(movers, centre, h);
}

void correct_motion(const Movers& movers, const Vec3& centre, const RigidDisplacement& correction, float h) {
  HWY_DYNAMIC_DISPATCH(correct_motion)(movers, centre, correction, h);
}

}  // namespace tetsoup::kernel
#endif
