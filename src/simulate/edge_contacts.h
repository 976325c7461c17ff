// Edges that get into other bodies between their ends, where no vertex tells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulate/part_pairs.h"
#include "simulate/world.h"

namespace tetsoup::simulate {

/// A point of an edge in a tet of a part.
struct EdgePlace {
  float along = 0;  ///< The edge, 0..1.
  std::uint32_t tet = 0;
  std::array<float, 4> weights{};  ///< Barycentric.
};

/// An edge with both ends outside of a part: where it gets in, where it comes out, and the middle between.
struct EdgeHit {
  std::array<std::uint32_t, 2> ends{};
  std::uint32_t part = 0;
  EdgePlace in, out, middle;
};

/// Sharp edges [begin, end) of another part that are in a part, whose boxes have been fitted; ascending.
std::vector<EdgeHit> find_edge_hits(const World& world, const PartPairs& pairs, std::uint32_t part, std::uint32_t other,
                                    std::size_t begin, std::size_t end);

/// Over a ridge, where the edge gets in and comes out through two sides of it, both push, which adds up to a push
/// across both edges [as Heidelberger04 averages normals]. Where it runs through from side to opposite side, the
/// nearest surface does. The near triangles of the three tets are known.
void add_edge_contacts(World& world, const EdgeHit& hit);

}  // namespace tetsoup::simulate
