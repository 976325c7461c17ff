#include "tetsoup/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "base/listing.h"
#include "base/require.h"
#include "samples/formula.h"
#include "samples/shapes.h"

namespace tetsoup {

namespace {

struct Sample {
  std::string_view name;
  std::string_view summary;
  TriangleSoup (*make)(const SampleOptions& options);
  double wall = 0, most = 0;  ///< Where it has walls: their thickness, and the largest.
};

constexpr std::array<Sample, 11> kSamples{{
    {"torus", "closed torus of 640 triangles, extents 150 : 150 : 37",
     [](const SampleOptions&) { return samples::make_torus(); }},
    {"heart", "closed heart with a deep notch, 4,800 triangles",
     [](const SampleOptions&) { return samples::make_heart(); }},
    {"sphere", "closed sphere of 2,700 triangles; damage it to see holes filled",
     [](const SampleOptions&) { return samples::make_sphere(); }},
    {"robot", "waving robot of about 16,000 triangles, closed parts pushed into each other",
     [](const SampleOptions&) { return samples::make_robot(); }},
    {"tree", "tree of 8,000 loose triangles, no two connected",
     [](const SampleOptions& o) { return samples::make_tree(o.seed); }},
    {"palm", "palm of loose bark and leaflets, no two triangles connected",
     [](const SampleOptions& o) { return samples::make_palm(o.seed); }},
    {"cup", "closed surface of an open cup, 1 high; --wall is that of side and floor",
     [](const SampleOptions& o) { return samples::make_cup(*o.wall); }, 0.02, 0.4},
    {"pipe", "pipe open at both ends, 1 long and 0.5 thick; --wall is that of its side",
     [](const SampleOptions& o) { return samples::make_pipe(*o.wall); }, 0.02, 0.2},
    {"tray", "open box of 28 triangles, 1 x 0.7 x 0.25; --wall is that of sides and floor",
     [](const SampleOptions& o) { return samples::make_tray(*o.wall); }, 0.02, 0.2},
    {"comb", "spine with eight teeth, 1 long; --wall is a tooth's thickness",
     [](const SampleOptions& o) { return samples::make_comb(*o.wall); }, 0.06, 0.12},
    {"chain", "eight links that hang in each other and do not touch, each 1 long; --wall is the wire's thickness",
     [](const SampleOptions& o) { return samples::make_chain(*o.wall); }, 0.15, 0.2},
}};

const Sample& find_sample(std::string_view name) {
  const auto found = std::find_if(kSamples.begin(), kSamples.end(), [&](const Sample& s) { return s.name == name; });
  if (found != kSamples.end()) return *found;
  throw InvalidInput("sample = " + std::string(name) + ", must be one of " + listing(sample_names()));
}

}  // namespace

std::vector<std::string> sample_names() {
  std::vector<std::string> names;
  for (const Sample& sample : kSamples) names.emplace_back(sample.name);
  return names;
}

std::string sample_summary(std::string_view name) {
  return std::string(find_sample(name).summary);
}

TriangleSoup make_sample(std::string_view name, const SampleOptions& options) {
  const Sample& sample = find_sample(name);
  require(options.damage >= 0 && options.damage < 1, "damage", options.damage, "in [0, 1)");
  SampleOptions chosen = options;
  if (options.wall && sample.most == 0) throw InvalidInput("wall: the sample " + std::string(name) + " has none");
  chosen.wall = options.wall.value_or(sample.wall);
  if (sample.most > 0) {
    constexpr double kThinnest = 1e-4;
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g for the sample %s", kThinnest, sample.most, sample.name.data());
    require(*chosen.wall >= kThinnest && *chosen.wall <= sample.most, "wall", *chosen.wall, range);
  }
  const TriangleSoup soup = sample.make(chosen);
  return options.damage > 0 ? remove_triangles(soup, options.damage, options.seed) : soup;
}

TriangleSoup remove_triangles(const TriangleSoup& soup, double share, std::uint64_t seed) {
  require(share >= 0 && share < 1, "share", share, "in [0, 1)");
  const std::size_t count = soup.triangles.size();
  const auto removed = static_cast<std::size_t>(std::llround(share * static_cast<double>(count)));
  // The first `removed` places of a shuffle that is stopped there [Fisher-Yates].
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  samples::Random random(seed);
  std::vector<bool> gone(count);
  for (std::size_t i = 0; i < removed; ++i) {
    std::swap(order[i], order[i + random.below(count - i)]);
    gone[order[i]] = true;
  }
  TriangleSoup rest{soup.vertices, {}};
  for (std::size_t i = 0; i < count; ++i)
    if (!gone[i]) rest.triangles.push_back(soup.triangles[i]);
  return rest;
}

}  // namespace tetsoup
