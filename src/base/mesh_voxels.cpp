// The tets are drawn into the voxel grid layer by layer, a row of voxels at a time.
#include "base/mesh_voxels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/bits.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"

namespace tetsoup {

namespace {

constexpr int kSlabLayers =
    4;  // Layers of voxels one thread draws at a time: long enough to pay, short enough to stop.
// Voxels. A centre so close outside a tet counts as in it, so that no centre falls through the seam of two tets.
constexpr double kSeam = 1e-6;
constexpr double kParallel =
    1e-12;  // A unit normal with a smaller x is parallel to the rows: no crossing to divide by.

struct VoxelBox {
  std::array<int, 3> lo{0, 0, 0}, hi{-1, -1, -1};  ///< Inclusive.
};

/// Half space: the inside is where dot(normal, p) + offset >= 0; unit normal, voxel units.
struct Plane {
  Vec3d normal;
  double offset = 0;
};

/// A tet in voxel units, where voxel centres are the integer points.
struct DrawnTet {
  std::array<Plane, 4> planes;
  VoxelBox box;
};

/// The voxels that are counted: the grid's, and beyond it as far as the mesh reaches, up to the grid's own length.
struct Canvas {
  std::array<int, 3> lo{0, 0, 0}, hi{-1, -1, -1};  ///< Inclusive; x spans whole words.
  std::size_t words_per_row = 0;

  explicit Canvas(const BitGrid& grid, const std::vector<TetCorners>& tets) {
    Vec3d low, high;
    for (const TetCorners& tet : tets) {
      for (const Vec3d& p : tet) low = min(low, p), high = max(high, p);
    }
    const int reach = *std::max_element(grid.frame.size.begin(), grid.frame.size.end());
    const std::array<double, 3> first{low.x, low.y, low.z}, last{high.x, high.y, high.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const int size = grid.frame.size[a];
      lo[a] = static_cast<int>(std::max<double>(-reach, std::floor(first[a])));
      hi[a] = static_cast<int>(std::clamp<double>(std::ceil(last[a]), size - 1, size - 1 + reach));
    }
    lo[0] = -64 * ((63 - lo[0]) / 64);
    words_per_row = std::max(static_cast<std::size_t>(hi[0] - lo[0]) / 64 + 1, grid.words_per_row + lead_words());
  }
  std::size_t lead_words() const { return static_cast<std::size_t>(-lo[0]) / 64; }
  std::size_t rows() const { return static_cast<std::size_t>(hi[1] - lo[1] + 1); }
};

std::vector<TetCorners> tets_in_voxels(const TetMesh& mesh, const GridFrame& frame) {
  std::vector<TetCorners> tets;
  tets.reserve(mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    if (!is_valid_tet(tet, mesh.vertices.size())) continue;
    const TetCorners p = corners_in_voxels(mesh, tet, frame);
    const double volume = signed_volume(p);
    if (std::isfinite(volume) && volume != 0) tets.push_back(p);
  }
  return tets;
}

VoxelBox box_of(const TetCorners& p, const Canvas& canvas) {
  const Vec3d low = min(min(p[0], p[1]), min(p[2], p[3]));
  const Vec3d high = max(max(p[0], p[1]), max(p[2], p[3]));
  const std::array<double, 3> first{low.x, low.y, low.z}, last{high.x, high.y, high.z};
  VoxelBox box;
  for (std::size_t a = 0; a < 3; ++a) {
    const double begin = canvas.lo[a], end = canvas.hi[a];
    box.lo[a] = static_cast<int>(std::clamp(std::ceil(first[a] - kSeam), begin, end + 1));
    box.hi[a] = static_cast<int>(std::clamp(std::floor(last[a] + kSeam), begin - 1, end));
  }
  return box;
}

DrawnTet prepare(const TetCorners& p, const Canvas& canvas) {
  DrawnTet drawn;
  drawn.box = box_of(p, canvas);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& face = kTetFaces[i];
    const Vec3d a = p[static_cast<std::size_t>(face[0])];
    Vec3d normal = cross(p[static_cast<std::size_t>(face[1])] - a, p[static_cast<std::size_t>(face[2])] - a);
    const double side = dot(normal, p[i] - a) < 0 ? -1 : 1;
    normal = normal * (side / length(normal));
    drawn.planes[i] = {normal, kSeam - dot(normal, a)};
  }
  return drawn;
}

/// Sets the bits begin..end (inclusive) of a row.
void set_bits(std::uint64_t* row, int begin, int end) {
  for (int word = begin / 64; word <= end / 64; ++word) {
    std::uint64_t mask = ~std::uint64_t{0};
    if (word == begin / 64) mask &= ~std::uint64_t{0} << (begin & 63);
    if (word == end / 64) mask &= ~std::uint64_t{0} >> (63 - (end & 63));
    row[word] |= mask;
  }
}

void draw_row(const DrawnTet& tet, int y, int z, const Canvas& canvas, std::uint64_t* row) {
  double begin = tet.box.lo[0], end = tet.box.hi[0];
  for (const Plane& plane : tet.planes) {
    const double at_zero = plane.normal.y * y + plane.normal.z * z + plane.offset;
    if (plane.normal.x > kParallel) {
      begin = std::max(begin, std::ceil(-at_zero / plane.normal.x));
    } else if (plane.normal.x < -kParallel) {
      end = std::min(end, std::floor(-at_zero / plane.normal.x));
    } else if (at_zero < 0) {
      return;
    }
  }
  if (begin <= end) set_bits(row, static_cast<int>(begin) - canvas.lo[0], static_cast<int>(end) - canvas.lo[0]);
}

/// For every slab the tets that reach into it, ascending.
std::vector<std::vector<std::uint32_t>> tets_of_slabs(const std::vector<DrawnTet>& tets, const Canvas& canvas) {
  std::vector<std::vector<std::uint32_t>> slabs(
      static_cast<std::size_t>((canvas.hi[2] - canvas.lo[2]) / kSlabLayers + 1));
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    const VoxelBox& box = tets[t].box;
    if (box.lo[0] > box.hi[0] || box.lo[1] > box.hi[1] || box.lo[2] > box.hi[2]) continue;
    const int last = (box.hi[2] - canvas.lo[2]) / kSlabLayers;
    for (int s = (box.lo[2] - canvas.lo[2]) / kSlabLayers; s <= last; ++s) {
      slabs[static_cast<std::size_t>(s)].push_back(t);
    }
  }
  return slabs;
}

/// One layer of voxels, of which only the rows [first, last] are in use.
struct Layer {
  std::vector<std::uint64_t> words;
  int first = 0, last = -1;
};

/// Counts the layer's voxels and clears it.
MeshVoxels count_layer(Layer& layer, int z, const Canvas& canvas, const BitGrid& inside) {
  MeshVoxels count;
  for (int y = layer.first; y <= layer.last; ++y) {
    const bool in_grid = z >= 0 && z < inside.frame.size[2] && y >= 0 && y < inside.frame.size[1];
    const std::uint64_t* voxels = in_grid ? inside.words.data() + inside.row(y, z) : nullptr;
    std::uint64_t* row = layer.words.data() + static_cast<std::size_t>(y - canvas.lo[1]) * canvas.words_per_row;
    for (std::size_t w = 0; w < canvas.words_per_row; ++w) {
      if (row[w] == 0) continue;
      const std::size_t from = w - canvas.lead_words();
      const std::uint64_t is_inside = in_grid && from < inside.words_per_row ? voxels[from] : 0;
      count += {bit_count(row[w]), bit_count(row[w] & is_inside)};
      row[w] = 0;
    }
  }
  return count;
}

MeshVoxels count_slab(int slab, const std::vector<std::uint32_t>& tets, const std::vector<DrawnTet>& drawn,
                      const Canvas& canvas, const BitGrid& inside) {
  MeshVoxels sum;
  Layer layer{std::vector<std::uint64_t>(canvas.rows() * canvas.words_per_row)};
  const int first = canvas.lo[2] + slab * kSlabLayers;
  for (int z = first; z < first + kSlabLayers && z <= canvas.hi[2]; ++z) {
    layer.first = canvas.hi[1];
    layer.last = canvas.lo[1];
    for (const std::uint32_t t : tets) {
      const VoxelBox& box = drawn[t].box;
      if (z < box.lo[2] || z > box.hi[2]) continue;
      layer.first = std::min(layer.first, box.lo[1]);
      layer.last = std::max(layer.last, box.hi[1]);
      for (int y = box.lo[1]; y <= box.hi[1]; ++y) {
        draw_row(drawn[t], y, z, canvas,
                 layer.words.data() + static_cast<std::size_t>(y - canvas.lo[1]) * canvas.words_per_row);
      }
    }
    sum += count_layer(layer, z, canvas, inside);
  }
  return sum;
}

}  // namespace

MeshVoxels count_mesh_voxels(const TetMesh& mesh, const BitGrid& inside, StageWatch& watch) {
  const std::vector<TetCorners> tets = tets_in_voxels(mesh, inside.frame);
  const Canvas canvas(inside, tets);
  std::vector<DrawnTet> drawn;
  drawn.reserve(tets.size());
  for (const TetCorners& tet : tets) drawn.push_back(prepare(tet, canvas));
  const auto slabs = tets_of_slabs(drawn, canvas);
  return parallel_sum<MeshVoxels>(static_cast<std::int64_t>(slabs.size()), 1, watch, [&](std::int64_t s, std::int64_t) {
    return count_slab(static_cast<int>(s), slabs[static_cast<std::size_t>(s)], drawn, canvas, inside);
  });
}

}  // namespace tetsoup
