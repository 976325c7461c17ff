#include "calibrate/transfer.h"

#include <algorithm>

#include "base/tet_geometry.h"
#include "base/symmetric_eigen.h"
#include "tetsoup/embed.h"

namespace tetsoup {

namespace {

constexpr double kLeastDensity = 0.1, kMostDensity = 4;  ///< Lighter and heavier tets would rule a time step.
constexpr int kCorrections = 8;                          ///< Of the moments; two do where no tet meets a limit.
constexpr std::size_t kMoments = 10;

/// Mass 1 a unit of volume: one tet's share of every moment.
std::array<double, kMoments> unit_moments(const std::array<Vec3d, 4>& p, double volume) {
  const Vec3d sum = p[0] + p[1] + p[2] + p[3];
  const auto second = [&](double Vec3d::*a, double Vec3d::*b) {
    double products = sum.*a * (sum.*b);
    for (const Vec3d& corner : p) products += corner.*a * (corner.*b);
    return volume * products / 20;
  };
  constexpr auto x = &Vec3d::x, y = &Vec3d::y, z = &Vec3d::z;
  return {volume,       volume * sum.x / 4, volume * sum.y / 4, volume * sum.z / 4, second(x, x),
          second(y, y), second(z, z),       second(x, y),       second(y, z),       second(z, x)};
}

std::array<double, kMoments> unit_moments(const ElasticBody& body, std::size_t t) {
  const Tet& tet = body.tets()[t];
  const auto& p = body.points();
  return unit_moments({p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]}, body.tet(t).volume);
}

std::array<double, kMoments> sum_moments(const ElasticBody& body, const std::vector<double>& density) {
  std::array<double, kMoments> sum{};
  for (std::size_t t = 0; t < body.tet_count(); ++t) {
    const auto own = unit_moments(body, t);
    for (std::size_t k = 0; k < kMoments; ++k) sum[k] += density[t] * own[k];
  }
  return sum;
}

/// The least solution of a small symmetric system; directions in which it says nothing are left alone.
std::array<double, kMoments> solve_small(const std::vector<double>& matrix, const std::array<double, kMoments>& right) {
  const SymmetricEigen eigen = symmetric_eigen(matrix, kMoments);
  std::array<double, kMoments> x{};
  for (std::size_t e = 0; e < kMoments; ++e) {
    if (!(eigen.values[e] > 1e-10 * eigen.values.back())) continue;
    const double* v = &eigen.vectors[e * kMoments];
    double along = 0;
    for (std::size_t k = 0; k < kMoments; ++k) along += v[k] * right[k];
    for (std::size_t k = 0; k < kMoments; ++k) x[k] += along / eigen.values[e] * v[k];
  }
  return x;
}

/// Four points of every tet, each standing for a quarter of it.
std::vector<Vec3> sample_points(const TetMesh& mesh) {
  constexpr double kNear = 0.58541019662496852,
                   kFar = 0.13819660112501049;  // (5 +- 3 sqrt 5) / 20: exact to the square
  std::vector<Vec3> points;
  for (const Tet& tet : mesh.tets) {
    const TetCorners p = corners_of(mesh, tet);
    const Vec3d far = (p[0] + p[1] + p[2] + p[3]) * kFar;
    for (const Vec3d& corner : p) points.push_back(to_float(far + corner * (kNear - kFar)));
  }
  return points;
}

}  // namespace

MassMoments moments_of(const ElasticBody& body, const std::vector<double>& density) {
  const auto m = sum_moments(body, density);
  return {m[0], {m[1], m[2], m[3]}, {m[4], m[5], m[6], m[7], m[8], m[9]}};
}

Prolongation::Prolongation(const TetMesh& mesh, const std::vector<Vec3>& points) {
  TriangleSoup soup;
  soup.vertices = points;
  soup.origin = mesh.origin;
  const Embedding embedding = embed_points(mesh, soup);
  tets_ = embedding.tets;
  for (const auto& w : embedding.weights) weights_.push_back({w[0], w[1], w[2], w[3]});
}

NodalFields Prolongation::operator()(const NodalFields& fields, const std::vector<Tet>& tets) const {
  NodalFields result(3 * tets_.size(), fields.columns);
  for (std::size_t v = 0; v < tets_.size(); ++v)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        const double* from = fields.row(3 * std::size_t{tets[tets_[v]][i]} + a);
        double* to = result.row(3 * v + a);
        for (std::size_t c = 0; c < fields.columns; ++c) to[c] += weights_[v][i] * from[c];
      }
  return result;
}

std::vector<double> fill_densities(const TetMesh& mesh, const ElasticBody& coarse, const std::vector<double>& own,
                                   const TetMesh& fine_mesh, const ElasticBody& fine,
                                   const std::vector<double>& fine_density) {
  TriangleSoup samples;
  samples.vertices = sample_points(fine_mesh);
  samples.origin = mesh.origin;
  const Embedding embedding = embed_points(mesh, samples);
  std::vector<double> masses(coarse.tet_count(), 0.0), scale(coarse.tet_count());
  for (std::size_t s = 0; s < samples.vertices.size(); ++s)
    masses[embedding.tets[s]] += fine_density[s / 4] * fine.tet(s / 4).volume / 4;
  const auto limited = [](double value) { return std::clamp(value, kLeastDensity, kMostDensity); };
  for (std::size_t t = 0; t < scale.size(); ++t) scale[t] = limited(masses[t] / (own[t] * coarse.tet(t).volume));
  const auto wanted = sum_moments(fine, fine_density);
  for (int round = 0; round < kCorrections; ++round) {
    std::vector<double> density(scale.size()), products(kMoments * kMoments, 0.0);
    for (std::size_t t = 0; t < scale.size(); ++t) density[t] = scale[t] * own[t];
    auto missing = sum_moments(coarse, density);
    for (std::size_t k = 0; k < kMoments; ++k) missing[k] = wanted[k] - missing[k];
    for (std::size_t t = 0; t < scale.size(); ++t) {
      const auto m = unit_moments(coarse, t);
      // Least relative change, a tet counting by its mass.
      for (std::size_t i = 0; i < kMoments; ++i)
        for (std::size_t j = 0; j < kMoments; ++j)
          products[i * kMoments + j] += density[t] / coarse.tet(t).volume * m[i] * m[j];
    }
    const auto weights = solve_small(products, missing);
    for (std::size_t t = 0; t < scale.size(); ++t) {
      const auto m = unit_moments(coarse, t);
      double change = 0;
      for (std::size_t k = 0; k < kMoments; ++k) change += weights[k] * m[k] / coarse.tet(t).volume;
      scale[t] = limited(scale[t] * std::max(0.25, 1 + change));
    }
  }
  return scale;
}

}  // namespace tetsoup
