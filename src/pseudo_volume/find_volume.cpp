#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

#include "base/bits.h"
#include "base/elementary.h"
#include "base/unions.h"
#include "base/vec.h"
#include "pseudo_volume/cavities.h"
#include "pseudo_volume/classify_volume.h"
#include "pseudo_volume/solids.h"
#include "pseudo_volume/votes.h"
#include "tetsoup/bodies.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {
namespace {

/// Of the triangles; soups with more rims than this are loose, and no crossing of theirs says anything.
constexpr double kMostRims = 0.25;
/// Of the inside: less filled space is not worth a word.
constexpr double kToldCavity = 0.02;
/// Of the score: holes that a wider band closes raise it by more, noise by less.
constexpr double kLeastGain = 1.1;

std::string to_text(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", number);
  return text.data();
}

struct Split {
  std::vector<std::uint32_t> sound, unsound;  ///< Triangles.
};

Split split_by_soundness(const CleanSoup& soup) {
  Split split;
  for (std::uint32_t t = 0; t < soup.soup.triangles.size(); ++t)
    (soup.parts.parts[soup.parts.part_of_triangle[t]].sound ? split.sound : split.unsound).push_back(t);
  return split;
}

/// The inside of the sound parts, and of that what is hollow by evidence.
struct Solids {
  BitGrid inside, hollow;
  Nests nests;
  bool all_oriented = true;
};

Solids find_solids(const CleanSoup& soup, const GridFrame& frame, Cavities cavities, StageWatch& watch) {
  Solids solids;
  std::size_t sound = 0;
  for (const SoupPart& part : soup.parts.parts) {
    sound += part.sound;
    solids.all_oriented = solids.all_oriented && (part.oriented || !part.sound);
  }
  if (sound == 0) return solids;
  std::vector<std::uint32_t> around = soup.parts.around;
  around.resize(soup.parts.parts.size(), SoupParts::kNone);
  solids.nests = make_nests(soup.parts, around, cavities);
  solids.inside = fill_solids(soup, solids.nests, frame, watch);
  if (soup.parts.near > 0) close_hairlines(solids.inside, static_cast<int>(soup.parts.near / frame.voxel_size + 0.5));
  if (solids.nests.cavities.empty()) return solids;
  solids.hollow = fill_solids(soup, make_nests(soup.parts, around, Cavities::Fill), frame, watch);
  for (std::size_t i = 0; i < solids.hollow.words.size(); ++i) solids.hollow.words[i] &= ~solids.inside.words[i];
  return solids;
}

/// The rims as a soup of segments.
CleanSoup rims_of(const CleanSoup& soup) {
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> name(soup.soup.vertices.size(), kNone);
  for (const auto& edge : soup.parts.odd_edges)
    for (const std::uint32_t v : edge) name[v] = 0;
  CleanSoup rims;
  for (std::size_t v = 0; v < name.size(); ++v) {
    if (name[v] == kNone) continue;
    name[v] = static_cast<std::uint32_t>(rims.soup.vertices.size());
    rims.soup.vertices.push_back(soup.soup.vertices[v]);
  }
  for (const auto& [a, b] : soup.parts.odd_edges) rims.soup.triangles.push_back({name[a], name[a], name[b]});
  rims.report = soup.report;
  rims.soup.origin = soup.soup.origin;
  rims.report.used_triangles = rims.soup.triangles.size();
  return rims;
}

/// Radius of the circle around which the longest rim would run, whatever its shape: no hole is wider than twice that.
double widest_hole_radius(const CleanSoup& soup) {
  Unions rims(soup.soup.vertices.size());
  for (const auto& [a, b] : soup.parts.odd_edges) rims.join(a, b);
  std::vector<double> around(soup.soup.vertices.size());
  double longest = 0;
  for (const auto& [a, b] : soup.parts.odd_edges) {
    double& sum = around[rims.find(a)];
    sum += length(to_double(soup.soup.vertices[a]) - to_double(soup.soup.vertices[b]));
    longest = std::max(longest, sum);
  }
  return longest / (2 * std::numbers::pi);
}

/// What the rays say of parts that are not sound.
PseudoVolume vote(const CleanSoup& soup, const GridFrame& frame, const PseudoVolumeOptions& options,
                  const BitGrid* solids, const Progress& progress) {
  const bool loose =
      static_cast<double>(soup.parts.odd_edges.size()) > kMostRims * static_cast<double>(soup.soup.triangles.size());
  DistanceField field = unsigned_distance(soup, frame, kLeastBandVoxels, progress), rim_field;
  CleanSoup rims;
  CrossingPlanes planes;
  Evidence evidence;
  evidence.solids = solids;
  if (!loose && options.placement == Placement::Closest && !soup.parts.odd_edges.empty()) {
    StageWatch watch(progress, "pseudo_volume");
    rims = rims_of(soup);
    rim_field = unsigned_distance(rims, frame, kLeastBandVoxels, progress);
    planes = find_crossings(soup.soup, frame, watch);
    evidence.planes = &planes;
    evidence.least_gain = kLeastGain;
    evidence.widest_band_voxels = widest_hole_radius(soup) / frame.voxel_size;
    evidence.rims = &rim_field;
  }
  std::optional<double> band = band_needed_voxels(field, options);
  PseudoVolume volume;
  while (band) {
    widen_distance(field, soup, *band, progress);
    if (evidence.rims != nullptr) widen_distance(rim_field, rims, *band, progress);
    volume = classify_volume(field, options, evidence, progress);
    band = volume.report.wants_band_voxels;
  }
  return volume;
}

/// Share of the surface that has an inside voxel beside it, by the middles of some thousand triangles.
class CoveredArea {
 public:
  explicit CoveredArea(const BitGrid& inside) : frame_(inside.frame), rows_(inside) {}

  void add(const TriangleSoup& soup, const Triangle& t) {
    const Vec3d a = to_double(soup.vertices[t[0]]), b = to_double(soup.vertices[t[1]]),
                c = to_double(soup.vertices[t[2]]);
    const double area = length(cross(b - a, c - a));
    const Vec3d at = ((a + b + c) * (1.0 / 3) - frame_.origin) * (1 / frame_.voxel_size);
    const int x = static_cast<int>(std::lround(at.x));
    const std::uint64_t near = rows_.grown(static_cast<int>(std::lround(at.y)), static_cast<int>(std::lround(at.z)),
                                           static_cast<std::size_t>(x / 64));
    all_ += area;
    covered_ += (near >> (x % 64) & 1U) != 0 ? area : 0;
  }
  double area() const { return all_; }
  double share() const { return all_ > 0 ? covered_ / all_ : 1; }

 private:
  const GridFrame& frame_;
  BitRows rows_;
  double all_ = 0, covered_ = 0;
};

double covered_share(const TriangleSoup& soup, const BitGrid& inside) {
  constexpr std::size_t kSamples = 4096;
  const std::size_t step = soup.triangles.size() / kSamples + 1;
  CoveredArea covered(inside);
  for (std::size_t i = 0; i < soup.triangles.size(); i += step) covered.add(soup, soup.triangles[i]);
  return covered.share();
}

/// Inside voxels with inside voxels beside all their faces.
BitGrid core_of(const BitGrid& inside) {
  BitGrid core = inside;
  const BitRows rows(inside);
  for (int z = 0; z < inside.frame.size[2]; ++z) {
    for (int y = 0; y < inside.frame.size[1]; ++y) {
      const std::uint64_t* here = rows.at(y, z);
      for (std::size_t w = 0; w < inside.words_per_row; ++w) {
        std::uint64_t& word = core.words[core.row(y, z) + w];
        word &= shifted_up(here, w) & shifted_down(here, w, inside.words_per_row);
        for (const std::uint64_t* beside : {rows.at(y - 1, z), rows.at(y + 1, z), rows.at(y, z - 1), rows.at(y, z + 1)})
          word &= beside == nullptr ? 0 : beside[w];
      }
    }
  }
  return core;
}

/// Of every part, how long its rims are.
std::vector<double> rim_lengths(const CleanSoup& soup) {
  std::vector<std::uint32_t> part(soup.soup.vertices.size());
  for (std::size_t t = 0; t < soup.soup.triangles.size(); ++t)
    for (const std::uint32_t v : soup.soup.triangles[t]) part[v] = soup.parts.part_of_triangle[t];
  std::vector<double> lengths(soup.parts.parts.size());
  for (const auto& [a, b] : soup.parts.odd_edges)
    lengths[part[a]] += length(to_double(soup.soup.vertices[a]) - to_double(soup.soup.vertices[b]));
  return lengths;
}

/// The triangles of sheets: open parts whose rims are long beside their area, and of which less than half has a body of
/// more than two voxels beside it.
std::vector<std::uint32_t> find_sheets(const CleanSoup& soup, PseudoVolume& volume) {
  const BitGrid body = dilated(core_of(volume.inside), 1);
  const std::vector<double> rims = rim_lengths(soup);
  std::vector<CoveredArea> covered(soup.parts.parts.size(), CoveredArea(body));
  for (std::size_t t = 0; t < soup.soup.triangles.size(); ++t)
    covered[soup.parts.part_of_triangle[t]].add(soup.soup, soup.soup.triangles[t]);
  const auto is_sheet = [&](std::size_t p) {
    return !soup.parts.parts[p].sound && covered[p].share() < 0.5 && rims[p] * rims[p] > covered[p].area() / 2;
  };
  double all = 0, sheets = 0;
  for (std::size_t p = 0; p < covered.size(); ++p) {
    all += covered[p].area();
    if (is_sheet(p)) sheets += covered[p].area();
  }
  volume.report.sheet_share = all > 0 ? sheets / all : 0;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < soup.soup.triangles.size(); ++t) {
    if (is_sheet(soup.parts.part_of_triangle[t])) triangles.push_back(t);
  }
  return triangles;
}

/// What lies within half the thickness of a sheet is inside.
void thicken_sheets(const CleanSoup& soup, double thickness, PseudoVolume& volume, const Progress& progress) {
  const std::vector<std::uint32_t> sheets = find_sheets(soup, volume);
  if (sheets.empty()) return;
  StageWatch watch(progress, "pseudo_volume");
  const GridFrame& frame = volume.inside.frame;
  const double half = thickness / 2, band = std::max(half / frame.voxel_size + 1, kLeastBandVoxels);
  const DistanceField field = unsigned_distance(subset_of(soup, sheets), frame, band, progress);
  add_bits(volume.inside, find_band(field.distance, static_cast<float>(half), watch).bits);
  volume.report.soup_covered = covered_share(soup.soup, volume.inside);
}

/// All rays agree.
VoteGrid votes_for(const BitGrid& inside, int rays) {
  VoteGrid votes;
  votes.frame = inside.frame;
  votes.words_per_row = inside.words_per_row;
  votes.words.resize(inside.words.size());
  for (std::size_t i = 0; i < inside.words.size(); ++i)
    for (std::size_t slice = 0; slice < votes.words[i].slices.size(); ++slice)
      votes.words[i].slices[slice] |= (rays >> slice & 1) != 0 ? inside.words[i] : 0;
  return votes;
}

/// A volume of sound parts alone: nothing was voted on.
PseudoVolume agreed(const CleanSoup& soup, Solids solids, const PseudoVolumeOptions& options, StageWatch& watch) {
  constexpr double kFloorVoxels = 0.9;
  PseudoVolume volume;
  volume.rays = options.rays;
  PseudoVolumeReport& report = volume.report;
  volume.inside = std::move(solids.inside);
  const bool fill = options.cavities == Cavities::Fill || (options.cavities == Cavities::Auto && !solids.all_oriented);
  if (fill) report.cavity_voxels = fill_cavities(volume.inside, make_bit_grid(volume.inside.frame), watch);
  for (std::size_t i = 0; i < solids.hollow.words.size(); ++i) volume.inside.words[i] &= ~solids.hollow.words[i];
  volume.votes = votes_for(volume.inside, options.rays);
  report.k = 1;
  report.band_voxels = kFloorVoxels;
  report.band = kFloorVoxels * volume.inside.frame.voxel_size;
  report.automatic = !options.k && !options.band && !options.band_voxels;
  report.consensus = 1;
  report.soup_covered = covered_share(soup.soup, volume.inside);
  return volume;
}

/// What was left hollow, or filled, and how to get the other.
void note_cavities(const PseudoVolumeOptions& options, PseudoVolumeReport& report) {
  double hollow = 0;
  for (const SoupCavity& cavity : report.cavities) hollow += cavity.volume;
  const std::size_t count = report.cavities.size();
  if (count > 0)
    report.notes.push_back((count == 1 ? "A closed space was" : std::to_string(count) + " closed spaces were") +
                           " left hollow (volume " + to_text(hollow) +
                           "), since shells turn their outside to it: --cavities fill makes the body solid.");
  if (options.cavities == Cavities::Auto && report.cavity_voxels > 0 &&
      static_cast<double>(report.cavity_voxels) > kToldCavity * static_cast<double>(report.inside_voxels))
    report.notes.push_back(
        "Space that the surface encloses was filled, since nothing says that it is hollow: "
        "--cavities keep leaves hollow what the rays call outside.");
}

}  // namespace

PseudoVolume find_volume(const CleanSoup& soup, const GridFrame& frame, const PseudoVolumeOptions& options,
                         const Progress& progress) {
  check_options(options);
  if (soup.report.used_triangles == 0) throw InvalidInput("the soup has no finite triangle");
  StageWatch watch(progress, "pseudo_volume");
  Split split = split_by_soundness(soup);
  if (options.placement == Placement::Entry) {
    split.unsound.insert(split.unsound.end(), split.sound.begin(), split.sound.end());
    split.sound.clear();
  }
  Solids solids;
  if (!split.sound.empty()) solids = find_solids(soup, frame, options.cavities, watch);
  const Nests nests = std::move(solids.nests);
  PseudoVolume volume;
  if (split.unsound.empty()) {
    volume = agreed(soup, std::move(solids), options, watch);
  } else if (split.sound.empty()) {
    volume = vote(soup, frame, options, nullptr, progress);
  } else {
    volume = vote(subset_of(soup, split.unsound), frame, options, &solids.inside, progress);
    for (std::size_t i = 0; i < solids.hollow.words.size(); ++i)
      volume.inside.words[i] &=
          ~(solids.hollow.words[i] & ~votes_above(volume.votes.words[i], static_cast<unsigned>(options.rays) / 2));
  }
  if (options.thickness) thicken_sheets(soup, *options.thickness, volume, progress);
  PseudoVolumeReport& report = volume.report;
  report.cavities = nests.cavities;
  note_cavities(options, report);
  report.exact_share =
      static_cast<double>(split.sound.size()) / static_cast<double>(split.sound.size() + split.unsound.size());
  report.inside_voxels = count_voxels(volume.inside);
  report.volume = static_cast<double>(report.inside_voxels) * elementary::cube(frame.voxel_size);
  if (split.unsound.empty()) report.bounded_volume = bounded_volume(soup, nests, report.volume, frame);
  return volume;
}

}  // namespace tetsoup
