#include "distance/farthest_voxel.h"

#include <cmath>
#include <limits>
#include <queue>

namespace tetsoup {
namespace {

constexpr int kFirstBlock = 32;     ///< Voxels along an edge of the blocks the search starts from.
constexpr float kRounding = 1e-3F;  ///< Voxels; more than the error of a computed distance.

struct Block {
  float bound = 0;  ///< No voxel of the block is farther than this.
  std::array<int, 3> begin{}, end{};
  bool operator<(const Block& other) const { return bound < other.bound; }
};

class Search {
 public:
  Search(const TriangleTree& tree, const GridFrame& frame) : tree_(tree) {
    for (std::size_t i = 0; i < 3; ++i) end_[i] = frame.size[i] - frame.pad;
    const int pad = frame.pad;
    for (int z = pad; z < end_[2]; z += kFirstBlock)
      for (int y = pad; y < end_[1]; y += kFirstBlock)
        for (int x = pad; x < end_[0]; x += kFirstBlock)
          add({x, y, z}, {x + kFirstBlock, y + kFirstBlock, z + kFirstBlock});
  }

  float run(StageWatch& watch) {
    std::size_t steps = 0;
    while (!open_.empty() && open_.top().bound > std::sqrt(best_) - kRounding) {
      const Block block = open_.top();
      open_.pop();
      split(block);
      if (++steps % 64 == 0) watch.step(0);
    }
    return best_;
  }

 private:
  float query(float x, float y, float z) const {
    return tree_.nearest_squared(x, y, z, std::numeric_limits<float>::max());
  }

  void add(std::array<int, 3> begin, std::array<int, 3> end) {
    float radius_squared = 0;
    std::array<float, 3> centre{};
    for (std::size_t i = 0; i < 3; ++i) {
      end[i] = std::min(end[i], end_[i]);
      if (begin[i] >= end[i]) return;
      centre[i] = 0.5F * static_cast<float>(begin[i] + end[i] - 1);
      const float half = 0.5F * static_cast<float>(end[i] - 1 - begin[i]);
      radius_squared += half * half;
    }
    const float square = query(centre[0], centre[1], centre[2]);
    if (radius_squared == 0) {
      best_ = std::max(best_, square);
    } else {
      open_.push({std::sqrt(square) + std::sqrt(radius_squared), begin, end});
    }
  }

  void split(const Block& b) {
    std::array<int, 3> middle{};
    for (std::size_t i = 0; i < 3; ++i) middle[i] = (b.begin[i] + b.end[i] + 1) / 2;
    for (unsigned octant = 0; octant < 8; ++octant) {
      std::array<int, 3> begin{}, end{};
      for (std::size_t i = 0; i < 3; ++i) {
        const bool upper = (octant >> i) & 1U;
        begin[i] = upper ? middle[i] : b.begin[i];
        end[i] = upper ? b.end[i] : middle[i];
      }
      add(begin, end);
    }
  }

  const TriangleTree& tree_;
  std::array<int, 3> end_{};
  std::priority_queue<Block> open_;
  float best_ = 0;
};

}  // namespace

float farthest_voxel_squared(const TriangleTree& tree, const GridFrame& frame, StageWatch& watch) {
  return Search(tree, frame).run(watch);
}

}  // namespace tetsoup
