// What became of a soup's shape in a mesh of it.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/origin.h"
#include "base/parallel.h"
#include "base/tet_locator.h"
#include "base/triangle_boxes.h"
#include "quality/line_survey.h"
#include "quality/mesh_skin.h"
#include "quality/overlapping_tets.h"
#include "quality/piece_match.h"
#include "quality/soup_facts.h"
#include "quality/surface_cells.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

constexpr double kReach = 0.7;  ///< Edges; a soup farther from the mesh is lost. Below .75, as points stand for cells.
constexpr double kLongStretch = 1.5;    ///< Edges.
constexpr double kStrayDistance = 0.5;  ///< Edges.
constexpr double kCellsPerEdge = 4;     ///< Of the surface that is looked for.
constexpr double kNested = 0.01;  ///< Share of a soup's lines within two parts: beyond, its volume is not their sum.

bool any_within(const TriangleBoxes& boxes, const Vec3d& at, double distance) {
  const Vec3d p = boxes.to_unit(at);
  const double square = distance * boxes.scale() * distance * boxes.scale();
  float best = TriangleBoxes::bound_above(square);
  bool found = false;
  boxes.visit_near(to_float(p), best, [&](std::uint32_t triangle) {
    if (found || squared_length(closest_on_triangle(boxes.corners_in_unit(triangle), p) - p) > square) return;
    found = true;
    best = -1;  // nothing lies nearer than that
  });
  return found;
}

/// What the mesh does not reach of the soup's surface.
void measure_lost(const TetMesh& mesh, const TriangleBoxes& skin, const TriangleSoup& soup, const SoupFacts& facts,
                  StageWatch& watch, Fidelity& found) {
  double cell = found.mean_edge / kCellsPerEdge;
  const std::vector<SurfaceCell> cells =
      find_surface_cells(soup, std::vector<std::uint32_t>(facts.part.size(), 0), cell);
  std::vector<char> far(cells.size(), 0);
  constexpr std::int64_t kGrain = 256;
  parallel_for(static_cast<std::int64_t>(cells.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      far[i] = !any_within(skin, cells[i].at, kReach * found.mean_edge);
  });
  if (std::find(far.begin(), far.end(), 1) == far.end()) return;
  const TetLocator tets(mesh);
  std::vector<SurfaceCell> lost;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    bool held = far[i] == 0;
    if (!held) tets.visit_holders(cells[i].at, [&](std::uint32_t) { held = true; });
    if (!held) lost.push_back(cells[i]);
  }
  std::uint32_t groups = 0;
  const std::vector<std::uint32_t> label = label_cells(lost, groups);
  std::vector<std::optional<std::pair<Vec3d, Vec3d>>> boxes(groups);
  for (std::size_t i = 0; i < lost.size(); ++i) {
    auto& box = boxes[label[i]];
    box =
        box ? std::pair(min(box->first, lost[i].at), max(box->second, lost[i].at)) : std::pair(lost[i].at, lost[i].at);
  }
  for (const auto& box : boxes) {
    const double size = (length(box->second - box->first) + cell) / found.mean_edge;
    found.lost_edges = std::max(found.lost_edges, size);
    if (size > kLongStretch) ++found.lost_stretches;
  }
}

double volume_of(const TetMesh& mesh) {
  double volume = 0;
  for (const Tet& tet : mesh.tets) {
    if (!is_valid_tet(tet, mesh.vertices.size())) continue;
    const double v = signed_volume(corners_of(mesh, tet));
    if (std::isfinite(v)) volume += v;
  }
  return volume;
}

/// Volumes, and what lies where it should not.
void measure_volume(const TetMesh& mesh, const MeshSkin& skin, const TriangleSoup& soup, const SoupFacts& facts,
                    const TriangleBoxes& boxes, StageWatch& watch, Fidelity& found) {
  const LineSurvey survey = survey_lines(mesh, skin, soup, facts, kStrayDistance * found.mean_edge);
  if (!(survey.mesh > 0)) return;
  found.overlap_share = survey.overlap / survey.mesh;
  found.apart_share = survey.apart / survey.mesh;
  found.closed = facts.closed && survey.soup > 0;
  if (!found.closed) return;
  const double volume = volume_of(mesh);
  found.soup_volume = survey.nested > kNested * survey.soup ? volume * survey.soup / survey.mesh : facts.volume;
  constexpr double kVolumeLimit = 1.1;
  if (found.soup_volume > 0) {
    found.volume_ratio = volume / found.soup_volume;
    found.wall_edges = 2 * found.soup_volume / facts.area / found.mean_edge;
    found.volume_limit = found.wall_edges > 0.5 ? kVolumeLimit : std::max(kVolumeLimit, 0.5 / found.wall_edges);
  }
  constexpr std::int64_t kGrain = 64;
  const auto stray = [&](std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      if (!any_within(boxes, survey.outside[i].at, kStrayDistance * found.mean_edge)) sum += survey.outside[i].length;
    return sum;
  };
  found.stray_share =
      parallel_sum<double>(static_cast<std::int64_t>(survey.outside.size()), kGrain, watch, stray) / survey.mesh;
}

Vec3d unit_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d n = cross(b - a, c - a);
  const double size = length(n);
  return size > 0 ? n * (1 / size) : Vec3d{};
}

/// Whether no triangle of the soup beside a point of the boundary is about parallel to it.
bool is_tilted(const TriangleBoxes& boxes, const Vec3d& at, const Vec3d& normal, double beside) {
  constexpr double kTilt = 0.90631;  // cosine of 25 degrees
  const Vec3d p = boxes.to_unit(at);
  double nearest = 4;  // beyond the box of the soup in its own unit, and the mesh about it
  float best = 16;
  boxes.visit_near(to_float(p), best, [&](std::uint32_t t) {
    nearest = std::min(nearest, length(closest_on_triangle(boxes.corners_in_unit(t), p) - p));
    best = std::min(best, TriangleBoxes::bound_above(nearest * nearest));
  });
  const double reach = nearest + beside * boxes.scale();
  bool parallel = false;
  float bound = TriangleBoxes::bound_above(reach * reach);
  boxes.visit_near(to_float(p), bound, [&](std::uint32_t t) {
    const auto corners = boxes.corners_in_unit(t);
    if (parallel || std::abs(dot(unit_normal(corners[0], corners[1], corners[2]), normal)) < kTilt) return;
    if (length(closest_on_triangle(corners, p) - p) > reach) return;
    parallel = true;
    bound = -1;
  });
  return !parallel;
}

void measure_tilt(const TetMesh& mesh, const MeshSkin& skin, const TriangleBoxes& boxes, StageWatch& watch,
                  Fidelity& found) {
  constexpr double kBeside = 1.0 / 6;  // edges
  struct Sum {
    double tilted = 0, area = 0;
    Sum& operator+=(const Sum& other) { return tilted += other.tilted, area += other.area, *this; }
  };
  constexpr std::int64_t kGrain = 64;
  const auto count = [&](std::int64_t begin, std::int64_t end) {
    Sum sum;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      const auto [i, j, k] = skin.triangles[t];
      const Vec3d a = to_double(mesh.vertices[i]), b = to_double(mesh.vertices[j]), c = to_double(mesh.vertices[k]);
      const double area = length(cross(b - a, c - a)) / 8;
      const Vec3d normal = unit_normal(a, b, c), middle = (a + b + c) * (1.0 / 3);
      for (const Vec3d& at : {middle, (a + middle) * 0.5, (b + middle) * 0.5, (c + middle) * 0.5}) {
        sum.area += area;
        if (is_tilted(boxes, at, normal, kBeside * found.mean_edge)) sum.tilted += area;
      }
    }
    return sum;
  };
  const Sum sum = parallel_sum<Sum>(static_cast<std::int64_t>(skin.triangles.size()), kGrain, watch, count);
  if (sum.area > 0) found.tilted_share = sum.tilted / sum.area;
}

}  // namespace

Fidelity measure_fidelity(const TetMesh& mesh, const TriangleSoup& soup) {
  if (!(mesh.origin == soup.origin))
    return measure_fidelity(
        mesh, TriangleSoup{recounted(soup.vertices, soup.origin, mesh.origin), soup.triangles, mesh.origin});
  Fidelity found;
  const MeshSkin skin = find_skin(mesh);
  found.mean_edge = skin.mean_edge;
  found.mesh_pieces = skin.pieces;
  const OverlappingTets overlapping = find_overlapping_tets(mesh, skin);
  found.overlapping_pairs = overlapping.in_piece;
  found.apart_pairs = overlapping.apart;
  const Progress nobody;
  StageWatch watch(nobody, "quality");
  const TriangleBoxes of_soup(soup, watch);
  const TriangleSoup surface{mesh.vertices, skin.triangles};
  const TriangleBoxes of_skin(surface, watch);
  if (of_soup.empty() || of_skin.empty() || !(found.mean_edge > 0)) return found;
  const SoupFacts facts = find_soup_facts(soup);
  measure_lost(mesh, of_skin, soup, facts, watch, found);
  measure_volume(mesh, skin, soup, facts, of_soup, watch, found);
  match_pieces(mesh, skin, of_skin, soup, facts, of_soup, found);
  if (facts.closed && facts.parts == 1) {
    found.soup_tunnels = facts.tunnels;
    found.mesh_tunnels = count_tunnels(skin.triangles, mesh.vertices.size());
  }
  found.flat = facts.flat;
  if (found.flat) measure_tilt(mesh, skin, of_soup, watch, found);
  return found;
}

Fidelity measure_fidelity(const TetMesh& mesh, const CleanSoup& soup) {
  TriangleSoup given = soup.soup;
  for (std::size_t t = 0; t < soup.parts.turned.size(); ++t)
    if (soup.parts.turned[t] != 0) std::swap(given.triangles[t][1], given.triangles[t][2]);
  return measure_fidelity(mesh, given);
}

}  // namespace tetsoup
