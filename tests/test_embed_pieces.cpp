// Where tets lie in one place, a point hangs on those of its own connected piece.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "base/unions.h"
#include "shapes.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

/// Component of every tet that `counts`, joined through faces; the others get kNobody.
constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
std::vector<std::size_t> components(const TetMesh& mesh, const std::function<bool(const TetCorners&)>& counts) {
  Unions tets(mesh.tets.size());
  std::vector<bool> is_counted;
  for (const Tet& tet : mesh.tets) is_counted.push_back(counts(corners_of(mesh, tet)));
  const std::vector<TetFace> faces = sorted_faces(mesh);
  for (std::size_t i = 1; i < faces.size(); ++i) {
    const std::size_t a = faces[i].slot / 4, b = faces[i - 1].slot / 4;
    if (faces[i].corners == faces[i - 1].corners && is_counted[a] && is_counted[b]) tets.join(a, b);
  }
  std::vector<std::size_t> result;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) result.push_back(is_counted[t] ? tets.find(t) : kNobody);
  return result;
}

struct Misplaced {
  std::size_t wrong = 0, all = 0;
};

/// Points that hang on another component than most of their kind; `kind` is negative for points that do not matter.
Misplaced count_misplaced(const Embedding& e, const std::vector<Vec3>& points,
                          const std::vector<std::size_t>& component,
                          const std::function<int(const Vec3d&, std::size_t)>& kind) {
  std::map<int, std::map<std::size_t, std::size_t>> votes;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const int k = kind(to_double(points[i]), i); k >= 0) ++votes[k][component[e.tets[i]]];
  Misplaced result;
  std::map<std::size_t, int> homes;
  for (const auto& [k, by_component] : votes) {
    std::size_t most = 0, sum = 0, home = kNobody;
    for (const auto& [c, count] : by_component) {
      sum += count;
      if (count > most) most = count, home = c;
    }
    EXPECT_TRUE(homes.emplace(home, k).second) << "two kinds live in one component";
    result.wrong += sum - most;
    result.all += sum;
  }
  return result;
}

/// A ring around z (or around y, moved along x), finely divided.
TriangleSoup make_ring(double major, double minor, bool turned) {
  TriangleSoup soup;
  constexpr int kAround = 96, kAcross = 32;
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i % kAround * kAcross + j % kAcross); };
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      const double phi = 2 * std::numbers::pi * i / kAround, theta = 2 * std::numbers::pi * j / kAcross;
      const double r = major + minor * std::cos(theta);
      const Vec3d p{r * std::cos(phi), r * std::sin(phi), minor * std::sin(theta)};
      soup.vertices.push_back(to_float(turned ? Vec3d{p.x + major, p.z, p.y} : p));
      soup.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      soup.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return soup;
}

TEST(EmbedPieces, rings_in_each_other_hang_on_their_own_tets) {
  const TriangleSoup one = make_ring(1, 0.45, false), soup = test::joined(one, make_ring(1, 0.45, true));
  for (const double cell : {0.2, 0.3}) {
    for (const int passes : {0, 6}) {
      MeshOptions options;
      options.distance.voxels = 128;
      options.lattice.cell_size = cell;
      options.smooth.passes = passes;
      const TetMesh mesh = mesh_soup(soup, options);
      ASSERT_EQ(measure_quality(mesh).components, 2U);
      const Embedding e = embed_points(mesh, soup);
      const Misplaced found = count_misplaced(e, soup.vertices, components(mesh, [](const auto&) { return true; }),
                                              [&](const Vec3d&, std::size_t i) { return i >= one.vertices.size(); });
      EXPECT_EQ(found.wrong, 0U) << cell << ", " << passes << " passes";
      EXPECT_EQ(found.all, soup.vertices.size());
      EXPECT_EQ(e.report.other_copy > 0, passes == 0);  // Smoothing draws the tets to their own surfaces.
    }
  }
}

/// Fingers on a palm: the surface of the filled cells of a grid, each face divided, vertices shared.
constexpr double kFinger = 0.3, kSlit = 0.06, kPalm = 0.5, kLength = 1.5;
TriangleSoup make_hand(int fingers) {
  const double pitch = kFinger + kSlit, step = kSlit / 2;
  const auto is_solid = [&](int i, int j, int k) {
    const double x = (i + 0.5) * step, y = (j + 0.5) * step, z = (k + 0.5) * step;
    if (x < 0 || y < 0 || z < 0 || x > fingers * pitch - kSlit || y > kLength || z > kFinger) return false;
    return y < kPalm || std::fmod(x, pitch) < kFinger;
  };
  TriangleSoup soup;
  std::map<std::array<int, 3>, std::uint32_t> names;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [at, is_new] = names.emplace(p, static_cast<std::uint32_t>(soup.vertices.size()));
    if (is_new) soup.vertices.push_back(to_float({p[0] * step, p[1] * step, p[2] * step}));
    return at->second;
  };
  const int nx = static_cast<int>(fingers * pitch / step) + 1, ny = static_cast<int>(kLength / step) + 1,
            nz = static_cast<int>(kFinger / step) + 1;
  for (int k = -1; k <= nz; ++k)
    for (int j = -1; j <= ny; ++j)
      for (int i = -1; i <= nx; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::array<int, 3> next{i + (axis == 0), j + (axis == 1), k + (axis == 2)};
          if (is_solid(i, j, k) == is_solid(next[0], next[1], next[2])) continue;
          std::array<std::array<int, 3>, 4> q;
          q.fill(next);
          ++q[1][(axis + 1) % 3], ++q[2][(axis + 1) % 3], ++q[2][(axis + 2) % 3], ++q[3][(axis + 2) % 3];
          const std::uint32_t a = vertex(q[0]), b = vertex(q[1]), c = vertex(q[2]), d = vertex(q[3]);
          soup.triangles.push_back({a, b, c});
          soup.triangles.push_back({a, c, d});
        }
  return soup;
}

TEST(EmbedPieces, every_finger_hangs_on_its_own_tets) {
  const TriangleSoup soup = make_hand(4);
  for (const double cell : {0.09, 0.1, 0.12, 0.13}) {
    for (const int passes : {0, 6}) {
      MeshOptions options;
      options.distance.voxels = 160;
      options.pseudo_volume.band_voxels = 0.9;
      options.lattice.cell_size = cell;
      options.lattice.thin = Thin::Drop;  // the cover of thin parts still glues fingers that share a tet
      options.smooth.passes = passes;
      const TetMesh mesh = mesh_soup(soup, options);
      ASSERT_EQ(measure_quality(mesh).components, 1U);
      const Embedding e = embed_points(mesh, soup);
      const double palm = kPalm + cell;  // Cells at a slit's ground belong to both fingers.
      const auto component =
          components(mesh, [&](const TetCorners& p) { return p[0].y + p[1].y + p[2].y + p[3].y > 4 * palm; });
      const Misplaced found = count_misplaced(e, soup.vertices, component, [&](const Vec3d& p, std::size_t) {
        return p.y > palm + 2 * cell ? static_cast<int>((p.x + kSlit / 2) / (kFinger + kSlit)) : -1;
      });
      EXPECT_EQ(found.wrong, 0U) << cell << ", " << passes << " passes, of " << found.all;
      EXPECT_GT(found.all, 1000U);
    }
  }
}

TEST(EmbedPieces, points_without_triangles_stay_where_they_are) {
  const TriangleSoup rings = test::joined(make_ring(1, 0.45, false), make_ring(1, 0.45, true));
  MeshOptions options;
  options.lattice.cell_size = 0.3;
  const TetMesh mesh = mesh_soup(rings, options);
  const Embedding e = embed_points(mesh, {rings.vertices, {}});
  EXPECT_EQ(e.report.other_copy, 0U);
}

TEST(EmbedPieces, one_solid_moves_nothing) {
  const TriangleSoup soup = test::make_ball();
  MeshOptions options;
  options.distance.voxels = 48;
  const TetMesh mesh = mesh_soup(soup, options);
  EXPECT_EQ(embed_points(mesh, soup).report.other_copy, 0U);
  EXPECT_EQ(embed_points(mesh, soup).tets, embed_points(mesh, {soup.vertices, {}}).tets);
}

}  // namespace
}  // namespace tetsoup
