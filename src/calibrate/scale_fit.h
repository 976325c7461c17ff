// The change of the tets' moduli after which a piece has the eigenvalues and the compliance of its reference.
#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "calibrate/modes.h"
#include "tetsoup/calibrate.h"

namespace tetsoup {

/// What a body is compared by.
struct Behaviour {
  std::vector<double> eigenvalues;  ///< Ascending, elastic.
  std::vector<double> compliances;  ///< Work that loads do.
};

/// What is known of the reference, and the loads it was asked with.
struct MotionTarget {
  Behaviour wanted;
  SmallMatrix loads;  ///< (kLoadFields, loads): combinations of load_fields().
};

inline constexpr std::size_t kLoadFields = 27;
/// Accelerations that grow linearly and quadratically with the place, along each axis.
NodalFields load_fields(const ElasticBody& body);
/// To begin a search for modes with: polynomials, and noise for what they all miss.
NodalFields first_guess(const ElasticBody& body, std::size_t columns);

/// Loads that vary across the body in ways that have nothing to do with its modes: each a combination, by noise, of all
/// of load_fields(). That they are right says that shapes and couplings of the modes are.
MotionTarget varied_loads(const Yielding& yielding);

struct ScaleFit {
  std::vector<double> scale;  ///< (tets)
  double factor = 1;          ///< The best for all.
  Behaviour before, one, after;
};

/// @param stiffness  (tets) of the coarse piece, over that of the material; density likewise, as calibrated.
/// @param filled     (tets) What the reference fills of each.
ScaleFit fit_scales(ElasticBody& body, const std::vector<double>& stiffness, const std::vector<double>& density,
                    const std::vector<double>& filled, const MotionTarget& target, const CalibrateOptions& options,
                    StageWatch& watch);

}  // namespace tetsoup
