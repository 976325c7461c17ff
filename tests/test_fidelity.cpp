// What became of a soup's shape: meshes and soups of boxes, whose answers are known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "base/parallel.h"
#include "tetsoup/progress.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/samples.h"
#include "tetsoup/soup.h"

namespace tetsoup {
namespace {

using Cell = std::array<int, 3>;

/// Cubes of a grid, each of six tets around its diagonal, where `has` says so; `place` moves the corners.
TetMesh cubes(const Cell& size, const std::function<bool(const Cell&)>& has,
              const std::function<Vec3(double, double, double)>& place) {
  TetMesh mesh;
  const auto vertex = [&](int x, int y, int z) {
    return static_cast<std::uint32_t>((z * (size[1] + 1) + y) * (size[0] + 1) + x);
  };
  for (int z = 0; z <= size[2]; ++z)
    for (int y = 0; y <= size[1]; ++y)
      for (int x = 0; x <= size[0]; ++x) mesh.vertices.push_back(place(x, y, z));
  constexpr std::array<std::array<int, 3>, 6> kPaths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        if (!has({x, y, z})) continue;
        for (std::size_t p = 0; p < kPaths.size(); ++p) {
          Cell at{x, y, z};
          Tet tet{vertex(x, y, z), 0, 0, 0};
          for (std::size_t i = 0; i < 3; ++i) {
            ++at[static_cast<std::size_t>(kPaths[p][i])];
            tet[i + 1] = vertex(at[0], at[1], at[2]);
          }
          if (p >= 3) std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
        }
      }
    }
  }
  return mesh;
}

Vec3 as_it_is(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}
bool everywhere(const Cell&) {
  return true;
}

/// A box's surface, 12 triangles.
void add_box(TriangleSoup& soup, const Vec3& lo, const Vec3& hi) {
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  for (unsigned i = 0; i < 8; ++i)
    soup.vertices.push_back({(i & 1U) != 0 ? hi.x : lo.x, (i & 2U) != 0 ? hi.y : lo.y, (i & 4U) != 0 ? hi.z : lo.z});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : kSides) {
    soup.triangles.push_back({first + a, first + b, first + c});
    soup.triangles.push_back({first + a, first + c, first + d});
  }
}

TriangleSoup box(float x, float y, float z) {
  TriangleSoup soup;
  add_box(soup, {0, 0, 0}, {x, y, z});
  return soup;
}

bool passes(const TetMesh& mesh, const Fidelity& fidelity, std::string_view name) {
  const Readiness readiness = assess_readiness(mesh, measure_quality(mesh), fidelity);
  for (const ReadinessCheck& check : readiness.checks)
    if (check.name == name) return check.passed;
  ADD_FAILURE() << "there is no check " << name;
  return false;
}

TEST(Fidelity, a_box_in_cubes_lacks_nothing) {
  const TetMesh mesh = cubes({5, 4, 3}, everywhere, as_it_is);
  const Fidelity found = measure_fidelity(mesh, clean_soup(box(5, 4, 3)).soup);
  EXPECT_TRUE(found.closed && found.flat);
  EXPECT_EQ(found.lost_edges, 0);
  EXPECT_NEAR(found.volume_ratio, 1, 1e-6);
  EXPECT_EQ(found.stray_share, 0);
  EXPECT_EQ(found.soup_pieces + found.mesh_pieces, 2U);
  EXPECT_EQ(found.torn_pieces + found.joined_pieces + found.lost_pieces, 0U);
  EXPECT_EQ(found.mesh_tunnels, 0);
  EXPECT_EQ(found.overlapping_pairs + found.apart_pairs, 0U);
  EXPECT_LT(found.overlap_share + found.apart_share, 1e-9);
  EXPECT_EQ(found.tilted_share, 0);
  EXPECT_NEAR(found.wall_edges * found.mean_edge, 2.0 * 60 / 94, 1e-6);
}

TEST(Fidelity, a_tray_that_was_filled_is_seen) {
  TriangleSoup tray = make_sample("tray", {.wall = 0.02});
  for (Vec3& v : tray.vertices) v = {v.x * 20, v.y * 20, v.z * 20};
  const TetMesh mesh = cubes({20, 14, 5}, everywhere, as_it_is);
  const Fidelity found = measure_fidelity(mesh, clean_soup(tray).soup);
  const double room = 19.2 * 13.2 * 4.6, e = found.mean_edge / 2;
  EXPECT_NEAR(found.volume_ratio, 1400 / (1400 - room), 1e-3);
  // What lies farther than half an edge from walls and floor; the room is open above.
  EXPECT_NEAR(found.stray_share, (19.2 - 2 * e) * (13.2 - 2 * e) * (4.6 - e) / 1400, 0.02);
  EXPECT_FALSE(passes(mesh, found, "volume_ratio"));
  EXPECT_FALSE(passes(mesh, found, "stray_share"));
}

TEST(Fidelity, parts_that_overlap_count_once) {
  TriangleSoup soup = box(4, 2, 2);
  add_box(soup, {2, 0.25F, 0.25F}, {6, 1.75F, 1.75F});
  const TetMesh mesh = cubes({4, 2, 2}, everywhere, as_it_is);
  const Fidelity found = measure_fidelity(mesh, clean_soup(soup).soup);
  EXPECT_NEAR(found.soup_volume, 16 + 2 * 1.5 * 1.5, 0.3);
  EXPECT_EQ(found.soup_pieces, 1U);
}

TEST(Fidelity, an_end_without_tets_is_lost_by_its_length) {
  const TetMesh mesh = cubes(
      {6, 2, 2}, [](const Cell& c) { return c[0] < 3; }, as_it_is);
  const Fidelity found = measure_fidelity(mesh, clean_soup(box(6, 2, 2)).soup);
  const double length = 3 - 0.7 * found.mean_edge;
  EXPECT_NEAR(found.lost_edges * found.mean_edge, std::sqrt(length * length + 8), 0.4 * found.mean_edge);
  EXPECT_EQ(found.lost_stretches, 1U);
  EXPECT_FALSE(passes(mesh, found, "lost_edges"));
  EXPECT_FALSE(passes(mesh, found, "volume_share"));
}

TEST(Fidelity, pieces_are_told_torn_joined_or_lost) {
  TriangleSoup two = box(4, 2, 2);
  add_box(two, {6, 0, 0}, {10, 2, 2});
  const CleanSoup apart = clean_soup(two), one = clean_soup(box(10, 2, 2));
  const TetMesh whole = cubes({10, 2, 2}, everywhere, as_it_is);
  const TetMesh parted = cubes(
      {10, 2, 2}, [](const Cell& c) { return c[0] < 4 || c[0] >= 6; }, as_it_is);
  const TetMesh half = cubes(
      {10, 2, 2}, [](const Cell& c) { return c[0] < 4; }, as_it_is);
  EXPECT_EQ(measure_fidelity(whole, apart.soup).joined_pieces, 1U);
  EXPECT_EQ(measure_fidelity(parted, one.soup).torn_pieces, 1U);
  EXPECT_EQ(measure_fidelity(half, apart.soup).lost_pieces, 1U);
  const Fidelity right = measure_fidelity(parted, apart.soup);
  EXPECT_EQ(right.soup_pieces, 2U);
  EXPECT_EQ(right.torn_pieces + right.joined_pieces + right.lost_pieces, 0U);
  EXPECT_TRUE(passes(parted, right, "components"));
  EXPECT_FALSE(passes(parted, measure_fidelity(parted, one.soup), "components"));
}

TEST(Fidelity, a_hole_through_the_mesh_alone_is_counted) {
  const TetMesh mesh = cubes(
      {5, 5, 2}, [](const Cell& c) { return c[0] != 2 || c[1] != 2; }, as_it_is);
  const Fidelity found = measure_fidelity(mesh, clean_soup(box(5, 5, 2)).soup);
  EXPECT_EQ(found.soup_tunnels, 0);
  EXPECT_EQ(found.mesh_tunnels, 1);
  EXPECT_FALSE(passes(mesh, found, "tunnels"));
}

TEST(Fidelity, a_ring_that_closes_over_itself_overlaps) {
  // A bar bent around by more than a full turn: its ends lie in each other.
  const double kPi = std::acos(-1.0);
  const auto bent = [&](double turns) {
    return cubes({44, 2, 2}, everywhere, [&](double x, double y, double z) {
      const double angle = 2 * kPi * turns * x / 44;
      return as_it_is((8 - y) * std::cos(angle), (8 - y) * std::sin(angle), z);
    });
  };
  const TriangleSoup soup = clean_soup(box(5, 5, 2)).soup;
  const Fidelity open = measure_fidelity(bent(0.9), soup), closed = measure_fidelity(bent(1.1), soup);
  EXPECT_EQ(open.overlapping_pairs, 0U);
  EXPECT_LT(open.overlap_share, 1e-9);
  EXPECT_GT(closed.overlapping_pairs, 20U);
  EXPECT_NEAR(closed.overlap_share, 0.1, 0.01);  // of what is covered at all
  EXPECT_EQ(closed.apart_pairs, 0U);
  TetMesh twice = cubes({3, 3, 3}, everywhere, as_it_is);
  const TetMesh moved =
      cubes({3, 3, 3}, everywhere, [](double x, double y, double z) { return as_it_is(x + 1.5, y, z); });
  for (const Tet& t : moved.tets) twice.tets.push_back({t[0] + 64, t[1] + 64, t[2] + 64, t[3] + 64});
  twice.vertices.insert(twice.vertices.end(), moved.vertices.begin(), moved.vertices.end());
  const Fidelity two = measure_fidelity(twice, soup);
  EXPECT_EQ(two.overlapping_pairs, 0U);
  EXPECT_GT(two.apart_pairs, 50U);
  EXPECT_NEAR(two.apart_share, 1.5 / 4.5, 0.01);
}

TEST(Fidelity, dents_in_what_is_flat_are_seen) {
  const auto dented = [](double x, double y, double z) {
    return as_it_is(x, y, z == 3 && static_cast<int>(x + y) % 2 == 1 ? 2.4 : z);
  };
  const TriangleSoup soup = clean_soup(box(6, 6, 3)).soup;
  const TetMesh mesh = cubes({6, 6, 3}, everywhere, dented);
  const double of_top = 36.0 / (2 * 36 + 4 * 18);
  EXPECT_NEAR(measure_fidelity(mesh, soup).tilted_share, of_top, 0.1);
  EXPECT_FALSE(measure_fidelity(mesh, make_sample("sphere")).flat);
}

TEST(Fidelity, windings_and_threads_leave_no_trace) {
  const TriangleSoup cup = make_sample("cup");
  const TetMesh mesh = cubes({8, 8, 8}, everywhere,
                             [](double x, double y, double z) { return as_it_is(x / 8 - 0.5, y / 8 - 0.5, z / 8); });
  const Fidelity given = measure_fidelity(mesh, cup);
  set_thread_count(1);
  const Fidelity cleaned = measure_fidelity(mesh, clean_soup(cup));
  set_thread_count(3);
  const Fidelity again = measure_fidelity(mesh, clean_soup(cup));
  set_thread_count(0);
  EXPECT_EQ(cleaned.stray_share, again.stray_share);
  EXPECT_EQ(cleaned.lost_edges, again.lost_edges);
  EXPECT_NEAR(given.volume_ratio, cleaned.volume_ratio, 1e-9);
  EXPECT_NEAR(given.stray_share, cleaned.stray_share, 1e-9);
}

TEST(Fidelity, nothing_is_compared_with_nothing) {
  EXPECT_EQ(measure_fidelity({}, TriangleSoup{}).mesh_pieces, 0U);
  const TetMesh mesh = cubes({2, 2, 2}, everywhere, as_it_is);
  EXPECT_FALSE(measure_fidelity(mesh, TriangleSoup{}).closed);
  EXPECT_EQ(measure_fidelity({}, box(1, 1, 1)).lost_edges, 0);
}

}  // namespace
}  // namespace tetsoup
