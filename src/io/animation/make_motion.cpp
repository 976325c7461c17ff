#include "io/animation/make_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/tet_faces.h"
#include "base/vec.h"
#include "base/symmetric_eigen.h"

namespace tetsoup::animation {
namespace {

constexpr double kTolerance = 5e-4;     // Of the diagonal of the mesh's box: a quarter of a pixel in most pictures.
constexpr std::size_t kMaxBasis = 192;  // Shapes while frames come; the weights of all frames are kept.

std::vector<std::uint32_t> used_vertices(const TetMesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size());
  for (const Tet& tet : mesh.tets)
    if (is_valid_tet(tet, mesh.vertices.size()))
      for (const std::uint32_t v : tet) is_used[v] = true;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) used.push_back(v);
  return used;
}

/// The rotation that brings `from` nearest to `to` in the sum of squares [Horn87].
std::array<double, 4> best_rotation(const std::vector<Vec3d>& from, const std::vector<Vec3d>& to) {
  Vec3d x, y, z;  // Rows of the sum of from to^T.
  for (std::size_t i = 0; i < from.size(); ++i) {
    x += to[i] * from[i].x;
    y += to[i] * from[i].y;
    z += to[i] * from[i].z;
  }
  const SymmetricEigen eigen = symmetric_eigen({x.x + y.y + z.z, y.z - z.y, z.x - x.z, x.y - y.x,    //
                                                y.z - z.y, x.x - y.y - z.z, x.y + y.x, z.x + x.z,    //
                                                z.x - x.z, x.y + y.x, -x.x + y.y - z.z, y.z + z.y,   //
                                                x.y - y.x, z.x + x.z, y.z + z.y, -x.x - y.y + z.z},  //
                                               4);
  const double* const q = &eigen.vectors[12];  // of the largest: w, x, y, z
  return {q[1], q[2], q[3], q[0]};
}

Vec3d rotated(const std::array<double, 4>& q, const Vec3d& p) {
  const Vec3d axis{q[0], q[1], q[2]};
  const Vec3d turned = cross(axis, p) * 2;
  return p + turned * q[3] + cross(axis, turned);
}

double product(const std::vector<float>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double{a[i]} * b[i];
  return sum;
}

double squared(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// Sums of products of the weights of all frames.
std::vector<double> covariance(const std::vector<BodyTrack>& tracks, std::size_t n) {
  std::vector<double> sums(n * n);
  for (const BodyTrack& track : tracks)
    for (const MotionKey& key : track.keys)
      for (std::size_t i = 0; i < key.weights.size(); ++i)
        for (std::size_t j = 0; j < key.weights.size(); ++j)
          sums[i * n + j] += double{key.weights[i]} * double{key.weights[j]};
  return sums;
}

/// Along which the weights vary, one a row, the most first.
std::vector<double> axes_of(const std::vector<BodyTrack>& tracks, std::size_t n) {
  const SymmetricEigen eigen = symmetric_eigen(covariance(tracks, n), n);
  std::vector<double> axes;
  for (std::size_t k = n; k-- > 0;) axes.insert(axes.end(), &eigen.vectors[k * n], &eigen.vectors[k * n] + n);
  return axes;
}

/// Weights of the shapes that `vectors` combine from the old ones.
void turn_weights(std::vector<BodyTrack>& tracks, const std::vector<double>& vectors, std::size_t n) {
  for (BodyTrack& track : tracks)
    for (MotionKey& key : track.keys) {
      std::vector<float> weights(n);
      for (std::size_t k = 0; k < n; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < key.weights.size(); ++i) sum += vectors[k * n + i] * double{key.weights[i]};
        weights[k] = static_cast<float>(sum);
      }
      key.weights = std::move(weights);
    }
}

/// Drops all but the first `count` weights, and divides each of those by its largest, which is returned.
std::vector<double> scale_weights(std::vector<BodyTrack>& tracks, std::size_t count) {
  std::vector<double> largest(count);
  for (BodyTrack& track : tracks)
    for (MotionKey& key : track.keys) {
      for (std::size_t k = count; k < key.weights.size(); ++k)
        key.left_out += double{key.weights[k]} * double{key.weights[k]};
      key.weights.resize(count);
      for (std::size_t k = 0; k < count; ++k) largest[k] = std::max(largest[k], std::abs(double{key.weights[k]}));
    }
  for (BodyTrack& track : tracks)
    for (MotionKey& key : track.keys)
      for (std::size_t k = 0; k < count; ++k)
        key.weights[k] = largest[k] > 0 ? static_cast<float>(double{key.weights[k]} / largest[k]) : 0.0F;
  return largest;
}

/// How many of the leading weights tell every frame within tolerance.
std::size_t shapes_needed(const std::vector<BodyTrack>& tracks, std::size_t n, double tolerance_squared) {
  std::size_t needed = 0;
  for (const BodyTrack& track : tracks)
    for (const MotionKey& key : track.keys) {
      double rest = key.left_out;
      std::size_t count = n;
      while (count > needed) {
        rest += double{key.weights[count - 1]} * double{key.weights[count - 1]};
        if (rest > tolerance_squared) break;
        --count;
      }
      needed = std::max(needed, count);
    }
  return needed;
}

}  // namespace

MakeMotion::MakeMotion(const TetMesh& mesh, std::size_t body_count)
    : vertex_count_(mesh.vertices.size()), used_(used_vertices(mesh)), tracks_(body_count) {
  if (used_.empty()) return;
  Box3 box{to_double(mesh.vertices[used_[0]]), to_double(mesh.vertices[used_[0]])};
  for (const std::uint32_t v : used_) {
    const Vec3d p = to_double(mesh.vertices[v]);
    box = {min(box.lo, p), max(box.hi, p)};
    centre_ += p * (1 / static_cast<double>(used_.size()));
  }
  double sum = 0;
  for (const std::uint32_t v : used_) {
    rest_.push_back(to_double(mesh.vertices[v]) - centre_);
    sum += squared_length(rest_.back());
  }
  rest_size_ = std::sqrt(sum);
  tolerance_ = kTolerance * length(box.hi - box.lo);
}

double MakeMotion::tolerance_squared() const {
  return tolerance_ * tolerance_ * static_cast<double>(used_.size());
}

std::vector<double> MakeMotion::local_displacements(std::size_t body, std::span<const Vec3> positions, MotionKey& key) {
  BodyTrack& track = tracks_[body];
  Vec3d centre;
  for (const std::uint32_t v : used_) centre += to_double(positions[v]) * (1 / static_cast<double>(used_.size()));
  std::vector<Vec3d> moved;
  double sum = 0;
  for (const std::uint32_t v : used_) {
    moved.push_back(to_double(positions[v]) - centre);
    sum += squared_length(moved.back());
  }
  if (track.keys.empty() && sum > 0 && rest_size_ > 0) track.scale = std::sqrt(sum) / rest_size_;
  key.rotation = best_rotation(rest_, moved);
  if (!track.keys.empty()) {
    // Of the two quaternions that mean the same, the one that is nearer.
    const std::array<double, 4>& before = track.keys.back().rotation;
    double alike = 0;
    for (std::size_t i = 0; i < 4; ++i) alike += before[i] * key.rotation[i];
    if (alike < 0)
      for (double& part : key.rotation) part = -part;
  }
  key.translation = centre - rotated(key.rotation, centre_) * track.scale;
  const std::array<double, 4> back{-key.rotation[0], -key.rotation[1], -key.rotation[2], key.rotation[3]};
  std::vector<double> displacements;
  displacements.reserve(3 * used_.size());
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const Vec3d d = rotated(back, moved[i]) * (1 / track.scale) - rest_[i];
    displacements.insert(displacements.end(), {d.x, d.y, d.z});
  }
  return displacements;
}

void MakeMotion::add(std::size_t body, std::span<const Vec3> positions) {
  MotionKey key;
  if (!used_.empty()) {
    std::vector<double> rest = local_displacements(body, positions, key);
    key.weights.assign(basis_.size(), 0);
    for (int pass = 0; pass < 2; ++pass) {  // The second takes what rounding has left.
      for (std::size_t k = 0; k < basis_.size(); ++k) {
        const double weight = product(basis_[k], rest);
        key.weights[k] += static_cast<float>(weight);
        for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= weight * double{basis_[k][i]};
      }
    }
    key.left_out = squared(rest);
    // Half the tolerance is for this, half for the shapes that are dropped in the end.
    if (key.left_out > tolerance_squared() / 2 && basis_.size() < kMaxBasis) {
      const double size = std::sqrt(key.left_out);
      std::vector<float>& added = basis_.emplace_back();
      for (const double value : rest) added.push_back(static_cast<float>(value / size));
      key.weights.push_back(static_cast<float>(size));
      key.left_out = 0;
    }
  }
  tracks_[body].keys.push_back(std::move(key));
}

ReducedMotion MakeMotion::reduce(std::size_t max_shapes) {
  const std::size_t n = basis_.size();
  const std::vector<double> axes = axes_of(tracks_, n);
  turn_weights(tracks_, axes, n);
  const std::size_t count = std::min(shapes_needed(tracks_, n, tolerance_squared()), max_shapes);
  ReducedMotion motion;
  const std::vector<double> largest = scale_weights(tracks_, count);
  for (const BodyTrack& track : tracks_)
    for (const MotionKey& key : track.keys)
      motion.error =
          std::max(motion.error,
                   track.scale * std::sqrt(key.left_out / static_cast<double>(std::max<std::size_t>(1, used_.size()))));
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<Vec3d> sums(used_.size());
    for (std::size_t i = 0; i < n; ++i) {
      const double share = axes[k * n + i] * largest[k];
      for (std::size_t v = 0; v < used_.size(); ++v)
        sums[v] += Vec3d{basis_[i][3 * v], basis_[i][3 * v + 1], basis_[i][3 * v + 2]} * share;
    }
    std::vector<Vec3>& shape = motion.shapes.emplace_back(vertex_count_);
    for (std::size_t v = 0; v < used_.size(); ++v) shape[used_[v]] = to_float(sums[v]);
  }
  motion.tracks = std::move(tracks_);
  return motion;
}

}  // namespace tetsoup::animation
