// Stiffness plus a little mass, factored once, for as many right sides as are asked for.
#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "calibrate/dissection.h"
#include "calibrate/elastic_body.h"

namespace tetsoup {

/// Cholesky's factor of K + shift M, front by front [DuffReid83]: dense inner loops, by kernel/dense_product.h.
class FactoredBody {
 public:
  /// @param shift  Above zero: K alone leaves a free body its six rigid motions.
  FactoredBody(const ElasticBody& body, const Dissection& dissection, double shift, StageWatch& watch);

  /// False where a pivot was not positive: tets that are all but flat, or stiffness that is none.
  bool positive() const { return positive_; }
  std::size_t entry_count() const;

  /// (K + shift M)^-1 of every column. All threads, by columns.
  NodalFields solve(const NodalFields& right_sides) const;

 private:
  struct Block {
    std::vector<double> factor;  ///< (own + boundary) x own rows, a column after the other.
  };
  void factor_front(const ElasticBody& body, std::size_t index, double shift);
  void solve_columns(const NodalFields& from, NodalFields& to, std::size_t begin, std::size_t end) const;

  const Dissection& dissection_;
  std::vector<Block> blocks_;
  std::vector<std::vector<double>> updates_;  ///< What each front leaves to its parent, while factoring.
  std::vector<std::uint8_t> bad_;
  bool positive_ = true;
};

}  // namespace tetsoup
