// A tet mesh as a linear elastic body: stiffness and mass of its linear tets, in units in which nothing is large.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/groups.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Columns of values at vertices: entry (3 vertex + axis, column) at values[(3 vertex + axis) * columns + column].
struct NodalFields {
  std::size_t columns = 0;
  std::vector<double> values;

  NodalFields() = default;
  NodalFields(std::size_t rows, std::size_t column_count) : columns(column_count), values(rows * column_count, 0.0) {}
  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  double* row(std::size_t i) { return values.data() + i * columns; }
  const double* row(std::size_t i) const { return values.data() + i * columns; }
};

/// Of the material of all tets before they are scaled: Young's modulus 1, density 1.
struct LameConstants {
  double lambda = 0, mu = 0;
};
LameConstants lame_constants(double poisson);

/// One linear tet: the gradients of its barycentric coordinates, and its volume.
struct ElasticTet {
  std::array<Vec3d, 4> gradients;
  double volume = 0;
};

/// The pattern of a mesh's matrices and their entries: 3 x 3 blocks for vertices that share a tet, in rows by vertex.
class ElasticBody {
 public:
  /// @param points  In any unit; only vertices that tets name.
  ElasticBody(std::vector<Vec3d> points, std::vector<Tet> tets, double poisson);

  /// Young's modulus and density of every tet, over those of the material.
  void assemble(std::span<const double> stiffness, std::span<const double> density);

  std::size_t vertex_count() const { return points_.size(); }
  std::size_t tet_count() const { return tets_.size(); }
  const std::vector<Vec3d>& points() const { return points_; }
  const std::vector<Tet>& tets() const { return tets_; }
  const ElasticTet& tet(std::size_t t) const { return elements_[t]; }

  /// Vertices beside a vertex, itself included, ascending.
  std::span<const std::uint32_t> neighbours(std::size_t vertex) const { return neighbours_[vertex]; }
  /// Of the i-th of them: stiffness block, in rows, and the entry of the mass matrix.
  const std::array<double, 9>& stiffness_block(std::size_t vertex, std::size_t i) const {
    return stiffness_[first_[vertex] + i];
  }
  double mass_entry(std::size_t vertex, std::size_t i) const { return mass_[first_[vertex] + i]; }

  NodalFields times_stiffness(const NodalFields& fields) const;
  NodalFields times_mass(const NodalFields& fields) const;
  /// u^T K_t u of every tet and column, for Young's modulus 1: tet t, column j at [t * columns + j].
  std::vector<double> unit_energies(const NodalFields& fields) const;

 private:
  std::vector<Vec3d> points_;
  std::vector<Tet> tets_;
  LameConstants lame_;
  std::vector<ElasticTet> elements_;
  Groups<std::uint32_t> neighbours_;
  std::vector<std::size_t> first_;  ///< Of a vertex's blocks.
  std::vector<std::array<double, 9>> stiffness_;
  std::vector<double> mass_;
};

}  // namespace tetsoup
