#include "tetsoup/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  TriangleSoup (*make)(std::uint64_t seed);
};

constexpr std::array<Sample, 6> kSamples{{
    {"torus", "closed torus of 640 triangles, extents 150 : 150 : 37",
     [](std::uint64_t) { return samples::make_torus(); }},
    {"heart", "closed heart with a deep notch, 4,800 triangles", [](std::uint64_t) { return samples::make_heart(); }},
    {"sphere", "closed sphere of 2,700 triangles; damage it to see holes filled",
     [](std::uint64_t) { return samples::make_sphere(); }},
    {"robot", "waving robot of about 16,000 triangles, closed parts pushed into each other",
     [](std::uint64_t) { return samples::make_robot(); }},
    {"tree", "tree of 8,000 loose triangles, no two connected", samples::make_tree},
    {"palm", "palm of loose bark and leaflets, no two triangles connected", samples::make_palm},
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
  const TriangleSoup soup = sample.make(options.seed);
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
