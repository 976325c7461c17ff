// The elastic modes of a free body, and how it yields to loads.
#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/factored_body.h"
#include "calibrate/fields.h"

namespace tetsoup {

/// Of the mass that is added to the stiffness before it is factored, in units of modulus / (density longest^2): far
/// below the first eigenvalue of most bodies, far above rounding.
inline constexpr double kShift = 1e-4;

/// Shapes are orthonormal by mass; an eigenvalue is the square of an angular frequency.
struct Modes {
  std::vector<double> values;  ///< Ascending.
  NodalFields shapes;
};

/// The six motions that cost a free body nothing.
MassOrthonormal rigid_motions(const ElasticBody& body);

/// The first modes beyond the rigid ones: the best combinations, by Rayleigh and Ritz, of the start, of what
/// (K + shift M)^-1 M makes of it, of what that makes of the result, and so on.
///
/// @param start   More columns than modes are wanted, and the nearer to them the better.
/// @param blocks  Times that the inverse is applied.
Modes find_modes(const ElasticBody& body, const FactoredBody& factored, const MassOrthonormal& rigid,
                 const NodalFields& start, std::size_t count, int blocks, StageWatch& watch);

/// Displacements under forces per mass, u = K^-1 M a with what would only carry the body off left out, and the
/// work u . M a that is done.
struct Yielding {
  NodalFields displacements;
  SmallMatrix work;  ///< (loads, loads)
};
Yielding yield_to(const ElasticBody& body, const FactoredBody& factored, const MassOrthonormal& rigid,
                  const NodalFields& accelerations);

}  // namespace tetsoup
