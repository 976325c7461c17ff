#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "base/vec.h"
#include "tetsoup/distance.h"

namespace tetsoup {
namespace {

constexpr int kDefaultVoxels = 128;
constexpr int kMaxVoxels = 4096;  ///< Along the longest axis: float resolves 2^-11 of a voxel there.
constexpr double kMaxVoxelCount = sizeof(std::size_t) > 4 ? 1.1e12 : 2147483648.0;  ///< 2^40: what index arithmetic is
                                                                                    ///< tested for.
constexpr int kPad = 2;  ///< Voxels; one lets rays start outside, two give the first a predecessor.
/// Smallest voxel edge as a share of the largest coordinate: 64 steps of single precision.
constexpr double kFinestRelativeVoxel = 0x1p-17;
constexpr double kFinestVoxel = 1e-33;  ///< Keeps results away from float's subnormal numbers.

bool is_finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Box3 domain_of(const SoupReport& soup, const DistanceOptions& options) {
  if (soup.used_triangles == 0) throw InvalidInput("the soup has no finite triangle");
  if (!options.box) return soup.box;
  const Box3 box{options.box->lo - soup.origin, options.box->hi - soup.origin};
  const bool holds = is_finite(box.lo) && is_finite(box.hi) && min(box.lo, soup.box.lo) == box.lo &&
                     max(box.hi, soup.box.hi) == box.hi;
  if (!holds) throw InvalidInput("box must be finite and hold the soup's own box");
  return box;
}

double voxel_edge(const DistanceOptions& options, double longest, double largest_coordinate) {
  const double finest = std::max(kFinestVoxel, largest_coordinate * kFinestRelativeVoxel);
  if (options.voxel_size) return std::max(*options.voxel_size, finest);
  const double voxels = options.voxels.value_or(kDefaultVoxels);
  if (largest_coordinate == 0) return 1 / voxels;  // one point at the origin: any size will do
  return std::max(longest / voxels, finest);
}

}  // namespace

GridFrame make_grid(const CleanSoup& soup, const DistanceOptions& options) {
  if (options.voxels && options.voxel_size) throw InvalidInput("give voxels or voxel_size, not both");
  require(!options.voxels || (*options.voxels >= 1 && *options.voxels <= kMaxVoxels), "voxels",
          options.voxels.value_or(0), "1 to 4096");
  require(!options.voxel_size || (*options.voxel_size > 0 && std::isfinite(*options.voxel_size)), "voxel_size",
          options.voxel_size.value_or(0), "positive and finite");
  require(options.band_voxels >= 3, "band_voxels", options.band_voxels, "3 or more");

  const Box3 box = domain_of(soup.report, options);
  const Vec3d extent = box.hi - box.lo;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double largest_coordinate = std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z),
                                              std::abs(box.hi.x), std::abs(box.hi.y), std::abs(box.hi.z)});
  const double h = voxel_edge(options, longest, largest_coordinate);
  require(longest / h <= kMaxVoxels + 0.5, "voxel_size", h,
          "large enough for at most 4096 voxels along the longest axis");

  GridFrame frame;
  frame.pad = kPad;
  frame.voxel_size = h;
  frame.soup_origin = soup.soup.origin;
  const std::array<double, 3> along{extent.x, extent.y, extent.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double voxels = std::max(1.0, std::ceil(along[axis] / h * (1 - 1e-12)));
    frame.size[axis] = static_cast<int>(voxels) + 2 * kPad;
  }
  const double count = 1.0 * frame.size[0] * frame.size[1] * frame.size[2];
  require(count <= kMaxVoxelCount, "voxels", count, "at most 2^40 in all, or 2^31 where addresses have 32 bits");
  const auto first_centre = [&](double lo, double hi, int size) { return (lo + hi) / 2 - (size - 1) * h / 2; };
  frame.origin = {first_centre(box.lo.x, box.hi.x, frame.size[0]), first_centre(box.lo.y, box.hi.y, frame.size[1]),
                  first_centre(box.lo.z, box.hi.z, frame.size[2])};
  return frame;
}

}  // namespace tetsoup
