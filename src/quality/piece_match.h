// Which piece of a mesh stands for which piece of its soup.
#pragma once

#include "base/triangle_boxes.h"
#include "quality/mesh_skin.h"
#include "quality/soup_facts.h"
#include "tetsoup/quality.h"

namespace tetsoup {

/// Counts the pieces of both, and what was torn, joined or lost of them, into `found`, whose mean edge is known.
void match_pieces(const TetMesh& mesh, const MeshSkin& skin, const TriangleBoxes& of_skin, const TriangleSoup& soup,
                  const SoupFacts& facts, const TriangleBoxes& of_soup, Fidelity& found);

}  // namespace tetsoup
