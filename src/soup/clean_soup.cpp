#include <algorithm>
#include <cmath>

#include "base/origin.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "base/words.h"
#include "base/merge_vertices.h"
#include "soup/diagnose.h"
#include "soup/find_parts.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

/// Coordinates beyond this count as non-finite: their squares and the space around them must fit in the arithmetic.
constexpr float kLargestCoordinate = 1e30F;
constexpr std::int64_t kGrain = 4096;  ///< Vertices or triangles in a chunk.

bool is_usable(const Vec3& v) {
  return std::abs(v.x) <= kLargestCoordinate && std::abs(v.y) <= kLargestCoordinate &&
         std::abs(v.z) <= kLargestCoordinate;  // false for NaN
}

std::vector<Triangle> usable_triangles(const TriangleSoup& soup, SoupReport& report) {
  const std::size_t vertex_count = soup.vertices.size();
  std::vector<std::uint8_t> usable(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) usable[i] = is_usable(soup.vertices[i]);

  std::vector<Triangle> kept;
  kept.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    if (t[0] >= vertex_count || t[1] >= vertex_count || t[2] >= vertex_count) {
      ++report.index_out_of_range;
    } else if (!usable[t[0]] || !usable[t[1]] || !usable[t[2]]) {
      ++report.non_finite;
    } else {
      kept.push_back(t);
    }
  }
  return kept;
}

OrderedTriangles ordered_triangles(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                                   StageWatch& watch) {
  OrderedTriangles ordered(vertex_count, [&](const auto& put) {
    for (auto [a, b, c] : triangles) {
      bool turned = false;
      const auto swap_if_above = [&](std::uint32_t& low, std::uint32_t& high) {
        if (low <= high) return;
        std::swap(low, high);
        turned = !turned;
      };
      swap_if_above(a, b);
      swap_if_above(b, c);
      swap_if_above(a, b);
      put(a, RestOfTriangle{b, c, turned});
    }
  });
  parallel_for(static_cast<std::int64_t>(vertex_count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
      std::sort(ordered[v].begin(), ordered[v].end());
  });
  return ordered;
}

/// The triangles without duplicates, and for each what its copies say of its winding.
void drop_duplicates(const OrderedTriangles& ordered, std::vector<Triangle>& triangles,
                     std::vector<WindingOf>& windings) {
  triangles.reserve(ordered.items().size());
  windings.reserve(ordered.items().size());
  for (std::uint32_t low = 0; low < ordered.size(); ++low) {
    for (const RestOfTriangle& t : ordered[low]) {
      const Triangle triangle{low, t.middle, t.high};
      const WindingOf winding = t.turned ? WindingOf::Turned : WindingOf::Ascending;
      if (triangles.empty() || triangles.back() != triangle) {
        triangles.push_back(triangle);
        windings.push_back(winding);
      } else if (windings.back() != winding) {
        windings.back() = WindingOf::Both;
      }
    }
  }
}

bool has_no_area(const std::vector<Vec3>& vertices, const Triangle& t) {
  const Vec3d a = to_double(vertices[t[0]]);
  return cross(to_double(vertices[t[1]]) - a, to_double(vertices[t[2]]) - a) == Vec3d{0, 0, 0};
}

std::size_t count_without_area(const TriangleSoup& soup, StageWatch& watch) {
  const auto count = [&](std::int64_t begin, std::int64_t end) {
    return static_cast<std::size_t>(std::count_if(soup.triangles.begin() + begin, soup.triangles.begin() + end,
                                                  [&](const Triangle& t) { return has_no_area(soup.vertices, t); }));
  };
  return parallel_sum<std::size_t>(static_cast<std::int64_t>(soup.triangles.size()), kGrain, watch, count);
}

/// Floats, which half of the formats and most engines hold, are too coarse there.
std::string place_note(const Vec3d& origin) {
  constexpr int kDigits = 12;
  const auto text = [](double x) { return rounded(x, kDigits); };
  return "The model lies far from zero for its size, around (" + text(origin.x) + ", " + text(origin.y) + ", " +
         text(origin.z) +
         "). What reads its files as floats, as most engines do, rounds there: --recentre leaves that "
         "offset out.";
}

}  // namespace

TriangleSoup make_soup(std::span<const Vec3d> vertices, std::vector<Triangle> triangles) {
  const Vec3d origin = origin_of(vertices, flat(std::span<const Triangle>(triangles)));
  return {counted_from(origin, vertices), std::move(triangles), origin};
}

CleanSoup clean_soup(const TriangleSoup& soup, const Progress& progress) {
  StageWatch watch(progress, "soup");
  CleanSoup clean;
  SoupReport& report = clean.report;
  report.vertex_count = soup.vertices.size();
  report.triangle_count = soup.triangles.size();

  std::vector<Triangle> triangles = usable_triangles(soup, report);
  watch.step(0.1);
  clean.soup.vertices = merge_vertices(soup.vertices, triangles).positions;
  watch.enter_part(0.4, 0.6);
  const OrderedTriangles ordered = ordered_triangles(clean.soup.vertices.size(), triangles, watch);
  watch.enter_part(0.6, 0.9);
  diagnose(ordered, report, watch);

  std::vector<WindingOf> windings;
  drop_duplicates(ordered, clean.soup.triangles, windings);
  clean.soup.origin = report.origin = soup.origin;
  report.duplicates = triangles.size() - clean.soup.triangles.size();
  clean.parts = find_parts(clean.soup, windings, watch);
  watch.enter_part(0.9, 1);
  report.zero_area = count_without_area(clean.soup, watch);
  report.used_triangles = clean.soup.triangles.size();
  report.merged_vertices = clean.soup.vertices.size();
  report.box = box_of(clean.soup.vertices);
  if (!(soup.origin == Vec3d{})) report.notes.push_back(place_note(soup.origin));
  return clean;
}

}  // namespace tetsoup
