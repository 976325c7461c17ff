#include "lattice/fit_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/elementary.h"
#include "base/bits.h"
#include "base/whole.h"
#include "lattice/five_tets.h"

namespace tetsoup {
namespace {

Vec3d centre_of(const GridFrame& grid) {
  const Box3 box = grid_box(grid);
  return (box.lo + box.hi) * 0.5;
}

/// Of a cell's box of counts: where the count of a point's tet lies from that of tet 0 of the point's cube. Which tet
/// it is depends on a few comparisons; they are made without a branch, and `code` holds their answers.
struct Codes {
  std::array<std::ptrdiff_t, 64> offset{};
};

/// The corners of the cube that owner_tet() asks for, one bit each.
Codes five_codes() {
  Codes codes;
  for (std::size_t tet = 1; tet < kTetsPerCell; ++tet)
    codes.offset[std::size_t{1} << (tet - 1)] = static_cast<int>(tet);
  return codes;
}
inline unsigned five_code(float x, float y, float z, bool odd) {
  x = odd ? 1 - x : x;
  return static_cast<unsigned>(x > y + z) | static_cast<unsigned>(y > x + z) << 1 |
         static_cast<unsigned>(z > x + y) << 2 | static_cast<unsigned>(x + y + z > 2) << 3;
}

/// The cube's six faces are the bases of pyramids with their tips at its centre; each pyramid is halves of four tets,
/// and those about a lower face belong to the cell below.
Codes bcc_codes(const std::array<std::ptrdiff_t, 3>& strides) {
  Codes codes;
  for (std::size_t code = 0; code < codes.offset.size(); ++code) {
    const auto bit = [&](std::size_t i) { return (code >> i & 1U) != 0; };
    const std::array<bool, 3> below{bit(3), bit(4), bit(5)};
    const auto larger = [&](std::size_t a, std::size_t b) {  // of two coordinates about the centre
      return a < b ? bit(a + b - 1) : !bit(a + b - 1);
    };
    const std::size_t axis = larger(0, 1) ? (larger(0, 2) ? 0 : 2) : (larger(1, 2) ? 1 : 2);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::size_t side = larger(v, u) ? (below[v] ? 0 : 2) : (below[u] ? 3 : 1);  // as the table has them
    codes.offset[code] = static_cast<std::ptrdiff_t>(4 * axis + side) - (below[axis] ? strides[axis] : 0);
  }
  return codes;
}
inline unsigned bcc_code(float x, float y, float z) {
  x -= 0.5F, y -= 0.5F, z -= 0.5F;
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  return static_cast<unsigned>(ax >= ay) | static_cast<unsigned>(ax >= az) << 1 | static_cast<unsigned>(ay >= az) << 2 |
         static_cast<unsigned>(x < 0) << 3 | static_cast<unsigned>(y < 0) << 4 | static_cast<unsigned>(z < 0) << 5;
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// Eigenvectors of a symmetric matrix, as columns, by Jacobi's rotations.
Matrix eigenvectors(Matrix a) {
  Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 12;  // the error is squared by each
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : {std::array<std::size_t, 2>{0, 1}, {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      const auto turn = [&](double& x, double& y) {
        const double x0 = x;
        x = c * x0 - s * y;
        y = s * x0 + c * y;
      };
      for (std::size_t k = 0; k < 3; ++k) turn(a[k][p], a[k][q]);
      for (std::size_t k = 0; k < 3; ++k) turn(a[p][k], a[q][k]);
      for (std::size_t k = 0; k < 3; ++k) turn(v[k][p], v[k][q]);
    }
  }
  return v;
}

}  // namespace

LatticePose pose_of(const Place& place, const GridFrame& grid) {
  LatticePose pose{place.cell_size, {}, place.rotate, place.stretch};
  const Vec3d shift = make_lattice_frame(grid, pose).centre_cell - place.centre_cell;
  // Lattices repeat after two cells.
  const auto least = [](double s) { return s - 2 * std::round(s / 2); };
  pose.translate_cells = {least(shift.x), least(shift.y), least(shift.z)};
  return pose;
}

Place place_of(const LatticePose& pose, const GridFrame& grid) {
  return {pose.cell_size, pose.rotate, make_lattice_frame(grid, pose).centre_cell, pose.stretch};
}

FitPoints::FitPoints(const BitGrid& inside, std::size_t wanted, const LatticeTable& table, double rho_min)
    : grid_(inside.frame), table_(table), rho_min_(rho_min) {
  std::size_t all = 0;
  for (const std::uint64_t word : inside.words) all += bit_count(word);
  // Every so many voxels along a line that winds through the grid evenly: x + a y + b z is a multiple of `every`.
  const int every = std::max(1, static_cast<int>(std::lround(static_cast<double>(all) / static_cast<double>(wanted))));
  const int a = static_cast<int>(std::lround(elementary::cbrt(every))), b = std::max(1, a * a - 1);
  const Vec3d centre = centre_of(grid_);
  const auto [nx, ny, nz] = grid_.size;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = (every - (a * y + b * z) % every) % every; x < nx; x += every) {
        if (!inside.test(x, y, z)) continue;
        const Vec3d at{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        points_.push_back(to_float(grid_.origin + at * grid_.voxel_size - centre));
      }
    }
  }
  if (!points_.empty())
    volume_ = elementary::cube(grid_.voxel_size) * static_cast<double>(all) / static_cast<double>(points_.size());
}

Vec3d FitPoints::principal_rotation() const {
  Vec3d mean;
  for (const Vec3& p : points_) mean += to_double(p) * (1 / static_cast<double>(points_.size()));
  Matrix spread{};
  for (const Vec3& point : points_) {
    const Vec3d d = to_double(point) - mean;
    const std::array<double, 3> p{d.x, d.y, d.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) spread[i][j] += p[i] * p[j];
  }
  Matrix r = eigenvectors(spread);
  const double turn = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                      r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                      r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
  if (turn < 0)
    for (std::size_t i = 0; i < 3; ++i) r[i][2] = -r[i][2];
  return {elementary::atan2(r[2][1], r[2][2]), elementary::asin(std::clamp(-r[2][0], -1.0, 1.0)),
          elementary::atan2(r[1][0], r[0][0])};
}

Guess FitPoints::guess(const Place& place) const {
  LatticePose pose{place.cell_size, {}, place.rotate, place.stretch};
  LatticeFrame frame = make_lattice_frame(grid_, pose, 1);
  const Vec3d shift = place.centre_cell - frame.centre_cell;
  const std::array<int, 3> whole{floor_to_int(shift.x), floor_to_int(shift.y), floor_to_int(shift.z)};
  for (std::size_t i = 0; i < 3; ++i) {
    frame.begin[i] += whole[i];
    frame.end[i] += whole[i] + 1;
  }
  frame.centre_cell = place.centre_cell;
  return judge(frame, count_points(frame));
}

std::vector<std::uint16_t> FitPoints::count_points(const LatticeFrame& frame) const {
  const auto cells = [&](std::size_t i) { return static_cast<std::ptrdiff_t>(frame.end[i] - frame.begin[i]); };
  const auto tets = static_cast<std::ptrdiff_t>(table_.tet_count);
  const std::array<std::ptrdiff_t, 3> strides{tets, tets * cells(0), tets * cells(0) * cells(1)};
  const bool is_five = table_.point_count == 1;
  const Codes codes = is_five ? five_codes() : bcc_codes(strides);
  const auto row = [&](std::size_t axis, double stretch) {
    return to_float(frame.axes[axis] * (1 / (frame.cell_size * stretch)));
  };
  const Vec3 ax = row(0, frame.stretch.x), ay = row(1, frame.stretch.y), az = row(2, frame.stretch.z);
  // From the first cell on coordinates are positive, and their whole parts what the conversion cuts them to.
  const Vec3 c = to_float(frame.centre_cell - Vec3d{1.0 * frame.begin[0], 1.0 * frame.begin[1], 1.0 * frame.begin[2]});
  const int first_odd = is_odd(frame.begin);
  std::vector<std::uint16_t> counts(static_cast<std::size_t>(strides[2] * cells(2)));
  for (const Vec3& p : points_) {
    const float x = p.x * ax.x + p.y * ax.y + p.z * ax.z + c.x;
    const float y = p.x * ay.x + p.y * ay.y + p.z * ay.z + c.y;
    const float z = p.x * az.x + p.y * az.y + p.z * az.z + c.z;
    const int ix = static_cast<int>(x), iy = static_cast<int>(y), iz = static_cast<int>(z);
    const float lx = x - static_cast<float>(ix), ly = y - static_cast<float>(iy), lz = z - static_cast<float>(iz);
    const bool odd = ((ix + iy + iz + first_odd) & 1) != 0;
    const unsigned code = is_five ? five_code(lx, ly, lz, odd) : bcc_code(lx, ly, lz);
    ++counts[static_cast<std::size_t>(ix * strides[0] + iy * strides[1] + iz * strides[2] + codes.offset[code])];
  }
  return counts;
}

Guess FitPoints::judge(const LatticeFrame& frame, const std::vector<std::uint16_t>& counts) const {
  const std::size_t tets = table_.tet_count;
  std::array<double, kMostTetsPerCell> full{};  // points in a tet that is inside
  std::array<int, kMostTetsPerCell> least{};    // and in one that is kept
  for (std::size_t t = 0; t < tets; ++t) {
    full[t] = table_.volume[t] * elementary::cube(frame.cell_size) * frame.stretch.x * frame.stretch.y *
              frame.stretch.z / volume_;
    least[t] = std::max(1, ceil_to_int(std::min(rho_min_ * full[t], 1e6)));
  }
  Guess guess;
  double both = 0, mesh = 0;
  for (std::size_t i = 0; i < counts.size(); i += tets) {
    for (std::size_t t = 0; t < tets; ++t) {
      if (counts[i + t] < least[t]) continue;
      guess.tets += 1;
      both += counts[i + t];
      mesh += full[t];
    }
  }
  guess.overlap = both / (mesh + static_cast<double>(points_.size()) - both);
  return guess;
}

}  // namespace tetsoup
