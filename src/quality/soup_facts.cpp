#include "quality/soup_facts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/groups.h"
#include "base/unions.h"
#include "base/vec.h"

namespace tetsoup {

namespace {

constexpr double kFlatCosine = 0.99939;  ///< Of 2 degrees: below, two triangles are one plane;
constexpr double kSharpCosine = 0.5;     ///< of 60 degrees: above, their edge is one that a mesh should have.
constexpr double kSliver = 1e-9;         ///< Of the size's square: triangles below have no normal to speak of.

/// One side of a triangle, in the group of its lower end.
struct Side {
  std::uint32_t high, triangle;
  std::uint8_t number;  ///< 0..2: from this corner to the next.
  bool upward;          ///< Runs from the lower end to the higher one.
};

Groups<Side> sides_of(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  Groups<Side> sides(vertex_count, [&](const auto& put) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (!is_triangle(triangles[t])) continue;
      for (std::uint8_t i = 0; i < 3; ++i) {
        const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1U) % 3U];
        put(std::min(a, b), Side{std::max(a, b), t, i, a < b});
      }
    }
  });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(sides[v].begin(), sides[v].end(), [](const Side& a, const Side& b) {
      return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
  }
  return sides;
}

/// visit(run) for the sides of every edge.
template <class Visit>
void visit_edges(const Groups<Side>& sides, const Visit& visit) {
  for (std::size_t v = 0; v < sides.size(); ++v) {
    const auto group = sides[v];
    for (std::size_t begin = 0, end = 0; begin < group.size(); begin = end) {
      for (end = begin + 1; end < group.size() && group[end].high == group[begin].high;) ++end;
      visit(group.subspan(begin, end - begin));
    }
  }
}

Vec3d normal_of(const TriangleSoup& soup, const Triangle& t) {
  const Vec3d a = to_double(soup.vertices[t[0]]);
  return cross(to_double(soup.vertices[t[1]]) - a, to_double(soup.vertices[t[2]]) - a);
}

void number_parts(const TriangleSoup& soup, SoupFacts& facts) {
  Unions vertices(soup.vertices.size());
  for (const Triangle& t : soup.triangles) vertices.join(t[0], t[1]), vertices.join(t[0], t[2]);
  std::vector<std::uint32_t> number(soup.vertices.size(), ~0U);
  facts.part.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    std::uint32_t& n = number[vertices.find(t[0])];
    if (n == ~0U) n = facts.parts++;
    facts.part.push_back(n);
  }
}

/// The neighbour across each side: its triangle, and whether it has to be turned over to agree.
struct Neighbour {
  std::uint32_t triangle;
  bool turned;
};
using Neighbours = std::vector<std::array<Neighbour, 3>>;

/// Empty if an edge has not two triangles. `agree` tells whether all windings do.
Neighbours find_neighbours(const TriangleSoup& soup, const Groups<Side>& sides, bool& agree) {
  Neighbours neighbours(soup.triangles.size());
  bool closed = true;
  agree = true;
  visit_edges(sides, [&](std::span<const Side> run) {
    if (run.size() != 2) return void(closed = false);
    const bool turned = run[0].upward == run[1].upward;
    if (turned) agree = false;
    neighbours[run[0].triangle][run[0].number] = {run[1].triangle, turned};
    neighbours[run[1].triangle][run[1].number] = {run[0].triangle, turned};
  });
  return closed ? neighbours : Neighbours{};
}

/// Turns all triangles like the first of their part; false if they cannot be.
bool turn_alike(const TriangleSoup& soup, const Neighbours& neighbours, std::vector<std::int8_t>& turn) {
  turn.assign(soup.triangles.size(), 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < turn.size(); ++first) {
    if (turn[first] != 0 || !is_triangle(soup.triangles[first])) continue;
    turn[first] = 1;
    for (open.assign(1, first); !open.empty();) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (const auto& [other, turned] : neighbours[t]) {
        const auto wanted = static_cast<std::int8_t>(turned ? -turn[t] : turn[t]);
        if (turn[other] == 0) turn[other] = wanted, open.push_back(other);
        if (turn[other] != wanted) return false;
      }
    }
  }
  return true;
}

/// Turns whole parts so that their volume is positive; where windings agree all over, all at once.
void turn_outwards(const TriangleSoup& soup, bool agree, SoupFacts& facts) {
  std::vector<double> volumes(agree ? 1 : facts.parts, 0.0);
  const auto part_of = [&](std::size_t t) { return agree ? 0 : facts.part[t]; };
  const Vec3d origin = soup.vertices.empty() ? Vec3d{} : to_double(soup.vertices[0]);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& c = soup.triangles[t];
    volumes[part_of(t)] += facts.turn[t] / 6.0 *
                           dot(to_double(soup.vertices[c[0]]) - origin,
                               cross(to_double(soup.vertices[c[1]]) - origin, to_double(soup.vertices[c[2]]) - origin));
  }
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (volumes[part_of(t)] < 0) facts.turn[t] = static_cast<std::int8_t>(-facts.turn[t]);
  for (const double volume : volumes) facts.volume += std::abs(volume);
}

bool is_flat(const TriangleSoup& soup, const Groups<Side>& sides) {
  const Box3 box = box_of(soup.vertices);
  const double size = std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
  bool flat = true, any = false;
  visit_edges(sides, [&](std::span<const Side> run) {
    const Vec3d a = normal_of(soup, soup.triangles[run[0].triangle]),
                b = normal_of(soup, soup.triangles[run[1].triangle]);
    const double la = length(a), lb = length(b);
    if (std::min(la, lb) <= kSliver * size * size) return;
    any = true;
    const double cosine = std::abs(dot(a, b)) / (la * lb);
    if (cosine < kFlatCosine && cosine > kSharpCosine) flat = false;
  });
  return any && flat;
}

}  // namespace

SoupFacts find_soup_facts(const TriangleSoup& soup) {
  SoupFacts facts;
  number_parts(soup, facts);
  for (const Triangle& t : soup.triangles) facts.area += length(normal_of(soup, t)) / 2;
  const Groups<Side> sides = sides_of(soup.triangles, soup.vertices.size());
  bool agree = false;
  const Neighbours neighbours = find_neighbours(soup, sides, agree);
  facts.closed = soup.triangles.size() > 3 && !neighbours.empty() && turn_alike(soup, neighbours, facts.turn);
  if (!facts.closed) return facts;
  turn_outwards(soup, agree, facts);
  facts.tunnels = count_tunnels(soup.triangles, soup.vertices.size());
  facts.flat = is_flat(soup, sides);
  return facts;
}

double count_tunnels(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  Unions vertices(vertex_count);
  std::vector<char> used(vertex_count, 0);
  double faces = 0, corners = 0, parts = 0;
  for (const Triangle& t : triangles) {
    if (!is_triangle(t)) continue;
    ++faces;
    vertices.join(t[0], t[1]), vertices.join(t[0], t[2]);
    for (const std::uint32_t v : t) used[v] = 1;
  }
  for (std::size_t v = 0; v < vertex_count; ++v)
    if (used[v] != 0) ++corners, parts += vertices.find(v) == v ? 1 : 0;
  return parts - (corners - faces / 2) / 2;  // a closed surface has three edges for two faces
}

}  // namespace tetsoup
