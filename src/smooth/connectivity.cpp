#include "smooth/connectivity.h"

#include <algorithm>
#include <limits>

#include "base/tet_faces.h"
#include "base/tet_geometry.h"

namespace tetsoup {

namespace {

constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();

VertexLists tets_around(const TetMesh& mesh) {
  std::vector<VertexLists::Entry> entries;
  entries.reserve(4 * mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::uint32_t v : mesh.tets[t]) entries.push_back({v, t});
  }
  return {mesh.vertices.size(), entries};
}

VertexLists edges_of_tets(const TetMesh& mesh) {
  std::vector<VertexLists::Entry> entries;
  entries.reserve(12 * mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    for (const auto& [i, j] : kTetEdges) {
      const std::uint32_t a = tet[static_cast<std::size_t>(i)], b = tet[static_cast<std::size_t>(j)];
      entries.push_back({a, b});
      entries.push_back({b, a});
    }
  }
  return {mesh.vertices.size(), entries};
}

VertexLists edges_of_triangles(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  std::vector<VertexLists::Entry> entries;
  entries.reserve(6 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    entries.insert(entries.end(), {{a, b}, {b, a}, {b, c}, {c, b}, {c, a}, {a, c}});
  }
  return {vertex_count, std::move(entries)};
}

VertexLists triangles_around(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  std::vector<VertexLists::Entry> entries;
  entries.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) entries.push_back({v, t});
  }
  return {vertex_count, entries};
}

/// Numbers the parts by their first tet.
void find_parts(const TetMesh& mesh, Connectivity& links) {
  std::vector<std::uint32_t> part(mesh.vertices.size(), kNoPart);
  std::vector<std::uint32_t> open;
  for (const Tet& tet : mesh.tets) {
    if (part[tet[0]] != kNoPart) continue;
    const auto id = static_cast<std::uint32_t>(links.part_count++);
    part[tet[0]] = id;
    open.push_back(tet[0]);
    while (!open.empty()) {
      const std::uint32_t v = open.back();
      open.pop_back();
      for (const std::uint32_t w : links.neighbours[v]) {
        if (part[w] != kNoPart) continue;
        part[w] = id;
        open.push_back(w);
      }
    }
  }
  for (const Tet& tet : mesh.tets) links.part_of_tet.push_back(part[tet[0]]);
  for (std::uint32_t& p : part) p = p == kNoPart ? 0 : p;
  links.part_of_vertex = std::move(part);
}

void split_vertices(std::size_t vertex_count, Connectivity& links) {
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (!links.boundary_neighbours[v].empty()) {
      links.boundary.push_back(v);
    } else if (!links.tets[v].empty()) {
      links.interior.push_back(v);
    }
  }
}

/// In a layer one tet thick, all vertices are.
void find_bare(Connectivity& links) {
  links.is_bare.assign(links.part_of_vertex.size(), 0);
  const auto is_inside = [&](std::uint32_t v) { return links.boundary_neighbours[v].empty(); };
  for (const std::uint32_t v : links.boundary) {
    const auto around = links.neighbours[v];
    links.is_bare[v] = std::none_of(around.begin(), around.end(), is_inside);
  }
}

}  // namespace

VertexLists::VertexLists(std::size_t vertex_count, const std::vector<Entry>& entries) : begin_(vertex_count + 1, 0) {
  for (const Entry& entry : entries) ++begin_[entry.vertex + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begin_[v + 1] += begin_[v];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  items_.resize(entries.size());
  for (const Entry& entry : entries) items_[next[entry.vertex]++] = entry.item;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto first = items_.begin() + static_cast<std::ptrdiff_t>(begin_[v]);
    const auto last = items_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]);
    std::sort(first, last);
    begin_[v] = kept;
    kept = static_cast<std::size_t>(
        std::copy(first, std::unique(first, last), items_.begin() + static_cast<std::ptrdiff_t>(kept)) -
        items_.begin());
  }
  begin_[vertex_count] = kept;
  items_.resize(kept);
}

Connectivity connect(const TetMesh& mesh) {
  Connectivity links;
  links.tets = tets_around(mesh);
  links.neighbours = edges_of_tets(mesh);
  links.triangles = lone_faces(mesh, sorted_faces(mesh));
  links.boundary_neighbours = edges_of_triangles(mesh.vertices.size(), links.triangles);
  links.boundary_triangles = triangles_around(mesh.vertices.size(), links.triangles);
  split_vertices(mesh.vertices.size(), links);
  find_parts(mesh, links);
  find_bare(links);
  return links;
}

}  // namespace tetsoup
