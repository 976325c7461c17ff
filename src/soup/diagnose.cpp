#include "soup/diagnose.h"

#include <numeric>

#include "base/parallel.h"

namespace tetsoup {
namespace {

/// One side of a triangle: the lower vertex, the higher one, and whether the triangle runs from the higher to the
/// lower.
struct HalfEdge {
  std::uint64_t vertices;
  bool downward;
};

std::vector<HalfEdge> sorted_half_edges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = t[i], to = t[(i + 1) % 3];
      edges.push_back({from < to ? from << 32 | to : to << 32 | from, from > to});
    }
  }
  parallel_sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.downward < b.downward;
  });
  return edges;
}

void count_edges(const std::vector<HalfEdge>& edges, SoupReport& report) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].vertices == edges[begin].vertices) ++end;
    const std::size_t triangles = end - begin;
    report.boundary_edges += triangles == 1;
    report.non_manifold_edges += triangles > 2;
    report.inconsistent_edges += triangles == 2 && edges[begin].downward == edges[begin + 1].downward;
  }
}

std::size_t count_components(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::size_t components = vertex_count;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 1; i < 3; ++i) {
      const std::uint32_t a = root(t[0]), b = root(t[i]);
      if (a == b) continue;
      parent[std::max(a, b)] = std::min(a, b);
      --components;
    }
  }
  return components;
}

}  // namespace

void diagnose(std::size_t vertex_count, const std::vector<Triangle>& triangles, SoupReport& report) {
  const std::vector<HalfEdge> edges = sorted_half_edges(triangles);
  count_edges(edges, report);
  report.components = count_components(vertex_count, triangles);
  if (triangles.empty()) {
    report.kind = SoupClass::Empty;
  } else if (edges.empty() || 2 * report.boundary_edges >= triangles.size()) {
    report.kind = SoupClass::Soup;
  } else {
    report.kind = report.boundary_edges == 0 ? SoupClass::Closed : SoupClass::Open;
  }
}

}  // namespace tetsoup
