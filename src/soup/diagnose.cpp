#include "soup/diagnose.h"

#include <numeric>

namespace tetsoup {

namespace {

constexpr std::int64_t kGrain = 4096;  // vertices, about 12,000 edges

struct EdgeCounts {
  std::size_t sides = 0;  ///< Of all triangles.
  std::size_t boundary = 0, non_manifold = 0, inconsistent = 0;
  EdgeCounts& operator+=(const EdgeCounts& other) {
    sides += other.sides;
    boundary += other.boundary;
    non_manifold += other.non_manifold;
    inconsistent += other.inconsistent;
    return *this;
  }
};

/// One side of a triangle but for its lower vertex: twice the higher one, plus one if it runs from there.
using RestOfSide = std::uint64_t;

Groups<RestOfSide> sides_of(const OrderedTriangles& triangles) {
  return {triangles.size(), [&](const auto& put) {
            for (std::uint32_t low = 0; low < triangles.size(); ++low) {
              for (const RestOfTriangle& t : triangles[low]) {
                if (low == t.middle || t.middle == t.high) continue;
                const std::uint64_t turned = t.turned;
                put(low, std::uint64_t{2} * t.middle + turned);
                put(t.middle, std::uint64_t{2} * t.high + turned);
                put(low, std::uint64_t{2} * t.high + 1 - turned);
              }
            }
          }};
}

EdgeCounts count_edges(std::span<const RestOfSide> sorted_sides) {
  EdgeCounts counts;
  counts.sides = sorted_sides.size();
  for (std::size_t begin = 0, end = 0; begin < sorted_sides.size(); begin = end) {
    while (end < sorted_sides.size() && sorted_sides[end] / 2 == sorted_sides[begin] / 2) ++end;
    const std::size_t triangles = end - begin;
    counts.boundary += triangles == 1;
    counts.non_manifold += triangles > 2;
    counts.inconsistent += triangles == 2 && sorted_sides[begin] == sorted_sides[begin + 1];
  }
  return counts;
}

EdgeCounts count_edges(const OrderedTriangles& triangles, StageWatch& watch) {
  Groups<RestOfSide> sides = sides_of(triangles);
  return parallel_sum<EdgeCounts>(
      static_cast<std::int64_t>(sides.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
        EdgeCounts counts;
        for (auto low = static_cast<std::size_t>(begin); low < static_cast<std::size_t>(end); ++low) {
          std::sort(sides[low].begin(), sides[low].end());
          counts += count_edges(sides[low]);
        }
        return counts;
      });
}

std::size_t count_components(const OrderedTriangles& triangles) {
  std::vector<std::uint32_t> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::size_t components = triangles.size();
  for (std::uint32_t low = 0; low < triangles.size(); ++low) {
    for (const RestOfTriangle& t : triangles[low]) {
      for (const std::uint32_t other : {t.middle, t.high}) {
        const std::uint32_t a = root(low), b = root(other);
        if (a == b) continue;
        parent[std::max(a, b)] = std::min(a, b);
        --components;
      }
    }
  }
  return components;
}

}  // namespace

void diagnose(const OrderedTriangles& triangles, SoupReport& report, StageWatch& watch) {
  const EdgeCounts edges = count_edges(triangles, watch);
  report.boundary_edges = edges.boundary;
  report.non_manifold_edges = edges.non_manifold;
  report.inconsistent_edges = edges.inconsistent;
  report.components = count_components(triangles);
  if (triangles.items().empty()) {
    report.kind = SoupClass::Empty;
  } else if (edges.sides == 0 || 2 * edges.boundary >= triangles.items().size()) {
    report.kind = SoupClass::Soup;
  } else {
    report.kind = edges.boundary == 0 ? SoupClass::Closed : SoupClass::Open;
  }
}

}  // namespace tetsoup
