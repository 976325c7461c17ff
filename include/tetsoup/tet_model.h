// tetsoup: a tet mesh with all that a simulation engine's file may say about it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tetsoup/embed.h"
#include "tetsoup/readiness.h"
#include "tetsoup/regions.h"
#include "tetsoup/render_mesh.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct Region {
  std::string name;
  Material material;
};

enum class UpAxis { X, Y, Z };

/// What is written. All but the mesh may be missing.
struct TetModel {
  std::string name = "body";  ///< Of the body, in files that name things.
  TetMesh mesh;
  std::vector<Region> regions{{}};         ///< At least one.
  std::vector<std::uint32_t> tet_regions;  ///< Region of every tet; empty: all are of the first.
  std::vector<VertexSet> pins;             ///< Vertices to be held.
  std::vector<float> stiffness_scale;  ///< Young's modulus of every tet over its material's (calibrate.h); empty: 1.
  std::vector<float> density_scale;    ///< Density likewise; empty: 1.
  Midsides midsides;                   ///< With edges: tets of ten nodes, where the format has such.
  double stiffness_factor = 1;         ///< Instead of the former, for all tets, where a format takes one material.
  RenderMesh render;                   ///< The input's own surface,
  Embedding embedding;                 ///< and where its vertices lie in the mesh.
  UpAxis up = UpAxis::Z;               ///< Of the model, for the scene it is placed in.
};

/// What a region's tets are together.
struct RegionSize {
  std::size_t tet_count = 0;
  double volume = 0;  ///< In the mesh's unit,
  double mass = 0;    ///< and in kilograms, with the region's density and the scales of its tets.
};
/// Of every region.
std::vector<RegionSize> region_sizes(const TetModel& model);

/// Leaves out what the vertices are counted from, so that the model lies around zero; its surface keeps its place in
/// it.
void recentre(TetModel& model);

/// Mass in kg: of all regions.
double mass_of(const TetModel& model);

}  // namespace tetsoup
