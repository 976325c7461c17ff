// Exact crossings where the soup is sound, volume events where it is not, and bodies on grids of their own.
#include <gtest/gtest.h>

#include <cmath>

#include "base/block_grid.h"
#include "pseudo_volume/classify_volume.h"
#include "ray_parity.h"
#include "shapes.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

using test::joined;
using test::make_ball;
using test::make_box;

TriangleSoup turned_over(TriangleSoup soup) {
  for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  return soup;
}

/// Clean, with what lies inside what.
CleanSoup prepared(const TriangleSoup& soup) {
  CleanSoup clean = clean_soup(soup);
  clean.parts.around = split_bodies(clean).around;
  return clean;
}

GridFrame grid_of(const CleanSoup& soup, int voxels) {
  DistanceOptions options;
  options.voxels = voxels;
  return make_grid(soup, options);
}

PseudoVolume volume_of(const TriangleSoup& soup, int voxels = 48, const PseudoVolumeOptions& options = {}) {
  const CleanSoup clean = prepared(soup);
  return find_volume(clean, grid_of(clean, voxels), options);
}

/// Share of the voxels of which two grids say the same.
double agreement(const BitGrid& a, const BitGrid& b) {
  std::size_t same = 0;
  for (int z = 0; z < a.frame.size[2]; ++z)
    for (int y = 0; y < a.frame.size[1]; ++y)
      for (int x = 0; x < a.frame.size[0]; ++x) same += a.test(x, y, z) == b.test(x, y, z);
  return static_cast<double>(same) / static_cast<double>(a.frame.voxel_count());
}

TEST(FindVolume, a_sound_soup_has_the_voxels_of_its_winding_number) {
  const TriangleSoup turned_box =
      test::joined(make_ball(1, {0.31, 0.2, 0.1}), make_box({-0.83, -0.4, -0.7}, {0.5, 0.9, 0.6}));
  for (const TriangleSoup& soup : std::vector<TriangleSoup>{make_ball(), turned_box, make_sample("torus")}) {
    const CleanSoup clean = prepared(soup);
    const GridFrame frame = grid_of(clean, 40);
    EXPECT_EQ(agreement(find_volume(clean, frame).inside, test::winding_solid(soup, frame)), 1);
  }
}

TEST(FindVolume, exact_crossings_along_26_rays_say_what_rows_along_x_say) {
  const CleanSoup soup = prepared(joined(make_ball(1, {0.3, 0.2, 0.1}), make_box({1.5, -0.4, -0.7}, {2.5, 0.9, 0.6})));
  const GridFrame frame = grid_of(soup, 48);
  const DistanceField field = unsigned_distance(soup, frame, 5);
  DistanceField nowhere;  // no rims
  nowhere.distance = make_block_grid(frame);
  const Progress nobody;
  StageWatch watch(nobody, "test");
  const CrossingPlanes planes = find_crossings(soup.soup, frame, watch);
  Evidence evidence;
  evidence.planes = &planes;
  evidence.rims = &nowhere;
  PseudoVolumeOptions options;
  options.band_voxels = 1.5;
  const PseudoVolume by_rays = classify_volume(field, options, evidence, {});
  EXPECT_EQ(by_rays.report.consensus, 1) << "all 26 agree";
  EXPECT_EQ(by_rays.inside.words, find_volume(soup, frame).inside.words);
}

TEST(FindVolume, walls_closer_than_a_voxel_raise_no_lasting_event) {
  // Two boxes, a slot of half a voxel between them: rays that cross both walls are as before behind them.
  const double gap = 0.5 / 48;
  const TriangleSoup soup =
      joined(make_box({0, 0, 0}, {0.5 - gap / 2, 1, 1}), make_box({0.5 + gap / 2, 0, 0}, {1, 1, 1}));
  EXPECT_NEAR(volume_of(soup).report.volume, 1 - gap, 0.03);
  const TriangleSoup plate = make_box({0, 0, 0}, {1, 1, 0.011});
  EXPECT_NEAR(volume_of(joined(plate, make_box({0, 0, 0.3}, {1, 1, 1}))).report.volume, 0.711, 0.03);
}

TEST(FindVolume, shells_that_turn_their_outside_inwards_leave_a_space_hollow) {
  const TriangleSoup outer = make_ball(1), inner = make_ball(0.6);
  const double solid = volume_of(outer).report.volume, space = volume_of(inner).report.volume;
  const PseudoVolume hollow = volume_of(joined(outer, turned_over(inner)));
  EXPECT_NEAR(hollow.report.volume, solid - space, 0.02 * solid);
  ASSERT_EQ(hollow.report.cavities.size(), 1U);
  EXPECT_NEAR(hollow.report.cavities[0].volume, 4.0 / 3 * std::numbers::pi * 0.216, 0.02);
  EXPECT_FALSE(hollow.report.notes.empty());
  EXPECT_NEAR(volume_of(joined(outer, inner)).report.volume, solid, 1e-9) << "both turn their outside out";
  EXPECT_NEAR(volume_of(turned_over(joined(outer, turned_over(inner)))).report.volume, solid - space, 0.02 * solid)
      << "all turned over";
  PseudoVolumeOptions fill;
  fill.cavities = Cavities::Fill;
  EXPECT_NEAR(volume_of(joined(outer, turned_over(inner)), 48, fill).report.volume, solid, 1e-9);
}

TEST(FindVolume, what_one_closed_surface_bounds_is_known_exactly) {
  const auto bounded = [](const TriangleSoup& soup) { return volume_of(soup).report.bounded_volume; };
  // 3.5 voxels thick: the voxels show 3 or 4.
  const double thick = 3.5 / 48;
  const TriangleSoup plate = make_box({0, 0, 0}, {1, 1, thick}), cube = make_box({0, 0, 0}, {1, 1, 1}),
                     space = make_box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7});
  EXPECT_GT(std::abs(volume_of(plate).report.volume - thick), 0.1 * thick) << "or the test shows nothing";
  ASSERT_TRUE(bounded(plate).has_value());
  EXPECT_NEAR(*bounded(plate), thick, 1e-6 * thick);
  EXPECT_NEAR(*bounded(turned_over(plate)), thick, 1e-6 * thick);
  EXPECT_NEAR(*bounded(joined(cube, turned_over(space))), 1 - 0.064, 1e-6) << "hollow";
}

TEST(FindVolume, what_is_not_one_closed_surface_bounds_nothing_that_is_known) {
  const auto bounded = [](const TriangleSoup& soup) { return volume_of(soup).report.bounded_volume; };
  const TriangleSoup cube = make_box({0, 0, 0}, {1, 1, 1}), inner = make_box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7});
  EXPECT_FALSE(bounded(joined(cube, make_box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5})))) << "two that overlap";
  EXPECT_FALSE(bounded(joined(cube, inner))) << "a solid in a solid";
  EXPECT_FALSE(bounded(test::scrambled(cube, 5))) << "windings that say nothing";
  TriangleSoup open = cube;
  open.triangles.pop_back();
  EXPECT_FALSE(bounded(open));
  // A hollow space with a block in it: two shells in a shell.
  EXPECT_FALSE(bounded(joined(joined(cube, turned_over(inner)), make_box({0.45, 0.45, 0.45}, {0.55, 0.55, 0.55}))));
  // One surface that is there twice over: closed and oriented, but it bounds its space two times.
  const TriangleSoup twice = joined(cube, make_box({-0.001, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(bounded(twice));
}

TEST(FindVolume, random_windings_leave_no_trace) {
  const TriangleSoup soup = joined(make_ball(1), make_ball(0.6));
  const PseudoVolume whole = volume_of(test::scrambled(soup, 5));
  EXPECT_EQ(whole.inside.words, volume_of(test::scrambled(soup, 9)).inside.words);
  EXPECT_NEAR(whole.report.volume, volume_of(make_ball(1)).report.volume, 1e-9) << "no evidence: filled";
}

TEST(FindVolume, a_hole_changes_only_what_is_near_it) {
  TriangleSoup holed = make_ball();
  const PseudoVolume whole = volume_of(holed);
  std::erase_if(holed.triangles, [&](const Triangle& t) { return holed.vertices[t[0]].z > 0.93F; });
  const CleanSoup clean = prepared(holed);
  EXPECT_FALSE(clean.parts.odd_edges.empty());
  const PseudoVolume volume = find_volume(clean, whole.inside.frame);
  EXPECT_GE(agreement(volume.inside, whole.inside), 0.998);
  for (int z = 0; z < 30; ++z)
    for (int y = 0; y < 52; ++y)
      for (int x = 0; x < 52; ++x) ASSERT_EQ(volume.inside.test(x, y, z), whole.inside.test(x, y, z)) << x << y << z;
}

TEST(FindVolume, a_sheet_gets_the_thickness_that_is_asked_for_and_a_solid_none) {
  const TriangleSoup sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  MeshOptions options;
  options.pseudo_volume.thickness = 0.05;
  Pipeline thick(sheet);
  thick.run_until(Stage::PseudoVolume, options);
  EXPECT_NEAR(thick.pseudo_volume().report.volume, 0.05 * 1.05 * 1.05, 0.006);
  EXPECT_EQ(thick.pseudo_volume().report.sheet_share, 1);
  Pipeline ball(make_ball());
  ball.run_until(Stage::PseudoVolume, options);
  EXPECT_EQ(ball.pseudo_volume().report.sheet_share, 0);
}

TEST(SplitBodies, parts_that_do_not_touch_are_bodies_and_hairline_gaps_are_none) {
  const auto boxes = [](double gap) {
    return joined(make_box({0, 0, 0}, {1, 1, 1}), make_box({1 + gap, 0, 0}, {2, 1, 1}));
  };
  EXPECT_EQ(split_bodies(clean_soup(boxes(0))).triangles.size(), 1U);
  EXPECT_EQ(split_bodies(clean_soup(boxes(0.004))).triangles.size(), 1U);
  EXPECT_EQ(split_bodies(clean_soup(boxes(0.02))).triangles.size(), 2U);
  EXPECT_EQ(split_bodies(clean_soup(boxes(0.02)), Join::Near).triangles.size(), 1U);
}

TEST(SplitBodies, one_ball_in_another_is_no_body_of_its_own) {
  const Bodies bodies = split_bodies(clean_soup(joined(make_ball(1), make_ball(0.5))));
  EXPECT_EQ(bodies.triangles.size(), 1U);
}

TEST(SplitBodies, a_speck_far_away_is_left_out_and_decides_no_grid) {
  TriangleSoup soup = make_ball();
  const auto base = static_cast<std::uint32_t>(soup.vertices.size());
  for (const Vec3& v : {Vec3{100, 0, 0}, Vec3{100.001F, 0, 0}, Vec3{100, 0.001F, 0}}) soup.vertices.push_back(v);
  soup.triangles.push_back({base, base + 1, base + 2});
  Pipeline with(soup), without(make_ball());
  EXPECT_EQ(with.run({}).mesh.vertices, without.run({}).mesh.vertices);
  ASSERT_FALSE(with.body_notes().empty());
  EXPECT_NE(with.body_notes().front().find("left out"), std::string::npos);
}

TEST(SplitBodies, bodies_become_so_many_pieces_with_the_tets_that_were_asked_for) {
  TriangleSoup row;
  for (int i = 0; i < 5; ++i) row = joined(row, make_ball(1, {2.1 * i, 0, 0}));
  Pipeline balls(row);
  const TetMesh& mesh = balls.run({}).mesh;
  EXPECT_EQ(balls.body_count(), 5U);
  EXPECT_EQ(measure_quality(mesh).components, 5U);
  EXPECT_NEAR(static_cast<double>(mesh.tets.size()), 2000, 100);
  EXPECT_GT(balls.overlap(mesh), 0.8);
}

TEST(Pipeline, a_space_that_is_given_has_the_usual_number_of_voxels_and_one_body) {
  Pipeline pipeline(joined(make_ball(1), make_ball(1, {4, 0, 0})));
  MeshOptions options;
  pipeline.run_until(Stage::PseudoVolume, options);
  EXPECT_EQ(pipeline.body_count(), 2U);
  options.distance.box = Box3{{-1000, -1000, -1000}, {1000, 1000, 1000}};
  pipeline.run_until(Stage::PseudoVolume, options);
  EXPECT_EQ(pipeline.body_count(), 1U);
  EXPECT_EQ(pipeline.grid().size[0] - 2 * pipeline.grid().pad, 128);
}

TEST(Pipeline, a_lone_point_bears_a_thickness) {
  const TriangleSoup point{{{1, 2, 3}}, {{0, 0, 0}}};
  MeshOptions options;
  options.pseudo_volume.thickness = 0.1;
  EXPECT_FALSE(mesh_soup(point, options).tets.empty());
}

TEST(ShareTets, gives_all_tets_away_with_a_floor_for_the_small) {
  std::vector<BodySize> sizes(4);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i].longest = 1;
    sizes[i].volume = i == 3 ? 100 : 0.01;
    sizes[i].area = 1;
  }
  const std::vector<std::size_t> shares = share_tets(sizes, 1000);
  EXPECT_EQ(shares[0] + shares[1] + shares[2] + shares[3], 1000U);
  EXPECT_GE(shares[0], 5U);
  EXPECT_GT(shares[3], 800U);
  EXPECT_EQ(share_tets(sizes, 3), (std::vector<std::size_t>{0, 1, 1, 1}));
}

TEST(WantedVoxelSize, follows_thin_walls_up_to_a_limit_and_else_stays_what_it_was) {
  BodySize body;
  body.longest = 1, body.volume = 0.3, body.area = 5;
  EXPECT_NEAR(wanted_voxel_size(body, 2000, true), 1.0 / 128, 1e-12);
  body.wall = 0.01;
  EXPECT_NEAR(wanted_voxel_size(body, 2000, true), 0.01 / 1.7, 1e-4);
  body.wall = 1e-6;
  EXPECT_NEAR(wanted_voxel_size(body, 2000, true), 1.0 / 400, 1e-12);
}

}  // namespace
}  // namespace tetsoup
