// Tets that stick out of the mesh, and notches, where density hardly tells what is right.
#pragma once

#include <cstddef>

#include "lattice/candidates.h"

namespace tetsoup {

/// Drops tets that stick out by two faces or more and adds such that fill a notch, where that saves more boundary than
/// it costs volume. A tet with two faces on the boundary keeps an edge there that no smoothing can flatten.
///
/// Only tets whose density is not clear are touched, twice at most, and only where the kept tets around each of its
/// vertices stay one piece: thin parts may lose a corner, but nothing falls apart.
///
/// @param rho_min  From which density on tets were kept.
/// @return  Tets dropped and added.
std::size_t even_out(Candidates& candidates, double rho_min);

}  // namespace tetsoup
