// Numbers for the corners of the kept tets, in lattice order: x fastest, then y, then z.
#pragma once

#include <bit>
#include <vector>

#include "base/bits.h"
#include "lattice/kept_cells.h"

namespace tetsoup {

/// One bit for every corner of the cells' box; a corner's number is the count of bits before it.
class LatticeVertices {
 public:
  explicit LatticeVertices(const std::vector<KeptCell>& cells) : lo_(cells.front().cell) {
    Cell hi = lo_;
    for (const KeptCell& k : cells) {
      for (std::size_t i = 0; i < 3; ++i) {
        lo_[i] = std::min(lo_[i], k.cell[i]);
        hi[i] = std::max(hi[i], k.cell[i]);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) size_[i] = static_cast<std::size_t>(hi[i] - lo_[i]) + 2;
    used_.resize(size_[0] * size_[1] * size_[2] / 64 + 1);
  }

  void add(const Cell& cell, unsigned corner) {
    const std::size_t i = place(cell, corner);
    used_[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  /// Once all are added.
  void give_numbers() {
    before_.resize(used_.size());
    for (std::size_t w = 0; w < used_.size(); ++w) {
      before_[w] = count_;
      count_ += static_cast<std::uint32_t>(bit_count(used_[w]));
    }
  }

  std::size_t count() const { return count_; }
  std::uint32_t number(const Cell& cell, unsigned corner) const {
    const std::size_t i = place(cell, corner);
    const std::uint64_t below = used_[i / 64] & ((std::uint64_t{1} << (i % 64)) - 1);
    return before_[i / 64] + static_cast<std::uint32_t>(bit_count(below));
  }
  /// visit(cell coordinates of the corner), in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t w = 0; w < used_.size(); ++w) {
      for (std::uint64_t bits = used_[w]; bits != 0; bits &= bits - 1) {
        const std::size_t i = 64 * w + static_cast<std::size_t>(std::countr_zero(bits));
        visit(Cell{lo_[0] + static_cast<int>(i % size_[0]), lo_[1] + static_cast<int>(i / size_[0] % size_[1]),
                   lo_[2] + static_cast<int>(i / size_[0] / size_[1])});
      }
    }
  }

 private:
  std::size_t place(const Cell& cell, unsigned corner) const {
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(cell[i] - lo_[i]) + (corner >> i & 1U); };
    return at(0) + size_[0] * (at(1) + size_[1] * at(2));
  }

  Cell lo_;
  std::array<std::size_t, 3> size_{};
  std::vector<std::uint64_t> used_;
  std::vector<std::uint32_t> before_;
  std::uint32_t count_ = 0;
};

}  // namespace tetsoup
