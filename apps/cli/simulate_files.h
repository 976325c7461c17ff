// The files that frames go into.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tetsoup/animation.h"
#include "tetsoup/scene.h"

namespace tetsoup::cli {

class FrameFiles {
 public:
  /// @param paths  As AnimationWriter takes them; none: nothing is written.
  /// @param view   What pictures showed before, of a scene that goes on.
  /// The loaded scene must outlive it.
  FrameFiles(std::vector<std::filesystem::path> paths, const LoadedScene& loaded, const std::optional<Box3>& view);

  /// The scene as it is now.
  void add_frame(std::uint64_t state_hash);
  /// Films are written now, of the frames so far.
  void finish();
  /// Removes all that was written.
  void remove_all() const;

  /// What pictures show.
  std::optional<Box3> view() const;

 private:
  const LoadedScene& loaded_;
  std::optional<AnimationWriter> writer_;
};

}  // namespace tetsoup::cli
