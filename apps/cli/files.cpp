#include "files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "tetsoup/error.h"
#include "tetsoup/samples.h"

namespace tetsoup::cli {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool is_sample(const std::string& name) {
  const std::vector<std::string> names = sample_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

void check_input(const fs::path& path) {
  const std::string name = path.string();
  if (name == "-") throw InvalidInput("IN -: standard input is not read; save the soup to a file and name that");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    if (is_sample(name))
      throw IoError(
          fmt::format("{0}: no such file; it is the name of a sample, which `tetsoup sample {0}` writes", name));
    throw IoError(fmt::format("{}: no such file; check the path", name));
  }
  if (status.type() == fs::file_type::directory) throw IoError(name + ": this is a folder; name a file in it");
  if (access(path.c_str(), R_OK) != 0)
    throw IoError(fmt::format("{}: cannot be read: {}; check its permissions", name, std::strerror(errno)));
}

namespace {

/// A USD file may hold tets, a surface or anything; its text tells.
bool is_usd_without_tets(const fs::path& path) {
  if (lower_extension(path) != ".usda") return false;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.find("def TetMesh") != line.npos) return false;
  return true;
}

void refuse_tets(const fs::path& path) {
  if (is_tet_file(path) && !is_usd_without_tets(path))
    throw IoError(path.string() +
                  ": this is a tet mesh already, where triangles are wanted; `tetsoup inspect` shows how good it is if "
                  "it is .msh .vtk .vtu .mesh .npz or .node");
}

}  // namespace

TriangleSoup read_input_soup(const fs::path& path, std::optional<double> point_size) {
  if (point_size) return triangles_of(read_input_surface(path, point_size));
  refuse_tets(path);
  return read_soup(path);
}

RenderMesh read_input_surface(const fs::path& path, std::optional<double> point_size) {
  refuse_tets(path);
  RenderMesh surface = read_render_mesh(path);
  if (!point_size) return surface;
  if (!surface.face_sizes.empty())
    throw InvalidInput(
        fmt::format("--point-size: {} holds faces; it is for files that hold points alone", path.string()));
  return triangles_at_points(std::move(surface), *point_size);
}

void Outputs::add(std::string_view flag, const fs::path& path) {
  const fs::path folder = folder_of(path);
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoError(fmt::format("{} {}: there is no folder {}; make it first", flag, path.string(), folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw IoError(fmt::format("{} {}: cannot write into {}: {}; choose another folder", flag, path.string(),
                              folder.string(), std::strerror(errno)));
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    throw IoError(
        fmt::format("{} {}: not a file, and will not be replaced by one; choose another name", flag, path.string()));
  if (!input_.empty() && fs::equivalent(path, input_, error))
    throw InvalidInput(fmt::format("{} {}: this is the input; choose another name", flag, path.string()));
  const fs::path whole = fs::weakly_canonical(folder, error) / path.filename();
  const auto same = std::find_if(added_.begin(), added_.end(), [&](const Added& other) { return other.path == whole; });
  if (same != added_.end())
    throw InvalidInput(
        fmt::format("{} {}: {} writes a file of this name; choose another name", flag, path.string(), same->flag));
  added_.push_back({whole, std::string(flag)});
}

void Outputs::add(std::string_view flag, const fs::path& path, std::string_view extension) {
  if (lower_extension(path) != extension)
    throw IoError(fmt::format("{} {}: the file's name must end in {}", flag, path.string(), extension));
  add(flag, path);
}

TetFormat Outputs::add_mesh(std::string_view flag, const fs::path& path, std::optional<TetFormat> wanted) {
  const TetFormat format = wanted ? *wanted : tet_format_of(path);
  const std::string extension = lower_extension(path);
  if (format == TetFormat::Surface && extension != ".obj" && extension != ".stl" && extension != ".ply")
    throw IoError(fmt::format("{} {}: a surface file's name must end in .obj, .stl or .ply", flag, path.string()));
  for (const fs::path& file : tet_files(path, format)) add(flag, file);
  return format;
}

NewFiles::~NewFiles() {
  if (kept_) return;
  std::error_code error;
  for (const fs::path& path : made_) fs::remove(path, error);
}

void NewFiles::expect(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) made_.push_back(path);
}

void NewFiles::expect_all(const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) expect(path);
}

void write_stdout(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw IoError(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

void write_report(const std::string& path, std::string_view text) {
  if (path == "-") return write_stdout(text);
  write_file_atomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace tetsoup::cli
