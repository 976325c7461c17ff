// A model as OpenUSD text: a body with its simulation mesh, its material, and the render mesh that it moves.
//
// Two families of schemas say the same: `Physics...` of the proposal for UsdPhysics, which Newton reads, and
// `OmniPhysics...`, which Isaac Sim reads. Newton makes an attribute of every array on the tet mesh that it does not
// know and its builder refuses those, so that regions and pins are subsets, prims of their own.
#include "io/usda_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/tet_geometry.h"
#include "io/raw_numbers.h"
#include "io/tet_writers.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

/// For attributes that hold floats.
std::string real(double value) {
  std::string text;
  append_float(text, narrow(value));
  return text;
}

bool has_render_mesh(const TetModel& model) {
  return !model.render.vertices.empty();
}

/// Y or Z; USD knows no other.
const char* up_axis(const TetModel& model) {
  return model.up == UpAxis::Y ? "\"Y\"" : "\"Z\"";
}

/// One material for all: density by volume gives the mesh its mass, and the others go along with it.
Material mean_material(const TetModel& model) {
  if (!has_regions(model)) return in_mesh_units(model.regions[0].material);
  Material sum{0, 0, 0, model.regions[0].material.metres_per_unit};
  double volume = 0;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const double v = signed_volume(corners_of(model.mesh, model.mesh.tets[t]));
    if (!(v > 0)) continue;
    const Material& material = model.regions[region_of(model, t)].material;
    volume += v;
    sum.density += v * material.density;
    sum.young += v * material.young;
    sum.poisson += v * material.poisson;
  }
  if (!(volume > 0)) return in_mesh_units(model.regions[0].material);
  for (double* value : {&sum.density, &sum.young, &sum.poisson}) *value /= volume;
  return in_mesh_units(sum);
}

void write_material(UsdaWriter& usd, const std::string& name, const Material& material) {
  usd.open(
      "Material", name,
      {usda_schemas({"PhysicsMaterialAPI", "PhysicsVolumeDeformableMaterialAPI", "OmniPhysicsDeformableMaterialAPI"})});
  for (const char* family : {"physics", "omniphysics"}) {
    const std::string prefix = std::string("float ") + family + ':';
    usd.line(prefix + "density", real(material.density));
    usd.line(prefix + "youngsModulus", real(material.young));
    usd.line(prefix + "poissonsRatio", real(material.poisson));
  }
  usd.close();
}

void write_subsets(UsdaWriter& usd, const TetModel& model) {
  LegalNames names;
  if (has_regions(model)) {
    const auto tets = tets_by_region(model);
    for (std::size_t r = 0; r < tets.size(); ++r)
      write_usda_subset(usd, names, model.regions[r].name.empty() ? "region" : model.regions[r].name, "tetrahedron",
                        "region", tets[r]);
  }
  for (const VertexSet& pin : model.pins)
    write_usda_subset(usd, names, pin.name.empty() ? "pin" : pin.name, "point", "pin", pin.vertices);
}

void write_tet_mesh(UsdaWriter& usd, const TetModel& model, const std::string& material_path) {
  const TetMesh& mesh = model.mesh;
  usd.open("TetMesh", "SimulationMesh",
           {usda_schemas({"PhysicsVolumeDeformableSimAPI", "OmniPhysicsVolumeDeformableSimAPI",
                          "PhysicsDeformablePoseAPI:default", "PhysicsCollisionAPI", "MaterialBindingAPI"})});
  write_usda_extent(usd, mesh.vertices);
  usd.line("rel material:binding:physics", '<' + material_path + '>');
  usd.array("point3f[] omniphysics:restShapePoints", mesh.vertices);
  usd.array("int4[] omniphysics:restTetVtxIndices", mesh.tets);
  usd.line("uniform token orientation", "\"rightHanded\"");
  usd.array("point3f[] physics:deformablePose:default:points", mesh.vertices);
  usd.line("uniform token[] physics:deformablePose:default:purposes", "[\"bindPose\"]");
  usd.array("point3f[] physics:restShapePoints", mesh.vertices);
  usd.array("point3f[] points", mesh.vertices);
  if (has_render_mesh(model)) usd.line("uniform token purpose", "\"guide\"");
  if (has_regions(model)) usd.line("uniform token subsetFamily:region:familyType", "\"partition\"");
  if (!model.pins.empty()) usd.line("uniform token subsetFamily:pin:familyType", "\"unrestricted\"");
  usd.array("int3[] surfaceFaceVertexIndices", boundary_triangles(mesh));
  usd.array("int4[] tetVertexIndices", mesh.tets);
  write_subsets(usd, model);
  usd.close();
}

/// What the file says of itself.
std::string description(const TetModel& model) {
  std::string text = "Written by tetsoup";
  if (model.stiffness_factor != 1)
    text += "; calibrated: Young's modulus is " + real(model.stiffness_factor) +
            " times that of the body that these few tets stand for, which are too stiff";
  return text;
}

}  // namespace

void write_usda_extent(UsdaWriter& usd, std::span<const Vec3> points) {
  std::array<Vec3, 2> box{};
  bool any = false;
  for (const Vec3& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    box = any ? std::array{min(box[0], p), max(box[1], p)} : std::array{p, p};
    any = true;
  }
  usd.array("float3[] extent", std::span<const Vec3>(box));
}

void write_usda_subset(UsdaWriter& usd, LegalNames& names, const std::string& name, std::string_view type,
                       std::string_view family, const std::vector<std::uint32_t>& elements) {
  const std::string legal = names.make(name, family);
  usd.open("GeomSubset", legal,
           legal == name ? std::vector<std::string>{} : std::vector{"displayName = " + usda_string(name)});
  usd.line("uniform token elementType", '"' + std::string(type) + '"');
  usd.line("uniform token familyName", '"' + std::string(family) + '"');
  usd.array("int[] indices", elements);
  usd.close();
}

std::string usda_text(const TetModel& model) {
  LegalNames names;
  const std::string body = names.make(model.name, "body");
  UsdaWriter usd({"defaultPrim = \"" + body + '"', "doc = " + usda_string(description(model)), "kilogramsPerUnit = 1",
                  "metersPerUnit = " + number(model.regions[0].material.metres_per_unit),
                  std::string("upAxis = ") + up_axis(model)});
  usd.open("Xform", body,
           {usda_schemas({"PhysicsDeformableBodyAPI", "OmniPhysicsDeformableBodyAPI"}), "kind = \"component\""});
  std::string order;
  if (model.up == UpAxis::X) {
    usd.line("float xformOp:rotateY", "-90");
    order = "\"xformOp:rotateY\"";
  }
  if (!(model.mesh.origin == Vec3d{})) {
    const auto& [x, y, z] = model.mesh.origin;
    usd.line("double3 xformOp:translate", '(' + number(x) + ", " + number(y) + ", " + number(z) + ')');
    order += order.empty() ? "\"xformOp:translate\"" : ", \"xformOp:translate\"";
  }
  if (!order.empty()) usd.line("uniform token[] xformOpOrder", '[' + order + ']');
  write_material(usd, "PhysicsMaterial", mean_material(model));
  write_tet_mesh(usd, model, '/' + body + "/PhysicsMaterial");
  if (has_render_mesh(model)) write_usda_render_mesh(usd, model);
  usd.close();
  return usd.take();
}

}  // namespace tetsoup
