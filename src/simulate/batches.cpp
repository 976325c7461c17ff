#include "simulate/batches.h"

#include <algorithm>
#include <limits>

namespace tetsoup::simulate {
namespace {

/// Puts each tet into the first group that has none of its vertices and fewer than `capacity` tets.
std::vector<std::vector<std::uint32_t>> group_tets(const Piece& piece, std::size_t capacity) {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::vector<std::uint32_t>> groups_of(piece.places.size());  // ascending enough: a few dozen a vertex
  std::size_t first_open = 0;
  for (std::uint32_t t = 0; t < piece.tets.size(); ++t) {
    const Tet& tet = piece.tets[t];
    const auto is_taken = [&](std::uint32_t group) {
      return std::any_of(tet.begin(), tet.end(), [&](std::uint32_t v) {
        return std::find(groups_of[v].rbegin(), groups_of[v].rend(), group) != groups_of[v].rend();
      });
    };
    while (first_open < groups.size() && groups[first_open].size() >= capacity) ++first_open;
    std::size_t g = first_open;
    while (g < groups.size() && (groups[g].size() >= capacity || is_taken(static_cast<std::uint32_t>(g)))) ++g;
    if (g == groups.size()) groups.emplace_back();
    groups[g].push_back(t);
    for (const std::uint32_t v : tet) groups_of[v].push_back(static_cast<std::uint32_t>(g));
  }
  return groups;
}

kernel::TetBatch empty_batch(std::uint32_t vertex_without_mass) {
  kernel::TetBatch batch{};
  for (auto& corner : batch.corners) std::fill(std::begin(corner), std::end(corner), vertex_without_mass);
  std::fill(std::begin(batch.volume_compliance), std::end(batch.volume_compliance), 1.0F);
  return batch;
}

}  // namespace

void fill_batches(Rest& rest) {
  const std::size_t tet_count = rest.piece.tets.size();
  const bool shared = tet_count > kSharedTets;
  const auto groups =
      group_tets(rest.piece, shared ? std::numeric_limits<std::size_t>::max() : std::size_t{kernel::kTetLanes});
  rest.lanes.assign(tet_count, 0);
  for (const std::vector<std::uint32_t>& group : groups) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::size_t lane = i % kernel::kTetLanes;
      if (lane == 0) rest.batches.push_back(empty_batch(static_cast<std::uint32_t>(rest.padded_count - 1)));
      const Tet& tet = rest.piece.tets[group[i]];
      for (std::size_t c = 0; c < 4; ++c) rest.batches.back().corners[c][lane] = tet[c];
      rest.lanes[group[i]] = static_cast<std::uint32_t>((rest.batches.size() - 1) * kernel::kTetLanes + lane);
    }
    rest.colours.push_back(rest.batches.size());
  }
}

}  // namespace tetsoup::simulate
