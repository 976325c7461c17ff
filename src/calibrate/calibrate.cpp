#include "tetsoup/calibrate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/elementary.h"
#include "base/origin.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "calibrate/pieces.h"
#include "calibrate/scale_fit.h"
#include "calibrate/transfer.h"
#include "tetsoup/embed.h"

namespace tetsoup {

namespace {

constexpr std::size_t kGuard = 10;  ///< Modes looked for beyond those that are compared: the last ones come out worse.
constexpr double kMostVolumeRatio = 2;  ///< Of a piece over its reference: beyond, they are not the same thing.

void check(const ElasticMesh& elastic, const char* name) {
  const TetMesh& mesh = *elastic.mesh;
  const std::string of = std::string(" of ") + name;
  require(!mesh.tets.empty(), "tets" + of, mesh.tets.size(), "at least 1");
  for (const Tet& tet : mesh.tets) {
    require(is_valid_tet(tet, mesh.vertices.size()), "a tet" + of, tet[0], "four different vertices of the mesh");
    require(signed_volume(corners_of(mesh, tet)) > 0, "the volume of a tet" + of, 0, "above 0");
  }
  for (const auto values : {elastic.stiffness, elastic.density}) {
    require(values.empty() || values.size() == mesh.tets.size(), "values" + of, values.size(), "one a tet");
    for (const double value : values) require(value > 0 && std::isfinite(value), "a value" + of, value, "above 0");
  }
}

void check(const CalibrateOptions& options) {
  require(options.poisson >= 0 && options.poisson <= 0.49, "poisson", options.poisson, "in [0, 0.49]");
  require(options.modes >= 6 && options.modes <= 60, "modes", options.modes, "in 6..60");
  require(options.rounds >= 1 && options.rounds <= 50, "rounds", options.rounds, "in 1..50");
  require(options.least_stiffness > 0 && options.least_stiffness <= 1, "least_stiffness", options.least_stiffness,
          "in (0, 1]");
  require(options.most_stiffness >= 1 && options.most_stiffness <= 1000, "most_stiffness", options.most_stiffness,
          "in [1, 1000]");
}

/// The body in units of its longest side, around its middle.
struct Frame {
  Vec3d middle;
  double side = 1;

  explicit Frame(const TetMesh& mesh) {
    const Box3 box = box_of(mesh.vertices);
    middle = (box.lo + box.hi) * 0.5;
    const Vec3d sides = box.hi - box.lo;
    side = std::max({sides.x, sides.y, sides.z});
  }
  ElasticBody body(const TetMesh& mesh, double poisson) const {
    std::vector<Vec3d> points;
    for (const Vec3& v : mesh.vertices) points.push_back((to_double(v) - middle) * (1 / side));
    return {std::move(points), mesh.tets, poisson};
  }
};

/// For every piece of the mesh the piece of the reference that is the same body, where there is one.
std::vector<std::optional<std::size_t>> match_pieces(const TetMesh& mesh, const std::vector<Piece>& pieces,
                                                     const std::vector<Piece>& references) {
  if (pieces.size() == 1 && references.size() == 1) return {0};
  std::vector<std::size_t> piece_of(mesh.tets.size());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const std::uint32_t t : pieces[p].tets) piece_of[t] = p;
  std::vector<std::optional<std::size_t>> found(pieces.size());
  for (std::size_t r = 0; r < references.size(); ++r) {
    const TetMesh& fine = references[r].mesh;
    TriangleSoup centres;
    centres.origin = mesh.origin;
    for (const Tet& tet : fine.tets) {
      const TetCorners p = corners_of(fine, tet);
      centres.vertices.push_back(to_float((p[0] + p[1] + p[2] + p[3]) * 0.25));
    }
    const Embedding embedding = embed_points(mesh, centres);
    std::vector<double> shared(pieces.size(), 0.0);
    for (std::size_t t = 0; t < fine.tets.size(); ++t)
      shared[piece_of[embedding.tets[t]]] += signed_volume(corners_of(fine, fine.tets[t]));
    const auto most = std::max_element(shared.begin(), shared.end());
    const auto p = static_cast<std::size_t>(most - shared.begin());
    if (!found[p] || references[*found[p]].volume < references[r].volume) found[p] = r;
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (!found[p]) continue;
    const double ratio = pieces[p].volume / references[*found[p]].volume;
    if (ratio > kMostVolumeRatio || ratio < 1 / kMostVolumeRatio) found[p].reset();
  }
  return found;
}

struct PieceResult {
  std::vector<double> density;
  ScaleFit fit;
  Behaviour wanted;
  MassMoments mass, wanted_mass;
};

/// One piece and its reference.
PieceResult calibrate_piece(const Piece& piece, const Piece& reference, const CalibrateOptions& options,
                            StageWatch& watch, double begin, double end) {
  const Frame frame(reference.mesh);
  const auto enter = [&](double from, double to) {
    watch.enter_part(begin + (end - begin) * from, begin + (end - begin) * to);
  };
  enter(0, 0.1);
  ElasticBody coarse = frame.body(piece.mesh, options.poisson), fine = frame.body(reference.mesh, options.poisson);
  PieceResult result;
  result.density = fill_densities(piece.mesh, coarse, piece.density, reference.mesh, fine, reference.density);
  std::vector<double> density = result.density;
  for (std::size_t t = 0; t < density.size(); ++t) density[t] *= piece.density[t];
  result.mass = moments_of(coarse, density);
  result.wanted_mass = moments_of(fine, reference.density);
  // A piece of few vertices has few modes.
  const std::size_t elastic = 3 * std::min(piece.mesh.vertices.size(), reference.mesh.vertices.size()) - 6;
  const std::size_t count = std::min(static_cast<std::size_t>(options.modes), elastic);
  enter(0.1, 0.5);
  fine.assemble(reference.stiffness, reference.density);
  const Dissection dissection = dissect(fine);
  const FactoredBody factored(fine, dissection, kShift, watch);
  enter(0.5, 0.8);
  const MassOrthonormal rigid = rigid_motions(fine);
  const Modes modes = find_modes(fine, factored, rigid, first_guess(fine, count + kGuard), count, 3, watch);
  MotionTarget target = varied_loads(yield_to(fine, factored, rigid, load_fields(fine)));
  target.wanted.eigenvalues = modes.values;
  enter(0.8, 1);
  result.fit = fit_scales(coarse, piece.stiffness, density, result.density, target, options, watch);
  result.wanted = target.wanted;
  return result;
}

MotionError error_of(const Behaviour& is, const Behaviour& wanted) {
  MotionError error;
  const auto mean = [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    end = std::min(end, is.eigenvalues.size());
    for (std::size_t i = begin; i < end; ++i) sum += std::abs(std::sqrt(is.eigenvalues[i] / wanted.eigenvalues[i]) - 1);
    return end > begin ? sum / static_cast<double>(end - begin) : 0;
  };
  error.low = mean(0, 10);
  error.high = mean(10, is.eigenvalues.size());
  std::vector<double> ratios;
  for (std::size_t k = 0; k < is.compliances.size(); ++k) ratios.push_back(is.compliances[k] / wanted.compliances[k]);
  if (ratios.empty()) return error;
  for (const double ratio : ratios) error.load += std::abs(elementary::log(ratio)) / static_cast<double>(ratios.size());
  std::sort(ratios.begin(), ratios.end());
  error.compliance = (ratios[(ratios.size() - 1) / 2] + ratios[ratios.size() / 2]) / 2;
  return error;
}

void add(MotionError& sum, const MotionError& error, double share) {
  sum.low += share * error.low;
  sum.high += share * error.high;
  sum.compliance += share * error.compliance;
  sum.load += share * error.load;
}

void note_mass(CalibrateReport& report, const PieceResult& piece) {
  const MassMoments &is = piece.mass, &wanted = piece.wanted_mass;
  report.mass_error = std::max(report.mass_error, std::abs(is.mass / wanted.mass - 1));
  const Vec3d off = is.first * (1 / is.mass) - wanted.first * (1 / wanted.mass);
  report.centre_error = std::max(report.centre_error, length(off));
  double largest = 0, worst = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    largest = std::max(largest, std::abs(wanted.second[k]));
    worst = std::max(worst, std::abs(is.second[k] - wanted.second[k]));
  }
  report.inertia_error = std::max(report.inertia_error, worst / largest);
}

}  // namespace

Calibration calibrate_tets(const ElasticMesh& mesh, const ElasticMesh& reference, const CalibrateOptions& options,
                           const Progress& progress) {
  check(options);
  check(mesh, "the mesh");
  check(reference, "the reference");
  StageWatch watch(progress, "calibrate");
  TetMesh near = *reference.mesh;
  if (near.origin != mesh.mesh->origin) {
    near.vertices = recounted(near.vertices, near.origin, mesh.mesh->origin);
    near.origin = mesh.mesh->origin;
  }
  const std::vector<Piece> pieces = split_pieces(mesh),
                           references = split_pieces({&near, reference.stiffness, reference.density});
  const auto matches = match_pieces(*mesh.mesh, pieces, references);
  Calibration result;
  result.stiffness_scale.assign(mesh.mesh->tets.size(), 0.0F);
  result.density_scale.assign(mesh.mesh->tets.size(), 1.0F);
  CalibrateReport& report = result.report;
  report.reference_tets = near.tets.size();
  report.pieces = pieces.size();
  double volume = 0, done = 0, log_factor = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) volume += matches[p] ? pieces[p].volume : 0;
  report.before.compliance = report.one.compliance = report.after.compliance = volume > 0 ? 0 : 1;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (!matches[p]) {
      ++report.uncalibrated;
      continue;
    }
    const double share = pieces[p].volume / volume;
    const PieceResult own =
        calibrate_piece(pieces[p], references[*matches[p]], options, watch, done, std::min(1.0, done + share));
    done = std::min(1.0, done + share);
    for (std::size_t t = 0; t < pieces[p].tets.size(); ++t) {
      result.stiffness_scale[pieces[p].tets[t]] = static_cast<float>(own.fit.scale[t]);
      result.density_scale[pieces[p].tets[t]] = static_cast<float>(own.density[t]);
    }
    report.modes += own.wanted.eigenvalues.size();
    log_factor += share * elementary::log(own.fit.factor);
    add(report.before, error_of(own.fit.before, own.wanted), share);
    add(report.one, error_of(own.fit.one, own.wanted), share);
    add(report.after, error_of(own.fit.after, own.wanted), share);
    note_mass(report, own);
  }
  result.factor = elementary::exp(log_factor);
  for (float& scale : result.stiffness_scale)
    if (scale == 0) scale = static_cast<float>(result.factor);
  const auto [soft, stiff] = std::minmax_element(result.stiffness_scale.begin(), result.stiffness_scale.end());
  const auto [light, heavy] = std::minmax_element(result.density_scale.begin(), result.density_scale.end());
  report.least_stiffness = *soft;
  report.most_stiffness = *stiff;
  report.least_density = *light;
  report.most_density = *heavy;
  return result;
}

TetMesh calibration_reference(const TriangleSoup& soup, const MeshOptions& options, std::size_t tets,
                              const Progress& progress) {
  constexpr int kVoxels = 256;  // A tet of 40,000 is then some eight voxels across, as one of 2,000 is by default.
  require(tets >= 1000 && tets <= 400000, "reference_tets", tets, "in 1000..400000");
  MeshOptions fine = options;
  LatticeOptions& lattice = fine.lattice;
  lattice.vertices.reset();
  lattice.edge.reset();
  lattice.cells.reset();
  lattice.cell_size.reset();
  lattice.tets = tets;
  fine.memory_limit.reset();  // 256 voxels are few
  lattice.fit = Fit::Off;
  lattice.topology.boundary_only = BoundaryOnly::Leave;
  Pipeline pipeline(soup, progress);
  const bool chosen = options.distance.voxels || options.distance.voxel_size || options.distance.box;
  if (!chosen) fine.distance.voxels = kVoxels;
  return pipeline.run(fine, progress).mesh;
}

}  // namespace tetsoup
