// The files a command reads and writes: what can be told to be wrong is told before the work starts.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "tetsoup/io.h"

namespace tetsoup::cli {

/// In lower case, with the dot.
std::string lower_extension(const std::filesystem::path& path);

/// @throws IoError  unless the path names something that can be read as a file; a sample's name gets a hint.
void check_input(const std::filesystem::path& path);

/// Reads a soup; a tet mesh is refused with a hint.
/// @param point_size  Edge of the triangle that each point becomes of a file that holds only points.
TriangleSoup read_input_soup(const std::filesystem::path& path, std::optional<double> point_size = {});

/// The same with all that the file says about it.
RenderMesh read_input_surface(const std::filesystem::path& path, std::optional<double> point_size = {});

/// All that one run will write.
class Outputs {
 public:
  /// Nothing is ever written over `input`; empty: there is none.
  explicit Outputs(std::filesystem::path input) : input_(std::move(input)) {}

  /// @throws IoError       if the folder is missing or closed to us, or something else than a file stands there;
  ///         InvalidInput  if it is the input or was added before.
  void add(std::string_view flag, const std::filesystem::path& path);

  /// The same for a file that must have this extension.
  void add(std::string_view flag, const std::filesystem::path& path, std::string_view extension);

  /// Adds a tet mesh and what is written beside it. @return  The format: the wanted one, else by extension.
  TetFormat add_mesh(std::string_view flag, const std::filesystem::path& path, std::optional<TetFormat> wanted);

 private:
  std::filesystem::path input_;
  struct Added {
    std::filesystem::path path;
    std::string flag;
  };
  std::vector<Added> added_;
};

/// Removes the files that a run has made, unless the run gets to its end.
class NewFiles {
 public:
  NewFiles() = default;
  ~NewFiles();
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;

  /// To be called before `path` is written; a file that stands there already is not ours to remove.
  void expect(const std::filesystem::path& path);
  void expect_all(const std::vector<std::filesystem::path>& paths);
  void keep() { kept_ = true; }

 private:
  std::vector<std::filesystem::path> made_;
  bool kept_ = false;
};

/// Writes to standard output. @throws IoError  if that fails, as on a full disk.
void write_stdout(std::string_view text);

/// Writes a report to a file, atomically, or to standard output where `path` is "-".
void write_report(const std::string& path, std::string_view text);

}  // namespace tetsoup::cli
