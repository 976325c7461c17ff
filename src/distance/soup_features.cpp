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

void find_edges(const std::vector<Triangle>& triangles, SoupFeatures& features, StageWatch& watch) {
  Groups<Side> sides(features.corners.size(), [&](const auto& put) {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = triangles[f][kSides[i][0]], to = triangles[f][kSides[i][1]];
        if (from != to) put(from, Side{to, static_cast<std::uint32_t>(4 * f + i)});
      }
    }
  });
  const auto for_corners = [&](const auto& body) {
    parallel_for(static_cast<std::int64_t>(sides.size()), 2048, watch, [&](std::int64_t begin, std::int64_t end) {
      for (auto from = static_cast<std::size_t>(begin); from < static_cast<std::size_t>(end); ++from)
        body(from, sides[from]);
    });
  };
  std::vector<std::size_t> first_edge(sides.size() + 1);
  for_corners([&](std::size_t from, std::span<Side> group) {
    std::sort(group.begin(), group.end());
    for (std::size_t i = 0; i < group.size(); ++i) first_edge[from] += i == 0 || group[i].to != group[i - 1].to;
  });
  std::exclusive_scan(first_edge.begin(), first_edge.end(), first_edge.begin(), std::size_t{0});
  features.edges.resize(first_edge.back());
  features.sides.resize(sides.items().size());
  for_corners([&](std::size_t from, std::span<Side> group) {
    const auto first_side = static_cast<std::uint32_t>(group.data() - sides.items().data());
    std::size_t edge = first_edge[from];
    for (std::uint32_t i = 0; i < group.size(); ++i) {
      if (i == 0 || group[i].to != group[i - 1].to)
        features.edges[edge++] = {static_cast<std::uint32_t>(from), group[i].to, first_side + i, first_side + i};
      features.edges[edge - 1].last_side = first_side + i + 1;
      features.sides[first_side + i] = group[i].id;
    }
  });
}

Groups<std::uint32_t> find_spokes(const SoupFeatures& features) {
  return {features.corners.size(), [&](const auto& put) {
            for (std::uint32_t i = 0; i < features.edges.size(); ++i) {
              put(features.edges[i].from, i);
              put(features.edges[i].to, i);
            }
          }};
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
  find_edges(triangles, features, watch);
  watch.step(0.3);
  features.spokes = find_spokes(features);
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
