#include "kernel/relax_tets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/relax_tets.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernel/load_places-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct Vector {
  Floats x, y, z;
};
struct Matrix {
  Vector rows[3];
};

HWY_INLINE Vector minus(const Vector& a, const Vector& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Floats dot(const Vector& a, const Vector& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Vector times(const Matrix& m, const Vector& v) {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}
HWY_INLINE Vector load_vector(const TetLanes* from, std::size_t lane) {
  const Lanes d;
  return {hn::Load(d, from[0] + lane), hn::Load(d, from[1] + lane), hn::Load(d, from[2] + lane)};
}

/// a (x) g1 + b (x) g2 + c (x) g3, of which one row.
HWY_INLINE Vector gradient_row(Floats a, Floats b, Floats c, const Vector* g) {
  const auto entry = [&](Floats g1, Floats g2, Floats g3) {
    return hn::Add(hn::Add(hn::Mul(a, g1), hn::Mul(b, g2)), hn::Mul(c, g3));
  };
  return {entry(g[0].x, g[1].x, g[2].x), entry(g[0].y, g[1].y, g[2].y), entry(g[0].z, g[1].z, g[2].z)};
}
HWY_INLINE Vector edge_of(const Corners& p, int i) {
  return {hn::Sub(p[i].x, p[0].x), hn::Sub(p[i].y, p[0].y), hn::Sub(p[i].z, p[0].z)};
}
HWY_INLINE Matrix gradient_of(const Vector& a, const Vector& b, const Vector& c, const Vector* g) {
  return {{gradient_row(a.x, b.x, c.x, g), gradient_row(a.y, b.y, c.y, g), gradient_row(a.z, b.z, c.z, g)}};
}

HWY_INLINE Matrix gradient_of(const Corners& p, const Vector* g) {
  return gradient_of(edge_of(p, 1), edge_of(p, 2), edge_of(p, 3), g);
}
HWY_INLINE Vector plus(const Vector& a, const Vector& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Matrix plus(const Matrix& a, const Matrix& b) {
  return {{plus(a.rows[0], b.rows[0]), plus(a.rows[1], b.rows[1]), plus(a.rows[2], b.rows[2])}};
}
/// Of places and what they lack.
HWY_INLINE Matrix gradient_of(const Corners& p, const Corners& more, const Vector* g) {
  const auto edge = [&](int i) { return plus(edge_of(p, i), edge_of(more, i)); };
  return gradient_of(edge(1), edge(2), edge(3), g);
}

struct Quaternion {
  Floats x, y, z, w;
};
HWY_INLINE Matrix to_matrix(const Quaternion& q) {
  const Floats one = set(1);
  const Floats x2 = hn::Add(q.x, q.x), y2 = hn::Add(q.y, q.y), z2 = hn::Add(q.z, q.z);
  const Floats xx = hn::Mul(q.x, x2), yy = hn::Mul(q.y, y2), zz = hn::Mul(q.z, z2);
  const Floats xy = hn::Mul(q.x, y2), xz = hn::Mul(q.x, z2), yz = hn::Mul(q.y, z2);
  const Floats wx = hn::Mul(q.w, x2), wy = hn::Mul(q.w, y2), wz = hn::Mul(q.w, z2);
  return {{{hn::Sub(one, hn::Add(yy, zz)), hn::Sub(xy, wz), hn::Add(xz, wy)},
           {hn::Add(xy, wz), hn::Sub(one, hn::Add(xx, zz)), hn::Sub(yz, wx)},
           {hn::Sub(xz, wy), hn::Add(yz, wx), hn::Sub(one, hn::Add(xx, yy))}}};
}
HWY_INLINE Vector column(const Matrix& m, int c) {
  return c == 0   ? Vector{m.rows[0].x, m.rows[1].x, m.rows[2].x}
         : c == 1 ? Vector{m.rows[0].y, m.rows[1].y, m.rows[2].y}
                  : Vector{m.rows[0].z, m.rows[1].z, m.rows[2].z};
}

/// One step towards the rotation that maximises tr(R^T F): about the torque of F on R, by torque / (2/3 tr(R^T F)),
/// which is Newton's where all stretches are equal; as a Cayley map, of at most 90 degrees.
HWY_INLINE Quaternion turned_towards(const Quaternion& q, const Matrix& f) {
  const Matrix r = to_matrix(q);
  const Vector tx = cross(column(r, 0), column(f, 0)), ty = cross(column(r, 1), column(f, 1)),
               tz = cross(column(r, 2), column(f, 2));
  const Vector torque{hn::Add(hn::Add(tx.x, ty.x), tz.x), hn::Add(hn::Add(tx.y, ty.y), tz.y),
                      hn::Add(hn::Add(tx.z, ty.z), tz.z)};
  const Floats trace =
      hn::Add(hn::Add(dot(r.rows[0], f.rows[0]), dot(r.rows[1], f.rows[1])), dot(r.rows[2], f.rows[2]));
  const Floats newton = hn::Mul(set(2.0F / 3), hn::Abs(trace));
  const Floats quarter_turn = hn::Mul(set(0.5F), hn::Sqrt(dot(torque, torque)));
  const Floats scale = hn::Div(set(0.5F), hn::Add(hn::Max(newton, quarter_turn), set(1e-20F)));
  const Vector s{hn::Mul(torque.x, scale), hn::Mul(torque.y, scale), hn::Mul(torque.z, scale)};
  // (s, 1) times q, made a unit quaternion.
  const Vector v{q.x, q.y, q.z};
  const Vector sv = cross(s, v);
  const Quaternion next{hn::Add(hn::Add(q.x, hn::Mul(s.x, q.w)), sv.x), hn::Add(hn::Add(q.y, hn::Mul(s.y, q.w)), sv.y),
                        hn::Add(hn::Add(q.z, hn::Mul(s.z, q.w)), sv.z), hn::Sub(q.w, dot(s, v))};
  const Floats square = hn::Add(dot({next.x, next.y, next.z}, {next.x, next.y, next.z}), hn::Mul(next.w, next.w));
  const Floats unit = hn::Div(set(1), hn::Sqrt(square));
  return {hn::Mul(next.x, unit), hn::Mul(next.y, unit), hn::Mul(next.z, unit), hn::Mul(next.w, unit)};
}

/// The deviatoric energy: every corner i moves by -e responses[i].
HWY_INLINE void relax_shape(const Matrix& e, const TetBatch& batch, std::size_t lane, Corners& p) {
  for (int i = 0; i < 4; ++i) {
    const Vector move = times(e, load_vector(batch.responses + 3 * i, lane));
    p[i].x = hn::Sub(p[i].x, move.x);
    p[i].y = hn::Sub(p[i].y, move.y);
    p[i].z = hn::Sub(p[i].z, move.z);
  }
}

/// det F = 1 + wanted, along the gradients cof(F) g of the corners.
HWY_INLINE void relax_volume(const Matrix& f, const Vector* g, Floats compliance, Floats wanted, Corners& p) {
  const Matrix cofactor{{cross(f.rows[1], f.rows[2]), cross(f.rows[2], f.rows[0]), cross(f.rows[0], f.rows[1])}};
  Vector a[4];
  for (int i = 1; i < 4; ++i) a[i] = times(cofactor, g[i - 1]);
  const auto rest = [](Floats u, Floats v, Floats w) { return hn::Neg(hn::Add(hn::Add(u, v), w)); };
  a[0] = {rest(a[1].x, a[2].x, a[3].x), rest(a[1].y, a[2].y, a[3].y), rest(a[1].z, a[2].z, a[3].z)};
  Floats denominator = compliance;
  for (int i = 0; i < 4; ++i) denominator = hn::Add(denominator, hn::Mul(p[i].inverse_mass, dot(a[i], a[i])));
  const Floats lambda = hn::Div(hn::Sub(hn::Add(set(1), wanted), dot(f.rows[0], cofactor.rows[0])), denominator);
  for (int i = 0; i < 4; ++i) {
    const Floats scale = hn::Mul(lambda, p[i].inverse_mass);
    p[i].x = hn::Add(p[i].x, hn::Mul(scale, a[i].x));
    p[i].y = hn::Add(p[i].y, hn::Mul(scale, a[i].y));
    p[i].z = hn::Add(p[i].z, hn::Mul(scale, a[i].z));
  }
}

HWY_INLINE Matrix minus(const Matrix& a, const Matrix& b) {
  return {{minus(a.rows[0], b.rows[0]), minus(a.rows[1], b.rows[1]), minus(a.rows[2], b.rows[2])}};
}
HWY_INLINE Matrix scaled(const Matrix& m, Floats s) {
  const auto row = [&](int i) {
    return Vector{hn::Mul(m.rows[i].x, s), hn::Mul(m.rows[i].y, s), hn::Mul(m.rows[i].z, s)};
  };
  return {{row(0), row(1), row(2)}};
}

/// The places of a tet's corners, or offsets from there, one tet a lane.
template <class P>
HWY_INLINE void load_corners(const P* places, const TetBatch& batch, std::size_t lane, Corners& p) {
  for (int i = 0; i < 4; ++i) p[i] = load_places(places, batch.corners[i] + lane);
}

template <bool kDamped, bool kExact>
HWY_INLINE void relax_lanes(const TetBatch& batch, TetRotations& rotations, const Substep& substep, std::size_t lane) {
  const Lanes d;
  const Vector g[3] = {load_vector(batch.gradients, lane), load_vector(batch.gradients + 3, lane),
                       load_vector(batch.gradients + 6, lane)};
  TetLanes* q = rotations.q;
  const Quaternion before{hn::Load(d, q[0] + lane), hn::Load(d, q[1] + lane), hn::Load(d, q[2] + lane),
                          hn::Load(d, q[3] + lane)};
  Corners p, moves;
  load_corners(substep.places, batch, lane, p);
  load_corners(substep.moves, batch, lane, moves);
  const auto gradient_at_start = [&] {
    if constexpr (!kExact) return gradient_of(p, g);
    Corners remainders;
    load_corners(substep.remainders, batch, lane, remainders);
    return gradient_of(p, remainders, g);
  };
  // F where the substep began and what has changed since stay apart as long as there is something to subtract.
  const Matrix start = gradient_at_start(), change = gradient_of(moves, g);
  const Quaternion turned = turned_towards(before, plus(start, change));
  Matrix e = plus(minus(start, to_matrix(turned)), change);
  Floats wanted = hn::Zero(d);
  if constexpr (kDamped) {
    const Floats damped = hn::Mul(set(substep.damped), hn::Load(d, batch.damping + lane));
    e = minus(e, scaled(minus(start, to_matrix(before)), damped));
    wanted = hn::Mul(hn::Sub(dot(start.rows[0], cross(start.rows[1], start.rows[2])), set(1)), damped);
  }
  relax_shape(e, batch, lane, moves);
  relax_volume(plus(start, gradient_of(moves, g)), g, hn::Load(d, batch.volume_compliance + lane), wanted, moves);
  for (int i = 0; i < 4; ++i) store_places(moves[i], substep.moves, batch.corners[i] + lane);
  hn::Store(turned.x, d, q[0] + lane);
  hn::Store(turned.y, d, q[1] + lane);
  hn::Store(turned.z, d, q[2] + lane);
  hn::Store(turned.w, d, q[3] + lane);
}

template <bool kDamped, bool kExact>
HWY_INLINE void relax_batches(std::span<const TetBatch> batches, std::span<TetRotations> rotations,
                              const Substep& substep) {
  for (std::size_t b = 0; b < batches.size(); ++b)
    for (std::size_t lane = 0; lane < kTetLanes; lane += hn::Lanes(Lanes()))
      relax_lanes<kDamped, kExact>(batches[b], rotations[b], substep, lane);
}

void relax_tets(std::span<const TetBatch> batches, std::span<TetRotations> rotations, const Substep& substep) {
  if (substep.damped > 0 && substep.remainders != nullptr)
    relax_batches<true, true>(batches, rotations, substep);
  else if (substep.damped > 0)
    relax_batches<true, false>(batches, rotations, substep);
  else if (substep.remainders != nullptr)
    relax_batches<false, true>(batches, rotations, substep);
  else
    relax_batches<false, false>(batches, rotations, substep);
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(relax_tets);

void relax_tets(std::span<const TetBatch> batches, std::span<TetRotations> rotations, const Substep& substep) {
  HWY_DYNAMIC_DISPATCH(relax_tets)(batches, rotations, substep);
}

}  // namespace tetsoup::kernel
#endif
