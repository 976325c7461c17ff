// What a TetModel says, as the writers ask for it: names a file may hold, tets of a region, units that fit together.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/tet_model.h"

namespace tetsoup {

/// @throws InvalidInput  if an index is out of range, or arrays that belong together differ in length.
void require_valid(const TetModel& model);

/// Without its name or material a lone region says nothing that a mesh does not.
inline bool has_regions(const TetModel& model) {
  return model.regions.size() > 1;
}
inline std::uint32_t region_of(const TetModel& model, std::size_t tet) {
  return model.tet_regions.empty() ? 0 : model.tet_regions[tet];
}
inline double stiffness_scale_of(const TetModel& model, std::size_t tet) {
  return model.stiffness_scale.empty() ? 1.0 : model.stiffness_scale[tet];
}
inline double density_scale_of(const TetModel& model, std::size_t tet) {
  return model.density_scale.empty() ? 1.0 : model.density_scale[tet];
}
/// Tets of every region, ascending; a region may have none.
std::vector<std::vector<std::uint32_t>> tets_by_region(const TetModel& model);

/// For every vertex the first set that holds it, counted from 1; 0: none.
std::vector<std::uint32_t> pin_marks(const TetModel& model);
/// All vertices that any set holds, ascending.
std::vector<std::uint32_t> pinned_vertices(const TetModel& model);

/// Edges of the tets, each once with the lower vertex first, ascending.
std::vector<std::array<std::uint32_t, 2>> unique_edges(const TetMesh& mesh);

/// Nodes of every tet where the model has those of edges: its corners, then between the first and the second of them,
/// the second and third, third and first, and from these three to the fourth. They are counted behind the vertices.
std::vector<std::array<std::uint32_t, 10>> ten_nodes(const TetModel& model);
/// Vertices and nodes of edges in the input's place.
std::vector<Vec3d> placed_nodes(const TetModel& model);
/// A set of vertices, with the nodes of edges between two of them.
std::vector<std::uint32_t> nodes_of(const TetModel& model, const std::vector<std::uint32_t>& vertices);

/// Names that every format takes: letters, digits and underscores, the first a letter, at most 60 of them, no two
/// alike whatever the case, and none of those `reserved`.
class LegalNames {
 public:
  explicit LegalNames(std::initializer_list<std::string_view> reserved = {});

  /// The nearest legal name; `fallback` where nothing is left.
  std::string make(std::string_view wanted, std::string_view fallback);

 private:
  std::vector<std::string> used_;  // In lower case.
};
/// Of the regions, which are "region" where they have none.
std::vector<std::string> region_names(const TetModel& model, LegalNames& names);
std::vector<std::string> pin_names(const TetModel& model, LegalNames& names);

/// Density and Young's modulus in the mesh's own unit of length, kilograms and seconds, so that a solver without units
/// computes with consistent ones. In metres they are what they were.
Material in_mesh_units(const Material& material);

}  // namespace tetsoup
