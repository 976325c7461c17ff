// Which parts may touch which before contacts are searched for again.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "base/vec.h"
#include "simulate/world.h"

namespace tetsoup::simulate {

inline Vec3 to_vec(const kernel::Place& p) {
  return {p.x, p.y, p.z};
}

struct Bounds {
  Vec3 lo{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
          std::numeric_limits<float>::infinity()};
  Vec3 hi{-lo.x, -lo.y, -lo.z};

  void add(const Vec3& p) {
    lo = min(lo, p);
    hi = max(hi, p);
  }
  bool holds(const Vec3& p, float margin) const {
    return p.x >= lo.x - margin && p.x <= hi.x + margin && p.y >= lo.y - margin && p.y <= hi.y + margin &&
           p.z >= lo.z - margin && p.z <= hi.z + margin;
  }
  bool meets(const Bounds& other, float margin) const {
    return lo.x - margin <= other.hi.x && hi.x + margin >= other.lo.x && lo.y - margin <= other.hi.y &&
           hi.y + margin >= other.lo.y && lo.z - margin <= other.hi.z && hi.z + margin >= other.lo.z;
  }
};

struct Partner {
  std::uint32_t part = 0;
  float ahead = 0;  ///< By how much a vertex of one and a tet of the other may come closer.
};

struct PartPairs {
  std::vector<Bounds> bounds;                  ///< Of the parts' surfaces.
  std::vector<float> ahead;                    ///< How far a vertex of a part may get.
  std::vector<std::vector<Partner>> partners;  ///< Of each part, ascending; itself where it may touch itself.
};

PartPairs find_part_pairs(const World& world, double horizon, StageWatch& watch);

}  // namespace tetsoup::simulate
