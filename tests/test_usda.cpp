// OpenUSD text: the whole of a small model, and names and numbers that must not break it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "io/tet_writers.h"
#include "io/usda_writer.h"

namespace tetsoup {
namespace {

TetModel one_tet() {
  TetModel model;
  model.name = "soft body";
  model.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1F}}, {{0, 1, 2, 3}}};
  model.regions[0].material = {.density = 1000, .young = 1e5, .poisson = 0.25, .metres_per_unit = 0.01};
  return model;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
#define EXPECT_HOLDS(text, part) EXPECT_TRUE(holds(text, part)) << (part) << "\nis not in\n" << (text)

TEST(Usda, a_tet_alone_is_a_body_with_a_material) {
  const std::string points = "[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0.1)]";
  EXPECT_EQ(usda_text(one_tet()), R"(#usda 1.0
(
    defaultPrim = "soft_body"
    doc = "Written by tetsoup"
    kilogramsPerUnit = 1
    metersPerUnit = 0.01
    upAxis = "Z"
)

def Xform "soft_body" (
    prepend apiSchemas = ["PhysicsDeformableBodyAPI", "OmniPhysicsDeformableBodyAPI"]
    kind = "component"
)
{

    def Material "PhysicsMaterial" (
        prepend apiSchemas = ["PhysicsMaterialAPI", "PhysicsVolumeDeformableMaterialAPI", "OmniPhysicsDeformableMaterialAPI"]
    )
    {
        float physics:density = 0.001
        float physics:youngsModulus = 1000
        float physics:poissonsRatio = 0.25
        float omniphysics:density = 0.001
        float omniphysics:youngsModulus = 1000
        float omniphysics:poissonsRatio = 0.25
    }

    def TetMesh "SimulationMesh" (
        prepend apiSchemas = ["PhysicsVolumeDeformableSimAPI", "OmniPhysicsVolumeDeformableSimAPI", "PhysicsDeformablePoseAPI:default", "PhysicsCollisionAPI", "MaterialBindingAPI"]
    )
    {
        float3[] extent = [(0, 0, 0), (1, 1, 0.1)]
        rel material:binding:physics = </soft_body/PhysicsMaterial>
        point3f[] omniphysics:restShapePoints = )" +
                                      points + R"(
        int4[] omniphysics:restTetVtxIndices = [(0, 1, 2, 3)]
        uniform token orientation = "rightHanded"
        point3f[] physics:deformablePose:default:points = )" +
                                      points + R"(
        uniform token[] physics:deformablePose:default:purposes = ["bindPose"]
        point3f[] physics:restShapePoints = )" +
                                      points + R"(
        point3f[] points = )" + points +
                                      R"(
        int3[] surfaceFaceVertexIndices = [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)]
        int4[] tetVertexIndices = [(0, 1, 2, 3)]
    }
}
)");
}

TEST(Usda, regions_and_pins_are_subsets_under_legal_names) {
  TetModel model = one_tet();
  model.mesh.vertices.push_back({1, 1, 1});
  model.mesh.tets.push_back({1, 2, 3, 4});
  model.regions = {{"left \"lung\"", {}}, {"", {}}};
  model.tet_regions = {0, 1};
  model.pins = {{"foot", {0, 3}}};
  const std::string text = usda_text(model);
  EXPECT_HOLDS(text, R"(
        def GeomSubset "left_lung" (
            displayName = "left \"lung\""
        )
        {
            uniform token elementType = "tetrahedron"
            uniform token familyName = "region"
            int[] indices = [0]
        }

        def GeomSubset "region"
        {
            uniform token elementType = "tetrahedron"
            uniform token familyName = "region"
            int[] indices = [1]
        }

        def GeomSubset "foot"
        {
            uniform token elementType = "point"
            uniform token familyName = "pin"
            int[] indices = [0, 3]
        }
)");
  EXPECT_HOLDS(text, "uniform token subsetFamily:region:familyType = \"partition\"\n");
  EXPECT_HOLDS(text, "uniform token subsetFamily:pin:familyType = \"unrestricted\"\n");
}

TEST(Usda, regions_share_a_material_that_keeps_the_mass) {
  TetModel model = one_tet();
  model.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  model.mesh.tets.push_back({1, 2, 3, 4});  // Twice the volume of the first.
  model.regions = {{"a", {.density = 900, .young = 3e5}}, {"b", {.density = 1200, .young = 6e5}}};
  model.tet_regions = {0, 1};
  EXPECT_HOLDS(usda_text(model), "float physics:density = 1100\n        float physics:youngsModulus = 5e+05\n");
}

TetModel with_render_mesh() {
  TetModel model = one_tet();
  RenderMesh& mesh = model.render;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.face_sizes = {4, 3, 3};
  mesh.corners = {0, 1, 2, 3, 0, 1, 9, 2, 1, 0};
  mesh.parts = {{"box", "", "steel 1"}, {"box", "lid", ""}};
  mesh.face_parts = {0, 0, 1};
  mesh.texcoords = {{0, 0}, {1, 0.5F}};
  mesh.corner_texcoords = {0, 1, 1, 0, 0, 0, 0, RenderMesh::kNone, 1, 0};
  mesh.normals = {{0, 0, 1}};
  mesh.corner_normals.assign(10, 0);
  model.embedding.tets = {0, 0, 0, 0};
  model.embedding.weights.assign(4, {1, 0, 0, 0});
  model.embedding.distances.assign(4, 0);
  return model;
}

TEST(Usda, the_render_mesh_keeps_its_polygons_and_hangs_on_the_tets) {
  const std::string text = usda_text(with_render_mesh()), points = "[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]";
  EXPECT_HOLDS(text, "        uniform token purpose = \"guide\"\n");
  // The second face has a vertex that does not exist.
  EXPECT_HOLDS(text, R"(
    def Mesh "RenderMesh" (
        prepend apiSchemas = ["PhysicsDeformablePoseAPI:default", "OmniPhysicsDeformablePoseAPI:default"]
    )
    {
        point3f[] deformablePose:default:omniphysics:points = )" +
                         points + R"(
        uniform token[] deformablePose:default:omniphysics:purposes = ["bindPose"]
        uniform bool doubleSided = 1
        float3[] extent = [(0, 0, 0), (1, 1, 0)]
        int[] faceVertexCounts = [4, 3]
        int[] faceVertexIndices = [0, 1, 2, 3, 2, 1, 0]
        point3f[] physics:deformablePose:default:points = )" +
                         points + R"(
        uniform token[] physics:deformablePose:default:purposes = ["bindPose"]
        point3f[] points = )" +
                         points + R"(
        normal3f[] primvars:normals = [(0, 0, 1)] (interpolation = "faceVarying")
        int[] primvars:normals:indices = [0, 0, 0, 0, 0, 0, 0]
        texCoord2f[] primvars:st = [(0, 0), (1, 0.5), (0, 0)] (interpolation = "faceVarying")
        int[] primvars:st:indices = [0, 1, 1, 0, 2, 1, 0]
        int[] primvars:tetsoup:tet = [0, 0, 0, 0] (interpolation = "vertex")
        float4[] primvars:tetsoup:weights = [(1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)] (interpolation = "vertex")
        uniform token subdivisionScheme = "none"
        uniform token subsetFamily:materialBind:familyType = "nonOverlapping"
        uniform token subsetFamily:group:familyType = "nonOverlapping"
        uniform token subsetFamily:object:familyType = "nonOverlapping"

        def GeomSubset "steel_1" (
            displayName = "steel 1"
        )
        {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [0]
        }

        def GeomSubset "lid"
        {
            uniform token elementType = "face"
            uniform token familyName = "group"
            int[] indices = [1]
        }

        def GeomSubset "box"
        {
            uniform token elementType = "face"
            uniform token familyName = "object"
            int[] indices = [0, 1]
        }
    }
}
)");
}

TEST(Usda, normals_that_some_corners_lack_are_left_out) {
  TetModel model = with_render_mesh();
  model.render.corner_normals[0] = RenderMesh::kNone;
  EXPECT_FALSE(holds(usda_text(model), "primvars:normals"));
}

TEST(Usda, numbers_that_are_none_are_spelt_as_usd_spells_them) {
  TetModel model = with_render_mesh();
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  model.render.vertices[3] = {std::copysign(nan, -1.0F), inf, -inf};
  const std::string text = usda_text(model);
  EXPECT_HOLDS(text, "(1, 1, 0), (nan, inf, -inf)]\n");
  EXPECT_HOLDS(text, "float3[] extent = [(0, 0, 0), (1, 1, 0)]\n        int[] faceVertexCounts");
}

TEST(Usda, texts_cannot_break_out_of_their_quotes) {
  EXPECT_EQ(usda_string("a\"b\\c\nd\xFF"), "\"a\\\"b\\\\c d\xEF\xBF\xBD\"");
}

TEST(Usda, up_is_y_or_z_or_turned_there) {
  TetModel model = one_tet();
  model.up = UpAxis::Y;
  EXPECT_HOLDS(usda_text(model), "    upAxis = \"Y\"\n");
  model.up = UpAxis::X;
  EXPECT_HOLDS(usda_text(model), "    upAxis = \"Z\"\n");
  EXPECT_HOLDS(usda_text(model),
               "    float xformOp:rotateY = -90\n    uniform token[] xformOpOrder = [\"xformOp:rotateY\"]\n");
}

}  // namespace
}  // namespace tetsoup
