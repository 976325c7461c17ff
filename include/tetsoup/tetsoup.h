// tetsoup: any triangle soup in, a coarse well-shaped tet mesh out.
//
//   TriangleSoup -> clean_soup -> unsigned_distance -> classify_volume -> fill_lattice -> smooth_tets -> TetMesh
//                   soup.h        distance.h           pseudo_volume.h    lattice.h       smooth.h
//
// mesh_soup() is all of it in one call; Pipeline keeps what a changed option does not touch. C sees tetsoup_c.h.
#pragma once

#ifndef __cplusplus
#include "tetsoup/tetsoup_c.h"
#else

#include "tetsoup/error.h"
#include "tetsoup/progress.h"
#include "tetsoup/types.h"
// The stages, in the order of the flow.
#include "tetsoup/soup.h"
#include "tetsoup/distance.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/lattice.h"
#include "tetsoup/smooth.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/embed.h"
#include "tetsoup/regions.h"
#include "tetsoup/simulate.h"
#include "tetsoup/pipeline.h"

namespace tetsoup {

/// Turns any triangle soup into a tet mesh: all stages, default options unless given.
///
/// @return  Positive tets with the quality floor kept, never empty for a soup with at least one finite triangle.
/// @throws InvalidInput  if an option is out of range or the soup has no finite triangle; Cancelled.
TetMesh mesh_soup(const TriangleSoup& soup, const MeshOptions& options = {}, const Progress& progress = {});

}  // namespace tetsoup

#endif
