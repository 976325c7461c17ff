// The input's own polygons in USD, and the embedding that moves them.
#include <map>
#include <string>
#include <vector>

#include "base/origin.h"
#include "io/usda_text.h"

namespace tetsoup {

namespace {

constexpr std::uint32_t kNone = RenderMesh::kNone;

/// A face and where its corners begin.
struct Face {
  std::size_t index = 0, first_corner = 0, size = 0;
};

std::vector<Face> usable_faces(const RenderMesh& mesh) {
  std::vector<Face> faces;
  std::size_t first = 0;
  for (std::size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    const std::size_t size = mesh.face_sizes[f];
    bool usable = size >= 3;
    for (std::size_t c = first; c < first + size; ++c) usable = usable && mesh.corners[c] < mesh.vertices.size();
    if (usable) faces.push_back({f, first, size});
    first += size;
  }
  return faces;
}

/// What the corners of these faces choose out of a list; `missing` for those that choose nothing.
std::vector<std::uint32_t> choices_of(const std::vector<std::uint32_t>& choices, const std::vector<Face>& faces,
                                      std::uint32_t missing) {
  std::vector<std::uint32_t> chosen;
  for (const Face& face : faces)
    for (std::size_t c = face.first_corner; c < face.first_corner + face.size; ++c)
      chosen.push_back(choices[c] == kNone ? missing : choices[c]);
  return chosen;
}

/// Corners without a texture coordinate get one more, at zero.
void write_texcoords(UsdaWriter& usd, const RenderMesh& mesh, const std::vector<Face>& faces) {
  if (mesh.corner_texcoords.empty()) return;
  const auto missing = static_cast<std::uint32_t>(mesh.texcoords.size());
  const std::vector<std::uint32_t> chosen = choices_of(mesh.corner_texcoords, faces, missing);
  std::vector<Vec2> texcoords = mesh.texcoords;
  for (const std::uint32_t choice : chosen)
    if (choice == texcoords.size()) texcoords.push_back({});
  usd.array("texCoord2f[] primvars:st", texcoords, "interpolation = \"faceVarying\"");
  usd.array("int[] primvars:st:indices", chosen);
}

/// Only if no corner lacks one: a viewer makes better ones than zero.
void write_normals(UsdaWriter& usd, const RenderMesh& mesh, const std::vector<Face>& faces) {
  if (mesh.corner_normals.empty()) return;
  const std::vector<std::uint32_t> chosen = choices_of(mesh.corner_normals, faces, kNone);
  for (const std::uint32_t choice : chosen)
    if (choice == kNone) return;
  usd.array("normal3f[] primvars:normals", mesh.normals, "interpolation = \"faceVarying\"");
  usd.array("int[] primvars:normals:indices", chosen);
}

void write_embedding_primvars(UsdaWriter& usd, const TetModel& model) {
  if (model.embedding.tets.size() != model.render.vertices.size()) return;
  usd.array("int[] primvars:tetsoup:tet", model.embedding.tets, "interpolation = \"vertex\"");
  usd.array("float4[] primvars:tetsoup:weights", model.embedding.weights, "interpolation = \"vertex\"");
}

/// One name that faces can have, as a family of subsets.
struct Family {
  const char* name;
  std::string RenderMesh::Part::*name_of;
};
constexpr Family kFamilies[] = {{"materialBind", &RenderMesh::Part::material},
                                {"group", &RenderMesh::Part::group},
                                {"object", &RenderMesh::Part::object}};

bool has_names(const RenderMesh& mesh, const Family& family) {
  for (const RenderMesh::Part& part : mesh.parts)
    if (!(part.*family.name_of).empty() && !mesh.face_parts.empty()) return true;
  return false;
}

void write_subsets(UsdaWriter& usd, const RenderMesh& mesh, const std::vector<Face>& faces) {
  LegalNames names;
  for (const Family& family : kFamilies) {
    if (!has_names(mesh, family)) continue;
    std::map<std::string, std::size_t> places;
    std::vector<std::string> order;
    std::vector<std::vector<std::uint32_t>> elements;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const std::string& name = mesh.parts[mesh.face_parts[faces[i].index]].*family.name_of;
      if (name.empty()) continue;
      const auto [place, is_new] = places.try_emplace(name, order.size());
      if (is_new) {
        order.push_back(name);
        elements.emplace_back();
      }
      elements[place->second].push_back(static_cast<std::uint32_t>(i));
    }
    for (std::size_t i = 0; i < order.size(); ++i)
      write_usda_subset(usd, names, order[i], "face", family.name, elements[i]);
  }
}

}  // namespace

void write_usda_render_mesh(UsdaWriter& usd, const TetModel& model) {
  const RenderMesh& mesh = model.render;
  const std::vector<Face> faces = usable_faces(mesh);
  const std::vector<Vec3> points = recounted(mesh.vertices, mesh.origin, model.mesh.origin);
  std::vector<std::uint32_t> sizes, corners;
  for (const Face& face : faces) {
    sizes.push_back(static_cast<std::uint32_t>(face.size));
    for (std::size_t c = 0; c < face.size; ++c) corners.push_back(mesh.corners[face.first_corner + c]);
  }
  usd.open("Mesh", "RenderMesh",
           {usda_schemas({"PhysicsDeformablePoseAPI:default", "OmniPhysicsDeformablePoseAPI:default"})});
  usd.array("point3f[] deformablePose:default:omniphysics:points", points);
  usd.line("uniform token[] deformablePose:default:omniphysics:purposes", "[\"bindPose\"]");
  usd.line("uniform bool doubleSided", "1");
  write_usda_extent(usd, points);
  usd.array("int[] faceVertexCounts", sizes);
  usd.array("int[] faceVertexIndices", corners);
  usd.array("point3f[] physics:deformablePose:default:points", points);
  usd.line("uniform token[] physics:deformablePose:default:purposes", "[\"bindPose\"]");
  usd.array("point3f[] points", points);
  write_normals(usd, mesh, faces);
  write_texcoords(usd, mesh, faces);
  write_embedding_primvars(usd, model);
  usd.line("uniform token subdivisionScheme", "\"none\"");
  for (const Family& family : kFamilies)
    if (has_names(mesh, family))
      usd.line("uniform token subsetFamily:" + std::string(family.name) + ":familyType", "\"nonOverlapping\"");
  write_subsets(usd, mesh, faces);
  usd.close();
}

}  // namespace tetsoup
