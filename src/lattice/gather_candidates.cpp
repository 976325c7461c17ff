#include "lattice/gather_candidates.h"

#include "lattice/lattice_vertices.h"

namespace tetsoup {
namespace {

struct CellBox {
  Cell begin{}, end{};
};

/// The cells and those beside them.
CellBox box_around(const std::vector<FilledCell>& cells) {
  CellBox box;
  box.begin = box.end = cells.front().cell;
  for (const FilledCell& c : cells) {
    for (std::size_t i = 0; i < 3; ++i) {
      box.begin[i] = std::min(box.begin[i], c.cell[i]);
      box.end[i] = std::max(box.end[i], c.cell[i]);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    box.begin[i] -= 1;
    box.end[i] += 2;
  }
  return box;
}

struct CandidateTet {
  Cell cell;
  std::uint8_t tet;
  std::uint8_t kept;
  float density;
};

/// Tets of which a corner is marked, in lattice order. Every filled cell has one.
std::vector<CandidateTet> tets_beside(const LatticeVertices& marked, const FilledCells& filled,
                                      const LatticeTable& table) {
  std::vector<CandidateTet> tets;
  tets.reserve(filled.densities.size() * 2);
  std::size_t next = 0;
  marked.for_each_cell_beside([&](const Cell& cell) {
    const bool is_filled = next < filled.cells.size() && filled.cells[next].cell == cell;
    const bool odd = is_odd(cell);
    for (std::size_t t = 0; t < table.tet_count; ++t) {
      const LatticeTet& corners = table.tet(t, odd);
      const bool is_candidate = std::any_of(corners.begin(), corners.end(),
                                            [&](const LatticeCorner& c) { return marked.is_marked(cell, c); });
      if (!is_candidate) continue;
      const float density = is_filled ? filled.densities[next * table.tet_count + t] : 0.0F;
      const unsigned kept = is_filled ? filled.cells[next].kept >> t & 1U : 0;
      tets.push_back({cell, static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(kept), density});
    }
    next += is_filled;
  });
  return tets;
}

}  // namespace

Candidates gather_candidates(const FilledCells& filled, const LatticeFrame& frame, const LatticeTable& table) {
  if (filled.cells.empty()) return {};
  const auto [begin, end] = box_around(filled.cells);
  LatticeVertices core(table, begin, end);
  for (std::size_t c = 0; c < filled.cells.size(); ++c) {
    const auto& [cell, kept] = filled.cells[c];
    for (std::size_t t = 0; t < table.tet_count; ++t)
      if (filled.densities[c * table.tet_count + t] > 0 || (kept >> t & 1U) != 0)
        for (const LatticeCorner& corner : table.tet(t, is_odd(cell))) core.mark(cell, corner);
  }
  const std::vector<CandidateTet> tets = tets_beside(core, filled, table);

  LatticeVertices vertices(table, begin, end);
  for (const CandidateTet& t : tets)
    for (const LatticeCorner& corner : table.tet(t.tet, is_odd(t.cell))) vertices.mark(t.cell, corner);
  vertices.give_numbers();
  Candidates candidates;
  candidates.mesh.vertices.reserve(vertices.count());
  vertices.for_each([&](const Cell& cell, std::size_t point) {
    const Vec3d at{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    const LatticeCorner corner{{}, static_cast<std::uint8_t>(point)};
    candidates.mesh.vertices.push_back(to_float(frame.to_point(at + table.position(corner))));
  });
  candidates.mesh.tets.reserve(tets.size());
  candidates.density.reserve(tets.size());
  candidates.kept.reserve(tets.size());
  for (const CandidateTet& t : tets) {
    const LatticeTet& corners = table.tet(t.tet, is_odd(t.cell));
    candidates.mesh.tets.push_back({vertices.number(t.cell, corners[0]), vertices.number(t.cell, corners[1]),
                                    vertices.number(t.cell, corners[2]), vertices.number(t.cell, corners[3])});
    candidates.density.push_back(t.density);
    candidates.kept.push_back(t.kept);
  }
  return candidates;
}

}  // namespace tetsoup
