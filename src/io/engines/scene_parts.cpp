#include "io/engines/scene_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/elementary.h"
#include "base/tet_geometry.h"
#include "io/line_writer.h"
#include "io/model_parts.h"
#include "io/number_text.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"

namespace tetsoup {

namespace {

constexpr double kGravity = 9.81;  // m/s^2
// Young's modulus over the pressure that a column as high as the body has at its foot: it is shortened by half a
// percent. What stands on thin legs needs that much. 1e5 Pa is that stiffness for a body of 0.1 m.
constexpr double kStiffness = 100;
constexpr double kDropShare = 0.05;  // Of the height, between body and plane,
constexpr double kMostDrop = 0.5;    // and at most so many metres, which take a third of a second.

constexpr std::string_view kScriptEnd = R"(

if __name__ == "__main__":
    _, ends, velocities = simulate(view="--view" in sys.argv)
    speed = numpy.sqrt((velocities**2).sum(axis=1).mean())
    print(f"at the end: lowest point {ends[:, 2].min():.4f} m, speed {speed:.4f} m/s")
)";

struct Extent {
  std::array<double, 3> low, high;
};

// In the scene's axes.
std::array<double, 3> upright(const Vec3d& v, UpAxis up) {
  if (up == UpAxis::Y) return {v.x, -v.z, v.y};
  if (up == UpAxis::X) return {-v.z, v.y, v.x};
  return {v.x, v.y, v.z};
}

Extent extent_of(const TetModel& model) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Extent e{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Vec3& v : model.mesh.vertices) {
    const auto p = upright(placed(v, model.mesh.origin), model.up);
    for (std::size_t i = 0; i < 3; ++i) {
      e.low[i] = std::min(e.low[i], p[i]);
      e.high[i] = std::max(e.high[i], p[i]);
    }
  }
  if (model.mesh.vertices.empty()) e = {{0, 0, 0}, {1, 1, 1}};
  return e;
}

// Means by volume, for engines with one material a body.
struct Means {
  double volume = 0, mass = 0, young = 0, poisson = 0;
};

Means means_of(const TetModel& model) {
  Means sum;
  for (std::uint32_t i = 0; i < model.mesh.tets.size(); ++i) {
    const Material& material = model.regions[region_of(model, i)].material;
    const double volume = signed_volume(corners_of(model.mesh, model.mesh.tets[i]));
    sum.volume += volume;
    sum.mass += volume * density_scale_of(model, i) * material.density;
    sum.young += volume * material.young;
    sum.poisson += volume * material.poisson;
  }
  if (!(sum.volume > 0)) {
    const Material& material = model.regions.front().material;
    return {1, material.density, material.young, material.poisson};
  }
  sum.young /= sum.volume;
  sum.poisson /= sum.volume;
  return sum;
}

}  // namespace

Drop plan_drop(const SceneInput& input, const StepLimit& limit) {
  const TetModel& model = input.model;
  const Extent e = extent_of(model);
  const Means means = means_of(model);
  Drop drop;
  drop.name = LegalNames().make(model.name, "body");
  drop.height = e.high[2] - e.low[2];
  drop.x = -(e.low[0] + e.high[0]) / 2;
  drop.y = -(e.low[1] + e.high[1]) / 2;
  drop.lift = -e.low[2] + std::min(kDropShare * drop.height, kMostDrop);
  drop.mass = means.mass;
  drop.density = means.mass / means.volume;
  drop.poisson = means.poisson;
  drop.time_step = limit.default_step;
  drop.edge = elementary::cbrt(6 * std::sqrt(2.0) * means.volume / std::max<double>(1, double(model.mesh.tets.size())));
  const double weight = drop.density * kGravity * drop.height;
  drop.young = input.material_is_default ? kStiffness * weight : means.young;
  drop.stiffness_why =
      input.material_is_default ? "100 times the pressure of its own weight, so that it hardly sags" : "as asked for";
  const bool one_factor = model.stiffness_factor != 1 && model.stiffness_scale.empty();
  if (one_factor && input.material_is_default) drop.young *= model.stiffness_factor;
  const Material material{drop.density, drop.young, drop.poisson, 1};
  const double explicit_step = assess_readiness(model.mesh, measure_quality(model.mesh), material).stable_time_step;
  const double bearable = limit.bearable * explicit_step;
  if (bearable > 0 && bearable < limit.default_step) {
    if (input.material_is_default) {
      drop.young *= elementary::square(bearable / limit.default_step);  // The bound goes with 1 / sqrt(young).
      drop.stiffness_why = "the stiffest that this time step bears with these tets";
    } else {
      drop.time_step = 1 / std::ceil(1 / bearable);
      drop.stiffness_why += "; it needs a shorter time step than the engine's default";
    }
  }
  drop.stiffening = drop.young / means.young;
  if (one_factor)
    drop.stiffness_why += "; calibrated: " + brief(model.stiffness_factor) +
                          " times that of the body they stand for, " + brief(drop.young / model.stiffness_factor) +
                          " Pa, since so few tets are too stiff";
  else if (!model.stiffness_scale.empty())
    drop.stiffness_why += "; calibrated: times a factor for every tet, so that they move as many would";
  return drop;
}

std::pair<double, double> lame(const Drop& drop) {
  const double shear = drop.young / (2 * (1 + drop.poisson));
  return {2 * shear * drop.poisson / (1 - 2 * drop.poisson), shear};
}

std::string upright_wxyz(UpAxis up, std::string_view between) {
  constexpr std::string_view kHalf = "0.70710678";
  const std::string gap(between), half(kHalf);
  if (up == UpAxis::Y) return half + gap + half + gap + "0" + gap + "0";
  if (up == UpAxis::X) return half + gap + "0" + gap + "-" + half + gap + "0";
  return "1" + gap + "0" + gap + "0" + gap + "0";
}

std::string upright_xyzw(UpAxis up, std::string_view between) {
  const std::string text = upright_wxyz(up, between);
  const std::size_t first = text.find(between);
  return text.substr(first + between.size()) + std::string(between) + text.substr(0, first);
}

namespace {

/// With all digits where the body lies far from zero for its size, so that it comes to rest where it should.
std::string shift_text(double shift, const Drop& drop) {
  constexpr double kFar = 16;
  if (std::abs(shift) <= kFar * drop.height) return brief(shift);
  std::string text;
  append_number(text, shift);
  return text;
}

}  // namespace

Gaps gaps_of(const Drop& drop, Gaps more) {
  more.insert(more.end(), {{"name", drop.name},
                           {"why", drop.stiffness_why},
                           {"height", brief(drop.height)},
                           {"mass", brief(drop.mass)},
                           {"density", brief(drop.density)},
                           {"young", brief(drop.young)},
                           {"poisson", brief(drop.poisson)},
                           {"x", shift_text(drop.x, drop)},
                           {"y", shift_text(drop.y, drop)},
                           {"lift", shift_text(drop.lift, drop)}});
  return more;
}

std::string filled(std::string_view text, const Gaps& gaps) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('@');
    result += text.substr(0, begin);
    if (begin == text.npos) return result;
    const std::size_t end = text.find('@', begin + 1);
    const std::string_view name = text.substr(begin + 1, end == text.npos ? end : end - begin - 1);
    const auto gap = std::find_if(gaps.begin(), gaps.end(), [&](const auto& g) { return g.first == name; });
    if (gap == gaps.end()) {  // A lone @ of the language itself.
      result += '@';
      text.remove_prefix(begin + 1);
    } else {
      result += gap->second;
      text.remove_prefix(end + 1);
    }
  }
}

std::string filled_script(std::string_view text, const Gaps& gaps) {
  return filled(std::string(text) + std::string(kScriptEnd), gaps);
}

std::string brief(double value) {
  constexpr int kDigits = 4;
  std::string text;
  append_digits(text, value, kDigits);
  return text;
}

std::string quoted_python(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result + '"';
}

Unions pieces_of(const TetMesh& mesh) {
  Unions pieces(mesh.vertices.size());
  for (const Tet& t : mesh.tets)
    for (std::size_t i = 1; i < 4; ++i) pieces.join(t[0], t[i]);
  return pieces;
}

std::string pin_list(const TetModel& model, std::uint32_t base, std::string_view between) {
  constexpr std::size_t kPerLine = 16;
  const std::vector<std::uint32_t> pins = pinned_vertices(model);
  if (pins.empty()) return {};
  std::string text;
  append_list(text, std::span(pins), base, kPerLine, between);
  text.pop_back();
  return text;
}

}  // namespace tetsoup
