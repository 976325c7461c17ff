// The candidate tets around one vertex, and the pieces they fall into.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lattice/tet_complex.h"

namespace tetsoup {

/// Tets of a star that are all kept or all absent, and joined through faces.
struct StarPiece {
  std::vector<std::uint32_t> tets;
  bool kept = false;
  bool is_open = false;  ///< Nothing is listed behind one of those faces.
};

class Star {
 public:
  Star(const TetComplex& complex, std::uint32_t vertex);

  std::size_t size() const { return members_.size(); }
  std::uint32_t tet(std::size_t member) const { return members_[member].tet; }
  bool is_kept(std::size_t member) const { return members_[member].kept; }

  /// Joined through faces at the vertex.
  const std::vector<StarPiece>& pieces() const { return pieces_; }
  std::size_t kept_pieces() const { return kept_pieces_; }

  /// Other ends of the edges at the vertex around which the kept tets form more than one fan, ascending.
  std::vector<std::uint32_t> pinched_edges() const;
  /// Fans and gaps around an edge: joined through faces at it.
  std::vector<StarPiece> pieces_at_edge(std::uint32_t other_end) const;

  /// The cheapest tets that join a piece to another of its kind, through tets of the other kind; empty if there are
  /// none. What is not listed counts as one absent piece.
  /// @param costs  Of the members; infinite: not to be passed.
  std::vector<std::uint32_t> cheapest_path(std::size_t from_piece, std::span<const double> costs) const;

 private:
  static constexpr int kNothing = -1;
  struct Member {
    std::uint32_t tet = 0;
    bool kept = false;
    std::array<int, 3> beside{};              ///< Members behind the three faces at the vertex,
    std::array<std::uint32_t, 3> opposite{};  ///< opposite these corners.
    std::size_t piece = 0;
  };
  int member_of(std::uint32_t tet) const;
  std::vector<StarPiece> collect(std::vector<int> open, std::vector<std::size_t>* piece_of,
                                 std::uint32_t edge_end) const;
  bool touches(const Member& member, std::size_t piece) const;
  bool reaches_another(const Member& member, std::size_t from_piece) const;

  std::vector<Member> members_;
  std::vector<StarPiece> pieces_;
  std::size_t kept_pieces_ = 0;
};

}  // namespace tetsoup
