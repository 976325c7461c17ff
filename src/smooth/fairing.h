// The two linear solves over the boundary: implicit fairing [Desbrun99 §3], and diffusion of the volume it swept.
#pragma once

#include "base/eigen_settings.h"

#include <Eigen/SparseCore>
#include <vector>

#include "smooth/connectivity.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Backward Euler (I - t L) x' = x with the umbrella operator L over the edges of the boundary triangles. Multiplied by
/// the numbers of edges n it reads (N + t K) x' = N x with K = N - adjacency: symmetric and positive definite.
///
/// Scale-dependent weights (by one over the edge length, and its square) gave the same trade of roughness against
/// fidelity on lattice boundaries, whose edges differ by sqrt(2) only; so the plain umbrella, the same in every pass.
class BoundaryFlow {
 public:
  explicit BoundaryFlow(const Connectivity& links);

  /// How far one step moves the boundary vertices; in and out in the order of Connectivity::boundary.
  std::vector<Vec3d> fair(const std::vector<Vec3d>& positions, double time) const;

  /// Spreads a volume per boundary vertex over its neighbourhood by one step of diffusion, as a layer on the surface:
  /// (A + t s K) u = v, where A is the surface area each vertex stands for and s = sum A / sum N makes t a time in
  /// edges.
  /// @return  The layer's thickness u at each vertex; the volumes A u add up to those given.
  std::vector<double> spread(const std::vector<double>& volumes, const std::vector<double>& areas, double time) const;

 private:
  Eigen::VectorXd valence_;                ///< N
  Eigen::SparseMatrix<double> stiffness_;  ///< K
};

}  // namespace tetsoup
