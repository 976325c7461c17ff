// A cheap guess of how well a lattice in a given place meets the volume: some of the inside voxels stand for all.
#pragma once

#include <cstdint>
#include <vector>

#include "lattice/lattice_frame.h"
#include "lattice/lattice_table.h"

namespace tetsoup {

/// Where a lattice lies, by continuous numbers: a pose counts from the corner of a whole number of cells, and jumps.
struct Place {
  double cell_size = 1;
  Vec3d rotate;
  Vec3d centre_cell;  ///< Cell coordinates of the centre of the soup's box.
  Vec3d stretch{1, 1, 1};
};

/// The pose of that place.
LatticePose pose_of(const Place& place, const GridFrame& grid);
Place place_of(const LatticePose& pose, const GridFrame& grid);

struct Guess {
  double tets = 0;     ///< That density would keep.
  double overlap = 0;  ///< IoU of those with the volume.
};

class FitPoints {
 public:
  /// About `wanted` of the inside voxels, evenly spread.
  FitPoints(const BitGrid& inside, std::size_t wanted, const LatticeTable& table, double rho_min);

  std::size_t count() const { return points_.size(); }
  /// Principal axes of the volume, as angles.
  Vec3d principal_rotation() const;
  Guess guess(const Place& place) const;

 private:
  /// Points in every tet of every cell of the frame.
  std::vector<std::uint16_t> count_points(const LatticeFrame& frame) const;
  Guess judge(const LatticeFrame& frame, const std::vector<std::uint16_t>& counts) const;

  GridFrame grid_;
  const LatticeTable& table_;
  double rho_min_;
  std::vector<Vec3> points_;  ///< Relative to the centre of the box,
  double volume_ = 0;         ///< and what each of them stands for.
};

}  // namespace tetsoup
