// Sheets of the boundary that must not pass through each other while its vertices move.
#pragma once

#include <array>
#include <vector>

#include "base/groups.h"
#include "base/parallel.h"
#include "smooth/connectivity.h"
#include "smooth/facets.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Tets that are all positive can only overlap where the boundary crosses itself. So a move is refused if it makes one
/// of the vertex's boundary triangles cross another one, be it near along the boundary or of another sheet.
///
/// What lies in one place at the start counts as touching, not as crossing: copies of a vertex may part, each towards
/// its own side. Copies of a whole tet overlap by intention; their vertices pass freely through each other.
class Sheets {
 public:
  Sheets(const Connectivity& links, const TetMesh& start);

  /// Notes which triangles each vertex may come to meet as long as no vertex goes farther than its reach from here.
  /// O(triangles), on all threads; nothing is done where hardly a move was refused for that.
  void look_around(const TetMesh& mesh, StageWatch& watch);

  /// What was noted serves no more: vertices went anywhere.
  void forget() { looked_.clear(); }

  /// Whether a boundary vertex, which stands at its new place, may go there from `before`.
  bool allow(std::uint32_t vertex, const Vec3& before, const TetMesh& mesh);

  /// Calls found(vertex, triangle) for vertices with a triangle that crosses another one; look_around() came before.
  template <class Found>
  void visit_crossings(const TetMesh& mesh, const Found& found) const {
    for (const std::uint32_t v : links_->boundary) {
      const std::uint32_t other = crossed_by(v, mesh, nullptr);
      if (other != kNone) found(v, other);
    }
  }

  /// Vertices that stand where another one stands at the start, copies of whole tets aside; ascending.
  const std::vector<std::uint32_t>& doubled() const { return doubled_; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  /// Around a triangle, and how far its corners may go.
  struct Disc {
    Vec3d centre;
    double radius = 0, reach = 0;
    std::uint32_t triangle = 0;
  };

  void link_across_edges(const TetMesh& start);
  double turn_to(std::uint32_t triangle, std::size_t corner, std::uint32_t vertex, const TetMesh& mesh) const;
  void find_doubled(const TetMesh& start);
  void find_copied_tets(const TetMesh& start, const std::vector<std::uint32_t>& place);
  void find_reach(const TetMesh& start);
  Disc disc_around(std::uint32_t triangle, const TetMesh& mesh) const;
  void gather(std::uint32_t vertex, const TetMesh& mesh, const Groups<Disc>& buckets,
              std::vector<std::uint32_t>& beside, std::vector<std::uint32_t>& near) const;
  std::array<int, 3> bucket_of(const Vec3d& p) const;
  std::size_t index_of(const std::array<int, 3>& b) const;
  bool are_copied(std::uint32_t vertex, std::uint32_t triangle) const;
  bool is_separate(std::uint32_t vertex, const Disc& disc, double reach, const TetMesh& mesh) const;
  bool is_open_to_one_side(std::uint32_t vertex, const TetMesh& mesh) const;
  std::uint32_t crossed_by(std::uint32_t vertex, const TetMesh& mesh, const Vec3* before) const;
  bool crossed_before(std::uint32_t vertex, std::uint32_t own, std::uint32_t other, const TetMesh& mesh,
                      const Vec3& before) const;
  bool folds_over(std::uint32_t vertex, const Vec3& before, const TetMesh& mesh) const;
  bool stands_in_copy(std::uint32_t vertex, const TetMesh& mesh) const;

  const Connectivity* links_;
  VertexLists around_;            ///< Triangles that share a vertex with those of a vertex, its own left out.
  std::vector<Triangle> across_;  ///< By triangle, for the edge opposite each corner: the corner beyond it.
  VertexLists copies_;            ///< Other vertices in the same place at the start.
  std::vector<std::uint32_t> doubled_;
  std::vector<std::uint8_t> is_of_copied_tet_;
  std::vector<float> reach_;                      ///< How far a vertex may go from where the last look found it.
  std::vector<Vec3> looked_;                      ///< Where it was then.
  std::size_t refused_ = 0;                       ///< Moves beyond reach since the last look.
  std::vector<std::vector<std::uint32_t>> near_;  ///< By boundary vertex: triangles of `around_` not among them.
  std::vector<std::uint32_t> boundary_index_;
  mutable BoundaryFan fan_;  ///< Memory of crossed_by().
  Vec3d lo_;
  double bucket_ = 1, largest_ = 0;  ///< Edge of a bucket; largest distance of a triangle's corner from its centre.
  std::array<int, 3> count_{1, 1, 1};
};

}  // namespace tetsoup
