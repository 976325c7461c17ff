// Which reader takes a file: by content where that is certain, else by extension.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "io/file_names.h"
#include "io/soup_readers.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {
namespace readers {

void fail(std::string_view name, const std::string& what) {
  throw IoError(std::string(name) + ": " + what);
}
void fail_at_line(std::string_view name, std::size_t line, const std::string& what) {
  throw IoError(std::string(name) + ", line " + std::to_string(line) + ": " + what);
}
void fail_at_byte(std::string_view name, std::size_t byte, const std::string& what) {
  throw IoError(std::string(name) + ", byte " + std::to_string(byte) + ": " + what);
}

std::vector<std::byte> read_whole_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  const auto fail_for_reason = [&](int reason) { fail(name, std::generic_category().message(reason)); };
  std::error_code ignored;
  if (std::filesystem::is_character_file(path, ignored)) fail(name, "is a device, not a file");
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), &std::fclose);
  if (!file) fail_for_reason(errno);

  // The size is only a hint: pipes have none, and a file may grow meanwhile.
  constexpr std::size_t kSmallest = 1 << 16;
  const std::uintmax_t hint = std::filesystem::file_size(path, ignored);
  std::vector<std::byte> bytes(ignored ? kSmallest
                                       : std::max<std::size_t>(kSmallest, static_cast<std::size_t>(hint) + 1));
  std::size_t used = 0;
  while (const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get())) {
    used += got;
    if (used == bytes.size()) bytes.resize(2 * used);
  }
  if (std::ferror(file.get())) fail_for_reason(errno);
  if (used == 0) fail(name, "is empty");
  bytes.resize(used);
  return bytes;
}

namespace {

constexpr const char* kKnownExtensions = "known: .obj .stl .ply .off .gltf .glb .3mf .dae";

bool starts_with(std::span<const std::byte> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

std::optional<SoupFormat> format_of_content(std::span<const std::byte> bytes) {
  if (starts_with(bytes, "ply\n") || starts_with(bytes, "ply\r")) return SoupFormat::Ply;
  if (starts_with(bytes, "glTF")) return SoupFormat::Gltf;
  if (starts_with(bytes, "PK\x03\x04")) return SoupFormat::ThreeMf;
  if (is_collada(bytes)) return SoupFormat::Collada;
  if (is_off(bytes)) return SoupFormat::Off;
  if (is_stl(bytes)) return SoupFormat::Stl;
  return {};
}

std::optional<SoupFormat> format_of_extension(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".obj") return SoupFormat::Obj;
  if (extension == ".stl") return SoupFormat::Stl;
  if (extension == ".ply") return SoupFormat::Ply;
  if (extension == ".off") return SoupFormat::Off;
  if (extension == ".3mf") return SoupFormat::ThreeMf;
  if (extension == ".dae") return SoupFormat::Collada;
  if (extension == ".gltf" || extension == ".glb") return SoupFormat::Gltf;
  return {};
}

template <class Sink>
auto parse(const Source& source, SoupFormat format, const std::optional<std::filesystem::path>& folder, Sink sink) {
  if (source.bytes.empty()) fail(source.name, "is empty");
  switch (format) {
    case SoupFormat::Obj:
      read_obj(source, sink);
      break;
    case SoupFormat::Stl:
      read_stl(source, sink);
      break;
    case SoupFormat::Ply:
      read_ply(source, sink);
      break;
    case SoupFormat::Off:
      read_off(source, sink);
      break;
    case SoupFormat::Gltf:
      read_gltf(source, folder, sink);
      break;
    case SoupFormat::ThreeMf:
      read_3mf(source, sink);
      break;
    case SoupFormat::Collada:
      read_collada(source, sink);
      break;
  }
  if (sink.vertex_count() >= kNoVertex) fail(source.name, "more vertices than 32-bit indices can name");
  return sink.take();
}

/// What people have that is not read, and how to get from there to what is.
struct WayOut {
  std::vector<std::string_view> extensions;
  const char* says;
};

/// Null: nobody knows.
const char* way_out(std::string_view extension) {
  static const std::array<WayOut, 4> ways = {{
      {{".step", ".stp", ".iges", ".igs", ".brep"},
       "holds curved CAD surfaces, not triangles: export it as STL or 3MF, for instance from FreeCAD (File, Export), "
       "or "
       "`gmsh FILE -2 -format stl -o part.stl`"},
      {{".usd", ".usda", ".usdc", ".usdz"},
       "is USD, of which no surface is read: export as .glb or .obj, for instance from Blender; in Python, usd-core's "
       "UsdGeom.Mesh has points and face indices for tetsoup.mesh()"},
      {{".fbx", ".blend", ".3ds", ".lwo", ".x3d", ".wrl", ".abc"},
       "is not read: open it in Blender and export as .glb or .obj"},
      {{".splat", ".spz", ".ksplat", ".pcd", ".las", ".laz", ".xyz", ".e57"},
       "holds points, not triangles: make a surface of them first, for instance by Poisson reconstruction in MeshLab "
       "or Open3D, or save them as .ply and have each taken as a triangle (--point-size)"},
  }};
  for (const WayOut& way : ways)
    if (std::find(way.extensions.begin(), way.extensions.end(), extension) != way.extensions.end()) return way.says;
  return nullptr;
}

SoupFormat format_of(const std::filesystem::path& path, const Source& source) {
  if (const auto format = format_of_content(source.bytes)) return *format;
  if (const auto format = format_of_extension(path)) return *format;
  if (starts_with(source.bytes, "ISO-10303-21")) fail(source.name, way_out(".step"));
  if (const char* const says = way_out(lower_extension(path))) fail(source.name, says);
  const std::string extension = path.extension().string();
  fail(source.name, (extension.empty() ? std::string("no extension") : "unknown extension '" + extension + "'") +
                        " and unknown content; " + kKnownExtensions);
}

}  // namespace
}  // namespace readers

using readers::MeshSink, readers::Source, readers::SoupSink;

TriangleSoup parse_soup(std::span<const std::byte> bytes, SoupFormat format, std::string_view name) {
  return readers::parse({bytes, name}, format, {}, SoupSink());
}

RenderMesh parse_render_mesh(std::span<const std::byte> bytes, SoupFormat format, std::string_view name) {
  return readers::parse({bytes, name}, format, {}, MeshSink(name, bytes.size()));
}

RenderMesh parse_render_mesh(std::span<const std::byte> bytes, std::string_view name) {
  const Source source{bytes, name};
  if (bytes.empty()) readers::fail(name, "is empty");
  return readers::parse(source, readers::format_of(name, source), {}, MeshSink(name, bytes.size()));
}

TriangleSoup read_soup(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = readers::read_whole_file(path);
  const std::string name = path.string();
  const Source source{bytes, name};
  return readers::parse(source, readers::format_of(path, source), path.parent_path(), SoupSink());
}

RenderMesh read_render_mesh(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = readers::read_whole_file(path);
  const std::string name = path.string();
  const Source source{bytes, name};
  return readers::parse(source, readers::format_of(path, source), path.parent_path(), MeshSink(name, bytes.size()));
}

}  // namespace tetsoup
