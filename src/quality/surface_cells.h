// A soup's surface as cells of a grid: one point of it in each.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct SurfaceCell {
  std::uint64_t key;  ///< 21 bits each of x, y, z.
  Vec3d at;
  std::uint32_t triangle;
};

/// One point of each part of the soup in every cell that it passes through, but for corners of cells; by key. Cells are
/// made larger where the soup is too large for so small ones. O(area in cells log cells + triangles).
/// @param part  Of every triangle.
std::vector<SurfaceCell> find_surface_cells(const TriangleSoup& soup, const std::vector<std::uint32_t>& part,
                                            double& cell);

/// Groups of cells that touch, corners included; numbered from 0. O(cells log cells).
std::vector<std::uint32_t> label_cells(const std::vector<SurfaceCell>& cells, std::uint32_t& groups);

}  // namespace tetsoup
