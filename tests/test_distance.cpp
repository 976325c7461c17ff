// Stage 2 against a brute force that shares no code with it: closest points in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shapes.h"
#include "tetsoup/distance.h"
#include "tetsoup/error.h"

namespace tetsoup {
namespace {

/// Stated bound of the exact distance, in voxels (distance.h).
constexpr double kBoundVoxels = 1e-3;
/// The same for a full field, from 4 voxels on.
constexpr double kFarBoundVoxels = 0.05, kFarVoxels = 4;
constexpr double kScanVoxels = 10;  // bands that are exact all over

double segment_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d e = b - a;
  const double square = squared_length(e);
  const double s = square > 0 ? std::clamp(dot(p - a, e) / square, 0.0, 1.0) : 0;
  return length(p - a - e * s);
}

double triangle_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double edges = std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
  const Vec3d n = cross(b - a, c - a);
  if (squared_length(n) == 0) return edges;
  const bool above =
      dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
  return above ? std::min(edges, std::abs(dot(p - a, n)) / length(n)) : edges;
}

double brute_distance(const TriangleSoup& soup, const Vec3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Triangle& t : soup.triangles)
    best = std::min(best, triangle_distance(p, to_double(soup.vertices[t[0]]), to_double(soup.vertices[t[1]]),
                                            to_double(soup.vertices[t[2]])));
  return best;
}

/// Triangles of every size and shape: slivers, needles, points, one that spans everything.
TriangleSoup make_mixed(std::uint64_t seed) {
  TriangleSoup soup = test::make_confetti(25, 0.1, seed);
  test::Random random(seed + 100);
  const auto point = [&] { return to_float({random.uniform(), random.uniform(), random.uniform()}); };
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {a, b, c});
    soup.triangles.push_back({n, n + 1, n + 2});
  };
  add(point(), point(), point());
  const Vec3 a = point(), b = point();
  add(a, b, {b.x + 1e-6F, b.y, b.z});
  add(a, a, b);
  add(b, b, b);
  add({0, 0, 0}, {0.5F, 0.5F, 0.5F}, {1, 1, 1});
  return soup;
}

DistanceField make_field(const TriangleSoup& soup, DistanceMode mode, int voxels, double band = 4) {
  DistanceOptions options;
  options.voxels = voxels;
  options.mode = mode;
  options.band_voxels = band;
  return unsigned_distance(clean_soup(soup), options);
}

void expect_matches_brute_force(const DistanceField& field, const TriangleSoup& soup) {
  const GridFrame& frame = field.distance.frame;
  const double h = frame.voxel_size;
  for (int z = 0; z < frame.size[2]; ++z) {
    for (int y = 0; y < frame.size[1]; ++y) {
      for (int x = 0; x < frame.size[0]; ++x) {
        const double truth = brute_distance(soup, test::voxel_centre(frame, x, y, z));
        const double d = field.distance.at(x, y, z);
        const bool exact = field.band <= kScanVoxels * h * (1 + 1e-9) || truth < (kFarVoxels - kBoundVoxels) * h;
        if (exact && truth < field.band - kBoundVoxels * h) {
          ASSERT_NEAR(d, truth, kBoundVoxels * h) << x << ' ' << y << ' ' << z;
        } else if (!exact && truth < field.band - kFarBoundVoxels * h) {
          ASSERT_GE(d, truth - kBoundVoxels * h) << x << ' ' << y << ' ' << z;
          ASSERT_LE(d, truth + kFarBoundVoxels * h) << x << ' ' << y << ' ' << z;
        } else if (truth > field.band + kBoundVoxels * h) {
          ASSERT_TRUE(std::isinf(d)) << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

TEST(Distance, full_field_matches_brute_force_on_triangles_of_every_shape) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TriangleSoup soup = make_mixed(seed);
    expect_matches_brute_force(make_field(soup, DistanceMode::Full, 24), soup);
  }
}

TEST(Distance, band_matches_brute_force_and_ends_where_it_says) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TriangleSoup soup = make_mixed(seed);
    expect_matches_brute_force(make_field(soup, DistanceMode::Band, 40, 3), soup);
  }
}

TEST(Distance, a_band_beyond_what_is_scan_converted_matches_brute_force) {
  const TriangleSoup soup = test::make_confetti(12, 0.1, 8);
  const DistanceField field = make_field(soup, DistanceMode::Band, 40, 14);
  expect_matches_brute_force(field, soup);
  DistanceField widened = make_field(soup, DistanceMode::Band, 40, 3);
  widen_distance(widened, clean_soup(soup), 14);
  EXPECT_EQ(widened.distance, field.distance);
}

TEST(Distance, band_and_full_agree_to_the_bit_where_both_are_known) {
  const TriangleSoup soup = make_mixed(7);
  const DistanceField full = make_field(soup, DistanceMode::Full, 48);
  const std::vector<float> all = dense(full.distance).values;
  for (const double voxels : {4.0, 12.0, 25.0, 1e9}) {
    const DistanceField band = make_field(soup, DistanceMode::Band, 48, voxels);
    EXPECT_EQ(band.d_max, full.d_max);
    const std::vector<float> known = dense(band.distance).values;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (std::isinf(known[i])) {
        ++beyond;
        ASSERT_GE(all[i], band.band * (1 - 1e-5));
      } else {
        ASSERT_EQ(known[i], all[i]);
        ASSERT_LT(known[i], band.band * (1 + 1e-5));
      }
    }
    EXPECT_EQ(beyond == 0, voxels > 100) << voxels;
  }
}

TEST(Distance, a_widened_band_has_the_same_bits_as_a_wide_one) {
  const TriangleSoup soup = test::make_ball();
  const CleanSoup clean = clean_soup(soup);
  DistanceField narrow = make_field(soup, DistanceMode::Band, 48, 3);
  widen_distance(narrow, clean, 8);
  const DistanceField wide = make_field(soup, DistanceMode::Band, 48, 8);
  EXPECT_EQ(narrow.distance, wide.distance);
  EXPECT_EQ(narrow.band, wide.band);
  widen_distance(narrow, clean, 5);
  EXPECT_EQ(narrow.band, wide.band) << "a narrower wish takes nothing away";
}

TEST(Distance, a_cancelled_widening_leaves_the_field_as_it_was) {
  const CleanSoup clean = clean_soup(test::make_ball());
  DistanceOptions options;
  options.voxels = 64;
  options.band_voxels = 3;
  const DistanceField before = unsigned_distance(clean, options);
  DistanceField field = before;
  const auto stop_late = [](std::string_view, double fraction) { return fraction < 0.5; };
  EXPECT_THROW(widen_distance(field, clean, 1e9, stop_late), Cancelled);
  EXPECT_EQ(field.distance, before.distance);
  EXPECT_EQ(field.band, before.band);
}

TEST(Distance, d_max_is_the_largest_distance_over_the_unpadded_box) {
  for (const TriangleSoup& soup : {make_mixed(5), test::make_ball(), test::make_box({0, 0, 0}, {1, 0.2, 0.4})}) {
    const DistanceField field = make_field(soup, DistanceMode::Full, 33);
    const GridFrame& f = field.distance.frame;
    float largest = 0;
    for (int z = f.pad; z < f.size[2] - f.pad; ++z)
      for (int y = f.pad; y < f.size[1] - f.pad; ++y)
        for (int x = f.pad; x < f.size[0] - f.pad; ++x) largest = std::max(largest, field.distance.at(x, y, z));
    // Exact, while the field itself may be a little too far there.
    EXPECT_LE(field.d_max, static_cast<double>(largest));
    EXPECT_NEAR(field.d_max, static_cast<double>(largest), kFarBoundVoxels * f.voxel_size);
  }
}

TEST(Distance, the_grid_covers_the_box_with_cubic_voxels_and_two_of_padding) {
  const CleanSoup clean = clean_soup(test::make_box({1, 2, 3}, {5, 4, 3.5}));
  DistanceOptions options;
  options.voxels = 40;
  const GridFrame frame = make_grid(clean, options);
  EXPECT_EQ(frame.size, (std::array<int, 3>{44, 24, 9}));
  EXPECT_DOUBLE_EQ(frame.voxel_size, 0.1);
  EXPECT_NEAR(frame.origin.x, 1 - 1.5 * 0.1, 1e-12);
  options.voxels.reset();
  options.voxel_size = 0.25;
  EXPECT_EQ(make_grid(clean, options).size, (std::array<int, 3>{20, 12, 6}));
}

TEST(Distance, position_and_scale_do_not_matter) {
  const TriangleSoup soup = test::make_confetti(60, 0.2, 3);
  TriangleSoup scaled = soup;
  for (Vec3& v : scaled.vertices) v = {v.x * 0x1p-90F, v.y * 0x1p-90F, v.z * 0x1p-90F};
  const DistanceField a = make_field(soup, DistanceMode::Band, 40), b = make_field(scaled, DistanceMode::Band, 40);
  const std::vector<float> large = dense(a.distance).values, tiny = dense(b.distance).values;
  for (std::size_t i = 0; i < large.size(); ++i) ASSERT_EQ(large[i] * 0x1p-90F, tiny[i]);
}

TEST(Distance, a_soup_too_small_for_single_precision_gets_coarser_voxels) {
  TriangleSoup far;
  far.vertices = {{1e6F, 1e6F, 1e6F}, {1e6F + 1, 1e6F, 1e6F}, {1e6F, 1e6F + 1, 1e6F}};
  far.triangles = {{0, 1, 2}};
  EXPECT_NEAR(make_grid(clean_soup(far), {}).voxel_size, 1e6 * 0x1p-17, 1e-3);
}

TEST(Distance, a_point_at_the_origin_still_has_a_grid) {
  TriangleSoup point;
  point.vertices = {{0, 0, 0}};
  point.triangles = {{0, 0, 0}};
  const DistanceField field = make_field(point, DistanceMode::Full, 16);
  EXPECT_EQ(field.distance.frame.size, (std::array<int, 3>{5, 5, 5}));
  EXPECT_EQ(field.distance.at(2, 2, 2), 0.0F);
}

TEST(Distance, wrong_options_are_named) {
  const CleanSoup clean = clean_soup(test::make_box({0, 0, 0}, {1, 1, 1}));
  const auto message = [&](const DistanceOptions& options) {
    try {
      make_grid(clean, options);
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  DistanceOptions o;
  o.voxels = 0;
  EXPECT_NE(message(o).find("voxels = 0"), std::string::npos);
  o.voxels = 5000;
  EXPECT_NE(message(o).find("voxels = 5000"), std::string::npos);
  o = {};
  o.voxel_size = -1;
  EXPECT_NE(message(o).find("voxel_size = -1"), std::string::npos);
  o.voxel_size = 1e-9;
  EXPECT_NE(message(o).find("voxel_size"), std::string::npos);
  o.voxels = 10;
  EXPECT_NE(message(o).find("not both"), std::string::npos);
  o = {};
  o.box = Box3{{0.5, 0, 0}, {1, 1, 1}};
  EXPECT_NE(message(o).find("box"), std::string::npos);
  EXPECT_THROW(make_grid(clean_soup({}), {}), InvalidInput);
}

TEST(Distance, same_bits_at_any_thread_count) {
  const TriangleSoup soup = test::make_confetti(200, 0.1, 9);
  set_thread_count(1);
  const DistanceField one = make_field(soup, DistanceMode::Full, 40);
  set_thread_count(5);
  const DistanceField many = make_field(soup, DistanceMode::Full, 40);
  set_thread_count(0);
  EXPECT_EQ(one.distance, many.distance);
  EXPECT_EQ(one.d_max, many.d_max);
}

}  // namespace
}  // namespace tetsoup
