#include "calibrate/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetsoup {

namespace {

/// A symmetric matrix as Q T Q^T; row i of `q` is what the i-th unit vector of T stands for.
struct Tridiagonal {
  std::vector<double> diagonal, beside;  ///< beside[i] ties i and i + 1.
  std::vector<double> q;
};

/// Mirrors every column of the matrix onto its first entry below the diagonal, from both sides.
Tridiagonal reduce(std::vector<double>& a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) a[j * n + i] = a[i * n + j];
  Tridiagonal t;
  t.q.assign(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) t.q[i * n + i] = 1;
  std::vector<double> v(n), p(n);
  for (std::size_t k = 0; k + 2 < n; ++k) {
    double square = 0;
    for (std::size_t i = k + 1; i < n; ++i) square += a[i * n + k] * a[i * n + k];
    const double norm = std::sqrt(square);
    if (!(norm > 0)) continue;
    std::fill(v.begin(), v.end(), 0.0);
    for (std::size_t i = k + 1; i < n; ++i) v[i] = a[i * n + k];
    v[k + 1] += v[k + 1] < 0 ? -norm : norm;
    double length = 0;
    for (std::size_t i = k + 1; i < n; ++i) length += v[i] * v[i];
    const double factor = 2 / length;
    // A - v w^T - w v^T with w = factor (A v - factor / 2 (v . A v) v).
    double along = 0;
    for (std::size_t i = k; i < n; ++i) {
      double sum = 0;
      for (std::size_t j = k + 1; j < n; ++j) sum += a[i * n + j] * v[j];
      p[i] = factor * sum;
      along += p[i] * v[i];
    }
    for (std::size_t i = k; i < n; ++i) p[i] -= factor / 2 * along * v[i];
    for (std::size_t i = k; i < n; ++i)
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= v[i] * p[j] + p[i] * v[j];
    for (std::size_t j = 0; j < n; ++j) p[j] = 0;
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) p[j] += v[i] * t.q[i * n + j];
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) t.q[i * n + j] -= factor * v[i] * p[j];
  }
  for (std::size_t i = 0; i < n; ++i) {
    t.diagonal.push_back(a[i * n + i]);
    t.beside.push_back(i + 1 < n ? a[(i + 1) * n + i] : 0);
  }
  return t;
}

/// Rotates rows i and i + 1 of the vectors.
void rotate(std::vector<double>& q, std::size_t n, std::size_t i, double c, double s) {
  double* first = &q[i * n];
  double* second = &q[(i + 1) * n];
  for (std::size_t j = 0; j < n; ++j) {
    const double f = second[j];
    second[j] = s * first[j] + c * f;
    first[j] = c * first[j] - s * f;
  }
}

/// One step of QL from m up to l, shifted by the eigenvalue of the first two that is nearer to the first.
void ql_step(Tridiagonal& t, std::size_t n, std::size_t l, std::size_t m) {
  auto& d = t.diagonal;
  auto& e = t.beside;
  double g = (d[l + 1] - d[l]) / (2 * e[l]);
  double r = std::sqrt(g * g + 1);
  g = d[m] - d[l] + e[l] / (g + (g < 0 ? -r : r));
  double s = 1, c = 1, p = 0;
  for (std::size_t i = m; i-- > l;) {
    const double f = s * e[i], b = c * e[i];
    r = std::sqrt(f * f + g * g);
    e[i + 1] = r;
    if (r == 0) {
      d[i + 1] -= p;
      e[m] = 0;
      return;
    }
    s = f / r;
    c = g / r;
    g = d[i + 1] - p;
    r = (d[i] - g) * s + 2 * c * b;
    p = s * r;
    d[i + 1] = g + p;
    g = c * r - b;
    rotate(t.q, n, i, c, s);
  }
  d[l] -= p;
  e[l] = g;
  e[m] = 0;
}

}  // namespace

SymmetricEigen symmetric_eigen(std::vector<double> matrix, std::size_t n) {
  constexpr int kMostSteps = 60;  // An eigenvalue takes two or three.
  Tridiagonal t = reduce(matrix, n);
  for (std::size_t l = 0; l < n; ++l) {
    for (int step = 0; step < kMostSteps; ++step) {
      std::size_t m = l;
      while (m + 1 < n) {
        const double size = std::abs(t.diagonal[m]) + std::abs(t.diagonal[m + 1]);
        if (size + std::abs(t.beside[m]) == size) break;
        ++m;
      }
      if (m == l) break;
      ql_step(t, n, l, m);
    }
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return t.diagonal[a] < t.diagonal[b]; });
  SymmetricEigen result;
  for (const std::size_t i : order) {
    result.values.push_back(t.diagonal[i]);
    const auto row = t.q.begin() + static_cast<std::ptrdiff_t>(i * n);
    result.vectors.insert(result.vectors.end(), row, row + static_cast<std::ptrdiff_t>(n));
  }
  return result;
}

}  // namespace tetsoup
