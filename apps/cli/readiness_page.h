// Is the mesh ready for simulation? The checks, in plain words, and the flags for the material.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tetsoup/readiness.h"

namespace tetsoup::cli {

/// What --help lists the material's flags under.
inline constexpr const char* kMaterialGroup =
    "Material (for mass and time step in the report, and for files that name one)";

void add_material_flags(CLI::App& app, Material& material);

/// One line a check, then mass and time step.
std::string describe_readiness(const Readiness& readiness, const Material& material);

}  // namespace tetsoup::cli
