#include "lattice/piece_graph.h"

#include <algorithm>
#include <cmath>

#include "base/tet_faces.h"
#include "base/whole.h"

namespace tetsoup {
namespace {

constexpr double kSpacing = 0.7;  ///< Voxels between the points of a face: hardly a voxel in the face is missed.

/// Visits the voxels of points spread over a triangle, n to a side, until `visit` says stop.
template <class Visit>
bool visit_voxels(const std::array<Vec3d, 3>& p, int n, const Visit& visit) {
  const Vec3d origin = p[0] + Vec3d{0.5, 0.5, 0.5}, u = (p[1] - p[0]) * (1.0 / n), v = (p[2] - p[0]) * (1.0 / n);
  constexpr double kThird = 1.0 / 3;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const Vec3d at = origin + u * (i + kThird) + v * (j + kThird);
      if (!visit(floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z))) return false;
    }
  }
  return true;
}

/// What touches through one face.
class FaceContacts {
 public:
  FaceContacts(const TetMesh& mesh, const TetPieces& pieces, const BitGrid& inside, std::vector<Contact>& out)
      : mesh_(mesh), pieces_(pieces), inside_(inside), out_(out) {}

  void find(const SharedFace& face) {
    if (pieces_.count(face.a) == 0 || pieces_.count(face.b) == 0) return;
    const GridFrame& grid = inside_.frame;
    std::array<Vec3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = (to_double(mesh_.vertices[face.corners[i]]) - grid.origin) * (1 / grid.voxel_size);
    const double longest = std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
    const int n = 1 + static_cast<int>(longest / kSpacing);
    const bool is_plain = pieces_.count(face.a) == 1 && pieces_.count(face.b) == 1;
    const std::size_t begin = out_.size();
    std::array<int, 3> last{-1, -1, -1};
    const auto visit = [&](int x, int y, int z) {
      if (last == std::array{x, y, z}) return true;
      last = {x, y, z};
      if (!grid.contains(x, y, z) || !inside_.test(x, y, z)) return true;
      add({pieces_.piece_at(face.a, x, y, z), pieces_.piece_at(face.b, x, y, z), 1}, begin);
      return !is_plain;
    };
    // Most faces between single pieces are in the midst of them: a few points tell.
    if (is_plain && !visit_voxels(p, 2, visit)) return;
    visit_voxels(p, n, visit);
  }

 private:
  void add(const Contact& contact, std::size_t begin) {
    if (contact.a == TetPieces::kNone || contact.b == TetPieces::kNone) return;
    for (std::size_t i = begin; i < out_.size(); ++i) {
      if (out_[i].a != contact.a || out_[i].b != contact.b) continue;
      ++out_[i].samples;
      return;
    }
    out_.push_back(contact);
  }

  const TetMesh& mesh_;
  const TetPieces& pieces_;
  const BitGrid& inside_;
  std::vector<Contact>& out_;
};

}  // namespace

std::vector<SharedFace> shared_faces(const TetMesh& mesh) {
  const std::vector<TetFace> faces = sorted_faces(mesh);
  std::vector<SharedFace> shared;
  shared.reserve(faces.size() / 2);
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    end = face_run_end(faces, begin);
    if (end - begin != 2) continue;
    shared.push_back({faces[begin].corners, static_cast<std::uint32_t>(faces[begin].slot / 4),
                      static_cast<std::uint32_t>(faces[begin + 1].slot / 4)});
  }
  return shared;
}

PieceGraph::PieceGraph(const TetMesh& mesh, const std::vector<SharedFace>& faces, const TetPieces& pieces,
                       const BitGrid& inside, StageWatch& watch)
    : faces_(faces) {
  constexpr std::int64_t kGrain = 256;  // faces
  const auto count = static_cast<std::int64_t>(faces_.size());
  struct Chunk {
    std::vector<Contact> contacts;
    std::vector<std::size_t> ends;
  };
  std::vector<Chunk> chunks(static_cast<std::size_t>(chunk_count(count, kGrain)));
  parallel_for(count, kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    Chunk& chunk = chunks[static_cast<std::size_t>(begin / kGrain)];
    FaceContacts finder(mesh, pieces, inside, chunk.contacts);
    for (auto f = static_cast<std::size_t>(begin); f < static_cast<std::size_t>(end); ++f) {
      finder.find(faces_[f]);
      chunk.ends.push_back(chunk.contacts.size());
    }
  });
  contacts_begin_.assign(1, 0);
  for (const Chunk& chunk : chunks) {
    const std::size_t before = contacts_.size();
    contacts_.insert(contacts_.end(), chunk.contacts.begin(), chunk.contacts.end());
    for (const std::size_t end : chunk.ends) contacts_begin_.push_back(before + end);
  }
  neighbours_ = Groups<std::uint32_t>(pieces.size(), [&](const auto& put) {
    for (const Contact& c : contacts_) {
      put(c.a, c.b);
      put(c.b, c.a);
    }
  });
}

}  // namespace tetsoup
