// tetsoup::io: what each simulation engine wants to read, and a scene that it runs at once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/io.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

/// One engine's wishes.
struct Engine {
  std::string name;     ///< As `--for` takes it: "mujoco".
  std::string title;    ///< "MuJoCo"
  std::string summary;  ///< One line: file, base, orientation, unit, scene.
  TetFormat format;
  std::string extension;        ///< Of the mesh file, with the dot.
  std::string scene_extension;  ///< What the scene's file adds to the stem: ".xml", "_sofa.py"; empty: there is none.
  std::string usage;  ///< What to do next, one line in which {mesh}, {stem} and {scene} stand for names of files.
};

/// All of them, in alphabetical order.
const std::vector<Engine>& engines();

/// By name, or by another name it goes by: "pybullet" is bullet.
/// @throws InvalidInput  listing them, if there is none of that name.
const Engine& find_engine(std::string_view name);

/// Files that write_for_engine() may write: the mesh's first. `path` may leave the extension out.
/// @throws InvalidInput  if the path has another extension than the engine's.
std::vector<std::filesystem::path> engine_files(const Engine& engine, const std::filesystem::path& path);

/// What an engine is told of a calibrated model, in its mesh or in its scene.
CalibrationForm calibration_of(const Engine& engine);

/// The engine's usage with the names of the files that engine_files() gives.
std::string engine_usage(const Engine& engine, const std::filesystem::path& path);

/// Writes the mesh as this engine reads it (in metres, positive tets unless it wants others) and beside it, where there
/// is one, a scene that drops the body on a plane and runs as it stands. All files appear, or none.
///
/// The scene's stiffness is what the model says, and its time step the engine's default unless that needs a shorter
/// one. If `material_is_default`, it is instead a hundred times the pressure of the body's own weight, so that a body
/// of any size hardly sags, or less where the engine's default step would not bear it.
/// @return  The files written, the mesh's first.
/// @throws InvalidInput  as engine_files(); IoError.
std::vector<std::filesystem::path> write_for_engine(const Engine& engine, const std::filesystem::path& path,
                                                    const TetModel& model, bool material_is_default = true);

}  // namespace tetsoup
