#include "distance/feature_region.h"

#include <cmath>

namespace tetsoup {
namespace {

float dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3 scaled(const Vec3& a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
float component(const Vec3& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Length that rounding can move a point by, next to a feature of so many voxels.
float rounding(float extent, float band) {
  return 1e-4F + 1e-6F * (extent + band);
}

/// A rival beats a feature for sure if its true squared distance is less by this: bounds the error of both formulas.
float sure_gain(float extent, float band) {
  return 8e-6F * band * (extent + band);
}

constexpr kernel::UpDown kUpDown{{0, 0, 0, 0}, {1, -1, 0, 0}, {0, 0, 1, -1}};

IndexRange clamped_range(float lo, float hi, int size) {
  return {std::max(0, static_cast<int>(std::ceil(std::max(lo, -1.0F)))),
          std::min(size, static_cast<int>(std::floor(std::min(hi, 1e6F))) + 1)};
}

}  // namespace

FeatureRegion corner_region(const SoupFeatures& features, std::uint32_t corner, float band, const GridFrame& frame) {
  FeatureRegion region;
  region.base = features.corners[corner];
  const std::span spokes = features.spokes[corner];
  const std::size_t stride = 1 + spokes.size() / FeatureRegion::kMost;
  for (std::size_t i = 0; i < spokes.size(); i += stride) {
    const SoupFeatures::Edge& edge = features.edges[spokes[i]];
    const Vec3 away = minus(features.corners[edge.from == corner ? edge.to : edge.from], region.base);
    const float length = std::sqrt(dot(away, away)), gain = sure_gain(length, band);
    const float limit = std::max(std::sqrt(gain), gain / length);  // moving along the edge gains limit^2 or more
    if (limit < band) region.add(scaled(away, 1 / length), limit);
  }
  const float radius = band + rounding(0, band);
  const auto far = kernel::cone_reach(kUpDown, {region.half_spaces.data(), region.count}, radius);
  const Vec3& at = region.base;
  region.box = {clamped_range(at.x - radius, at.x + radius, frame.size[0]),
                clamped_range(at.y - far[1], at.y + far[0], frame.size[1]),
                clamped_range(at.z - far[3], at.z + far[2], frame.size[2])};
  return region;
}

FeatureRegion edge_region(const SoupFeatures& features, std::uint32_t edge, float band, const GridFrame& frame) {
  FeatureRegion region;
  const SoupFeatures::Edge& e = features.edges[edge];
  region.base = features.corners[e.from];
  const Vec3 along = minus(features.corners[e.to], region.base);
  const float length = std::sqrt(dot(along, along));
  if (!(length > 0)) return region;
  const std::uint32_t sides = e.last_side - e.first_side;
  const std::uint32_t stride = 1 + sides / static_cast<std::uint32_t>(FeatureRegion::kMost - 2);
  for (std::uint32_t i = e.first_side; i < e.last_side; i += stride) {
    const std::uint32_t side = features.sides[i] % 4;
    const kernel::FacePlan& face = features.faces[features.sides[i] / 4];
    if (!face.has_area) continue;
    const std::uint32_t opposite = features.triangles[features.sides[i] / 4][side == 0 ? 2 : side == 1 ? 0 : 1];
    const Vec3 across = minus(features.corners[opposite], region.base);
    const float height = std::abs(dot(face.inward[side], across)), width = length + std::sqrt(dot(across, across));
    const float gain = sure_gain(width, band);
    // Moving towards the opposite corner gains (height limit / width)^2, or height limit if that corner is near.
    const float limit = std::max(std::sqrt(gain) * width, gain) / height;
    if (limit < band) region.add(face.inward[side], limit);
  }
  const float slack = rounding(length, band), radius = band + slack;
  const Vec3 unit = scaled(along, 1 / length);
  kernel::UpDown outward = kUpDown;  // less what lies along the edge
  std::array<float, 4> step{};
  for (std::size_t i = 0; i < step.size(); ++i) {
    step[i] = unit.y * kUpDown.y[i] + unit.z * kUpDown.z[i];
    outward.x[i] -= unit.x * step[i];
    outward.y[i] -= unit.y * step[i];
    outward.z[i] -= unit.z * step[i];
  }
  auto far = kernel::cone_reach(outward, {region.half_spaces.data(), region.count}, radius);
  for (std::size_t i = 0; i < step.size(); ++i) far[i] += std::max(0.0F, step[i] * length) + slack;
  const Vec3& at = region.base;
  region.box = {
      clamped_range(at.x + std::min(0.0F, along.x) - radius, at.x + std::max(0.0F, along.x) + radius, frame.size[0]),
      clamped_range(at.y - far[1], at.y + far[0], frame.size[1]),
      clamped_range(at.z - far[3], at.z + far[2], frame.size[2])};
  region.add(unit, length + slack);
  region.add(scaled(unit, -1), slack);
  return region;
}

FeatureRegion face_region(const SoupFeatures& features, std::uint32_t face, float band, const GridFrame& frame) {
  FeatureRegion region;
  const kernel::FacePlan& f = features.faces[face];
  if (!f.has_area) return region;
  region.base = f.base[0];
  const Triangle& t = features.triangles[face];
  Vec3 lo = features.corners[t[0]], hi = lo;
  for (const std::uint32_t corner : t) {
    const Vec3& c = features.corners[corner];
    lo = {std::min(lo.x, c.x), std::min(lo.y, c.y), std::min(lo.z, c.z)};
    hi = {std::max(hi.x, c.x), std::max(hi.y, c.y), std::max(hi.z, c.z)};
  }
  const float slack = rounding((hi.x - lo.x) + (hi.y - lo.y) + (hi.z - lo.z), band);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float height = std::abs(component(f.normal, axis)) * band + slack;
    region.box[axis] = clamped_range(component(lo, axis) - height, component(hi, axis) + height, frame.size[axis]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 outward = scaled(f.inward[i], -1);
    region.add(outward, dot(outward, minus(f.base[i], f.base[0])) + slack);
  }
  region.add(f.normal, band + slack);
  region.add(scaled(f.normal, -1), band + slack);
  return region;
}

}  // namespace tetsoup
