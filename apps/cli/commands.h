// The commands, one file each, and the outcomes that main() turns into exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace tetsoup::cli {

/// The file is fine but holds nothing that could be meshed.
struct CannotMesh : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Stopped by the user, with something left to go on from; the text says what.
struct CancelledMidway : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Each adds its command with flags and help; the work is done when the command line has been read as a whole.
void add_mesh_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_calibrate_command(CLI::App& app);
void add_field_command(CLI::App& app);
void add_sample_command(CLI::App& app);
void add_simulate_command(CLI::App& app);
void add_studio_command(CLI::App& app);

}  // namespace tetsoup::cli
