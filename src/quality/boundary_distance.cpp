#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/morton.h"
#include "base/parallel.h"
#include "base/tet_faces.h"
#include "base/vec.h"
#include "kernel/triangle_distance.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

constexpr int kParts = 3;            // A boundary triangle is asked at the centres of so many parts along each side.
constexpr double kCodeRange = 8000;  // Morton codes tell an eighth of a unit up to 8191.

/// A binary tree of boxes over the triangles along a Morton curve, halved by count: for a few thousand questions, where
/// building counts for more than asking.
class TriangleBoxes {
 public:
  TriangleBoxes(const TriangleSoup& soup, StageWatch& watch) : soup_(soup) {
    find_box();
    const auto centre = [&](std::size_t i) {
      const auto [a, b, c] = soup_.triangles[usable_[i]];
      const Vec3d sum = place(a) + place(b) + place(c);
      return to_float(sum * (kCodeRange / 3));
    };
    for (const MortonEntry& entry : morton_order(usable_.size(), centre, watch)) order_.push_back(usable_[entry.index]);
    leaves_ = (order_.size() + kLeaf - 1) / kLeaf;
    if (leaves_ == 0) return;
    first_leaf_ = std::bit_ceil(leaves_);
    boxes_.assign(2 * first_leaf_, Box{});
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf) {
      for (std::size_t i = leaf * kLeaf; i < std::min(order_.size(), (leaf + 1) * kLeaf); ++i) {
        for (const std::uint32_t v : soup_.triangles[order_[i]]) boxes_[first_leaf_ + leaf].add(to_float(place(v)));
      }
    }
    for (std::size_t node = first_leaf_ - 1; node > 0; --node) {
      boxes_[node] = boxes_[2 * node];
      boxes_[node].add(boxes_[2 * node + 1]);
    }
  }

  bool empty() const { return order_.empty(); }

  /// Distance from the nearest triangle, where `near` is a triangle to begin with, which becomes the nearest.
  double distance(const Vec3d& at, std::uint32_t& near) const {
    const Vec3 p = to_float((at - lo_) * scale_);
    float best = squared_distance(near, p);
    visit(1, p, best, near);
    return std::sqrt(static_cast<double>(best)) / scale_;
  }
  std::uint32_t any() const { return order_[0]; }

 private:
  static constexpr std::size_t kLeaf = 4;
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  struct Box {
    Vec3 lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};
    void add(const Vec3& p) { lo = min(lo, p), hi = max(hi, p); }
    void add(const Box& box) { lo = min(lo, box.lo), hi = max(hi, box.hi); }  // an empty one adds nothing
    float squared_distance(const Vec3& p) const {
      const float dx = std::max({lo.x - p.x, p.x - hi.x, 0.0F}), dy = std::max({lo.y - p.y, p.y - hi.y, 0.0F}),
                  dz = std::max({lo.z - p.z, p.z - hi.z, 0.0F});
      return dx * dx + dy * dy + dz * dz;
    }
  };

  /// The box of the finite triangles, whose longest side becomes 1.
  void find_box() {
    const auto is_usable = [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
        if (v >= soup_.vertices.size()) return false;
        const Vec3& p = soup_.vertices[v];
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
      });
    };
    Vec3d hi;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      if (!is_usable(soup_.triangles[t])) continue;
      if (usable_.empty()) lo_ = hi = to_double(soup_.vertices[soup_.triangles[t][0]]);
      for (const std::uint32_t v : soup_.triangles[t]) {
        lo_ = min(lo_, to_double(soup_.vertices[v])), hi = max(hi, to_double(soup_.vertices[v]));
      }
      usable_.push_back(t);
    }
    const double longest = std::max({hi.x - lo_.x, hi.y - lo_.y, hi.z - lo_.z});
    scale_ = longest > 0 ? 1 / longest : 1;
  }

  Vec3d place(std::uint32_t v) const { return (to_double(soup_.vertices[v]) - lo_) * scale_; }

  float squared_distance(std::uint32_t triangle, const Vec3& p) const {
    const auto [a, b, c] = soup_.triangles[triangle];
    return kernel::squared_distance(kernel::plan_triangle(to_float(place(a)), to_float(place(b)), to_float(place(c))),
                                    p.x, p.y, p.z);
  }

  void visit(std::size_t node, const Vec3& p, float& best, std::uint32_t& near) const {
    if (node >= first_leaf_) {
      const std::size_t leaf = node - first_leaf_;
      for (std::size_t i = leaf * kLeaf; i < std::min(order_.size(), (leaf + 1) * kLeaf); ++i) {
        const float square = squared_distance(order_[i], p);
        if (square < best) best = square, near = order_[i];
      }
      return;
    }
    std::size_t first = 2 * node, second = 2 * node + 1;
    float to_first = boxes_[first].squared_distance(p), to_second = boxes_[second].squared_distance(p);
    if (to_second < to_first) std::swap(first, second), std::swap(to_first, to_second);
    if (to_first < best) visit(first, p, best, near);
    if (to_second < best) visit(second, p, best, near);
  }

  const TriangleSoup& soup_;
  std::vector<std::uint32_t> usable_, order_;
  Vec3d lo_;
  double scale_ = 1;
  std::size_t leaves_ = 0, first_leaf_ = 1;
  std::vector<Box> boxes_;  ///< Node i has the children 2 i and 2 i + 1; node 1 is the root.
};

struct Sample {
  double distance, area;
};

/// The samples of one boundary triangle, one after the other so that each starts with the nearest of the last.
void ask(const TetMesh& mesh, const Triangle& triangle, const TriangleBoxes& boxes, std::vector<Sample>& samples) {
  const Vec3d a = to_double(mesh.vertices[triangle[0]]), b = to_double(mesh.vertices[triangle[1]]),
              c = to_double(mesh.vertices[triangle[2]]);
  const double area = length(cross(b - a, c - a)) / 2;
  std::uint32_t near = boxes.any();
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; i + j < kParts; ++j) {
      const double u = (i + 1.0 / 3) / kParts, v = (j + 1.0 / 3) / kParts;
      samples.push_back({boxes.distance(a * (1 - u - v) + b * u + c * v, near), area});
    }
  }
}

}  // namespace

BoundaryDistance boundary_distance(const TetMesh& mesh, const TriangleSoup& soup, double unit) {
  const Progress nobody;
  StageWatch watch(nobody, "quality");
  const std::vector<Triangle> boundary = boundary_triangles(mesh);
  const TriangleBoxes boxes(soup, watch);
  if (boundary.empty() || boxes.empty()) return {};
  constexpr std::int64_t kGrain = 64;
  std::vector<std::vector<Sample>> chunks(
      static_cast<std::size_t>(chunk_count(static_cast<std::int64_t>(boundary.size()), kGrain)));
  parallel_for(static_cast<std::int64_t>(boundary.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    auto& samples = chunks[static_cast<std::size_t>(begin / kGrain)];
    for (std::int64_t t = begin; t < end; ++t) ask(mesh, boundary[static_cast<std::size_t>(t)], boxes, samples);
  });
  std::vector<Sample> samples;
  for (const auto& chunk : chunks) samples.insert(samples.end(), chunk.begin(), chunk.end());
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.area < b.area;
  });
  double area = 0, sum = 0;
  for (const Sample& s : samples) area += s.area, sum += s.area * s.distance;
  if (!(area > 0)) return {};
  BoundaryDistance result{sum / area / unit, 0};
  double within = 0;
  for (const Sample& s : samples) {
    within += s.area;
    result.percentile95 = s.distance / unit;
    if (within >= 0.95 * area) break;
  }
  return result;
}

}  // namespace tetsoup
