// tetsoup::io: images whose voxels have labels, as segmented scans are, made surfaces that the mesher takes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tetsoup/render_mesh.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Labels on a regular grid, x fastest; what has label 0 is outside. A mask is a volume with one label.
struct LabelVolume {
  std::array<std::size_t, 3> size{};
  std::vector<std::uint32_t> labels;
  std::array<Vec3d, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< From a voxel to the next one along x, y, z.
  Vec3d origin;                                                   ///< Centre of the first voxel.
  std::vector<std::pair<std::uint32_t, std::string>> names;       ///< Of labels, where they are known.
};

/// Reads NRRD: `.nrrd`, or `.nhdr` with its data in one file beside it; raw, gzip or text, whole numbers of any type in
/// three dimensions, with spacings or directions; names of segments as 3D Slicer writes them. Lengths and directions
/// are those of the file, whatever space it names.
/// @throws IoError  if it is not what it says, or holds other numbers than labels.
LabelVolume read_label_volume(const std::filesystem::path& path);
/// The same from memory; data in other files are refused.
LabelVolume parse_label_volume(std::span<const std::byte> bytes, std::string_view name);

/// Whether the file is NRRD by its first bytes.
bool is_label_volume(const std::filesystem::path& path);

/// The closed surface of every label by itself, through the corners of voxels: an object of its name, or "label_3".
/// For regions.
/// @throws InvalidInput  if sizes do not fit together, or the steps span no volume.
RenderMesh label_surfaces(const LabelVolume& volume);

/// The surface between what has a label and what is outside: what the mesher takes.
/// @throws InvalidInput  likewise.
TriangleSoup label_hull(const LabelVolume& volume);

}  // namespace tetsoup
