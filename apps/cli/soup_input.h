// What mesh and field do first: read the soup, clean it, and refuse it if nothing is left.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>

#include "progress_bar.h"
#include "tetsoup/pipeline.h"

namespace tetsoup::cli {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Adds --point-size.
void add_point_flag(CLI::App& app, std::optional<double>& size);

/// @param read_seconds  Set to the time that reading took.
/// @throws CannotMesh   if no finite triangle is in the file.
Pipeline open_pipeline(const std::filesystem::path& input, std::optional<double> point_size, ProgressBar& bar,
                       double& read_seconds);

/// The same for a soup that was read from there.
Pipeline open_pipeline(const std::filesystem::path& input, const TriangleSoup& soup, ProgressBar& bar);

}  // namespace tetsoup::cli
