#include "lattice/budget.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/elementary.h"
#include "lattice/fit_points.h"

namespace tetsoup {
namespace {

constexpr double kTolerance = 0.05, kToleranceOfFew = 0.10;
constexpr std::size_t kFew = 200;
constexpr double kGoodEnough = 0.8;  ///< Of the tolerance: a search ends here.
constexpr int kTriesAsGiven = 2;     ///< Fills before the frame is shifted,
constexpr int kTriesUpright = 5;     ///< and before it is turned.
constexpr int kTriesTurned = 4;      ///< Thereafter between shifts: where the count jumps over what is wanted.
/// Cells. With no symmetry: shapes with some then lose or gain their tets one by one as the edge changes, not eight at
/// once.
constexpr Vec3d kShift{0.31, 0.17, 0.43};
/// Radians. A flat side along the lattice loses or gains a whole layer at once, wherever the lattice lies.
constexpr Vec3d kTurn{0.21, 0.13, 0.17};
constexpr double kSharedVertices = 1.6;  ///< Vertices of a coarse mesh over those of as much endless lattice.

struct Try {
  double log_edge = 0;
  double miss = 0;  ///< Logarithm of count / wanted.
};

/// Where the count would be met by what is known: between two tries that miss it to either side, else along a power of
/// the edge from the nearest.
double next_log_edge(std::vector<Try> tries, double power) {
  const bool same_side = tries.size() > 1 && (tries.back().miss > 0) == (tries[tries.size() - 2].miss > 0);
  std::sort(tries.begin(), tries.end(), [](const Try& a, const Try& b) { return a.log_edge < b.log_edge; });
  const Try* below = nullptr;
  double nearest = 1e300;
  for (std::size_t i = 0; i + 1 < tries.size(); ++i) {
    const double misses = std::abs(tries[i].miss) + std::abs(tries[i + 1].miss);
    if ((tries[i].miss > 0) != (tries[i + 1].miss > 0) && misses < nearest) {
      below = &tries[i];
      nearest = misses;
    }
  }
  if (below != nullptr) {
    const Try& above = *(below + 1);
    // Where the count jumps, the line through both ends comes down on the same side again and again: then halve.
    const double part = same_side ? 0.5 : below->miss / (below->miss - above.miss);
    return below->log_edge + part * (above.log_edge - below->log_edge);
  }
  const auto closer = [](const Try& a, const Try& b) { return std::abs(a.miss) < std::abs(b.miss); };
  const Try& best = *std::min_element(tries.begin(), tries.end(), closer);
  constexpr double kMostChange = 0.7, kLeastChange = 0.03;  // a factor of two; beyond what was tried already
  const double next = best.log_edge + std::clamp(best.miss / power, -kMostChange, kMostChange);
  if (tries.size() == 1) return next;
  return best.miss > 0 ? std::max(next, tries.back().log_edge + kLeastChange)
                       : std::min(next, tries.front().log_edge - kLeastChange);
}

/// The power of the edge that the count falls with, from two tries that are far enough apart to tell.
double fitted_power(const std::vector<Try>& tries, double power) {
  if (tries.size() < 2) return power;
  const Try &a = tries[tries.size() - 2], &b = tries.back();
  constexpr double kApart = 0.05;
  if (std::abs(a.log_edge - b.log_edge) < kApart) return power;
  return std::clamp((a.miss - b.miss) / (b.log_edge - a.log_edge), 1.0, 4.0);
}

class Search {
 public:
  Search(Filler& filler, const Budget& budget, const LatticePose& start, FineTuning tuning)
      : filler_(filler), budget_(budget), pose_(start), tuning_(tuning), place_(place_of(start, filler.grid())) {}

  Fill run(int most_fills) {
    // Smaller cells would put more tets than are wanted into a single voxel, and fill the memory where nothing helps.
    const double in_voxel = filler_.grid().voxel_size / elementary::cbrt(static_cast<double>(budget_.wanted));
    const double largest = 4 * filler_.longest_edge(), smallest = std::max(filler_.smallest_cell(), in_voxel);
    const double stop = kGoodEnough * budget_.tolerance();
    double cell_size = pose_.cell_size;
    for (int i = 0; i < most_fills; ++i) {
      cell_size = std::clamp(cell_size, smallest, std::max(smallest, largest));
      if (!tries_.empty() && cell_size == pose_.cell_size) break;
      set_pose(cell_size);
      try_pose();
      if (std::abs(elementary::exp(tries_.back().miss) - 1) <= stop) break;
      cell_size = elementary::exp(next_log_edge(tries_, fitted_power(tries_, filler_.has_volume() ? 3 : 2)));
      if (tuning_ == FineTuning::Frame) tune_after(i + 1);
    }
    return std::move(best_);
  }

 private:
  void set_pose(double cell_size) {
    pose_.cell_size = place_.cell_size = cell_size;
    if (tuning_ == FineTuning::None) pose_ = pose_of(place_, filler_.grid());
  }

  /// What the soup passes through is no better aligned than turned.
  void tune_after(int tries) {
    const int upright = filler_.has_volume() ? kTriesUpright : kTriesAsGiven;
    const bool turns = !turned_ && tries >= upright;
    const bool shifts = tries == kTriesAsGiven || (turned_ && (tries - upright) % kTriesTurned == 0);
    if (shifts) pose_.translate_cells += kShift;
    if (turns) pose_.rotate += kTurn;
    if (turns || shifts) tries_.clear();
    turned_ = turned_ || turns;
  }

  void try_pose() {
    Fill fill = filler_.fill(pose_);
    const double count = std::max(0.5, static_cast<double>(budget_.count(fill)));
    tries_.push_back({elementary::log(pose_.cell_size), elementary::log(count / static_cast<double>(budget_.wanted))});
    const double miss = std::abs(tries_.back().miss);
    if (miss >= best_miss_) return;
    best_miss_ = miss;
    best_ = std::move(fill);
  }

  Filler& filler_;
  const Budget& budget_;
  LatticePose pose_;
  FineTuning tuning_;
  Place place_;
  std::vector<Try> tries_;
  bool turned_ = false;
  Fill best_;
  double best_miss_ = 1e300;
};

}  // namespace

double Budget::tolerance() const {
  return wanted >= kFew ? kTolerance : kToleranceOfFew;
}

Fill search_budget(Filler& filler, const Budget& budget, const LatticePose& start, FineTuning tuning, int most_fills) {
  return Search(filler, budget, start, tuning).run(most_fills);
}

double expected_cell(const LatticeTable& table, const Budget& budget, double volume) {
  const double per_cell = budget.counts == Budget::Counts::Tets
                              ? static_cast<double>(table.tet_count)
                              : kSharedVertices * static_cast<double>(table.point_count);
  return elementary::cbrt(volume * per_cell / static_cast<double>(budget.wanted));
}

}  // namespace tetsoup
