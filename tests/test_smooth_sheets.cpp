// Smoothing does not make the boundary cross itself: no place of the mesh lies in two tets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "smooth/sheets.h"
#include "smooth_shapes.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {

namespace {

/// A box of 12 triangles, turned a little so that no lattice plane is one of its faces.
TriangleSoup box_soup(const Vec3d& size) {
  TriangleSoup soup;
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (int i = 0; i < 8; ++i) {
    const Vec3d p{(i & 1) * size.x, (i >> 1 & 1) * size.y, (i >> 2 & 1) * size.z};
    soup.vertices.push_back(to_float(Vec3d{c * p.x - s * p.y, s * p.x + c * p.y, p.z}));
  }
  soup.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return soup;
}

bool is_strictly_in(const TetCorners& tet, const Vec3d& p) {
  return least_weight(tet, p) > 1e-5;
}

/// Tets of which a point well inside lies in another tet, too: in the middle, or halfway from there to a corner.
std::size_t count_overlapping(const TetMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const TetCorners own = corners_of(mesh, mesh.tets[t]);
    const Vec3d middle = (own[0] + own[1] + own[2] + own[3]) * 0.25;
    bool twice = false;
    for (std::size_t other = 0; other < mesh.tets.size() && !twice; ++other) {
      if (other == t) continue;
      const TetCorners tet = corners_of(mesh, mesh.tets[other]);
      twice = is_strictly_in(tet, middle);
      for (const Vec3d& corner : own) twice = twice || is_strictly_in(tet, middle + (corner - middle) * 0.8);
    }
    count += twice;
  }
  return count;
}

/// Two tetrahedra of nothing in common but the places of an edge, each with a copy of it.
TetMesh touching_along_an_edge() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5F},  {0.5F, 0.9F, 0.5F},
                   {0, 0, 0}, {0, 0, 1}, {-1, 0, 0.5F}, {-0.5F, -0.9F, 0.5F}};
  mesh.tets = {{0, 2, 3, 1}, {4, 6, 7, 5}};
  return mesh;
}

}  // namespace

TEST(Sheets, plates_boxes_and_walls_have_no_place_in_two_tets) {
  const Vec3d sizes[] = {{1, 1, 1}, {1, 0.8, 0.05}, {1, 0.1, 0.06}, {1, 0.9, 0.02}, {1, 0.5, 0.12}};
  for (const Vec3d& size : sizes) {
    for (const std::size_t tets : {400U, 1500U}) {
      SCOPED_TRACE(testing::Message() << size.y << " x " << size.z << ", " << tets);
      MeshOptions options;
      options.lattice.tets = tets;
      for (const Snap snap : {Snap::Surface, Snap::Off}) {
        options.smooth.snap = snap;
        EXPECT_EQ(count_overlapping(mesh_soup(box_soup(size), options)), 0U);
      }
    }
  }
}

TEST(Sheets, random_pieces_of_a_lattice_do_not_come_to_overlap) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const TetMesh mesh = random_lattice(seed, {5, 4, 4}, 0.3 + 0.05 * seed);
    EXPECT_EQ(count_overlapping(smooth_tets(mesh, {.passes = 12, .strength = 3, .min_dihedral = 0.05}).mesh), 0U);
  }
}

TEST(Sheets, copies_of_an_edge_part_each_towards_its_own_side) {
  const TetMesh before = touching_along_an_edge();
  const TetMesh after = smooth_tets(before, {.passes = 3}).mesh;
  for (const std::size_t v : {0U, 1U}) EXPECT_GT(after.vertices[v].x + after.vertices[v].y, 0.01F);
  for (const std::size_t v : {4U, 5U}) EXPECT_LT(after.vertices[v].x + after.vertices[v].y, -0.01F);
  EXPECT_EQ(count_overlapping(after), 0U);
}

TEST(Sheets, a_vertex_is_kept_from_the_sheet_beside_it_and_free_elsewhere) {
  TetMesh mesh;  // Two tets with 0.2 between their nearest faces.
  mesh.vertices = {{0, 0, 0}, {1, 0, 0},    {0, 1, 0},    {0.3F, 0.3F, -1},
                   {0, 0, 1}, {1, 0, 0.2F}, {0, 1, 0.2F}, {-1, -1, 0.2F}};
  mesh.tets = {{0, 2, 1, 3}, {5, 6, 7, 4}};
  for (const Tet& t : mesh.tets) ASSERT_GT(signed_volume(corners_of(mesh, t)), 0);
  const Connectivity links = connect(mesh);
  Sheets sheets(links, mesh);
  const Progress progress;
  StageWatch watch(progress, "test");
  sheets.look_around(mesh, watch);
  const Vec3 before = mesh.vertices[0];
  mesh.vertices[0] = {0, 0, 0.19F};
  EXPECT_TRUE(sheets.allow(0, before, mesh));
  mesh.vertices[0] = {0, 0, 0.25F};
  EXPECT_FALSE(sheets.allow(0, before, mesh));
  mesh.vertices[0] = {0, 0, -0.25F};
  EXPECT_TRUE(sheets.allow(0, before, mesh));
}

TEST(Sheets, whole_copies_of_a_tet_may_pass_through_each_other) {
  TetMesh mesh = touching_along_an_edge();
  for (std::size_t v = 0; v < 4; ++v) mesh.vertices[v + 4] = mesh.vertices[v];
  const Connectivity links = connect(mesh);
  const Sheets sheets(links, mesh);
  EXPECT_TRUE(sheets.doubled().empty());
  const SmoothResult result = smooth_tets(mesh, {.passes = 2});
  EXPECT_GT(result.report.volume_after, 0);
}

}  // namespace tetsoup
