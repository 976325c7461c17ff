// A piece of a body at rest: its tets in batches for the solver, and what they are made of.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/tet_geometry.h"
#include "kernel/relax_tets.h"
#include "tetsoup/simulate.h"

namespace tetsoup::simulate {

/// Pieces with more tets are solved by all threads at once, smaller ones by one thread each.
inline constexpr std::size_t kSharedTets = 4000;

/// Edges that waves of elasticity and viscosity together may pass in a substep: columns and beams then sag by at most
/// 1.4 times what theory says; where it is 1, by 1.8.
inline constexpr double kMostEdges = 0.7;

/// Tets that hang together by vertices.
struct Piece {
  std::vector<Vec3d> places;            ///< At rest, in metres.
  std::vector<Tet> tets;                ///< Of positive volume, into `places`.
  std::vector<std::uint32_t> vertices;  ///< Of the mesh, for each place.
  double mean_edge = 0;                 ///< Of the tets, m.
};

/// The pieces of a mesh, by their first tets; tets that cannot be simulated are in none.
std::vector<Piece> split_pieces(const TetMesh& mesh, double scale);

/// What the instances of a piece share.
struct Rest {
  Piece piece;
  SimMaterial material;
  std::vector<double> masses;             ///< A quarter of its tets' for every vertex.
  std::vector<std::uint8_t> held;         ///< Pinned vertices; a part with one has a Rest of its own.
  std::size_t held_count = 0;             ///< Of them.
  std::size_t padded_count = 0;           ///< Vertices in whole blocks, with at least one of no mass.
  std::vector<std::uint32_t> lanes;       ///< Place of each tet in the batches: batch * kTetLanes + lane.
  std::vector<kernel::TetBatch> batches;  ///< Responses and compliances as `prepare` made them.
  /// Ends of runs of batches: one round after the other; runs of a round share no vertex.
  std::vector<std::vector<std::size_t>> rounds;
  double prepared_for = 0;       ///< Substep, s.
  bool is_solved_whole = false;  ///< By the coupled system, not tet by tet; as choose_schemes() has it.
  std::size_t part_count = 0;    ///< That share it.

  double shear_modulus() const { return material.elastic.young / (2 * (1 + material.elastic.poisson)); }
  double lame() const {
    const double nu = material.elastic.poisson;
    return material.elastic.young * nu / ((1 + nu) * (1 - 2 * nu));
  }
  /// In which a wave along a rod passes an edge, s.
  double wave_time(double edge) const { return edge / std::sqrt(material.elastic.young / material.elastic.density); }
  /// What is taken of the material's damping in substeps of h where edges are so long, s.
  double damping_time(double h, double edge) const;
  double inverse_mass(std::size_t v) const { return held[v] != 0 ? 0 : 1 / masses[v]; }
  bool is_held() const { return held_count > 0; }
};

Rest make_rest(Piece piece, const SimMaterial& material);

/// Of the strain at the start of a substep, which viscosity holds on to.
double share_of(double damping_time, double h);

/// Makes the batches' constants for substeps of h.
void prepare(Rest& rest, double h);

inline TetCorners corners_at(const std::vector<Vec3d>& places, const Tet& tet) {
  return {places[tet[0]], places[tet[1]], places[tet[2]], places[tet[3]]};
}

}  // namespace tetsoup::simulate
