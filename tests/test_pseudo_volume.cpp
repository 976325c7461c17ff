// Stage 3: the fast rays against the obvious ones, against parity counting, and against solids that are known.
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/reference.h"
#include "kernel/targets.h"
#include "ray_parity.h"
#include "shapes.h"
#include "tetsoup/error.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/samples.h"
#include "vote_grids.h"

namespace tetsoup {
namespace {

DistanceField make_field(const TriangleSoup& soup, int voxels, double band = 5, std::optional<Box3> box = {}) {
  DistanceOptions options;
  options.voxels = voxels;
  options.band_voxels = band;
  options.box = box;
  return unsigned_distance(clean_soup(soup), options);
}

PseudoVolumeOptions with_band(double band_voxels) {
  PseudoVolumeOptions options;
  options.band_voxels = band_voxels;
  return options;
}

bool in_unit_ball(const Vec3d& p) {
  return squared_length(p) < 1;
}

TEST(PseudoVolume, bits_of_the_fast_rays_are_those_of_the_obvious_ones) {
  // Widths around a word's 64 bits, so that rays cross words, enter through every side and leave through every other.
  for (const int voxels : {7, 60, 61, 70, 130}) {
    TriangleSoup soup = test::make_confetti(40, 0.2, static_cast<std::uint64_t>(voxels));
    for (Vec3& v : soup.vertices) v = {v.x, v.y * 0.3F, v.z * 0.4F};
    const DistanceField field = make_field(soup, voxels, 6);
    for (const double band : {0.9, 1.5, 4.0}) {
      for (const int rays : {26, 13}) {
        for (const Placement placement : {Placement::Closest, Placement::Entry}) {
          PseudoVolumeOptions options = with_band(band);
          options.rays = rays;
          options.placement = placement;
          const PseudoVolume fast = classify_volume(field, options);
          const auto obvious =
              reference::count_votes(dense(field.distance), static_cast<float>(band * field.distance.frame.voxel_size),
                                     rays, placement == Placement::Entry);
          const auto expected =
              test::make_votes(obvious.frame, [&](int x, int y, int z) { return int{obvious.at(x, y, z)}; });
          ASSERT_EQ(fast.votes, expected) << voxels << ' ' << band << ' ' << rays;
        }
      }
    }
  }
}

TEST(PseudoVolume, inside_is_a_strict_majority_of_the_votes) {
  const DistanceField field = make_field(test::make_confetti(300, 0.1, 4), 40);
  for (const int rays : {26, 13}) {
    PseudoVolumeOptions options = with_band(1.5);
    options.rays = rays;
    options.cavities = Cavities::Keep;
    const PseudoVolume volume = classify_volume(field, options);
    const auto [nx, ny, nz] = volume.inside.frame.size;
    std::size_t inside = 0;
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          ASSERT_EQ(volume.inside.test(x, y, z), 2 * volume.votes.at(x, y, z) > rays);
          inside += volume.inside.test(x, y, z);
        }
      }
    }
    EXPECT_GT(inside, 0U);
  }
}

TEST(PseudoVolume, a_closed_ball_is_its_voxelisation) {
  const DistanceField field = make_field(test::make_globe(48, 96, [](Vec3d p) { return p; }), 64);
  EXPECT_GE(test::overlap(classify_volume(field).inside, in_unit_ball), 0.985);
}

TEST(PseudoVolume, k_of_one_is_parity_counting_on_the_closed_samples) {
  PseudoVolumeOptions options;
  options.k = 1;
  options.cavities = Cavities::Keep;
  for (const char* name : {"torus", "heart", "sphere", "robot"}) {
    const TriangleSoup soup = make_sample(name);
    const DistanceField field = make_field(soup, 96, 4);
    const PseudoVolume events = classify_volume(field, options);
    EXPECT_TRUE(events.report.floored);
    const auto agreement =
        test::compare_with_parity(soup, dense(field.distance), static_cast<float>(events.report.band));
    EXPECT_GE(agreement.clear_rays, 0.99) << name;
    // The robot's parts overlap, so many of its rays graze: two sheets within one run of the band.
    if (std::string_view(name) != "robot") {
      EXPECT_GE(agreement.all_rays, 0.99) << name;
    }
    RecordProperty(std::string(name) + "_all_rays", std::to_string(agreement.all_rays));
    RecordProperty(std::string(name) + "_clear_rays", std::to_string(agreement.clear_rays));
  }
}

TEST(PseudoVolume, overlapping_parts_become_their_union_unless_cavities_are_kept) {
  const TriangleSoup parts = test::joined(test::make_ball(1, {0, 0, 0}), test::make_ball(1, {1, 0, 0}));
  const auto in_either = [](const Vec3d& p) { return in_unit_ball(p) || in_unit_ball(p - Vec3d{1, 0, 0}); };
  const DistanceField field = make_field(parts, 80, 4);
  const PseudoVolume filled = classify_volume(field);
  EXPECT_GE(test::overlap(filled.inside, in_either), 0.97);
  EXPECT_GT(filled.report.cavity_voxels, 0U);
  PseudoVolumeOptions keep;
  keep.cavities = Cavities::Keep;
  EXPECT_LE(test::overlap(classify_volume(field, keep).inside, in_either), 0.85) << "parity leaves the lens hollow";
  EXPECT_EQ(classify_volume(make_field(test::make_ball(), 64)).report.cavity_voxels, 0U);
}

/// Without the triangles whose centre lies in a ball.
TriangleSoup pierced(const TriangleSoup& soup, const Vec3d& centre, double radius) {
  TriangleSoup rest{soup.vertices, {}};
  for (const Triangle& t : soup.triangles) {
    Vec3d middle;
    for (const std::uint32_t v : t) middle += to_double(soup.vertices[v]) * (1.0 / 3);
    if (squared_length(middle - centre) > radius * radius) rest.triangles.push_back(t);
  }
  return rest;
}

TEST(PseudoVolume, a_hole_smaller_than_the_band_lets_no_flood_into_an_overlap) {
  // Two balls meet in a circle; a hole on it opens the lens between them, which parity calls outside.
  const TriangleSoup parts = test::joined(test::make_ball(1, {0, 0, 0}), test::make_ball(1, {1, 0, 0}));
  const TriangleSoup holed = pierced(parts, {0.5, std::sqrt(0.75), 0}, 0.12);
  const auto in_either = [](const Vec3d& p) { return in_unit_ball(p) || in_unit_ball(p - Vec3d{1, 0, 0}); };
  const DistanceField field = make_field(holed, 80, 7);
  EXPECT_LE(test::overlap(classify_volume(field, with_band(0.9)).inside, in_either), 0.85);
  EXPECT_GE(test::overlap(classify_volume(field, with_band(5)).inside, in_either), 0.93);
}

TEST(PseudoVolume, the_largest_closure_is_about_as_wide_as_the_hole) {
  const TriangleSoup ball = test::make_globe(48, 96, [](Vec3d p) { return p; });
  EXPECT_EQ(classify_volume(make_field(ball, 64)).report.largest_closure, 0);
  for (const double radius : {0.2, 0.3, 0.5}) {
    const TriangleSoup holed = pierced(ball, {0, 0, 1}, radius);
    // Where the field does not know the distance it is found anew.
    for (const double band : {5.0, 10.0}) {
      const DistanceField field = make_field(holed, 64, band);
      const double voxel = field.distance.frame.voxel_size;
      // The surface over the hole is no disc: it bulges, and where it is thin a few voxels of its middle are missing.
      const double closure = classify_volume(field).report.largest_closure;
      EXPECT_GE(closure, 1.4 * radius - 2 * voxel) << radius << ' ' << band;
      EXPECT_LE(closure, 2 * radius + 2 * voxel) << radius << ' ' << band;
    }
  }
}

TEST(PseudoVolume, entry_placement_dilates_by_the_band) {
  const DistanceField field = make_field(test::make_ball(), 64);
  PseudoVolumeOptions options = with_band(3);
  const auto closest = classify_volume(field, options).report.inside_voxels;
  options.placement = Placement::Entry;
  const auto entry = classify_volume(field, options).report.inside_voxels;
  const double h = field.distance.frame.voxel_size;
  EXPECT_NEAR(static_cast<double>(entry) / static_cast<double>(closest), std::pow(1 + 3 * h, 3), 0.1);
}

TEST(PseudoVolume, an_open_box_with_a_small_hole_is_still_solid) {
  TriangleSoup box = make_sample("sphere");
  const TriangleSoup holed = remove_triangles(box, 0.1, 5);
  const Box3 domain = clean_soup(box).report.box;
  const PseudoVolume whole = classify_volume(make_field(box, 64, 5, domain));
  const PseudoVolume damaged = classify_volume(make_field(holed, 64, 5, domain));
  EXPECT_GE(test::overlap(whole.inside, damaged.inside), 0.98);
}

TEST(PseudoVolume, half_of_the_triangles_is_enough) {
  const TriangleSoup sphere = make_sample("sphere");
  const Box3 domain = clean_soup(sphere).report.box;
  const PseudoVolume whole = classify_volume(make_field(sphere, 64, 5, domain));
  const PseudoVolume half = classify_volume(make_field(remove_triangles(sphere, 0.5, 2), 64, 5, domain));
  EXPECT_GE(test::overlap(whole.inside, half.inside), 0.95);
  EXPECT_TRUE(half.report.automatic);
}

TEST(PseudoVolume, every_instruction_set_gives_the_same_bits) {
  const DistanceField field = make_field(test::make_confetti(60, 0.2, 5), 70);
  for (const Placement placement : {Placement::Closest, Placement::Entry}) {
    PseudoVolumeOptions options;
    options.placement = placement;
    const PseudoVolume best = classify_volume(field, options);
    for_each_simd_target([&](const std::string& target) {
      const PseudoVolume volume = classify_volume(field, options);
      EXPECT_EQ(volume.votes, best.votes) << target;
      EXPECT_EQ(volume.inside.words, best.inside.words) << target;
      EXPECT_EQ(volume.report.band_voxels, best.report.band_voxels) << target;
    });
  }
}

TEST(PseudoVolume, winding_and_order_change_nothing) {
  const TriangleSoup soup = make_sample("robot");
  const PseudoVolume a = classify_volume(make_field(soup, 64));
  const PseudoVolume b = classify_volume(make_field(test::scrambled(soup, 3), 64));
  EXPECT_EQ(a.inside.words, b.inside.words);
  EXPECT_EQ(a.votes, b.votes);
}

TEST(PseudoVolume, mirroring_the_soup_mirrors_the_votes) {
  TriangleSoup soup = test::make_confetti(60, 0.25, 8);
  const Box3 box{{-1, -1, -1}, {2, 2, 2}};
  const PseudoVolume a = classify_volume(make_field(soup, 48, 5, box), with_band(2));
  for (Vec3& v : soup.vertices) v.x = 1 - v.x;  // about the middle of the box
  const PseudoVolume b = classify_volume(make_field(soup, 48, 5, box), with_band(2));
  const auto [nx, ny, nz] = a.inside.frame.size;
  std::size_t differ = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) differ += a.votes.at(x, y, z) != b.votes.at(nx - 1 - x, y, z);
  EXPECT_LE(differ, a.votes.frame.voxel_count() / 500) << "only distances that rounding makes equal may differ";
}

TEST(PseudoVolume, the_choice_does_not_depend_on_how_wide_the_known_band_is) {
  for (const char* name : {"torus", "sphere"}) {
    const TriangleSoup soup = remove_triangles(make_sample(name), 0.3, 1);
    const PseudoVolume narrow = classify_volume(make_field(soup, 48, 5)),
                       wide = classify_volume(make_field(soup, 48, 20));
    EXPECT_FALSE(narrow.report.wants_band_voxels);
    EXPECT_EQ(narrow.report.band_voxels, wide.report.band_voxels);
    EXPECT_EQ(narrow.inside.words, wide.inside.words);
  }
}

TEST(PseudoVolume, k_band_and_band_in_voxels_are_three_names_of_one_thing) {
  const DistanceField field = make_field(test::make_ball(), 48);
  const double h = field.distance.frame.voxel_size;
  PseudoVolumeOptions by_k, by_band;
  by_k.k = 1 - 2 * h / field.d_max;
  by_band.band = 2 * h;
  const PseudoVolume a = classify_volume(field, with_band(2)), b = classify_volume(field, by_k),
                     c = classify_volume(field, by_band);
  EXPECT_NEAR(b.report.band_voxels, 2, 1e-9);
  EXPECT_NEAR(a.report.k, *by_k.k, 1e-9);
  EXPECT_EQ(a.inside.words, c.inside.words);
}

TEST(PseudoVolume, a_band_wider_than_the_field_is_refused) {
  const DistanceField field = make_field(test::make_ball(), 48, 3);
  EXPECT_THROW(classify_volume(field, with_band(2)), InvalidInput);
  EXPECT_NEAR(band_needed_voxels(field, with_band(2)), 3.74, 1e-9);
}

TEST(PseudoVolume, wrong_options_are_refused) {
  const DistanceField field = make_field(test::make_ball(), 24);
  const auto refused = [&](auto change) {
    PseudoVolumeOptions options;
    change(options);
    EXPECT_THROW(classify_volume(field, options), InvalidInput);
  };
  refused([](auto& o) { o.k = -0.01; });
  refused([](auto& o) { o.k = 1.01; });
  refused([](auto& o) { o.k = std::nan(""); });
  refused([](auto& o) { o.band_voxels = -1; });
  refused([](auto& o) { o.rays = 6; });
  refused([](auto& o) { o.k = 0.9, o.band = 1; });
}

TEST(PseudoVolume, a_band_far_wider_than_the_grid_is_as_wide_as_the_grid) {
  const CleanSoup soup = clean_soup(test::make_confetti(40, 0.2, 3));
  DistanceOptions grid;
  grid.voxels = 24;
  PseudoVolumeOptions options;
  const auto with = [&](double band_voxels) {
    options.band_voxels = band_voxels;
    DistanceField field = unsigned_distance(soup, grid);
    widen_distance(field, soup, band_needed_voxels(field, options));
    return classify_volume(field, options);
  };
  const PseudoVolume wide = with(200), widest = with(1e10);
  EXPECT_EQ(wide.votes, widest.votes);
  EXPECT_EQ(wide.inside.words, widest.inside.words);
  EXPECT_LT(widest.report.band_voxels, 1000);
}

TEST(PseudoVolume, same_bits_at_any_thread_count_and_cancellable) {
  const DistanceField field = make_field(make_sample("tree"), 64);
  set_thread_count(1);
  const PseudoVolume one = classify_volume(field);
  set_thread_count(5);
  const PseudoVolume many = classify_volume(field);
  set_thread_count(0);
  EXPECT_EQ(one.votes, many.votes);
  EXPECT_EQ(one.report.band_voxels, many.report.band_voxels);
  EXPECT_THROW(classify_volume(field, {}, [](std::string_view, double f) { return f < 0.3; }), Cancelled);
}

}  // namespace
}  // namespace tetsoup
