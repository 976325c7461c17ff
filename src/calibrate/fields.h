// Columns of values at vertices as vectors: inner products, combinations, an orthonormal basis of their span.
#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/elastic_body.h"

namespace tetsoup {

/// A small matrix, (rows, columns), a row after the other.
struct SmallMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;

  SmallMatrix() = default;
  SmallMatrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), values(row_count * column_count, 0.0) {}
  double& at(std::size_t i, std::size_t j) { return values[i * columns + j]; }
  double at(std::size_t i, std::size_t j) const { return values[i * columns + j]; }
};

/// A^T B. Chunks of rows are added in their order: the same bits with any number of threads.
SmallMatrix inner_products(const NodalFields& a, const NodalFields& b);

/// A times a matrix of (A's columns, new columns).
NodalFields combine(const NodalFields& a, const SmallMatrix& coefficients);

/// `from` -= A times a matrix of (A's columns, from's columns).
void subtract_combination(NodalFields& from, const NodalFields& a, const SmallMatrix& coefficients);

/// Fields that are orthonormal in the product of the mass, and mass times them.
struct MassOrthonormal {
  NodalFields fields, times_mass;
};

/// The part of the columns' span that is at a right angle, by mass, to all of a basis. Columns that add nothing go.
MassOrthonormal orthonormal_part(const ElasticBody& body, NodalFields columns,
                                 const std::vector<MassOrthonormal>& basis);

}  // namespace tetsoup
