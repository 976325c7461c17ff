// Presets: which files an engine gets, in metres.
#include "tetsoup/engines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "base/listing.h"
#include "base/require.h"
#include "base/vec.h"
#include "io/calibrated_model.h"
#include "io/engines/engine_table.h"
#include "io/engines/scenes.h"
#include "io/file_names.h"
#include "io/model_parts.h"
#include "io/raw_numbers.h"
#include "io/tet_files.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

void scale(std::vector<Vec3>& points, double factor) {
  for (Vec3& p : points) p = {narrow(p.x * factor), narrow(p.y * factor), narrow(p.z * factor)};
}

// Weights and normals have no unit.
TetModel in_metres(TetModel model) {
  const double unit = model.regions.front().material.metres_per_unit;
  require(std::isfinite(unit) && unit > 0, "metres_per_unit", unit, "above 0");
  if (unit != 1) {
    scale(model.mesh.vertices, unit);
    scale(model.midsides.places, unit);
    scale(model.render.vertices, unit);
    model.mesh.origin = model.mesh.origin * unit;
    model.render.origin = model.render.origin * unit;
    for (float& distance : model.embedding.distances) distance = narrow(distance * unit);
    model.embedding.report.max_distance *= unit;
  }
  for (Region& region : model.regions) region.material.metres_per_unit = 1;
  return model;
}

// Changes of one letter that lead from one word to the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

[[noreturn]] void fail_unknown(std::string_view name) {
  constexpr std::size_t kMostTypos = 2;
  std::string nearest;
  std::size_t least = kMostTypos + 1;
  for (const Engine& engine : engines()) {
    if (const std::size_t typos = edit_distance(name, engine.name); typos < least) {
      least = typos;
      nearest = engine.name;
    }
  }
  throw InvalidInput("engine " + std::string(name) + ": there is no such engine; " +
                     (nearest.empty() ? "" : "did you mean " + nearest + "? ") + "There are " +
                     listing(engines(), [](const Engine& engine) { return engine.name; }));
}

fs::path mesh_path(const Engine& engine, const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension.empty()) return fs::path(path) += engine.extension;
  const bool fits = extension == engine.extension ||
                    (engine.format == TetFormat::Tetgen && (extension == ".ele" || extension == ".face"));
  require(fits, "file for " + engine.title, path.string(), "named without an extension or with " + engine.extension);
  return path;
}

fs::path scene_path(const Engine& engine, const fs::path& mesh) {
  return fs::path(mesh).replace_extension() += engine.scene_extension;
}

void replace_all(std::string& text, std::string_view mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

}  // namespace

const std::vector<Engine>& engines() {
  static const std::vector<Engine> table = engine_table();
  return table;
}

const Engine& find_engine(std::string_view name) {
  const auto alias = engine_aliases().find(name);
  const std::string_view wanted = alias == engine_aliases().end() ? name : alias->second;
  for (const Engine& engine : engines())
    if (engine.name == wanted) return engine;
  fail_unknown(name);
}

std::vector<fs::path> engine_files(const Engine& engine, const fs::path& path) {
  const fs::path mesh = mesh_path(engine, path);
  std::vector<fs::path> files = tet_files(mesh, engine.format);
  if (!engine.scene_extension.empty()) files.push_back(scene_path(engine, mesh));
  return files;
}

CalibrationForm calibration_of(const Engine& engine) {
  if (engine.name == "sofa") return CalibrationForm::PerTet;  // Its scene lists moduli; the mesh has no place for them.
  // The other scenes take one material, but for those of the formats that hold some.
  const CalibrationForm form = calibration_of(engine.format);
  const bool of_mesh = form == CalibrationForm::Steps || engine.format == TetFormat::Npz;
  return engine.scene_extension.empty() || of_mesh ? form : CalibrationForm::OneFactor;
}

std::string engine_usage(const Engine& engine, const fs::path& path) {
  const fs::path mesh = mesh_path(engine, path);
  std::string text = engine.usage;
  replace_all(text, "{mesh}", mesh.string());
  replace_all(text, "{stem}", fs::path(mesh).replace_extension().string());
  replace_all(text, "{scene}", scene_path(engine, mesh).string());
  return text;
}

std::vector<fs::path> write_for_engine(const Engine& engine, const fs::path& path, const TetModel& model,
                                       bool material_is_default) {
  require_valid(model);
  const TetModel scaled = calibrated_as(calibration_of(engine), in_metres(model));
  const fs::path mesh = mesh_path(engine, path);
  std::vector<NamedText> files = tet_texts(mesh, scaled, engine.format);
  if (!engine.scene_extension.empty())
    files.push_back({scene_path(engine, mesh),
                     scene_text(engine, {scaled, files.front().path.filename().string(), material_is_default})});
  return write_together(files);
}

}  // namespace tetsoup
