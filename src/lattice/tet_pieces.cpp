#include "lattice/tet_pieces.h"

#include <algorithm>
#include <tuple>

#include "base/bits.h"
#include "base/unions.h"
#include "base/whole.h"

namespace tetsoup {
namespace {

constexpr double kRounding = 1e-6;  ///< Voxels, of a plane.
constexpr double kParallel = 1e-9;  ///< A unit normal with a smaller x is parallel to the rows.

struct Range {
  int begin, end;
};

/// The voxels of a row that lie in a tet grown by some share of a voxel. What a plane leaves of a row begins or ends at
/// x = y * p.y + z * p.z + p.x.
class GrownTet {
 public:
  GrownTet(const TetCorners& p, double margin) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& face = kTetFaces[i];
      const Vec3d a = p[static_cast<std::size_t>(face[0])];
      Vec3d n = cross(p[static_cast<std::size_t>(face[2])] - a, p[static_cast<std::size_t>(face[1])] - a);
      n = n * (1 / length(n));
      // Inside is where dot(n, p) + offset >= 0. Half a voxel across the plane is what its cube reaches.
      const double reach = 0.5 * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
      const double offset = -dot(n, a) + margin * reach + kRounding;
      if (std::abs(n.x) < kParallel) {
        parallel_[parallels_++] = {offset, n.y, n.z};
      } else if (n.x > 0) {
        low_[lows_++] = {-offset / n.x, -n.y / n.x, -n.z / n.x};
      } else {
        high_[highs_++] = {-offset / n.x, -n.y / n.x, -n.z / n.x};
      }
    }
  }

  Range narrowed(Range range, int y, int z) const {
    double low = range.begin, high = range.end - 1;
    for (std::size_t i = 0; i < lows_; ++i) low = std::max(low, at(low_[i], y, z));
    for (std::size_t i = 0; i < highs_; ++i) high = std::min(high, at(high_[i], y, z));
    for (std::size_t i = 0; i < parallels_; ++i)
      if (at(parallel_[i], y, z) < 0) return {range.begin, range.begin};
    if (low > high) return {range.begin, range.begin};
    return {ceil_to_int(low), floor_to_int(high) + 1};
  }

 private:
  static double at(const Vec3d& p, int y, int z) { return p.x + p.y * y + p.z * z; }

  std::array<Vec3d, 4> low_, high_, parallel_;
  std::size_t lows_ = 0, highs_ = 0, parallels_ = 0;
};

}  // namespace

/// Finds the pieces of one tet after the other: runs of voxels along x, joined from row to row.
class TetPieces::Finder {
 public:
  Finder(const BitGrid& inside, const VoxelParts& parts) : inside_(inside), parts_(parts) {}

  /// `voxels`: those that the tet holds.
  Found find(const TetCorners& corners, double voxels) {
    box_of(corners);
    collect(GrownTet(corners, 1));
    Found found;
    if (runs_.empty()) return found;
    name_runs(found);
    if (found.voxels.size() == 1) {
      found.voxels[0] = static_cast<std::uint32_t>(voxels);
      return found;
    }
    const GrownTet own(corners, 0);
    for (const Run& run : runs_) {
      const Range range = own.narrowed({run.begin, run.end}, run.y, run.z);
      found.voxels[run.piece] += static_cast<std::uint32_t>(std::max(0, range.end - range.begin));
    }
    found.runs = runs_;
    return found;
  }

 private:
  void box_of(const TetCorners& corners) {
    const Vec3d lo = min(min(corners[0], corners[1]), min(corners[2], corners[3]));
    const Vec3d hi = max(max(corners[0], corners[1]), max(corners[2], corners[3]));
    const auto range = [&](double low, double high, std::size_t axis) {
      const int begin = std::max(0, ceil_to_int(low - 0.5 - kRounding));
      return Range{begin,
                   std::max(begin, std::min(inside_.frame.size[axis], floor_to_int(high + 0.5 + kRounding) + 1))};
    };
    x_ = range(lo.x, hi.x, 0);
    y_ = range(lo.y, hi.y, 1);
    z_ = range(lo.z, hi.z, 2);
  }

  std::size_t row(int y, int z) const {
    return static_cast<std::size_t>(z - z_.begin) * static_cast<std::size_t>(y_.end - y_.begin) +
           static_cast<std::size_t>(y - y_.begin);
  }

  void collect(const GrownTet& rows) {
    runs_.clear();
    row_begin_.assign(1, 0);
    for (int z = z_.begin; z < z_.end; ++z) {
      for (int y = y_.begin; y < y_.end; ++y) {
        const std::uint64_t* bits = inside_.words.data() + inside_.row(y, z);
        const Range range = rows.narrowed(x_, y, z);
        for (int x = range.begin; x < range.end;) {
          const int begin = find_bit(bits, x, range.end, true);
          x = find_bit(bits, begin, range.end, false);
          if (begin < x) runs_.push_back({z, y, begin, x, 0});
        }
        row_begin_.push_back(runs_.size());
      }
    }
  }

  /// Each row with the four neighbours that came before it.
  void name_runs(Found& found) {
    Unions unions(runs_.size());
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const Run& run = runs_[r];
      if (run.y > y_.begin) join_with(r, run.y - 1, run.z, unions);
      if (run.z == z_.begin) continue;
      for (int y = std::max(y_.begin, run.y - 1); y <= std::min(y_.end - 1, run.y + 1); ++y)
        join_with(r, y, run.z - 1, unions);
    }
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      // The first of a set stands for it, so it has its name by now.
      const std::size_t root = unions.find(r);
      runs_[r].piece = root == r ? static_cast<std::uint32_t>(found.voxels.size()) : runs_[root].piece;
      if (root != r) continue;
      found.voxels.push_back(0);
      found.parts.push_back(parts_.at(runs_[r].begin, runs_[r].y, runs_[r].z));
    }
  }
  void join_with(std::size_t r, int y, int z, Unions& unions) const {
    for (std::size_t i = row_begin_[row(y, z)]; i < row_begin_[row(y, z) + 1]; ++i)
      if (runs_[i].begin <= runs_[r].end && runs_[r].begin <= runs_[i].end) unions.join(i, r);
  }

  const BitGrid& inside_;
  const VoxelParts& parts_;
  Range x_{}, y_{}, z_{};
  std::vector<Run> runs_;
  std::vector<std::size_t> row_begin_;
};

TetPieces::TetPieces(const Candidates& candidates, const BitGrid& inside, const VoxelParts& parts, StageWatch& watch) {
  constexpr std::int64_t kGrain = 64;  // tets
  const TetMesh& mesh = candidates.mesh;
  const std::vector<float>& density = candidates.density;
  std::vector<Found> found(mesh.tets.size());
  parallel_for(static_cast<std::int64_t>(mesh.tets.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    Finder finder(inside, parts);
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      const TetCorners corners = corners_in_voxels(mesh, mesh.tets[t], inside.frame);
      if (density[t] > 0 && density[t] < 1)
        found[t] = finder.find(corners, static_cast<double>(density[t]) * signed_volume(corners));
      if (!found[t].voxels.empty() || (density[t] <= 0 && !candidates.kept[t])) continue;
      const Vec3d middle = (corners[0] + corners[1] + corners[2] + corners[3]) * 0.25 + Vec3d{0.5, 0.5, 0.5};
      found[t].voxels.push_back(0);
      found[t].parts.push_back(parts.at(floor_to_int(middle.x), floor_to_int(middle.y), floor_to_int(middle.z)));
    }
  });
  first_.assign(1, 0);
  runs_begin_.assign(1, 0);
  for (const Found& f : found) {
    tet_of_.insert(tet_of_.end(), f.voxels.size(), static_cast<std::uint32_t>(first_.size() - 1));
    voxels_.insert(voxels_.end(), f.voxels.begin(), f.voxels.end());
    parts_.insert(parts_.end(), f.parts.begin(), f.parts.end());
    runs_.insert(runs_.end(), f.runs.begin(), f.runs.end());
    first_.push_back(static_cast<std::uint32_t>(voxels_.size()));
    runs_begin_.push_back(runs_.size());
  }
}

std::uint32_t TetPieces::piece_at(std::size_t tet, int x, int y, int z) const {
  if (count(tet) < 2) return count(tet) == 0 ? kNone : first(tet);
  const auto begin = runs_.begin() + static_cast<std::ptrdiff_t>(runs_begin_[tet]);
  const auto end = runs_.begin() + static_cast<std::ptrdiff_t>(runs_begin_[tet + 1]);
  const auto after = std::upper_bound(begin, end, std::tuple(z, y, x), [](const auto& at, const Run& run) {
    return at < std::tuple(run.z, run.y, run.begin);
  });
  if (after == begin) return kNone;
  const Run& run = *(after - 1);
  return run.z == z && run.y == y && x < run.end ? first(tet) + run.piece : kNone;
}

}  // namespace tetsoup
