// Triangles as OBJ, binary STL or binary PLY.
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/origin.h"
#include "base/require.h"
#include "base/vec.h"
#include "io/atomic_file.h"
#include "io/file_names.h"
#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "io/tet_writers.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace {

constexpr std::size_t kStlHeaderBytes = 80;

// The vertices that triangles use, in their order.
TriangleSoup used_part(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3d& origin) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renamed(vertices.size(), kUnused);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle) {
      require(vertex < vertices.size(), "vertex of a triangle", vertex, "below the number of vertices");
      renamed[vertex] = 0;
    }
  TriangleSoup part{{}, {}, origin};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (renamed[i] == kUnused) continue;
    renamed[i] = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.push_back(vertices[i]);
  }
  part.triangles.reserve(triangles.size());
  for (const Triangle& t : triangles) part.triangles.push_back({renamed[t[0]], renamed[t[1]], renamed[t[2]]});
  return part;
}

std::string obj_text(const TriangleSoup& soup) {
  std::string text;
  for (const Vec3d& v : placed_points(soup.vertices, soup.origin)) append_line(text += "v ", v.x, v.y, v.z);
  for (const Triangle& t : soup.triangles) append_line(text += "f ", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

template <class Point>
void append_point(std::string& bytes, const Point& point) {
  for (const auto coordinate : {point.x, point.y, point.z}) append_raw(bytes, coordinate);
}

// Zero for triangles without area, as STL readers expect.
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3d normal = cross(to_double(b) - to_double(a), to_double(c) - to_double(a));
  const double size = length(normal);
  return size > 0 && std::isfinite(size) ? to_float(normal * (1 / size)) : Vec3{};
}

std::string stl_bytes(const TriangleSoup& soup) {
  std::string bytes = "binary STL";  // Not "solid", which would pass for the text format.
  bytes.resize(kStlHeaderBytes, ' ');
  append_raw(bytes, static_cast<std::uint32_t>(soup.triangles.size()));
  for (const Triangle& t : soup.triangles) {
    const Vec3 &a = soup.vertices[t[0]], &b = soup.vertices[t[1]], &c = soup.vertices[t[2]];
    append_point(bytes, unit_normal(a, b, c));
    for (const Vec3& corner : {a, b, c}) append_point(bytes, to_float(placed(corner, soup.origin)));
    append_raw(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// Doubles where floats are too coarse.
std::string ply_bytes(const TriangleSoup& soup) {
  const bool far = !(soup.origin == Vec3d{});
  const std::string type = far ? "double" : "float";
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  append_number(bytes, soup.vertices.size());
  for (const char* axis : {"x", "y", "z"}) bytes += "\nproperty " + type + ' ' + axis;
  bytes += "\nelement face ";
  append_number(bytes, soup.triangles.size());
  bytes += "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& v : soup.vertices) far ? append_point(bytes, placed(v, soup.origin)) : append_point(bytes, v);
  for (const Triangle& t : soup.triangles) {
    append_raw(bytes, std::uint8_t{3});
    for (const std::uint32_t vertex : t) append_raw(bytes, static_cast<std::int32_t>(vertex));
  }
  return bytes;
}

std::string surface_bytes(SurfaceFormat format, const TriangleSoup& soup) {
  switch (format) {
    case SurfaceFormat::Obj:
      return obj_text(soup);
    case SurfaceFormat::StlBinary:
      return stl_bytes(soup);
    case SurfaceFormat::Ply:
      return ply_bytes(soup);
  }
  return {};
}

}  // namespace

SurfaceFormat surface_format_of(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".obj") return SurfaceFormat::Obj;
  if (extension == ".stl") return SurfaceFormat::StlBinary;
  if (extension == ".ply") return SurfaceFormat::Ply;
  throw IoError("cannot tell the surface format of '" + path.string() +
                "' from its extension; known are .obj, .stl, .ply");
}

void write_surface(const std::filesystem::path& path, std::span<const Vec3> vertices,
                   std::span<const Triangle> triangles, const Vec3d& origin) {
  const std::string bytes = surface_bytes(surface_format_of(path), used_part(vertices, triangles, origin));
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace tetsoup
