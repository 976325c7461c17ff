#include "tetsoup/readiness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/elementary.h"
#include "base/require.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"

namespace tetsoup {
namespace {

constexpr double kMinDihedral = 20, kMaxDihedral = 155;  ///< Degrees; outside, elements lock and time steps shrink.
constexpr double kMaxEdgeRatio = 3.5;
constexpr double kMaxVolumeRatio = 200;   ///< Largest over smallest tet: that is a hundredth of the mean, or less.
constexpr double kMaxBoundaryOnly = 0.5;  ///< Share of tets without an interior vertex: beyond, the body is too stiff.
constexpr double kLongestLost = 1.5;    ///< Edges of the model without mesh: less is the coarseness that was asked for.
constexpr double kLeastVolume = 0.9;    ///< Of the model's; what is more, Fidelity says.
constexpr double kMostStray = 0.02;     ///< Share of the mesh that stands where nothing of the model is near.
constexpr double kMostOverlap = 0.001;  ///< Share of the mesh within two tets: contacts begin there.
constexpr double kMostTilted = 0.1;     ///< Share of a flat model's boundary that is dented.
constexpr double kRounding = 1e-6;      ///< Relative; a limit that was met by construction counts as met.

/// Largest eigenvalue of the symmetric matrix (a d e; d b f; e f c) [Smith61].
double largest_eigenvalue(double a, double b, double c, double d, double e, double f) {
  const double mean = (a + b + c) / 3, off = d * d + e * e + f * f;
  const double x = a - mean, y = b - mean, z = c - mean;
  const double p = std::sqrt((x * x + y * y + z * z + 2 * off) / 6);
  if (p == 0) return mean;
  const double half_determinant = (x * (y * z - f * f) - d * (d * z - e * f) + e * (d * f - y * e)) / (2 * p * p * p);
  return mean + 2 * p * elementary::cos(elementary::acos(std::clamp(half_determinant, -1.0, 1.0)) / 3);
}

/// Of the sum of g g^T over the gradients of the barycentric coordinates; infinite for a tet without volume.
double largest_gradient_eigenvalue(const TetCorners& p) {
  const double volume = signed_volume(p);
  if (!(volume > 0)) return std::numeric_limits<double>::infinity();
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  for (const auto& face : kTetFaces) {
    const Vec3d a = p[static_cast<std::size_t>(face[0])], b = p[static_cast<std::size_t>(face[1])],
                c = p[static_cast<std::size_t>(face[2])];
    const Vec3d g = cross(b - a, c - a) * (1 / (6 * volume));
    xx += g.x * g.x, yy += g.y * g.y, zz += g.z * g.z;
    xy += g.x * g.y, xz += g.x * g.z, yz += g.y * g.z;
  }
  return largest_eigenvalue(xx, yy, zz, xy, xz, yz);
}

double stable_time_step(const TetMesh& mesh, const Material& material) {
  double largest = 0;
  for (const Tet& tet : mesh.tets) {
    if (!is_valid_tet(tet, mesh.vertices.size())) continue;
    largest = std::max(largest, largest_gradient_eigenvalue(corners_of(mesh, tet)));
  }
  if (!(largest > 0) || std::isinf(largest)) return 0;
  return material.metres_per_unit *
         std::sqrt(material.density * (1 - 2 * material.poisson) / (material.young * largest));
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

ReadinessCheck at_most(std::string_view name, std::string_view title, double value, double limit,
                       std::string_view advice) {
  return {name, title, value, limit, false, value <= limit * (1 + kRounding), advice};
}
ReadinessCheck at_least(std::string_view name, std::string_view title, double value, double limit,
                        std::string_view advice) {
  return {name, title, value, limit, true, value >= limit * (1 - kRounding), advice};
}

/// Only what the soup has a truth for.
void add_fidelity(const Fidelity& f, const Quality& quality, std::vector<ReadinessCheck>& checks) {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const bool is_layer = 2 * quality.volume < quality.boundary_area * f.mean_edge;  // thinner than a tet: no room inside
  for (ReadinessCheck& check : checks) {
    if (check.name == "components")
      check = at_most(check.name, check.title, check.value, std::max(1.0, count(f.soup_pieces)), check.advice);
    if (check.name == "boundary_only_share" && is_layer)
      check = at_most(check.name, check.title, check.value, 1, check.advice);
  }
  checks.push_back(at_most("lost_edges", "longest stretch of the model without mesh, edges", f.lost_edges, kLongestLost,
                           "more voxels, a lower rho-min (0.2), or more tets"));
  checks.push_back(at_most("lost_pieces", "pieces of the model without mesh", count(f.lost_pieces), 0,
                           "min-part = 0 keeps small pieces; more tets make room for all"));
  checks.push_back(at_most("torn_pieces", "pieces that the model has in one", count(f.torn_pieces), 0,
                           "a lower rho-min (0.2) or more tets; to drop crumbs, a min-part of 0.05"));
  checks.push_back(at_most("joined_pieces", "pieces joined that the model has apart", count(f.joined_pieces), 0,
                           "more voxels and more tets, or mesh the parts one by one"));
  checks.push_back(at_most("overlap_share", "share of the mesh that lies in it twice", f.overlap_share, kMostOverlap,
                           "no snapping (snap = off), fewer passes, or another tet count"));
  if (f.closed) {
    checks.push_back(at_least("volume_share", "volume over the model's, at least", f.volume_ratio, kLeastVolume,
                              "more voxels, a lower rho-min (0.3), or more tets"));
    checks.push_back(at_most("volume_ratio", "volume over the model's, at most", f.volume_ratio, f.volume_limit,
                             "more voxels where walls are thinner than a few of them, and more tets where they are "
                             "thinner than a tet"));
    checks.push_back(at_most("stray_share", "share of the mesh away from the model", f.stray_share, kMostStray,
                             "what is open was filled: more voxels, or cavities = keep for what is closed"));
  }
  if (f.closed && f.soup_pieces == 1)
    checks.push_back(at_most("tunnels", "holes through the mesh", f.mesh_tunnels, f.soup_tunnels,
                             "a lower rho-min (0.2), more voxels, or more tets"));
  if (f.flat)
    checks.push_back(at_most("tilted_share", "share of a flat model's surface that is dented", f.tilted_share,
                             kMostTilted, "more tets, or turn the lattice (rotate, fit = search)"));
}

bool all_pass(const std::vector<ReadinessCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const ReadinessCheck& c) { return c.passed; });
}

}  // namespace

void check_material(const Material& m) {
  require(m.density > 0 && std::isfinite(m.density), "density", m.density, "above 0 and finite, in kg/m^3");
  require(m.young > 0 && std::isfinite(m.young), "young", m.young, "above 0 and finite, in Pa");
  require(m.poisson >= 0 && m.poisson < 0.5, "poisson", m.poisson, "at least 0 and below 0.5");
  require(m.metres_per_unit > 0 && std::isfinite(m.metres_per_unit), "metres_per_unit", m.metres_per_unit,
          "above 0 and finite");
}

Readiness assess_readiness(const TetMesh& mesh, const Quality& quality, const Material& material) {
  check_material(material);
  constexpr double kDegrees = 180 / std::numbers::pi;
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  Readiness result;
  result.checks = {
      at_least("tet_count", "tets", count(quality.tet_count), 1, "mesh something that has a volume"),
      at_most("inverted_tets", "tets without positive volume", count(quality.inverted_tets + quality.invalid_tets), 0,
              "mesh the soup again: no engine takes such tets"),
      at_least("min_dihedral_deg", "smallest dihedral angle, degrees", quality.min_dihedral * kDegrees, kMinDihedral,
               "raise the smoothing's min-angle (25 by default)"),
      at_most("max_dihedral_deg", "largest dihedral angle, degrees", quality.max_dihedral * kDegrees, kMaxDihedral,
              "raise the smoothing's min-angle, or take fewer passes"),
      at_most("max_edge_ratio", "longest over shortest edge of a tet", quality.max_edge_ratio, kMaxEdgeRatio,
              "raise the smoothing's min-angle, or take fewer passes"),
      at_most("tet_volume_ratio", "largest over smallest tet",
              quality.min_tet_volume > 0 ? quality.max_tet_volume / quality.min_tet_volume
                                         : std::numeric_limits<double>::infinity(),
              kMaxVolumeRatio, "raise the smoothing's min-angle, or take fewer passes"),
      at_most("non_manifold", "edges and vertices where the boundary touches itself",
              count(quality.non_manifold_edges + quality.non_manifold_vertices), 0,
              "let the clean-up mend what touches (touching = mend)"),
      at_most(
          "components", "pieces that share no face", count(quality.components), 1,
          "to join what is meant to be one, a lower rho-min (0.2) or more tets; to drop crumbs, a min-part of 0.05"),
      at_most("boundary_only_share", "share of tets without an interior vertex",
              share(quality.boundary_only_tets, quality.tet_count), kMaxBoundaryOnly,
              "they make thin parts stiff: more tets, or boundary-only = split"),
  };
  result.passed = all_pass(result.checks);
  result.mass = material.density * quality.volume * elementary::cube(material.metres_per_unit);
  result.stable_time_step = stable_time_step(mesh, material);
  return result;
}

Readiness assess_readiness(const TetMesh& mesh, const Quality& quality, const Fidelity& fidelity,
                           const Material& material) {
  Readiness result = assess_readiness(mesh, quality, material);
  add_fidelity(fidelity, quality, result.checks);
  result.passed = all_pass(result.checks);
  return result;
}

}  // namespace tetsoup
