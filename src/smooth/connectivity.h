// Who is next to whom in a tet mesh, made once per smoothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

/// A list of numbers for each vertex, all in one array.
class VertexLists {
 public:
  struct Entry {
    std::uint32_t vertex, item;
  };

  VertexLists() = default;
  /// Lists ascend and hold nothing twice.
  VertexLists(std::size_t vertex_count, const std::vector<Entry>& entries);

  std::span<const std::uint32_t> operator[](std::size_t vertex) const {
    return std::span(items_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> items_;
};

struct Connectivity {
  VertexLists tets;                           ///< Around each vertex.
  VertexLists neighbours;                     ///< Along the edges of the tets.
  std::vector<Triangle> triangles;            ///< Of the boundary.
  std::vector<std::uint32_t> boundary;        ///< Vertices of the boundary, ascending.
  std::vector<std::uint32_t> interior;        ///< Vertices inside, ascending.
  std::vector<std::uint8_t> is_bare;          ///< By vertex: it and all its neighbours lie on the boundary.
  VertexLists boundary_neighbours;            ///< Along the edges of the boundary triangles.
  VertexLists boundary_triangles;             ///< Around each vertex.
  std::vector<std::uint32_t> part_of_tet;     ///< Tets joined through vertices form one part.
  std::vector<std::uint32_t> part_of_vertex;  ///< 0 for a vertex without tets.
  std::size_t part_count = 0;
};

Connectivity connect(const TetMesh& mesh);

}  // namespace tetsoup
