#include "kernel/nearest_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/nearest_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetsoup::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Lanes>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// More than rounding can change of a squared distance, as a fraction of it.
constexpr float kSlack = 0x1p-17F;

Floats set(float v) {
  return hn::Set(Lanes(), v);
}

struct Points {
  Floats x, y, z;
};
Floats squared_distance(const Points& p, const Vec3& from) {
  const Floats dx = hn::Sub(p.x, set(from.x)), dy = hn::Sub(p.y, set(from.y)), dz = hn::Sub(p.z, set(from.z));
  return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
}
float squared_distance(const Vec3& p, const Vec3& q) {
  const float dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
  return dx * dx + dy * dy + dz * dz;
}
Floats absolute_difference(Floats a, float b) {
  return hn::Abs(hn::Sub(a, set(b)));
}

/// The points from `i` on; beyond the end, the last one again.
HWY_NOINLINE Points load_last(const PointColumns& points, std::size_t i) {
  const Lanes d;
  alignas(64) std::array<float, 16> x, y, z;
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const std::size_t at = std::min(i + lane, points.size() - 1);
    x[lane] = points.x[at];
    y[lane] = points.y[at];
    z[lane] = points.z[at];
  }
  return {hn::Load(d, x.data()), hn::Load(d, y.data()), hn::Load(d, z.data())};
}

/// body(points, i) for all points, a vector at a time from `i` on.
template <class Body>
HWY_INLINE void for_all(const PointColumns& points, const Body& body) {
  const Lanes d;
  const std::size_t n = points.size();
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d))
    body(
        Points{hn::LoadU(d, points.x.data() + i), hn::LoadU(d, points.y.data() + i), hn::LoadU(d, points.z.data() + i)},
        i);
  if (i < n) body(load_last(points, i), i);
}

/// Copies the points for which keep(points) is true; `to` may be `from`.
template <class Keep>
void copy_if(const PointColumns& from, PointColumns& to, const Keep& keep) {
  const Lanes d;
  const std::size_t lanes = hn::Lanes(d), n = from.size();
  std::size_t count = 0;
  for_all(from, [&](const Points& p, std::size_t i) {
    const auto kept = hn::And(keep(p), hn::FirstN(d, n - i));
    if (hn::AllFalse(d, kept)) return;
    if (to.size() < count + lanes) to.resize(count + std::max(count, std::size_t{256}));  // whole vectors are stored
    // Not CompressStore(): its instruction takes a hundred cycles and more on some processors (Zen 4).
    hn::StoreU(hn::Compress(p.x, kept), d, &to.x[count]);
    hn::StoreU(hn::Compress(p.y, kept), d, &to.y[count]);
    hn::StoreU(hn::Compress(p.z, kept), d, &to.z[count]);
    count += hn::CountTrue(d, kept);
  });
  to.resize(count);
}

/// Of equally near ones, any.
Vec3 nearest_to(const Vec3& at, const PointColumns& points) {
  const Lanes d;
  Floats least = set(kInfinity);
  Points nearest{least, least, least};
  for_all(points, [&](const Points& p, std::size_t) {
    const Floats square = squared_distance(p, at);
    const auto nearer = hn::Lt(square, least);
    least = hn::Min(square, least);
    nearest = {hn::IfThenElse(nearer, p.x, nearest.x), hn::IfThenElse(nearer, p.y, nearest.y),
               hn::IfThenElse(nearer, p.z, nearest.z)};
  });
  alignas(64) std::array<float, 16> squares, x, y, z;
  hn::Store(least, d, squares.data());
  hn::Store(nearest.x, d, x.data());
  hn::Store(nearest.y, d, y.data());
  hn::Store(nearest.z, d, z.data());
  const auto lane = static_cast<std::size_t>(
      std::min_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(hn::Lanes(d))) - squares.begin());
  return {x[lane], y[lane], z[lane]};
}

/// Keeps the points that are not farther from all of the box than the nearest point of its centre can be.
void keep_in_ball(const PointColumns& points, const CentredBox& box, PointColumns& out) {
  const Lanes d;
  Floats least = set(kInfinity);
  for_all(points, [&](const Points& p, std::size_t) { least = hn::Min(least, squared_distance(p, box.centre)); });
  const float radius = std::sqrt(hn::GetLane(hn::MinOfLanes(d, least))) + 2 * std::sqrt(squared_distance(box.half, {}));
  const Floats reach = set(radius * radius * (1 + kSlack));
  copy_if(points, out, [&](const Points& p) { return hn::Le(squared_distance(p, box.centre), reach); });
}

/// For v = centre + w in the box: |p - v|^2 - |q - v|^2 = |p - centre|^2 - |q - centre|^2 - 2 w (p - q), which is
/// linear in w, so q is nearer than p to all of the box if the least value, at a corner, is positive.
void drop_dominated(PointColumns& points, const CentredBox& box) {
  struct Witness {
    Vec3 q;
    float square;
  };
  std::array<Witness, 9> witnesses;
  for (unsigned i = 0; i < 9; ++i) {
    Vec3 at = box.centre;
    if (i > 0) {
      at.x += (i & 1U) ? box.half.x : -box.half.x;
      at.y += (i & 2U) ? box.half.y : -box.half.y;
      at.z += (i & 4U) ? box.half.z : -box.half.z;
    }
    const Vec3 q = nearest_to(at, points);
    witnesses[i] = {q, squared_distance(q, box.centre)};
  }
  const float size = squared_distance(box.half, {});
  copy_if(points, points, [&](const Points& p) {
    const Lanes d;
    const Floats square = squared_distance(p, box.centre);
    const Floats more = hn::Sub(square, hn::Mul(hn::Add(square, set(size)), set(kSlack)));
    Floats most = set(-kInfinity);
    for (const Witness& witness : witnesses) {
      const Floats x = absolute_difference(p.x, witness.q.x), y = absolute_difference(p.y, witness.q.y),
                   z = absolute_difference(p.z, witness.q.z);
      const Floats reach = hn::Add(hn::Add(hn::Mul(x, set(2 * box.half.x)), hn::Mul(y, set(2 * box.half.y))),
                                   hn::Mul(z, set(2 * box.half.z)));
      most = hn::Max(most, hn::Sub(hn::Sub(more, set(witness.square)), reach));
    }
    return hn::Le(most, hn::Zero(d));
  });
}

void keep_candidates(const PointColumns& points, const CentredBox& box, PointColumns& out) {
  keep_in_ball(points, box, out);
  if (out.size() > 8) drop_dominated(out, box);
}

constexpr std::size_t kLayer = kBrick * kBrick;

/// Lowers four vectors of a layer's squares; `xy` holds the layers' common part for each of the points.
void lower_part(const float* xy, const float* dz, std::size_t count, float* squares) {
  const Lanes d;
  const std::size_t lanes = hn::Lanes(d);
  Floats best0 = hn::LoadU(d, squares), best1 = hn::LoadU(d, squares + lanes),
         best2 = hn::LoadU(d, squares + 2 * lanes), best3 = hn::LoadU(d, squares + 3 * lanes);
  for (std::size_t i = 0; i < count; ++i, xy += kLayer) {
    const Floats z = set(dz[i]);
    best0 = hn::Min(best0, hn::Add(hn::LoadU(d, xy), z));
    best1 = hn::Min(best1, hn::Add(hn::LoadU(d, xy + lanes), z));
    best2 = hn::Min(best2, hn::Add(hn::LoadU(d, xy + 2 * lanes), z));
    best3 = hn::Min(best3, hn::Add(hn::LoadU(d, xy + 3 * lanes), z));
  }
  hn::StoreU(best0, d, squares);
  hn::StoreU(best1, d, squares + lanes);
  hn::StoreU(best2, d, squares + 2 * lanes);
  hn::StoreU(best3, d, squares + 3 * lanes);
}

void nearest_squares(const PointColumns& points, int x0, int y0, int z0, BrickSquares squares) {
  constexpr std::size_t kPart = 32;  // points at once
  const Lanes d;
  std::fill(squares.begin(), squares.end(), kInfinity);
  alignas(64) std::array<float, kPart * kLayer> xy;
  std::array<float, kPart> dz;
  alignas(64) std::array<float, kLayer> x, y;
  for (std::size_t i = 0; i < kLayer; ++i) {
    x[i] = static_cast<float>(x0 + static_cast<int>(i) % kBrick);
    y[i] = static_cast<float>(y0 + static_cast<int>(i) / kBrick);
  }
  for (std::size_t begin = 0; begin < points.size(); begin += kPart) {
    const std::size_t count = std::min(kPart, points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Floats px = set(points.x[begin + i]), py = set(points.y[begin + i]);
      for (std::size_t j = 0; j < kLayer; j += hn::Lanes(d)) {
        const Floats dx = hn::Sub(hn::Load(d, &x[j]), px), dy = hn::Sub(hn::Load(d, &y[j]), py);
        hn::Store(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), d, &xy[i * kLayer + j]);
      }
    }
    for (int k = 0; k < kBrick; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        const float z = static_cast<float>(z0 + k) - points.z[begin + i];
        dz[i] = z * z;
      }
      for (std::size_t j = 0; j < kLayer; j += 4 * hn::Lanes(d))
        lower_part(&xy[j], dz.data(), count, &squares[static_cast<std::size_t>(k) * kLayer + j]);
    }
  }
}

}  // namespace tetsoup::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetsoup::kernel {

HWY_EXPORT(keep_candidates);
HWY_EXPORT(nearest_squares);

void keep_candidates(const PointColumns& points, const CentredBox& box, PointColumns& out) {
  HWY_DYNAMIC_DISPATCH(keep_candidates)(points, box, out);
}

void nearest_squares(const PointColumns& points, int x0, int y0, int z0, BrickSquares squares) {
  HWY_DYNAMIC_DISPATCH(nearest_squares)(points, x0, y0, z0, squares);
}

}  // namespace tetsoup::kernel
#endif
