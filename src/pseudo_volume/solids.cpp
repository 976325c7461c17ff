#include "pseudo_volume/solids.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bits.h"
#include "base/groups.h"
#include "base/unions.h"
#include "base/vec.h"
#include "pseudo_volume/crossings.h"

namespace tetsoup {
namespace {

constexpr int kLayersAtOnce = 8;

/// A row of voxels gets into a nest, or out of it.
struct Crossing {
  std::uint32_t row;  ///< Of those of some layers.
  std::uint32_t nest;
  std::int32_t first;  ///< First voxel beyond it.
  std::int32_t sign;
  bool operator<(const Crossing& o) const {
    if (row != o.row) return row < o.row;
    return nest != o.nest ? nest < o.nest : first < o.first;
  }
};

void set_bits(std::uint64_t* words, int begin, int end) {
  for (int x = begin; x < end;) {
    const auto word = static_cast<std::size_t>(x / 64);
    const int stop = std::min(end, static_cast<int>(word + 1) * 64), count = stop - x;
    words[word] |= (count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1) << (x % 64);
    x = stop;
  }
}

class SolidFiller {
 public:
  SolidFiller(const CleanSoup& soup, const Nests& nests, BitGrid& inside)
      : soup_(soup), nests_(nests), inside_(inside), frame_(inside.frame) {}

  /// Triangles by the layers they reach.
  Groups<std::uint32_t> by_slab() const {
    const auto slabs = static_cast<std::size_t>((frame_.size[2] + kLayersAtOnce - 1) / kLayersAtOnce);
    return {slabs, [&](const auto& put) {
              for (std::uint32_t t = 0; t < soup_.soup.triangles.size(); ++t) {
                if (nest_of(t) == Nests::kNone) continue;
                double lo = 1e300, hi = -1e300;
                for (const std::uint32_t v : soup_.soup.triangles[t]) {
                  const double z = voxel_z(soup_.soup.vertices[v]);
                  lo = std::min(lo, z);
                  hi = std::max(hi, z);
                }
                const int begin = std::max(0, first_at_least(lo)), end = std::min(frame_.size[2], first_at_least(hi));
                for (int s = begin / kLayersAtOnce; s * kLayersAtOnce < end; ++s) put(static_cast<std::size_t>(s), t);
              }
            }};
  }

  void fill(std::size_t slab, std::span<const std::uint32_t> triangles) const {
    const int begin = static_cast<int>(slab) * kLayersAtOnce, end = std::min(frame_.size[2], begin + kLayersAtOnce);
    std::vector<Crossing> crossings;
    for (const std::uint32_t t : triangles) cross(t, begin, end, crossings);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0, j = 0; i < crossings.size(); i = j) {
      while (j < crossings.size() && crossings[j].row == crossings[i].row && crossings[j].nest == crossings[i].nest)
        ++j;
      fill_row(std::span(crossings).subspan(i, j - i), begin);
    }
  }

 private:
  std::uint32_t nest_of(std::uint32_t t) const { return nests_.of_part[soup_.parts.part_of_triangle[t]]; }
  double voxel_z(const Vec3& p) const { return (static_cast<double>(p.z) - frame_.origin.z) / frame_.voxel_size; }

  SeenCorner seen(const Vec3& p) const {
    return {(static_cast<double>(p.y) - frame_.origin.y) / frame_.voxel_size, voxel_z(p),
            (static_cast<double>(p.x) - frame_.origin.x) / frame_.voxel_size};
  }

  void cross(std::uint32_t t, int begin, int end, std::vector<Crossing>& out) const {
    const auto [a, b, c] = soup_.soup.triangles[t];
    const std::vector<Vec3>& vertices = soup_.soup.vertices;
    const int turn = soup_.parts.turned[t] != 0 ? -1 : 1;
    const std::uint32_t nest = nest_of(t);
    cross_lines({seen(vertices[a]), seen(vertices[b]), seen(vertices[c])}, begin, end,
                [&](int y, int z, int first, int sign) {
                  if (y < 0 || y >= frame_.size[1]) return;
                  const auto row = static_cast<std::uint32_t>((z - begin) * frame_.size[1] + y);
                  out.push_back({row, nest, std::clamp(first, 0, frame_.size[0]), sign * turn});
                });
  }

  /// One row through one nest.
  void fill_row(std::span<const Crossing> crossings, int first_layer) const {
    const auto row = static_cast<int>(crossings.front().row);
    std::uint64_t* words = inside_.words.data() + inside_.row(row % frame_.size[1], first_layer + row / frame_.size[1]);
    const bool by_winding = nests_.by_winding[crossings.front().nest] != 0;
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
      winding = by_winding ? winding + crossings[i].sign : 1 - winding;
      if (winding != 0) set_bits(words, crossings[i].first, crossings[i + 1].first);
    }
  }

  const CleanSoup& soup_;
  const Nests& nests_;
  BitGrid& inside_;
  const GridFrame& frame_;
};

}  // namespace

Nests make_nests(const SoupParts& parts, std::span<const std::uint32_t> around, Cavities cavities) {
  const std::size_t count = parts.parts.size();
  Nests nests;
  nests.of_part.assign(count, Nests::kNone);
  Unions joined(count);
  const bool keep = cavities != Cavities::Fill;
  for (std::size_t p = 0; p < count; ++p) {
    const std::uint32_t holder = around[p];
    if (!keep || holder == Nests::kNone || !parts.parts[p].oriented || !parts.parts[holder].oriented) continue;
    joined.join(p, holder);
    if ((parts.parts[p].volume < 0) != (parts.parts[holder].volume < 0))
      nests.cavities.push_back({std::abs(parts.parts[p].volume), static_cast<std::uint32_t>(p)});
  }
  for (std::size_t p = 0; p < count; ++p) {
    if (!parts.parts[p].sound) continue;
    const std::size_t root = joined.find(p);
    if (nests.of_part[root] == Nests::kNone) {  // the smallest of a set is its root: met first
      nests.of_part[root] = static_cast<std::uint32_t>(nests.by_winding.size());
      nests.by_winding.push_back(parts.parts[root].oriented);
    }
    nests.of_part[p] = nests.of_part[root];
  }
  return nests;
}

BitGrid fill_solids(const CleanSoup& soup, const Nests& nests, const GridFrame& frame, StageWatch& watch) {
  BitGrid inside = make_bit_grid(frame);
  const SolidFiller filler(soup, nests, inside);
  const Groups<std::uint32_t> triangles = filler.by_slab();
  parallel_for(static_cast<std::int64_t>(triangles.size()), 1, watch, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t s = begin; s < end && !watch.stopped(); ++s)
      filler.fill(static_cast<std::size_t>(s), triangles[static_cast<std::size_t>(s)]);
  });
  return inside;
}

std::optional<double> bounded_volume(const CleanSoup& soup, const Nests& nests, double of_voxels,
                                     const GridFrame& frame) {
  const std::vector<SoupPart>& parts = soup.parts.parts;
  std::vector<std::uint8_t> is_hollow(parts.size(), 0);
  for (const SoupCavity& cavity : nests.cavities) is_hollow[cavity.part] = 1;
  double volume = 0;
  bool has_outside = false;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const bool is_second = is_hollow[p] != 0 ? is_hollow[soup.parts.around[p]] != 0 : has_outside;
    if (!parts[p].oriented || is_second) return std::nullopt;
    volume += (is_hollow[p] != 0 ? -1 : 1) * std::abs(parts[p].volume);
    has_outside = has_outside || is_hollow[p] == 0;
  }
  double area = 0;
  for (const auto& [a, b, c] : soup.soup.triangles) {
    const Vec3d at = to_double(soup.soup.vertices[a]);
    area += length(cross(to_double(soup.soup.vertices[b]) - at, to_double(soup.soup.vertices[c]) - at)) / 2;
  }
  if (std::abs(volume - of_voxels) > area * frame.voxel_size / 2) return std::nullopt;
  return volume;
}

void close_hairlines(BitGrid& inside, int most) {
  const BitGrid before = inside;
  const std::array<int, 3>& size = inside.frame.size;
  const std::size_t words = inside.words_per_row, layer = words * static_cast<std::size_t>(size[1]);
  for (int gap = 1; gap <= most; ++gap) {
    for (int z = 0; z < size[2]; ++z) {
      for (int y = 0; y < size[1]; ++y) {
        for (int x = 0; x < size[0]; ++x) {
          if (x + gap + 1 < size[0] && before.test(x, y, z) && !before.test(x + 1, y, z) &&
              before.test(x + gap + 1, y, z))
            set_bits(inside.words.data() + inside.row(y, z), x + 1, x + gap + 1);
        }
      }
    }
    const auto along = [&](int count, std::size_t stride, int other_count, std::size_t other_stride) {
      for (int j = 0; j < other_count; ++j) {
        for (int i = 0; i + gap + 1 < count; ++i) {
          const std::size_t from = static_cast<std::size_t>(i) * stride + static_cast<std::size_t>(j) * other_stride;
          for (std::size_t w = 0; w < words; ++w) {
            const std::uint64_t between = before.words[from + w] & ~before.words[from + stride + w] &
                                          before.words[from + static_cast<std::size_t>(gap + 1) * stride + w];
            if (between == 0) continue;
            for (int step = 1; step <= gap; ++step)
              inside.words[from + static_cast<std::size_t>(step) * stride + w] |= between;
          }
        }
      }
    };
    along(size[1], words, size[2], layer);
    along(size[2], layer, size[1], words);
  }
}

}  // namespace tetsoup
