#include "simulate_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "files.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path.string() + ": cannot be read; without it the simulation cannot be continued");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_text(const fs::path& path, std::string_view text) {
  write_file_atomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

/// The folder may be read from anywhere.
Scene with_absolute_files(Scene scene) {
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(scene.folder.empty() ? fs::path(".") : scene.folder, ignored);
  const auto extend = [&](std::string& file) {
    if (!file.empty()) file = (folder / file).string();
  };
  for (SceneBody& body : scene.bodies) {
    extend(body.source.file);
    extend(body.source.tets_file);
    extend(body.surface_file);
  }
  for (SceneObstacle& obstacle : scene.obstacles) extend(obstacle.source.file);
  return scene;
}

/// What must be the same for a scene to go on; it may go on for longer.
std::string text_to_compare(Scene scene) {
  scene.seconds = 0;
  return scene_text(scene);
}

std::uint64_t parse_hash(const std::string& words) {
  return std::stoull(words, nullptr, 16);
}

/// The number in frame_0012.vtu and preview_0012.png; none of other names.
std::optional<std::size_t> number_in(const fs::path& path) {
  constexpr std::size_t kMostDigits = 9;
  const std::string stem = path.stem().string(), extension = path.extension().string();
  const std::string start = extension == ".vtu" ? "frame_" : "preview_";
  if ((extension != ".vtu" && extension != ".png") || !stem.starts_with(start)) return {};
  const std::string digits = stem.substr(start.size());
  if (digits.size() < 4 || digits.size() > kMostDigits || digits.find_first_not_of("0123456789") != digits.npos)
    return {};
  return std::stoul(digits);
}

/// Whether there is more than the beginning of a simulation, which any run writes again.
bool holds_frames(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (number_in(entry.path()).value_or(0) > 0) return true;
  if (!fs::exists(folder / "frames.json", ignored)) return false;
  const Json json = Json::parse(read_text(folder / "frames.json"), nullptr, false);
  return !json.is_object() || !json.contains("frames") || json["frames"].size() > 1;
}

}  // namespace

std::string hash_words(std::uint64_t hash) {
  return fmt::format("0x{:016x}", hash);
}

SimulationFolder::SimulationFolder(fs::path path, const Scene& scene, bool resume)
    : path_(std::move(path)), scene_text_(scene_text(with_absolute_files(scene))) {
  std::error_code error;
  if (fs::exists(path_ / "frames.json", error) && !resume)
    throw IoError(fmt::format("-o {}: this folder holds a simulation; --resume goes on with it, or name another folder",
                              path_.string()));
  fs::create_directory(path_, error);
  if (!fs::is_directory(path_))
    throw IoError(fmt::format("-o {}: the folder cannot be made: {}", path_.string(),
                              error ? error.message() : "something else is there"));
}

void SimulationFolder::resume(LoadedScene& loaded) {
  if (!fs::exists(path_ / "state.bin")) {
    if (!holds_frames(path_)) return;
    throw IoError((path_ / "state.bin").string() +
                  ": it is missing, without it the simulation cannot go on; start anew in another folder");
  }
  const Scene before = read_scene(path_ / "scene.json");
  if (text_to_compare(before) != text_to_compare(parse_scene(scene_text_, {})))
    throw IoError(path_.string() + ": this is the folder of another scene, or of other options; name another folder");
  const std::string state = read_text(path_ / "state.bin");
  try {
    restore_scene_state(loaded, std::as_bytes(std::span(state.data(), state.size())));
    const Json json = Json::parse(read_text(path_ / "frames.json"));
    for (const Json& frame : json.at("frames")) {
      if (frames_.size() > loaded.frame) break;  // written after the state was
      frames_.push_back({frame.at("frame"), frame.at("time"), parse_hash(frame.at("state_hash"))});
    }
    if (json.contains("view")) {
      const auto corner = [&](std::size_t i) {
        return Vec3d{json["view"].at(i).at(0), json["view"].at(i).at(1), json["view"].at(i).at(2)};
      };
      view_ = Box3{corner(0), corner(1)};
    }
  } catch (const InvalidInput& error) {
    throw IoError((path_ / "state.bin").string() + ": " + error.what());
  } catch (const std::exception&) {
    throw IoError((path_ / "frames.json").string() + ": it is damaged; start anew in another folder");
  }
  if (frames_.size() != loaded.frame + 1 || frames_.back().state_hash != loaded.simulation.state_hash())
    throw IoError(path_.string() + ": state.bin and frames.json are of different runs; start anew in another folder");
  check_frame_files();
  remove_later_files();
  if (loaded.frame == 0) frames_.clear();  // The beginning is written again: a run may have ended before it was.
}

void SimulationFolder::check_frame_files() const {
  if (frames_.size() == 1) return;
  for (const FrameRecord& frame : frames_) {
    const fs::path file = path_ / fmt::format("frame_{:04}.vtu", frame.frame);
    if (!fs::exists(file)) throw IoError(file.string() + ": it is missing; start anew in another folder");
  }
}

/// What a run wrote after its last state, or the frames of two runs would lie side by side.
void SimulationFolder::remove_later_files() const {
  std::vector<fs::path> later;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, ignored))
    if (number_in(entry.path()).value_or(0) >= frames_.size()) later.push_back(entry.path());
  for (const fs::path& path : later) fs::remove(path, ignored);
}

void SimulationFolder::save(const LoadedScene& loaded, const std::optional<Box3>& view) const {
  write_text(path_ / "scene.json", scene_text_);
  std::string text = fmt::format("{{\n  \"fps\": {},\n", Json(loaded.scene.fps).dump());
  if (view) {
    const auto corner = [](const Vec3d& p) { return Json::array({p.x, p.y, p.z}); };
    text += fmt::format("  \"view\": {},\n", Json::array({corner(view->lo), corner(view->hi)}).dump());
  }
  text += "  \"frames\": [\n";
  for (const FrameRecord& frame : frames_)
    text += fmt::format("    {{\"frame\": {}, \"time\": {}, \"state_hash\": \"{}\"}}{}\n", frame.frame,
                        Json(frame.time).dump(), hash_words(frame.state_hash), &frame == &frames_.back() ? "" : ",");
  write_text(path_ / "frames.json", text + "  ]\n}\n");
  const std::vector<std::byte> state = save_scene_state(loaded);
  write_file_atomic(path_ / "state.bin", state);
}

}  // namespace tetsoup::cli
