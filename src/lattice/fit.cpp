#include "lattice/fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"

namespace tetsoup {
namespace {

constexpr double kPointsPerTet = 20;
constexpr double kLeastPoints = 16000, kMostPoints = 100000;
constexpr double kMostLookups = 3e7;  ///< Points times guesses, some 0.2 s of one core.
constexpr int kRotations = 24;        ///< Tried besides the given and the principal one,
constexpr int kShifts = 8;            ///< each with so many shifts.
constexpr int kGuessesPerClimb = 70;
/// Relative; what the count may miss the wanted one by at no cost.
constexpr double kFreeMiss = 0.02;

struct Found {
  Place place;
  double cost = 1e300;
};

/// Points that fill the unit cube evenly: multiples of powers of the root of x^4 = x + 1, modulo one.
Vec3d even_point(int i) {
  constexpr double kRoot = 1.2207440846057596;
  const auto part = [&](double step) {
    const double v = 0.5 + step * i;
    return v - std::floor(v);
  };
  return {part(1 / kRoot), part(1 / (kRoot * kRoot)), part(1 / (kRoot * kRoot * kRoot))};
}

/// Angles about x, y and z; a cube looks the same after a quarter turn.
Vec3d even_rotation(int i) {
  const Vec3d p = even_point(i);
  const auto turn = [](double part) { return (part - 0.5) * std::numbers::pi / 2; };
  return {turn(p.x), turn(p.y), turn(p.z)};
}

class Climber {
 public:
  Climber(const FitSearch& search, const FitPoints& points, StageWatch& watch)
      : search_(search), points_(points), watch_(watch) {}

  std::vector<Found> judge(const std::vector<Place>& places) const {
    std::vector<Found> found(places.size());
    parallel_for(static_cast<std::int64_t>(places.size()), 1, watch_, [&](std::int64_t begin, std::int64_t) {
      const auto i = static_cast<std::size_t>(begin);
      found[i] = {places[i], cost(places[i])};
    });
    return found;
  }

  /// From each place to a better one beside it as long as there is one, by ever smaller steps; all side by side.
  void climb(std::vector<Found>& found, int rounds) const {
    std::vector<double> step(found.size(), 1);
    for (int round = 0; round < rounds; ++round) {
      std::vector<Place> places;
      for (std::size_t i = 0; i < found.size(); ++i)
        for (int way = 0; way < kWays; ++way) places.push_back(moved(found[i].place, way, step[i]));
      const std::vector<Found> next = judge(places);
      for (std::size_t i = 0; i < found.size(); ++i) {
        const auto begin = next.begin() + static_cast<std::ptrdiff_t>(i * kWays);
        const auto best = std::min_element(begin, begin + kWays, cheaper);
        if (best->cost < found[i].cost) {
          found[i] = *best;
        } else {
          step[i] *= 0.5;
        }
      }
    }
  }

  static bool cheaper(const Found& a, const Found& b) { return a.cost < b.cost; }
  static constexpr int kWays = 14;  ///< Seven numbers, up and down.

 private:
  /// The part of the union that is not shared, at the wanted count: it goes as the edge, and that as count^(-1/3).
  double cost(const Place& place) const {
    const Guess guess = points_.guess(place);
    if (search_.edge == FitSearch::Edge::Given) return 1 - guess.overlap;
    if (guess.tets == 0) return 1e300;
    const double ratio = guess.tets / search_.tets;
    return (1 - guess.overlap) * elementary::cbrt(ratio) + std::max(0.0, std::abs(ratio - 1) - kFreeMiss);
  }

  Place moved(Place place, int way, double step) const {
    constexpr double kShift = 0.2, kTurn = 0.12, kScale = 0.02;  // cells, radians, relative
    const double by = way % 2 == 0 ? step : -step;
    const std::array<double*, 6> numbers{&place.centre_cell.x, &place.centre_cell.y, &place.centre_cell.z,
                                         &place.rotate.x,      &place.rotate.y,      &place.rotate.z};
    const int which = way / 2;
    if (which < 3) {
      *numbers[static_cast<std::size_t>(which)] += kShift * by;
    } else if (which < 6) {
      *numbers[static_cast<std::size_t>(which)] += kTurn * by;
    } else if (search_.edge == FitSearch::Edge::Searched) {
      place.cell_size *= 1 + kScale * by;
    }
    return place;
  }

  const FitSearch& search_;
  const FitPoints& points_;
  StageWatch& watch_;
};

std::vector<Place> first_places(const Place& start, const FitPoints& points) {
  std::vector<Vec3d> rotations{start.rotate, points.principal_rotation()};
  for (int i = 0; i < kRotations; ++i) rotations.push_back(even_rotation(i));
  std::vector<Place> places{start};
  for (const Vec3d& rotate : rotations)
    for (int i = 0; i < kShifts; ++i) {
      const auto n = static_cast<int>(places.size());
      places.push_back({start.cell_size, rotate, start.centre_cell + even_point(n), start.stretch});
    }
  return places;
}

}  // namespace

std::vector<Place> search_fit(const FitSearch& search, const Place& start, std::size_t most, StageWatch& watch) {
  const double wanted = std::clamp(kPointsPerTet * search.tets, kLeastPoints, kMostPoints);
  const FitPoints points(search.inside, static_cast<std::size_t>(wanted), search.table, search.rho_min);
  if (points.count() == 0) return {start};
  const Climber climber(search, points, watch);
  std::vector<Found> found = climber.judge(first_places(start, points));
  std::stable_sort(found.begin() + 1, found.end(), Climber::cheaper);
  const double guesses = kMostLookups / static_cast<double>(points.count()) - static_cast<double>(found.size());
  const auto climbs = static_cast<std::size_t>(std::clamp(guesses / kGuessesPerClimb, 2.0, 32.0));
  found.resize(std::min(climbs, found.size()));
  climber.climb(found, kGuessesPerClimb / Climber::kWays);
  std::stable_sort(found.begin(), found.end(), Climber::cheaper);
  std::vector<Place> best;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i) best.push_back(found[i].place);
  return best;
}

}  // namespace tetsoup
