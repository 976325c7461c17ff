// Names of the formats, and tet meshes into files.
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <vector>

#include "base/require.h"
#include "io/atomic_file.h"
#include "io/file_names.h"
#include "io/tet_writers.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

void require_valid_indices(const TetMesh& mesh) {
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t vertex : tet)
      require(vertex < mesh.vertices.size(), "vertex of a tet", vertex, "below the number of vertices");
}

std::vector<fs::path> write_one(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
  return {path};
}

std::vector<fs::path> write_tetgen(const fs::path& path, const TetMesh& mesh) {
  const TetgenPair pair = tetgen_pair(path);
  std::array<AtomicFile, 2> files{AtomicFile(pair.nodes), AtomicFile(pair.tets)};
  files[0].write(tetgen_node_text(mesh));
  files[1].write(tetgen_ele_text(mesh));
  AtomicFile::commit_together(files);
  return {pair.nodes, pair.tets};
}

}  // namespace

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

TetgenPair tetgen_pair(const fs::path& path) {
  const std::string extension = lower_extension(path);
  const fs::path stem = extension == ".node" || extension == ".ele" ? fs::path(path).replace_extension() : path;
  TetgenPair pair{stem, stem};
  pair.nodes += ".node";
  pair.tets += ".ele";
  if (extension == ".node") pair.nodes = path;
  if (extension == ".ele") pair.tets = path;
  return pair;
}

std::string known_tet_extensions() {
  return ".msh, .vtk, .vtu, .mesh, .node, .ele";
}

const std::vector<TetFormatInfo>& tet_formats() {
  static const std::vector<TetFormatInfo> formats{
      {TetFormat::Msh41, "msh", "Gmsh MSH 4.1 (.msh)", ".msh"},
      {TetFormat::Msh22, "msh22", "Gmsh MSH 2.2 (.msh)", ".msh"},
      {TetFormat::Vtk, "vtk", "Legacy VTK 3.0 (.vtk)", ".vtk"},
      {TetFormat::Vtu, "vtu", "VTK XML, for ParaView (.vtu)", ".vtu"},
      {TetFormat::Medit, "mesh", "MEDIT, as fTetWild and mmg use it (.mesh)", ".mesh"},
      {TetFormat::Tetgen, "tetgen", "TetGen, two files (.node and .ele)", ".node"},
      {TetFormat::Surface, "surface", "Boundary triangles only (.obj, .stl, .ply)", ".obj"},
  };
  return formats;
}

TetFormat tet_format_of(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".ele") return TetFormat::Tetgen;
  if (extension == ".stl" || extension == ".ply") return TetFormat::Surface;
  for (const TetFormatInfo& info : tet_formats())
    if (extension == info.extension) return info.format;
  throw IoError("cannot tell the format of '" + path.string() + "' from its extension; known are " +
                known_tet_extensions() + ", .obj, .stl, .ply");
}

std::vector<fs::path> write_tets(const fs::path& path, const TetMesh& mesh, std::optional<TetFormat> format) {
  require_valid_indices(mesh);
  switch (format ? *format : tet_format_of(path)) {
    case TetFormat::Msh41:
      return write_one(path, msh41_text(mesh));
    case TetFormat::Msh22:
      return write_one(path, msh22_text(mesh));
    case TetFormat::Vtk:
      return write_one(path, vtk_text(mesh));
    case TetFormat::Vtu:
      return write_one(path, vtu_text(mesh));
    case TetFormat::Medit:
      return write_one(path, medit_text(mesh));
    case TetFormat::Tetgen:
      return write_tetgen(path, mesh);
    case TetFormat::Surface:
      write_surface(path, mesh.vertices, boundary_triangles(mesh));
      return {path};
  }
  return {};
}

}  // namespace tetsoup
