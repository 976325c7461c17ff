#include "lattice/star.h"

#include <algorithm>

namespace tetsoup {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Star::Star(const TetComplex& complex, std::uint32_t vertex) {
  const auto tets = complex.around(vertex);
  members_.resize(tets.size());
  for (std::size_t m = 0; m < tets.size(); ++m) {
    members_[m].tet = tets[m];
    members_[m].kept = complex.is_kept(tets[m]);
  }
  for (Member& member : members_) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t corner = complex.corners(member.tet)[i];
      if (corner == vertex) continue;
      member.opposite[k] = corner;
      member.beside[k++] = member_of(complex.neighbour(member.tet, i));
    }
  }
  std::vector<int> all(members_.size());
  for (std::size_t m = 0; m < all.size(); ++m) all[m] = static_cast<int>(m);
  std::vector<std::size_t> piece_of(members_.size());
  pieces_ = collect(std::move(all), &piece_of, kNoVertex);
  for (std::size_t m = 0; m < members_.size(); ++m) members_[m].piece = piece_of[m];
  for (const StarPiece& piece : pieces_) kept_pieces_ += piece.kept;
}

int Star::member_of(std::uint32_t tet) const {
  if (tet == kNoTet) return kNothing;
  for (std::size_t m = 0; m < members_.size(); ++m)
    if (members_[m].tet == tet) return static_cast<int>(m);
  return kNothing;
}

/// Pieces of some members, joined through faces at the vertex that hold `edge_end` too, if it is one.
std::vector<StarPiece> Star::collect(std::vector<int> some, std::vector<std::size_t>* piece_of,
                                     std::uint32_t edge_end) const {
  std::vector<StarPiece> pieces;
  std::vector<char> is_open(members_.size(), 0);  // still to be put into a piece
  for (const int m : some) is_open[static_cast<std::size_t>(m)] = 1;
  std::vector<int> stack;
  for (const int start : some) {
    if (!is_open[static_cast<std::size_t>(start)]) continue;
    is_open[static_cast<std::size_t>(start)] = 0;
    stack.assign(1, start);
    StarPiece piece;
    piece.kept = members_[static_cast<std::size_t>(start)].kept;
    while (!stack.empty()) {
      const auto at = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      piece.tets.push_back(members_[at].tet);
      if (piece_of != nullptr) (*piece_of)[at] = pieces.size();
      for (std::size_t k = 0; k < 3; ++k) {
        if (members_[at].opposite[k] == edge_end) continue;
        const int n = members_[at].beside[k];
        if (n == kNothing) {
          piece.is_open = true;
        } else if (is_open[static_cast<std::size_t>(n)] && members_[static_cast<std::size_t>(n)].kept == piece.kept) {
          is_open[static_cast<std::size_t>(n)] = 0;
          stack.push_back(n);
        }
      }
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::vector<std::uint32_t> Star::pinched_edges() const {
  std::vector<std::uint32_t> ends;  // of boundary faces at the vertex
  for (const Member& member : members_) {
    for (std::size_t k = 0; k < 3 && member.kept; ++k) {
      const int n = member.beside[k];
      if (n != kNothing && members_[static_cast<std::size_t>(n)].kept) continue;
      ends.push_back(member.opposite[(k + 1) % 3]);
      ends.push_back(member.opposite[(k + 2) % 3]);
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<std::uint32_t> pinched;
  for (std::size_t i = 2; i < ends.size(); ++i)
    if (ends[i] == ends[i - 2] && (pinched.empty() || pinched.back() != ends[i])) pinched.push_back(ends[i]);
  return pinched;
}

std::vector<StarPiece> Star::pieces_at_edge(std::uint32_t other_end) const {
  std::vector<int> around;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const auto& corners = members_[m].opposite;
    if (std::find(corners.begin(), corners.end(), other_end) != corners.end()) around.push_back(static_cast<int>(m));
  }
  return collect(std::move(around), nullptr, other_end);
}

bool Star::touches(const Member& member, std::size_t piece) const {
  return std::any_of(member.beside.begin(), member.beside.end(),
                     [&](int n) { return n != kNothing && members_[static_cast<std::size_t>(n)].piece == piece; });
}

/// Whether the member lies beside another piece of the kind of `from_piece`.
bool Star::reaches_another(const Member& member, std::size_t from_piece) const {
  const StarPiece& from = pieces_[from_piece];
  return std::any_of(member.beside.begin(), member.beside.end(), [&](int n) {
    if (n == kNothing) return !from.kept && !from.is_open;
    const Member& other = members_[static_cast<std::size_t>(n)];
    return other.kept == from.kept && other.piece != from_piece;
  });
}

std::vector<std::uint32_t> Star::cheapest_path(std::size_t from_piece, std::span<const double> costs) const {
  const std::size_t count = members_.size();
  std::vector<double> cost_to(count, kInfinity);
  std::vector<int> before(count, kNothing);
  std::vector<char> is_done(count, 0);
  for (std::size_t m = 0; m < count; ++m)
    if (members_[m].kept != pieces_[from_piece].kept && touches(members_[m], from_piece)) cost_to[m] = costs[m];
  for (;;) {
    std::size_t nearest = count;
    for (std::size_t m = 0; m < count; ++m)
      if (!is_done[m] && cost_to[m] < (nearest == count ? kInfinity : cost_to[nearest])) nearest = m;
    if (nearest == count) return {};
    is_done[nearest] = 1;
    const Member& member = members_[nearest];
    if (reaches_another(member, from_piece)) {
      std::vector<std::uint32_t> path;
      for (int m = static_cast<int>(nearest); m != kNothing; m = before[static_cast<std::size_t>(m)])
        path.push_back(members_[static_cast<std::size_t>(m)].tet);
      return path;
    }
    for (const int n : member.beside) {
      if (n == kNothing) continue;
      const auto next = static_cast<std::size_t>(n);
      if (members_[next].kept != member.kept || cost_to[nearest] + costs[next] >= cost_to[next]) continue;
      cost_to[next] = cost_to[nearest] + costs[next];
      before[next] = static_cast<int>(nearest);
    }
  }
}

}  // namespace tetsoup
