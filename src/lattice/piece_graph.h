// Which pieces of neighbouring tets touch through the face between them.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/groups.h"
#include "lattice/tet_pieces.h"

namespace tetsoup {

/// A face of two tets.
struct SharedFace {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t a, b;
};

/// All faces that two tets of the mesh share. O(tets).
std::vector<SharedFace> shared_faces(const TetMesh& mesh);

/// Piece `a` of the face's tet a and piece `b` of its tet b have voxels of the face in common.
struct Contact {
  std::uint32_t a, b;
  std::uint32_t samples;  ///< Points of the face in them; where there is but one piece each, those found so far.
};

/// Walks from piece to piece, in a few tets only.
class LocalWalk {
 public:
  /// Both must outlive this.
  LocalWalk(const TetMesh& mesh, const TetPieces& pieces) : mesh_(mesh), pieces_(pieces), seen_(pieces.size(), 0) {}

  /// Whether a way leads from a piece to one for which `is_end` holds, through tets that have one of these vertices.
  template <class IsEnd>
  bool leads(const Groups<std::uint32_t>& neighbours, std::span<const std::uint32_t> around, std::uint32_t from,
             const IsEnd& is_end) {
    seen_[from] = ++walks_;
    queue_.assign(1, from);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      if (is_end(queue_[next])) return true;
      for (const std::uint32_t piece : neighbours[queue_[next]]) {
        if (seen_[piece] == walks_ || !is_near(piece, around)) continue;
        seen_[piece] = walks_;
        queue_.push_back(piece);
      }
    }
    return false;
  }
  bool leads(const Groups<std::uint32_t>& neighbours, std::span<const std::uint32_t> around, std::uint32_t from,
             std::uint32_t to) {
    return leads(neighbours, around, from, [&](std::uint32_t piece) { return piece == to; });
  }

 private:
  bool is_near(std::uint32_t piece, std::span<const std::uint32_t> around) const {
    const Tet& tet = mesh_.tets[pieces_.tet_of(piece)];
    return std::find_first_of(tet.begin(), tet.end(), around.begin(), around.end()) != tet.end();
  }

  const TetMesh& mesh_;
  const TetPieces& pieces_;
  std::vector<std::uint32_t> seen_;  ///< The walk that saw a piece last.
  std::vector<std::uint32_t> queue_;
  std::uint32_t walks_ = 0;
};

class PieceGraph {
 public:
  /// `faces` are the mesh's and must outlive this. O(tets + voxels on faces between pieces), all threads.
  PieceGraph(const TetMesh& mesh, const std::vector<SharedFace>& faces, const TetPieces& pieces, const BitGrid& inside,
             StageWatch& watch);

  const std::vector<SharedFace>& faces() const { return faces_; }
  std::span<const Contact> contacts(std::size_t face) const {
    return std::span(contacts_).subspan(contacts_begin_[face], contacts_begin_[face + 1] - contacts_begin_[face]);
  }
  /// Of all faces.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Of every piece, those it touches.
  const Groups<std::uint32_t>& neighbours() const { return neighbours_; }

 private:
  const std::vector<SharedFace>& faces_;
  std::vector<std::size_t> contacts_begin_;
  std::vector<Contact> contacts_;
  Groups<std::uint32_t> neighbours_;
};

}  // namespace tetsoup
