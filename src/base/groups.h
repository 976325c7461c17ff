// Things sorted into groups by a small whole number: counted, then placed; nothing is compared.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tetsoup {

template <class Item>
class Groups {
 public:
  Groups() = default;
  /// Calls visit(put) twice, and visit each time put(group, item) for all items in the same order, which the groups
  /// keep. O(groups + items).
  template <class Visit>
  Groups(std::size_t group_count, const Visit& visit) : begin_(group_count + 2, 0) {
    visit([&](std::size_t group, const Item&) { ++begin_[group + 2]; });
    for (std::size_t g = 2; g < begin_.size(); ++g) begin_[g] += begin_[g - 1];
    items_.resize(begin_.back());
    // begin_[group + 1] runs over the group's places, and ends where the next group begins.
    visit([&](std::size_t group, const Item& item) { items_[begin_[group + 1]++] = item; });
    begin_.pop_back();
  }

  std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::span<Item> operator[](std::size_t group) {
    return std::span(items_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }
  std::span<const Item> operator[](std::size_t group) const {
    return std::span(items_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }
  const std::vector<Item>& items() const& { return items_; }
  std::vector<Item> items() && { return std::move(items_); }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Item> items_;
};

}  // namespace tetsoup
