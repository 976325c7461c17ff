// A tet mesh whose vertices can only be moved where no tet is harmed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/tet_geometry.h"
#include "smooth/connectivity.h"
#include "smooth/sheets.h"
#include "smooth/sided_points.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr std::size_t kVerticesPerStep =
    256;  ///< Moves between two looks at the progress callback: well under 1 ms.

/// What every tet must keep.
struct ShapeLimits {
  double min_dihedral = 0;    ///< Radians, below pi / 3.
  double max_dihedral = 0;    ///< Radians, pi / 2 or more.
  double max_edge_ratio = 0;  ///< Longest over shortest edge, 1 or more.
};

/// Every tet keeps, in the float positions that are stored, a share of its first volume and the limits, or what it had
/// first where that was worse; the boundary does not come to cross itself; and given points stay on their side of it.
/// Refers to the start and the links: both must outlive it.
class GuardedMesh {
 public:
  GuardedMesh(const TetMesh& start, const Connectivity& links, const ShapeLimits& limits,
              std::span<const Vec3> sided = {});

  /// Goes before a round of moves: a vertex of the boundary goes only so far from where this saw it that it can meet
  /// nothing unseen.
  void look_around(StageWatch& watch) { sheets_.look_around(mesh_, watch); }

  /// Moves a vertex all the way to the target, or a half, a quarter, ... of it, or not at all.
  /// @return  Whether it went all the way.
  bool move(std::uint32_t vertex, const Vec3d& target);

  /// Puts a vertex anywhere; whoever does it asks is_sound() about the tets afterwards. Sides are forgotten.
  void place(std::uint32_t vertex, const Vec3& position) {
    mesh_.vertices[vertex] = position;
    sheets_.forget();
  }
  bool is_sound(std::size_t tet) const;
  const Sheets& sheets() const { return sheets_; }

  Vec3d at(std::uint32_t vertex) const { return to_double(mesh_.vertices[vertex]); }
  Vec3d start_of(std::uint32_t vertex) const { return to_double(start_.vertices[vertex]); }
  bool has_sided_points() const { return !sided_.empty(); }
  double volume(std::size_t tet) const { return signed_volume(corners_of(mesh_, mesh_.tets[tet])); }
  double start_volume(std::size_t tet) const { return signed_volume(corners_of(start_, start_.tets[tet])); }
  double min_dihedral() const;
  const TetMesh& mesh() const { return mesh_; }
  std::size_t shortened_moves() const { return shortened_moves_; }

 private:
  bool surroundings_are_sound(std::uint32_t vertex) const;

  struct Limit {
    double volume;                ///< A tet's must stay above.
    double square_cosine_of_min;  ///< None of its acute angles' may rise above.
    double square_cosine_of_max;  ///< None of its obtuse angles' may rise above.
    double square_edge_ratio;
  };

  const TetMesh& start_;
  const Connectivity& links_;
  TetMesh mesh_;
  std::vector<Limit> limits_;
  double to_unit_ = 1;  ///< A power of two that makes edges about 1 long, so that no product overflows.
  Sheets sheets_;
  SidedPoints sided_;
  std::size_t shortened_moves_ = 0;
};

}  // namespace tetsoup
