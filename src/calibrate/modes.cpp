#include "calibrate/modes.h"

#include <algorithm>

#include "base/vec.h"
#include "base/symmetric_eigen.h"

namespace tetsoup {

MassOrthonormal rigid_motions(const ElasticBody& body) {
  Vec3d centre{};
  for (const Vec3d& p : body.points()) centre += p;
  centre = centre * (1 / static_cast<double>(body.vertex_count()));
  NodalFields motions(3 * body.vertex_count(), 6);
  for (std::size_t v = 0; v < body.vertex_count(); ++v) {
    const Vec3d r = body.points()[v] - centre;
    const double rows[3][6] = {{1, 0, 0, 0, r.z, -r.y}, {0, 1, 0, -r.z, 0, r.x}, {0, 0, 1, r.y, -r.x, 0}};
    for (std::size_t a = 0; a < 3; ++a) std::copy_n(rows[a], 6, motions.row(3 * v + a));
  }
  return orthonormal_part(body, std::move(motions), {});
}

Modes find_modes(const ElasticBody& body, const FactoredBody& factored, const MassOrthonormal& rigid,
                 const NodalFields& start, std::size_t count, int blocks, StageWatch& watch) {
  std::vector<MassOrthonormal> basis{rigid};
  basis.push_back(orthonormal_part(body, start, basis));
  for (int b = 0; b < blocks; ++b) {
    watch.poll();
    watch.throw_if_stopped();
    MassOrthonormal next = orthonormal_part(body, factored.solve(basis.back().times_mass), basis);
    if (next.fields.columns == 0) break;
    basis.push_back(std::move(next));
  }
  std::vector<std::size_t> first{0};
  for (std::size_t b = 1; b < basis.size(); ++b) first.push_back(first.back() + basis[b].fields.columns);
  const std::size_t size = first.back();
  SmallMatrix stiffness(size, size);
  for (std::size_t b = 1; b < basis.size(); ++b) {
    const NodalFields forces = body.times_stiffness(basis[b].fields);
    for (std::size_t other = 1; other <= b; ++other) {
      const SmallMatrix products = inner_products(forces, basis[other].fields);
      for (std::size_t i = 0; i < products.rows; ++i)
        for (std::size_t j = 0; j < products.columns; ++j)
          stiffness.at(first[b - 1] + i, first[other - 1] + j) = products.at(i, j);
    }
  }
  const SymmetricEigen eigen = symmetric_eigen(stiffness.values, size);
  count = std::min(count, size);
  Modes modes;
  modes.values.assign(eigen.values.begin(), eigen.values.begin() + static_cast<std::ptrdiff_t>(count));
  modes.shapes = NodalFields(3 * body.vertex_count(), count);
  for (std::size_t b = 1; b < basis.size(); ++b) {
    SmallMatrix shares(basis[b].fields.columns, count);
    for (std::size_t i = 0; i < shares.rows; ++i)
      for (std::size_t k = 0; k < count; ++k) shares.at(i, k) = -eigen.vectors[k * size + first[b - 1] + i];
    subtract_combination(modes.shapes, basis[b].fields, shares);
  }
  return modes;
}

Yielding yield_to(const ElasticBody& body, const FactoredBody& factored, const MassOrthonormal& rigid,
                  const NodalFields& accelerations) {
  NodalFields elastic = accelerations;
  subtract_combination(elastic, rigid.fields, inner_products(rigid.times_mass, elastic));
  const NodalFields forces = body.times_mass(elastic);
  Yielding result;
  result.displacements = factored.solve(forces);
  subtract_combination(result.displacements, rigid.fields, inner_products(rigid.times_mass, result.displacements));
  result.work = inner_products(forces, result.displacements);
  return result;
}

}  // namespace tetsoup
