// How the tool explains itself: the layout of --help, and what it says about a command line it cannot take.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tetsoup::cli {

/// Puts what is required into the usage line and one blank line between groups.
class HelpLayout : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override;
};

/// One line on what is wrong with the command line, and where to look.
std::string describe_usage_error(const CLI::App& app, const CLI::ParseError& error);

/// "; see `tetsoup mesh --help`" for the command that was asked for.
std::string help_hint(const CLI::App& app);

}  // namespace tetsoup::cli
