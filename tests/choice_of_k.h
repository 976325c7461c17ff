// How much does the automatic choice of k lose against the best fixed band, known only with the true solid?
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "damage.h"
#include "ray_parity.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/samples.h"

namespace tetsoup::test {

/// The fixed bands that the choice is held against, in voxels.
inline constexpr std::array<double, 10> kFixedBands{0.9, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8};

struct Damage {
  std::string name;
  TriangleSoup soup;
};

/// The same model intact and in nine states of ruin. Lengths are in shares of the longest side of its box.
inline std::vector<Damage> make_damages(const TriangleSoup& soup, std::uint64_t seed) {
  constexpr double kHoleRadius = 0.06;
  const double size = longest_side(soup);
  std::vector<Damage> all{{"intact", soup}};
  for (const int percent : {50, 90, 95, 99})
    all.push_back({std::to_string(percent) + " % removed", remove_triangles(soup, percent / 100.0, seed)});
  for (const int percent : {20, 50})
    all.push_back(
        {std::to_string(percent) + " % in patches", remove_patches(soup, percent / 100.0, kHoleRadius * size, seed)});
  all.push_back({"jitter 0.2 %", detached(soup, 0.002 * size, seed)});
  all.push_back({"jitter 1 %", detached(soup, 0.01 * size, seed)});
  return all;
}

/// The true solids of one model, by grid: most states of it share one.
class TrueSolid {
 public:
  explicit TrueSolid(const TriangleSoup& intact) : intact_(intact) {}

  const TriangleSoup& intact() const { return intact_; }
  const BitGrid& on(const GridFrame& frame) {
    for (const BitGrid& known : known_)
      if (known.frame == frame) return known;
    return known_.emplace_back(winding_solid(intact_, frame));
  }

 private:
  TriangleSoup intact_;
  std::vector<BitGrid> known_;
};

/// IoU with the true solid.
struct BandTrial {
  std::array<double, kFixedBands.size()> fixed{};
  double automatic = 0, automatic_band = 0;

  double best() const { return *std::max_element(fixed.begin(), fixed.end()); }
  double best_band() const {
    return kFixedBands[static_cast<std::size_t>(std::max_element(fixed.begin(), fixed.end()) - fixed.begin())];
  }
  double loss() const { return best() - automatic; }
};

/// A field over the box of both soups, so that it holds all of the true solid, wide enough for all bands.
inline DistanceField field_for_trial(const TriangleSoup& damaged, const TriangleSoup& intact, int voxels) {
  const CleanSoup clean = clean_soup(damaged);
  const Box3 a = clean.report.box, b = clean_soup(intact).report.box;
  DistanceOptions options;
  options.box = Box3{{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
                     {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
  options.voxels = voxels;
  options.band_voxels = 10;
  return unsigned_distance(clean, options);
}

inline BandTrial try_bands(const TriangleSoup& damaged, TrueSolid& truth, int voxels) {
  const DistanceField field = field_for_trial(damaged, truth.intact(), voxels);
  const BitGrid& solid = truth.on(field.distance.frame);
  BandTrial trial;
  for (std::size_t i = 0; i < kFixedBands.size(); ++i) {
    PseudoVolumeOptions options;
    options.band_voxels = kFixedBands[i];
    trial.fixed[i] = overlap(classify_volume(field, options).inside, solid);
  }
  const PseudoVolume chosen = classify_volume(field);
  trial.automatic = overlap(chosen.inside, solid);
  trial.automatic_band = chosen.report.band_voxels;
  return trial;
}

}  // namespace tetsoup::test
