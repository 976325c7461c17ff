#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/unions.h"
#include "base/vec.h"
#include "bodies/touching_groups.h"
#include "tetsoup/bodies.h"

namespace tetsoup {
namespace {

/// Of the model: parts that come closer hang together for whoever looks at it.
constexpr double kHairline = 1.0 / 256;
/// A part that is so many times as large as all others together tells nothing of the model's size.
constexpr double kOutsize = 8;
/// Cells along the extent of all parts with rims: those in neighbouring cells are one body.
constexpr int kCells = 16;
/// Of the largest body's extent, and of all area: an open piece below both is a speck.
constexpr double kSpeckSize = 0.02, kSpeckArea = 1e-4;

double longest(const Box3& box) {
  const Vec3d e = box.hi - box.lo;
  return std::max({e.x, e.y, e.z});
}
double thinnest(const Box3& box) {
  const Vec3d e = box.hi - box.lo;
  return std::min({e.x, e.y, e.z});
}
Box3 united(const Box3& a, const Box3& b) {
  return {min(a.lo, b.lo), max(a.hi, b.hi)};
}
bool overlap(const Box3& a, const Box3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

/// Parts by size, the largest first, as long as each is outsize beside all that follow: those, and the extent of the
/// others.
struct Extent {
  std::vector<std::uint8_t> outsize;  ///< Of every part.
  double model = 0;
};
Extent find_extent(const std::vector<SoupPart>& parts) {
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return longest(parts[a].box) > longest(parts[b].box); });
  std::vector<Box3> rest(parts.size() + 1, {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}});
  for (std::size_t i = parts.size(); i-- > 0;) rest[i] = united(rest[i + 1], parts[order[i]].box);
  Extent extent{std::vector<std::uint8_t>(parts.size()), longest(rest[0])};
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const Box3& box = parts[order[i]].box;
    const double others = longest(rest[i + 1]);
    if (!(others > 0) || longest(box) < kOutsize * others) break;
    extent.outsize[order[i]] = thinnest(box) * kOutsize < others;
    extent.model = others;
  }
  return extent;
}

class Splitter {
 public:
  Splitter(const CleanSoup& soup, StageWatch& watch)
      : soup_(soup), parts_(soup.parts.parts), extent_(find_extent(parts_)), watch_(watch), sets_(parts_.size()) {}

  Bodies split() {
    const std::vector<std::uint32_t> touching = groups_within(0);
    std::vector<std::uint8_t> closed(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) closed[p] = parts_[p].sound;
    around_ = part_inside(soup_.soup, soup_.parts.part_of_triangle, touching, closed, watch_);
    join_groups(groups_within(extent_.model * kHairline));
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (around_[p] != kNoPart) join(p, around_[p]);
    join_rimmed();
    join_reached();
    return collect(touching);
  }

 private:
  std::vector<std::uint32_t> groups_within(double near) const {
    return touching_groups(soup_.soup, soup_.parts.part_of_triangle, parts_.size(), near, watch_);
  }
  void join(std::size_t a, std::size_t b) {
    if (extent_.outsize[a] == extent_.outsize[b]) sets_.join(a, b);
  }
  void join_groups(const std::vector<std::uint32_t>& groups) {
    for (const int outsize : {0, 1}) {
      std::vector<std::uint32_t> first(parts_.size(), kNoPart);
      for (std::uint32_t p = 0; p < parts_.size(); ++p) {
        if (extent_.outsize[p] != outsize) continue;
        if (first[groups[p]] == kNoPart) first[groups[p]] = p;
        sets_.join(first[groups[p]], p);
      }
    }
  }

  /// Parts with rims: those that reach into neighbouring cells of a coarse grid.
  void join_rimmed() {
    Box3 box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (is_loose(p)) box = united(box, parts_[p].box);
    const double cell = longest(box) / kCells;
    if (!(cell > 0)) return;
    constexpr int kSide = kCells + 2;
    std::vector<std::uint32_t> holder(kSide * kSide * kSide, kNoPart);
    for (std::size_t t = 0; t < soup_.soup.triangles.size(); ++t) {
      const std::uint32_t p = soup_.parts.part_of_triangle[t];
      if (!is_loose(p)) continue;
      std::array<int, 3> lo, hi;
      cells_of(t, box.lo, cell, lo, hi);
      for (int z = lo[2]; z <= hi[2]; ++z)
        for (int y = lo[1]; y <= hi[1]; ++y)
          for (int x = lo[0]; x <= hi[0]; ++x) {
            std::uint32_t& here = holder[static_cast<std::size_t>((z * kSide + y) * kSide + x)];
            if (here == kNoPart) here = p;
            sets_.join(here, p);
          }
    }
    const auto at = [&](int x, int y, int z) { return holder[static_cast<std::size_t>((z * kSide + y) * kSide + x)]; };
    for (int z = 0; z + 1 < kSide; ++z)
      for (int y = 0; y + 1 < kSide; ++y)
        for (int x = 0; x + 1 < kSide; ++x) join_cube(at, x, y, z);
  }
  template <class At>
  void join_cube(const At& at, int x, int y, int z) {
    std::uint32_t first = kNoPart;
    for (int i = 0; i < 8; ++i) {
      const std::uint32_t p = at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
      if (p == kNoPart) continue;
      if (first == kNoPart) first = p;
      sets_.join(first, p);
    }
  }
  bool is_loose(std::size_t p) const { return !parts_[p].sound && extent_.outsize[p] == 0; }
  void cells_of(std::size_t t, const Vec3d& origin, double cell, std::array<int, 3>& lo, std::array<int, 3>& hi) const {
    Vec3 low = soup_.soup.vertices[soup_.soup.triangles[t][0]], high = low;
    for (const std::uint32_t v : soup_.soup.triangles[t]) {
      low = min(low, soup_.soup.vertices[v]);
      high = max(high, soup_.soup.vertices[v]);
    }
    const Vec3d a = (to_double(low) - origin) * (1 / cell), b = (to_double(high) - origin) * (1 / cell);
    lo = {static_cast<int>(a.x), static_cast<int>(a.y), static_cast<int>(a.z)};
    hi = {static_cast<int>(b.x), static_cast<int>(b.y), static_cast<int>(b.z)};
  }

  /// Bodies with rims take in the closed ones whose boxes they reach, until nothing changes.
  void join_reached() {
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<Box3> box(parts_.size(), {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}});
      std::vector<std::uint8_t> rimmed(parts_.size());
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        box[sets_.find(p)] = united(box[sets_.find(p)], parts_[p].box);
        rimmed[sets_.find(p)] |= is_loose(p);
      }
      for (std::size_t a = 0; a < parts_.size(); ++a) {
        if (rimmed[a] == 0 || sets_.find(a) != a) continue;
        for (std::size_t b = 0; b < parts_.size(); ++b) {
          if (box[b].lo.x > box[b].hi.x || sets_.find(b) == sets_.find(a) || !overlap(box[a], box[b])) continue;
          if (extent_.outsize[a] != extent_.outsize[b]) continue;
          sets_.join(a, b);
          changed = true;
        }
      }
    }
  }

  double area_of(std::uint32_t t) const {
    const auto [a, b, c] = soup_.soup.triangles[t];
    const Vec3d at = to_double(soup_.soup.vertices[a]);
    return length(cross(to_double(soup_.soup.vertices[b]) - at, to_double(soup_.soup.vertices[c]) - at)) / 2;
  }

  struct Found {
    std::vector<std::uint32_t> triangles;
    Box3 box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
    double area = 0;
    bool sound = true, parts_apart = false;
    std::uint32_t touching = kNoPart;
  };
  std::vector<Found> find_bodies(const std::vector<std::uint32_t>& touching) {
    std::vector<std::uint32_t> name(parts_.size(), kNoPart);
    std::vector<Found> found;
    for (std::uint32_t t = 0; t < soup_.soup.triangles.size(); ++t) {
      const std::uint32_t p = soup_.parts.part_of_triangle[t];
      std::uint32_t& body = name[sets_.find(p)];
      if (body == kNoPart) {
        body = static_cast<std::uint32_t>(found.size());
        found.emplace_back();
      }
      Found& f = found[body];
      f.triangles.push_back(t);
      f.box = united(f.box, parts_[p].box);
      f.area += area_of(t);
      f.sound = f.sound && parts_[p].sound;
      if (f.touching == kNoPart) f.touching = touching[p];
      f.parts_apart = f.parts_apart || (f.touching != touching[p] && around_[p] == kNoPart);
    }
    return found;
  }

  Bodies collect(const std::vector<std::uint32_t>& touching) {
    std::vector<Found> found = find_bodies(touching);
    double area = 0, size = 0;
    for (const Found& f : found) {
      area += f.area;
      if (f.area > 0) size = std::max(size, longest(f.box));
    }
    Bodies bodies;
    bodies.around = std::move(around_);
    for (Found& f : found) {
      const bool speck = found.size() > 1 && !f.sound && area > 0 && f.area <= kSpeckArea * area &&
                         longest(f.box) <= kSpeckSize * size;
      if (speck) {
        bodies.specks.insert(bodies.specks.end(), f.triangles.begin(), f.triangles.end());
        continue;
      }
      bodies.triangles.push_back(std::move(f.triangles));
      bodies.near.push_back(f.parts_apart ? extent_.model * kHairline : 0);
    }
    return bodies;
  }

  const CleanSoup& soup_;
  const std::vector<SoupPart>& parts_;
  Extent extent_;
  StageWatch& watch_;
  Unions sets_;
  std::vector<std::uint32_t> around_;
};

std::vector<std::uint32_t> all_triangles(const CleanSoup& soup) {
  std::vector<std::uint32_t> all(soup.soup.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

Bodies split_bodies(const CleanSoup& soup, Join join, const Progress& progress) {
  StageWatch watch(progress, "bodies");
  if (soup.parts.parts.size() <= 1)
    return {{all_triangles(soup)}, {0}, {}, std::vector<std::uint32_t>(soup.parts.parts.size(), kNoPart)};
  Bodies bodies = Splitter(soup, watch).split();
  if (join == Join::Touching) return bodies;
  std::vector<std::uint32_t> all;
  for (const auto& triangles : bodies.triangles) all.insert(all.end(), triangles.begin(), triangles.end());
  std::sort(all.begin(), all.end());
  bodies.triangles = {std::move(all)};
  bodies.near = {0};
  return bodies;
}

CleanSoup subset_of(const CleanSoup& soup, std::span<const std::uint32_t> chosen) {
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  CleanSoup out;
  out.report.kind = soup.report.kind;
  out.soup.origin = out.report.origin = soup.soup.origin;
  std::vector<std::uint32_t> vertex(soup.soup.vertices.size(), kNone), part(soup.parts.parts.size(), kNone);
  for (const std::uint32_t t : chosen)
    for (const std::uint32_t v : soup.soup.triangles[t]) vertex[v] = 0;
  for (std::size_t v = 0; v < vertex.size(); ++v) {
    if (vertex[v] == kNone) continue;
    vertex[v] = static_cast<std::uint32_t>(out.soup.vertices.size());
    out.soup.vertices.push_back(soup.soup.vertices[v]);
  }
  for (const std::uint32_t t : chosen) {
    const auto [a, b, c] = soup.soup.triangles[t];
    out.soup.triangles.push_back({vertex[a], vertex[b], vertex[c]});
    std::uint32_t& name = part[soup.parts.part_of_triangle[t]];
    if (name == kNone) {
      name = static_cast<std::uint32_t>(out.parts.parts.size());
      out.parts.parts.push_back(soup.parts.parts[soup.parts.part_of_triangle[t]]);
    }
    out.parts.part_of_triangle.push_back(name);
    out.parts.turned.push_back(soup.parts.turned[t]);
  }
  const auto renamed = [&](std::uint32_t p) { return p == SoupParts::kNone ? p : part[p]; };
  if (!soup.parts.around.empty()) {
    out.parts.around.assign(out.parts.parts.size(), SoupParts::kNone);
    for (std::size_t p = 0; p < part.size(); ++p)
      if (part[p] != kNone) out.parts.around[part[p]] = renamed(soup.parts.around[p]);
  }
  for (const auto& [a, b] : soup.parts.odd_edges)
    if (vertex[a] != kNone && vertex[b] != kNone) out.parts.odd_edges.push_back({vertex[a], vertex[b]});
  out.report.vertex_count = out.report.merged_vertices = out.soup.vertices.size();
  out.report.triangle_count = out.report.used_triangles = out.soup.triangles.size();
  out.report.components = out.parts.parts.size();
  out.report.box = box_of(out.soup.vertices);
  return out;
}

}  // namespace tetsoup
