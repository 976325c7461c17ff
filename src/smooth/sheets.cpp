#include "smooth/sheets.h"

#include <algorithm>
#include <cmath>

#include "base/tet_geometry.h"
#include "smooth/facets.h"

namespace tetsoup {

namespace {

constexpr float kReach = 0.4F;        // Mean edges around a vertex: what moves farther in one pass waits for the next.
constexpr double kFewRefused = 0.05;  // Of the boundary vertices: so many may be held back by the last look.
constexpr double kSameWay = 0.05;     // Least cosine between normals of a patch and their mean: it is a height field.
constexpr std::size_t kMostAround = 64;  // Triangles of a patch; larger ones are not asked whether they are one.
constexpr int kMostBuckets = 64;         // Along an axis: about as many as lattices have cells.
constexpr std::int64_t kVerticesPerChunk = 256;

bool holds(const TetCorners& tet, const Vec3d& p) {
  return least_weight(tet, p) >= 0;
}

/// Equal positions get the same number: that of the first vertex there.
std::vector<std::uint32_t> first_in_place(const TetMesh& mesh) {
  const std::vector<Vec3>& p = mesh.vertices;
  std::vector<std::uint32_t> order(p.size()), place(p.size());
  for (std::uint32_t v = 0; v < p.size(); ++v) order[v] = v;
  const auto key = [&](std::uint32_t v) { return std::array<float, 3>{p[v].x, p[v].y, p[v].z}; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
  }
  return place;
}

}  // namespace

Sheets::Sheets(const Connectivity& links, const TetMesh& start)
    : links_(&links), boundary_index_(start.vertices.size(), 0) {
  std::vector<VertexLists::Entry> entries;
  for (std::uint32_t i = 0; i < links.boundary.size(); ++i) {
    const std::uint32_t v = links.boundary[i];
    boundary_index_[v] = i;
    for (const std::uint32_t w : links.boundary_neighbours[v]) {
      for (const std::uint32_t t : links.boundary_triangles[w]) {
        const Triangle& corners = links.triangles[t];
        if (std::find(corners.begin(), corners.end(), v) == corners.end()) entries.push_back({v, t});
      }
    }
  }
  around_ = VertexLists(start.vertices.size(), entries);
  link_across_edges(start);
  find_doubled(start);
  find_reach(start);
}

/// Where an edge has more than two triangles, the one beyond it is the first around the edge, seen from outside.
void Sheets::link_across_edges(const TetMesh& start) {
  std::vector<std::array<std::uint32_t, 4>> sides;  // ends of the edge, triangle, its corner opposite
  for (std::uint32_t t = 0; t < links_->triangles.size(); ++t) {
    const Triangle& c = links_->triangles[t];
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(c[(i + 1) % 3], c[(i + 2) % 3]);
      sides.push_back({a, b, t, i});
    }
  }
  std::sort(sides.begin(), sides.end());
  across_.resize(links_->triangles.size());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end][0] == sides[begin][0] && sides[end][1] == sides[begin][1]) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b, own, corner] = sides[i];
      std::uint32_t& beyond = across_[own][corner];
      double least = 5;  // above any turn
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t other = links_->triangles[sides[k][2]][sides[k][3]];
        const double turn = k == i ? 4 : end - begin == 2 ? 0 : turn_to(own, corner, other, start);
        if (turn < least) least = turn, beyond = other;
      }
    }
  }
}

/// How far a vertex is around a triangle's edge, from the triangle outwards: 0 to 4, which grows as the angle does.
double Sheets::turn_to(std::uint32_t triangle, std::size_t corner, std::uint32_t vertex, const TetMesh& mesh) const {
  const Triangle& t = links_->triangles[triangle];
  const auto at = [&](std::uint32_t v) { return to_double(mesh.vertices[v]); };
  const Vec3d origin = at(t[(corner + 1) % 3]), edge = at(t[(corner + 2) % 3]) - origin, own = at(t[corner]) - origin;
  const Vec3d across = own - edge * (dot(own, edge) / squared_length(edge)), other = at(vertex) - origin;
  const double x = dot(other, across) * length(edge), y = dot(other, cross(edge, own)), size = std::sqrt(x * x + y * y);
  return y >= 0 ? 1 - x / size : 3 + x / size;
}

void Sheets::find_doubled(const TetMesh& start) {
  const std::vector<std::uint32_t> place = first_in_place(start);
  find_copied_tets(start, place);
  std::vector<VertexLists::Entry> in_place, copies;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (!links_->tets[v].empty() && is_of_copied_tet_[v] == 0) in_place.push_back({place[v], v});
  }
  const VertexLists lists(start.vertices.size(), in_place);
  for (const auto& [first, v] : in_place) {
    if (lists[first].size() > 1) doubled_.push_back(v);
    for (const std::uint32_t w : lists[first]) {
      if (w != v) copies.push_back({v, w});
    }
  }
  copies_ = VertexLists(start.vertices.size(), copies);
}

void Sheets::find_copied_tets(const TetMesh& start, const std::vector<std::uint32_t>& place) {
  is_of_copied_tet_.assign(start.vertices.size(), 0);
  std::vector<std::pair<Tet, std::uint32_t>> tets;
  for (std::uint32_t t = 0; t < start.tets.size(); ++t) {
    Tet at = start.tets[t];
    if (std::all_of(at.begin(), at.end(), [&](std::uint32_t v) { return links_->boundary_triangles[v].empty(); }))
      continue;
    for (std::uint32_t& v : at) v = place[v];
    std::sort(at.begin(), at.end());
    tets.push_back({at, t});
  }
  std::sort(tets.begin(), tets.end());
  for (std::size_t i = 0; i + 1 < tets.size(); ++i) {
    if (tets[i].first != tets[i + 1].first) continue;
    for (const std::size_t k : {i, i + 1}) {
      for (const std::uint32_t v : start.tets[tets[k].second]) is_of_copied_tet_[v] = 1;
    }
  }
}

void Sheets::find_reach(const TetMesh& start) {
  reach_.assign(start.vertices.size(), 0);
  double sum = 0;
  for (const std::uint32_t v : links_->boundary) {
    double edges = 0;
    for (const std::uint32_t w : links_->boundary_neighbours[v]) {
      edges += length(to_double(start.vertices[w]) - to_double(start.vertices[v]));
    }
    const double mean = edges / static_cast<double>(links_->boundary_neighbours[v].size());
    reach_[v] = kReach * static_cast<float>(mean);
    sum += mean;
  }
  bucket_ = links_->boundary.empty() ? 1 : sum / static_cast<double>(links_->boundary.size());
}

std::array<int, 3> Sheets::bucket_of(const Vec3d& p) const {
  const auto along = [&](double way, int count) {
    return static_cast<int>(std::clamp(std::floor(way / bucket_), 0.0, static_cast<double>(count - 1)));
  };
  return {along(p.x - lo_.x, count_[0]), along(p.y - lo_.y, count_[1]), along(p.z - lo_.z, count_[2])};
}

std::size_t Sheets::index_of(const std::array<int, 3>& b) const {
  return static_cast<std::size_t>((b[2] * count_[1] + b[1]) * count_[0] + b[0]);
}

void Sheets::look_around(const TetMesh& mesh, StageWatch& watch) {
  const bool serves =
      !looked_.empty() && static_cast<double>(refused_) <= kFewRefused * static_cast<double>(links_->boundary.size());
  refused_ = 0;
  if (serves || links_->triangles.empty()) return;
  looked_ = mesh.vertices;
  std::vector<Disc> discs;
  Vec3d hi = to_double(mesh.vertices[links_->boundary[0]]);
  lo_ = hi, largest_ = 0;
  for (std::uint32_t t = 0; t < links_->triangles.size(); ++t) {
    discs.push_back(disc_around(t, mesh));
    lo_ = min(lo_, discs.back().centre), hi = max(hi, discs.back().centre);
    largest_ = std::max(largest_, discs.back().radius);
  }
  bucket_ = std::max(bucket_, std::max({hi.x - lo_.x, hi.y - lo_.y, hi.z - lo_.z}) / kMostBuckets);
  const auto count = [&](double way) { return static_cast<int>(std::floor(way / bucket_)) + 1; };
  count_ = {count(hi.x - lo_.x), count(hi.y - lo_.y), count(hi.z - lo_.z)};
  const std::size_t bucket_count = index_of({count_[0] - 1, count_[1] - 1, count_[2] - 1}) + 1;
  const Groups<Disc> buckets(bucket_count, [&](const auto& put) {
    for (const Disc& disc : discs) put(index_of(bucket_of(disc.centre)), disc);
  });
  near_.resize(links_->boundary.size());
  parallel_for(static_cast<std::int64_t>(near_.size()), kVerticesPerChunk, watch,
               [&](std::int64_t begin, std::int64_t end) {
                 std::vector<std::uint32_t> beside(links_->triangles.size(), kNone);
                 for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
                   gather(links_->boundary[i], mesh, buckets, beside, near_[i]);
                 }
               });
}

Sheets::Disc Sheets::disc_around(std::uint32_t triangle, const TetMesh& mesh) const {
  const Triangle& corners = links_->triangles[triangle];
  const TriangleCorners c = corners_at(mesh, corners);
  Disc disc{(c[0] + c[1] + c[2]) * (1.0 / 3), 0, 0, triangle};
  for (std::size_t i = 0; i < 3; ++i) {
    disc.radius = std::max(disc.radius, length(c[i] - disc.centre));
    disc.reach = std::max(disc.reach, static_cast<double>(reach_[corners[i]]));
  }
  return disc;
}

void Sheets::gather(std::uint32_t v, const TetMesh& mesh, const Groups<Disc>& buckets,
                    std::vector<std::uint32_t>& beside, std::vector<std::uint32_t>& near) const {
  near.clear();
  for (const auto& list : {links_->boundary_triangles[v], around_[v]}) {
    for (const std::uint32_t t : list) beside[t] = v;
  }
  const Vec3d at = to_double(mesh.vertices[v]);
  double radius = 0, reach = static_cast<double>(reach_[v]);
  for (const std::uint32_t w : links_->boundary_neighbours[v]) {
    radius = std::max(radius, length(to_double(mesh.vertices[w]) - at));
    reach = std::max(reach, static_cast<double>(reach_[w]));
  }
  const double far = radius + 2 * reach + largest_;
  const auto first = bucket_of(at - Vec3d{far, far, far}), last = bucket_of(at + Vec3d{far, far, far});
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      const std::size_t row = index_of({first[0], y, z});
      for (std::size_t b = row; b <= row + static_cast<std::size_t>(last[0] - first[0]); ++b) {
        for (const Disc& disc : buckets[b]) {
          const double away = radius + reach + disc.radius + disc.reach;
          if (squared_length(disc.centre - at) > away * away || beside[disc.triangle] == v) continue;
          if (!are_copied(v, disc.triangle) && !is_separate(v, disc, reach, mesh)) near.push_back(disc.triangle);
        }
      }
    }
  }
  std::sort(near.begin(), near.end());
}

/// Whether a vertex and a triangle belong to copies of tets.
bool Sheets::are_copied(std::uint32_t v, std::uint32_t triangle) const {
  const Triangle& corners = links_->triangles[triangle];
  const auto is_copied = [&](std::uint32_t w) { return is_of_copied_tet_[w] != 0; };
  return is_copied(v) && std::any_of(corners.begin(), corners.end(), is_copied);
}

/// Whether, seen along the line from the vertex to the triangle, its own triangles end well before that begins.
bool Sheets::is_separate(std::uint32_t vertex, const Disc& disc, double reach, const TetMesh& mesh) const {
  const Vec3d at = to_double(mesh.vertices[vertex]), way = disc.centre - at;
  double begin = squared_length(way), end = 0;
  const double apart = (reach + disc.reach) * std::sqrt(begin);
  for (const std::uint32_t w : links_->triangles[disc.triangle]) {
    begin = std::min(begin, dot(way, to_double(mesh.vertices[w]) - at));
  }
  for (const std::uint32_t w : links_->boundary_neighbours[vertex]) {
    end = std::max(end, dot(way, to_double(mesh.vertices[w]) - at));
    if (begin - end <= apart) return false;
  }
  return begin - end > apart;
}

/// Whether the triangles of the vertex and those around them all face one way: then they cannot cross each other.
bool Sheets::is_open_to_one_side(std::uint32_t vertex, const TetMesh& mesh) const {
  std::array<Vec3d, kMostAround> normals;
  std::size_t count = 0;
  Vec3d sum;
  for (const auto& list : {links_->boundary_triangles[vertex], around_[vertex]}) {
    for (const std::uint32_t triangle : list) {
      if (count == kMostAround) return false;
      const TriangleCorners t = corners_at(mesh, links_->triangles[triangle]);
      normals[count] = cross(t[1] - t[0], t[2] - t[0]);
      sum += normals[count++];
    }
  }
  const double least = kSameWay * kSameWay * squared_length(sum);
  return std::all_of(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(count), [&](const Vec3d& n) {
    const double along = dot(n, sum);
    return along > 0 && along * along > least * squared_length(n);
  });
}

/// Whether one triangle of the vertex, which was at `before`, crossed another one there.
bool Sheets::crossed_before(std::uint32_t vertex, std::uint32_t own, std::uint32_t other, const TetMesh& mesh,
                            const Vec3& before) const {
  const auto facet = [&](std::uint32_t t) {
    TriangleCorners corners = corners_at(mesh, links_->triangles[t]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (links_->triangles[t][i] == vertex) corners[i] = to_double(before);
    }
    return BoundaryFacet(corners);
  };
  return cross_each_other(facet(own), facet(other));
}

std::uint32_t Sheets::crossed_by(std::uint32_t vertex, const TetMesh& mesh, const Vec3* before) const {
  const auto near = std::span(near_[boundary_index_[vertex]]);
  const bool is_open = is_open_to_one_side(vertex, mesh);
  if (near.empty() && is_open) return kNone;
  BoundaryFan& fan = fan_;
  const Vec3d at = to_double(mesh.vertices[vertex]);
  fan.points.assign(1, at), fan.box = {at, at}, fan.facets.clear();
  for (const std::uint32_t w : links_->boundary_neighbours[vertex]) {
    fan.points.push_back(to_double(mesh.vertices[w]));
    fan.box = {min(fan.box.lo, fan.points.back()), max(fan.box.hi, fan.points.back())};
  }
  const auto own = links_->boundary_triangles[vertex];
  for (const std::uint32_t t : own) fan.facets.emplace_back(corners_at(mesh, links_->triangles[t]));
  const auto find = [&](std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t t : triangles) {
      const BoundaryFacet facet(corners_at(mesh, links_->triangles[t]));
      if (fan.is_beside(facet)) continue;
      for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i] == t || !cross_each_other(fan.facets[i], facet)) continue;
        if (before == nullptr || !crossed_before(vertex, own[i], t, mesh, *before)) return t;
      }
    }
    return kNone;
  };
  std::uint32_t found = find(near);
  if (found == kNone && !is_open) found = find(around_[vertex]);
  if (found == kNone && !is_open) found = find(own);
  return found;
}

/// Whether two triangles with a common edge have come to pass through each other, as the last two sides of a small hole
/// can without crossing anything else: they lie on the same side of the edge and changed places there.
bool Sheets::folds_over(std::uint32_t vertex, const Vec3& before, const TetMesh& mesh) const {
  for (const std::uint32_t own : links_->boundary_triangles[vertex]) {
    const Triangle& t = links_->triangles[own];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<std::uint32_t, 4> numbers{t[(i + 1) % 3], t[(i + 2) % 3], t[i], across_[own][i]};
      TetCorners p;
      for (std::size_t k = 0; k < 4; ++k) p[k] = to_double(mesh.vertices[numbers[k]]);
      const Vec3d edge = p[1] - p[0], a = p[2] - p[0], b = p[3] - p[0];
      if (dot(a, b) * squared_length(edge) <= dot(a, edge) * dot(b, edge)) continue;
      const double now = signed_volume(p);
      for (std::size_t k = 0; k < 4; ++k) {
        if (numbers[k] == vertex) p[k] = to_double(before);
      }
      if (now * signed_volume(p) < 0) return true;
    }
  }
  return false;
}

/// Sheets with common corners may come to lie in each other without crossing: so copies must also stay out of each
/// other's tets.
bool Sheets::stands_in_copy(std::uint32_t vertex, const TetMesh& mesh) const {
  const auto is_held = [&](std::uint32_t v, std::uint32_t by) {
    const Vec3d p = to_double(mesh.vertices[v]);
    const auto tets = links_->tets[by];
    return std::any_of(tets.begin(), tets.end(),
                       [&](std::uint32_t t) { return holds(corners_of(mesh, mesh.tets[t]), p); });
  };
  const auto copies = copies_[vertex];
  return std::any_of(copies.begin(), copies.end(),
                     [&](std::uint32_t copy) { return is_held(vertex, copy) || is_held(copy, vertex); });
}

bool Sheets::allow(std::uint32_t vertex, const Vec3& before, const TetMesh& mesh) {
  const Vec3d way = to_double(mesh.vertices[vertex]) - to_double(looked_[vertex]);
  const double reach = static_cast<double>(reach_[vertex]);
  if (squared_length(way) > reach * reach) {
    ++refused_;
    return false;
  }
  return crossed_by(vertex, mesh, &before) == kNone && !folds_over(vertex, before, mesh) &&
         !stands_in_copy(vertex, mesh);
}

}  // namespace tetsoup
