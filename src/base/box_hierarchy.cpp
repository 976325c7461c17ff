#include "base/box_hierarchy.h"

namespace tetsoup {
namespace {

using Node = BoxHierarchy::Node;

constexpr std::uint32_t kPiece = 1U << 15;  ///< Things of a part of the tree that one thread builds.

class Builder {
 public:
  Builder(std::span<const MortonEntry> sorted, std::uint32_t leaf_size,
          const std::function<BoxHierarchy::Box(std::size_t)>& box)
      : sorted_(sorted), leaf_size_(leaf_size), box_(box) {}

  std::vector<Node> run(StageWatch& watch) {
    const auto count = static_cast<std::uint32_t>(sorted_.size());
    cut(0, count);
    parallel_for(static_cast<std::int64_t>(pieces_.size()), 1, watch, [&](std::int64_t i, std::int64_t) {
      Piece& piece = pieces_[static_cast<std::size_t>(i)];
      piece.nodes.reserve((piece.end - piece.begin) * 3 / leaf_size_);
      build(piece.begin, piece.end, piece.nodes);
    });
    std::size_t total = pieces_.size();  // less one node above them
    for (const Piece& piece : pieces_) total += piece.nodes.size();
    nodes_.reserve(total);
    join(0, count);
    return std::move(nodes_);
  }

 private:
  struct Piece {
    std::uint32_t begin, end;
    std::vector<Node> nodes;
  };

  void cut(std::uint32_t begin, std::uint32_t end) {
    if (end - begin <= kPiece) return pieces_.push_back({begin, end, {}});
    const std::uint32_t middle = morton_split(sorted_, begin, end);
    cut(begin, middle);
    cut(middle, end);
  }

  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::vector<Node>& nodes) const {
    const auto self = static_cast<std::uint32_t>(nodes.size());
    if (end - begin <= leaf_size_) {
      auto [lo, hi] = box(begin);
      for (std::uint32_t i = begin + 1; i < end; ++i) {
        const BoxHierarchy::Box next = box(i);
        lo = min(lo, next.lo), hi = max(hi, next.hi);
      }
      nodes.push_back({lo, hi, begin, end - begin});
      return self;
    }
    nodes.emplace_back();
    const std::uint32_t middle = morton_split(sorted_, begin, end);
    const std::uint32_t first = build(begin, middle, nodes), second = build(middle, end, nodes);
    nodes[self] = around(nodes[first], nodes[second], second);
    return self;
  }

  /// Puts the pieces one after the other below the nodes that they were cut from.
  std::uint32_t join(std::uint32_t begin, std::uint32_t end) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    if (end - begin <= kPiece) {
      std::vector<Node> piece = std::move(pieces_[joined_++].nodes);
      for (Node& node : piece) node.next += node.count == 0 ? self : 0;
      nodes_.insert(nodes_.end(), piece.begin(), piece.end());
      return self;
    }
    nodes_.emplace_back();
    const std::uint32_t middle = morton_split(sorted_, begin, end);
    const std::uint32_t first = join(begin, middle), second = join(middle, end);
    nodes_[self] = around(nodes_[first], nodes_[second], second);
    return self;
  }

  BoxHierarchy::Box box(std::uint32_t i) const { return box_(sorted_[i].index); }
  static Node around(const Node& first, const Node& second, std::uint32_t place) {
    return {min(first.lo, second.lo), max(first.hi, second.hi), place, 0};
  }

  std::span<const MortonEntry> sorted_;
  std::uint32_t leaf_size_;
  const std::function<BoxHierarchy::Box(std::size_t)>& box_;
  std::vector<Piece> pieces_;
  std::size_t joined_ = 0;
  std::vector<Node> nodes_;
};

/// The digits of a pass, 10 bits: how often each occurs in every chunk, then where the chunk's first goes.
constexpr std::size_t kDigits = 1024;
constexpr std::int64_t kChunk = 1 << 18;

void sort_by_digit(std::span<const MortonEntry> from, std::span<MortonEntry> to, int shift, StageWatch& watch) {
  const auto digit = [&](const MortonEntry& e) { return e.code >> shift & (kDigits - 1); };
  const auto count = static_cast<std::int64_t>(from.size());
  std::vector<std::vector<std::uint32_t>> places(static_cast<std::size_t>(chunk_count(count, kChunk)));
  parallel_for(count, kChunk, watch, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint32_t>& own = places[static_cast<std::size_t>(begin / kChunk)];
    own.assign(kDigits, 0);
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) ++own[digit(from[i])];
  });
  std::uint32_t sum = 0;
  for (std::size_t d = 0; d < kDigits; ++d) {
    for (std::vector<std::uint32_t>& own : places) {
      const std::uint32_t n = own[d];
      own[d] = sum;
      sum += n;
    }
  }
  parallel_for(count, kChunk, watch, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint32_t>& own = places[static_cast<std::size_t>(begin / kChunk)];
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      to[own[digit(from[i])]++] = from[i];
  });
}

}  // namespace

void sort_by_code(std::vector<MortonEntry>& entries, StageWatch& watch) {
  constexpr std::size_t kFew = 4096;  // faster by comparing
  if (entries.size() < kFew) {
    std::sort(entries.begin(), entries.end(), [](const MortonEntry& a, const MortonEntry& b) {
      return a.code != b.code ? a.code < b.code : a.index < b.index;
    });
    return;
  }
  std::vector<MortonEntry> other(entries.size());
  for (const int shift : {0, 10, 20}) {
    sort_by_digit(entries, other, shift, watch);
    entries.swap(other);
  }
}

BoxHierarchy make_box_hierarchy(std::size_t count, std::uint32_t leaf_size, const Box3& bounds,
                                const std::function<BoxHierarchy::Box(std::size_t)>& box, StageWatch& watch) {
  const Vec3d sides = bounds.hi - bounds.lo;
  const double longest = std::max({sides.x, sides.y, sides.z}), scale = longest > 0 ? kMortonRange / longest : 0;
  const auto place = [&](std::size_t i) {
    const auto [lo, hi] = box(i);
    return to_float(((to_double(lo) + to_double(hi)) * 0.5 - bounds.lo) * scale);
  };
  const std::vector<MortonEntry> sorted = morton_order(count, place, watch);
  BoxHierarchy tree;
  if (sorted.empty()) return tree;
  tree.nodes = Builder(sorted, leaf_size, box).run(watch);
  tree.order.resize(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) tree.order[i] = sorted[i].index;
  return tree;
}

BoxHierarchy make_box_hierarchy(std::span<const Triangle> triangles, std::span<const Vec3> corners, StageWatch& watch) {
  constexpr std::uint32_t kLeafSize = 4;
  const auto box = [&](std::size_t i) { return triangle_box(corners, triangles[i]); };
  return make_box_hierarchy(triangles.size(), kLeafSize, box_of(corners), box, watch);
}

}  // namespace tetsoup
