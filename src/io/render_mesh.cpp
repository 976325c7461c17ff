// A render mesh as triangles, its parts, and as a file again.
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/require.h"
#include "base/vec.h"
#include "io/atomic_file.h"
#include "io/file_names.h"
#include "io/number_text.h"
#include "io/obj_text.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {
namespace {

constexpr std::uint32_t kNone = RenderMesh::kNone;

void require_whole(const RenderMesh& mesh) {
  std::size_t corners = 0;
  for (const std::uint32_t size : mesh.face_sizes) corners += size;
  require(corners == mesh.corners.size(), "corners", mesh.corners.size(), "as many as the faces' sizes add up to");
  const auto require_each = [](std::size_t size, std::size_t wanted, const char* what) {
    require(size == 0 || size == wanted, what, size, "none or one for every face or corner");
  };
  require_each(mesh.corner_texcoords.size(), corners, "corner_texcoords");
  require_each(mesh.corner_normals.size(), corners, "corner_normals");
  require_each(mesh.face_parts.size(), mesh.face_sizes.size(), "face_parts");
  for (const std::uint32_t part : mesh.face_parts)
    require(part < mesh.parts.size(), "part of a face", part, "below the number of parts");
}

/// add(triangle, face)
template <class Add>
void cut_into_fans(const RenderMesh& mesh, const Add& add) {
  require_whole(mesh);
  std::size_t first = 0;
  for (std::size_t face = 0; face < mesh.face_sizes.size(); ++face) {
    const std::size_t size = mesh.face_sizes[face];
    for (std::size_t c = 2; c < size; ++c)
      add({mesh.corners[first], mesh.corners[first + c - 1], mesh.corners[first + c]}, face);
    first += size;
  }
}

/// One-based; 0, which no reader takes for an index, where there is none.
void append_index(std::string& text, std::uint32_t index, std::size_t first) {
  append_number(text, index == kNone ? 0 : first + index + 1);
}

void append_changed_names(std::string& text, const RenderMesh::Part& from, const RenderMesh::Part& to) {
  if (from.object != to.object) append_name_line(text, "o", to.object);
  if (from.group != to.group) append_name_line(text, "g", to.group);
  if (from.material != to.material) append_name_line(text, "usemtl", to.material);
}

}  // namespace

void append_name_line(std::string& text, const char* keyword, const std::string& name) {
  text += keyword;
  if (!name.empty()) text += ' ';
  for (const char c : name) text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  text += '\n';
}

void append_obj(std::string& text, const RenderMesh& mesh, const ObjPlace& place) {
  for (const Vec3& vertex : place.vertices) {
    const Vec3d v = placed(vertex, place.origin);
    append_line(text += "v ", v.x, v.y, v.z);
  }
  for (const Vec2& t : mesh.texcoords) append_line(text += "vt ", t.x, t.y);
  for (const Vec3& n : place.normals) append_line(text += "vn ", n.x, n.y, n.z);
  const auto choice = [](const std::vector<std::uint32_t>& choices, std::size_t corner) {
    return choices.empty() ? kNone : choices[corner];
  };
  RenderMesh::Part part{place.object, {}, {}};
  std::size_t corner = 0;
  for (std::size_t face = 0; face < mesh.face_sizes.size(); ++face) {
    if (!mesh.face_parts.empty()) {
      RenderMesh::Part next = mesh.parts[mesh.face_parts[face]];
      if (!place.object.empty()) next.object = place.object + (next.object.empty() ? "" : "." + next.object);
      append_changed_names(text, part, next);
      part = std::move(next);
    }
    text += 'f';
    for (const std::size_t end = corner + mesh.face_sizes[face]; corner < end; ++corner) {
      append_index(text += ' ', mesh.corners[corner], place.first_vertex);
      const std::uint32_t texcoord = choice(mesh.corner_texcoords, corner);
      const std::uint32_t normal = place.normals.empty() ? kNone : choice(mesh.corner_normals, corner);
      if (texcoord != kNone || normal != kNone) text += '/';
      if (texcoord != kNone) append_index(text, texcoord, place.first_texcoord);
      if (normal != kNone) append_index(text += '/', normal, 0);
    }
    text += '\n';
  }
}

RenderMesh render_mesh_of(const TriangleSoup& soup) {
  RenderMesh mesh;
  mesh.vertices = soup.vertices;
  mesh.origin = soup.origin;
  mesh.face_sizes.assign(soup.triangles.size(), 3);
  mesh.corners.reserve(soup.triangles.size() * 3);
  for (const Triangle& t : soup.triangles) mesh.corners.insert(mesh.corners.end(), t.begin(), t.end());
  mesh.parts.emplace_back();
  mesh.face_parts.assign(soup.triangles.size(), 0);
  return mesh;
}

TriangleSoup triangles_of(const RenderMesh& mesh) {
  TriangleSoup soup{mesh.vertices, {}, mesh.origin};
  soup.triangles.reserve(mesh.face_sizes.size());
  cut_into_fans(mesh, [&](const Triangle& triangle, std::size_t) { soup.triangles.push_back(triangle); });
  return soup;
}

std::vector<std::uint32_t> triangle_faces(const RenderMesh& mesh) {
  std::vector<std::uint32_t> faces;
  faces.reserve(mesh.face_sizes.size());
  cut_into_fans(mesh, [&](const Triangle&, std::size_t face) { faces.push_back(static_cast<std::uint32_t>(face)); });
  return faces;
}

std::vector<PartName> part_names(const RenderMesh& mesh) {
  require_whole(mesh);
  std::vector<std::size_t> triangles(mesh.parts.size(), 0);
  for (std::size_t face = 0; face < mesh.face_parts.size(); ++face)
    if (mesh.face_sizes[face] > 2) triangles[mesh.face_parts[face]] += mesh.face_sizes[face] - 2;
  std::vector<PartName> names;
  const auto add_kind = [&](PartKind kind, std::string RenderMesh::Part::*name_of) {
    std::map<std::string_view, std::size_t> known;
    for (std::size_t part = 0; part < mesh.parts.size(); ++part) {
      const std::string& name = mesh.parts[part].*name_of;
      if (name.empty()) continue;
      const auto [place, is_new] = known.try_emplace(name, names.size());
      if (is_new) names.push_back({kind, name, 0});
      names[place->second].triangle_count += triangles[part];
    }
  };
  add_kind(PartKind::Object, &RenderMesh::Part::object);
  add_kind(PartKind::Group, &RenderMesh::Part::group);
  add_kind(PartKind::Material, &RenderMesh::Part::material);
  return names;
}

void write_render_mesh(const std::filesystem::path& path, const RenderMesh& mesh) {
  if (lower_extension(path) != ".obj")
    throw IoError("cannot write '" + path.string() + "': render meshes are written as .obj");
  require_whole(mesh);
  AtomicFile file(path);
  std::string text;
  append_obj(text, mesh, {mesh.vertices, mesh.normals, {}, 0, 0, mesh.origin});
  file.write(text);
  file.commit();
}

RenderMesh triangles_at_points(RenderMesh points, double size) {
  require(points.face_sizes.empty(), "faces", points.face_sizes.size(), "none, where points are to be triangles");
  require(size > 0 && std::isfinite(size), "size of a point", size, "above 0 and finite");
  RenderMesh mesh;
  mesh.origin = points.origin;
  mesh.vertices = std::move(points.vertices);
  mesh.parts = points.parts.empty() ? std::vector<RenderMesh::Part>(1) : std::move(points.parts);
  const double step = size / (3 * std::numbers::sqrt2);  // (2, -1, -1) and its turns are three roots of two apart.
  const std::size_t count = mesh.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d at = to_double(mesh.vertices[i]);
    if (!is_finite(mesh.vertices[i])) continue;
    for (const Vec3d& way : {Vec3d{2, -1, -1}, Vec3d{-1, 2, -1}, Vec3d{-1, -1, 2}}) {
      mesh.corners.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back(to_float(at + way * step));
    }
    mesh.face_sizes.push_back(3);
    mesh.face_parts.push_back(0);
  }
  return mesh;
}

}  // namespace tetsoup
