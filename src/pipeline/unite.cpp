#include "pipeline/unite.h"

#include <algorithm>
#include <cmath>

#include "base/bits.h"
#include "base/elementary.h"
#include "base/vec.h"

namespace tetsoup {
namespace {

void append(TetMesh& all, const TetMesh& mesh) {
  const auto base = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const auto& [a, b, c, d] : mesh.tets) all.tets.push_back({a + base, b + base, c + base, d + base});
  all.origin = mesh.origin;
}

/// Marks the voxels of `grid` whose centres lie in inside voxels of a body.
void mark(const BitGrid& body, BitGrid& all) {
  const GridFrame &from = body.frame, &to = all.frame;
  const double scale = to.voxel_size / from.voxel_size;
  const Vec3d shift = (to.origin - from.origin) * (1 / from.voxel_size);
  const auto range = [&](std::size_t axis, double offset, int& begin, int& end) {
    begin = std::max(0, static_cast<int>(std::ceil((-0.5 - offset) / scale)));
    end = std::min(to.size[axis], static_cast<int>(std::floor((from.size[axis] - 0.5 - offset) / scale)) + 1);
  };
  int x0, x1, y0, y1, z0, z1;
  range(0, shift.x, x0, x1);
  range(1, shift.y, y0, y1);
  range(2, shift.z, z0, z1);
  const auto place = [&](int i, double offset) { return static_cast<int>(std::floor(i * scale + offset + 0.5)); };
  for (int z = z0; z < z1; ++z) {
    for (int y = y0; y < y1; ++y) {
      std::uint64_t* words = all.words.data() + all.row(y, z);
      for (int x = x0; x < x1; ++x) {
        const int bx = place(x, shift.x), by = place(y, shift.y), bz = place(z, shift.z);
        if (from.contains(bx, by, bz) && body.test(bx, by, bz))
          words[static_cast<std::size_t>(x / 64)] |= std::uint64_t{1} << (x % 64);
      }
    }
  }
}

}  // namespace

PseudoVolume united_volume(const std::vector<const PseudoVolume*>& bodies, const GridFrame& grid) {
  PseudoVolume all;
  all.inside = make_bit_grid(grid);
  PseudoVolumeReport& report = all.report;
  double weight = 0;
  std::optional<double> bounded = 0;
  for (const PseudoVolume* body : bodies) {
    const PseudoVolumeReport& own = body->report;
    if (!own.bounded_volume) bounded.reset();
    if (bounded) *bounded += *own.bounded_volume;
    mark(body->inside, all.inside);
    if (own.volume > weight || body == bodies.front()) {  // what cannot be added up is the largest body's
      weight = own.volume;
      const double volume = report.volume;
      const std::size_t voxels = report.inside_voxels, cavity_voxels = report.cavity_voxels;
      std::vector<SoupCavity> cavities = std::move(report.cavities);
      std::vector<std::string> notes = std::move(report.notes);
      const double closure = report.largest_closure;
      report = own;
      report.volume = volume, report.inside_voxels = voxels, report.cavity_voxels = cavity_voxels;
      report.cavities = std::move(cavities), report.notes = std::move(notes);
      report.largest_closure = closure;
    }
    report.volume += own.volume;
    report.inside_voxels += own.inside_voxels;
    report.cavity_voxels += own.cavity_voxels;
    report.largest_closure = std::max(report.largest_closure, own.largest_closure);
    report.cavities.insert(report.cavities.end(), own.cavities.begin(), own.cavities.end());
    report.notes.insert(report.notes.end(), own.notes.begin(), own.notes.end());
    all.rays = body->rays;
  }
  report.bounded_volume = bounded;
  all.votes.frame = grid;
  all.votes.words_per_row = all.inside.words_per_row;
  all.votes.words.resize(all.inside.words.size());
  for (std::size_t i = 0; i < all.inside.words.size(); ++i)
    for (std::size_t slice = 0; slice < all.votes.words[i].slices.size(); ++slice)
      all.votes.words[i].slices[slice] |= (all.rays >> slice & 1) != 0 ? all.inside.words[i] : 0;
  return all;
}

LatticeMesh united_lattice(const std::vector<const LatticeMesh*>& bodies) {
  LatticeMesh all;
  LatticeReport& sum = all.report;
  std::size_t most = 0;
  double shared = 0, either = 0;
  for (const LatticeMesh* body : bodies) {
    append(all.mesh, body->mesh);
    const LatticeReport& own = body->report;
    if (own.tet_count > most) {
      most = own.tet_count;
      sum.cells = own.cells;
      sum.cell_size = own.cell_size;
      sum.mean_edge = own.mean_edge;
      sum.translate_cells = own.translate_cells;
      sum.rotate = own.rotate;
    }
    sum.used_cells += own.used_cells;
    sum.tet_count += own.tet_count;
    sum.sampled_tets += own.sampled_tets;
    sum.kept_volume += own.kept_volume;
    sum.pseudo_volume += own.pseudo_volume;
    sum.kept_by_soup = sum.kept_by_soup || own.kept_by_soup;
    sum.fills += own.fills;
    sum.evened_tets += own.evened_tets;
    sum.thin_tets += own.thin_tets;
    sum.enclosing_tets += own.enclosing_tets;
    sum.doubled_tets += own.doubled_tets;
    sum.parted_vertices += own.parted_vertices;
    sum.excess_volume += own.excess_volume;
    sum.lacking_volume += own.lacking_volume;
    sum.topology.touching_mended += own.topology.touching_mended;
    sum.topology.tets_added += own.topology.tets_added;
    sum.topology.tets_dropped += own.topology.tets_dropped;
    sum.topology.vertices_doubled += own.topology.vertices_doubled;
    sum.topology.parts_dropped += own.topology.parts_dropped;
    sum.topology.dropped_volume += own.topology.dropped_volume;
    sum.topology.bubbles_filled += own.topology.bubbles_filled;
    sum.topology.bubble_tets += own.topology.bubble_tets;
    sum.topology.boundary_only_tets += own.topology.boundary_only_tets;
    sum.topology.boundary_only_edges += own.topology.boundary_only_edges;
    sum.notes.insert(sum.notes.end(), own.notes.begin(), own.notes.end());
    shared += own.pseudo_volume - own.lacking_volume;
    either += own.pseudo_volume + own.excess_volume;
  }
  sum.overlap = either > 0 ? shared / either : 0;
  return all;
}

SmoothResult united_smooth(const std::vector<const SmoothResult*>& bodies) {
  SmoothResult all;
  SmoothReport& sum = all.report;
  sum.min_dihedral = 4;
  bool any_wanted = false;
  for (const SmoothResult* body : bodies) {
    append(all.mesh, body->mesh);
    const SmoothReport& own = body->report;
    sum.passes = std::max(sum.passes, own.passes);
    sum.snapped = sum.snapped || own.snapped;
    sum.boundary_vertices += own.boundary_vertices;
    sum.shortened_moves += own.shortened_moves;
    sum.volume_before += own.volume_before;
    sum.volume_after += own.volume_after;
    sum.volume_wanted += own.volume_wanted > 0 ? own.volume_wanted : own.volume_after;
    any_wanted = any_wanted || own.volume_wanted > 0;
    sum.min_dihedral = std::min(sum.min_dihedral, own.min_dihedral);
    sum.boundary_volume_ratio.insert(sum.boundary_volume_ratio.end(), own.boundary_volume_ratio.begin(),
                                     own.boundary_volume_ratio.end());
    sum.notes.insert(sum.notes.end(), own.notes.begin(), own.notes.end());
  }
  if (!any_wanted) sum.volume_wanted = 0;
  return all;
}

TetMesh take_mesh(const TetMesh& all, const TetMesh& like, MeshPlace& place) {
  TetMesh mesh;
  mesh.origin = all.origin;
  const auto base = static_cast<std::uint32_t>(place.vertex);
  const auto from = all.vertices.begin() + static_cast<std::ptrdiff_t>(place.vertex);
  mesh.vertices.assign(from, from + static_cast<std::ptrdiff_t>(like.vertices.size()));
  for (std::size_t i = 0; i < like.tets.size(); ++i) {
    const auto [a, b, c, d] = all.tets[place.tet + i];
    mesh.tets.push_back({a - base, b - base, c - base, d - base});
  }
  place.vertex += like.vertices.size();
  place.tet += like.tets.size();
  return mesh;
}

LatticeMesh single_tet(const Box3& box, double volume) {
  const Vec3d middle = (box.lo + box.hi) * 0.5, sides = box.hi - box.lo;
  // Every other corner of a cube of three times the volume. A sheet has none: then one as large as its box.
  double side = elementary::cbrt(3 * volume);
  if (!(side > 0)) side = std::max({sides.x, sides.y, sides.z, 1e-30}) / 2;
  const double h = side / 2;
  LatticeMesh result;
  for (const Vec3d& corner : {Vec3d{h, h, h}, Vec3d{-h, h, -h}, Vec3d{h, -h, -h}, Vec3d{-h, -h, h}})
    result.mesh.vertices.push_back(to_float(middle + corner));
  result.mesh.tets.push_back({0, 1, 2, 3});
  result.report.tet_count = 1;
  result.report.mean_edge = side * std::sqrt(2.0);
  result.report.cell_size = side;
  result.report.kept_volume = result.report.pseudo_volume = side * side * side / 3;
  return result;
}

}  // namespace tetsoup
