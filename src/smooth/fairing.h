// The two linear solves over the boundary: implicit fairing [Desbrun99 §3], and diffusion of the volume it swept.
#pragma once

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

  /// One step of diffusion of an amount per boundary vertex; their sum stays.
  std::vector<double> spread(const std::vector<double>& amounts, double time) const;

 private:
  /// Solves (N + t K) x = (1 + t) right_side.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_side, double time) const;

  Eigen::VectorXd valence_;                ///< N
  Eigen::SparseMatrix<double> stiffness_;  ///< K
};

}  // namespace tetsoup
