#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/require.h"
#include "pseudo_volume/cavities.h"
#include "pseudo_volume/rays.h"
#include "pseudo_volume/score.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {
namespace {

/// Voxels: the crossing of a diagonal step, sqrt(3) voxels long, may be 0.87 voxels from both centres.
constexpr double kFloorVoxels = 0.9;
/// Voxels beyond the band whose distances are compared: a diagonal step, and a little for rounding.
constexpr double kReachVoxels = 1.74;
/// Bands that the automatic choice tries, in voxels, from narrow to wide.
constexpr std::array<double, 10> kCandidates{0.9, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8};
/// Known distance is asked for in these steps, since it costs more than trying a candidate: sound surfaces need the
/// first.
constexpr std::array<double, 3> kTiers{2, 3, 8};
/// The choice ends once this many candidates in a row did worse than the best, if the best is sound: below that score,
/// votes are speckle or nothing, and the best may lie anywhere.
constexpr std::size_t kWorseInARow = 2;
constexpr double kSoundScore = 0.45;

struct Trial {
  std::vector<VoteWord> votes;
  BitGrid inside;
  VoteStatistics statistics;
};

void check_options(const PseudoVolumeOptions& options) {
  if (int{options.k.has_value()} + int{options.band.has_value()} + int{options.band_voxels.has_value()} > 1)
    throw InvalidInput("give at most one of k, band_voxels and band");
  require(!options.k || (*options.k >= 0 && *options.k <= 1), "k", options.k.value_or(0), "0 to 1");
  const auto is_length = [](const std::optional<double>& v) { return !v || (*v > 0 && std::isfinite(*v)); };
  require(is_length(options.band), "band", options.band.value_or(0), "positive and finite");
  require(is_length(options.band_voxels), "band_voxels", options.band_voxels.value_or(0), "positive and finite");
  require(options.rays == 26 || options.rays == 13, "rays", options.rays, "26 or 13");
}

bool is_automatic(const PseudoVolumeOptions& o) {
  return !o.k && !o.band && !o.band_voxels;
}

/// The band that was asked for, in voxels, before the floor.
double asked_band_voxels(const DistanceField& field, const PseudoVolumeOptions& options) {
  if (options.band_voxels) return *options.band_voxels;
  if (options.band) return *options.band / field.distance.frame.voxel_size;
  return (1 - *options.k) * field.d_max / field.distance.frame.voxel_size;
}

bool is_served(const DistanceField& field, double band_voxels) {
  return (band_voxels + kReachVoxels) * field.distance.frame.voxel_size <= field.band * (1 + 1e-12);
}

/// A band of d_max or more would make all of the box one event.
bool is_useful(const DistanceField& field, double band_voxels) {
  return band_voxels == kCandidates.front() || band_voxels * field.distance.frame.voxel_size < field.d_max;
}

Trial try_band(const DistanceField& field, const Grid<float>& distance, double band_voxels,
               const PseudoVolumeOptions& options, const BitGrid& unpadded, StageWatch& watch, double begin,
               double end) {
  Trial trial;
  const auto band = static_cast<float>(band_voxels * field.distance.frame.voxel_size);
  cast_rays(distance, band, options.rays, options.placement, trial.votes, watch, begin, end);
  trial.inside = majority(field.distance.frame, trial.votes, options.rays);
  trial.statistics = summarize_votes(trial.inside, unpadded, trial.votes, options.rays);
  return trial;
}

/// Tries the candidates from narrow to wide and keeps the first of the best. The rule never looks at how far the field
/// is known: where that is not far enough to decide, the report asks for more.
void choose_band(const DistanceField& field, const Grid<float>& distance, const PseudoVolumeOptions& options,
                 const SoupMarks& marks, StageWatch& watch, PseudoVolumeReport& report, Trial& best) {
  double best_score = -1;
  std::size_t worse = 0;
  for (const double band : kCandidates) {
    if (!is_useful(field, band) || (worse >= kWorseInARow && best_score >= kSoundScore)) break;
    if (!is_served(field, band)) {
      report.wants_band_voxels = *std::lower_bound(kTiers.begin(), kTiers.end(), band) + kReachVoxels;
      break;
    }
    const double tried = static_cast<double>(report.candidates.size());
    const auto part = [&](double n) { return n / static_cast<double>(kCandidates.size()); };
    Trial trial = try_band(field, distance, band, options, marks.unpadded, watch, part(tried), part(tried + 1));
    const double score = score_votes(trial.inside, marks, trial.statistics);
    report.candidates.push_back({band, score, trial.statistics.consensus});
    ++worse;
    if (score > best_score) {
      best_score = score;
      worse = 0;
      report.band_voxels = band;
      best = std::move(trial);
    }
  }
}

void expand_votes(const std::vector<VoteWord>& votes, std::size_t words_per_row, Grid<std::uint8_t>& bytes,
                  StageWatch& watch) {
  const auto nx = static_cast<std::size_t>(bytes.frame.size[0]);
  bytes.values.resize(bytes.frame.voxel_count());
  const auto rows = static_cast<std::int64_t>(bytes.values.size() / nx);
  parallel_for(rows, 64, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row) {
      std::uint8_t* out = bytes.values.data() + row * nx;
      for (std::size_t w = 0; w < words_per_row; ++w) {
        const VoteWord& word = votes[row * words_per_row + w];
        if (word.above(0) == 0) continue;
        for (std::size_t x = 64 * w; x < std::min(nx, 64 * w + 64); ++x)
          out[x] = word.at(static_cast<unsigned>(x % 64));
      }
    }
  });
}

}  // namespace

double band_needed_voxels(const DistanceField& field, const PseudoVolumeOptions& options) {
  check_options(options);
  if (is_automatic(options)) return kTiers.front() + kReachVoxels;
  return std::max(asked_band_voxels(field, options), kFloorVoxels) + kReachVoxels;
}

PseudoVolume classify_volume(const DistanceField& field, const PseudoVolumeOptions& options, const Progress& progress) {
  check_options(options);
  const GridFrame& frame = field.distance.frame;
  StageWatch watch(progress, "pseudo_volume");
  const Grid<float> distance = dense(field.distance);
  const SoupMarks marks = mark_soup(distance, watch);

  PseudoVolume result;
  result.rays = options.rays;
  PseudoVolumeReport& report = result.report;
  Trial trial;
  if (is_automatic(options)) {
    report.automatic = true;
    choose_band(field, distance, options, marks, watch, report, trial);
  } else {
    const double asked = asked_band_voxels(field, options);
    report.floored = asked < kFloorVoxels;
    report.band_voxels = std::max(asked, kFloorVoxels);
    if (!is_served(field, report.band_voxels))
      throw InvalidInput(
          "the distance field's band is too narrow for this k: widen_distance() to band_needed_voxels()");
    trial = try_band(field, distance, report.band_voxels, options, marks.unpadded, watch, 0, 1);
  }

  if (options.cavities == Cavities::Fill && !report.wants_band_voxels)
    report.cavity_voxels = fill_cavities(trial.inside, marks.sealed, watch);
  for (const std::uint64_t word : trial.inside.words)
    report.inside_voxels += static_cast<std::size_t>(std::popcount(word));
  report.soup_covered = covered_share(trial.inside, marks.touched);
  report.band = report.band_voxels * frame.voxel_size;
  report.k = field.d_max > 0 ? std::max(0.0, 1 - report.band / field.d_max) : 0;
  report.volume = static_cast<double>(report.inside_voxels) * std::pow(frame.voxel_size, 3);
  report.consensus = trial.statistics.consensus;
  result.inside = std::move(trial.inside);
  result.votes.frame = frame;
  watch.enter_part(0.98, 1);
  expand_votes(trial.votes, result.inside.words_per_row, result.votes, watch);
  return result;
}

}  // namespace tetsoup
