#include "lattice/reach.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/tet_geometry.h"
#include "base/whole.h"

namespace tetsoup {
namespace {

/// Mean edges of the lattice, from the middle of what a tet holds to a tet that covers it. At .25 flat sides get
/// rougher, at .45 fins as deep as a tet go.
constexpr double kNear = 0.36;
/// 56 points in a tet, and 560 if none of them is in the body.
constexpr std::array<unsigned, 2> kSampleOrders{5, 13};

using Plane = std::array<double, 4>;  ///< Distance of p outside a face: dot(p, the first three) + the last.
using Planes = std::array<Plane, 4>;

Planes planes_of(const TetCorners& p) {
  Planes planes;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [&](std::size_t k) { return p[static_cast<std::size_t>(kTetFaces[i][k])]; };
    Vec3d n = cross(corner(1) - corner(0), corner(2) - corner(0));
    n = n * (1 / length(n));
    planes[i] = {n.x, n.y, n.z, -dot(n, corner(0))};
  }
  return planes;
}

/// Whether the point lies no farther than `reach` outside any face. Beyond an edge or a corner that is a little more.
bool is_near(const Planes& planes, const Vec3d& p, double reach) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Plane& n) { return n[0] * p.x + n[1] * p.y + n[2] * p.z + n[3] <= reach; });
}

/// Mean of the sample points that lie in the body, corners in voxels; none if none does.
std::optional<Vec3d> middle_of_content(const TetCorners& p, const BitGrid& body, unsigned order) {
  const auto weight = [&](unsigned i) { return (i + 0.25) / (order + 1); };
  Vec3d sum;
  int count = 0;
  for (unsigned a = 0; a <= order; ++a) {
    for (unsigned b = 0; a + b <= order; ++b) {
      for (unsigned c = 0; a + b + c <= order; ++c) {
        const Vec3d at = p[0] * weight(a) + p[1] * weight(b) + p[2] * weight(c) + p[3] * weight(order - a - b - c);
        const int x = floor_to_int(at.x + 0.5), y = floor_to_int(at.y + 0.5), z = floor_to_int(at.z + 0.5);
        if (!body.frame.contains(x, y, z) || !body.test(x, y, z)) continue;
        sum += at;
        ++count;
      }
    }
  }
  if (count == 0) return {};
  return sum * (1.0 / count);
}

/// Of a voxel or two, or of a sheet between voxels' centres, the points know nothing: then it is the middle of the tet.
Vec3d middle_of_content(const TetCorners& p, const BitGrid& body) {
  for (const unsigned order : kSampleOrders)
    if (const auto middle = middle_of_content(p, body, order)) return *middle;
  return (p[0] + p[1] + p[2] + p[3]) * 0.25;
}

}  // namespace

Reach find_reach(const TetComplex& complex, const ReachLimits& limits, const BitGrid& body, StageWatch& watch) {
  constexpr std::int64_t kGrain = 64;  // tets
  const std::uint32_t tets = complex.tet_count();
  const double reach = kNear * lattice_edge(complex.mesh()) / body.frame.voxel_size;
  std::vector<Planes> planes(tets);
  std::vector<std::vector<std::uint32_t>> near(tets);
  const auto corners = [&](std::uint32_t t) {
    return corners_in_voxels(complex.mesh(), complex.corners(t), body.frame);
  };
  const auto for_each_kept = [&](const auto& visit) {
    parallel_for(tets, kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
      for (auto t = static_cast<std::uint32_t>(begin); t < static_cast<std::uint32_t>(end); ++t)
        if (complex.is_kept(t)) visit(t);
    });
  };
  const auto serves = [&](std::uint32_t t) { return complex.is_kept(t) && complex.density(t) >= limits.serving; };
  for_each_kept([&](std::uint32_t t) { planes[t] = planes_of(corners(t)); });
  for_each_kept([&](std::uint32_t t) {
    if (complex.density(t) <= 0 || complex.density(t) >= limits.going) return;
    const Vec3d middle = middle_of_content(corners(t), body);
    for (const std::uint32_t v : complex.corners(t))
      for (const std::uint32_t n : complex.around(v))
        if (n != t && serves(n) && is_near(planes[n], middle, reach)) near[t].push_back(n);
    std::sort(near[t].begin(), near[t].end());
    near[t].erase(std::unique(near[t].begin(), near[t].end()), near[t].end());
  });
  Reach found;
  found.count.assign(tets, 0);
  for (std::uint32_t t = 0; t < tets; ++t) found.count[t] = static_cast<std::uint32_t>(near[t].size());
  found.served = Groups<std::uint32_t>(tets, [&](const auto& put) {
    for (std::uint32_t t = 0; t < tets; ++t)
      for (const std::uint32_t n : near[t]) put(n, t);
  });
  return found;
}

}  // namespace tetsoup
