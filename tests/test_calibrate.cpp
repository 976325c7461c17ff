#include "tetsoup/calibrate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibrate/modes.h"
#include "calibrate/scale_fit.h"
#include "base/symmetric_eigen.h"
#include "kernel/dense_product.h"
#include "kernel/targets.h"
#include "lattice_shapes.h"
#include "tetsoup/error.h"

namespace tetsoup {
namespace {

/// A square bar, `cells` along each side, as cubes of five tets.
TetMesh bar(const std::array<int, 3>& cells, double edge, const Vec3d& at = {}) {
  return lattice_mesh(at, cells, edge, [](const TetCorners&) { return true; });
}

/// Eight cells long and two across, and the same twice as fine.
const TetMesh& coarse_bar() {
  static const TetMesh mesh = bar({8, 2, 2}, 0.5);
  return mesh;
}
const TetMesh& fine_bar() {
  static const TetMesh mesh = bar({16, 4, 4}, 0.25);
  return mesh;
}

ElasticBody body_of(const TetMesh& mesh, double poisson) {
  std::vector<Vec3d> points;
  for (const Vec3& v : mesh.vertices) points.push_back(to_double(v));
  ElasticBody body(points, mesh.tets, poisson);
  const std::vector<double> one(mesh.tets.size(), 1.0);
  body.assemble(one, one);
  return body;
}

Calibration calibrate(const TetMesh& mesh, const TetMesh& reference, const CalibrateOptions& options = {}) {
  return calibrate_tets({&mesh, {}, {}}, {&reference, {}, {}}, options);
}

TEST(Calibrate, a_product_has_the_same_bits_on_every_instruction_set) {
  constexpr std::size_t kRows = 21, kColumns = 7, kDepth = 13;
  std::vector<double> a(kRows * kDepth), b(kDepth * kColumns), expected(kRows * kColumns);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = 1.0 / static_cast<double>(i + 3);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = 1.0 / static_cast<double>(2 * i + 5);
  for (std::size_t j = 0; j < kColumns; ++j)
    for (std::size_t i = 0; i < kRows; ++i) {
      expected[j * kRows + i] = 0.1;
      for (std::size_t k = 0; k < kDepth; ++k) expected[j * kRows + i] -= a[k * kRows + i] * b[k * kColumns + j];
    }
  for_each_simd_target([&](const std::string& target) {
    std::vector<double> c(kRows * kColumns, 0.1);
    kernel::subtract_product(c.data(), kRows, kRows, kColumns, a.data(), kRows, {b.data(), kColumns, 1}, kDepth);
    EXPECT_EQ(c, expected) << target;
  });
}

TEST(Calibrate, eigenvalues_of_a_string_of_springs_are_those_of_the_formula) {
  constexpr std::size_t kCount = 24;
  std::vector<double> matrix(kCount * kCount, 0.0);
  for (std::size_t i = 0; i < kCount; ++i) {
    matrix[i * kCount + i] = 2;
    if (i > 0) matrix[i * kCount + i - 1] = -1;
  }
  const SymmetricEigen eigen = symmetric_eigen(matrix, kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_NEAR(eigen.values[i], 2 - 2 * std::cos(std::numbers::pi * double(i + 1) / (kCount + 1)), 1e-13);
    for (std::size_t r = 0; r < kCount; ++r) {  // T v = value v
      const double* v = &eigen.vectors[i * kCount];
      const double left = r > 0 ? v[r - 1] : 0, right = r + 1 < kCount ? v[r + 1] : 0;
      EXPECT_NEAR(2 * v[r] - left - right, eigen.values[i] * v[r], 1e-13);
    }
  }
}

TEST(Calibrate, what_was_factored_solves_the_equations) {
  const ElasticBody body = body_of(bar({7, 5, 4}, 0.2), 0.3);
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  const Dissection dissection = dissect(body);
  const FactoredBody factored(body, dissection, 0.1, watch);
  ASSERT_TRUE(factored.positive());
  const NodalFields right = first_guess(body, 35);
  const NodalFields x = factored.solve(right), kx = body.times_stiffness(x), mx = body.times_mass(x);
  for (std::size_t i = 0; i < x.values.size(); ++i)
    ASSERT_NEAR(kx.values[i] + 0.1 * mx.values[i], right.values[i], 1e-9);
}

TEST(Calibrate, a_bar_without_lateral_strain_rings_as_a_string_of_springs_does) {
  // Poisson ratio 0: waves along it do not bend it, and its first eigenvalue among them is (pi / length)^2.
  const ElasticBody body = body_of(bar({24, 2, 2}, 1.0 / 24), 0);
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  const Dissection dissection = dissect(body);
  const FactoredBody factored(body, dissection, kShift, watch);
  const Modes modes = find_modes(body, factored, rigid_motions(body), first_guess(body, 30), 20, 4, watch);
  const double wanted = std::numbers::pi * std::numbers::pi;
  double nearest = 0;
  for (const double value : modes.values)
    if (std::abs(value - wanted) < std::abs(nearest - wanted)) nearest = value;
  EXPECT_NEAR(nearest / wanted, 1, 0.003);
}

TEST(Calibrate, a_coarse_bar_gets_the_frequencies_of_the_fine_one) {
  const Calibration result = calibrate(coarse_bar(), fine_bar());
  const CalibrateReport& report = result.report;
  EXPECT_GT(report.before.low, 0.1);
  EXPECT_LT(report.one.low, report.before.low / 2);
  EXPECT_LT(report.after.low, 0.03);
  EXPECT_LT(report.after.high, 0.06);
  EXPECT_NEAR(report.after.compliance, 1, 0.1);
  EXPECT_LT(result.factor, 0.9);
  EXPECT_EQ(report.pieces, 1U);
  EXPECT_EQ(report.uncalibrated, 0U);
}

TEST(Calibrate, mass_centre_and_inertia_are_those_of_the_reference) {
  // The coarse bar is half a cell too long and too thick.
  const TetMesh mesh = bar({8, 2, 2}, 0.56);
  const Calibration result = calibrate(mesh, fine_bar());
  EXPECT_LT(result.report.mass_error, 0.001);
  EXPECT_LT(result.report.centre_error, 0.001);
  EXPECT_LT(result.report.inertia_error, 0.001);
  double mass = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    mass += result.density_scale[t] * signed_volume(corners_of(mesh, mesh.tets[t]));
  EXPECT_NEAR(mass, 4.0, 0.004);
}

TEST(Calibrate, neither_threads_nor_size_nor_place_change_it) {
  const Calibration one = calibrate(coarse_bar(), fine_bar());
  set_thread_count(1);
  const Calibration alone = calibrate(coarse_bar(), fine_bar());
  set_thread_count(0);
  EXPECT_EQ(one.stiffness_scale, alone.stiffness_scale);
  EXPECT_EQ(one.density_scale, alone.density_scale);
  const Calibration large = calibrate(bar({8, 2, 2}, 512), bar({16, 4, 4}, 256));
  for (std::size_t t = 0; t < one.stiffness_scale.size(); ++t)
    EXPECT_NEAR(large.stiffness_scale[t] / one.stiffness_scale[t], 1, 0.001);
  TetMesh moved = fine_bar();  // counted from elsewhere
  moved.origin = {1024, 0, 0};
  for (Vec3& v : moved.vertices) v.x -= 1024;
  EXPECT_NEAR(calibrate(coarse_bar(), moved).factor, one.factor, 0.001);
}

TetMesh both(const TetMesh& a, const TetMesh& b) {
  TetMesh all = a;
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  all.vertices.insert(all.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Tet& tet : b.tets) all.tets.push_back({tet[0] + first, tet[1] + first, tet[2] + first, tet[3] + first});
  return all;
}

TEST(Calibrate, each_piece_is_calibrated_by_its_own_reference) {
  const TetMesh mesh = both(coarse_bar(), bar({4, 4, 4}, 0.5, {10, 0, 0}));
  const TetMesh reference = both(bar({8, 8, 8}, 0.25, {10, 0, 0}), fine_bar());
  const Calibration alone = calibrate(coarse_bar(), fine_bar()), result = calibrate(mesh, reference);
  EXPECT_EQ(result.report.pieces, 2U);
  EXPECT_EQ(result.report.uncalibrated, 0U);
  for (std::size_t t = 0; t < alone.stiffness_scale.size(); ++t)
    EXPECT_NEAR(result.stiffness_scale[t] / alone.stiffness_scale[t], 1, 0.001);
  // A piece that the reference lacks takes the mean factor.
  const Calibration lacking = calibrate(mesh, fine_bar());
  EXPECT_EQ(lacking.report.uncalibrated, 1U);
  EXPECT_FLOAT_EQ(lacking.stiffness_scale.back(), static_cast<float>(lacking.factor));
}

TEST(Calibrate, regions_keep_the_ratio_of_their_moduli) {
  const auto halves = [](const TetMesh& mesh) {
    std::vector<double> stiffness;
    for (const Tet& tet : mesh.tets) {
      const TetCorners p = corners_of(mesh, tet);
      stiffness.push_back(p[0].x + p[1].x + p[2].x + p[3].x < 8 ? 1.0 : 100.0);
    }
    return stiffness;
  };
  const std::vector<double> of_mesh = halves(coarse_bar()), of_reference = halves(fine_bar());
  const Calibration result = calibrate_tets({&coarse_bar(), of_mesh, {}}, {&fine_bar(), of_reference, {}});
  EXPECT_LT(result.report.after.low, 0.06);
  EXPECT_LT(result.report.after.low, result.report.before.low / 3);
}

/// A board of three by three on four legs, half a unit wide and two and a half long: one cell across where coarse.
TetMesh table(int refinement) {
  const auto kept = [](const TetCorners& p) {
    const Vec3d centre = (p[0] + p[1] + p[2] + p[3]) * 0.25;
    const auto outer = [](double at) { return at < 0.5 || at > 2.5; };
    return centre.z > 2.5 || (outer(centre.x) && outer(centre.y));
  };
  return lattice_mesh({}, {6 * refinement, 6 * refinement, 6 * refinement}, 0.5 / refinement, kept);
}

TEST(Calibrate, what_stands_on_thin_legs_yields_to_loads_as_it_should) {
  const CalibrateReport report = calibrate(table(1), table(3)).report;
  EXPECT_GT(report.before.low, 0.3);
  EXPECT_GT(report.before.load, 0.5);
  EXPECT_LT(report.after.low, 0.02);
  EXPECT_LT(report.after.high, 0.05);
  EXPECT_LT(report.after.load, 0.05);
  EXPECT_NEAR(report.after.compliance, 1, 0.05);
}

TEST(Calibrate, what_makes_no_sense_is_refused_and_what_is_stopped_throws) {
  const TetMesh mesh = bar({2, 1, 1}, 1);
  EXPECT_THROW(calibrate(TetMesh{}, mesh), InvalidInput);
  EXPECT_THROW(calibrate(mesh, mesh, {.poisson = 0.5}), InvalidInput);
  EXPECT_THROW(calibrate(mesh, mesh, {.modes = 0}), InvalidInput);
  EXPECT_THROW(calibrate(mesh, mesh, {.least_stiffness = 0}), InvalidInput);
  EXPECT_THROW(calibrate(mesh, mesh, {.most_stiffness = 0.5}), InvalidInput);
  const std::vector<double> few(3, 1.0);
  EXPECT_THROW(calibrate_tets({&mesh, few, {}}, {&mesh, {}, {}}), InvalidInput);
  TetMesh turned = mesh;
  std::swap(turned.tets[0][0], turned.tets[0][1]);
  EXPECT_THROW(calibrate(turned, mesh), InvalidInput);
  EXPECT_THROW(calibrate_tets({&mesh, {}, {}}, {&mesh, {}, {}}, {}, [](auto, double done) { return done < 0.3; }),
               Cancelled);
}

TEST(Calibrate, a_single_tet_has_its_own_few_modes) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  const Calibration result = calibrate(mesh, mesh);
  EXPECT_EQ(result.report.modes, 6U);
  EXPECT_NEAR(result.factor, 1, 1e-6);
  EXPECT_NEAR(result.stiffness_scale[0], 1, 1e-5);
}

}  // namespace
}  // namespace tetsoup
