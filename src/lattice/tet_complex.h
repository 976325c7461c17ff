// Candidates with what lies beside what: the tet behind a face, the tets around a vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/groups.h"
#include "lattice/candidates.h"

namespace tetsoup {

inline constexpr std::uint32_t kNoTet = std::numeric_limits<std::uint32_t>::max();

/// Adjacency is by vertex indices, never by position: copies of a tet in one place have vertices of their own. A face
/// has two tets at most; where more share it, the first two in the mesh are partners, and the others are left over.
class TetComplex {
 public:
  explicit TetComplex(Candidates& candidates);
  TetComplex(const TetComplex&) = delete;
  TetComplex& operator=(const TetComplex&) = delete;

  std::uint32_t tet_count() const { return static_cast<std::uint32_t>(neighbours_.size()); }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(around_.size()); }
  const TetMesh& mesh() const { return candidates_.mesh; }
  const Tet& corners(std::uint32_t t) const { return candidates_.mesh.tets[t]; }
  float density(std::uint32_t t) const { return candidates_.density[t]; }
  double volume(std::uint32_t t) const;

  /// The tet behind the face opposite a corner, or kNoTet.
  std::uint32_t neighbour(std::uint32_t t, std::size_t face) const { return neighbours_[t][face]; }
  std::span<const std::uint32_t> around(std::uint32_t v) const { return around_[v]; }

  bool is_kept(std::uint32_t t) const { return t != kNoTet && candidates_.kept[t] != 0; }
  bool is_held(std::uint32_t t) const { return candidates_.kept[t] == kHeld; }
  /// Whether the tet may be added: not where a vertex of it was doubled, since it would fit one side only.
  bool is_addable(std::uint32_t t) const { return candidates_.kept[t] == 0 && !is_left_over_[t]; }
  /// Whether two other tets share a face of this one.
  bool is_left_over(std::uint32_t t) const { return is_left_over_[t] != 0; }
  std::uint8_t state(std::uint32_t t) const { return candidates_.kept[t]; }
  void set_state(std::uint32_t t, std::uint8_t state) { candidates_.kept[t] = state; }

  /// Whether a face of the tet is on the boundary of the mesh.
  bool is_at_boundary(std::uint32_t t) const;
  /// Whether the kept tets around a vertex form a ball with the vertex in it or on its skin, or there are none.
  bool is_sound(std::uint32_t v) const;
  /// The same of only those that faces at the vertex join to `start`.
  bool is_sound_part(std::uint32_t v, std::uint32_t start) const { return reached_if_ball(v, start) != 0; }

  /// Gives every group of kept tets that faces at `v` join a vertex of its own; the first keeps `v`. Returns how many
  /// vertices that took.
  std::size_t double_vertex(std::uint32_t v);

 private:
  struct FaceSide {
    std::uint64_t others;  ///< The upper two corners, packed.
    std::uint64_t slot;    ///< 4 * tet + face.
  };
  void join_faces();
  void pair_faces(std::span<FaceSide> run);
  std::size_t reached_if_ball(std::uint32_t v, std::uint32_t start) const;
  void move_to_vertex(std::uint32_t t, std::uint32_t from, std::uint32_t to);
  void mark_part(std::uint32_t v, std::uint32_t start) const;

  Candidates& candidates_;
  std::vector<std::array<std::uint32_t, 4>> neighbours_;
  Groups<std::uint32_t> storage_;
  std::vector<std::span<std::uint32_t>> around_;  ///< Into `storage_`, so that a group can be split where it lies.
  std::vector<std::uint8_t> is_left_over_;
  // Marks of the last walk around a vertex.
  mutable std::vector<std::uint32_t> tet_mark_, vertex_mark_, stack_;
  mutable std::uint32_t walk_ = 0;
};

/// Which corner of the tet is `v`.
inline std::size_t corner_of(const Tet& tet, std::uint32_t v) {
  std::size_t i = 0;
  while (tet[i] != v) ++i;
  return i;
}

}  // namespace tetsoup
