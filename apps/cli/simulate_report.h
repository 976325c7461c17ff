// What a simulation was, for people and for scripts.
#pragma once

#include <string>

#include "simulate_run.h"

namespace tetsoup::cli {

std::string describe_simulation(const SimulateRun& run, const LoadedScene& loaded);

/// Member names are a promise.
std::string simulation_json(const SimulateRun& run, const LoadedScene& loaded);

}  // namespace tetsoup::cli
