#include "simulate/rounds.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace tetsoup::simulate {
namespace {

/// Larger runs are halved: 40 us of work, beside which it costs little to give it to another thread.
constexpr std::size_t kRunTets = 3000;
/// A layer is not worth more halvings than this, nor is what cannot be parted.
constexpr int kMostHalvings = 24;

class Splitter {
 public:
  explicit Splitter(const Piece& piece) : piece_(piece), marked_(piece.places.size(), 0) {
    for (const Tet& tet : piece.tets) middles_.push_back(middle_of(corners_at(piece.places, tet)));
  }

  std::vector<std::vector<TetRun>> rounds_of(TetRun tets, int halvings) {
    if (tets.empty()) return {};
    if (tets.size() <= kRunTets || halvings == 0) return {{std::move(tets)}};
    const std::size_t axis = longest_axis(tets);
    auto [low, high] = halves(tets, axis, tets.size() / 2);
    TetRun layer = take_layer(low, high);
    // Once more, so that the halves are even without the layer, which has been taken from one of them.
    std::tie(low, high) = halves(tets, axis, (tets.size() - layer.size()) / 2);
    layer = take_layer(low, high);
    std::vector<std::vector<TetRun>> rounds = rounds_of(std::move(low), halvings - 1);
    join(rounds, rounds_of(std::move(high), halvings - 1), 0);
    join(rounds, rounds_of(std::move(layer), halvings - 1), rounds.size());
    return rounds;
  }

 private:
  static std::array<double, 3> middle_of(const TetCorners& p) {
    const Vec3d sum = p[0] + p[1] + p[2] + p[3];
    return {sum.x, sum.y, sum.z};
  }

  std::size_t longest_axis(const TetRun& tets) const {
    std::array<double, 3> extent{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [least, most] = std::minmax_element(tets.begin(), tets.end(), [&](std::uint32_t a, std::uint32_t b) {
        return middles_[a][axis] < middles_[b][axis];
      });
      extent[axis] = middles_[*most][axis] - middles_[*least][axis];
    }
    return static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  }

  /// The `count` lowest tets along the axis, and the others; each half ascending.
  std::pair<TetRun, TetRun> halves(const TetRun& tets, std::size_t axis, std::size_t count) const {
    TetRun order = tets;
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(order.begin(), middle, order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(middles_[a][axis], a) < std::pair(middles_[b][axis], b);
    });
    std::pair<TetRun, TetRun> parts{{order.begin(), middle}, {middle, order.end()}};
    std::sort(parts.first.begin(), parts.first.end());
    std::sort(parts.second.begin(), parts.second.end());
    return parts;
  }

  /// The tets of `high` with a vertex of `low`, taken from it.
  TetRun take_layer(const TetRun& low, TetRun& high) {
    const auto mark = [&](std::uint8_t value) {
      for (const std::uint32_t t : low)
        for (const std::uint32_t v : piece_.tets[t]) marked_[v] = value;
    };
    mark(1);
    const auto end = std::stable_partition(high.begin(), high.end(), [&](std::uint32_t t) {
      const Tet& tet = piece_.tets[t];
      return std::none_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return marked_[v] != 0; });
    });
    mark(0);
    TetRun layer(end, high.end());
    high.erase(end, high.end());
    return layer;
  }

  /// Adds rounds beside those from `first` on.
  static void join(std::vector<std::vector<TetRun>>& to, std::vector<std::vector<TetRun>> from, std::size_t first) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (first + i == to.size()) to.emplace_back();
      for (TetRun& run : from[i]) to[first + i].push_back(std::move(run));
    }
  }

  const Piece& piece_;
  std::vector<std::array<double, 3>> middles_;  ///< Of the tets, four times.
  std::vector<std::uint8_t> marked_;            ///< Vertices.
};

}  // namespace

std::vector<std::vector<TetRun>> split_rounds(const Piece& piece) {
  TetRun all(piece.tets.size());
  std::iota(all.begin(), all.end(), 0U);
  if (all.size() <= kSharedTets) return {{std::move(all)}};
  return Splitter(piece).rounds_of(std::move(all), kMostHalvings);
}

}  // namespace tetsoup::simulate
