// From a run to all that a file may say about its mesh: render surface, regions, pins.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh_run.h"
#include "part_labels.h"
#include "progress_bar.h"
#include "tetsoup/io.h"
#include "tetsoup/tet_model.h"

namespace tetsoup::cli {

/// The material of one region, where it is not that of the whole.
struct RegionWish {
  std::string name;
  std::optional<double> density, young, poisson;
};

/// Vertices to be held: those that `choose` finds, or those nearest to a named part of the input.
struct PinWish {
  std::string name;
  std::function<std::vector<std::uint32_t>(const TetMesh&)> choose;  ///< Empty: by name.
};

/// Of tets: four nodes, or ten.
enum class Order { Linear, Quadratic };

struct ModelOptions {
  Order order = Order::Linear;
  std::optional<UpAxis> up;          ///< Else by the input's format: y for OBJ and glTF, z for all others.
  std::optional<std::string> embed;  ///< File for the embedding.
  std::optional<RegionsBy> regions_by;
  bool fit_regions = true;  ///< Faces of tets follow the borders between regions.
  std::vector<RegionWish> materials;
  std::vector<PinWish> pins;
  bool recentre = false;  ///< Files leave out what the vertices are counted from.
};

void add_model_flags(CLI::App& app, ModelOptions& options);

/// Whether the input's own surface is wanted, or triangles are enough.
bool wants_surface(const ModelOptions& options, bool format_holds_surface);

/// @throws InvalidInput  listing what there is, if the surface lacks a name that the options ask for.
void check_names(const ModelOptions& options, const RenderMesh& surface);

/// @param surface  Of the input; empty if it is not wanted.
TetModel make_model(const MeshRun& run, const ModelOptions& options, RenderMesh surface, ProgressBar& bar);

/// What a reader of the summary should know of it; empty if there is nothing.
std::string describe_model(const TetModel& model);

}  // namespace tetsoup::cli
