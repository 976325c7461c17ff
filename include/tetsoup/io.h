// tetsoup::io: files in and out. Everything throws IoError with the file's name and the line, byte or system reason.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/distance.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/render_mesh.h"
#include "tetsoup/tet_model.h"
#include "tetsoup/types.h"

namespace tetsoup {

// --- Triangle soups -------------------------------------------------------------------------------------------------

enum class SoupFormat { Obj, Stl, Ply, Off, Gltf, ThreeMf, Collada };

/// Reads a soup; the format is told from the content where that is certain, else from the extension (.obj .stl .ply
/// .off .gltf .glb). Polygons are cut into fans; NaN and wild indices are passed on, since clean_soup() counts them.
/// Memory stays within a small multiple of the file's size whatever its header claims.
/// @throws IoError  if the file cannot be read or is not what it says; the text names the line or the byte offset.
TriangleSoup read_soup(const std::filesystem::path& path);

/// The same file with polygons, texture coordinates, normals and names; triangles_of() it is what read_soup() gives,
/// bit for bit, so an embedding of that refers to these vertices. OBJ has all of it (several groups are one name with
/// blanks between), glTF triangles whose object is the node's name or else the mesh's, PLY texture coordinates and
/// normals, STL the solids' names. Texture coordinates and normals that cannot be read are left out.
/// @throws IoError  as read_soup() does, or if the names, repeated for every part, took far more than the file.
RenderMesh read_render_mesh(const std::filesystem::path& path);

/// Triangles without names; triangles_of() gives the soup again.
RenderMesh render_mesh_of(const TriangleSoup& soup);
/// Its faces cut into fans, as read_soup() does.
TriangleSoup triangles_of(const RenderMesh& mesh);
/// The face of every triangle of triangles_of().
std::vector<std::uint32_t> triangle_faces(const RenderMesh& mesh);

/// Every point of a surface without faces as an equilateral triangle around it, across (1, 1, 1), with edges of that
/// length: the method takes any triangles, and a cloud of points about as far apart encloses what it outlines. The
/// points stay the first vertices, each triangle has three of its own behind them; points that are not finite have
/// none.
/// @throws InvalidInput  if there are faces, or the size is not above 0 and finite.
RenderMesh triangles_at_points(RenderMesh points, double size);

enum class PartKind { Object, Group, Material };
struct PartName {
  PartKind kind = PartKind::Object;
  std::string name;
  std::size_t triangle_count = 0;
};
/// The names that faces have: objects, groups, materials, each in the order of the file. One name may be of two kinds.
std::vector<PartName> part_names(const RenderMesh& mesh);

/// Writes polygons, texture coordinates, normals and names as OBJ; read_render_mesh() of it gives the mesh again, but
/// for blanks in names. With other vertices it is the same surface deformed. Atomic.
/// @throws InvalidInput  if sizes do not fit together; IoError, also if the extension is not .obj.
void write_render_mesh(const std::filesystem::path& path, const RenderMesh& mesh);

/// The same from memory; `name` stands for the path in errors. External buffers of a .gltf are not followed.
TriangleSoup parse_soup(std::span<const std::byte> bytes, SoupFormat format, std::string_view name);
RenderMesh parse_render_mesh(std::span<const std::byte> bytes, SoupFormat format, std::string_view name);
/// The same with the format told as read_soup() tells it, the extension being that of the name.
RenderMesh parse_render_mesh(std::span<const std::byte> bytes, std::string_view name);

/// A soup or a mesh with its origin taken into the coordinates, as nearly as floats can hold them: for interfaces that
/// know no origin.
template <class Mesh>
Mesh at_its_place(Mesh mesh) {
  for (Vec3& v : mesh.vertices) {
    const Vec3d p = placed(v, mesh.origin);
    v = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  mesh.origin = {};
  return mesh;
}

enum class SurfaceFormat { Obj, StlBinary, Ply };

/// Writes triangles by extension: .obj, .stl (binary), .ply (binary little endian). Vertices no triangle uses are left
/// out.
/// @param origin  That the vertices are counted from; PLY then holds doubles, STL the nearest floats.
void write_surface(const std::filesystem::path& path, std::span<const Vec3> vertices,
                   std::span<const Triangle> triangles, const Vec3d& origin = {});

// --- Tet meshes -----------------------------------------------------------------------------------------------------

enum class TetFormat {
  Msh41,     ///< Gmsh MSH 4.1 ASCII, one node block, one element block, sequential tags from 1.
  Msh22,     ///< Gmsh MSH 2.2 ASCII.
  Vtk,       ///< Legacy VTK 3.0 ASCII, one point a line.
  Vtu,       ///< VTK XML, inline base64.
  Medit,     ///< .mesh
  Tetgen,    ///< .node, .ele and .face side by side, 0-based; the path may name any or have no extension.
  IsaacGym,  ///< .tet: lines `v x y z`, then `t a b c d`.
  Vega,      ///< .veg
  Abaqus,    ///< .inp: *NODE, *ELEMENT, TYPE=C3D4.
  Netgen,    ///< .vol, whose tets are negative.
  Npz,       ///< NumPy arrays: vertices, tet_indices.
  Json,      ///< vertices, edges, tets, surface triangles.
  Usd,       ///< .usda: UsdGeomTetMesh, with the render mesh and its embedding.
  ObjTets,   ///< .obj with one four-cornered face a tet, as Blender's users have it.
  Surface    ///< Boundary triangles only: .obj, .stl, .ply.
};

/// Names and extensions of the formats, for help texts: {"msh", "Gmsh MSH 4.1 (.msh)", Msh41} ...
struct TetFormatInfo {
  TetFormat format;
  std::string name;       ///< As `--format` takes it.
  std::string summary;    ///< One line.
  std::string extension;  ///< With the dot.
};
const std::vector<TetFormatInfo>& tet_formats();

/// Whether the format has a place for tets of ten nodes (Midsides).
bool takes_midsides(TetFormat format);

/// @throws InvalidInput  listing them, if there is none of that name.
TetFormat tet_format_named(std::string_view name);

/// Format by extension: .msh is 4.1, .obj the boundary; throws IoError listing the known extensions.
TetFormat tet_format_of(const std::filesystem::path& path);

/// All files that write_tets() may write: three of TetGen's, Vega's list of pins beside its mesh.
std::vector<std::filesystem::path> tet_files(const std::filesystem::path& path, TetFormat format);

/// How much of a calibrated model (calibrate.h) a file holds.
enum class CalibrationForm {
  PerTet,     ///< Every tet's stiffness and density.
  Steps,      ///< Up to eight materials a region, by steps of the logarithm of stiffness.
  OneFactor,  ///< One material a region or for all: the one factor of stiffness, and the mean density.
  None        ///< No material at all.
};
CalibrationForm calibration_of(TetFormat format);

/// Writes a mesh; format by extension unless given. Atomic: the file (or files) appear whole or not at all, and an
/// existing one stays as it was if anything fails.
/// @return  The files written.
std::vector<std::filesystem::path> write_tets(const std::filesystem::path& path, const TetMesh& mesh,
                                              std::optional<TetFormat> format = {});

/// The same with regions, pins, material, render mesh and embedding, as far as the format has a place for them.
std::vector<std::filesystem::path> write_tets(const std::filesystem::path& path, const TetModel& model,
                                              std::optional<TetFormat> format = {});

/// Writes an embedding by extension: .npz (arrays `tets` (N) int32, `weights` (N, 4) and `distances` (N) float32) or
/// .embedding (docs/FORMATS.md has its layout). Atomic.
void write_embedding(const std::filesystem::path& path, const Embedding& embedding);
/// Reads either back, told from its first bytes; the report counts what the distances tell.
/// @throws IoError  if the file is not what it says: arrays that are missing, cut short, or not of as many points.
Embedding read_embedding(const std::filesystem::path& path);
/// The same from memory; `name` stands for the path in errors.
Embedding parse_embedding(std::span<const std::byte> bytes, std::string_view name);

/// Reads a tet mesh: MSH, VTK, VTU, MEDIT, TetGen or NPZ; other cells are skipped.
TetMesh read_tets(const std::filesystem::path& path);

/// True if the path names, by extension and first bytes, a file of tets, which read_tets() takes, or refuses with the
/// reason, rather than read_soup().
bool is_tet_file(const std::filesystem::path& path);

// --- Fields and pictures --------------------------------------------------------------------------------------------

/// Writes distance, votes and inside (signed distance too) as VTK ImageData .vti with raw appended data. Atomic.
void write_field(const std::filesystem::path& path, const DistanceField& field, const PseudoVolume& volume);

/// Replaces `path` by `bytes`, whole or not at all; an existing file stays as it was if anything fails.
void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// What a preview shows; all four panels in one picture.
struct PreviewScene {
  const TriangleSoup* soup = nullptr;    ///< As read.
  const PseudoVolume* volume = nullptr;  ///< Votes are shown in a slice.
  const TetMesh* lattice = nullptr;      ///< Before smoothing, with a cutaway.
  const TetMesh* mesh = nullptr;         ///< Final.
  std::string title;                     ///< One line on top.
  std::array<std::string, 4> captions;   ///< One line under each panel.
  std::optional<UpAxis> up = {};         ///< Y or Z where it is known; else the soup tells on which side it stands.
};

/// Draws the four panels with a software rasteriser into a PNG of the given width. Atomic. Same bytes for the same
/// scene.
void write_preview(const std::filesystem::path& path, const PreviewScene& scene, int width = 1600);

// --- The machine ----------------------------------------------------------------------------------------------------

/// Bytes that a run may take without driving the machine into swap or the kernel into killing it: what is free now, for
/// the machine and for the control group this process runs in, less a margin; nothing where the system does not say.
std::optional<std::size_t> usable_memory();

}  // namespace tetsoup
