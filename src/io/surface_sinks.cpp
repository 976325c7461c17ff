#include "io/surface_sinks.h"

#include <algorithm>

#include "base/origin.h"
#include "io/soup_readers.h"

namespace tetsoup::readers {
namespace {

constexpr std::uint32_t kNone = RenderMesh::kNone;

void take_of_vertices(std::vector<std::uint32_t>& choices, const std::vector<std::uint32_t>& corners,
                      std::size_t first_corner, std::size_t first_vertex, std::size_t count, std::size_t first) {
  choices.resize(corners.size(), kNone);
  for (std::size_t i = first_corner; i < corners.size(); ++i) {
    const std::size_t vertex = corners[i];
    if (vertex >= first_vertex && vertex - first_vertex < count)
      choices[i] = vertex_index(static_cast<std::int64_t>(vertex - first_vertex + first));
  }
}

void drop_wild_choices(std::vector<std::uint32_t>& choices, std::size_t corner_count, std::size_t choice_count) {
  if (choices.empty()) return;
  choices.resize(corner_count, kNone);
  bool any = false;
  for (std::uint32_t& choice : choices) {
    if (choice >= choice_count) choice = kNone;
    any = any || choice != kNone;
  }
  if (!any) choices.clear();
}

}  // namespace

TriangleSoup SoupSink::take() {
  soup_.origin = origin_of(points_, flat(std::span<const Triangle>(soup_.triangles)));
  soup_.vertices = counted_from(soup_.origin, points_);
  return std::move(soup_);
}

void MeshSink::Polygon::finish() {
  RenderMesh& mesh = sink_.mesh_;
  const std::size_t size = mesh.corners.size() - first_;
  if (size >= 3) {
    sink_.add_face(static_cast<std::uint32_t>(size));
    return;
  }
  mesh.corners.resize(first_);
  for (auto* choices : {&mesh.corner_texcoords, &mesh.corner_normals})
    choices->resize(std::min(choices->size(), first_));
}

void MeshSink::reserve_faces(std::size_t added) {
  mesh_.face_sizes.reserve(face_count() + added);
  mesh_.face_parts.reserve(face_count() + added);
}

void MeshSink::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  for (const std::uint32_t corner : {a, b, c}) mesh_.corners.push_back(corner);
  add_face(3);
}

void MeshSink::take_vertex_texcoords(std::size_t first_corner, std::size_t first_vertex, std::size_t count,
                                     std::size_t first_texcoord) {
  take_of_vertices(mesh_.corner_texcoords, mesh_.corners, first_corner, first_vertex, count, first_texcoord);
}

void MeshSink::take_vertex_normals(std::size_t first_corner, std::size_t first_vertex, std::size_t count,
                                   std::size_t first_normal) {
  take_of_vertices(mesh_.corner_normals, mesh_.corners, first_corner, first_vertex, count, first_normal);
}

void MeshSink::find_part() {
  constexpr std::size_t kFreeNameBytes = 1 << 16, kNameBytesPerByte = 16;  // a name before a thousand groups is rare
  const auto next = static_cast<std::uint32_t>(mesh_.parts.size());
  const auto& [object, group, material] = next_part_;
  const auto [known, is_new] = part_of_names_.try_emplace({object, group, material}, next);
  part_ = known->second;
  part_known_ = true;
  if (!is_new) return;
  name_bytes_ += object.size() + group.size() + material.size();
  if (name_bytes_ > kFreeNameBytes + kNameBytesPerByte * file_bytes_)
    fail(file_name_, "the names of its objects, groups and materials, face by face, are far longer than the file");
  mesh_.parts.push_back(next_part_);
}

RenderMesh MeshSink::take() {
  mesh_.origin = origin_of(points_, mesh_.corners);
  mesh_.vertices = counted_from(mesh_.origin, points_);
  drop_wild_choices(mesh_.corner_texcoords, mesh_.corners.size(), mesh_.texcoords.size());
  drop_wild_choices(mesh_.corner_normals, mesh_.corners.size(), mesh_.normals.size());
  return std::move(mesh_);
}

}  // namespace tetsoup::readers
