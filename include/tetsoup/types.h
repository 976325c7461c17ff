// tetsoup: the plain structs that travel between the stages, and the conventions they all follow.
//
// Lengths are in the soup's own unit unless a name ends in `_voxels` or `_cells`; angles are radians; right-handed
// axes. Tets are positive: dot(cross(b - a, c - a), d - a) > 0. Boundary triangles are counter-clockwise seen from
// outside. Grids run x fastest; values sit at voxel centres.
//
// Coordinates are floats, counted from an `origin` in double precision: it is zero unless the input lies far from zero
// for its size, as in map coordinates. The stages work on what is counted from it; boxes and planes that users give and
// reports that they read are in the input's own place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetsoup {

struct Vec3 {
  float x = 0, y = 0, z = 0;
  bool operator==(const Vec3&) const = default;
};

struct Vec3d {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec3d&) const = default;
};

/// Axis-aligned box; empty where `hi` lies below `lo`.
struct Box3 {
  Vec3d lo, hi;
  bool operator==(const Box3&) const = default;
};

using Triangle = std::array<std::uint32_t, 3>;
using Tet = std::array<std::uint32_t, 4>;

/// Where a vertex lies in the input's own place.
inline Vec3d placed(const Vec3& vertex, const Vec3d& origin) {
  if (origin == Vec3d{}) return {vertex.x, vertex.y, vertex.z};  // -0 stays what it is
  return {origin.x + vertex.x, origin.y + vertex.y, origin.z + vertex.z};
}

/// Any triangles at all: open, crossing, unoriented, duplicated, degenerate, non-finite.
struct TriangleSoup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  Vec3d origin{};  ///< That the vertices are counted from.
};

struct TetMesh {
  std::vector<Vec3> vertices;
  std::vector<Tet> tets;
  Vec3d origin{};  ///< That the vertices are counted from.
};

/// Where a regular grid of cubic voxels lies. The grid is the voxels over the soup's box plus `pad` voxels on every
/// side.
struct GridFrame {
  std::array<int, 3> size{0, 0, 0};  ///< Voxels along x, y, z, padding included.
  int pad = 0;                       ///< Voxels added on each side of the soup's box.
  Vec3d origin;                      ///< Centre of voxel (0, 0, 0).
  double voxel_size = 1;             ///< Edge of a voxel.
  Vec3d soup_origin{};               ///< The soup's own, which `origin` is counted from.

  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  }
  bool contains(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2];
  }
  bool operator==(const GridFrame&) const = default;
};

template <class T>
struct Grid {
  GridFrame frame;
  std::vector<T> values;  ///< (nz, ny, nx), x fastest.

  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(frame.size[0]) *
               (static_cast<std::size_t>(y) + static_cast<std::size_t>(frame.size[1]) * static_cast<std::size_t>(z));
  }
  T at(int x, int y, int z) const { return values[index(x, y, z)]; }
};

/// Values of a grid of which most may be unknown, that is infinite: 64 voxels along x make a block, as they make a word
/// of a BitGrid, and a block without a known value takes no memory.
struct BlockGrid {
  static constexpr int kBlock = 64;
  static constexpr int kSlab = 8;  ///< Layers of z whose values are stored together.
  struct Slab {
    std::vector<std::uint32_t> places;  ///< (layers, ny, blocks_per_row): the block's place in `values`; 0: unknown.
    std::vector<float> values;          ///< 64 a block, in the order of `places`; the first block is all infinity.
    bool operator==(const Slab&) const = default;
  };

  GridFrame frame;
  std::size_t blocks_per_row = 0;
  std::vector<Slab> slabs;  ///< Layers 0 to 7, 8 to 15, ...

  /// The 64 values of block `b` of a row; those beyond the row's end are infinite.
  const float* block(std::size_t b, int y, int z) const {
    const Slab& slab = slabs[static_cast<std::size_t>(z / kSlab)];
    const std::size_t row =
        static_cast<std::size_t>(z % kSlab) * static_cast<std::size_t>(frame.size[1]) + static_cast<std::size_t>(y);
    return slab.values.data() + std::size_t{kBlock} * slab.places[row * blocks_per_row + b];
  }
  float at(int x, int y, int z) const { return block(static_cast<std::size_t>(x / kBlock), y, z)[x % kBlock]; }
  bool operator==(const BlockGrid&) const = default;
};

/// One bit a voxel: 64 voxels along x in a word, every row of voxels starts a new word, unused bits are zero.
struct BitGrid {
  GridFrame frame;
  std::size_t words_per_row = 0;
  std::vector<std::uint64_t> words;  ///< (nz, ny, words_per_row)

  std::size_t row(int y, int z) const {
    return words_per_row *
           (static_cast<std::size_t>(y) + static_cast<std::size_t>(frame.size[1]) * static_cast<std::size_t>(z));
  }
  bool test(int x, int y, int z) const {
    return (words[row(y, z) + static_cast<std::size_t>(x >> 6)] >> (x & 63)) & 1U;
  }
};

}  // namespace tetsoup
