#include <algorithm>
#include <array>
#include <cmath>

#include "base/require.h"
#include "base/tet_geometry.h"
#include "regions/label_places.h"
#include "tetsoup/regions.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kGrain = 32;  // tets
constexpr int kSteps = 3;            // Of the points along an edge: 20 in a tet.
constexpr double kOffset = 0.25;     // Of a step, from the faces: each point stands for as much as any other.

/// Barycentric weights of the points at which a tet is asked.
std::vector<std::array<double, 4>> sample_weights() {
  std::vector<std::array<double, 4>> all;
  const auto weight = [](int i) { return (i + kOffset) / (kSteps + 1); };
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j)
      for (int k = 0; i + j + k <= kSteps; ++k)
        all.push_back({weight(i), weight(j), weight(k), weight(kSteps - i - j - k)});
  return all;
}

}  // namespace

std::vector<LabelShare> share_tet(const std::array<Vec3d, 4>& corners, const LabelPlaces& places, const Vec3d& shift) {
  static const std::vector<std::array<double, 4>> kWeights = sample_weights();
  TetCorners p = corners;
  for (Vec3d& corner : p) corner += shift;
  const Vec3d centre = (p[0] + p[1] + p[2] + p[3]) * 0.25;
  double radius = 0;
  for (const Vec3d& corner : p) radius = std::max(radius, length(corner - centre));
  if (places.empty() || places.is_clear(centre, radius)) return {{places.at(centre), 1}};
  std::vector<std::uint32_t> labels;
  for (const auto& w : kWeights) labels.push_back(places.at(p[0] * w[0] + p[1] * w[1] + p[2] * w[2] + p[3] * w[3]));
  std::sort(labels.begin(), labels.end());
  std::vector<LabelShare> shares;
  for (std::size_t i = 0, j = 0; i < labels.size(); i = j) {
    while (j < labels.size() && labels[j] == labels[i]) ++j;
    shares.push_back({labels[i], static_cast<float>(j - i) / static_cast<float>(labels.size())});
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const LabelShare& a, const LabelShare& b) { return a.share > b.share; });
  return shares;
}

TetLabels share_tets(const TetMesh& mesh, const LabelPlaces& places, const Vec3d& shift, StageWatch& watch) {
  std::vector<std::vector<LabelShare>> of_tets(mesh.tets.size());
  parallel_for(static_cast<std::int64_t>(of_tets.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t)
      of_tets[t] = share_tet(corners_of(mesh, mesh.tets[t]), places, shift);
  });
  TetLabels result;
  result.first.push_back(0);
  for (const auto& shares : of_tets) {
    result.shares.insert(result.shares.end(), shares.begin(), shares.end());
    result.first.push_back(static_cast<std::uint32_t>(result.shares.size()));
  }
  return result;
}

TetLabels share_tets(const TetMesh& mesh, const TriangleSoup& soup, std::span<const std::uint32_t> labels,
                     const Progress& progress) {
  require(labels.size() == soup.triangles.size(), "number of labels", labels.size(), "that of the triangles");
  StageWatch watch(progress, "regions");
  const LabelPlaces places(soup, labels, watch);
  return share_tets(mesh, places, mesh.origin - soup.origin, watch);
}

std::vector<std::uint32_t> label_tets(const TetMesh& mesh, const TriangleSoup& soup,
                                      std::span<const std::uint32_t> labels, const Progress& progress) {
  return largest_of(share_tets(mesh, soup, labels, progress));
}

std::vector<std::uint32_t> largest_of(const TetLabels& labels) {
  std::vector<std::uint32_t> largest;
  for (std::size_t t = 0; t < labels.size(); ++t) largest.push_back(labels[t].front().label);
  return largest;
}

}  // namespace tetsoup
