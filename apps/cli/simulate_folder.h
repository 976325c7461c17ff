// The folder of a simulation: what is in it so that it can be looked at, told from others, and continued.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tetsoup/scene.h"

namespace tetsoup::cli {

/// One line of DIR/frames.json.
struct FrameRecord {
  std::size_t frame = 0;
  double time = 0;
  std::uint64_t state_hash = 0;
};

/// "0x0123456789abcdef"
std::string hash_words(std::uint64_t hash);

/// DIR/scene.json, DIR/frames.json and DIR/state.bin.
class SimulationFolder {
 public:
  /// @throws IoError  if it cannot be a folder, or holds a simulation that is not to be continued.
  SimulationFolder(std::filesystem::path path, const Scene& scene, bool resume);

  /// Brings the scene to where the folder's simulation stands; at its start where there is none. Files of later frames
  /// are removed.
  /// @throws IoError  if the folder is of another scene or damaged, or the state or a frame is missing.
  void resume(LoadedScene& loaded);

  void add(const FrameRecord& record) { frames_.push_back(record); }
  /// From here on it can be continued.
  void save(const LoadedScene& loaded, const std::optional<Box3>& view) const;

  const std::filesystem::path& path() const { return path_; }
  const std::vector<FrameRecord>& frames() const { return frames_; }
  /// What pictures showed so far.
  const std::optional<Box3>& view() const { return view_; }

 private:
  void check_frame_files() const;
  void remove_later_files() const;

  std::filesystem::path path_;
  std::vector<FrameRecord> frames_;
  std::optional<Box3> view_;
  std::string scene_text_;  ///< As it is written, names of files made absolute.
};

}  // namespace tetsoup::cli
