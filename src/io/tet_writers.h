// The writers of tet meshes, each giving a file's bytes. The model must be valid; what a format has no place for is
// left out.
#pragma once

#include <span>
#include <string>

#include "tetsoup/io.h"
#include "tetsoup/tet_model.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Neither regions nor pins: they would need a second block.
std::string msh41_text(const TetModel& model);
/// Regions are physical volumes.
std::string msh22_text(const TetModel& model);
/// Cell data `region` and point data `pin_<name>`, behind all that Bullet reads; so in VTU.
std::string vtk_text(const TetModel& model);
std::string vtu_text(const TetModel& model);
/// References: region of a tet, pin set of a vertex, counted from 1.
std::string medit_text(const TetModel& model);

/// Attribute of a tet: its region; marker of a vertex: its pin set, counted from 1.
std::string tetgen_node_text(const TetModel& model);
std::string tetgen_ele_text(const TetModel& model);
std::string tetgen_face_text(const TetModel& model);

std::string isaacgym_text(const TetModel& model);
/// A material, a set and a region for each region.
std::string vega_text(const TetModel& model);
/// Pinned vertices from 1, commas between them and no blanks, which Vega's reader would stop at.
std::string vega_pins_text(const TetModel& model);
/// An element set, material and section for each region, a node set for each pin set, and the boundary as surface HULL.
std::string abaqus_text(const TetModel& model);
/// Domains are regions; faces between two regions are surface elements too.
std::string netgen_text(const TetModel& model);
/// docs/FORMATS.md has its layout.
std::string json_text(const TetModel& model);
std::string obj_tets_text(const TetModel& model);
/// NumPy arrays as Newton names them: vertices (P, 3), k_mu and k_lambda (T) float32, tet_indices (T, 4) int32,
/// density. Only models that have such also hold tet_regions, tet_densities (T), region_names, pin_<name>,
/// embedding_tets (N), embedding_weights (N, 4), render_vertices (N, 3).
std::string npz_text(const TetModel& model);
std::string usda_text(const TetModel& model);

/// @throws IoError  listing what there is, if the extension is none of them.
SurfaceFormat surface_format_of(const std::filesystem::path& path);

}  // namespace tetsoup
