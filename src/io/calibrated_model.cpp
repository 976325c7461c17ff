#include "io/calibrated_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/elementary.h"
#include "base/tet_geometry.h"
#include "io/model_parts.h"

namespace tetsoup {

namespace {

constexpr std::size_t kSteps = 8;  ///< Materials a region; a deck stays readable.
constexpr int kMostRounds = 100;   ///< Of moving the steps; they stand still after some twenty.

using Levels = std::array<double, kSteps>;

std::size_t nearest(const Levels& levels, double value) {
  const auto above = std::lower_bound(levels.begin(), levels.end(), value);
  if (above == levels.begin()) return 0;
  if (above == levels.end()) return kSteps - 1;
  const auto i = static_cast<std::size_t>(above - levels.begin());
  return value - levels[i - 1] <= levels[i] - value ? i - 1 : i;
}

/// What a step or a region holds: sums by volume.
struct Sums {
  double volume = 0, mass = 0, log_stiffness = 0;
};

double volume_of(const TetModel& model, std::size_t t) {
  return std::max(0.0, signed_volume(corners_of(model.mesh, model.mesh.tets[t])));
}

/// The step of every tet. Begun evenly over the range of the logarithms, each step is moved to the mean of its tets
/// until none changes [Lloyd82]: where most tets are they lie close, and the few that are far off cost one or two. Even
/// ones are 2.1 times apart where moduli are 400 times apart, as they may be; these halve the error on real bodies.
std::vector<std::size_t> steps_of(const TetModel& model) {
  std::vector<double> logs, volumes;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    logs.push_back(elementary::log(model.stiffness_scale[t]));
    volumes.push_back(volume_of(model, t));
  }
  const auto [least, most] = std::minmax_element(logs.begin(), logs.end());
  Levels levels;
  for (std::size_t s = 0; s < kSteps; ++s)
    levels[s] = *least + (*most - *least) * (static_cast<double>(s) + 0.5) / kSteps;
  std::vector<std::size_t> steps(logs.size(), kSteps);
  for (int round = 0; round < kMostRounds; ++round) {
    bool changed = false;
    Levels sums{}, weights{};
    for (std::size_t t = 0; t < logs.size(); ++t) {
      const std::size_t step = nearest(levels, logs[t]);
      changed |= step != steps[t];
      steps[t] = step;
      sums[step] += volumes[t] * logs[t];
      weights[step] += volumes[t];
    }
    if (!changed) break;
    for (std::size_t s = 0; s < kSteps; ++s)
      if (weights[s] > 0) levels[s] = sums[s] / weights[s];
  }
  return steps;
}

std::vector<Sums> sums_of(const TetModel& model, const std::vector<std::size_t>& groups, std::size_t count) {
  std::vector<Sums> sums(count);
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const double volume = volume_of(model, t);
    Sums& sum = sums[groups[t]];
    sum.volume += volume;
    sum.mass += volume * density_scale_of(model, t);
    sum.log_stiffness += volume * elementary::log(stiffness_scale_of(model, t));
  }
  return sums;
}

void clear_scales(TetModel& model) {
  model.stiffness_scale.clear();
  model.density_scale.clear();
}

}  // namespace

TetModel in_stiffness_steps(const TetModel& model) {
  TetModel stepped = model;
  if (model.stiffness_scale.empty()) return stepped;
  std::vector<std::size_t> groups = steps_of(model);
  for (std::size_t t = 0; t < groups.size(); ++t) groups[t] += region_of(model, t) * kSteps;
  const std::vector<Sums> sums = sums_of(model, groups, model.regions.size() * kSteps);
  stepped.regions.clear();
  std::vector<std::uint32_t> numbers(sums.size(), 0);
  for (std::size_t g = 0; g < sums.size(); ++g) {
    if (!(sums[g].volume > 0)) continue;
    Region region = model.regions[g / kSteps];
    region.name = (region.name.empty() ? "region" : region.name) + "_" + std::to_string(g % kSteps + 1);
    // The mean of the logarithms: an eigenvalue goes, to first order, with the mean of those.
    region.material.young *= elementary::exp(sums[g].log_stiffness / sums[g].volume);
    region.material.density *= sums[g].mass / sums[g].volume;
    numbers[g] = static_cast<std::uint32_t>(stepped.regions.size());
    stepped.regions.push_back(region);
  }
  stepped.tet_regions.clear();
  for (const std::size_t group : groups) stepped.tet_regions.push_back(numbers[group]);
  if (stepped.regions.empty()) stepped.regions = model.regions;
  clear_scales(stepped);
  return stepped;
}

TetModel with_one_factor(const TetModel& model) {
  TetModel single = model;
  if (model.stiffness_scale.empty()) return single;
  std::vector<std::size_t> groups;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) groups.push_back(region_of(model, t));
  const std::vector<Sums> sums = sums_of(model, groups, model.regions.size());
  for (std::size_t r = 0; r < sums.size(); ++r) {
    single.regions[r].material.young *= model.stiffness_factor;
    if (sums[r].volume > 0) single.regions[r].material.density *= sums[r].mass / sums[r].volume;
  }
  clear_scales(single);
  return single;
}

TetModel calibrated_as(CalibrationForm form, const TetModel& model) {
  if (form == CalibrationForm::Steps) return in_stiffness_steps(model);
  return form == CalibrationForm::OneFactor ? with_one_factor(model) : model;
}

CalibrationForm calibration_of(TetFormat format) {
  switch (format) {
    case TetFormat::Npz:
    case TetFormat::Json:
    case TetFormat::Vtk:
    case TetFormat::Vtu:
      return CalibrationForm::PerTet;
    case TetFormat::Abaqus:
    case TetFormat::Vega:
      return CalibrationForm::Steps;
    case TetFormat::Usd:
      return CalibrationForm::OneFactor;
    default:
      return CalibrationForm::None;
  }
}

}  // namespace tetsoup
