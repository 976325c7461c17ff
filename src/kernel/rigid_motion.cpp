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

void predict(std::span<Place> places, std::span<Place> start, std::span<Motion> motions, const Vec3& kick, float h) {
  const Floats kx = set(kick.x), ky = set(kick.y), kz = set(kick.z), step = set(h);
  for_lanes(places.size(), [&](std::size_t i) {
    Columns p = load_block(&places[i].x), v = load_block(&motions[i].x);
    store_block(p, &start[i].x);
    const auto held = hn::Eq(p.w, set(0));
    v.x = hn::IfThenZeroElse(held, hn::Add(v.x, kx));
    v.y = hn::IfThenZeroElse(held, hn::Add(v.y, ky));
    v.z = hn::IfThenZeroElse(held, hn::Add(v.z, kz));
    store_block(v, &motions[i].x);
    p.x = hn::Add(p.x, hn::Mul(step, v.x));
    p.y = hn::Add(p.y, hn::Mul(step, v.y));
    p.z = hn::Add(p.z, hn::Mul(step, v.z));
    store_block(p, &places[i].x);
  });
}

std::size_t hold_back(std::span<Place> places, std::span<const Place> start, std::span<const Motion> motions,
                      float most, float h) {
  const Lanes d;
  const Floats step = set(h), farthest = set(most);
  std::size_t count = 0;
  for_lanes(places.size(), [&](std::size_t i) {
    Columns p = load_block(&places[i].x);
    const Columns from = load_block(&start[i].x), v = load_block(&motions[i].x);
    const Floats px = hn::Add(from.x, hn::Mul(step, v.x)), py = hn::Add(from.y, hn::Mul(step, v.y)),
                 pz = hn::Add(from.z, hn::Mul(step, v.z));
    const Floats x = hn::Sub(p.x, px), y = hn::Sub(p.y, py), z = hn::Sub(p.z, pz);
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
    p.x = held(p.x, px, x);
    p.y = held(p.y, py, y);
    p.z = held(p.z, pz, z);
    store_block(p, &places[i].x);
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

MotionSums sum_motion(std::span<const Place> places, std::span<const Place> start, std::span<const Motion> motions,
                      const Vec3& centre, float h) {
  const Lanes d;
  const Floats step = set(h);
  MotionSums total;
  // Lane l of sixteen takes the vertices l, l + 16, ..., however many lanes a register has.
  for (std::size_t lane = 0; lane < kPlaceBlock; lane += hn::Lanes(d)) {
    Floats sums[MotionSums::kCount];
    for (Floats& s : sums) s = hn::Zero(d);
    for (std::size_t i = lane; i < places.size(); i += kPlaceBlock) {
      const Columns p = load_block(&places[i].x), v = load_block(&motions[i].x);
      Columns r = load_block(&start[i].x);
      const Floats ux = hn::Sub(p.x, r.x), uy = hn::Sub(p.y, r.y), uz = hn::Sub(p.z, r.z);
      r = {hn::Sub(r.x, set(centre.x)), hn::Sub(r.y, set(centre.y)), hn::Sub(r.z, set(centre.z)), r.w};
      add_inertia(v.w, r, sums);
      add_moments(v.w, r, hn::Sub(hn::Mul(step, v.x), ux), hn::Sub(hn::Mul(step, v.y), uy),
                  hn::Sub(hn::Mul(step, v.z), uz), sums + MotionSums::Dx);
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

void correct_motion(std::span<Place> places, std::span<const Place> start, std::span<Motion> motions,
                    const Vec3& centre, const RigidDisplacement& correction, float h) {
  const Floats step = set(h);
  for_lanes(places.size(), [&](std::size_t i) {
    const Columns p = load_block(&places[i].x), from = load_block(&start[i].x);
    const Columns add = rigid(correction, {hn::Sub(from.x, set(centre.x)), hn::Sub(from.y, set(centre.y)),
                                           hn::Sub(from.z, set(centre.z)), from.w});
    const auto held = hn::Eq(p.w, set(0));
    const auto corrected = [&](Floats to, Floats at, Floats more) {
      return hn::IfThenZeroElse(held, hn::Add(hn::Sub(to, at), more));
    };
    const Floats ux = corrected(p.x, from.x, add.x), uy = corrected(p.y, from.y, add.y),
                 uz = corrected(p.z, from.z, add.z);
    const Floats mass = load_block(&motions[i].x).w;
    store_block({hn::Div(ux, step), hn::Div(uy, step), hn::Div(uz, step), mass}, &motions[i].x);
    store_block({hn::Add(from.x, ux), hn::Add(from.y, uy), hn::Add(from.z, uz), p.w}, &places[i].x);
  });
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(predict);
HWY_EXPORT(hold_back);
HWY_EXPORT(sum_motion);
HWY_EXPORT(correct_motion);

void predict(std::span<Place> places, std::span<Place> start, std::span<Motion> motions, const Vec3& kick, float h) {
  HWY_DYNAMIC_DISPATCH(predict)(places, start, motions, kick, h);
}

std::size_t hold_back(std::span<Place> places, std::span<const Place> start, std::span<const Motion> motions,
                      float most, float h) {
  return HWY_DYNAMIC_DISPATCH(hold_back)(places, start, motions, most, h);
}

MotionSums sum_motion(std::span<const Place> places, std::span<const Place> start, std::span<const Motion> motions,
                      const Vec3& centre, float h) {
  return HWY_DYNAMIC_DISPATCH(sum_motion)(places, start, motions, centre, h);
}

void correct_motion(std::span<Place> places, std::span<const Place> start, std::span<Motion> motions,
                    const Vec3& centre, const RigidDisplacement& correction, float h) {
  HWY_DYNAMIC_DISPATCH(correct_motion)(places, start, motions, centre, correction, h);
}

}  // namespace tetsoup::kernel
#endif
