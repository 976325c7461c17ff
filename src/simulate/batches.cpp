#include "simulate/batches.h"

#include <algorithm>

#include "simulate/rounds.h"

namespace tetsoup::simulate {
namespace {

/// Puts each tet of a run into the first group that has none of its vertices and room for it.
class Grouping {
 public:
  explicit Grouping(const Piece& piece) : piece_(piece), groups_of_(piece.places.size()) {}

  std::vector<TetRun> groups(const TetRun& run) {
    std::vector<TetRun> groups;
    std::size_t first_open = 0;
    for (const std::uint32_t t : run) {
      const auto is_full = [&](std::size_t g) { return groups[g].size() >= kernel::kTetLanes; };
      while (first_open < groups.size() && is_full(first_open)) ++first_open;
      std::size_t g = first_open;
      while (g < groups.size() && (is_full(g) || is_taken(t, static_cast<std::uint32_t>(g)))) ++g;
      if (g == groups.size()) groups.emplace_back();
      groups[g].push_back(t);
      for (const std::uint32_t v : piece_.tets[t]) groups_of_[v].push_back(static_cast<std::uint32_t>(g));
    }
    for (const std::uint32_t t : run)
      for (const std::uint32_t v : piece_.tets[t]) groups_of_[v].clear();
    return groups;
  }

 private:
  bool is_taken(std::uint32_t t, std::uint32_t group) const {
    const Tet& tet = piece_.tets[t];
    return std::any_of(tet.begin(), tet.end(), [&](std::uint32_t v) {
      return std::find(groups_of_[v].rbegin(), groups_of_[v].rend(), group) != groups_of_[v].rend();
    });
  }

  const Piece& piece_;
  std::vector<std::vector<std::uint32_t>> groups_of_;  ///< Of the vertices; a few dozen each.
};

kernel::TetBatch empty_batch(std::uint32_t vertex_without_mass) {
  kernel::TetBatch batch{};
  for (auto& corner : batch.corners) std::fill(std::begin(corner), std::end(corner), vertex_without_mass);
  std::fill(std::begin(batch.volume_compliance), std::end(batch.volume_compliance), 1.0F);
  return batch;
}

void add_batch(Rest& rest, const TetRun& tets) {
  rest.batches.push_back(empty_batch(static_cast<std::uint32_t>(rest.padded_count - 1)));
  for (std::size_t lane = 0; lane < tets.size(); ++lane) {
    const Tet& tet = rest.piece.tets[tets[lane]];
    for (std::size_t c = 0; c < 4; ++c) rest.batches.back().corners[c][lane] = tet[c];
    rest.lanes[tets[lane]] = static_cast<std::uint32_t>((rest.batches.size() - 1) * kernel::kTetLanes + lane);
  }
}

}  // namespace

void fill_batches(Rest& rest) {
  rest.lanes.assign(rest.piece.tets.size(), 0);
  Grouping grouping(rest.piece);
  for (const std::vector<TetRun>& round : split_rounds(rest.piece)) {
    std::vector<std::size_t>& ends = rest.rounds.emplace_back();
    for (const TetRun& run : round) {
      for (const TetRun& group : grouping.groups(run)) add_batch(rest, group);
      ends.push_back(rest.batches.size());
    }
  }
}

}  // namespace tetsoup::simulate
