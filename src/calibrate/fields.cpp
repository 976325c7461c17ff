#include "calibrate/fields.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/symmetric_eigen.h"
#include "kernel/dense_product.h"

namespace tetsoup {

namespace {

constexpr std::int64_t kRows = 512;    ///< A chunk: what two fields of 40 columns have of it stays in the cache.
constexpr double kRounding = 1e-18;    ///< Share of a column's square that may be left of one that adds nothing.
constexpr double kNothingNew = 1e-10;  ///< Share of the largest square that is rounding and no direction.

struct Summed {
  std::vector<double> values;
  Summed& operator+=(const Summed& other) {
    if (values.empty()) values.assign(other.values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= other.values[i];
    return *this;
  }
};

}  // namespace

SmallMatrix inner_products(const NodalFields& a, const NodalFields& b) {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  const auto rows = static_cast<std::int64_t>(a.rows());
  // Each chunk is minus its products, since that is what the kernel makes; the sum subtracts it.
  const Summed sum = parallel_sum<Summed>(rows, kRows, watch, [&](std::int64_t begin, std::int64_t end) {
    Summed own{std::vector<double>(a.columns * b.columns, 0.0)};
    const auto first = static_cast<std::size_t>(begin);
    kernel::subtract_product(own.values.data(), b.columns, b.columns, a.columns, b.row(first), b.columns,
                             {a.row(first), a.columns, 1}, static_cast<std::size_t>(end - begin));
    return own;
  });
  SmallMatrix result(a.columns, b.columns);
  if (!sum.values.empty()) result.values = sum.values;
  return result;
}

void subtract_combination(NodalFields& from, const NodalFields& a, const SmallMatrix& coefficients) {
  const Progress nobody;
  StageWatch watch(nobody, "calibrate");
  parallel_for(static_cast<std::int64_t>(a.rows()), kRows, watch, [&](std::int64_t begin, std::int64_t end) {
    const auto first = static_cast<std::size_t>(begin);
    kernel::subtract_product(from.row(first), from.columns, from.columns, static_cast<std::size_t>(end - begin),
                             coefficients.values.data(), coefficients.columns, {a.row(first), 1, a.columns}, a.columns);
  });
}

NodalFields combine(const NodalFields& a, const SmallMatrix& coefficients) {
  NodalFields result(a.rows(), coefficients.columns);
  subtract_combination(result, a, coefficients);
  for (double& value : result.values) value = -value;
  return result;
}

MassOrthonormal orthonormal_part(const ElasticBody& body, NodalFields columns,
                                 const std::vector<MassOrthonormal>& basis) {
  MassOrthonormal part{std::move(columns), {}};
  NodalFields& fields = part.fields;
  for (int pass = 0; pass < 2; ++pass) {  // The second takes what rounding left: twice is enough.
    if (fields.columns == 0) break;
    const SmallMatrix lengths = inner_products(fields, body.times_mass(fields));
    for (const MassOrthonormal& block : basis)
      subtract_combination(fields, block.fields, inner_products(block.times_mass, fields));
    SmallMatrix products = inner_products(fields, body.times_mass(fields));
    // Columns are first made equally long, so that the small eigenvalues tell directions and not lengths.
    std::vector<double> scale(fields.columns);
    for (std::size_t i = 0; i < scale.size(); ++i)
      scale[i] = products.at(i, i) > kRounding * lengths.at(i, i) ? 1 / std::sqrt(products.at(i, i)) : 0;
    for (std::size_t i = 0; i < scale.size(); ++i)
      for (std::size_t j = 0; j < scale.size(); ++j) products.at(i, j) *= scale[i] * scale[j];
    const SymmetricEigen eigen = symmetric_eigen(products.values, scale.size());
    std::vector<std::size_t> kept;
    const double least = (pass == 0 ? kNothingNew : 0.5) * eigen.values.back();
    for (std::size_t e = eigen.values.size(); e-- > 0;)
      if (eigen.values[e] > least) kept.push_back(e);
    SmallMatrix turn(scale.size(), kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const double length = 1 / std::sqrt(eigen.values[kept[k]]);
      for (std::size_t i = 0; i < scale.size(); ++i)
        turn.at(i, k) = scale[i] * length * eigen.vectors[kept[k] * scale.size() + i];
    }
    fields = combine(fields, turn);
  }
  part.times_mass = body.times_mass(fields);
  return part;
}

}  // namespace tetsoup
