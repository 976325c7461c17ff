// How thick a soup's walls are, how wide its gaps, and where it is a sheet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "tetsoup/types.h"

namespace tetsoup {

enum class SpaceKind : std::uint8_t {
  Wall,     ///< Within a closed part.
  Gap,      ///< In none, between closed parts.
  Unknown,  ///< Beside a part that is open, or in several that are closed.
};

/// What a point of the surface sees along its normal, to either side: a surface that faces it.
struct FacingSample {
  std::uint32_t triangle = 0, opposite = 0;
  float distance = 0;
  float slope = 0;  ///< Tangent of the angle between the two planes; 1 at most.
  SpaceKind kind = SpaceKind::Unknown;
};

struct ThinSpaces {
  std::vector<FacingSample> samples;  ///< By triangle; two or none of a point are possible.
  std::size_t point_count = 0;        ///< That looked to both sides; each stands for as much of the area.
  double area = 0;                    ///< Of the soup.
  double doubled_share = 0;  ///< Of the area: another face within 1e-4 of the soup's size, as in doubled sheets.
  double free_share = 0;     ///< Of the area: nothing lies to either side.

  /// The distance below which spaces of this kind take `share` of the area; none where they take less.
  std::optional<double> distance_below(SpaceKind kind, double share) const;

  /// The distance of the thinnest spaces that take at least `share` of the area at nearly the same distance. A wall
  /// does; the tip of a wedge, where the distance falls to nothing, does not, whatever its area.
  std::optional<double> thinnest(SpaceKind kind, double share) const;
};

/// Enough for what takes half a percent of the area.
inline constexpr std::size_t kThinPoints = 4096;

/// Looks from points that are spread over the surface by area, the same ones each time. A surface faces the point where
/// it is the first that the ray meets, and turned by less than 45 degrees; not where its triangle meets the point's in
/// a crease. Winding has no part in it.
///
/// @param soup              Clean: distinct positions.
/// @param part_of_triangle  One number a triangle.
/// @param is_closed         Of every part, not 0: without open edges. Which spaces are walls is told by how often a
///                          ray crosses each.
/// @param points            So many: a triangle has as many as its share of the area, one more or less.
/// Cost: O(n log n), and some microseconds a point; mostly on all threads.
ThinSpaces measure_thin_spaces(const TriangleSoup& soup, std::span<const std::uint32_t> part_of_triangle,
                               std::span<const std::uint8_t> is_closed, std::size_t points, StageWatch& watch);

}  // namespace tetsoup
