#include "calibrate/dissection.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/vec.h"

namespace tetsoup {

namespace {

constexpr std::size_t kLeafVertices = 16;  ///< Dense from here on: halving on saved no time.

class Dissector {
 public:
  explicit Dissector(const ElasticBody& body) : body_(body), side_(body.vertex_count(), kElsewhere) {}

  Dissection run() {
    std::vector<std::uint32_t> all(body_.vertex_count());
    std::iota(all.begin(), all.end(), 0U);
    result_.places.resize(all.size());
    split(all, 0);
    find_boundaries();
    return std::move(result_);
  }

 private:
  enum Side : std::uint8_t { kElsewhere, kLow, kHigh, kBetween };
  struct Parting {
    std::vector<std::uint32_t> low, high, between;
  };

  /// The middle by one coordinate, equal ones by index; those of the half with fewer such that touch the other part it.
  Parting part(const std::vector<std::uint32_t>& vertices, double Vec3d::*axis) {
    std::vector<std::uint32_t> sorted = vertices;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double pa = body_.points()[a].*axis, pb = body_.points()[b].*axis;
      return pa != pb ? pa < pb : a < b;
    });
    for (auto v = sorted.begin(); v != sorted.end(); ++v) side_[*v] = v < middle ? kLow : kHigh;
    std::array<std::vector<std::uint32_t>, 2> touching;
    for (const std::uint32_t v : vertices) {
      const Side other = side_[v] == kLow ? kHigh : kLow;
      const auto beside = body_.neighbours(v);
      if (std::any_of(beside.begin(), beside.end(), [&](std::uint32_t n) { return side_[n] == other; }))
        touching[side_[v] == kLow ? 0 : 1].push_back(v);
    }
    Parting parting;
    parting.between = std::move(touching[touching[1].size() < touching[0].size() ? 1 : 0]);
    for (const std::uint32_t v : parting.between) side_[v] = kBetween;
    for (const std::uint32_t v : vertices) {
      if (side_[v] == kLow) parting.low.push_back(v);
      if (side_[v] == kHigh) parting.high.push_back(v);
      side_[v] = kElsewhere;
    }
    return parting;
  }

  std::size_t split(const std::vector<std::uint32_t>& vertices, std::size_t depth) {
    Front front;
    front.depth = depth;
    if (vertices.size() <= kLeafVertices) return finish(std::move(front), vertices);
    Parting best = part(vertices, &Vec3d::x);
    for (const auto axis : {&Vec3d::y, &Vec3d::z}) {
      Parting other = part(vertices, axis);
      if (other.between.size() < best.between.size()) best = std::move(other);
    }
    for (const auto* half : {&best.low, &best.high})
      if (!half->empty()) front.children.push_back(split(*half, depth + 1));
    return finish(std::move(front), best.between);
  }

  std::size_t finish(Front&& front, const std::vector<std::uint32_t>& own) {
    front.first = result_.order.size();
    front.count = own.size();
    for (const std::uint32_t v : own) {
      result_.places[v] = static_cast<std::uint32_t>(result_.order.size());
      result_.order.push_back(v);
    }
    result_.fronts.push_back(std::move(front));
    return result_.fronts.size() - 1;
  }

  void find_boundaries() {
    for (Front& front : result_.fronts) {
      const std::size_t end = front.first + front.count;
      auto& rows = front.boundary;
      for (std::size_t place = front.first; place < end; ++place)
        for (const std::uint32_t n : body_.neighbours(result_.order[place]))
          if (result_.places[n] >= end) rows.push_back(result_.places[n]);
      for (const std::size_t child : front.children)
        for (const std::uint32_t place : result_.fronts[child].boundary)
          if (place >= end) rows.push_back(place);
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    }
  }

  const ElasticBody& body_;
  std::vector<Side> side_;
  Dissection result_;
};

}  // namespace

Dissection dissect(const ElasticBody& body) {
  return Dissector(body).run();
}

}  // namespace tetsoup
