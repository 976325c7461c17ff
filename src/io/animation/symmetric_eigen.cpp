#include "io/animation/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetsoup::animation {
namespace {

/// Turns the plane of axes p and q so that element (p, q) becomes zero.
void rotate(std::vector<double>& a, std::vector<double>& vectors, std::size_t n, std::size_t p, std::size_t q) {
  const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = a[i * n + p], y = a[i * n + q];
    a[i * n + p] = c * x - s * y;
    a[i * n + q] = s * x + c * y;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double x = a[p * n + i], y = a[q * n + i];
    a[p * n + i] = c * x - s * y;
    a[q * n + i] = s * x + c * y;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double x = vectors[p * n + i], y = vectors[q * n + i];
    vectors[p * n + i] = c * x - s * y;
    vectors[q * n + i] = s * x + c * y;
  }
}

}  // namespace

EigenSystem symmetric_eigen(std::vector<double> a, std::size_t n) {
  constexpr int kMaxSweeps = 40;   // It converges quadratically; ten are much already.
  constexpr double kTiny = 1e-15;  // Of the largest element of the diagonal.
  std::vector<double> vectors(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) vectors[i * n + i] = 1;
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(a[i * n + i]));
    bool turned = false;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        if (!(std::abs(a[p * n + q]) > kTiny * largest)) continue;
        rotate(a, vectors, n, p, q);
        turned = true;
      }
    if (!turned) break;
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return a[i * n + i] > a[j * n + j]; });
  EigenSystem system;
  for (const std::size_t i : order) {
    system.values.push_back(a[i * n + i]);
    const auto row = vectors.begin() + static_cast<std::ptrdiff_t>(i * n);
    system.vectors.insert(system.vectors.end(), row, row + static_cast<std::ptrdiff_t>(n));
  }
  return system;
}

}  // namespace tetsoup::animation
