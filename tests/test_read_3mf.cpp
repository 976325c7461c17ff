// 3MF: what is to be built, and where; packages of one part and of several, and damage.
#include "soup_files.h"
#include "zip_files.h"

namespace tetsoup {
namespace {

using namespace test;

constexpr SoupFormat kThreeMf = SoupFormat::ThreeMf;
const std::string kTriangle =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>\n<vertex x=\"0\" y=\"2\" "
    "z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh>";
const std::string kRelations =
    "<?xml version=\"1.0\"?><Relationships><Relationship Target=\"/3D/own name.model\" Id=\"r\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

std::string model(const std::string& resources, const std::string& items) {
  return "<?xml version=\"1.0\"?>\n<model unit=\"millimeter\"><resources>" + resources + "</resources>\n<build>" +
         items + "</build></model>";
}

std::string package(const std::string& text) {
  return zip_of({{"_rels/.rels", kRelations, ""}, {"3D/own name.model", text, ""}});
}

std::string object(const std::string& id, const std::string& content, const std::string& more = "") {
  return "<object id=\"" + id + "\" " + more + ">" + content + "</object>\n";
}

/// A triangle, and an assembly of two of them, one of them turned by a quarter about z and moved.
std::string assembly() {
  return package(model(object("1", kTriangle, "name=\"bolt &amp; nut\"") +
                           object("2",
                                  "<components><component objectid=\"1\"/><component objectid=\"1\" "
                                  "transform=\"0 1 0 -1 0 0 0 0 1 10 20 30\"/></components>"),
                       "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 100 0 0\"/>"));
}

TEST(Read3mf, components_stand_where_item_and_component_put_them) {
  const TriangleSoup soup = parse(assembly(), kThreeMf);
  ASSERT_EQ(soup.vertices.size(), 6U);
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
  const Vec3 expected[] = {{100, 0, 0}, {101, 0, 0}, {100, 2, 0}, {110, 20, 30}, {110, 21, 30}, {108, 20, 30}};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(soup.vertices[i].x + static_cast<float>(soup.origin.x), expected[i].x) << i;
    EXPECT_EQ(soup.vertices[i].y + static_cast<float>(soup.origin.y), expected[i].y) << i;
    EXPECT_EQ(soup.vertices[i].z + static_cast<float>(soup.origin.z), expected[i].z) << i;
  }
  EXPECT_EQ(parse_mesh(assembly(), kThreeMf).parts, (std::vector<RenderMesh::Part>{{"bolt & nut", "", ""}}));
}

TEST(Read3mf, only_what_is_to_be_built_is_read_and_all_where_nothing_is_said) {
  const std::string objects = object("1", kTriangle) + object("2", kTriangle);
  EXPECT_EQ(parse(package(model(objects, "<item objectid=\"2\"/>")), kThreeMf).triangles.size(), 1U);
  EXPECT_EQ(parse(package(model(objects, "")), kThreeMf).triangles.size(), 2U);
}

TEST(Read3mf, objects_of_other_parts_are_followed) {
  const std::string root =
      model(object("1", "<components><component p:path=\"/3D/Objects/a.model\" objectid=\"7\"/></components>"),
            "<item objectid=\"1\"/>");
  const std::string bytes = zip_of({{"3D/3dmodel.model", root, ""},  // the usual name, without relations
                                    {"3D/Objects/a.model", model(object("7", kTriangle), ""), ""}});
  EXPECT_EQ(parse(bytes, kThreeMf).triangles.size(), 1U);
  EXPECT_ERROR(zip_of({{"3D/3dmodel.model", root, ""}}), kThreeMf, "there is no part '3D/Objects/a.model'");
}

TEST(Read3mf, materials_are_those_of_the_object_or_the_triangle) {
  const std::string materials =
      "<basematerials id=\"5\"><base name=\"red\" displaycolor=\"#F00\"/><base name=\"blue\"/></basematerials>";
  std::string two = kTriangle;
  two.insert(two.find("</triangles>"), "<triangle v1=\"0\" v2=\"2\" v3=\"1\" p1=\"1\"/>");
  const RenderMesh mesh = parse_mesh(
      package(model(materials + object("1", two, "pid=\"5\" pindex=\"0\""), "<item objectid=\"1\"/>")), kThreeMf);
  EXPECT_EQ(mesh.parts, (std::vector<RenderMesh::Part>{{"", "", "red"}, {"", "", "blue"}}));
}

TEST(Read3mf, an_index_beyond_its_object_does_not_reach_the_next) {
  std::string wild = kTriangle;
  wild.replace(wild.find("v3=\"2\""), 6, "v3=\"3\"");
  const TriangleSoup soup =
      parse(package(model(object("1", wild) + object("2", kTriangle), "<item objectid=\"1\"/><item objectid=\"2\"/>")),
            kThreeMf);
  EXPECT_EQ(soup.triangles[0], (Triangle{0, 1, 0xffffffff}));
}

TEST(Read3mf, circles_and_endless_multiplication_are_errors_not_hangs) {
  const auto with = [](const std::string& id, const std::string& of) {
    return object(id,
                  "<components><component objectid=\"" + of + "\"/><component objectid=\"" + of + "\"/></components>");
  };
  EXPECT_ERROR(package(model(with("1", "1"), "<item objectid=\"1\"/>")), kThreeMf, "nested too deeply, or in a circle");
  std::string doubled = object("0", kTriangle);
  for (int i = 1; i < 40; ++i) doubled += with(std::to_string(i), std::to_string(i - 1));
  EXPECT_ERROR(package(model(doubled, "<item objectid=\"39\"/>")), kThreeMf, "its instances add up to more than");
}

TEST(Read3mf, errors_name_the_part_and_the_line) {
  std::string bad = kTriangle;
  bad.replace(bad.find("x=\"1\""), 5, "x=\"one\"");
  EXPECT_ERROR(package(model(object("1", bad), "")), kThreeMf,
               "sample, 3D/own name.model, line 2: <vertex>: 'x' is no number: 'one'");
  EXPECT_ERROR(package(model(object("1", kTriangle), "<item objectid=\"9\"/>")), kThreeMf, "object '9' does not exist");
  EXPECT_ERROR(package(model(object("1", kTriangle), "<item objectid=\"1\" transform=\"1 0 0\"/>")), kThreeMf,
               "a transform is not twelve numbers");
  EXPECT_ERROR("PK\x03\x04", kThreeMf, "not a 3MF file");
}

TEST(Read3mf, every_truncation_throws_and_every_damage_is_survived) {
  const std::string sample = assembly();
  expect_truncations_throw(sample, kThreeMf, sample.size());
  expect_damage_survived(sample, kThreeMf, 50'000, 21);
}

}  // namespace
}  // namespace tetsoup
