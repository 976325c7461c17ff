#include "lattice/even_out.h"

#include <array>
#include <vector>

#include "base/elementary.h"
#include "base/tet_geometry.h"
#include "lattice/tet_complex.h"

namespace tetsoup {
namespace {

constexpr int kRounds = 2;  // A third changes little, and more would eat plates from their rims.
// What a unit of boundary weighs against a unit of volume, in edges of a regular tet of the mean size. Twice as much
// gains 2 % of smoothness and shrinks limbs.
constexpr double kArea = 0.125;
constexpr double kUnclear = 0.5;  // Of the way from rho_min to none and to all: densities beyond stand.

class Evening {
 public:
  Evening(Candidates& candidates, double rho_min)
      : mesh_(candidates.mesh), complex_(candidates), rho_min_(rho_min), edge_(lattice_edge(mesh_)) {}

  std::size_t round() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t t = 0; t < complex_.tet_count(); ++t) {
      if (is_unclear(t) && other_sides(t) >= 2 && other_sides(t) <= 3) open.push_back(t);
    }
    std::size_t flipped = 0;
    for (const std::uint32_t t : open) flipped += flip_if_better(t) ? 1 : 0;
    return flipped;
  }

 private:
  bool is_unclear(std::uint32_t t) const {
    const double density = complex_.density(t);
    return density >= rho_min_ * (1 - kUnclear) && density <= rho_min_ + (1 - rho_min_) * kUnclear &&
           (complex_.is_kept(t) ? !complex_.is_held(t) : complex_.is_addable(t));
  }

  /// Faces with a tet of the other kind behind them.
  int other_sides(std::uint32_t t) const {
    int count = 0;
    for (std::size_t i = 0; i < 4; ++i) count += complex_.is_kept(complex_.neighbour(t, i)) != complex_.is_kept(t);
    return count;
  }

  double face_area(std::uint32_t t, std::size_t i) const {
    const auto corner = [&](std::size_t k) {
      return to_double(mesh_.vertices[complex_.corners(t)[static_cast<std::size_t>(kTetFaces[i][k])]]);
    };
    return length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
  }

  bool flip_if_better(std::uint32_t t) {
    const bool kept = complex_.is_kept(t);
    double boundary = 0;  // how much more there would be
    for (std::size_t i = 0; i < 4; ++i) {
      const bool is_boundary = complex_.is_kept(complex_.neighbour(t, i)) != kept;
      boundary += is_boundary ? -face_area(t, i) : face_area(t, i);
    }
    const double volume = (kept ? 1 : -1) * (complex_.density(t) - rho_min_) * complex_.volume(t);
    if (volume + kArea * edge_ * boundary >= 0) return false;
    std::array<bool, 4> was_sound{};
    const Tet& corners = complex_.corners(t);
    for (std::size_t i = 0; i < 4; ++i) was_sound[i] = complex_.is_sound(corners[i]);
    const std::uint8_t before = complex_.state(t);
    complex_.set_state(t, kept ? 0 : 1);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!was_sound[i] || complex_.is_sound(corners[i])) continue;
      complex_.set_state(t, before);
      return false;
    }
    return true;
  }

  const TetMesh& mesh_;
  TetComplex complex_;
  double rho_min_, edge_;
};

}  // namespace

std::size_t even_out(Candidates& candidates, double rho_min) {
  Evening evening(candidates, rho_min);
  std::size_t flipped = 0;
  for (int round = 0; round < kRounds; ++round) flipped += evening.round();
  return flipped;
}

}  // namespace tetsoup
