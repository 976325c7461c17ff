// Surfaces of labelled voxels, through their corners.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/require.h"
#include "base/vec.h"
#include "tetsoup/label_volume.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

using Key = std::uint64_t;  // Of a corner of voxels.

/// Four corners of a face between two voxels, counter-clockwise from outside.
struct Side {
  std::array<Key, 4> corners{};
  std::uint32_t label = 0;
};

class Sides {
 public:
  explicit Sides(const LabelVolume& volume) : volume_(volume) {
    const auto& [nx, ny, nz] = volume.size;
    constexpr std::size_t kMost = 1U << 20;
    for (const std::size_t n : volume.size) require(n >= 1 && n <= kMost, "voxels along an axis", n, "1 to 2^20");
    require(volume.labels.size() == nx * ny * nz, "number of labels", volume.labels.size(), "that of the voxels");
    spanned_ = dot(cross(volume.steps[0], volume.steps[1]), volume.steps[2]);
    require(spanned_ != 0 && std::isfinite(spanned_), "volume of a voxel", spanned_, "finite and not zero");
  }

  /// Sides of each label, or of all of them as one.
  enum class Of { EachLabel, All };
  std::vector<Side> find(Of of) const {
    std::vector<Side> sides;
    const auto label = [&](std::size_t x, std::size_t y, std::size_t z) {
      const std::uint32_t own = volume_.labels[x + volume_.size[0] * (y + volume_.size[1] * z)];
      return of == Of::All ? std::min(own, 1U) : own;
    };
    std::array<std::size_t, 3> at{};
    for (at[2] = 0; at[2] < volume_.size[2]; ++at[2]) {
      for (at[1] = 0; at[1] < volume_.size[1]; ++at[1]) {
        for (at[0] = 0; at[0] < volume_.size[0]; ++at[0]) {
          const std::uint32_t own = label(at[0], at[1], at[2]);
          if (own == 0) continue;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool up : {false, true}) {
              auto next = at;
              next[axis] += up ? 1 : std::size_t(0) - 1;  // Wraps below 0, and is beyond the size then.
              if (next[axis] < volume_.size[axis] && label(next[0], next[1], next[2]) == own) continue;
              sides.push_back({corners(at, axis, up), own});
            }
          }
        }
      }
    }
    return sides;
  }

  Vec3d place(Key key) const {
    const std::size_t across = volume_.size[0] + 1, layer = across * (volume_.size[1] + 1);
    const auto along = [](std::size_t i) { return static_cast<double>(i) - 0.5; };
    const auto whole = static_cast<std::size_t>(key);
    return volume_.origin + volume_.steps[0] * along(whole % across) +
           volume_.steps[1] * along(whole % layer / across) + volume_.steps[2] * along(whole / layer);
  }

 private:
  std::array<Key, 4> corners(const std::array<std::size_t, 3>& at, std::size_t axis, bool up) const {
    std::array<Key, 4> keys{};
    const std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (std::size_t i = 0; i < 4; ++i) {
      auto corner = at;
      if (up) ++corner[axis];
      if (i == 1 || i == 2) ++corner[first];
      if (i >= 2) ++corner[second];
      keys[i] = corner[0] + (volume_.size[0] + 1) * (corner[1] + Key{volume_.size[1] + 1} * corner[2]);
    }
    if (up != (spanned_ > 0)) std::swap(keys[1], keys[3]);
    return keys;
  }

  const LabelVolume& volume_;
  double spanned_ = 0;
};

/// Corners, each once, and triangles of the sides.
TriangleSoup soup_of(const Sides& grid, const std::vector<Side>& sides) {
  std::vector<Key> keys;
  for (const Side& side : sides) keys.insert(keys.end(), side.corners.begin(), side.corners.end());
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<Vec3d> places;
  places.reserve(keys.size());
  for (const Key key : keys) places.push_back(grid.place(key));
  std::vector<Triangle> triangles;
  for (const Side& side : sides) {
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i)
      v[i] = static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), side.corners[i]) - keys.begin());
    triangles.push_back({v[0], v[1], v[2]});
    triangles.push_back({v[0], v[2], v[3]});
  }
  return make_soup(places, std::move(triangles));
}

std::string name_of(const LabelVolume& volume, std::uint32_t label) {
  for (const auto& [value, name] : volume.names)
    if (value == label && !name.empty()) return name;
  return "label_" + std::to_string(label);
}

}  // namespace

RenderMesh label_surfaces(const LabelVolume& volume) {
  const Sides grid(volume);
  std::vector<Side> sides = grid.find(Sides::Of::EachLabel);
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.label < b.label; });
  TriangleSoup soup = soup_of(grid, sides);
  RenderMesh mesh;
  mesh.origin = soup.origin;
  mesh.vertices = std::move(soup.vertices);
  std::uint32_t last = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const std::uint32_t label = sides[t / 2].label;
    if (label != last) mesh.parts.push_back({name_of(volume, label), {}, {}});
    last = label;
    mesh.corners.insert(mesh.corners.end(), soup.triangles[t].begin(), soup.triangles[t].end());
    mesh.face_sizes.push_back(3);
    mesh.face_parts.push_back(static_cast<std::uint32_t>(mesh.parts.size() - 1));
  }
  return mesh;
}

TriangleSoup label_hull(const LabelVolume& volume) {
  const Sides grid(volume);
  return soup_of(grid, grid.find(Sides::Of::All));
}

}  // namespace tetsoup
