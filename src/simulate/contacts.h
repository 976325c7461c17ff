// Which vertices touch what, found every few substeps, and how they are pushed back and rubbed in each.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {
class StageWatch;
}

namespace tetsoup::simulate {

struct World;

/// A vertex at the surface of a part: it stays on the outer side of the triangle, at the point that is nearest to it
/// where the part is at rest.
struct Contact {
  std::uint32_t vertex = 0;
  std::array<std::uint32_t, 3> corners{};
  std::array<float, 3> weights{};
  float friction = 0;
  float reach = 0;             ///< How far along the triangle's plane the vertex may leave the point.
  std::uint32_t part = 0;      ///< The triangle's,
  std::uint32_t triangle = 0;  ///< and its number there.
};

/// A point of a sharp edge that has got into a part between its ends: as the vertex of a contact, which is the first
/// end.
struct EdgeContact {
  Contact contact;
  std::uint32_t other_end = 0;
  float along = 0;  ///< From the first end to the other, 0..1.
  float slack = 0;  ///< Depth that is left alone.
};

/// A vertex at an obstacle, which is `gap` away where the vertex is at `from`: gap + dot(normal, p - from) stays above
/// 0.
struct ObstacleContact {
  std::uint32_t vertex = 0;
  Vec3 normal, from;
  float gap = 0;
  float friction = 0;
};

struct ContactSet {
  std::vector<Contact> between;     ///< Ascending by part, then vertex; one for each two.
  std::vector<EdgeContact> across;  ///< Edges and other bodies.
  std::vector<ObstacleContact> with_obstacles;
};

enum class Edges { Find, Keep };

/// Finds what touches, or may touch within `horizon` seconds. Edges are found once a step and then kept: they are slow
/// to find, and vertices tell of most.
/// @throws Cancelled  as the watch says; the contacts of before are kept for the next search then.
void find_contacts(World& world, double horizon, Edges edges, StageWatch& watch);

/// Pushes and rubs, after all parts have moved freely for h.
void solve_contacts(World& world, double h);

/// Before contacts, so that no spring pulls through an obstacle,
void solve_springs(World& world, double h);
/// and after them, so that what is attached stays together.
void solve_attachments(World& world, double h);

}  // namespace tetsoup::simulate
