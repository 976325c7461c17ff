#include "lattice/boundary_only.h"

#include <algorithm>

#include "base/tet_geometry.h"

namespace tetsoup {
namespace {

std::vector<std::uint8_t> boundary_vertices(const TetComplex& complex) {
  std::vector<std::uint8_t> is_boundary(complex.vertex_count(), 0);
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (!complex.is_kept(t)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      if (complex.is_kept(complex.neighbour(t, i))) continue;
      for (std::size_t j = 0; j < 4; ++j)
        if (j != i) is_boundary[complex.corners(t)[j]] = 1;
    }
  }
  return is_boundary;
}

bool all_on_boundary(const Tet& tet, const std::vector<std::uint8_t>& is_boundary) {
  return std::all_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return is_boundary[v] != 0; });
}

/// Kept tets with four boundary vertices, those with the least inside first.
std::vector<std::uint32_t> boundary_only_tets(const TetComplex& complex, const std::vector<std::uint8_t>& is_boundary) {
  std::vector<std::uint32_t> tets;
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t)
    if (complex.is_kept(t) && all_on_boundary(complex.corners(t), is_boundary)) tets.push_back(t);
  std::stable_sort(tets.begin(), tets.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return complex.density(a) < complex.density(b); });
  return tets;
}

/// Vertices of tets that reach inside: no removal of boundary-only tets takes these from them.
std::vector<std::uint8_t> anchored_vertices(const TetComplex& complex, const std::vector<std::uint8_t>& is_boundary) {
  std::vector<std::uint8_t> is_anchored(complex.vertex_count(), 0);
  for (std::uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (!complex.is_kept(t) || all_on_boundary(complex.corners(t), is_boundary)) continue;
    for (const std::uint32_t v : complex.corners(t)) is_anchored[v] = 1;
  }
  return is_anchored;
}

std::size_t count_kept_around(const TetComplex& complex, std::uint32_t v) {
  const auto tets = complex.around(v);
  return static_cast<std::size_t>(
      std::count_if(tets.begin(), tets.end(), [&](std::uint32_t t) { return complex.is_kept(t); }));
}

/// Whether the tet stands on anchored vertices: all four, or three and a tip that no other tet has.
bool stands_on_thick(const TetComplex& complex, std::uint32_t t, const std::vector<std::uint8_t>& is_anchored) {
  std::size_t loose = 0;
  for (const std::uint32_t v : complex.corners(t)) {
    if (is_anchored[v]) continue;
    ++loose;
    if (count_kept_around(complex, v) > 1) return false;
  }
  return loose < 2;
}

/// Where all vertices stay sound, the tets around each of them stay joined, and with them the neighbours of the tet.
bool drop_if_sound(TetComplex& complex, std::uint32_t t) {
  if (complex.is_held(t) || !complex.is_at_boundary(t)) return false;
  const Tet& corners = complex.corners(t);
  const auto is_sound = [&](std::uint32_t v) { return complex.is_sound(v); };
  if (!std::all_of(corners.begin(), corners.end(), is_sound)) return false;
  const std::uint8_t state = complex.state(t);
  complex.set_state(t, 0);
  if (std::all_of(corners.begin(), corners.end(), is_sound)) return true;
  complex.set_state(t, state);
  return false;
}

}  // namespace

void remove_boundary_only(TetComplex& complex, TopologyReport& report) {
  // What is uncovered has boundary vertices only, so these stay what they are while tets go.
  const std::vector<std::uint8_t> is_boundary = boundary_vertices(complex);
  const std::vector<std::uint8_t> is_anchored = anchored_vertices(complex, is_boundary);
  std::vector<std::uint32_t> tets = boundary_only_tets(complex, is_boundary);
  for (std::size_t before = tets.size() + 1; tets.size() < before;) {
    before = tets.size();
    std::erase_if(
        tets, [&](std::uint32_t t) { return stands_on_thick(complex, t, is_anchored) && drop_if_sound(complex, t); });
    report.boundary_only_tets += before - tets.size();
  }
}

}  // namespace tetsoup
