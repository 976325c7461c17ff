#include "distance/farthest_voxel.h"

#include <cmath>
#include <limits>
#include <queue>

namespace tetsoup {
namespace {

constexpr int kFirstBlock = 32;     ///< Voxels along an edge of the blocks the search starts from.
constexpr float kRounding = 1e-3F;  ///< Voxels; more than the error of a computed distance.
constexpr int kAtOnce = 8;          ///< Blocks split together, so that their parts can be measured in parallel.
constexpr float kFar = std::numeric_limits<float>::max();

struct Block {
  float bound = 0;  ///< No voxel of the block is farther than this; first, what its parent knows.
  std::array<int, 3> begin{}, end{};
  bool operator<(const Block& other) const { return bound < other.bound; }
};

class Search {
 public:
  Search(const NearestSquared& nearest, const GridFrame& frame) : nearest_(nearest) {
    for (std::size_t i = 0; i < 3; ++i) end_[i] = frame.size[i] - frame.pad;
    const int pad = frame.pad;
    for (int z = pad; z < end_[2]; z += kFirstBlock)
      for (int y = pad; y < end_[1]; y += kFirstBlock)
        for (int x = pad; x < end_[0]; x += kFirstBlock)
          found_.push_back({kFar, {x, y, z}, {x + kFirstBlock, y + kFirstBlock, z + kFirstBlock}});
  }

  float run(StageWatch& watch) {
    measure_found(watch);
    while (!open_.empty() && open_.top().bound > std::sqrt(best_) - kRounding) {
      for (int i = 0; i < kAtOnce && !open_.empty(); ++i) {
        split(open_.top());
        open_.pop();
      }
      measure_found(watch);
    }
    return best_;
  }

 private:
  /// Asks for the distance of the new blocks' centres and opens the blocks, or closes them if they are single voxels.
  void measure_found(StageWatch& watch) {
    std::vector<float> squares(found_.size());
    parallel_for(static_cast<std::int64_t>(found_.size()), 4, watch, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const std::array<float, 3> c = centre(found_[i]);
        const float bound = found_[i].bound < kFar ? found_[i].bound * found_[i].bound : kFar;
        squares[i] = nearest_(c[0], c[1], c[2], bound);
      }
    });
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const float radius = half_diagonal(found_[i]);
      if (radius == 0)
        best_ = std::max(best_, squares[i]);
      else
        open_.push({std::sqrt(squares[i]) + radius, found_[i].begin, found_[i].end});
    }
    found_.clear();
  }

  std::array<float, 3> centre(const Block& b) const {
    std::array<float, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) c[i] = 0.5F * static_cast<float>(b.begin[i] + std::min(b.end[i], end_[i]) - 1);
    return c;
  }
  float half_diagonal(const Block& b) const {
    float square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const float half = 0.5F * static_cast<float>(std::min(b.end[i], end_[i]) - 1 - b.begin[i]);
      square += half * half;
    }
    return std::sqrt(square);
  }

  void split(const Block& b) {
    std::array<int, 3> middle{};
    for (std::size_t i = 0; i < 3; ++i) middle[i] = (b.begin[i] + std::min(b.end[i], end_[i]) + 1) / 2;
    for (unsigned octant = 0; octant < 8; ++octant) {
      Block child{b.bound * 1.001F + 0.01F, {}, {}};
      bool empty = false;
      for (std::size_t i = 0; i < 3; ++i) {
        const bool upper = (octant >> i) & 1U;
        child.begin[i] = upper ? middle[i] : b.begin[i];
        child.end[i] = upper ? std::min(b.end[i], end_[i]) : middle[i];
        empty |= child.begin[i] >= child.end[i];
      }
      if (!empty) found_.push_back(child);
    }
  }

  const NearestSquared& nearest_;
  std::array<int, 3> end_{};
  std::vector<Block> found_;  ///< Not measured yet.
  std::priority_queue<Block> open_;
  float best_ = 0;
};

}  // namespace

float farthest_voxel_squared(const NearestSquared& nearest, const GridFrame& frame, StageWatch& watch) {
  return Search(nearest, frame).run(watch);
}

}  // namespace tetsoup
