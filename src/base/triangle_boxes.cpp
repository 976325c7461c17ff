#include "base/triangle_boxes.h"

#include <bit>
#include <cmath>

#include "base/merge_vertices.h"
#include "base/morton.h"

namespace tetsoup {
namespace {

constexpr double kCodeRange = kMortonRange;

}  // namespace

Vec3d closest_on_triangle(const std::array<Vec3d, 3>& triangle, const Vec3d& p) {
  const auto& [a, b, c] = triangle;
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3d bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 == d3 ? a : a + ab * (d1 / (d1 - d3));
  const Vec3d cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 == d6 ? a : a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double sum = (d4 - d3) + (d5 - d6);
    return sum == 0 ? b : b + (c - b) * ((d4 - d3) / sum);
  }
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

TriangleBoxes::TriangleBoxes(const TriangleSoup& soup, StageWatch& watch) : soup_(soup) {
  find_box();
  const auto centre = [&](std::size_t i) {
    const auto [a, b, c] = soup_.triangles[usable_[i]];
    const Vec3d sum = place(a) + place(b) + place(c);
    return to_float(sum * (kCodeRange / 3));
  };
  for (const MortonEntry& entry : morton_order(usable_.size(), centre, watch)) order_.push_back(usable_[entry.index]);
  const std::size_t leaves = (order_.size() + kLeaf - 1) / kLeaf;
  if (leaves == 0) return;
  first_leaf_ = std::bit_ceil(leaves);
  boxes_.assign(2 * first_leaf_, Box{});
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    for (std::size_t i = leaf * kLeaf; i < std::min(order_.size(), (leaf + 1) * kLeaf); ++i) {
      for (const std::uint32_t v : soup_.triangles[order_[i]]) boxes_[first_leaf_ + leaf].add(to_float(place(v)));
    }
  }
  for (std::size_t node = first_leaf_ - 1; node > 0; --node) {
    boxes_[node] = boxes_[2 * node];
    boxes_[node].add(boxes_[2 * node + 1]);
  }
}

/// The box of the finite triangles, whose longest side becomes 1.
void TriangleBoxes::find_box() {
  Vec3d hi;
  for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
    if (!is_usable(soup_, soup_.triangles[t])) continue;
    if (usable_.empty()) lo_ = hi = to_double(soup_.vertices[soup_.triangles[t][0]]);
    for (const std::uint32_t v : soup_.triangles[t]) {
      lo_ = min(lo_, to_double(soup_.vertices[v])), hi = max(hi, to_double(soup_.vertices[v]));
    }
    usable_.push_back(t);
  }
  const double longest = std::max({hi.x - lo_.x, hi.y - lo_.y, hi.z - lo_.z});
  scale_ = longest > 0 ? 1 / longest : 1;
}

}  // namespace tetsoup
