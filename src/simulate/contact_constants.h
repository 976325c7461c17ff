// Lengths that the search for contacts goes by, in mean edges of the tets.
#pragma once

namespace tetsoup::simulate {

/// Vertices beyond a surface are looked for at most so far away: faster ones are found when they are in.
inline constexpr double kMostAhead = 0.1;
/// How far along a triangle's plane a contact holds.
inline constexpr double kReach = 1;
/// How deep an edge may lie in another body without being pushed: what rests on its vertices is not disturbed.
inline constexpr double kEdgeSlack = 0.05;
/// What lay so near at rest is not kept apart: neighbours, and copies of tets in one place.
inline constexpr double kNeighbours = 1;

}  // namespace tetsoup::simulate
