// Ten-node tets: nodes of edges on the surface, valid, and in the files that take them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "shapes.h"
#include "tetsoup/io.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

/// Volume and least determinant of a quadratic tet by the rule of five points, which is exact for cubics.
struct Curved {
  double volume = 0, least = 1e300;
};
Curved measure(const TetMesh& mesh, const Midsides& midsides) {
  Curved all;
  for (const Tet& tet : mesh.tets) {
    const TetCorners p = corners_of(mesh, tet);
    for (int point = -1; point < 4; ++point) {
      std::array<double, 4> w{};
      for (int i = 0; i < 4; ++i) w[static_cast<std::size_t>(i)] = point < 0 ? 0.25 : i == point ? 0.5 : 1.0 / 6;
      std::array<Vec3d, 4> d;
      for (std::size_t c = 0; c < 4; ++c) d[c] = p[c] * (4 * w[c] - 1);
      for (const auto& [i, j] : kTetEdges) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const std::array<std::uint32_t, 2> edge{std::min(tet[a], tet[b]), std::max(tet[a], tet[b])};
        const auto place =
            std::lower_bound(midsides.edges.begin(), midsides.edges.end(), edge) - midsides.edges.begin();
        const Vec3d middle = to_double(midsides.places[static_cast<std::size_t>(place)]);
        d[a] += middle * (4 * w[b]);
        d[b] += middle * (4 * w[a]);
      }
      const double determinant = dot(cross(d[1] - d[0], d[2] - d[0]), d[3] - d[0]);
      all.volume += determinant / 6 * (point < 0 ? -0.8 : 0.45);
      all.least = std::min(all.least, determinant / (6 * signed_volume(p)));
    }
  }
  return all;
}

TetMesh ball_mesh(std::size_t tets) {
  MeshOptions options;
  options.lattice.tets = tets;
  return mesh_soup(test::make_ball(), options);
}

TEST(Midsides, nodes_of_a_balls_boundary_lie_on_it_and_give_it_its_volume) {
  const TetMesh mesh = ball_mesh(500);
  const Midsides midsides = place_midsides(mesh, test::make_ball());
  EXPECT_EQ(midsides.places.size(), midsides.edges.size());
  EXPECT_GT(midsides.moved, midsides.edges.size() / 4);
  const double ball = 4 * std::numbers::pi / 3, straight = measure_quality(mesh).volume;
  const Curved curved = measure(mesh, midsides);
  EXPECT_GT(std::abs(straight - ball), 0.02 * ball);
  EXPECT_NEAR(curved.volume, ball, 0.01 * ball);
  EXPECT_GE(curved.least, 0.29);
}

TEST(Midsides, without_a_surface_near_they_are_halfway) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  const Midsides midsides = place_midsides(mesh, test::make_ball(1, {9, 9, 9}));
  ASSERT_EQ(midsides.edges.size(), 6U);
  EXPECT_EQ(midsides.moved, 0U);
  EXPECT_EQ(midsides.places[0], (Vec3{0.5F, 0, 0}));
  EXPECT_EQ(midsides.places[5], (Vec3{0, 0.5F, 0.5F}));
  EXPECT_THROW(place_midsides({{{0, 0, 0}}, {{0, 1, 2, 3}}}, {}), InvalidInput);
}

TEST(Midsides, what_would_turn_a_tet_inside_out_is_drawn_back) {
  // A surface that dips .24 of an edge into a flat tet, of whose height that is more than all.
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3F, 0.3F, 0.1F}}, {{0, 1, 2, 3}}};
  const TriangleSoup above{{{-5, -5, 0.2F}, {5, -5, 0.2F}, {0, 5, 0.2F}}, {{0, 1, 2}}};
  const Midsides midsides = place_midsides(mesh, above);
  EXPECT_GT(midsides.held_back, 0U);
  EXPECT_GE(measure(mesh, midsides).least, 0.29);
}

std::string text_of(const TetModel& model, const std::string& name, TetFormat format) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
  write_tets(path, model, format);
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

TEST(Midsides, files_have_ten_nodes_in_the_order_of_each_format) {
  TetModel model;
  model.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  model.midsides = place_midsides(model.mesh, {});  // 01 02 03 12 13 23 are nodes 4 to 9.
  model.pins = {{"foot", {0, 1}}};
  const std::string inp = text_of(model, "ten.inp", TetFormat::Abaqus);
  EXPECT_NE(inp.find("TYPE=C3D10"), std::string::npos);
  EXPECT_NE(inp.find("\n1, 1, 2, 3, 4, 5, 8, 6, 7, 9, 10\n"), std::string::npos) << inp;
  EXPECT_NE(inp.find("*NSET, NSET=foot\n1, 2, 5\n"), std::string::npos) << inp;
  EXPECT_NE(text_of(model, "ten.msh", TetFormat::Msh41).find("\n3 1 11 1\n1 1 2 3 4 5 8 6 7 10 9\n"),
            std::string::npos);
  EXPECT_NE(text_of(model, "ten.msh", TetFormat::Msh22).find("\n1 11 2 1 1 1 2 3 4 5 8 6 7 10 9\n"), std::string::npos);
  const std::string vtk = text_of(model, "ten.vtk", TetFormat::Vtk);
  EXPECT_NE(vtk.find("CELLS 1 11\n10 0 1 2 3 4 7 5 6 8 9\nCELL_TYPES 1\n24\n"), std::string::npos) << vtk;
  EXPECT_NE(text_of(model, "ten.vtu", TetFormat::Vtu).find("NumberOfPoints=\"10\""), std::string::npos);
  model.midsides.places.pop_back();
  EXPECT_THROW(text_of(model, "ten.vtu", TetFormat::Vtu), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
