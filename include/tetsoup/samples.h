// tetsoup: the shapes the paper shows and shapes of thin walls, made by formula; they serve as samples, test inputs and
// bench inputs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// The torus the sample `torus` stands for: axis z, centred at the origin. Its box is 150 x 150 x 37.
inline constexpr double kTorusMajorRadius = 56.5;
inline constexpr double kTorusMinorRadius = 18.5;

struct SampleOptions {
  double damage = 0;       ///< Share of the triangles removed at random, [0, 1).
  std::uint64_t seed = 1;  ///< Of the random removal and of the random parts of a shape.
  /// Thickness of a cup's, pipe's or tray's wall, a comb's tooth, a chain's wire; the shape (of a chain: a link) is 1
  /// long. Absent: the sample's own.
  std::optional<double> wall = {};
};

/// Names that make_sample() knows, in a fixed order.
std::vector<std::string> sample_names();

/// One line on what a sample is, for listings.
std::string sample_summary(std::string_view name);

/// Makes a sample; the same bits for the same name and options on every machine.
/// @throws InvalidInput  for an unknown name (the text lists the known ones) a damage or wall out of range, or a wall
/// where there is none.
TriangleSoup make_sample(std::string_view name, const SampleOptions& options = {});

/// Removes a share of the triangles, chosen at random by seed; the vertices stay.
TriangleSoup remove_triangles(const TriangleSoup& soup, double share, std::uint64_t seed);

}  // namespace tetsoup
