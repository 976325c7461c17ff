#include "simulate/rest.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/elementary.h"
#include "base/tet_faces.h"
#include "base/unions.h"
#include "simulate/batches.h"

namespace tetsoup::simulate {
namespace {

/// Relative; a flatter tet has gradients that single precision cannot hold beside those of the others.
constexpr double kFlattest = 1e-7;
/// A compliance that is as good as infinite.
constexpr double kLargest = 1e30;

bool can_be_simulated(const TetMesh& mesh, const Tet& tet) {
  if (!is_valid_tet(tet, mesh.vertices.size())) return false;
  const TetCorners p = corners_of(mesh, tet);
  double longest = 0;
  for (const auto& e : kTetEdges)
    longest = std::max(longest, length(p[static_cast<std::size_t>(e[0])] - p[static_cast<std::size_t>(e[1])]));
  return std::isfinite(longest) && signed_volume(p) > kFlattest * longest * longest * longest;
}

/// Inverse of the symmetric matrix with the diagonal a and, beside it, xy, xz, yz; applied to v.
Vec3d solve_symmetric(const Vec3d& a, const Vec3d& off, const Vec3d& v) {
  const Vec3d r0{a.x, off.x, off.y}, r1{off.x, a.y, off.z}, r2{off.y, off.z, a.z};
  const Vec3d c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
  return (c0 * v.x + c1 * v.y + c2 * v.z) * (1 / dot(r0, c0));
}

void set_lane(kernel::TetLanes* to, std::size_t lane, const Vec3d& v) {
  to[0][lane] = static_cast<float>(v.x);
  to[1][lane] = static_cast<float>(v.y);
  to[2][lane] = static_cast<float>(v.z);
}

double mean_edge_of(const Piece& piece) {
  double sum = 0;
  for (const Tet& tet : piece.tets) {
    const TetCorners p = corners_at(piece.places, tet);
    for (const auto& [a, b] : kTetEdges) sum += length(p[static_cast<std::size_t>(a)] - p[static_cast<std::size_t>(b)]);
  }
  return sum / static_cast<double>(6 * piece.tets.size());
}

/// What counts as the edge of a tet for its damping: in flat tets less than the mean, since the least of their moves is
/// much strain; in a good tet heights are more than half of it.
double edge_of(const Rest& rest, const std::array<Vec3d, 4>& gradients) {
  double edge = rest.piece.mean_edge;
  for (const Vec3d& g : gradients) edge = std::min(edge, 2 / length(g));
  return edge;
}

/// [kernel/relax_tets.h]: responses 2 mu V h^2 w (I + S)^-1 g, all stiffer by 1 + damping_time / h.
void prepare_tet(Rest& rest, std::size_t t, double h) {
  const Tet& tet = rest.piece.tets[t];
  const TetCorners p = corners_at(rest.piece.places, tet);
  const std::array<Vec3d, 4> g = barycentric_gradients(p);
  const double volume = signed_volume(p), damping_time = rest.damping_time(h, edge_of(rest, g));
  const double stiffer = h * (h + damping_time);
  const double stiffness = 2 * rest.shear_modulus() * volume * stiffer;
  Vec3d diagonal{1, 1, 1}, off;
  for (std::size_t i = 0; i < 4; ++i) {
    const double s = stiffness * rest.inverse_mass(tet[i]);
    diagonal += Vec3d{g[i].x * g[i].x, g[i].y * g[i].y, g[i].z * g[i].z} * s;
    off += Vec3d{g[i].x * g[i].y, g[i].x * g[i].z, g[i].y * g[i].z} * s;
  }
  kernel::TetBatch& batch = rest.batches[rest.lanes[t] / kernel::kTetLanes];
  const std::size_t lane = rest.lanes[t] % kernel::kTetLanes;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i > 0) set_lane(batch.gradients + 3 * (i - 1), lane, g[i]);
    set_lane(batch.responses + 3 * i, lane,
             solve_symmetric(diagonal, off, g[i]) * (stiffness * rest.inverse_mass(tet[i])));
  }
  const double most = share_of(rest.damping_time(h, rest.piece.mean_edge), h);
  batch.damping[lane] = static_cast<float>(most > 0 ? share_of(damping_time, h) / most : 0);
  batch.volume_compliance[lane] = static_cast<float>(std::min(kLargest, 1 / (rest.lame() * volume * stiffer)));
}

}  // namespace

double share_of(double damping_time, double h) {
  return damping_time / (damping_time + h);
}

std::vector<Piece> split_pieces(const TetMesh& mesh, double scale) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  Unions unions(mesh.vertices.size());
  std::vector<const Tet*> tets;
  for (const Tet& tet : mesh.tets) {
    if (!can_be_simulated(mesh, tet)) continue;
    tets.push_back(&tet);
    for (std::size_t i = 1; i < 4; ++i) unions.join(tet[0], tet[i]);
  }
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> piece_of(mesh.vertices.size(), kNone), local(mesh.vertices.size(), kNone);
  for (const Tet* tet : tets) {
    std::uint32_t& which = piece_of[unions.find((*tet)[0])];
    if (which == kNone) {
      which = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    Piece& piece = pieces[which];
    Tet own{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t v = (*tet)[i];
      if (local[v] == kNone) {
        local[v] = static_cast<std::uint32_t>(piece.places.size());
        piece.places.push_back(to_double(mesh.vertices[v]) * scale);
        piece.vertices.push_back(v);
      }
      own[i] = local[v];
    }
    piece.tets.push_back(own);
  }
  for (Piece& piece : pieces) piece.mean_edge = mean_edge_of(piece);
  return pieces;
}

double Rest::damping_time(double h, double edge) const {
  // A sweep does not reach the balance of a stiff body, and viscosity would keep what is amiss as if it were the
  // strain before: beams sag, and crumple where waves of elasticity and viscosity together pass two edges in a substep.
  constexpr double kAlways = 0.3;  // substeps: no beam crumpled with it
  constexpr double kTried = 12;    // edges in a substep, of those beams
  const double edges = h / wave_time(edge);
  const double least = kAlways * std::min(1.0, elementary::square(kTried / edges));
  return std::min(material.damping_time, h * std::max(least, elementary::square(kMostEdges / edges) - 1));
}

Rest make_rest(Piece piece, const SimMaterial& material) {
  Rest rest;
  rest.piece = std::move(piece);
  rest.material = material;
  const std::size_t count = rest.piece.places.size();
  rest.masses.assign(count, 0);
  rest.held.assign(count, 0);
  rest.padded_count = (count / kernel::kPlaceBlock + 1) * kernel::kPlaceBlock;
  for (const Tet& tet : rest.piece.tets) {
    const double mass = material.elastic.density * signed_volume(corners_at(rest.piece.places, tet));
    for (const std::uint32_t v : tet) rest.masses[v] += mass / 4;
  }
  fill_batches(rest);
  return rest;
}

void prepare(Rest& rest, double h) {
  if (rest.prepared_for == h) return;
  for (std::size_t t = 0; t < rest.piece.tets.size(); ++t) prepare_tet(rest, t, h);
  rest.prepared_for = h;
}

}  // namespace tetsoup::simulate
