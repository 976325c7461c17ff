// The surfaces of all bodies in every frame: OBJ with polygons, texture coordinates and names, or PLY.
#pragma once

#include <filesystem>
#include <string>

#include "io/animation/cast.h"
#include "io/animation/file_log.h"

namespace tetsoup::animation {

class SurfaceSeries {
 public:
  /// @param path  Of the series: x.obj or x.ply.
  SurfaceSeries(const Cast& cast, std::filesystem::path path);

  void add(FrameView& view, std::size_t number, FileLog& log) const;

 private:
  std::string obj_text(FrameView& view) const;
  void write_ply(const std::filesystem::path& file, FrameView& view) const;

  const Cast& cast_;
  std::filesystem::path path_;
};

/// All obstacles in one OBJ file, each an object; nothing if there are none.
void write_obstacles(const Cast& cast, const std::filesystem::path& path, FileLog& log);

}  // namespace tetsoup::animation
