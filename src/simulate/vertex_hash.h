// Vertices by the cell of space they are in, however far apart the cells lie [Teschner03].
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/groups.h"
#include "tetsoup/types.h"

namespace tetsoup::simulate {

struct HashedVertex {
  Vec3 place;
  std::uint32_t slot = 0;
};

class VertexHash {
 public:
  VertexHash(const std::vector<HashedVertex>& vertices, double cell)
      : inverse_cell_(1 / cell),
        mask_(static_cast<std::uint32_t>(std::bit_ceil(2 * vertices.size() + 1) - 1)),
        buckets_(std::size_t{mask_} + 1, [&](const auto& put) {
          for (const HashedVertex& v : vertices)
            put(bucket(cell_of(v.place.x), cell_of(v.place.y), cell_of(v.place.z)), v);
        }) {}

  /// visit(vertex) for all vertices in the box, and perhaps a few others; some may come twice.
  template <class Visit>
  void visit_box(const Vec3& lo, const Vec3& hi, const Visit& visit) const {
    const std::array<std::int64_t, 3> a{cell_of(lo.x), cell_of(lo.y), cell_of(lo.z)};
    const std::array<std::int64_t, 3> b{cell_of(hi.x), cell_of(hi.y), cell_of(hi.z)};
    const double cells = static_cast<double>(b[0] - a[0] + 1) * static_cast<double>(b[1] - a[1] + 1) *
                         static_cast<double>(b[2] - a[2] + 1);
    if (cells > static_cast<double>(mask_)) return visit_all(visit);
    for (std::int64_t z = a[2]; z <= b[2]; ++z)
      for (std::int64_t y = a[1]; y <= b[1]; ++y)
        for (std::int64_t x = a[0]; x <= b[0]; ++x)
          for (const HashedVertex& v : buckets_[bucket(x, y, z)]) visit(v);
  }

 private:
  template <class Visit>
  void visit_all(const Visit& visit) const {
    for (std::size_t i = 0; i < buckets_.size(); ++i)
      for (const HashedVertex& v : buckets_[i]) visit(v);
  }
  std::int64_t cell_of(float v) const {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(v) * inverse_cell_));
  }
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const auto u = [](std::int64_t v) { return static_cast<std::uint32_t>(v); };
    return (u(x) * 73856093U ^ u(y) * 19349663U ^ u(z) * 83492791U) & mask_;
  }

  double inverse_cell_;
  std::uint32_t mask_;
  Groups<HashedVertex> buckets_;
};

}  // namespace tetsoup::simulate
