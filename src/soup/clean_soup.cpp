#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "base/vec.h"
#include "soup/diagnose.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

/// Coordinates beyond this count as non-finite: their squares and the space around them must fit in the arithmetic.
constexpr float kLargestCoordinate = 1e30F;

bool is_usable(const Vec3& v) {
  return std::abs(v.x) <= kLargestCoordinate && std::abs(v.y) <= kLargestCoordinate &&
         std::abs(v.z) <= kLargestCoordinate;  // false for NaN
}

bool less_by_position(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// -0 becomes +0, so that equal positions are equal bits.
Vec3 without_negative_zero(const Vec3& v) {
  return {v.x + 0.0F, v.y + 0.0F, v.z + 0.0F};
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

/// Distinct positions of the triangles' vertices in lexicographic order; the triangles' indices are renamed to match.
std::vector<Vec3> merge_vertices(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles) {
  std::vector<std::uint8_t> used(vertices.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) used[v] = 1;
  struct Entry {
    Vec3 position;
    std::uint32_t index;
  };
  std::vector<Entry> order;
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    if (used[i]) order.push_back({without_negative_zero(vertices[i]), i});
  parallel_sort(order.begin(), order.end(), [](const Entry& a, const Entry& b) {
    if (a.position == b.position) return a.index < b.index;
    return less_by_position(a.position, b.position);
  });

  std::vector<Vec3> merged;
  std::vector<std::uint32_t> name(vertices.size());
  for (const Entry& e : order) {
    if (merged.empty() || !(merged.back() == e.position)) merged.push_back(e.position);
    name[e.index] = static_cast<std::uint32_t>(merged.size() - 1);
  }
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = name[v];
  return merged;
}

bool has_no_area(const std::vector<Vec3>& vertices, const Triangle& t) {
  const Vec3d a = to_double(vertices[t[0]]);
  return cross(to_double(vertices[t[1]]) - a, to_double(vertices[t[2]]) - a) == Vec3d{0, 0, 0};
}

Box3 box_of(const std::vector<Vec3>& vertices) {
  if (vertices.empty()) return {};
  Box3 box{to_double(vertices[0]), to_double(vertices[0])};
  for (const Vec3& v : vertices) {
    box.lo = min(box.lo, to_double(v));
    box.hi = max(box.hi, to_double(v));
  }
  return box;
}

}  // namespace

CleanSoup clean_soup(const TriangleSoup& soup, const Progress& progress) {
  StageWatch watch(progress, "soup");
  CleanSoup clean;
  SoupReport& report = clean.report;
  report.vertex_count = soup.vertices.size();
  report.triangle_count = soup.triangles.size();

  std::vector<Triangle> triangles = usable_triangles(soup, report);
  watch.step(0.1);
  clean.soup.vertices = merge_vertices(soup.vertices, triangles);
  watch.step(0.4);
  diagnose(clean.soup.vertices.size(), triangles, report);
  watch.step(0.7);

  for (Triangle& t : triangles) std::sort(t.begin(), t.end());
  parallel_sort(triangles.begin(), triangles.end(), std::less<>());
  const auto last = std::unique(triangles.begin(), triangles.end());
  report.duplicates = static_cast<std::size_t>(triangles.end() - last);
  triangles.erase(last, triangles.end());
  clean.soup.triangles = std::move(triangles);

  report.zero_area =
      static_cast<std::size_t>(std::count_if(clean.soup.triangles.begin(), clean.soup.triangles.end(),
                                             [&](const Triangle& t) { return has_no_area(clean.soup.vertices, t); }));
  report.used_triangles = clean.soup.triangles.size();
  report.merged_vertices = clean.soup.vertices.size();
  report.box = box_of(clean.soup.vertices);
  watch.step(1);
  return clean;
}

}  // namespace tetsoup
