// tetsoup: a coarse body that moves like the fine one: stiffness and density of every tet, made for that.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tetsoup/pipeline.h"
#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// For materials that nobody chose: factors differ by a few per cent between .3 and .4.
inline constexpr double kUsualPoisson = 0.35;

struct CalibrateOptions {
  std::size_t reference_tets = 40000;  ///< Of the fine mesh whose motion is taken, 1000..400000.
  double poisson = 0.3;                ///< Poisson ratio of the material, [0, 0.49].
  int modes = 30;                      ///< Elastic modes of every piece that are compared, 6..60.
  int rounds = 8;                      ///< Corrections of the tets, of whole parts and then of single ones, 1..50.
  double least_stiffness = 1e-3;       ///< Of a tet, over that of its material, (0, 1],
  double most_stiffness = 4;           ///< and the most, [1, 1000].
  bool operator==(const CalibrateOptions&) const = default;
};

/// A mesh, and of what its tets are made, over one material for all; empty: of that.
struct ElasticMesh {
  const TetMesh* mesh = nullptr;
  std::span<const double> stiffness;  ///< (tets) Young's modulus, over that of the material.
  std::span<const double> density;    ///< (tets)
};

/// Mean errors of eigenfrequencies, |f / reference - 1|, and of the work that loads do, over that of the reference.
struct MotionError {
  double low = 0;         ///< Of the first ten elastic eigenfrequencies.
  double high = 0;        ///< Of those from the eleventh on.
  double compliance = 1;  ///< Median over forty loads that vary across the body; below 1: too stiff.
  double load = 0;        ///< Mean of the absolute logarithm over them.
};

struct CalibrateReport {
  std::size_t reference_tets = 0;
  std::size_t pieces = 0;          ///< Connected pieces of the mesh,
  std::size_t uncalibrated = 0;    ///< and those that the reference has not as pieces: they take the mean factor.
  std::size_t modes = 0;           ///< Compared, of all pieces.
  MotionError before, one, after;  ///< As it is, with one factor, calibrated: mean over pieces by volume.
  double least_stiffness = 1, most_stiffness = 1;
  double least_density = 1, most_density = 1;
  double mass_error = 0;     ///< |mass / reference - 1| afterwards,
  double centre_error = 0;   ///< distance of the centres of mass, in the longest sides of pieces: the largest,
  double inertia_error = 0;  ///< and the largest error of second moments, over the largest of them.
};

struct Calibration {
  std::vector<float> stiffness_scale;  ///< (tets) Young's modulus of each over that of its material, above zero.
  std::vector<float> density_scale;    ///< (tets) Density likewise.
  double factor = 1;                   ///< The best single factor of Young's modulus, for engines that take one.
  CalibrateReport report;
};

/// Finds for every tet what to multiply stiffness and density by, so that the coarse mesh has the eigenfrequencies, the
/// compliance and the mass of the fine one.
///
/// Linear tets are too stiff in bending, the more the fewer there are across, and a coarse mesh covers what the model
/// does not [Kharevych09, Nesme09]. Reference and mesh are compared as free linear elastic bodies: their first modes,
/// in their order, and the work under loads that vary across the body. The least and smoothest change of the
/// logarithms of the tets' moduli that makes them alike is found by regularised Gauss-Newton steps, for which the share
/// of a mode's energy that a tet holds is the exact derivative. Density is what the reference fills of each tet,
/// corrected so that mass, centre and second moments are the reference's. It depends on shape and Poisson ratio alone,
/// neither on size nor on Young's modulus.
///
/// @param mesh       Positive tets; any tool's.
/// @param reference  The same body, fine; calibration_reference() makes one.
/// @throws InvalidInput  if a mesh has no tet, an index or an option is out of range, or sizes differ; Cancelled.
/// Cost: factors a matrix of the reference's vertices: with all modes 2.5 s of a processor at 40,000 tets, and 120 MB
/// for the factor, measured on a horse.
Calibration calibrate_tets(const ElasticMesh& mesh, const ElasticMesh& reference, const CalibrateOptions& options = {},
                           const Progress& progress = {});

/// The fine mesh of a soup, by the same stages with the same options but for the number of tets and finer voxels.
TetMesh calibration_reference(const TriangleSoup& soup, const MeshOptions& options, std::size_t tets,
                              const Progress& progress = {});

}  // namespace tetsoup
