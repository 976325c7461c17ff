// Walks from tet to tet through faces, within a few edges of a line.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/tet_geometry.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline bool share_a_vertex(const Tet& a, const Tet& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

class TetWalk {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// The mesh must outlive this. O(tets log tets).
  explicit TetWalk(const TetMesh& mesh);

  /// Whether the tets have a vertex in common, or a walk near the line leads from one to the other.
  bool leads(std::uint32_t from, std::uint32_t to, const Vec3d& begin, const Vec3d& end);

  /// Of the tets that a walk near the line reaches, that in which the end of the line lies deepest, or is least far
  /// beyond.
  std::uint32_t best_at_end(std::uint32_t from, const Vec3d& begin, const Vec3d& end);

 private:
  /// visit(tet) for `from` and all that is reached from there, until it answers true.
  template <class Visit>
  void walk(std::uint32_t from, const Vec3d& begin, const Vec3d& end, const Visit& visit);
  bool is_near(std::uint32_t tet, const Vec3d& begin, const Vec3d& end) const;

  const TetMesh& mesh_;
  double reach_ = 0;                                      ///< From the line to a tet's centre.
  std::vector<std::array<std::uint32_t, 4>> neighbours_;  ///< Through the face opposite each vertex, or kNone.
  std::vector<std::uint32_t> seen_;                       ///< The walk that saw a tet last.
  std::vector<std::uint32_t> queue_;
  std::uint32_t walks_ = 0;
};

}  // namespace tetsoup
