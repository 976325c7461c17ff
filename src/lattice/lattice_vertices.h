// Marks and numbers for the points of a lattice, in lattice order: x fastest, then the points of a cell, then y, z.
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "base/bits.h"
#include "lattice/lattice_table.h"

namespace tetsoup {

/// One bit for every point of a box of cells; a point's number is the count of bits before it.
class LatticeVertices {
 public:
  /// For the corners of all tets of the cells [begin, end).
  LatticeVertices(const LatticeTable& table, const Cell& begin, const Cell& end)
      : points_(table.point_count), lo_(begin) {
    for (std::size_t i = 0; i < 3; ++i) size_[i] = static_cast<std::size_t>(end[i] - begin[i]) + 1;
    words_ = size_[0] / 64 + 1;
    marked_.resize(words_ * points_ * size_[1] * size_[2]);
  }

  void mark(const Cell& cell, const LatticeCorner& corner) {
    const auto [word, bit] = place(cell, corner);
    marked_[word] |= std::uint64_t{1} << bit;
  }
  bool is_marked(const Cell& cell, const LatticeCorner& corner) const {
    const auto [word, bit] = place(cell, corner);
    return (marked_[word] >> bit & 1U) != 0;
  }
  /// Once all are marked.
  void give_numbers() {
    before_.resize(marked_.size());
    for (std::size_t w = 0; w < marked_.size(); ++w) {
      before_[w] = count_;
      count_ += static_cast<std::uint32_t>(bit_count(marked_[w]));
    }
  }

  std::size_t count() const { return count_; }
  std::uint32_t number(const Cell& cell, const LatticeCorner& corner) const {
    const auto [word, bit] = place(cell, corner);
    const std::uint64_t below = marked_[word] & ((std::uint64_t{1} << bit) - 1);
    return before_[word] + static_cast<std::uint32_t>(bit_count(below));
  }
  /// visit(cell, point of the cell), in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t w = 0; w < marked_.size(); ++w) {
      for (std::uint64_t bits = marked_[w]; bits != 0; bits &= bits - 1) {
        const std::size_t x = 64 * (w % words_) + static_cast<std::size_t>(std::countr_zero(bits));
        const std::size_t row = w / words_ / points_;
        visit(Cell{lo_[0] + static_cast<int>(x), lo_[1] + static_cast<int>(row % size_[1]),
                   lo_[2] + static_cast<int>(row / size_[1])},
              w / words_ % points_);
      }
    }
  }
  /// visit(cell) for every cell of the box with a marked point among those that its tets may have as corners, in order.
  template <class Visit>
  void for_each_cell_beside(const Visit& visit) const {
    for (std::size_t z = 0; z + 1 < size_[2]; ++z)
      for (std::size_t y = 0; y + 1 < size_[1]; ++y)
        for (std::size_t w = 0; w < words_; ++w) {
          const std::uint64_t here = any_of_rows(y, z, w);
          for (std::uint64_t bits = here | here >> 1 | any_of_rows(y, z, w + 1) << 63; bits != 0; bits &= bits - 1) {
            const std::size_t x = 64 * w + static_cast<std::size_t>(std::countr_zero(bits));
            if (x + 1 < size_[0])
              visit(Cell{lo_[0] + static_cast<int>(x), lo_[1] + static_cast<int>(y), lo_[2] + static_cast<int>(z)});
          }
        }
  }

 private:
  struct Place {
    std::size_t word, bit;
  };
  Place place(const Cell& cell, const LatticeCorner& corner) const {
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(cell[i] - lo_[i]) + corner.cell[i]; };
    const std::size_t x = at(0);
    return {((at(1) + size_[1] * at(2)) * points_ + corner.point) * words_ + x / 64, x % 64};
  }
  /// Word w of all points in the rows y and y + 1 at z and z + 1; zero beyond their end.
  std::uint64_t any_of_rows(std::size_t y, std::size_t z, std::size_t w) const {
    if (w == words_) return 0;
    std::uint64_t any = 0;
    for (const std::size_t row : {y + size_[1] * z, y + 1 + size_[1] * z})
      for (const std::size_t above : {row, row + size_[1]})
        for (std::size_t p = 0; p < points_; ++p) any |= marked_[(above * points_ + p) * words_ + w];
    return any;
  }

  std::size_t points_;
  Cell lo_;
  std::array<std::size_t, 3> size_{};
  std::size_t words_ = 0;  ///< Of a row of points.
  std::vector<std::uint64_t> marked_;
  std::vector<std::uint32_t> before_;
  std::uint32_t count_ = 0;
};

}  // namespace tetsoup
