// Where straight lines of voxel centres cross the soup's triangles, exactly: closed surfaces are crossed evenly, to the
// bit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "tetsoup/types.h"

namespace tetsoup {

/// Corner of a triangle, seen along a direction of lines: a line is a pair of whole numbers (u, v), and voxel centres
/// lie on it at whole numbers t.
struct SeenCorner {
  double u = 0, v = 0, t = 0;
};

/// An edge in one line of lines v: where it crosses, and whether the triangle runs up along it.
struct SeenEdge {
  double u = 0, t = 0;
  bool up = false;
};

/// A whole number that is at least `x`, and one of them, as far as it counts: beyond +-2^30 there are no voxels.
inline int first_at_least(double x) {
  constexpr double kFar = 1 << 30;
  return static_cast<int>(std::ceil(std::clamp(x, -kFar, kFar)));
}

/// The edge between two corners at height v, from its lower end: the same for all its triangles, bit for bit.
inline SeenEdge cut_edge(const SeenCorner& from, const SeenCorner& to, int v) {
  const bool up = from.v < to.v;
  const SeenCorner &low = up ? from : to, &high = up ? to : from;
  const double share = (v - low.v) / (high.v - low.v);
  return {low.u + share * (high.u - low.u), low.t + share * (high.t - low.t), up};
}

/// Calls visit(u, v, first, sign) for every line that crosses a triangle: `first` is the first whole t beyond the
/// crossing, `sign` is 1 where a line that runs towards higher t gets in, and -1 where it gets out, of what the
/// triangle's winding says is inside. An edge or a corner on a line belongs to just one of the triangles around it:
/// they add up to zero over every closed surface, since an edge is cut in the same place for all of its triangles.
template <class Visit>
void cross_lines(const std::array<SeenCorner, 3>& corner, int v_begin, int v_end, const Visit& visit) {
  const auto [lowest, highest] = std::minmax({corner[0].v, corner[1].v, corner[2].v});
  const auto [nearest, farthest] = std::minmax({corner[0].t, corner[1].t, corner[2].t});
  const int begin = std::max(v_begin, first_at_least(lowest)), end = std::min(v_end, first_at_least(highest));
  for (int v = begin; v < end; ++v) {
    std::array<SeenEdge, 2> cut;
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3 && found < 2; ++i) {
      const SeenCorner &a = corner[i], &b = corner[(i + 1) % 3];
      if ((a.v <= v) != (b.v <= v)) cut[found++] = cut_edge(a, b, v);
    }
    if (found < 2) continue;
    const auto& [left, right] = cut[0].u <= cut[1].u ? std::pair{cut[0], cut[1]} : std::pair{cut[1], cut[0]};
    const int sign = right.up ? -1 : 1;
    const double slope = right.u > left.u ? (right.t - left.t) / (right.u - left.u) : 0;
    for (int u = first_at_least(left.u), u_end = first_at_least(right.u); u < u_end; ++u)
      visit(u, v, first_at_least(std::clamp(left.t + (u - left.u) * slope, nearest, farthest)), sign);
  }
}

}  // namespace tetsoup
