#include "calibrate/scale_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/elementary.h"
#include "base/tet_faces.h"
#include "base/symmetric_eigen.h"

namespace tetsoup {

namespace {

constexpr double kLoadWeight = 0.3;  ///< Of a compliance's logarithm, where the first eigenvalue's has 1: measured.
constexpr std::size_t kLoads = 40;   ///< As many numbers again as modes and more.

/// How a round changes the tets.
struct Stage {
  int smoothings;  ///< Averages over faces; after four a change reaches as far as the tets around a vertex.
  double damping;  ///< Of the mean diagonal: directions that say less are left alone.
};
/// First what is wrong over whole parts; then single tets, such as those that bridge a gap.
constexpr Stage kStages[] = {{4, 0.03}, {1, 0.01}};
constexpr double kMostStep = 0.7;         ///< Of a tet's logarithm in one round: a factor of two.
constexpr std::size_t kFactorModes = 20;  ///< That the one factor is the best for.
constexpr std::size_t kGuard = 10;        ///< Modes carried along beyond those that are compared.

/// Even in [-.5, .5), by Knuth's multiplier.
double next_noise(std::uint64_t& state) {
  state = state * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(state >> 40) / 16777216.0 - 0.5;
}

/// A tet's average with those it shares faces with.
class FaceAverage {
 public:
  explicit FaceAverage(const std::vector<Tet>& tets, std::size_t vertex_count) {
    TetMesh mesh;
    mesh.tets = tets;
    mesh.vertices.resize(vertex_count);
    const std::vector<TetFace> faces = sorted_faces(mesh);
    beside_.resize(tets.size());
    for (std::size_t begin = 0; begin < faces.size();) {
      const std::size_t end = face_run_end(faces, begin);
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = begin; j < end; ++j)
          if (i != j) beside_[faces[i].slot / 4].push_back(static_cast<std::uint32_t>(faces[j].slot / 4));
      begin = end;
    }
  }
  /// The transposed average, then the average: of a row.
  void smooth(double* row, int times) {
    for (int i = 0; i < times; ++i) spread(row);
    for (int i = 0; i < times; ++i) gather(row);
  }

 private:
  double share(std::size_t t) const { return 1 / static_cast<double>(beside_[t].size() + 1); }
  void gather(double* row) {
    from_.assign(row, row + beside_.size());
    for (std::size_t t = 0; t < beside_.size(); ++t) {
      double sum = from_[t];
      for (const std::uint32_t other : beside_[t]) sum += from_[other];
      row[t] = sum * share(t);
    }
  }
  void spread(double* row) {
    from_.assign(row, row + beside_.size());
    for (std::size_t t = 0; t < beside_.size(); ++t) {
      double sum = from_[t] * share(t);
      for (const std::uint32_t other : beside_[t]) sum += from_[other] * share(other);
      row[t] = sum;
    }
  }
  std::vector<std::vector<std::uint32_t>> beside_;
  std::vector<double> from_;
};

/// What differs, weighted, and how that changes with the logarithm of every tet's modulus: (rows, tets).
struct Residuals {
  std::vector<double> values;
  SmallMatrix slopes;
  double square() const {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return sum;
  }
};

class Fitter {
 public:
  Fitter(ElasticBody& body, const std::vector<double>& stiffness, const std::vector<double>& density,
         const std::vector<double>& filled, const MotionTarget& target, const CalibrateOptions& options,
         StageWatch& watch)
      : body_(body),
        stiffness_(stiffness),
        density_(density),
        filled_(filled),
        target_(target),
        options_(options),
        watch_(watch),
        dissection_(dissect(body)),
        average_(body.tets(), body.vertex_count()),
        logs_(body.tet_count(), 0.0) {}

  ScaleFit run() {
    ScaleFit fit;
    start_ = first_guess(body_, target_.wanted.eigenvalues.size() + kGuard);
    measure(4);
    fit.before = now_;
    for (int i = 0; i < 2; ++i) {  // All eigenvalues scale with it: the second time takes what the modes lacked.
      const double change = mean_log_ratio();
      for (double& log : logs_) log += change;
      measure(1);
    }
    fit.one = now_;
    fit.factor = elementary::exp(logs_[0]);
    begin_with_what_is_filled();
    Residuals residuals = compare();
    std::vector<double> best = logs_;
    double least = residuals.square();
    fit.after = now_;
    int done = 0;
    for (const Stage& stage : kStages)
      for (int round = 0; round < options_.rounds; ++round) {
        watch_.step(++done / (2.0 * options_.rounds + 1));
        step(residuals, stage);
        measure(1);
        residuals = compare();
        if (residuals.square() >= least) continue;
        least = residuals.square();
        best = logs_;
        fit.after = now_;
      }
    for (const double log : best) fit.scale.push_back(elementary::exp(log));
    return fit;
  }

 private:
  /// What is half filled is half as stiff [Nesme09]: where the mesh bridges a gap, a start from one factor would end
  /// with a stiff bridge and legs that are too soft.
  void begin_with_what_is_filled() {
    for (std::size_t t = 0; t < logs_.size(); ++t) logs_[t] = elementary::log(std::min(1.0, filled_[t]));
    for (int i = 0; i < 2; ++i) {
      measure(2);
      const double change = mean_log_ratio();
      for (double& log : logs_) log += change;
    }
    measure(1);
  }

  /// Modes, from those of the last time on, and compliance.
  void measure(int blocks) {
    std::vector<double> scaled(stiffness_.size());
    for (std::size_t t = 0; t < scaled.size(); ++t) scaled[t] = stiffness_[t] * elementary::exp(logs_[t]);
    body_.assemble(scaled, density_);
    const MassOrthonormal rigid = rigid_motions(body_);
    const FactoredBody factored(body_, dissection_, kShift, watch_);
    const std::size_t count = target_.wanted.eigenvalues.size();
    modes_ = find_modes(body_, factored, rigid, start_, count + kGuard, blocks, watch_);
    start_ = modes_.shapes;
    now_.eigenvalues.assign(modes_.values.begin(),
                            modes_.values.begin() + static_cast<std::ptrdiff_t>(std::min(count, modes_.values.size())));
    yielding_ = yield_to(body_, factored, rigid, combine(load_fields(body_), target_.loads));
    now_.compliances.clear();
    for (std::size_t k = 0; k < yielding_.work.rows; ++k) now_.compliances.push_back(yielding_.work.at(k, k));
  }

  double mean_log_ratio() const {
    double sum = 0;
    const std::size_t count = std::min(kFactorModes, now_.eigenvalues.size());
    for (std::size_t i = 0; i < count; ++i) sum += elementary::log(target_.wanted.eigenvalues[i] / now_.eigenvalues[i]);
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

  Residuals compare() const {
    const std::size_t modes = now_.eigenvalues.size(), loads = now_.compliances.size(), tets = body_.tet_count();
    Residuals r;
    r.slopes = SmallMatrix(modes + loads, tets);
    const std::vector<double> modal = body_.unit_energies(modes_.shapes),
                              yielded = body_.unit_energies(yielding_.displacements);
    for (std::size_t i = 0; i < modes; ++i) {
      const double weight = 1 / std::sqrt(static_cast<double>(i + 1));
      r.values.push_back(weight * elementary::log(target_.wanted.eigenvalues[i] / now_.eigenvalues[i]));
      for (std::size_t t = 0; t < tets; ++t)
        r.slopes.at(i, t) = weight * scaled(t) * modal[t * modes_.shapes.columns + i] / now_.eigenvalues[i];
    }
    for (std::size_t k = 0; k < loads; ++k) {
      r.values.push_back(kLoadWeight * elementary::log(target_.wanted.compliances[k] / now_.compliances[k]));
      for (std::size_t t = 0; t < tets; ++t)
        r.slopes.at(modes + k, t) = -kLoadWeight * scaled(t) * yielded[t * loads + k] / now_.compliances[k];
    }
    return r;
  }

  double scaled(std::size_t t) const { return stiffness_[t] * elementary::exp(logs_[t]); }

  /// The least smooth change that makes the differences vanish to first order, damped, and within limits.
  void step(const Residuals& residuals, const Stage& stage) {
    const double low = elementary::log(options_.least_stiffness), high = elementary::log(options_.most_stiffness);
    const std::size_t rows = residuals.values.size(), tets = body_.tet_count();
    SmallMatrix smooth = residuals.slopes;
    for (std::size_t i = 0; i < rows; ++i) average_.smooth(&smooth.values[i * tets], stage.smoothings);
    std::vector<double> products(rows * rows, 0.0);
    double trace = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = 0;
        for (std::size_t t = 0; t < tets; ++t) sum += smooth.at(i, t) * residuals.slopes.at(j, t);
        products[i * rows + j] = products[j * rows + i] = sum;
      }
      trace += products[i * rows + i];
    }
    const SymmetricEigen eigen = symmetric_eigen(products, rows);
    std::vector<double> weights(rows, 0.0);
    for (std::size_t e = 0; e < rows; ++e) {
      const double* v = &eigen.vectors[e * rows];
      double along = 0;
      for (std::size_t i = 0; i < rows; ++i) along += v[i] * residuals.values[i];
      along /= eigen.values[e] + stage.damping * trace / static_cast<double>(rows);
      for (std::size_t i = 0; i < rows; ++i) weights[i] += along * v[i];
    }
    for (std::size_t t = 0; t < tets; ++t) {
      double change = 0;
      for (std::size_t i = 0; i < rows; ++i) change += weights[i] * smooth.at(i, t);
      logs_[t] = std::clamp(logs_[t] + std::clamp(change, -kMostStep, kMostStep), low, high);
    }
  }

  ElasticBody& body_;
  const std::vector<double>&stiffness_, &density_, &filled_;
  const MotionTarget& target_;
  const CalibrateOptions& options_;
  StageWatch& watch_;
  Dissection dissection_;
  FaceAverage average_;
  std::vector<double> logs_;
  NodalFields start_;
  Modes modes_;
  Yielding yielding_;
  Behaviour now_;
};

}  // namespace

NodalFields load_fields(const ElasticBody& body) {
  NodalFields fields(3 * body.vertex_count(), kLoadFields);
  for (std::size_t v = 0; v < body.vertex_count(); ++v) {
    const Vec3d& p = body.points()[v];
    const std::array<double, 9> terms{p.x, p.y, p.z, p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.y * p.z, p.z * p.x};
    for (std::size_t a = 0; a < 3; ++a) std::copy(terms.begin(), terms.end(), fields.row(3 * v + a) + 9 * a);
  }
  return fields;
}

NodalFields first_guess(const ElasticBody& body, std::size_t columns) {
  const NodalFields polynomials = load_fields(body);
  NodalFields fields(polynomials.rows(), columns);
  std::uint64_t noise = 1;
  for (std::size_t i = 0; i < fields.rows(); ++i) {
    const std::size_t known = std::min(columns, kLoadFields);
    std::copy_n(polynomials.row(i), known, fields.row(i));
    for (std::size_t c = known; c < columns; ++c) {
      fields.row(i)[c] = next_noise(noise);
    }
  }
  return fields;
}

MotionTarget varied_loads(const Yielding& yielding) {
  MotionTarget target;
  target.loads = SmallMatrix(yielding.work.rows, kLoads);
  std::uint64_t noise = 1;
  for (double& share : target.loads.values) share = next_noise(noise);
  for (std::size_t k = 0; k < kLoads; ++k) {
    double work = 0;
    for (std::size_t i = 0; i < yielding.work.rows; ++i)
      for (std::size_t j = 0; j < yielding.work.rows; ++j)
        work += target.loads.at(i, k) * yielding.work.at(i, j) * target.loads.at(j, k);
    target.wanted.compliances.push_back(work);
  }
  return target;
}

ScaleFit fit_scales(ElasticBody& body, const std::vector<double>& stiffness, const std::vector<double>& density,
                    const std::vector<double>& filled, const MotionTarget& target, const CalibrateOptions& options,
                    StageWatch& watch) {
  return Fitter(body, stiffness, density, filled, target, options, watch).run();
}

}  // namespace tetsoup
