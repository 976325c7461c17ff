#include "calibrate/elastic_body.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/tet_geometry.h"

namespace tetsoup {

namespace {

constexpr std::int64_t kRowGrain = 128;  ///< Vertices a chunk: well under a millisecond.

std::array<double, 3> entries(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

/// The vertices that share a tet with each, itself included, ascending.
Groups<std::uint32_t> find_neighbours(std::size_t vertex_count, const std::vector<Tet>& tets) {
  const Groups<std::uint32_t> all(vertex_count, [&](const auto& put) {
    for (const Tet& tet : tets)
      for (const std::uint32_t a : tet)
        for (const std::uint32_t b : tet) put(a, b);
  });
  std::vector<std::vector<std::uint32_t>> unique(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    unique[v].assign(all[v].begin(), all[v].end());
    std::sort(unique[v].begin(), unique[v].end());
    unique[v].erase(std::unique(unique[v].begin(), unique[v].end()), unique[v].end());
  }
  return Groups<std::uint32_t>(vertex_count, [&](const auto& put) {
    for (std::size_t v = 0; v < vertex_count; ++v)
      for (const std::uint32_t other : unique[v]) put(v, other);
  });
}

}  // namespace

LameConstants lame_constants(double poisson) {
  return {poisson / ((1 + poisson) * (1 - 2 * poisson)), 1 / (2 * (1 + poisson))};
}

ElasticBody::ElasticBody(std::vector<Vec3d> points, std::vector<Tet> tets, double poisson)
    : points_(std::move(points)), tets_(std::move(tets)), lame_(lame_constants(poisson)) {
  for (const Tet& tet : tets_) {
    const TetCorners p{points_[tet[0]], points_[tet[1]], points_[tet[2]], points_[tet[3]]};
    elements_.push_back({barycentric_gradients(p), signed_volume(p)});
  }
  neighbours_ = find_neighbours(points_.size(), tets_);
  first_.push_back(0);
  for (std::size_t v = 0; v < points_.size(); ++v) first_.push_back(first_.back() + neighbours_[v].size());
}

void ElasticBody::assemble(std::span<const double> stiffness, std::span<const double> density) {
  stiffness_.assign(first_.back(), {});
  mass_.assign(first_.back(), 0.0);
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    const ElasticTet& tet = elements_[t];
    const double weight = stiffness[t] * tet.volume, mass = density[t] * tet.volume / 20;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t vertex = tets_[t][i];
      const auto gi = entries(tet.gradients[i]);
      for (std::size_t j = 0; j < 4; ++j) {
        const auto beside = neighbours_[vertex];
        const auto found = std::lower_bound(beside.begin(), beside.end(), tets_[t][j]);
        const std::size_t at = first_[vertex] + static_cast<std::size_t>(found - beside.begin());
        const auto gj = entries(tet.gradients[j]);
        const double both = lame_.mu * dot(tet.gradients[i], tet.gradients[j]);
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b)
            stiffness_[at][3 * a + b] +=
                weight * (lame_.lambda * gi[a] * gj[b] + lame_.mu * gj[a] * gi[b] + (a == b ? both : 0.0));
        mass_[at] += i == j ? 2 * mass : mass;
      }
    }
  }
}

NodalFields ElasticBody::times_stiffness(const NodalFields& fields) const {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  NodalFields result(fields.rows(), fields.columns);
  parallel_for(static_cast<std::int64_t>(points_.size()), kRowGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
      for (std::size_t i = 0; i < neighbours_[v].size(); ++i) {
        const auto& block = stiffness_[first_[v] + i];
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) {
            const double entry = block[3 * a + b];
            const double* from = fields.row(3 * neighbours_[v][i] + b);
            double* to = result.row(3 * v + a);
            for (std::size_t c = 0; c < fields.columns; ++c) to[c] += entry * from[c];
          }
      }
  });
  return result;
}

NodalFields ElasticBody::times_mass(const NodalFields& fields) const {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  NodalFields result(fields.rows(), fields.columns);
  const std::size_t width = 3 * fields.columns;
  parallel_for(static_cast<std::int64_t>(points_.size()), kRowGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
      for (std::size_t i = 0; i < neighbours_[v].size(); ++i) {
        const double entry = mass_[first_[v] + i];
        const double* from = fields.row(3 * std::size_t{neighbours_[v][i]});
        double* to = result.row(3 * v);
        for (std::size_t c = 0; c < width; ++c) to[c] += entry * from[c];
      }
  });
  return result;
}

std::vector<double> ElasticBody::unit_energies(const NodalFields& fields) const {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  const std::size_t columns = fields.columns;
  std::vector<double> energies(tets_.size() * columns);
  parallel_for(static_cast<std::int64_t>(tets_.size()), kRowGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t)
      for (std::size_t c = 0; c < columns; ++c) {
        double f[3][3] = {};
        for (std::size_t i = 0; i < 4; ++i) {
          const auto g = entries(elements_[t].gradients[i]);
          for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) f[a][b] += fields.row(3 * std::size_t{tets_[t][i]} + a)[c] * g[b];
        }
        const double trace = f[0][0] + f[1][1] + f[2][2];
        const double xy = f[0][1] + f[1][0], yz = f[1][2] + f[2][1], zx = f[2][0] + f[0][2];
        const double squares =
            f[0][0] * f[0][0] + f[1][1] * f[1][1] + f[2][2] * f[2][2] + (xy * xy + yz * yz + zx * zx) / 2;
        energies[t * columns + c] = elements_[t].volume * (lame_.lambda * trace * trace + 2 * lame_.mu * squares);
      }
  });
  return energies;
}

}  // namespace tetsoup
