// All bodies' tets of every frame as .vtu, and the .pvd that lists them with their times.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/animation/cast.h"
#include "io/animation/file_log.h"

namespace tetsoup::animation {

class VtuSeries {
 public:
  /// @param path  Of the .pvd.
  /// @param stem  Of the frames, which lie beside it.
  /// @throws IoError  if the series is to be continued and its .pvd cannot be read.
  VtuSeries(const Cast& cast, std::filesystem::path path, std::string stem, std::size_t first_frame);

  void add(FrameView& view, std::size_t number, FileLog& log);

 private:
  struct Entry {
    std::string file, time;
  };
  void read_entries(std::size_t first_frame);
  void write_list(FileLog& log) const;

  std::filesystem::path path_;
  std::string stem_;
  std::vector<Entry> entries_;
  std::size_t point_count_ = 0, tet_count_ = 0;
  std::string cells_;  // The blocks of all frames that are the same in all.
};

}  // namespace tetsoup::animation
