// Netgen's volume meshes. Its tets are negative: the first two corners change places.
#include <array>
#include <string>
#include <vector>

#include "base/origin.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "io/text_capacity.h"
#include "io/tet_writers.h"

namespace tetsoup {

namespace {

// A triangle counter-clockwise from outside of domain `inner`; domain 0 is the outside of all.
struct SurfaceElement {
  Triangle corners;
  std::uint32_t inner, outer, surface;
};

// All faces between two domains lie on one surface, and each domain's faces to the outside on one: domains 1 and 2 have
// surfaces 1 and 2, then come those between domains, in the order in which they are met.
class Surfaces {
 public:
  explicit Surfaces(std::size_t domains) {
    for (std::size_t d = 1; d <= domains; ++d) sides_.push_back({static_cast<std::uint32_t>(d), 0});
  }
  std::uint32_t number(std::uint32_t inner, std::uint32_t outer) {
    const std::array<std::uint32_t, 2> wanted{inner, outer};
    std::size_t i = 0;
    while (i < sides_.size() && sides_[i] != wanted) ++i;
    if (i == sides_.size()) sides_.push_back(wanted);
    return static_cast<std::uint32_t>(i + 1);
  }
  const std::vector<std::array<std::uint32_t, 2>>& sides() const { return sides_; }

 private:
  std::vector<std::array<std::uint32_t, 2>> sides_;
};

std::vector<SurfaceElement> surface_elements(const TetModel& model, Surfaces& surfaces) {
  const std::vector<TetFace> faces = sorted_faces(model.mesh);
  std::vector<SurfaceElement> elements;
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    end = face_run_end(faces, begin);
    const auto domain = [&](std::size_t i) { return region_of(model, faces[i].slot / 4) + 1; };
    std::size_t owner = begin;
    std::uint32_t outer = 0;
    if (end - begin == 2) {
      outer = domain(begin + 1);
      if (outer < domain(begin)) {
        owner = begin + 1;
        outer = domain(begin);
      }
    }
    if (end - begin > 2 || outer == domain(owner)) continue;
    const Tet& tet = model.mesh.tets[faces[owner].slot / 4];
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = tet[static_cast<std::size_t>(kTetFaces[faces[owner].slot % 4][k])];
    elements.push_back({corners, domain(owner), outer, surfaces.number(domain(owner), outer)});
  }
  return elements;
}

void append_names(std::string& text, const char* section, const std::vector<std::string>& names) {
  text += section;
  append_line(text, names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    append_number(text, i + 1);
    text += ' ' + names[i] + '\n';
  }
}

}  // namespace

std::string netgen_text(const TetModel& model) {
  const TetMesh& mesh = model.mesh;
  Surfaces surfaces(model.regions.size());
  const std::vector<SurfaceElement> elements = surface_elements(model, surfaces);
  std::string text = text_for(mesh);
  text += "# tetsoup\nmesh3d\ndimension\n3\ngeomtype\n0\n\n# surfnr bcnr domin domout np p1 p2 p3\nsurfaceelements\n";
  append_line(text, elements.size());
  for (const SurfaceElement& e : elements)
    append_line(text, e.surface, e.surface, e.inner, e.outer, 3, e.corners[0] + 1, e.corners[1] + 1, e.corners[2] + 1);
  text += "\n# matnr np p1 p2 p3 p4\nvolumeelements\n";
  append_line(text, mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    append_line(text, region_of(model, i) + 1, 4, t[1] + 1, t[0] + 1, t[2] + 1, t[3] + 1);
  }
  text += "\npoints\n";
  append_line(text, mesh.vertices.size());
  for (const Vec3d& v : placed_points(mesh.vertices, mesh.origin)) append_line(text, v.x, v.y, v.z);
  LegalNames legal;
  const std::vector<std::string> names = region_names(model, legal);
  append_names(text, "\nmaterials\n", names);
  std::vector<std::string> sides;
  for (const auto& [inner, outer] : surfaces.sides())
    sides.push_back(outer == 0 ? "outside_of_" + names[inner - 1] : names[inner - 1] + "_to_" + names[outer - 1]);
  append_names(text, "\nbcnames\n", sides);
  return text + "\nendmesh\n";
}

}  // namespace tetsoup
