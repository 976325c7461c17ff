// Parts of the input by the names that its file gives, or by what is connected.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tetsoup/render_mesh.h"
#include "tetsoup/types.h"

namespace tetsoup::cli {

/// What makes a region: one kind of the file's names, or the connected parts.
enum class RegionsBy { Object, Group, Material, Part };

/// "object" and so on.
const char* word_of(RegionsBy by);

/// A label for every triangle, and what the labels are called.
struct PartLabels {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_triangles;
};

/// "part_1" the largest, and so on.
PartLabels connected_parts(const TriangleSoup& soup);

/// In the order of the file; what has no name comes last, as `rest`.
PartLabels label_by(const RenderMesh& surface, RegionsBy by, const std::string& rest);

/// 0 for the triangles that the name means, 1 for all others; empty if it means none. A name that the file gives goes
/// before that of a connected part.
std::vector<std::uint32_t> find_part(const RenderMesh& surface, const std::string& name);

/// "; it has object 'a', material 'b', connected part_1 to part_7", as far as a line holds them.
std::string known_names(const RenderMesh& surface);

}  // namespace tetsoup::cli
