// Tet meshes into files.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/require.h"
#include "io/atomic_file.h"
#include "io/calibrated_model.h"
#include "io/file_names.h"
#include "io/model_parts.h"
#include "io/tet_files.h"
#include "io/tet_writers.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

fs::path vega_pins_path(const fs::path& path) {
  return fs::path(path).replace_extension(".bou");
}

}  // namespace

std::vector<fs::path> tet_files(const fs::path& path, TetFormat format) {
  if (format == TetFormat::Vega) return {path, vega_pins_path(path)};
  if (format != TetFormat::Tetgen) return {path};
  const TetgenSet set = tetgen_set(path);
  return {set.nodes, set.tets, set.faces};
}

std::vector<NamedText> tet_texts(const fs::path& path, const TetModel& model, TetFormat format) {
  switch (format) {
    case TetFormat::Msh41:
      return {{path, msh41_text(model)}};
    case TetFormat::Msh22:
      return {{path, msh22_text(model)}};
    case TetFormat::Vtk:
      return {{path, vtk_text(model)}};
    case TetFormat::Vtu:
      return {{path, vtu_text(model)}};
    case TetFormat::Medit:
      return {{path, medit_text(model)}};
    case TetFormat::Tetgen: {
      const TetgenSet set = tetgen_set(path);
      return {{set.nodes, tetgen_node_text(model)},
              {set.tets, tetgen_ele_text(model)},
              {set.faces, tetgen_face_text(model)}};
    }
    case TetFormat::IsaacGym:
      return {{path, isaacgym_text(model)}};
    case TetFormat::Vega: {
      std::vector<NamedText> files{{path, vega_text(model)}};
      if (!pinned_vertices(model).empty()) files.push_back({vega_pins_path(path), vega_pins_text(model)});
      return files;
    }
    case TetFormat::Abaqus:
      return {{path, abaqus_text(model)}};
    case TetFormat::Netgen:
      return {{path, netgen_text(model)}};
    case TetFormat::Npz:
      return {{path, npz_text(model)}};
    case TetFormat::Json:
      return {{path, json_text(model)}};
    case TetFormat::Usd:
      return {{path, usda_text(model)}};
    case TetFormat::ObjTets:
      return {{path, obj_tets_text(model)}};
    case TetFormat::Surface:
      break;
  }
  throw InvalidInput("format surface: not one of tets");
}

std::vector<fs::path> write_together(const std::vector<NamedText>& files) {
  std::vector<AtomicFile> open;
  std::vector<fs::path> paths;
  for (const NamedText& file : files) {
    open.emplace_back(file.path).write(file.text);
    paths.push_back(file.path);
  }
  AtomicFile::commit_together(open);
  return paths;
}

std::vector<fs::path> write_tets(const fs::path& path, const TetModel& model, std::optional<TetFormat> format) {
  require_valid(model);
  const TetFormat chosen = format ? *format : tet_format_of(path);
  if (chosen != TetFormat::Surface)
    return write_together(tet_texts(path, calibrated_as(calibration_of(chosen), model), chosen));
  write_surface(path, model.mesh.vertices, boundary_triangles(model.mesh), model.mesh.origin);
  return {path};
}

std::vector<fs::path> write_tets(const fs::path& path, const TetMesh& mesh, std::optional<TetFormat> format) {
  TetModel model;
  model.mesh = mesh;
  return write_tets(path, model, format);
}

}  // namespace tetsoup
