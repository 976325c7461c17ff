#include "lattice/tet_complex.h"

#include <algorithm>

#include "base/tet_geometry.h"

namespace tetsoup {

TetComplex::TetComplex(Candidates& candidates) : candidates_(candidates) {
  const TetMesh& mesh = candidates.mesh;
  neighbours_.assign(mesh.tets.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  is_left_over_.assign(mesh.tets.size(), 0);
  tet_mark_.assign(mesh.tets.size(), 0);
  vertex_mark_.assign(mesh.vertices.size(), 0);
  storage_ = Groups<std::uint32_t>(mesh.vertices.size(), [&](const auto& put) {
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
      for (const std::uint32_t v : mesh.tets[t]) put(v, t);
  });
  around_.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) around_.push_back(storage_[v]);
  join_faces();
}

void TetComplex::join_faces() {
  const std::vector<Tet>& tets = candidates_.mesh.tets;
  Groups<FaceSide> by_lowest(around_.size(), [&](const auto& put) {
    for (std::uint64_t t = 0; t < tets.size(); ++t) {
      for (std::uint64_t i = 0; i < 4; ++i) {
        std::uint32_t a = tets[t][(i + 1) % 4], b = tets[t][(i + 2) % 4], c = tets[t][(i + 3) % 4];
        if (a > b) std::swap(a, b);
        if (b > c) std::swap(b, c);
        if (a > b) std::swap(a, b);
        put(a, {std::uint64_t{b} << 32 | c, 4 * t + i});
      }
    }
  });
  for (std::size_t v = 0; v < by_lowest.size(); ++v) {
    const std::span<FaceSide> sides = by_lowest[v];
    std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
      return a.others != b.others ? a.others < b.others : a.slot < b.slot;
    });
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      for (end = begin + 1; end < sides.size() && sides[end].others == sides[begin].others;) ++end;
      if (end - begin > 1) pair_faces(sides.subspan(begin, end - begin));
    }
  }
}

void TetComplex::pair_faces(std::span<FaceSide> run) {
  if (run.size() > 2) {
    std::stable_partition(run.begin(), run.end(), [&](const FaceSide& s) { return candidates_.kept[s.slot / 4] != 0; });
    for (const FaceSide& side : run.subspan(2)) is_left_over_[side.slot / 4] = 1;
  }
  neighbours_[run[0].slot / 4][run[0].slot % 4] = static_cast<std::uint32_t>(run[1].slot / 4);
  neighbours_[run[1].slot / 4][run[1].slot % 4] = static_cast<std::uint32_t>(run[0].slot / 4);
}

double TetComplex::volume(std::uint32_t t) const {
  const Tet& tet = corners(t);
  const auto at = [&](std::size_t i) { return to_double(candidates_.mesh.vertices[tet[i]]); };
  return signed_volume(at(0), at(1), at(2), at(3));
}

bool TetComplex::is_at_boundary(std::uint32_t t) const {
  return std::any_of(neighbours_[t].begin(), neighbours_[t].end(), [&](std::uint32_t n) { return !is_kept(n); });
}

bool TetComplex::is_sound(std::uint32_t v) const {
  std::size_t count = 0;
  std::uint32_t first = kNoTet;
  for (const std::uint32_t t : around_[v]) {
    if (!is_kept(t)) continue;
    if (count++ == 0) first = t;
  }
  return count == 0 || reached_if_ball(v, first) == count;
}

/// Seen from the vertex its tets are triangles on a sphere. Those joined to the first form a disc, or the whole sphere,
/// if corners - edges + triangles is 1, or 2 without a rim: every hole, and every corner they meet again, takes 1.
/// Returns their number, 0 if they form anything else.
std::size_t TetComplex::reached_if_ball(std::uint32_t v, std::uint32_t start) const {
  ++walk_;
  std::size_t triangles = 0, rim = 0, vertices = 0;
  stack_.assign(1, start);
  tet_mark_[start] = walk_;
  while (!stack_.empty()) {
    const std::uint32_t t = stack_.back();
    stack_.pop_back();
    ++triangles;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t w = corners(t)[i];
      if (w == v) continue;  // the face opposite the vertex is not at it
      if (vertex_mark_[w] != walk_) ++vertices;
      vertex_mark_[w] = walk_;
      const std::uint32_t n = neighbours_[t][i];
      if (!is_kept(n)) {
        ++rim;
      } else if (tet_mark_[n] != walk_) {
        tet_mark_[n] = walk_;
        stack_.push_back(n);
      }
    }
  }
  const std::size_t edges = (3 * triangles + rim) / 2;
  return vertices + triangles == edges + (rim > 0 ? 1 : 2) ? triangles : 0;
}

/// Marks the kept tets around `v` that faces at `v` join to `start`.
void TetComplex::mark_part(std::uint32_t v, std::uint32_t start) const {
  ++walk_;
  stack_.assign(1, start);
  tet_mark_[start] = walk_;
  while (!stack_.empty()) {
    const std::uint32_t t = stack_.back();
    stack_.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t n = neighbours_[t][i];
      if (corners(t)[i] == v || !is_kept(n) || tet_mark_[n] == walk_) continue;
      tet_mark_[n] = walk_;
      stack_.push_back(n);
    }
  }
}

/// Faces between the tet and tets that are not kept part with it.
void TetComplex::move_to_vertex(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
  const std::size_t moved = corner_of(corners(t), from);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t n = neighbours_[t][i];
    if (i == moved || n == kNoTet || is_kept(n)) continue;
    neighbours_[t][i] = kNoTet;
    std::replace(neighbours_[n].begin(), neighbours_[n].end(), t, kNoTet);
  }
  candidates_.mesh.tets[t][moved] = to;
}

std::size_t TetComplex::double_vertex(std::uint32_t v) {
  const std::span<std::uint32_t> all = around_[v];
  const auto absent_end = std::stable_partition(all.begin(), all.end(), [&](std::uint32_t t) { return !is_kept(t); });
  std::size_t doubled = 0;
  for (auto begin = absent_end, end = begin; begin != all.end(); begin = end) {
    mark_part(v, *begin);
    end = std::stable_partition(begin, all.end(), [&](std::uint32_t t) { return tet_mark_[t] == walk_; });
    if (begin == absent_end) {
      around_[v] = {all.begin(), end};
      continue;
    }
    const std::uint32_t copy = vertex_count();
    candidates_.mesh.vertices.push_back(candidates_.mesh.vertices[v]);
    vertex_mark_.push_back(0);
    for (const std::uint32_t t : std::span(begin, end)) move_to_vertex(t, v, copy);
    around_.emplace_back(begin, end);
    ++doubled;
  }
  if (doubled > 0)
    for (const std::uint32_t t : std::span(all.begin(), absent_end)) is_left_over_[t] = 1;
  return doubled;
}

}  // namespace tetsoup
