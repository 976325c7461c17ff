#include "base/soup_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/symmetric_eigen.h"

namespace tetsoup {

namespace {

// In widths.
constexpr double kOffsetStep = 0.2;   // Between the classes in which triangles are gathered first.
constexpr double kSamePlane = 0.1;    // Classes whose centres lie so near a plane may belong to it.
constexpr double kThickest = 0.1;     // Side of the box that spreads as far off a plane: more is bent.
constexpr double kLeastSeed = 0.5;    // Area of a class that a plane grows from, in squared widths,
constexpr double kLeastClass = 0.02;  // and of one that counts: the rest is noise.

constexpr double kNormalSteps = 32;   // A unit vector's components are rounded to so many steps: 1 to 2 degrees.
constexpr double kSameWay = 0.9993;   // Cosine of 2 degrees.
constexpr double kMostPlanes = 1024;  // That the area could be cut into: planes far smaller than a mesh of as many
                                      // triangles could follow are not looked for, and cost nothing.
constexpr unsigned kBucketBits = 16;
constexpr std::size_t kBuckets = std::size_t{1} << kBucketBits;
constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15ULL;  // of Fibonacci hashing
constexpr std::int64_t kGrain = 4096;                     // triangles
constexpr double kMostSteps = 1e9;                        // Offsets beyond share a class.

constexpr std::size_t kNoPatch = SIZE_MAX;

using Corners = std::array<Vec3d, 3>;

/// Triangles in about one plane: their area and its first and second moments.
struct Patch {
  double area = 0;
  Vec3d normal, centre;             ///< Sums, weighed by area.
  std::array<double, 6> moments{};  ///< xx, xy, xz, yy, yz, zz: integrals over the area.

  void add(const Corners& p) {
    const Vec3d twice = cross(p[1] - p[0], p[2] - p[0]), sum = p[0] + p[1] + p[2];
    const double size = length(twice) / 2;
    area += size, centre += sum * (size / 3);
    normal += twice * (dot(twice, normal) < 0 ? -0.5 : 0.5);
    for (const Vec3d& v : {p[0], p[1], p[2], sum}) {
      const std::array<double, 6> squares{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
      for (std::size_t i = 0; i < 6; ++i) moments[i] += squares[i] * (size / 12);
    }
  }
  void add(const Patch& other) {
    area += other.area, centre += other.centre;
    normal += dot(normal, other.normal) < 0 ? other.normal * -1 : other.normal;
    for (std::size_t i = 0; i < 6; ++i) moments[i] += other.moments[i];
  }
  Vec3d unit_normal() const { return normal * (1 / length(normal)); }
  Vec3d middle() const { return centre * (1 / area); }
  struct Extent {
    double width, thickness;  ///< The smaller side of the rectangle that spreads as far, and what it is off the plane.
  };
  Extent extent() const {
    const Vec3d c = middle();
    const double a = 1 / area;
    const auto& [xx, xy, xz, yy, yz, zz] = moments;
    const SymmetricEigen spread = symmetric_eigen({xx * a - c.x * c.x, 0, 0, xy * a - c.x * c.y, yy * a - c.y * c.y, 0,
                                                   xz * a - c.x * c.z, yz * a - c.y * c.z, zz * a - c.z * c.z},
                                                  3);
    const auto side = [&](std::size_t i) { return std::sqrt(12 * std::max(spread.values[i], 0.0)); };
    return {side(1), side(0)};
  }
};

struct Classed {
  std::uint64_t key;
  std::uint32_t triangle;
  bool operator<(const Classed& other) const { return key != other.key ? key < other.key : triangle < other.triangle; }
};

/// Equal for triangles of nearly the same normal, to either side, and offset.
std::uint64_t class_of(const Corners& p, double width) {
  const Vec3d twice = cross(p[1] - p[0], p[2] - p[0]);
  Vec3d n = twice * (1 / length(twice));
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  if ((x >= y && x >= z ? n.x : y >= z ? n.y : n.z) < 0) n = n * -1;
  const double offset = std::clamp(dot(n, p[0]) / (kOffsetStep * width), -kMostSteps, kMostSteps);
  auto key = static_cast<std::uint64_t>(std::floor(offset + 0.5) + kMostSteps);
  for (const double c : {n.x, n.y, n.z}) {
    key = key << 7 | static_cast<std::uint64_t>(std::floor(c * kNormalSteps + 0.5) + kNormalSteps);
  }
  return key;
}

struct Class {
  Patch patch;
  std::size_t begin, end;  ///< Of its triangles.
  std::size_t of_patch = kNoPatch;
};

/// Classes that lie in one plane are one patch; a small one belongs to that of a larger one or to none.
std::vector<Patch> joined(std::vector<Class>& classes, double width) {
  struct Lie {
    Vec3d normal;
    double offset;
  };
  std::vector<Patch> patches;
  std::vector<Lie> lies;  // of the patches
  for (Class& c : classes) {
    const Vec3d normal = c.patch.unit_normal(), at = c.patch.middle();
    const auto same = std::find_if(lies.begin(), lies.end(), [&](const Lie& lie) {
      return std::abs(dot(lie.normal, normal)) > kSameWay &&
             std::abs(dot(lie.normal, at) - lie.offset) < kSamePlane * width;
    });
    c.of_patch = static_cast<std::size_t>(same - lies.begin());
    if (same == lies.end() && c.patch.area < kLeastSeed * width * width) {
      c.of_patch = kNoPatch;
      continue;
    }
    if (same == lies.end()) {
      patches.emplace_back();
      lies.emplace_back();
    }
    Patch& patch = patches[c.of_patch];
    patch.add(c.patch);
    lies[c.of_patch] = {patch.unit_normal(), dot(patch.unit_normal(), patch.middle())};
  }
  return patches;
}

}  // namespace

SoupPlanes find_planes(const TriangleSoup& soup, double least_width, StageWatch& watch) {
  SoupPlanes found;
  found.plane_of.assign(soup.triangles.size(), SoupPlanes::kNone);
  if (soup.vertices.empty()) return found;
  const Vec3d origin = to_double(soup.vertices[0]);
  const auto corners = [&](std::uint32_t t) {
    const Triangle& c = soup.triangles[t];
    return Corners{to_double(soup.vertices[c[0]]) - origin, to_double(soup.vertices[c[1]]) - origin,
                   to_double(soup.vertices[c[2]]) - origin};
  };
  const auto area_of = [&](std::uint32_t t) {
    const Corners p = corners(t);
    const double area = length(cross(p[1] - p[0], p[2] - p[0])) / 2;
    return std::isfinite(area) ? area : 0;
  };
  found.area = parallel_sum<double>(static_cast<std::int64_t>(soup.triangles.size()), kGrain, watch,
                                    [&](std::int64_t begin, std::int64_t end) {
                                      double sum = 0;
                                      for (auto t = begin; t < end; ++t) sum += area_of(static_cast<std::uint32_t>(t));
                                      return sum;
                                    });
  const double width = std::max(least_width, std::sqrt(found.area / kMostPlanes)), least = kLeastClass * width * width;
  std::vector<std::uint64_t> keys(soup.triangles.size());
  std::vector<double> areas(soup.triangles.size());
  parallel_for(static_cast<std::int64_t>(keys.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::uint32_t>(begin); t < static_cast<std::uint32_t>(end); ++t) {
      areas[t] = area_of(t);
      if (areas[t] > 0) keys[t] = class_of(corners(t), width);
    }
  });
  // Of a fine mesh hardly a class is large enough: most are told by the area of many classes together.
  std::vector<double> together(kBuckets, 0);
  const auto bucket = [](std::uint64_t key) { return key * kSpread >> (64 - kBucketBits); };
  for (std::size_t t = 0; t < keys.size(); ++t) together[bucket(keys[t])] += areas[t];
  std::vector<Classed> classed;
  for (std::uint32_t t = 0; t < keys.size(); ++t) {
    if (areas[t] > 0 && together[bucket(keys[t])] >= least) classed.push_back({keys[t], t});
  }
  std::sort(classed.begin(), classed.end());
  std::vector<Class> classes;
  for (std::size_t begin = 0, end = 0; begin < classed.size(); begin = end) {
    Patch patch;
    for (; end < classed.size() && classed[end].key == classed[begin].key; ++end) {
      patch.add(corners(classed[end].triangle));
    }
    if (patch.area >= least) classes.push_back({patch, begin, end});
  }
  const auto larger = [](const auto& a, const auto& b) { return a.patch.area > b.patch.area; };
  std::stable_sort(classes.begin(), classes.end(), larger);
  const std::vector<Patch> patches = joined(classes, width);
  struct Wide {
    Patch patch;
    std::size_t number;
  };
  std::vector<Wide> wide;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const auto [side, thickness] = patches[p].extent();
    if (side >= width && thickness <= kThickest * width) wide.push_back({patches[p], p});
  }
  std::stable_sort(wide.begin(), wide.end(), larger);
  std::vector<std::uint32_t> plane_of_patch(patches.size(), SoupPlanes::kNone);
  for (const auto& [patch, number] : wide) {
    plane_of_patch[number] = static_cast<std::uint32_t>(found.planes.size());
    const Vec3d normal = patch.unit_normal();
    found.planes.push_back({normal, dot(normal, patch.middle() + origin), patch.area});
  }
  for (const Class& c : classes) {
    if (c.of_patch == kNoPatch) continue;
    for (std::size_t i = c.begin; i < c.end; ++i) found.plane_of[classed[i].triangle] = plane_of_patch[c.of_patch];
  }
  return found;
}

}  // namespace tetsoup
