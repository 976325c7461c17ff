// The library's reports, one line a number.
#include "records.h"
#include "tetsoup/embed.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"

namespace tetsoup::python {

namespace {

void bind_soup_report(nb::module_& m) {
  using R = SoupReport;
  Record<R>(m, "SoupReport",
            "What a soup is, and what of it could not be used. Vertices are one where positions are equal.")
      .field("vertex_count", &R::vertex_count, "As given.")
      .field("triangle_count", &R::triangle_count, "As given.")
      .field("index_out_of_range", &R::index_out_of_range, "Triangles dropped: an index beyond the vertices.")
      .field("non_finite", &R::non_finite, "Triangles dropped: a coordinate is NaN, infinite or beyond 1e30.")
      .field("duplicates", &R::duplicates, "Triangles dropped: the same three positions stand before.")
      .field("zero_area", &R::zero_area, "Triangles kept as the segment or the point they are.")
      .field("used_triangles", &R::used_triangles, "triangle_count less all that was dropped.")
      .field("merged_vertices", &R::merged_vertices, "Distinct positions of the used triangles.")
      .field("components", &R::components, "Parts, joined through shared vertices.")
      .field("boundary_edges", &R::boundary_edges, "Edges of one triangle.")
      .field("non_manifold_edges", &R::non_manifold_edges, "Edges of three or more triangles.")
      .field("inconsistent_edges", &R::inconsistent_edges, "Edges whose two triangles run along them the same way.")
      .field("kind", &R::kind, "'closed', 'open', 'soup' (mostly unconnected) or 'empty'.")
      .field("box", &R::box, "Lower and upper corner of the used triangles.")
      .field("notes", &R::notes, "What you should know, and the option that changes it.");
}

void bind_volume_report(nb::module_& m) {
  Record<BandScore>(m, "BandScore", "One candidate of the automatic choice of k.")
      .field("band_voxels", &BandScore::band_voxels, "Half width of the event band, voxels.")
      .field("score", &BandScore::score, "What the choice maximises, 0..1.")
      .field("consensus", &BandScore::consensus, "Mean of |2 votes / rays - 1| over all voxels.");
  using R = PseudoVolumeReport;
  Record<R>(m, "PseudoVolumeReport", "How inside and outside were told apart.")
      .field("k", &R::k, "Event threshold used, after the floor.")
      .field("band", &R::band, "(1 - k) d_max, in the soup's unit; at least 0.9 voxels.")
      .field("band_voxels", &R::band_voxels, "The same in voxels.")
      .field("automatic", &R::automatic, "The band was chosen here.")
      .field("floored", &R::floored, "The band asked for was below the floor.")
      .field("candidates", &R::candidates, "What the automatic choice tried.")
      .field("wants_band_voxels", &R::wants_band_voxels,
             "Wider candidates need the distance known this far; None: chosen.")
      .field("largest_closure", &R::largest_closure, "Diameter of the largest hole that was closed; 0: hardly any.")
      .field("cavity_voxels", &R::cavity_voxels, "Voxels added because the soup encloses them.")
      .field("soup_covered", &R::soup_covered, "Share of the soup's voxels with an inside voxel beside them.")
      .field("inside_voxels", &R::inside_voxels, "Their number.")
      .field("volume", &R::volume, "Of the inside voxels.")
      .field("bounded_volume", &R::bounded_volume, "What a closed surface bounds exactly; None: not known.")
      .field("consensus", &R::consensus, "Mean of |2 votes / rays - 1|; 1 = all rays agree everywhere.")
      .field("notes", &R::notes, "What you should know, and the option that changes it.");
}

void bind_lattice_report(nb::module_& m) {
  using T = TopologyReport;
  Record<T>(m, "TopologyReport", "What the clean-up of the lattice's topology did.")
      .field("touching_mended", &T::touching_mended, "Edges and vertices at which tets merely touched.")
      .field("tets_added", &T::tets_added, "To join them.")
      .field("tets_dropped", &T::tets_dropped, "To part them.")
      .field("vertices_doubled", &T::vertices_doubled, "To part them.")
      .field("parts_dropped", &T::parts_dropped, "Components below min_part.")
      .field("dropped_volume", &T::dropped_volume, "Their volume.")
      .field("bubbles_filled", &T::bubbles_filled, "Voids without a way out.")
      .field("bubble_tets", &T::bubble_tets, "Tets that fill them.")
      .field("boundary_only_tets", &T::boundary_only_tets, "Tets with four boundary vertices, removed or split.")
      .field("boundary_only_edges", &T::boundary_only_edges, "Interior edges between boundary vertices, split.");
  using R = LatticeReport;
  Record<R>(m, "LatticeReport", "The lattice, and what was kept of it.")
      .field("cells", &R::cells, "Cells along the lattice's axes over the soup's box.")
      .field("cell_size", &R::cell_size, "Edge of a cell, in the soup's unit.")
      .field("mean_edge", &R::mean_edge, "Of the tets before smoothing, in the soup's unit.")
      .field("used_cells", &R::used_cells, "Cells with at least one kept tet.")
      .field("tet_count", &R::tet_count, "Kept tets.")
      .field("sampled_tets", &R::sampled_tets, "Tets that held no voxel centre and were judged by sampling.")
      .field("kept_volume", &R::kept_volume, "Of the kept tets.")
      .field("pseudo_volume", &R::pseudo_volume, "Of the inside voxels.")
      .field("kept_by_soup", &R::kept_by_soup, "Density left nothing: tets the soup passes through were kept.")
      .field("fills", &R::fills, "Lattices filled to hit the wanted count.")
      .field("translate_cells", &R::translate_cells, "The shift that was taken, fractions of a cell.")
      .field("rotate", &R::rotate, "The rotation that was taken, radians about x, then y, then z.")
      .field("stretch", &R::stretch,
             "Edges of the cells along their axes, in cell sizes: not 1 where flat sides are met.")
      .field("overlap", &R::overlap, "IoU of the kept tets with the pseudo volume.")
      .field("overlap_unfitted", &R::overlap_unfitted, "The same with the frame as given.")
      .field("thin_tets", &R::thin_tets, "Kept because a piece of the soup would have lost its cover.")
      .field("enclosing_tets", &R::enclosing_tets, "Kept to enclose the soup's vertices.")
      .field("evened_tets", &R::evened_tets, "Dropped or added for a smoother boundary.")
      .field("doubled_tets", &R::doubled_tets, "Copies made to keep apart what is apart.")
      .field("parted_vertices", &R::parted_vertices, "Vertices doubled between tets that stay what they were.")
      .field("excess_volume", &R::excess_volume, "Of the mesh, outside the pseudo volume.")
      .field("lacking_volume", &R::lacking_volume, "Of the pseudo volume, outside the mesh.")
      .field("topology", &R::topology, "What the clean-up did.")
      .field("notes", &R::notes, "What you should know, and the option that changes it.");
}

void bind_smooth_report(nb::module_& m) {
  using R = SmoothReport;
  Record<R>(m, "SmoothReport", "What smoothing did.")
      .field("passes", &R::passes, "Passes made.")
      .field("boundary_vertices", &R::boundary_vertices, "Their number.")
      .field("snapped", &R::snapped, "The boundary was drawn to the pseudo volume.")
      .field("shortened_moves", &R::shortened_moves, "Moves the limits cut short, over all passes.")
      .field("volume_before", &R::volume_before, "Of the mesh.")
      .field("volume_after", &R::volume_after, "Of the mesh.")
      .field("volume_wanted", &R::volume_wanted, "What it should be; 0: what the fit gives.")
      .field("min_dihedral", &R::min_dihedral, "Smallest dihedral angle afterwards, radians.")
      .field("boundary_volume_ratio", &R::boundary_volume_ratio,
             "For each boundary vertex, ascending: volume of the tets around it, after over before.")
      .field("notes", &R::notes, "What you should know, and the option that changes it.");
}

void bind_quality(nb::module_& m) {
  using R = Quality;
  Record<R>(m, "Quality", "Measures of a tet mesh. Angles are radians, volumes in the cube of the mesh's unit.")
      .field("vertex_count", &R::vertex_count, "Vertices.")
      .field("tet_count", &R::tet_count, "Tets.")
      .field("inverted_tets", &R::inverted_tets, "Signed volume <= 0, or not a number.")
      .field("invalid_tets", &R::invalid_tets, "Index out of range, or a vertex used twice: otherwise ignored.")
      .field("unused_vertices", &R::unused_vertices, "Of no valid tet.")
      .field("volume", &R::volume, "Sum of the signed volumes.")
      .field("min_tet_volume", &R::min_tet_volume, "Signed.")
      .field("max_tet_volume", &R::max_tet_volume, "Signed.")
      .field("volume_variation", &R::volume_variation, "Standard deviation of the tets' volumes over their mean.")
      .field("min_dihedral", &R::min_dihedral, "Radians, over all tets with a volume.")
      .field("max_dihedral", &R::max_dihedral, "Radians, over all tets with a volume.")
      .field("min_dihedral_p1", &R::min_dihedral_p1, "One tet in a hundred has a smallest angle below it, radians.")
      .field("dihedral_histogram", &R::dihedral_histogram, "36 bins of 5 degrees; six angles a tet.")
      .field("max_edge_ratio", &R::max_edge_ratio, "Longest over shortest edge of a tet, worst tet.")
      .field("mean_ratio_min", &R::mean_ratio_min, "12 (3 V)^(2/3) / sum of squared edges: 1 = regular, 0 = flat.")
      .field("mean_ratio_mean", &R::mean_ratio_mean, "The same, mean.")
      .field("components", &R::components, "Parts, joined through shared faces.")
      .field("boundary_triangles", &R::boundary_triangles, "Faces of exactly one tet.")
      .field("boundary_vertices", &R::boundary_vertices, "Vertices of those.")
      .field("boundary_closed", &R::boundary_closed, "Every boundary edge has an even number of boundary triangles.")
      .field("non_manifold_edges", &R::non_manifold_edges, "Boundary edges without exactly two boundary triangles.")
      .field("non_manifold_vertices", &R::non_manifold_vertices,
             "Boundary vertices whose triangles form no single fan.")
      .field("boundary_manifold", &R::boundary_manifold, "Closed, and neither of the two above.")
      .field("boundary_only_tets", &R::boundary_only_tets, "All four vertices on the boundary.")
      .field("boundary_only_faces", &R::boundary_only_faces, "Interior faces with three vertices on the boundary.")
      .field("boundary_only_edges", &R::boundary_only_edges, "Interior edges with two vertices on the boundary.")
      .field("roughness", &R::roughness, "Mean angle between neighbouring boundary triangles' normals, radians.")
      .field("boundary_area", &R::boundary_area, "Of all boundary triangles.")
      .field("boundary_curvature", &R::boundary_curvature, "Half the sum of length x angle over the boundary's edges.");
  using D = BoundaryDistance;
  Record<D>(m, "BoundaryDistance", "How far a mesh's boundary lies from a soup.")
      .field("mean", &D::mean, "Over the boundary's area.")
      .field("percentile95", &D::percentile95, "What 95 % of it is within.");
}

void bind_fidelity(nb::module_& m) {
  using R = Fidelity;
  Record<R>(m, "Fidelity", "What became of a soup's shape in a mesh. Edges are the mesh's mean edge.")
      .field("mean_edge", &R::mean_edge, "In the soup's unit.")
      .field("lost_edges", &R::lost_edges, "Size of the largest stretch of the soup without tets, edges.")
      .field("lost_stretches", &R::lost_stretches, "Those longer than 1.5 edges.")
      .field("closed", &R::closed, "The soup has a volume to compare with.")
      .field("soup_volume", &R::soup_volume, "Of a closed soup; parts that overlap count once.")
      .field("volume_ratio", &R::volume_ratio, "Volume of the mesh over that.")
      .field("wall_edges", &R::wall_edges, "Twice volume over area of a closed soup, edges.")
      .field("volume_limit", &R::volume_limit, "What the ratio may be: 1.1, more where walls are thin.")
      .field("stray_share", &R::stray_share, "Of the mesh's volume, outside the soup and half an edge from it.")
      .field("soup_pieces", &R::soup_pieces, "What hangs together at a 256th of the soup's longest side.")
      .field("mesh_pieces", &R::mesh_pieces, "Joined through faces.")
      .field("torn_pieces", &R::torn_pieces, "Pieces of the mesh beyond one of each of the soup's.")
      .field("joined_pieces", &R::joined_pieces, "Pieces of the soup that the mesh joins to others.")
      .field("lost_pieces", &R::lost_pieces, "Pieces of the soup without tets.")
      .field("soup_tunnels", &R::soup_tunnels, "Through the soup, where it is closed and one part.")
      .field("mesh_tunnels", &R::mesh_tunnels, "Through the mesh, where the soup's are known.")
      .field("overlapping_pairs", &R::overlapping_pairs, "Tets of one piece that lie in each other.")
      .field("overlap_share", &R::overlap_share, "Of the mesh's volume, in two tets of one piece.")
      .field("apart_pairs", &R::apart_pairs, "Tets of two pieces that lie in each other.")
      .field("apart_share", &R::apart_share, "Of the mesh's volume, in tets of two pieces.")
      .field("flat", &R::flat, "The soup is closed, of planes and sharp edges only.")
      .field("tilted_share", &R::tilted_share, "Of a flat soup's mesh: share of its surface that is dented.");
}

void bind_readiness(nb::module_& m) {
  using C = ReadinessCheck;
  Record<C>(m, "ReadinessCheck", "One thing that simulations suffer from, measured.")
      .field("name", &C::name, "For machines: 'min_dihedral_deg'.")
      .field("title", &C::title, "For people: 'smallest dihedral angle, degrees'.")
      .field("value", &C::value, "What the mesh has.")
      .field("limit", &C::limit, "What it should have.")
      .field("at_least", &C::at_least, "At least the limit, or at most.")
      .field("passed", &C::passed, "It does.")
      .field("advice", &C::advice, "What to change if it does not.");
  using R = Readiness;
  Record<R>(m, "Readiness", "Whether an engine will simulate a mesh well, its mass, and a stable time step.")
      .field("checks", &R::checks, "One by one.")
      .field("passed", &R::passed, "All of them.")
      .field("mass", &R::mass, "kg.")
      .field("stable_time_step", &R::stable_time_step, "s, of explicit integration; 0 without a positive tet.");
}

void bind_embed_report(nb::module_& m) {
  using R = EmbedReport;
  Record<R>(m, "EmbedReport", "Where embedded points lie.")
      .field("inside", &R::inside, "Points in the mesh, within rounding.")
      .field("outside", &R::outside, "Points beyond it, hung on the nearest tet.")
      .field("drawn_closer", &R::drawn_closer, "Those of them that max_extrapolation has drawn towards the mesh.")
      .field("other_copy", &R::other_copy,
             "Points that another copy of the tets is nearer to than that of their piece.")
      .field("non_finite", &R::non_finite, "Points that are none: hung on the first vertex of the first tet.")
      .field("max_distance", &R::max_distance, "Of the points outside from the mesh, in its unit.");
}

}  // namespace

void bind_reports(nb::module_& m) {
  bind_soup_report(m);
  bind_volume_report(m);
  bind_lattice_report(m);
  bind_smooth_report(m);
  bind_quality(m);
  bind_fidelity(m);
  bind_readiness(m);
  bind_embed_report(m);
}

}  // namespace tetsoup::python
