#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.h"
#include "base/bits.h"
#include "base/require.h"
#include "pseudo_volume/band_bits.h"
#include "pseudo_volume/cavities.h"
#include "pseudo_volume/classify_volume.h"
#include "pseudo_volume/largest_closure.h"
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
constexpr std::array<double, 13> kCandidates{0.9, 1.25, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8};
/// Known distance is asked for in these steps, since it costs more than trying a candidate: sound surfaces need the
/// first.
constexpr std::array<double, 3> kTiers{1.5, 3, 8};
/// The choice ends once this many candidates in a row did worse than the best: the score rises while holes close and
/// falls once the soup is buried.
constexpr std::size_t kWorseInARow = 2;
constexpr double kTrialsShare = 0.95;  ///< Of the stage's time, for progress.

/// What one band gives.
struct Trial {
  VoteGrid votes;
  BitGrid inside;  ///< With its cavities filled, if asked for.
  VoteStatistics statistics;
  double surface_share = 0;  ///< Before cavities are filled.
  std::size_t cavity_voxels = 0;
};

bool is_automatic(const PseudoVolumeOptions& o) {
  return !o.k && !o.band && !o.band_voxels;
}

/// The band that was asked for, in voxels, before the floor; none is wider than the grid.
double asked_band_voxels(const DistanceField& field, const PseudoVolumeOptions& options) {
  const auto& [nx, ny, nz] = field.distance.frame.size;
  const double widest = 1.0 * nx + ny + nz;
  if (options.band_voxels) return std::min(*options.band_voxels, widest);
  if (options.band) return std::min(*options.band / field.distance.frame.voxel_size, widest);
  return (1 - *options.k) * field.d_max / field.distance.frame.voxel_size;
}

bool is_served(const DistanceField& field, double band_voxels) {
  return (band_voxels + kReachVoxels) * field.distance.frame.voxel_size <= field.band * (1 + 1e-12);
}

/// A band of d_max or more would make all of the box one event.
bool is_useful(const DistanceField& field, double band_voxels) {
  return band_voxels == kCandidates.front() || band_voxels * field.distance.frame.voxel_size < field.d_max;
}

/// Votes with one band after the other; what does not depend on the band is found once.
class Trials {
 public:
  Trials(const DistanceField& field, const PseudoVolumeOptions& options, const Evidence& evidence,
         const SoupMarks& marks, StageWatch& watch)
      : distance_(field.distance), options_(options), evidence_(evidence), marks_(marks), watch_(watch) {}

  /// Overwrites `trial`, and takes its memory. The watch's part is covered from `begin` to `end`.
  void run(double band_voxels, Trial& trial, double begin, double end) {
    watch_.enter_part(begin, begin + kEventsShare * (end - begin));
    begin += kEventsShare * (end - begin);
    find_events_for(band_voxels);
    const BandBits band = find_band(distance_, length(band_voxels), watch_);
    clear(trial.votes);
    if (trial.inside.words.empty()) trial.inside = make_bit_grid(distance_.frame);
    std::optional<ExactCrossings> exact;
    if (evidence_.planes != nullptr)
      exact = exact_for_band(*evidence_.planes, evidence_.rims->distance, distance_, band_voxels, watch_);
    cast_rays(band, *events_, exact ? &*exact : nullptr, options_.rays, trial.votes, watch_, begin, end);
    trial.statistics = count_votes(trial.votes, options_.rays, trial.inside, watch_);
    trial.surface_share = surface_share(trial.inside, marks_.touched, watch_);
    trial.cavity_voxels = 0;
    if (evidence_.solids != nullptr) add_bits(trial.inside, *evidence_.solids);
    if (options_.cavities == Cavities::Keep) return;
    trial.cavity_voxels = fill_cavities(trial.inside, marks_.sealed, watch_);
    if (band_voxels > kFloorVoxels)
      trial.cavity_voxels += fill_rooms(trial.inside, marks_.sealed, band.bits, band_voxels, watch_);
  }

 private:
  static constexpr double kEventsShare = 0.3;  ///< Of the time of a trial.

  float length(double voxels) const { return static_cast<float>(voxels * distance_.frame.voxel_size); }

  /// Events are found as far as the known distance is asked for, so that they serve several candidates.
  void find_events_for(double band_voxels) {
    const bool anywhere = options_.placement == Placement::Entry;
    if (events_ && (anywhere || events_->reach() >= length(band_voxels))) return;
    const auto* tier = std::lower_bound(kTiers.begin(), kTiers.end(), band_voxels);
    const double reach = is_automatic(options_) && tier != kTiers.end() ? *tier : band_voxels;
    events_.reset();
    events_.emplace(distance_, anywhere ? 0 : length(reach), watch_);
  }

  void clear(VoteGrid& votes) {
    if (votes.words.empty()) {
      votes.frame = distance_.frame;
      votes.words_per_row = distance_.blocks_per_row;
      votes.words.resize(votes.words_per_row * static_cast<std::size_t>(votes.frame.size[1]) *
                         static_cast<std::size_t>(votes.frame.size[2]));
      return;
    }
    constexpr std::int64_t kWordsAtOnce = 1 << 16;
    parallel_for(static_cast<std::int64_t>(votes.words.size()), kWordsAtOnce, watch_,
                 [&](std::int64_t first, std::int64_t last) {
                   std::fill(votes.words.begin() + first, votes.words.begin() + last, VoteWord{});
                 });
  }

  const BlockGrid& distance_;
  const PseudoVolumeOptions& options_;
  const Evidence& evidence_;
  const SoupMarks& marks_;
  StageWatch& watch_;
  std::optional<EventStore> events_;
};

/// Tries the candidates from narrow to wide and keeps the first of the best. The rule never looks at how far the field
/// is known: where that is not far enough to decide, the report asks for more.
void choose_band(const DistanceField& field, const Evidence& evidence, Trials& trials, StageWatch& watch,
                 PseudoVolumeReport& report, Trial& best) {
  double best_score = -1;
  std::size_t worse = 0;
  Trial trial;
  for (const double band : kCandidates) {
    if (!is_useful(field, band) || worse >= kWorseInARow) break;
    if (band > kCandidates.front() && band > evidence.widest_band_voxels) break;
    if (!is_served(field, band)) {
      report.wants_band_voxels = *std::lower_bound(kTiers.begin(), kTiers.end(), band) + kReachVoxels;
      break;
    }
    const double tried = static_cast<double>(report.candidates.size());
    const auto part = [&](double n) { return kTrialsShare * n / static_cast<double>(kCandidates.size()); };
    trials.run(band, trial, part(tried), part(tried + 1));
    const double score = score_solid(trial.surface_share, trial.inside, trial.statistics, watch);
    report.candidates.push_back({band, score, trial.statistics.consensus});
    ++worse;
    if (score > best_score * evidence.least_gain) {
      best_score = score;
      worse = 0;
      report.band_voxels = band;
      std::swap(best, trial);
    }
  }
}

}  // namespace

void check_options(const PseudoVolumeOptions& options) {
  if (int{options.k.has_value()} + int{options.band.has_value()} + int{options.band_voxels.has_value()} > 1)
    throw InvalidInput("give at most one of k, band_voxels and band");
  require(!options.k || (*options.k >= 0 && *options.k <= 1), "k", options.k.value_or(0), "0 to 1");
  const auto is_length = [](const std::optional<double>& v) { return !v || (*v > 0 && std::isfinite(*v)); };
  require(is_length(options.band), "band", options.band.value_or(0), "positive and finite");
  require(is_length(options.band_voxels), "band_voxels", options.band_voxels.value_or(0), "positive and finite");
  require(is_length(options.thickness), "thickness", options.thickness.value_or(0), "positive and finite");
  require(options.rays == 26 || options.rays == 13, "rays", options.rays, "26 or 13");
}

std::size_t count_voxels(const BitGrid& bits) {
  std::size_t count = 0;
  for (const std::uint64_t word : bits.words)
    if (word != 0) count += bit_count(word);
  return count;
}

void add_bits(BitGrid& to, const BitGrid& from) {
  for (std::size_t i = 0; i < to.words.size(); ++i) to.words[i] |= from.words[i];
}

double band_needed_voxels(const DistanceField& field, const PseudoVolumeOptions& options) {
  check_options(options);
  if (is_automatic(options)) return kTiers.front() + kReachVoxels;
  return std::max(asked_band_voxels(field, options), kFloorVoxels) + kReachVoxels;
}

PseudoVolume classify_volume(const DistanceField& field, const PseudoVolumeOptions& options, const Progress& progress) {
  return classify_volume(field, options, Evidence{}, progress);
}

PseudoVolume classify_volume(const DistanceField& field, const PseudoVolumeOptions& options, const Evidence& evidence,
                             const Progress& progress) {
  check_options(options);
  const GridFrame& frame = field.distance.frame;
  StageWatch watch(progress, "pseudo_volume");
  SoupMarks marks = mark_soup(field.distance, watch);
  Trials trials(field, options, evidence, marks, watch);

  PseudoVolume result;
  result.rays = options.rays;
  PseudoVolumeReport& report = result.report;
  Trial trial;
  if (is_automatic(options)) {
    report.automatic = true;
    choose_band(field, evidence, trials, watch, report, trial);
  } else {
    const double asked = asked_band_voxels(field, options);
    report.floored = asked < kFloorVoxels;
    report.band_voxels = std::max(asked, kFloorVoxels);
    if (!is_served(field, report.band_voxels))
      throw InvalidInput(
          "the distance field's band is too narrow for this k: widen_distance() to band_needed_voxels()");
    trials.run(report.band_voxels, trial, 0, kTrialsShare);
  }

  watch.enter_part(kTrialsShare, 1);
  report.cavity_voxels = trial.cavity_voxels;
  report.inside_voxels = count_voxels(trial.inside);
  report.soup_covered = covered_share(trial.inside, marks.touched, watch);
  if (evidence.solids != nullptr) add_bits(marks.sealed, *evidence.solids);  // their surface was not made up
  if (!report.wants_band_voxels)
    report.largest_closure = largest_closure_voxels(trial.inside, field.distance, marks, watch) * frame.voxel_size;
  report.band = report.band_voxels * frame.voxel_size;
  report.k = field.d_max > 0 ? std::max(0.0, 1 - report.band / field.d_max) : 0;
  report.volume = static_cast<double>(report.inside_voxels) * elementary::cube(frame.voxel_size);
  report.consensus = trial.statistics.consensus;
  result.inside = std::move(trial.inside);
  result.votes = std::move(trial.votes);
  return result;
}

}  // namespace tetsoup
