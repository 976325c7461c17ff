#include "soup/find_parts.h"

#include <algorithm>

#include "base/groups.h"
#include "base/unions.h"
#include "base/vec.h"

namespace tetsoup {
namespace {

/// One side of a triangle but for its lower vertex, which names its group.
struct Side {
  std::uint32_t high;
  std::uint32_t triangle;
  std::uint8_t forward;  ///< The triangle runs along it from the lower vertex to the higher.
  bool operator<(const Side& other) const { return high != other.high ? high < other.high : triangle < other.triangle; }
};

bool is_segment(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2];
}

Groups<Side> sides_of(const TriangleSoup& soup, std::span<const WindingOf> windings) {
  return {soup.vertices.size(), [&](const auto& put) {
            for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
              const auto [a, b, c] = soup.triangles[t];
              if (is_segment(soup.triangles[t])) continue;
              const bool ascending = windings[t] != WindingOf::Turned;
              put(a, Side{b, t, ascending});
              put(b, Side{c, t, ascending});
              put(a, Side{c, t, !ascending});
            }
          }};
}

/// What the edges say, of parts that are named by their first triangle.
struct EdgeFacts {
  Unions joined;
  std::vector<std::array<std::uint32_t, 2>> odd_edges;
  std::vector<std::uint8_t> odd, uneven;  ///< Of triangles: one of its edges is.
};

/// One edge: its triangles hang together.
void read_edge(std::uint32_t low, std::span<const Side> around, EdgeFacts& facts) {
  int balance = 0;
  for (const Side& side : around) {
    balance += side.forward != 0 ? 1 : -1;
    facts.joined.join(around.front().triangle, side.triangle);
  }
  const std::uint32_t first = around.front().triangle;
  if (around.size() % 2 != 0) {
    facts.odd[first] = 1;
    facts.odd_edges.push_back({low, around.front().high});
  }
  if (balance != 0) facts.uneven[first] = 1;
}

EdgeFacts read_edges(const TriangleSoup& soup, std::span<const WindingOf> windings, StageWatch& watch) {
  constexpr std::int64_t kGrain = 4096;
  Groups<Side> sides = sides_of(soup, windings);
  parallel_for(static_cast<std::int64_t>(sides.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
      std::sort(sides[v].begin(), sides[v].end());
  });
  const std::size_t count = soup.triangles.size();
  EdgeFacts facts{Unions(count), {}, std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count)};
  for (std::uint32_t low = 0; low < sides.size(); ++low) {
    const std::span<const Side> here = sides[low];
    for (std::size_t begin = 0, end = 0; begin < here.size(); begin = end) {
      while (end < here.size() && here[end].high == here[begin].high) ++end;
      read_edge(low, here.subspan(begin, end - begin), facts);
    }
  }
  for (std::size_t t = 0; t < count; ++t) {
    if (is_segment(soup.triangles[t])) facts.odd[t] = 1;
    if (windings[t] == WindingOf::Both) facts.uneven[t] = 1;
  }
  return facts;
}

/// Six times the volume of the tet between a triangle and `apex`.
double six_volumes(const TriangleSoup& soup, const Triangle& t, const Vec3d& apex) {
  const Vec3d a = to_double(soup.vertices[t[0]]) - apex, b = to_double(soup.vertices[t[1]]) - apex,
              c = to_double(soup.vertices[t[2]]) - apex;
  return dot(a, cross(b, c));
}

void grow(Box3& box, const Vec3& vertex) {
  box.lo = min(box.lo, to_double(vertex));
  box.hi = max(box.hi, to_double(vertex));
}

}  // namespace

SoupParts find_parts(const TriangleSoup& soup, std::span<const WindingOf> windings, StageWatch& watch) {
  EdgeFacts facts = read_edges(soup, windings, watch);
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  SoupParts result;
  result.odd_edges = std::move(facts.odd_edges);
  result.part_of_triangle.resize(soup.triangles.size());
  result.turned.resize(soup.triangles.size());
  std::vector<std::uint32_t> name(soup.triangles.size(), kNone);
  std::vector<Vec3d> apex;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const std::size_t root = facts.joined.find(t);
    const Vec3& corner = soup.vertices[soup.triangles[t][0]];
    if (name[root] == kNone) {
      name[root] = static_cast<std::uint32_t>(result.parts.size());
      apex.push_back(to_double(corner));
      result.parts.push_back({0, true, true, 0, {to_double(corner), to_double(corner)}});
    }
    const std::uint32_t p = name[root];
    SoupPart& part = result.parts[p];
    result.part_of_triangle[t] = p;
    result.turned[t] = windings[t] == WindingOf::Turned;
    ++part.triangles;
    part.sound = part.sound && facts.odd[t] == 0;
    part.oriented = part.oriented && facts.uneven[t] == 0;
    part.volume += (result.turned[t] != 0 ? -1.0 : 1.0) * six_volumes(soup, soup.triangles[t], apex[p]) / 6;
    for (const std::uint32_t v : soup.triangles[t]) grow(part.box, soup.vertices[v]);
  }
  for (SoupPart& part : result.parts) {
    part.oriented = part.oriented && part.sound;
    if (!part.oriented) part.volume = 0;
  }
  return result;
}

}  // namespace tetsoup
