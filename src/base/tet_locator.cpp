#include "base/elementary.h"
#include "base/tet_locator.h"

#include "base/whole.h"

namespace tetsoup {
namespace {

constexpr double kBucketsPerTet = 2;
/// A bucket's edge in edges of a tet: a point then has a dozen tets to ask.
constexpr double kBucketShare = 0.375;
/// Flat and empty meshes would have no end of buckets along their sides.
constexpr double kMostBucketsPerTet = 16;
/// Ordinary tets reach into some 50 buckets; those of slivers as long as the body would be no end of them.
constexpr double kMostReachedPerTet = 250;

/// About the edge of the largest tet.
double tet_edge_of(const Vec3d& size, double largest_volume, double tet_count) {
  double edge = std::max(elementary::cbrt(6 * largest_volume),
                         elementary::cbrt(size.x * size.y * size.z / (kBucketsPerTet * tet_count + 1)));
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0)) return 1;
  edge = std::max(edge, longest * 1e-6);
  const auto buckets = [&] { return (size.x / edge + 1) * (size.y / edge + 1) * (size.z / edge + 1); };
  while (buckets() > kMostBucketsPerTet * (tet_count + 1)) edge *= 2;
  return edge;
}

struct Box {
  Vec3d lo, hi;
};

/// Of the tets that hold something.
std::vector<Box> boxes_of(const TetMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    const TetCorners p = corners_of(mesh, tet);
    if (signed_volume(p) > 0)
      boxes.push_back({min(min(p[0], p[1]), min(p[2], p[3])), max(max(p[0], p[1]), max(p[2], p[3]))});
  }
  return boxes;
}

/// The bucket's edge, raised until the tets' boxes reach into few enough of them.
double with_few_reached(double edge, const std::vector<Box>& boxes) {
  const double most = kMostReachedPerTet * static_cast<double>(boxes.size());
  for (;; edge *= 2) {
    double reached = 0;
    for (const Box& box : boxes) {
      const Vec3d cells = (box.hi - box.lo) * (1 / edge);
      reached += (cells.x + 1) * (cells.y + 1) * (cells.z + 1);
    }
    if (!(reached > most)) return edge;
  }
}

}  // namespace

TetLocator::TetLocator(const TetMesh& mesh, double on_face) {
  if (mesh.tets.empty()) return;
  Vec3d lo = corners_of(mesh, mesh.tets.front())[0], hi = lo;
  double volume = 0;
  for (const Tet& tet : mesh.tets) {
    const TetCorners p = corners_of(mesh, tet);
    volume = std::max(volume, signed_volume(p));
    for (const Vec3d& q : p) {
      lo = min(lo, q);
      hi = max(hi, q);
    }
  }
  const double tet_edge = tet_edge_of(hi - lo, volume, static_cast<double>(mesh.tets.size()));
  edge_ = with_few_reached(tet_edge * kBucketShare, boxes_of(mesh));
  origin_ = lo;
  const auto last = bucket_of(hi);
  for (std::size_t i = 0; i < 3; ++i) count_[i] = last[i] + 1;

  planes_.resize(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const TetCorners p = corners_of(mesh, mesh.tets[t]);
    if (!(signed_volume(p) > 0)) {
      planes_[t][0] = {{}, -1};  // holds nothing
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& face = kTetFaces[i];
      const Vec3d a = p[static_cast<std::size_t>(face[0])];
      Vec3d n = cross(p[static_cast<std::size_t>(face[2])] - a, p[static_cast<std::size_t>(face[1])] - a);
      n = n * (1 / length(n));
      planes_[t][i] = {n, -dot(n, a) + on_face * tet_edge};
    }
  }
  tets_ = Groups<std::uint32_t>(number_of({count_[0] - 1, count_[1] - 1, count_[2] - 1}) + 1, [&](const auto& put) {
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
      const TetCorners p = corners_of(mesh, mesh.tets[t]);
      if (!(signed_volume(p) > 0)) continue;
      const auto first = bucket_of(min(min(p[0], p[1]), min(p[2], p[3])));
      const auto end = bucket_of(max(max(p[0], p[1]), max(p[2], p[3])));
      for (int z = first[2]; z <= end[2]; ++z)
        for (int y = first[1]; y <= end[1]; ++y)
          for (int x = first[0]; x <= end[0]; ++x) put(number_of({x, y, z}), t);
    }
  });
}

std::array<int, 3> TetLocator::bucket_of(const Vec3d& point) const {
  // Far points need not be told apart, but must fit an int.
  constexpr double kFar = 1e9;
  const Vec3d p = (point - origin_) * (1 / edge_);
  const auto whole = [&](double x) { return floor_to_int(std::clamp(x, -kFar, kFar)); };
  return {whole(p.x), whole(p.y), whole(p.z)};
}

}  // namespace tetsoup
