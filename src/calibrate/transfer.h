// What the fine mesh has to tell the coarse one: where its vertices lie in it, and how much of each tet it fills.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "calibrate/fields.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Mass, first and second moments about the origin: what a rigid motion can know of a body.
struct MassMoments {
  double mass = 0;
  Vec3d first{};
  std::array<double, 6> second{};  ///< xx, yy, zz, xy, yz, zx.
};
MassMoments moments_of(const ElasticBody& body, const std::vector<double>& density);

/// The coarse mesh's fields at the points of the fine one.
class Prolongation {
 public:
  /// @param mesh   The coarse one.
  Prolongation(const TetMesh& mesh, const std::vector<Vec3>& points);
  NodalFields operator()(const NodalFields& fields, const std::vector<Tet>& tets) const;

 private:
  std::vector<std::uint32_t> tets_;
  std::vector<std::array<double, 4>> weights_;
};

/// The share of every coarse tet that the fine mesh fills, by mass, what lies beyond counting for the nearest; then
/// corrected by the least relative change with which mass, centre and second moments are those of the fine mesh.
///
/// @param own  (tets) Density of the coarse tets, over that of the material.
/// @return     (tets) To multiply it by.
std::vector<double> fill_densities(const TetMesh& mesh, const ElasticBody& coarse, const std::vector<double>& own,
                                   const TetMesh& fine_mesh, const ElasticBody& fine,
                                   const std::vector<double>& fine_density);

}  // namespace tetsoup
