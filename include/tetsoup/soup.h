// tetsoup, stage 1: what is this soup, and which of its triangles can be used?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// What the soup's own edges say it is.
enum class SoupClass {
  Closed,  ///< Every edge has two triangles, or more where parts touch: no open edge.
  Open,    ///< A surface with open edges: holes, sheets.
  Soup,    ///< Mostly unconnected: at least half as many open edges as triangles.
  Empty,   ///< No finite triangle.
};

/// Diagnosis. Vertices count as one where their positions are bitwise equal (-0 equals 0), as in most files without
/// indices.
struct SoupReport {
  std::size_t vertex_count = 0;        ///< As given.
  std::size_t triangle_count = 0;      ///< As given.
  std::size_t index_out_of_range = 0;  ///< Triangles dropped: an index beyond the vertices.
  std::size_t non_finite = 0;          ///< Triangles dropped: a coordinate is NaN, infinite or beyond 1e30.
  std::size_t duplicates = 0;          ///< Triangles dropped: the same three positions, in any order, stand before.
  std::size_t zero_area = 0;        ///< Triangles kept as the segment or the point they are (duplicates not counted).
  std::size_t used_triangles = 0;   ///< What is left: triangle_count less all that was dropped.
  std::size_t merged_vertices = 0;  ///< Distinct positions of the used triangles.
  std::size_t components = 0;       ///< Joined through shared vertices.
  std::size_t boundary_edges = 0;   ///< Edges of one triangle.
  std::size_t non_manifold_edges = 0;  ///< Edges of three or more triangles.
  std::size_t inconsistent_edges = 0;  ///< Edges of two triangles that run along them in the same direction.
  SoupClass kind = SoupClass::Empty;
  Vec3d origin;  ///< The soup's own,
  Box3 box;      ///< and the box of the used triangles, counted from it.
  std::vector<std::string>
      notes;  ///< What the user should know, and the option that changes it: one sentence or two each.
};

/// Triangles that hang together through edges.
struct SoupPart {
  std::size_t triangles = 0;
  bool sound = false;     ///< Closed: every edge has an even number of its triangles. A ray crosses it evenly.
  bool oriented = false;  ///< Sound, and as many triangles run along each edge one way as the other.
  double volume = 0;      ///< Signed, of an oriented part: negative where it is turned inside out.
  Box3 box;
};

/// What of a soup can be trusted: where every ray crosses a closed surface, crossings tell inside from outside exactly.
/// The only place that knows windings; they are evidence for sound parts and leave no trace in others.
struct SoupParts {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> part_of_triangle;
  std::vector<SoupPart> parts;       ///< In the order of their first triangles.
  std::vector<std::uint8_t> turned;  ///< Of every triangle: it ran from its lowest vertex to the highest.
  std::vector<std::array<std::uint32_t, 2>> odd_edges;  ///< Edges of an odd number of triangles: rims of holes.
  /// Of every part the innermost sound part around it that it does not touch, or kNone; empty until somebody asks
  /// (split_bodies()).
  std::vector<std::uint32_t> around;
  double near = 0;  ///< Parts closer than this hang together.
};

/// The soup in its canonical form: distinct positions in lexicographic order, each triangle's indices ascending,
/// triangles in order and unique. Winding, triangle order and vertex order of the input leave no trace, so no later
/// stage can see them.
struct CleanSoup {
  TriangleSoup soup;
  SoupReport report;
  SoupParts parts;
};

/// A soup of points in double precision. If they lie farther from zero than 16 times their size, it gets an origin
/// among them, a multiple of a power of two about as large as they are; else their floats are what a plain conversion
/// gives. Few points far off, and such as no triangle uses, have no say in where that is.
TriangleSoup make_soup(std::span<const Vec3d> vertices, std::vector<Triangle> triangles);

/// Drops what cannot be used, counts all of it, and describes the rest.
///
/// Edge counts (boundary, non-manifold, inconsistent) are taken before duplicates are dropped, since a doubled sheet is
/// a fact about the file; triangles with two equal corners have no edges to count.
///
/// @throws Cancelled  if `progress` says so. Never throws on geometry; an empty result has class Empty.
/// Cost: O(n) time and memory, but for sorting what meets at one vertex; partly on all threads.
CleanSoup clean_soup(const TriangleSoup& soup, const Progress& progress = {});

}  // namespace tetsoup
