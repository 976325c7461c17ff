#include "smooth/sided_points.h"

#include <algorithm>
#include <cmath>

#include "base/tet_geometry.h"
#include "base/tet_locator.h"

namespace tetsoup {

namespace {

constexpr int kMostBuckets = 64;  // Along an axis: about as many as lattices have cells.

/// Whether p lies in the tet, its faces included; false for a tet without volume.
bool holds(const TetCorners& tet, const Vec3d& p) {
  const double volume = signed_volume(tet);
  if (volume == 0) return false;
  for (const auto& face : kTetFaces) {
    const auto corner = [&](std::size_t i) { return tet[static_cast<std::size_t>(face[i])]; };
    if (signed_volume(corner(0), corner(1), corner(2), p) * volume > 0) return false;
  }
  return true;
}

bool around_holds(const TetMesh& mesh, std::span<const std::uint32_t> tets, std::uint32_t vertex, const Vec3d& place,
                  const Vec3d& p) {
  return std::any_of(tets.begin(), tets.end(), [&](std::uint32_t t) {
    TetCorners corners = corners_of(mesh, mesh.tets[t]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (mesh.tets[t][i] == vertex) corners[i] = place;
    }
    return holds(corners, p);
  });
}

/// Of the way to a tet's centre: enough for what TetLocator counts as on a face, less than what embedding does.
constexpr double kPull = 1e-4;

}  // namespace

std::vector<Vec3> pulled_inside(std::span<const Vec3> points, const TetMesh& mesh) {
  std::vector<Vec3> pulled(points.begin(), points.end());
  if (points.empty()) return pulled;
  const TetLocator locator(mesh);
  for (Vec3& point : pulled) {
    if (!is_finite(point)) continue;
    const Vec3d p = to_double(point);
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::uint32_t on_face_of = kNone;
    bool is_held = false;
    locator.visit_holders(p, [&](std::uint32_t t) {
      is_held = is_held || holds(corners_of(mesh, mesh.tets[t]), p);
      on_face_of = std::min(on_face_of, t);
    });
    if (is_held || on_face_of == kNone) continue;
    const TetCorners tet = corners_of(mesh, mesh.tets[on_face_of]);
    point = to_float(p + ((tet[0] + tet[1] + tet[2] + tet[3]) * 0.25 - p) * kPull);
  }
  return pulled;
}

SidedPoints::SidedPoints(std::span<const Vec3> points, const TetMesh& mesh, const Connectivity& links)
    : links_(&links) {
  if (points.empty() || mesh.tets.empty()) return;
  Vec3d lo = to_double(mesh.vertices[mesh.tets[0][0]]), hi = lo;
  for (const Tet& tet : mesh.tets) {
    for (const std::uint32_t v : tet)
      lo = min(lo, to_double(mesh.vertices[v])), hi = max(hi, to_double(mesh.vertices[v]));
  }
  lo_ = lo;
  size_ = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}) / kMostBuckets;
  for (std::size_t axis = 0; axis < 3; ++axis) count_[axis] = kMostBuckets;
  points_ = Groups<Vec3>(std::size_t{kMostBuckets} * kMostBuckets * kMostBuckets, [&](const auto& put) {
    for (const Vec3& p : points) {
      if (is_finite(p)) put(index_of(bucket_of(to_double(p))), p);
    }
  });
}

std::array<int, 3> SidedPoints::bucket_of(const Vec3d& p) const {
  const auto along = [&](double way, int count) {
    return static_cast<int>(std::clamp(std::floor(way / size_), 0.0, static_cast<double>(count - 1)));
  };
  return {along(p.x - lo_.x, count_[0]), along(p.y - lo_.y, count_[1]), along(p.z - lo_.z, count_[2])};
}

std::size_t SidedPoints::index_of(const std::array<int, 3>& b) const {
  return static_cast<std::size_t>((b[2] * count_[1] + b[1]) * count_[0] + b[0]);
}

bool SidedPoints::are_kept(std::uint32_t vertex, const Vec3& before, const TetMesh& mesh) const {
  const Vec3d from = to_double(before), to = to_double(mesh.vertices[vertex]);
  const auto tets = links_->tets[vertex];
  for (const std::uint32_t triangle : links_->boundary_triangles[vertex]) {
    const Triangle& t = links_->triangles[triangle];
    const std::size_t own = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    const Vec3d a = to_double(mesh.vertices[t[(own + 1) % 3]]), b = to_double(mesh.vertices[t[(own + 2) % 3]]);
    const auto first = bucket_of(min(min(from, to), min(a, b))), last = bucket_of(max(max(from, to), max(a, b)));
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          for (const Vec3& point : points_[index_of({x, y, z})]) {
            const Vec3d p = to_double(point);
            if (!holds({from, to, a, b}, p)) continue;
            if (around_holds(mesh, tets, vertex, from, p) != around_holds(mesh, tets, vertex, to, p)) return false;
          }
        }
      }
    }
  }
  return true;
}

}  // namespace tetsoup
