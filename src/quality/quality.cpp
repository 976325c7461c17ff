#include "tetsoup/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/elementary.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "base/unions.h"
#include "quality/topology.h"

namespace tetsoup {

namespace {

struct EdgeLengths {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  double sum_of_squares = 0;
};

EdgeLengths measure_edges(const TetCorners& p) {
  EdgeLengths edges;
  for (const auto& [i, j] : kTetEdges) {
    const double squared = squared_length(p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]);
    edges.shortest = std::min(edges.shortest, std::sqrt(squared));
    edges.longest = std::max(edges.longest, std::sqrt(squared));
    edges.sum_of_squares += squared;
  }
  return edges;
}

double mean_ratio(double volume, const EdgeLengths& edges) {
  return volume > 0 ? 12 * elementary::square(elementary::cbrt(3 * volume)) / edges.sum_of_squares : 0;
}

TetQuality measure_tet(const TetCorners& p) {
  const double volume = signed_volume(p);
  if (!std::isfinite(volume) || volume == 0) return {};
  double smallest = std::numbers::pi;
  for (const double cosine : dihedral_cosines(p))
    if (!std::isnan(cosine)) smallest = std::min(smallest, elementary::acos(cosine));
  return {static_cast<float>(mean_ratio(volume, measure_edges(p))), static_cast<float>(smallest)};
}

std::size_t dihedral_bin(double angle) {
  const double bins = static_cast<double>(kDihedralBins);
  return static_cast<std::size_t>(std::clamp(angle / std::numbers::pi * bins, 0.0, bins - 1));
}

/// Shapes, summed and bounded over the tets as they are visited.
class ShapeTally {
 public:
  explicit ShapeTally(Quality& quality) : quality_(quality) {}

  void add(const TetCorners& p) {
    const double volume = signed_volume(p);
    if (!(volume > 0) || !std::isfinite(volume)) ++quality_.inverted_tets;
    if (!std::isfinite(volume)) return add_mean_ratio(0);
    quality_.volume += volume;
    min_volume_ = std::min(min_volume_, volume);
    max_volume_ = std::max(max_volume_, volume);
    if (volume == 0) return add_mean_ratio(0);
    const EdgeLengths edges = measure_edges(p);
    quality_.max_edge_ratio = std::max(quality_.max_edge_ratio, edges.longest / edges.shortest);
    add_mean_ratio(mean_ratio(volume, edges));
    if (volume > 0) sum_volume_ += volume, sum_square_ += volume * volume, ++positive_;
    double smallest = std::numbers::pi;
    for (const double cosine : dihedral_cosines(p)) smallest = std::min(smallest, add_angle(elementary::acos(cosine)));
    smallest_angles_.push_back(smallest);
  }

  void finish() {
    if (min_volume_ <= max_volume_) quality_.min_tet_volume = min_volume_, quality_.max_tet_volume = max_volume_;
    if (min_angle_ <= max_angle_) quality_.min_dihedral = min_angle_, quality_.max_dihedral = max_angle_;
    if (positive_ > 0) {
      const double mean = sum_volume_ / positive_;
      quality_.volume_variation = std::sqrt(std::max(0.0, sum_square_ / positive_ - mean * mean)) / mean;
    }
    if (!smallest_angles_.empty()) {
      const auto at = smallest_angles_.begin() + static_cast<std::ptrdiff_t>(smallest_angles_.size() / 100);
      std::nth_element(smallest_angles_.begin(), at, smallest_angles_.end());
      quality_.min_dihedral_p1 = *at;
    }
    if (tets_ > 0) quality_.mean_ratio_min = min_ratio_, quality_.mean_ratio_mean = sum_ratio_ / tets_;
  }

 private:
  double add_angle(double angle) {
    if (std::isnan(angle)) return std::numbers::pi;
    min_angle_ = std::min(min_angle_, angle);
    max_angle_ = std::max(max_angle_, angle);
    ++quality_.dihedral_histogram[dihedral_bin(angle)];
    return angle;
  }
  void add_mean_ratio(double ratio) {
    min_ratio_ = std::min(min_ratio_, ratio);
    sum_ratio_ += ratio;
    ++tets_;
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Quality& quality_;
  double min_volume_ = kInfinity, max_volume_ = -kInfinity;
  double min_angle_ = kInfinity, max_angle_ = -kInfinity;
  double min_ratio_ = kInfinity, sum_ratio_ = 0;
  double tets_ = 0;
  double sum_volume_ = 0, sum_square_ = 0, positive_ = 0;
  std::vector<double> smallest_angles_;
};

std::size_t count_unused(const TetMesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Tet& tet : mesh.tets) {
    if (!is_valid_tet(tet, mesh.vertices.size())) continue;
    for (const std::uint32_t v : tet) used[v] = 1;
  }
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), char{0}));
}

}  // namespace

Quality measure_quality(const TetMesh& mesh) {
  Quality quality;
  quality.vertex_count = mesh.vertices.size();
  quality.tet_count = mesh.tets.size();
  quality.unused_vertices = count_unused(mesh);
  ShapeTally tally(quality);
  for (const Tet& tet : mesh.tets) {
    if (is_valid_tet(tet, mesh.vertices.size())) {
      tally.add(corners_of(mesh, tet));
    } else {
      ++quality.invalid_tets;
    }
  }
  tally.finish();
  measure_topology(mesh, quality);
  return quality;
}

std::vector<TetQuality> measure_tets(const TetMesh& mesh) {
  std::vector<TetQuality> tets(mesh.tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    if (is_valid_tet(mesh.tets[t], mesh.vertices.size())) tets[t] = measure_tet(corners_of(mesh, mesh.tets[t]));
  return tets;
}

std::vector<Triangle> boundary_triangles(const TetMesh& mesh) {
  return lone_faces(mesh, sorted_faces(mesh));
}

std::vector<Triangle> cavity_triangles(const TetMesh& mesh) {
  std::vector<Triangle> triangles = boundary_triangles(mesh);
  Unions surfaces(mesh.vertices.size());
  for (const Triangle& t : triangles) {
    surfaces.join(t[0], t[1]);
    surfaces.join(t[0], t[2]);
  }
  std::vector<double> volume(mesh.vertices.size(), 0);  // six times that, of every surface
  for (const Triangle& t : triangles) {
    const Vec3d a = to_double(mesh.vertices[t[0]]), b = to_double(mesh.vertices[t[1]]),
                c = to_double(mesh.vertices[t[2]]);
    volume[surfaces.find(t[0])] += dot(a, cross(b, c));
  }
  std::erase_if(triangles, [&](const Triangle& t) { return volume[surfaces.find(t[0])] >= 0; });
  return triangles;
}

}  // namespace tetsoup
