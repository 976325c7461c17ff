#include "mesh_model.h"

#include <filesystem>

#include "files.h"

namespace tetsoup::cli {

namespace {

UpAxis usual_up_axis(const std::filesystem::path& input) {
  const std::string extension = lower_extension(input);
  return extension == ".obj" || extension == ".gltf" || extension == ".glb" ? UpAxis::Y : UpAxis::Z;
}

}  // namespace

TetModel make_model(const MeshRun& run, const ModelOptions& options) {
  TetModel model;
  model.name = std::filesystem::path(run.input).stem().string();
  model.mesh = run.pipeline->smooth().mesh;
  model.regions = {{model.name, run.material}};
  model.up = options.up.value_or(usual_up_axis(run.input));
  return model;
}

}  // namespace tetsoup::cli
