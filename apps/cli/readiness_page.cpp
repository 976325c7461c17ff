#include "readiness_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"
#include "options.h"

namespace tetsoup::cli {

namespace {

constexpr Range kPoisson{
    .low = 0, .high = 0.5, .high_included = false, .words = "a number of at least 0 and below 0.5"};

}  // namespace

void add_material_flags(CLI::App& app, Material& material) {
  const auto add = [&](const char* flag, const char* value, double& target, const Range& range, const char* text) {
    add_flag(
        app, flag, value,
        [flag, &target, range](const std::string& given) { target = parse_number(flag, given, range); }, text)
        ->group(kMaterialGroup);
  };
  add("--density", "KG/M3", material.density, kPositive, "Density (1000)");
  add("--young", "PA", material.young, kPositive, "Young's modulus (1e5, a soft rubber)");
  add("--poisson", "X", material.poisson, kPoisson, "Poisson ratio, 0 to below 0.5 (0.4)");
  add("--metres-per-unit", "M", material.metres_per_unit, kPositive,
      "The model's unit in metres; 0.001: millimetres (1)");
}

std::string describe_readiness(const Readiness& readiness, const Material& material) {
  const auto failed = std::count_if(readiness.checks.begin(), readiness.checks.end(),
                                    [](const ReadinessCheck& check) { return !check.passed; });
  std::string text = failed == 0 ? std::string("Ready for simulation:\n")
                                 : fmt::format("Ready for simulation, with {} of {} checks to look at:\n", failed,
                                               readiness.checks.size());
  for (const ReadinessCheck& check : readiness.checks) {
    text += fmt::format("  {:<5} {:<52} {:>8.4g}  ({} {:.4g})\n", check.passed ? "ok" : "look", check.title,
                        check.value, check.at_least ? "at least" : "at most", check.limit);
    if (!check.passed) text += fmt::format("        What helps: {}.\n", check.advice);
  }
  return text +
         fmt::format(
             "  With {:.4g} kg/m^3, Young's modulus {:.4g} Pa, Poisson ratio {:.4g} and a unit of {:.4g} m: mass "
             "{:.4g} kg; explicit time steps up to {:.3g} s are stable.\n",
             material.density, material.young, material.poisson, material.metres_per_unit, readiness.mass,
             readiness.stable_time_step);
}

}  // namespace tetsoup::cli
