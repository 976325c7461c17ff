#include "base/tet_faces.h"

#include <algorithm>
#include <tuple>

#include "base/groups.h"
#include "base/tet_geometry.h"

namespace tetsoup {

Triangle face_at(const TetMesh& mesh, std::uint64_t slot) {
  const Tet& tet = mesh.tets[slot / 4];
  const auto& face = kTetFaces[slot % 4];
  return {tet[static_cast<std::size_t>(face[0])], tet[static_cast<std::size_t>(face[1])],
          tet[static_cast<std::size_t>(face[2])]};
}

bool is_valid_tet(const Tet& tet, std::size_t vertex_count) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (tet[i] >= vertex_count) return false;
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (tet[i] == tet[j]) return false;
    }
  }
  return true;
}

std::vector<TetFace> sorted_faces(const TetMesh& mesh) {
  std::vector<std::uint8_t> is_valid(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) is_valid[t] = is_valid_tet(mesh.tets[t], mesh.vertices.size());
  Groups<TetFace> by_lowest(mesh.vertices.size(), [&](const auto& put) {
    for (std::uint64_t slot = 0; slot < 4 * mesh.tets.size(); ++slot) {
      if (!is_valid[slot / 4]) continue;
      TetFace face{face_at(mesh, slot), slot};
      auto& [a, b, c] = face.corners;
      if (a > b) std::swap(a, b);
      if (b > c) std::swap(b, c);
      if (a > b) std::swap(a, b);
      put(a, face);
    }
  });
  for (std::size_t v = 0; v < by_lowest.size(); ++v) {
    std::sort(by_lowest[v].begin(), by_lowest[v].end(), [](const TetFace& a, const TetFace& b) {
      return std::tie(a.corners[1], a.corners[2], a.slot) < std::tie(b.corners[1], b.corners[2], b.slot);
    });
  }
  return std::move(by_lowest).items();
}

std::size_t face_run_end(const std::vector<TetFace>& faces, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < faces.size() && faces[end].corners == faces[begin].corners) ++end;
  return end;
}

std::vector<std::uint64_t> lone_slots(const std::vector<TetFace>& faces) {
  std::vector<std::uint64_t> slots;
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    end = face_run_end(faces, begin);
    if (end - begin == 1) slots.push_back(faces[begin].slot);
  }
  std::sort(slots.begin(), slots.end());
  return slots;
}

std::vector<Triangle> lone_faces(const TetMesh& mesh, const std::vector<TetFace>& faces) {
  const std::vector<std::uint64_t> slots = lone_slots(faces);
  std::vector<Triangle> triangles;
  triangles.reserve(slots.size());
  for (const std::uint64_t slot : slots) triangles.push_back(face_at(mesh, slot));
  return triangles;
}

}  // namespace tetsoup
