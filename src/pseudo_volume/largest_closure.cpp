#include "pseudo_volume/largest_closure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "base/bits.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kRowsAtOnce = 256;

using Voxel = std::array<int, 3>;

/// Faces farther from the soup than the sealed voxels reach.
struct FarFaces {
  float farthest = 0;          ///< Of those whose distance is known; in the soup's unit.
  std::vector<Voxel> unknown;  ///< One voxel of each of the others.
  void operator+=(const FarFaces& other) {
    farthest = std::max(farthest, other.farthest);
    unknown.insert(unknown.end(), other.unknown.begin(), other.unknown.end());
  }
};

FarFaces find_far_faces(const BitGrid& inside, const BlockGrid& distance, const BitGrid& sealed, StageWatch& watch) {
  const BitRows in(inside), near(sealed);
  const std::size_t words = inside.words_per_row;
  const std::array<int, 3>& size = inside.frame.size;
  const auto rows_at_once = [&](std::int64_t begin, std::int64_t end) {
    FarFaces found;
    for (std::int64_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row % size[1]), z = static_cast<int>(row / size[1]);
      const auto note = [&](std::size_t w, std::uint64_t far, const Voxel& step) {
        for (; far != 0; far &= far - 1) {
          const int x = static_cast<int>(64 * w) + std::countr_zero(far);
          if (x + step[0] >= size[0]) return;
          const float d = std::min(distance.at(x, y, z), distance.at(x + step[0], y + step[1], z + step[2]));
          if (d < std::numeric_limits<float>::infinity())
            found.farthest = std::max(found.farthest, d);
          else
            found.unknown.push_back({x, y, z});
        }
      };
      const std::uint64_t *i0 = in.at(y, z), *iy = in.at(y + 1, z), *iz = in.at(y, z + 1);
      const std::uint64_t *n0 = near.at(y, z), *ny = near.at(y + 1, z), *nz = near.at(y, z + 1);
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t far_x = (i0[w] ^ shifted_down(i0, w, words)) & ~n0[w] & ~shifted_down(n0, w, words);
        const std::uint64_t far_y = iy == nullptr ? 0 : (i0[w] ^ iy[w]) & ~n0[w] & ~ny[w];
        const std::uint64_t far_z = iz == nullptr ? 0 : (i0[w] ^ iz[w]) & ~n0[w] & ~nz[w];
        if ((far_x | far_y | far_z) == 0) continue;
        note(w, far_x, {1, 0, 0});
        note(w, far_y, {0, 1, 0});
        note(w, far_z, {0, 0, 1});
      }
    }
    return found;
  };
  return parallel_sum<FarFaces>(std::int64_t{size[1]} * size[2], kRowsAtOnce, watch, rows_at_once);
}

double squared_distance(const Voxel& a, const Voxel& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// The voxels that the soup touches, in boxes of 8^3, for the nearest one to any voxel.
class TouchedBoxes {
 public:
  explicit TouchedBoxes(const BitGrid& touched) {
    for (std::size_t i = 0; i < 3; ++i) size_[i] = (touched.frame.size[i] + kEdge - 1) / kEdge;
    boxes_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                  static_cast<std::size_t>(size_[2]));
    const std::size_t words = touched.words_per_row, ny = static_cast<std::size_t>(touched.frame.size[1]);
    for (std::size_t i = 0; i < touched.words.size(); ++i) {
      const std::size_t row = i / words;
      for (std::uint64_t bits = touched.words[i]; bits != 0; bits &= bits - 1) {
        const Voxel v{static_cast<int>(64 * (i % words)) + std::countr_zero(bits), static_cast<int>(row % ny),
                      static_cast<int>(row / ny)};
        boxes_[index({v[0] / kEdge, v[1] / kEdge, v[2] / kEdge})].push_back(v);
      }
    }
  }

  /// Distance to the nearest touched voxel, in voxels: rings of boxes around the voxel's own, until none can be nearer.
  double nearest(const Voxel& v) const {
    const Voxel home{v[0] / kEdge, v[1] / kEdge, v[2] / kEdge};
    const int last = *std::max_element(size_.begin(), size_.end());
    double best = std::numeric_limits<double>::max();
    for (int ring = 0; ring <= last; ++ring) {
      const double beyond = std::max(0, (ring - 1) * kEdge);
      if (best <= beyond * beyond) break;
      for_ring(home, ring, [&](const std::vector<Voxel>& box) {
        for (const Voxel& other : box) best = std::min(best, squared_distance(v, other));
      });
    }
    return std::sqrt(best);
  }

 private:
  static constexpr int kEdge = 8;

  std::size_t index(const Voxel& box) const {
    return static_cast<std::size_t>((box[2] * size_[1] + box[1]) * size_[0] + box[0]);
  }
  template <class Body>
  void for_ring(const Voxel& home, int ring, const Body& body) const {
    const auto low = [&](std::size_t i) { return std::max(0, home[i] - ring); };
    const auto high = [&](std::size_t i) { return std::min(size_[i] - 1, home[i] + ring); };
    for (int z = low(2); z <= high(2); ++z)
      for (int y = low(1); y <= high(1); ++y)
        for (int x = low(0); x <= high(0); ++x)
          if (std::max({std::abs(x - home[0]), std::abs(y - home[1]), std::abs(z - home[2])}) == ring)
            body(boxes_[index({x, y, z})]);
  }

  Voxel size_{};
  std::vector<std::vector<Voxel>> boxes_;
};

/// The largest distance of some voxels from the touched ones. Most need not be asked for: the distance changes by at
/// most the step from the last one that was.
double farthest(const std::vector<Voxel>& voxels, const BitGrid& touched, StageWatch& watch) {
  const TouchedBoxes boxes(touched);
  double largest = 0, asked_distance = std::numeric_limits<double>::max();
  Voxel asked{};
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (i % 4096 == 0) watch.step(0);
    if (asked_distance + std::sqrt(squared_distance(voxels[i], asked)) <= largest) continue;
    asked = voxels[i];
    asked_distance = boxes.nearest(asked);
    largest = std::max(largest, asked_distance);
  }
  return largest;
}

}  // namespace

double largest_closure_voxels(const BitGrid& inside, const BlockGrid& distance, const SoupMarks& marks,
                              StageWatch& watch) {
  const FarFaces far = find_far_faces(inside, distance, marks.sealed, watch);
  const double known = static_cast<double>(far.farthest) / inside.frame.voxel_size;
  const auto any = [](const BitGrid& bits) {
    return std::any_of(bits.words.begin(), bits.words.end(), [](std::uint64_t word) { return word != 0; });
  };
  if (far.unknown.empty() || !any(marks.touched)) return 2 * known;
  return 2 * std::max(known, farthest(far.unknown, marks.touched, watch));
}

}  // namespace tetsoup
