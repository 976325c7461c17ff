#include "distance/soup_features.h"

#include <algorithm>
#include <numeric>

namespace tetsoup {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 3> kSides{{{0, 1}, {1, 2}, {0, 2}}};  // as plan_face() has them

/// A triangle's side, in the bucket of its lower corner.
struct Side {
  std::uint32_t to, id;
  bool operator<(const Side& other) const { return to != other.to ? to < other.to : id < other.id; }
};

/// Begin of every bucket of `counts`, and the end of the last.
std::vector<std::uint32_t> bucket_begins(std::vector<std::uint32_t> counts) {
  counts.push_back(0);
  std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), 0U);
  return counts;
}

void find_edges(const std::vector<Triangle>& triangles, SoupFeatures& features) {
  std::vector<std::uint32_t> counts(features.corners.size());
  for (const Triangle& t : triangles)
    for (const auto& [lower, higher] : kSides) counts[t[lower]] += t[lower] != t[higher];
  const std::vector<std::uint32_t> begins = bucket_begins(counts);
  std::vector<Side> sides(begins.back());
  std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangles[f][kSides[i][0]], to = triangles[f][kSides[i][1]];
      if (from != to) sides[next[from]++] = {to, static_cast<std::uint32_t>(4 * f + i)};
    }
  }
  features.sides.reserve(sides.size());
  features.edges.reserve(sides.size() / 2 + sides.size() / 32);
  for (std::uint32_t from = 0; from < features.corners.size(); ++from) {
    std::sort(sides.begin() + begins[from], sides.begin() + begins[from + 1]);
    for (std::uint32_t i = begins[from]; i < begins[from + 1]; ++i) {
      if (i == begins[from] || sides[i].to != sides[i - 1].to) features.edges.push_back({from, sides[i].to, i, i});
      features.edges.back().last_side = i + 1;
      features.sides.push_back(sides[i].id);
    }
  }
}

void find_spokes(SoupFeatures& features) {
  std::vector<std::uint32_t> counts(features.corners.size());
  for (const auto& e : features.edges) {
    ++counts[e.from];
    ++counts[e.to];
  }
  features.first_spoke = bucket_begins(std::move(counts));
  features.spokes.resize(features.first_spoke.back());
  std::vector<std::uint32_t> next = features.first_spoke;
  for (std::uint32_t i = 0; i < features.edges.size(); ++i) {
    features.spokes[next[features.edges[i].from]++] = i;
    features.spokes[next[features.edges[i].to]++] = i;
  }
}

}  // namespace

std::vector<Vec3> voxel_vertices(const CleanSoup& soup, const GridFrame& frame) {
  std::vector<Vec3> vertices(soup.soup.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = to_float((to_double(soup.soup.vertices[i]) - frame.origin) * (1 / frame.voxel_size));
  return vertices;
}

SoupFeatures find_features(const CleanSoup& soup, const GridFrame& frame, StageWatch& watch) {
  const auto& triangles = soup.soup.triangles;
  SoupFeatures features;
  features.triangles = triangles;
  features.corners = voxel_vertices(soup, frame);
  watch.step(0);
  find_edges(triangles, features);
  watch.step(0.3);
  find_spokes(features);
  watch.step(0.6);
  features.faces.resize(triangles.size());
  parallel_for(static_cast<std::int64_t>(triangles.size()), 4096, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Triangle& t = triangles[i];
      features.faces[i] = kernel::plan_face(features.corners[t[0]], features.corners[t[1]], features.corners[t[2]]);
    }
  });
  return features;
}

}  // namespace tetsoup
