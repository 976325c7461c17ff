// All files that a tet mesh becomes in some format, before any of them is written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tetsoup/io.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

struct NamedText {
  std::filesystem::path path;
  std::string text;
};

/// For every format but TetFormat::Surface; the mesh itself first.
std::vector<NamedText> tet_texts(const std::filesystem::path& path, const TetModel& model, TetFormat format);

/// Writes all or none. @return  Their paths.
std::vector<std::filesystem::path> write_together(const std::vector<NamedText>& files);

}  // namespace tetsoup
