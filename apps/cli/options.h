// The flags that commands share, in the groups in which --help lists them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tetsoup/error.h"
#include "tetsoup/pipeline.h"

namespace tetsoup::cli {

/// What concerns the run rather than the result.
struct RunOptions {
  std::optional<double> memory_gb;
  bool quiet = false;
};

/// A flag with a value: `read` gets the text behind it and throws InvalidInput if it makes no sense.
CLI::Option* add_flag(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::function<void(const std::string&)>& read, const std::string& description);

/// A flag whose value is one of a few words: "keep|drop".
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices, const std::string& description) {
  std::string names, words;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    names += (i == 0 ? "" : "|") + choices[i].first;
    words += (i == 0 ? "" : i + 1 < choices.size() ? ", " : " or ") + choices[i].first;
  }
  const auto read = [name, words, choices, &value](const std::string& text) {
    for (const auto& [word, meaning] : choices) {
      if (text != word) continue;
      value = meaning;
      return;
    }
    throw InvalidInput(name + " " + text + ": must be " + words);
  };
  return add_flag(app, name, names, read, description);
}

void add_grid_flags(CLI::App& app, DistanceOptions& options);
void add_volume_flags(CLI::App& app, PseudoVolumeOptions& options);
void add_join_flag(CLI::App& app, Join& join);
/// How many tets: as the options say, or searched for.
enum class TetCount { Given, Search };
void add_lattice_flags(CLI::App& app, LatticeOptions& options, TetCount& count);
void add_cover_flags(CLI::App& app, LatticeOptions& options);
void add_topology_flags(CLI::App& app, TopologyOptions& options);
void add_smooth_flags(CLI::App& app, SmoothOptions& options);
void add_threads_flag(CLI::App& app);
void add_quiet_flag(CLI::App& app, bool& quiet);
void add_run_flags(CLI::App& app, RunOptions& options);

/// Bytes the grids may take: what --memory says, else what the machine has left (memory.cpp); none if unknown.
std::optional<std::size_t> memory_limit(const RunOptions& options);

}  // namespace tetsoup::cli
