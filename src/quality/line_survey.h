// A mesh and a soup along many parallel lines: what lies in one and not in the other, and what lies in a mesh twice.
#pragma once

#include <vector>

#include "quality/mesh_skin.h"
#include "quality/soup_facts.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// A stretch of a line, for which its middle stands.
struct Stretch {
  Vec3d at;
  double length = 0;
};

struct LineSurvey {
  double mesh = 0;               ///< Length of the lines within the mesh,
  double soup = 0;               ///< and within a closed soup, where parts that overlap count once;
  double nested = 0;             ///< and where more than one of its parts lie.
  double overlap = 0;            ///< Length within two tets of one piece,
  double apart = 0;              ///< and within tets of two pieces.
  std::vector<Stretch> outside;  ///< Of the mesh, outside a closed soup, and farther than `far` from it along the line.
};

/// Lines stand upright in a frame turned against all axes; edges that two triangles share are crossed as one, so that
/// closed surfaces are crossed evenly. Stretches outside are cut to at most `far`.
LineSurvey survey_lines(const TetMesh& mesh, const MeshSkin& skin, const TriangleSoup& soup, const SoupFacts& facts,
                        double far);

}  // namespace tetsoup
