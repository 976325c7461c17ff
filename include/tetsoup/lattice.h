// tetsoup, stage 4: a lattice of tets laid over the pseudo volume, cut by density.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

enum class LatticeKind {
  Five,  ///< Cubes, five tets each [Spillmann06 §4].
  Bcc,   ///< Body-centred cubic: cubes' corners and centres, twelve equal tets a cube.
};

enum class Fit {
  Off,     ///< The frame is what `translate_cells` and `rotate` say.
  Search,  ///< It is searched for from there: translation, rotation and edge, for the best overlap with the volume.
};

enum class Thin {
  Keep,  ///< No tet goes that holds the body together, or without which a part of it would be bare.
  Drop,  ///< Density alone decides.
};

enum class Cover {
  Density,  ///< Tets at least rho_min inside.
  Enclose,  ///< And as many more as it takes for every vertex of the soup to lie in the mesh.
  Inside,   ///< Only tets that are inside altogether.
};

enum class Separate {
  Apart,    ///< Parts of the volume that share a cell but do not touch get a copy of it each.
  Together  ///< One cell, one copy: they are glued.
};

enum class Touching {
  Mend,   ///< No tets joined by a vertex or an edge only: tets are added, dropped or given their own vertices.
  Leave,  ///< The boundary may touch itself.
};

enum class Stairs {
  Even,  ///< Tets that stick out are dropped, notches filled, where density hardly tells: a smoother boundary.
  Leave  ///< Density alone decides.
};

enum class Bubbles { Fill, Keep };

enum class BoundaryOnly {
  Leave,
  Remove,  ///< Tets with four boundary vertices go where the mesh stays in one piece and keeps a manifold boundary.
  Split,   ///< Interior edges between boundary vertices, and tets with four, are split until there are none.
};

/// Clean-up of what density left.
struct TopologyOptions {
  Touching touching = Touching::Mend;
  double min_part = 0.001;  ///< Components with a smaller share of the volume are dropped, [0, 1); 0 keeps all.
  Bubbles bubbles = Bubbles::Fill;
  BoundaryOnly boundary_only = BoundaryOnly::Leave;
  bool operator==(const TopologyOptions&) const = default;
};

/// What the clean-up did.
struct TopologyReport {
  std::size_t touching_mended = 0;      ///< Edges and vertices at which tets merely touched.
  std::size_t tets_added = 0;           ///< To join them,
  std::size_t tets_dropped = 0;         ///< or to part them;
  std::size_t vertices_doubled = 0;     ///< likewise.
  std::size_t parts_dropped = 0;        ///< Components below min_part,
  double dropped_volume = 0;            ///< and their volume.
  std::size_t bubbles_filled = 0;       ///< Voids without a way out,
  std::size_t bubble_tets = 0;          ///< and the tets that fill them.
  std::size_t boundary_only_tets = 0;   ///< Tets with four boundary vertices that were removed or split.
  std::size_t boundary_only_edges = 0;  ///< Interior edges between boundary vertices that were split.
};

inline constexpr std::size_t kDefaultTets = 2000;  ///< Wanted if nothing is said.

/// At most one of `tets`, `vertices`, `edge`, `cells` and `cell_size`; none: kDefaultTets.
struct LatticeOptions {
  std::optional<std::size_t> tets;      ///< Tets wanted, 1..2^27: hit within 5 % from 200 on, 10 % below.
  std::optional<std::size_t> vertices;  ///< Vertices wanted, likewise.
  std::optional<double> edge;           ///< Mean edge of the lattice's tets, in the soup's unit.
  std::optional<int> cells;             ///< Cubic cells along the longest axis of the soup's box, 1..1024.
  std::optional<double> cell_size;      ///< Edge of a cubic cell.
  LatticeKind kind = LatticeKind::Five;
  Vec3d translate_cells;  ///< Shift of the lattice, in fractions of a cell.
  Vec3d rotate;           ///< Radians about x, then y, then z, around the centre of the soup's box.
  Fit fit = Fit::Off;
  double rho_min = 0.5;  ///< A tet stays if at least this share of its voxels is inside, (0, 1].
  Stairs stairs = Stairs::Even;
  Thin thin = Thin::Keep;
  Cover cover = Cover::Density;
  Separate separate = Separate::Apart;
  TopologyOptions topology;
  bool operator==(const LatticeOptions&) const = default;
};

struct LatticeReport {
  std::array<int, 3> cells{0, 0, 0};  ///< Cells along the lattice's axes over the soup's box.
  double cell_size = 0;
  double mean_edge = 0;        ///< Of the tets before smoothing.
  std::size_t used_cells = 0;  ///< Cells with at least one kept tet.
  std::size_t tet_count = 0;
  std::size_t sampled_tets = 0;   ///< Tets that held no voxel centre and were judged by sampling.
  double kept_volume = 0;         ///< Of the kept tets.
  double pseudo_volume = 0;       ///< Of the inside voxels.
  bool kept_by_soup = false;      ///< Density left nothing: the tets the soup passes through were kept instead.
  int fills = 0;                  ///< Lattices filled to hit the wanted count.
  Vec3d translate_cells, rotate;  ///< The frame that was taken.
  Vec3d stretch{1, 1, 1};         ///< Edges of its cells along its axes, in cell sizes: not 1 where flat sides are met.
  double overlap = 0;             ///< IoU of the kept tets with the pseudo volume,
  double overlap_unfitted = 0;    ///< and with the frame as given, where one was searched for.
  std::size_t evened_tets = 0;    ///< Dropped where they stuck out, or added to fill a notch, for a smoother boundary.
  std::size_t thin_tets = 0;      ///< Kept because a piece of the soup would have lost its cover.
  std::size_t enclosing_tets = 0;   ///< Kept to enclose the soup's vertices.
  std::size_t doubled_tets = 0;     ///< Copies made to keep apart what is apart,
  std::size_t parted_vertices = 0;  ///< and vertices doubled between tets that stay what they were.
  double excess_volume = 0;         ///< Of the mesh, outside the pseudo volume,
  double lacking_volume = 0;        ///< and of the pseudo volume, outside the mesh.
  TopologyReport topology;
  std::vector<std::string>
      notes;  ///< What the user should know, and the option that changes it: one sentence or two each.
};

struct LatticeMesh {
  TetMesh mesh;
  LatticeReport report;
};

/// Lays a lattice of tets over the pseudo volume, keeps those that are dense enough, and mends what density leaves.
///
/// A tet's density is the share of inside voxels among all voxels whose centre it holds [Spillmann06 §4], counted
/// exactly: every voxel centre belongs to exactly one tet. A tet too small to hold one is judged at 35 sample points
/// instead. First every tet is kept that holds something of the volume, or of the soup where it has none beside it; of
/// a lone sheet or a needle those that the soup passes through. Parts are kept apart, then the tets below rho_min go as
/// far as that tears, closes and bares nothing. Then come stairs and the clean-up of the topology, as the options say,
/// and the edge is searched for, in at most sixteen fills, with which all that leaves the wanted count. Before that
/// cells that end at the flat sides of the soup are tried, at most four times, if only a count is given.
///
/// @return  Positive tets, faces matching, boundary a closed manifold unless Touching::Leave, never empty if the soup
/// is
///          not; vertices and tets in lattice order, doubled and split ones behind.
/// @throws InvalidInput  if an option is out of range or the lattice would have more than 2^31 tets; Cancelled.
/// Cost: per fill O(cells + voxels near the boundary of the pseudo volume + tets log tets).
LatticeMesh fill_lattice(const PseudoVolume& volume, const CleanSoup& soup, const LatticeOptions& options = {},
                         const Progress& progress = {});

}  // namespace tetsoup
