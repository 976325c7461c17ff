// Is the mesh ready for simulation? The checks, in plain words and as JSON, and the flags for the material.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tetsoup/readiness.h"

namespace tetsoup::cli {

void add_material_flags(CLI::App& app, Material& material);

/// One line a check, then mass and time step.
std::string describe_readiness(const Readiness& readiness, const Material& material);

nlohmann::ordered_json readiness_json(const Readiness& readiness, const Material& material);

}  // namespace tetsoup::cli
