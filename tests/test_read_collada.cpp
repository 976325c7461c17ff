// Collada: unit, axes, nodes and instances; polygons of all kinds; damage.
#include "soup_files.h"

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kCollada = SoupFormat::Collada;

std::string collada(const std::string& asset, const std::string& libraries, const std::string& nodes) {
  return "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"><asset>" + asset + "</asset>\n" + libraries +
         "<library_visual_scenes><visual_scene id=\"s\">" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

/// A square in the plane z = 0, with normals that the polygons have numbers for too.
std::string square(const std::string& polygons) {
  return "<library_geometries><geometry id=\"g\" name=\"square\"><mesh><source id=\"p\"><float_array id=\"pa\" "
         "count=\"12\">0 0 0\n1 0 0 1 1 0 0 1 0</float_array><technique_common><accessor source=\"#pa\" count=\"4\" "
         "stride=\"3\"/></technique_common></source><source id=\"n\"><float_array id=\"na\" count=\"3\">0 0 "
         "1</float_array></source>\n<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>" +
         polygons + "</mesh></geometry></library_geometries>";
}

const std::string kInputs =
    "<input semantic=\"NORMAL\" source=\"#n\" offset=\"0\"/><input semantic=\"VERTEX\" source=\"#v\" offset=\"1\"/>";
const std::string kTriangles =
    "<triangles count=\"2\" material=\"m\">" + kInputs + "<p>0 0 0 1 0 2 0 0 0 2 0 3</p></triangles>";
const std::string kShow = "<instance_geometry url=\"#g\"/>";
const std::vector<Triangle> kTwo = {{0, 1, 2}, {0, 2, 3}};

TEST(ReadCollada, polygons_of_every_kind_are_read) {
  for (const std::string& polygons :
       {kTriangles, "<polylist>" + kInputs + "<vcount>3 3</vcount><p>0 0 0 1 0 2 0 0 0 2 0 3</p></polylist>",
        "<polylist>" + kInputs + "<vcount>4</vcount><p>0 0 0 1 0 2 0 3</p></polylist>",
        "<polygons>" + kInputs + "<p>0 0 0 1 0 2</p><p>0 0 0 2 0 3</p></polygons>",
        "<trifans>" + kInputs + "<p>0 0 0 1 0 2 0 3</p></trifans>"}) {
    const TriangleSoup soup = parse(collada("", square(polygons), "<node>" + kShow + "</node>"), kCollada);
    EXPECT_EQ(soup.triangles, kTwo) << polygons;
    EXPECT_EQ(soup.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  }
  const std::string strip = "<tristrips>" + kInputs + "<p>0 0 0 1 0 3 0 2</p></tristrips>";
  EXPECT_EQ(parse(collada("", square(strip), "<node>" + kShow + "</node>"), kCollada).triangles,
            (std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}}));
}

TEST(ReadCollada, what_the_file_says_of_its_unit_and_its_axes_is_kept_to) {
  const auto corner = [](const std::string& asset) {
    return parse(collada(asset, square(kTriangles), "<node><translate>0 0 2</translate>" + kShow + "</node>"), kCollada)
        .vertices[1];
  };
  EXPECT_EQ(corner(""), (Vec3{1, 0, 2}));
  EXPECT_EQ(corner("<unit name=\"foot\" meter=\"0.25\"/><up_axis>Z_UP</up_axis>"), (Vec3{.25F, 0, .5F}));
  EXPECT_EQ(corner("<up_axis>Y_UP</up_axis>"), (Vec3{1, -2, 0}));
  EXPECT_EQ(corner("<up_axis>X_UP</up_axis>"), (Vec3{0, -2, 1}));
}

TEST(ReadCollada, transforms_are_applied_in_their_order_down_the_nodes) {
  const std::string nodes =
      "<node><translate>10 0 0</translate><rotate>0 0 2 90</rotate><scale>2 1 1</scale><node name=\"inner\">" + kShow +
      "</node></node><node><matrix>1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1</matrix><instance_node url=\"#lib\"/></node>";
  const std::string library = "<library_nodes><node id=\"lib\">" + kShow + "</node></library_nodes>";
  const TriangleSoup soup = parse(collada("", square(kTriangles) + library, nodes), kCollada);
  ASSERT_EQ(soup.vertices.size(), 8U);
  EXPECT_NEAR(soup.vertices[2].x, 10 - 1, 1e-6);
  EXPECT_NEAR(soup.vertices[2].y, 2, 1e-6);
  EXPECT_EQ(soup.vertices[6], (Vec3{1, 1, 5}));
}

TEST(ReadCollada, names_are_those_of_nodes_and_of_the_materials_that_instances_bind) {
  const std::string materials = "<library_materials><material id=\"mat\" name=\"Red\"/></library_materials>";
  const std::string bound =
      "<node name=\"a\"><instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"m\" "
      "target=\"#mat\"/></technique_common></bind_material></instance_geometry></node><node>" +
      kShow + "</node>";
  const RenderMesh mesh = parse_mesh(collada("", materials + square(kTriangles), bound), kCollada);
  EXPECT_EQ(mesh.parts, (std::vector<RenderMesh::Part>{{"a", "", "Red"}, {"square", "", "m"}}));
}

TEST(ReadCollada, a_skin_stands_in_the_pose_it_was_bound_in) {
  const std::string skin =
      "<library_controllers><controller id=\"c\"><skin source=\"#g\"><bind_shape_matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 "
      "1</bind_shape_matrix><source id=\"w\"><float_array id=\"wa\" count=\"1\">1</float_array></source></skin>"
      "</controller></library_controllers>";
  const TriangleSoup soup = parse(collada("", square(kTriangles) + skin,
                                          "<node><scale>100 100 100</scale><instance_controller url=\"#c\"/></node>"),
                                  kCollada);
  ASSERT_EQ(soup.vertices.size(), 4U);
  EXPECT_EQ(soup.vertices[2], (Vec3{2, 2, 0}));
}

TEST(ReadCollada, circles_and_endless_multiplication_are_errors_not_hangs) {
  EXPECT_ERROR(collada("", square(kTriangles), "<node id=\"a\"><instance_node url=\"#a\"/></node>"), kCollada,
               "nested too deeply, or in a circle");
  std::string doubled = "<node id=\"n0\"/>";
  for (int i = 1; i < 40; ++i) {
    const std::string below = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
    doubled += "<node id=\"n" + std::to_string(i) + "\">" + below + below + "</node>";
  }
  EXPECT_ERROR(collada("", square(kTriangles), doubled), kCollada, "its instances add up to more than");
}

TEST(ReadCollada, errors_name_the_line) {
  std::string bad = square(kTriangles);
  bad.replace(bad.find("1 0 0 1 1 0"), 1, "z");
  EXPECT_ERROR(collada("", bad, ""), kCollada, "sample, line 3: expected a number, found 'z'");
  EXPECT_ERROR(collada("", square(kTriangles), "<node><instance_geometry url=\"#h\"/></node>"), kCollada,
               "sample: geometry 'h' does not exist");
  EXPECT_ERROR(collada("<unit meter=\"0\"/>", "", ""), kCollada, "line 2: the unit is '0' metres");
}

TEST(ReadCollada, every_damage_is_survived) {
  const std::string sample =
      collada("<unit meter=\"0.01\"/><up_axis>Y_UP</up_axis>", square(kTriangles),
              "<node><translate>10 0 0</translate><rotate>0 0 2 90</rotate>" + kShow + "</node>");
  expect_damage_survived(sample, kCollada, 50'000, 22);
}

}  // namespace
}  // namespace tetsoup
