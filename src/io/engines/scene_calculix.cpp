// CalculiX's scene: how the body sags under its own weight, standing on its foot or hanging from its pins.
#include <algorithm>
#include <span>

#include "io/engines/scene_parts.h"
#include "io/line_writer.h"
#include "io/model_parts.h"
#include "tetsoup/error.h"

namespace tetsoup {

namespace {

constexpr double kFootShare = 0.05;  // Of the height of a piece; what stands on the ground is as flat as that.
constexpr std::size_t kFewest = 4;   // Vertices that hold a piece.

constexpr std::string_view kScene = R"(** How a body sags under its own weight, in CalculiX: ccx @stem@_gravity
** Its material is that of the mesh file.
*INCLUDE, INPUT=@file@
*NSET, NSET=HELD_IN_SCENE
@held@
*BOUNDARY
HELD_IN_SCENE, 1, 3
*STEP
*STATIC
*DLOAD
EALL, GRAV, 9.81, @down@
*NODE FILE
U
*EL FILE
S
*EL PRINT, ELSET=EALL, TOTALS=ONLY
EVOL
*END STEP
)";

double height_of(const Vec3& v, UpAxis up) {
  return up == UpAxis::X ? v.x : up == UpAxis::Y ? v.y : v.z;
}

// Every piece needs something to stand on, or nothing determines where it is.
std::vector<std::uint32_t> held_vertices(const TetModel& model) {
  const std::vector<Vec3>& vertices = model.mesh.vertices;
  Unions pieces = pieces_of(model.mesh);
  std::vector<std::uint32_t> held = pinned_vertices(model);
  std::vector<bool> is_held(vertices.size());
  for (const std::uint32_t v : held) is_held[pieces.find(v)] = true;
  std::vector<std::vector<std::uint32_t>> members(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) members[pieces.find(v)].push_back(v);
  for (std::size_t piece = 0; piece < members.size(); ++piece) {
    std::vector<std::uint32_t>& list = members[piece];
    if (list.size() < kFewest || is_held[piece]) continue;
    const auto height = [&](std::uint32_t v) { return height_of(vertices[v], model.up); };
    std::stable_sort(list.begin(), list.end(), [&](std::uint32_t a, std::uint32_t b) { return height(a) < height(b); });
    const double foot = height(list.front()) + kFootShare * (height(list.back()) - height(list.front()));
    for (std::size_t i = 0; i < list.size() && (i < kFewest || height(list[i]) <= foot); ++i) held.push_back(list[i]);
  }
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace

std::string calculix_scene(const SceneInput& input) {
  constexpr std::size_t kPerLine = 8;
  std::string held;
  const std::vector<std::uint32_t> vertices = nodes_of(input.model, held_vertices(input.model));
  append_list(held, std::span(vertices), 1U, kPerLine, ", ");
  held.pop_back();
  const UpAxis up = input.model.up;
  // A line of its own would be a card of its own, be it in a file's name.
  if (std::any_of(input.mesh_file.begin(), input.mesh_file.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }))
    throw IoError("CalculiX's scene names the mesh's file, and '" + input.mesh_file +
                  "' has a line break or another control character in it; give the file another name");
  return filled(kScene, {{"stem", input.mesh_file.substr(0, input.mesh_file.rfind('.'))},
                         {"file", input.mesh_file},
                         {"held", held},
                         {"down", up == UpAxis::X   ? "-1, 0, 0"
                                  : up == UpAxis::Y ? "0, -1, 0"
                                                    : "0, 0, -1"}});
}

}  // namespace tetsoup
