// The files that `tetsoup mesh` is to write: by format or for an engine.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files.h"
#include "mesh_run.h"
#include "tetsoup/engines.h"
#include "tetsoup/tet_model.h"

namespace tetsoup::cli {

/// What the flags say.
struct WantedMeshes {
  std::vector<std::string> paths;
  std::optional<std::string> format;
  std::optional<std::string> engine;
};

/// One mesh to be written.
struct PlannedMesh {
  std::filesystem::path path;
  TetFormat format = TetFormat::Msh41;
  const Engine* engine = nullptr;            ///< If it is for one; its wishes count then.
  std::vector<std::filesystem::path> files;  ///< All that may be written.
};

void add_output_flags(CLI::App& app, WantedMeshes& wanted);

/// Everything about them that can be wrong is found here, before the work starts.
std::vector<PlannedMesh> plan_meshes(const WantedMeshes& wanted, Outputs& outputs);

/// @throws InvalidInput  if the format has no place for tets of ten nodes.
void require_midsides(const PlannedMesh& mesh);

/// Whether the format has a place for the input's own surface and its embedding.
bool holds_surface(TetFormat format);

/// Writes one, and notes it in the run.
void write_planned(const PlannedMesh& planned, const TetModel& model, bool material_is_default, MeshRun& run);

}  // namespace tetsoup::cli
