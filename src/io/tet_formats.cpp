// Names of the formats, and which a path asks for.
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "base/listing.h"
#include "io/file_names.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

TetgenSet tetgen_set(const fs::path& path) {
  const std::string extension = lower_extension(path);
  const bool is_named = extension == ".node" || extension == ".ele" || extension == ".face";
  const fs::path stem = is_named ? fs::path(path).replace_extension() : path;
  TetgenSet set{stem, stem, stem};
  set.nodes += ".node";
  set.tets += ".ele";
  set.faces += ".face";
  if (extension == ".node") set.nodes = path;
  if (extension == ".ele") set.tets = path;
  if (extension == ".face") set.faces = path;
  return set;
}

std::string readable_tet_extensions() {
  return ".msh, .vtk, .vtu, .mesh, .npz, .node, .ele";
}

const std::vector<TetFormatInfo>& tet_formats() {
  static const std::vector<TetFormatInfo> formats{
      {TetFormat::Msh41, "msh", "Gmsh MSH 4.1 (.msh)", ".msh"},
      {TetFormat::Msh22, "msh22", "Gmsh MSH 2.2 (.msh)", ".msh"},
      {TetFormat::Vtk, "vtk", "Legacy VTK 3.0 (.vtk)", ".vtk"},
      {TetFormat::Vtu, "vtu", "VTK XML, for ParaView (.vtu)", ".vtu"},
      {TetFormat::Medit, "mesh", "MEDIT, as fTetWild and mmg use it (.mesh)", ".mesh"},
      {TetFormat::Tetgen, "tetgen", "TetGen, three files (.node, .ele and .face)", ".node"},
      {TetFormat::IsaacGym, "tet", "Isaac Gym (.tet)", ".tet"},
      {TetFormat::Vega, "veg", "Vega FEM (.veg; pins in .bou)", ".veg"},
      {TetFormat::Abaqus, "inp", "Abaqus and CalculiX (.inp)", ".inp"},
      {TetFormat::Netgen, "vol", "Netgen (.vol)", ".vol"},
      {TetFormat::Npz, "npz", "NumPy arrays (.npz)", ".npz"},
      {TetFormat::Json, "json", "JSON of flat arrays (.json)", ".json"},
      {TetFormat::Usd, "usd", "OpenUSD text (.usda)", ".usda"},
      {TetFormat::ObjTets, "objtets", "OBJ, a four-cornered face a tet (.obj)", ".obj"},
      {TetFormat::Surface, "surface", "Boundary triangles only (.obj, .stl, .ply)", ".obj"},
  };
  return formats;
}

bool takes_midsides(TetFormat format) {
  return format == TetFormat::Msh41 || format == TetFormat::Msh22 || format == TetFormat::Vtk ||
         format == TetFormat::Vtu || format == TetFormat::Abaqus;
}

TetFormat tet_format_named(std::string_view name) {
  for (const TetFormatInfo& info : tet_formats())
    if (info.name == name) return info.format;
  const std::string known = listing(
      tet_formats(), [](const TetFormatInfo& info) -> const auto& { return info.name; });
  throw InvalidInput("format = '" + std::string(name) + "', must be one of " + known);
}

TetFormat tet_format_of(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".ele" || extension == ".face") return TetFormat::Tetgen;
  if (extension == ".obj" || extension == ".stl" || extension == ".ply") return TetFormat::Surface;
  std::string known;
  for (const TetFormatInfo& info : tet_formats()) {
    if (extension == info.extension) return info.format;
    if (known.find(info.extension + ',') == known.npos) known += info.extension + ", ";
  }
  throw IoError("cannot tell the format of '" + path.string() + "' from its extension; known are " + known +
                ".stl, .ply");
}

}  // namespace tetsoup
