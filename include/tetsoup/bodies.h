// tetsoup, between stages 1 and 2: which parts of a soup make a body, meshed on a grid of its own?
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Which parts are one body.
enum class Join {
  Touching,  ///< Those that touch, overlap or lie inside each other; open and loose parts with what is near them.
  Near,      ///< All: one grid, in which parts of the volume closer than its voxels can tell are one.
  All,       ///< All, and the lattice glues what shares a cell.
};

struct Bodies {
  std::vector<std::vector<std::uint32_t>> triangles;  ///< Of every body, ascending; bodies by their first triangles.
  std::vector<double> near;  ///< Of every body: parts of it that do not touch are closer than this; 0 where all touch.
  std::vector<std::uint32_t> specks;  ///< Triangles that belong to none: far too small to be a body beside the others.
  std::vector<std::uint32_t> around;  ///< For SoupParts::around.
};

/// Splits a soup into bodies.
///
/// Closed parts that neither touch nor contain each other are bodies of their own, whatever the gap, as long as it is
/// wider than 1/256 of the model, the hairline gaps of assembled models. Parts with rims (open, loose) join what lies
/// within a sixteenth of their extent, and closed parts whose boxes they reach. A flat part eight times as large as all
/// others, such as a ground plane, stays by itself even where things stand on it.
/// @throws Cancelled  if `progress` says so.
/// Cost: O(n log n).
Bodies split_bodies(const CleanSoup& soup, Join join = Join::Touching, const Progress& progress = {});

/// What a body asks of its grid and of the budget.
struct BodySize {
  double longest = 0;  ///< Side of its box.
  double volume = 0;   ///< Enclosed, where windings or closedness tell; else a guess from the box.
  double area = 0;
  bool rims = false;                ///< Some part of it is open.
  std::optional<double> wall, gap;  ///< The thinnest wall and the narrowest gap that take a share of the area.
};

/// Sizes of the bodies of a soup.
/// Cost: O(n log n), some 10 ms for walls and gaps, which are looked for from some thousand points.
std::vector<BodySize> measure_bodies(const CleanSoup& soup, const Bodies& bodies, const Progress& progress = {});

/// Tets for every body out of `tets`: by volume and area, with a floor for each; 1 where there are too few for that,
/// and 0, for the smallest, where there are fewer tets than bodies.
std::vector<std::size_t> share_tets(std::span<const BodySize> bodies, std::size_t tets);

/// Edge of the voxels for a body of so many tets: at most a 128th of its longest side (of a body among others, an
/// eighth of a tet's edge), and fine enough for its walls and gaps as far as a grid can be.
double wanted_voxel_size(const BodySize& body, std::size_t tets, bool alone);

/// The soup of some triangles of a clean one, `chosen` ascending: clean as well. Its report tells counts of triangles,
/// vertices and parts, box and class; its parts are those of the triangles, renumbered.
CleanSoup subset_of(const CleanSoup& soup, std::span<const std::uint32_t> chosen);

}  // namespace tetsoup
