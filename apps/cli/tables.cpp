// The tables of `tetsoup inspect`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "angles.h"
#include "part_labels.h"
#include "report_json.h"
#include "summary.h"

namespace tetsoup::cli {

namespace {

constexpr std::size_t kHistogramWidth = 40;  // columns of the longest bar

std::string row(std::string_view label, const std::string& value, std::string_view remark = {}) {
  std::string line = fmt::format("  {:<24}{:>14}", label, value);
  if (!remark.empty()) line += fmt::format("  {}", remark);
  return line + "\n";
}

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

std::string histogram(const Quality& quality) {
  const auto& bins = quality.dihedral_histogram;
  const auto used = [](std::size_t count) { return count > 0; };
  const auto first = std::find_if(bins.begin(), bins.end(), used);
  if (first == bins.end()) return {};
  const auto last = std::find_if(bins.rbegin(), bins.rend(), used).base();
  const std::size_t most = *std::max_element(first, last);
  constexpr std::size_t kBinDegrees = 180 / kDihedralBins;
  std::string text = "  dihedral angles in degrees, six a tet\n";
  for (auto bin = first; bin != last; ++bin) {
    const std::size_t low = static_cast<std::size_t>(bin - bins.begin()) * kBinDegrees;
    std::size_t length = *bin * kHistogramWidth / most;
    if (*bin > 0 && length == 0) length = 1;  // what is there is to be seen
    text += fmt::format("  {:>4} - {:<4}{:<{}} {}\n", low, low + kBinDegrees, std::string(length, '#'), kHistogramWidth,
                        grouped(*bin));
  }
  return text;
}

/// Nothing if the file names none. A name's control characters are not for the terminal.
std::string named_parts(const std::vector<PartName>& parts) {
  constexpr std::size_t kMost = 40;
  std::string text;
  for (std::size_t i = 0; i < std::min(parts.size(), kMost); ++i) {
    std::string name = parts[i].name;
    for (char& c : name)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    text += fmt::format("  {:<24}{:>14}  '{}'\n", std::string("triangles of ") + kind_name(parts[i].kind),
                        grouped(parts[i].triangle_count), name);
  }
  if (parts.size() > kMost) text += fmt::format("  and {} names more: --json lists them all\n", parts.size() - kMost);
  return text;
}

/// With as many digits as tell its sides apart, wherever it lies.
std::string box_text(const Vec3d& lo, const Vec3d& hi, const Vec3d& origin) {
  const double size = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
  const double far = std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)});
  int digits = 6;
  for (double reach = far; size > 0 && reach > size && digits < 17; reach /= 10) ++digits;
  return fmt::format("box from ({:.{}g}, {:.{}g}, {:.{}g}) to ({:.{}g}, {:.{}g}, {:.{}g})", origin.x + lo.x, digits,
                     origin.y + lo.y, digits, origin.z + lo.z, digits, origin.x + hi.x, digits, origin.y + hi.y, digits,
                     origin.z + hi.z, digits);
}

/// The triangles of a part and the box around them.
struct PartSize {
  std::size_t triangles = 0;
  Vec3d lo{HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  void add(const Vec3& v) {
    lo = {std::min(lo.x, double{v.x}), std::min(lo.y, double{v.y}), std::min(lo.z, double{v.z})};
    hi = {std::max(hi.x, double{v.x}), std::max(hi.y, double{v.y}), std::max(hi.z, double{v.z})};
  }
};

std::vector<PartSize> sizes_of(const PartLabels& parts, const TriangleSoup& soup) {
  std::vector<PartSize> sizes(parts.names.size());
  const auto is_point = [&](std::uint32_t v) {
    if (v >= soup.vertices.size()) return false;
    const Vec3& p = soup.vertices[v];
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& triangle = soup.triangles[t];
    if (!std::all_of(triangle.begin(), triangle.end(), is_point)) continue;
    PartSize& size = sizes[parts.of_triangles[t]];
    ++size.triangles;
    for (const std::uint32_t v : triangle) size.add(soup.vertices[v]);
  }
  return sizes;
}

}  // namespace

std::string tabulate_soup(const std::string& name, const SoupReport& soup, const std::vector<PartName>& parts) {
  std::string text = fmt::format("{}: {}\n", name,
                                 soup.kind == SoupClass::Closed ? "closed surface"
                                 : soup.kind == SoupClass::Open ? "surface with open edges"
                                 : soup.kind == SoupClass::Soup ? "soup of loose triangles"
                                                                : "no usable triangle");
  text += row("triangles", grouped(soup.triangle_count)) + row("vertices", grouped(soup.vertex_count)) +
          row("used triangles", grouped(soup.used_triangles)) +
          row("distinct positions", grouped(soup.merged_vertices)) +
          row("parts", grouped(soup.components), "joined through vertices") +
          row("open edges", grouped(soup.boundary_edges), "of one triangle") +
          row("non-manifold edges", grouped(soup.non_manifold_edges), "of three or more triangles") +
          row("inconsistent edges", grouped(soup.inconsistent_edges), "whose two triangles wind against each other") +
          row("zero-area triangles", grouped(soup.zero_area), "used as segments or points") +
          row("dropped: non-finite", grouped(soup.non_finite)) +
          row("dropped: wild index", grouped(soup.index_out_of_range)) +
          row("dropped: duplicate", grouped(soup.duplicates));
  if (soup.kind == SoupClass::Empty) return text + "There is nothing to mesh in it.\n";
  return text + "  " + box_text(soup.box.lo, soup.box.hi, soup.origin) + "\n" + named_parts(parts);
}

std::string tabulate_connected_parts(const TriangleSoup& soup) {
  constexpr std::size_t kMost = 12;
  const PartLabels parts = connected_parts(soup);
  if (parts.names.size() < 2) return {};
  const std::vector<PartSize> sizes = sizes_of(parts, soup);
  std::string text;
  for (std::size_t i = 0; i < std::min(sizes.size(), kMost); ++i)
    text += row("triangles of " + parts.names[i], grouped(sizes[i].triangles),
                box_text(sizes[i].lo, sizes[i].hi, soup.origin));
  if (sizes.size() > kMost) text += fmt::format("  and {} more\n", grouped(sizes.size() - kMost));
  return text;
}

std::string tabulate_tets(const std::string& name, const Quality& q) {
  std::string text =
      fmt::format("{}: {} mesh\n", name, q.inverted_tets + q.invalid_tets == 0 ? "valid tet" : "faulty tet");
  text += row("tets", grouped(q.tet_count)) + row("vertices", grouped(q.vertex_count)) +
          row("inverted tets", grouped(q.inverted_tets), "volume zero, negative or not a number") +
          row("invalid tets", grouped(q.invalid_tets), "index out of range or used twice") +
          row("unused vertices", grouped(q.unused_vertices)) + row("volume", number(q.volume)) +
          row("smallest tet volume", number(q.min_tet_volume)) + row("largest tet volume", number(q.max_tet_volume)) +
          row("smallest dihedral", fmt::format("{:.2f}", to_degrees(q.min_dihedral)), "degrees") +
          row("largest dihedral", fmt::format("{:.2f}", to_degrees(q.max_dihedral)), "degrees") +
          row("largest edge ratio", number(q.max_edge_ratio), "longest over shortest edge of a tet") +
          row("smallest mean ratio", number(q.mean_ratio_min), "1 = regular tet, 0 = flat") +
          row("average mean ratio", number(q.mean_ratio_mean)) +
          row("pieces", grouped(q.components), "joined through faces") +
          row("boundary triangles", grouped(q.boundary_triangles)) +
          row("boundary vertices", grouped(q.boundary_vertices)) +
          row("boundary closed", q.boundary_closed ? "yes" : "no") +
          row("boundary manifold", q.boundary_manifold ? "yes" : "no") +
          row("non-manifold edges", grouped(q.non_manifold_edges)) +
          row("non-manifold vertices", grouped(q.non_manifold_vertices)) +
          row("boundary-only tets", grouped(q.boundary_only_tets), "all four vertices on the boundary");
  return text + histogram(q);
}

}  // namespace tetsoup::cli
