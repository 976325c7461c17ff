#include "base/merge_vertices.h"

#include <algorithm>
#include <tuple>

#include "base/hash.h"
#include "base/radix_sort.h"
#include "base/vec.h"

namespace tetsoup {
namespace {

/// Below this many entries comparing is faster than counting digits.
constexpr std::size_t kFewEntries = 256;

struct Entry {
  std::uint32_t key;  ///< One coordinate, so that whole numbers are in the order of the coordinates.
  std::uint32_t index;
};

/// -0 becomes +0, so that equal positions are equal bits.
Vec3 without_negative_zero(const Vec3& v) {
  return {v.x + 0.0F, v.y + 0.0F, v.z + 0.0F};
}

std::uint32_t ordered_bits(float coordinate) {
  constexpr std::uint32_t kSign = 0x80000000U;
  const auto bits = bits_of(coordinate + 0.0F);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

/// Sorts entries by position; those given share the coordinates of the axes before `axis`.
void sort_by_position(std::span<Entry> entries, std::span<Entry> scratch, const std::vector<Vec3>& vertices,
                      std::size_t axis) {
  constexpr std::array<float Vec3::*, 3> kAxes{&Vec3::x, &Vec3::y, &Vec3::z};
  if (axis == kAxes.size() || entries.size() < 2) return;
  if (entries.size() < kFewEntries) {
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
      const Vec3 &p = vertices[a.index], &q = vertices[b.index];
      return std::tie(p.x, p.y, p.z, a.index) < std::tie(q.x, q.y, q.z, b.index);
    });
    return;
  }
  for (Entry& e : entries) e.key = ordered_bits(vertices[e.index].*kAxes[axis]);
  radix_sort(entries, scratch);
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
    sort_by_position(entries.subspan(begin, end - begin), scratch.subspan(begin, end - begin), vertices, axis + 1);
  }
}

}  // namespace

bool is_usable(const TriangleSoup& soup, const Triangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t v) { return v < soup.vertices.size() && is_finite(soup.vertices[v]); });
}

MergedVertices merge_vertices(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles) {
  std::vector<std::uint8_t> used(vertices.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) used[v] = 1;
  std::vector<Entry> order;
  order.reserve(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    if (used[i]) order.push_back({0, i});
  std::vector<Entry> scratch(order.size());
  sort_by_position(order, scratch, vertices, 0);

  MergedVertices merged{{}, std::vector<std::uint32_t>(vertices.size(), MergedVertices::kUnused)};
  merged.positions.reserve(order.size());
  for (const Entry& e : order) {
    const Vec3 position = without_negative_zero(vertices[e.index]);
    if (merged.positions.empty() || !(merged.positions.back() == position)) merged.positions.push_back(position);
    merged.names[e.index] = static_cast<std::uint32_t>(merged.positions.size() - 1);
  }
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = merged.names[v];
  return merged;
}

}  // namespace tetsoup
