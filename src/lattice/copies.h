// Copies of tets, and which of them are joined through the faces of the lattice.
#pragma once

#include <vector>

#include "base/unions.h"
#include "lattice/piece_graph.h"

namespace tetsoup {

/// Two copies that share a face, by their first pieces.
struct Glue {
  std::uint32_t face, a, b;
};

/// A copy of a kept tet is a set of its pieces.
class Copies {
 public:
  /// All must outlive this. With a `rho_min` of 0 every part keeps its copies, however thin.
  Copies(const Candidates& candidates, const TetPieces& pieces, const PieceGraph& graph, double rho_min);

  /// Joins copies through faces; copies that cannot be told apart at a face become one.
  void glue();
  /// Two copies of the same tet are one from now on.
  void merge(std::uint32_t a, std::uint32_t b) { sets_.join(a, b); }

  const std::vector<Glue>& glued() const { return glued_; }
  /// Whether no way leads from one copy to the other through the tets around. Small ones cannot tell and are not.
  bool are_apart(std::span<const std::uint32_t> around, std::uint32_t a, std::uint32_t b) {
    return !is_small(a) && !is_small(b) && !are_scraps(a, b) && !walk_.leads(graph_.neighbours(), around, a, b);
  }
  /// The tet's copies, each by its first piece.
  std::vector<std::uint32_t> of(std::size_t tet);
  /// Share of the tet that the copy's pieces fill.
  double density(std::uint32_t copy);
  /// Inside voxels of a copy.
  std::uint32_t voxels(std::uint32_t copy);

 private:
  struct Pair {
    std::uint32_t a, b;
    std::uint32_t samples;
  };
  bool is_small(std::uint32_t copy);
  void find_worthy();
  void join_near();
  void drop_thin_of_thick(double rho_min);
  bool has_copy(std::uint32_t piece) { return worthy_[sets_.find(piece)] != 0; }
  std::uint32_t set_of(std::uint32_t piece) { return static_cast<std::uint32_t>(sets_.find(piece)); }
  std::vector<Pair> pairs_of(std::size_t face);
  void add_near(std::size_t face, std::vector<Pair>& pairs);
  bool glue_once();
  bool link_torn();
  bool mark_scraps(Unions& lots);
  bool are_scraps(std::uint32_t a, std::uint32_t b) const;
  bool drop_crumbs();
  bool merge_rivals(const std::vector<Glue>& rejected);

  const Candidates& candidates_;
  const TetPieces& pieces_;
  const PieceGraph& graph_;
  bool keeps_thin_;
  LocalWalk walk_;
  Unions sets_;                         ///< Of pieces.
  std::vector<std::uint8_t> worthy_;    ///< By a set's first piece: it deserves a copy.
  std::vector<std::uint8_t> is_scrap_;  ///< Pieces that their part's other copies take in, though they seem apart.
  std::vector<Glue> glued_;
};

}  // namespace tetsoup
