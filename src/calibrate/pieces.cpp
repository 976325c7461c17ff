#include "calibrate/pieces.h"

#include <limits>

#include "base/tet_geometry.h"
#include "base/unions.h"

namespace tetsoup {

std::vector<Piece> split_pieces(const ElasticMesh& whole) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  const TetMesh& mesh = *whole.mesh;
  Unions joined(mesh.vertices.size());
  for (const Tet& tet : mesh.tets)
    for (std::size_t i = 1; i < 4; ++i) joined.join(tet[0], tet[i]);
  std::vector<std::uint32_t> piece_of(mesh.vertices.size(), kNone), index(mesh.vertices.size(), kNone);
  std::vector<Piece> pieces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::uint32_t& number = piece_of[joined.find(mesh.tets[t][0])];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    Piece& piece = pieces[number];
    Tet own{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t vertex = mesh.tets[t][i];
      if (index[vertex] == kNone) {
        index[vertex] = static_cast<std::uint32_t>(piece.mesh.vertices.size());
        piece.mesh.vertices.push_back(mesh.vertices[vertex]);
      }
      own[i] = index[vertex];
    }
    piece.tets.push_back(static_cast<std::uint32_t>(t));
    piece.mesh.tets.push_back(own);
    piece.stiffness.push_back(whole.stiffness.empty() ? 1.0 : whole.stiffness[t]);
    piece.density.push_back(whole.density.empty() ? 1.0 : whole.density[t]);
    piece.volume += signed_volume(corners_of(mesh, mesh.tets[t]));
  }
  return pieces;
}

}  // namespace tetsoup
