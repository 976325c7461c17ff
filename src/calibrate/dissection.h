// An order in which a mesh's vertices are eliminated: halves first, what parts them last [George73].
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "calibrate/elastic_body.h"

namespace tetsoup {

/// Vertices that are eliminated together, between halves that know of each other only through these.
struct Front {
  std::size_t first = 0;  ///< In the order of elimination: own vertices are first .. first + count.
  std::size_t count = 0;
  std::vector<std::uint32_t> boundary;  ///< Later vertices that elimination ties to them, by their places, ascending.
  std::vector<std::size_t> children;    ///< Fronts that come before.
  std::size_t depth = 0;                ///< Fronts above.
};

struct Dissection {
  std::vector<std::uint32_t> order;   ///< Vertices by their places in the elimination.
  std::vector<std::uint32_t> places;  ///< And back.
  std::vector<Front> fronts;          ///< Children before parents.
};

/// Halves the vertices across the axis that cuts fewest ties, again and again. O(n log^2 n).
Dissection dissect(const ElasticBody& body);

}  // namespace tetsoup
