// All that a simulation remembers.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.h"
#include "kernel/box_tree.h"
#include "kernel/places.h"
#include "kernel/rigid_motion.h"
#include "simulate/contacts.h"
#include "simulate/held_solver.h"
#include "simulate/obstacles.h"
#include "simulate/potentials.h"
#include "simulate/rest.h"
#include "simulate/rest_surface.h"
#include "tetsoup/simulate.h"

namespace tetsoup::simulate {

/// Place of a vertex that no simulated tet has.
inline constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();

/// A piece of a body in the world: vertices [begin, begin + padded count of its rest) of the world's arrays.
struct Part {
  std::size_t rest = 0, surface = 0, body = 0;
  std::uint32_t begin = 0;
  double last_h = 0;  ///< Of the substep before; 0: not moved yet.
  std::size_t clamped = 0;
  std::vector<kernel::TetRotations> rotations;
  kernel::BoxTree boxes;  ///< Around its tets in the surface's order, when contacts were last searched for.
  std::unique_ptr<HeldSystem> system = {};  ///< Where it is solved whole, and
  std::vector<Vec3d> change = {};           ///< what its velocities gain when the stretch ends; none between steps.
};

struct Body {
  std::size_t first_part = 0, part_count = 0;
  std::vector<std::uint32_t> slots;  ///< In the world's arrays, for every vertex of the mesh; or kNoSlot.
  std::vector<Vec3> positions, velocities;
};

struct Spring {
  std::uint32_t slot = 0;
  Vec3d target;
  double stiffness = 0;  ///< N/m; 0 once it is removed.
};

struct Attachment {
  std::uint32_t a = 0, b = 0;
};

struct World {
  SimulationOptions options;
  std::vector<kernel::Place> places;       ///< At the begin of the substep, and
  std::vector<kernel::Offset> remainders;  ///< what these floats lack.
  std::vector<kernel::Offset> moves;       ///< Since then; none between steps.
  std::vector<kernel::Motion> motions;
  std::vector<std::uint32_t> owners;  ///< Part of every slot.
  std::vector<Rest> rests;
  std::vector<RestSurface> surfaces;
  std::vector<SpringNet> nets;  ///< Of the rests, for Solver::Potentials.
  std::vector<Part> parts;
  std::vector<Body> bodies;
  std::vector<Obstacle> obstacles;
  std::vector<Spring> springs;
  std::vector<Attachment> attachments;
  ContactSet contacts;
  SimulationReport report;
  double time = 0;

  /// At the begin of the substep.
  Vec3d place(std::size_t slot) const {
    const kernel::Place& p = places[slot];
    const kernel::Offset& r = remainders[slot];
    return Vec3d{p.x, p.y, p.z} + Vec3d{r.x, r.y, r.z};
  }
  std::vector<Vec3d> places_of(const Part& part) const {
    std::vector<Vec3d> all;
    for (std::size_t v = 0; v < rest_of(part).masses.size(); ++v) all.push_back(place(part.begin + v));
    return all;
  }
  kernel::Movers movers(const Part& part) {
    return {slice(places, part), slice(remainders, part), slice(moves, part), slice(motions, part)};
  }
  const Rest& rest_of(const Part& part) const { return rests[part.rest]; }
  template <class T>
  std::span<T> slice(std::vector<T>& all, const Part& part) const {
    return std::span(all).subspan(part.begin, rest_of(part).padded_count);
  }
  template <class T>
  std::span<const T> slice(const std::vector<T>& all, const Part& part) const {
    return std::span(all).subspan(part.begin, rest_of(part).padded_count);
  }
};

}  // namespace tetsoup::simulate
