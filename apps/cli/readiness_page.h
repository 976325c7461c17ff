// Is the mesh ready for simulation? The checks, in plain words, and the flags for the material.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tetsoup/readiness.h"

namespace tetsoup::cli {

void add_material_flags(CLI::App& app, Material& material);

/// One line a check, then mass and time step.
std::string describe_readiness(const Readiness& readiness, const Material& material);

}  // namespace tetsoup::cli
