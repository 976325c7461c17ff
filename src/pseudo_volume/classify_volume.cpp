#include <algorithm>
#include <array>
#include <cmath>

#include "base/require.h"
#include "pseudo_volume/rays.h"
#include "pseudo_volume/score.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {
namespace {

/// Voxels: the crossing of a diagonal step, sqrt(3) voxels long, may be 0.87 voxels from both centres.
constexpr double kFloorVoxels = 0.9;
/// Voxels beyond the band whose distances are compared: a diagonal step, and a little for rounding.
constexpr double kReachVoxels = 1.74;
/// Bands that the automatic choice tries, in voxels. The first six are what sound surfaces need; only if the widest of
/// those is the best are the others tried, since they cost a wider distance band.
constexpr std::array<double, 10> kCandidates{0.9, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8};
constexpr std::size_t kFirstCandidates = 6;

struct Trial {
  std::vector<VoteWord> votes;
  BitGrid inside;
  VoteStatistics statistics;
};

void check_options(const PseudoVolumeOptions& options) {
  if (int{options.k.has_value()} + int{options.band.has_value()} + int{options.band_voxels.has_value()} > 1)
    throw InvalidInput("give at most one of k, band_voxels and band");
  require(!options.k || (*options.k > 0 && *options.k <= 1), "k", options.k.value_or(0), "above 0 and at most 1");
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

/// Candidates that this field can serve; a band of d_max or more would make all of the box one event.
std::vector<double> candidates_for(const DistanceField& field) {
  std::vector<double> bands;
  for (const double b : kCandidates) {
    const bool useful = b == kFloorVoxels || b * field.distance.frame.voxel_size < field.d_max;
    if (useful && is_served(field, b)) bands.push_back(b);
  }
  return bands;
}

Trial try_band(const DistanceField& field, double band_voxels, const PseudoVolumeOptions& options,
               const BitGrid& unpadded, StageWatch& watch, double begin, double end) {
  Trial trial;
  const auto band = static_cast<float>(band_voxels * field.distance.frame.voxel_size);
  cast_rays(field.distance, band, options.rays, options.placement, trial.votes, watch, begin, end);
  trial.inside = majority(field.distance.frame, trial.votes, options.rays);
  trial.statistics = summarize_votes(trial.inside, unpadded, trial.votes, options.rays);
  return trial;
}

/// Tries the candidates from narrow to wide and keeps the first of the best.
double choose_band(const DistanceField& field, const PseudoVolumeOptions& options, const SoupMarks& marks,
                   StageWatch& watch, PseudoVolumeReport& report, Trial& best) {
  const std::vector<double> bands = candidates_for(field);
  double best_band = 0, best_score = -1;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const auto part = [&](std::size_t j) { return static_cast<double>(j) / static_cast<double>(bands.size()); };
    Trial trial = try_band(field, bands[i], options, marks.unpadded, watch, part(i), part(i + 1));
    const double score = score_votes(trial.inside, marks, trial.statistics);
    report.candidates.push_back({bands[i], score, trial.statistics.consensus});
    if (score > best_score) {
      best_score = score;
      best_band = bands[i];
      best = std::move(trial);
    }
    // The rule is the same for any field, so a wider known band never changes the choice.
    if (i + 1 == kFirstCandidates && best_band < bands[i] && best_score > 0) break;
  }
  const double h = field.distance.frame.voxel_size;
  const auto next = std::upper_bound(kCandidates.begin(), kCandidates.end(), bands.back());
  const bool more = next != kCandidates.end() && *next * h < field.d_max;
  report.wants_wider_band = more && (bands.size() > kFirstCandidates || best_band == bands.back() || best_score <= 0);
  return best_band;
}

void expand_votes(const std::vector<VoteWord>& votes, std::size_t words_per_row, Grid<std::uint8_t>& bytes,
                  StageWatch& watch) {
  const auto nx = static_cast<std::size_t>(bytes.frame.size[0]);
  bytes.values.resize(bytes.frame.voxel_count());
  const auto rows = static_cast<std::int64_t>(bytes.values.size() / nx);
  parallel_for(rows, 64, watch, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row)
      for (std::size_t x = 0; x < nx; ++x)
        bytes.values[row * nx + x] = votes[row * words_per_row + x / 64].at(static_cast<unsigned>(x % 64));
  });
}

}  // namespace

double band_needed_voxels(const DistanceField& field, const PseudoVolumeOptions& options, bool wide) {
  check_options(options);
  if (is_automatic(options)) return (wide ? kCandidates.back() : kCandidates[kFirstCandidates - 1]) + kReachVoxels;
  return std::max(asked_band_voxels(field, options), kFloorVoxels) + kReachVoxels;
}

PseudoVolume classify_volume(const DistanceField& field, const PseudoVolumeOptions& options, const Progress& progress) {
  check_options(options);
  const GridFrame& frame = field.distance.frame;
  StageWatch watch(progress, "pseudo_volume");
  const SoupMarks marks = mark_soup(field.distance);

  PseudoVolume result;
  result.rays = options.rays;
  PseudoVolumeReport& report = result.report;
  Trial trial;
  if (is_automatic(options)) {
    report.automatic = true;
    report.band_voxels = choose_band(field, options, marks, watch, report, trial);
  } else {
    const double asked = asked_band_voxels(field, options);
    report.floored = asked < kFloorVoxels;
    report.band_voxels = std::max(asked, kFloorVoxels);
    if (!is_served(field, report.band_voxels))
      throw InvalidInput(
          "the distance field's band is too narrow for this k: widen_distance() to band_needed_voxels()");
    trial = try_band(field, report.band_voxels, options, marks.unpadded, watch, 0, 1);
  }

  report.band = report.band_voxels * frame.voxel_size;
  report.k = field.d_max > 0 ? std::max(0.0, 1 - report.band / field.d_max) : 0;
  report.inside_voxels = trial.statistics.inside;
  report.volume = static_cast<double>(report.inside_voxels) * std::pow(frame.voxel_size, 3);
  report.consensus = trial.statistics.consensus;
  result.inside = std::move(trial.inside);
  result.votes.frame = frame;
  watch.enter_part(0.98, 1);
  expand_votes(trial.votes, result.inside.words_per_row, result.votes, watch);
  return result;
}

}  // namespace tetsoup
