// tetsoup, the command-line tool.
//
// Exit codes, which scripts may rely on:
//   0    done (also for soups of any ugliness: what was assumed is said in the summary)
//   1    internal error, or out of memory
//   2    wrong usage or an option out of range
//   3    a file cannot be read, parsed or written
//   4    the file holds no finite triangle: nothing can be meshed
//   130  cancelled by Ctrl-C (SIGINT) or SIGTERM; no file is left, but for the folder of a simulation, which can go on
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <new>
#include <sstream>
#include <string>

#include "commands.h"
#include "files.h"
#include "help.h"
#include "interrupt.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

constexpr int kExitInternal = 1;
constexpr int kExitUsage = 2;
constexpr int kExitFile = 3;
constexpr int kExitCannotMesh = 4;

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup sample torus -o torus.obj            write a shape to try\n"
    "  tetsoup mesh torus.obj -o torus.msh          mesh it: about 2,000 tets, everything chosen for you\n"
    "  tetsoup inspect torus.msh                    see how good the tets are\n"
    "  tetsoup mesh --help                          all that can be chosen\n"
    "  tetsoup simulate drop                        let a soft robot fall\n"
    "  tetsoup studio                               all of it by hand, in the browser\n"
    "\n"
    "Exit codes: 0 done, 1 internal error or out of memory, 2 wrong usage or option, 3 a file cannot be read or\n"
    "written, 4 nothing in the file can be meshed, 130 cancelled.";

constexpr const char* kShortHelp =
    "tetsoup " TETSOUP_VERSION
    ": any triangle soup in, a tet mesh out.\n"
    "\n"
    "Start with:  tetsoup mesh IN.obj -o OUT.msh\n"
    "\n"
    "No model at hand? `tetsoup sample` lists shapes to try. All commands: tetsoup --help\n";

/// One line, whatever is in it: a file's name may hold line breaks and terminal codes.
int fail(int code, std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  fmt::print(stderr, "tetsoup: error: {}\n", text);
  return code;
}

/// What is asked for and cannot be written is an error, as it is for reports.
int show(const std::string& text, int code = 0) {
  try {
    write_stdout(text);
    return code;
  } catch (const IoError& error) {
    return fail(kExitFile, error.what());
  }
}

int parse_and_run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help_or_version) {
    std::ostringstream text, unused;
    const int code = app.exit(help_or_version, text, unused);
    return show(text.str(), code);
  } catch (const CLI::ParseError& error) {
    return fail(kExitUsage, describe_usage_error(app, error));
  } catch (const InvalidInput& error) {
    return fail(kExitUsage, error.what() + help_hint(app));
  } catch (const IoError& error) {
    return fail(kExitFile, error.what());
  } catch (const CannotMesh& error) {
    return fail(kExitCannotMesh, error.what());
  } catch (const CancelledMidway& stop) {
    return fail(kExitCancelled, stop.what());
  } catch (const Cancelled&) {
    return fail(kExitCancelled, "cancelled; no file was written");
  }
}

int run(int argc, char** argv) {
  CLI::App app("tetsoup: any triangle soup in, a coarse well-shaped tet mesh out.", "tetsoup");
  app.set_version_flag("--version", "tetsoup " TETSOUP_VERSION, "Print the version and exit");
  app.require_subcommand(0, 1);
  const auto layout = std::make_shared<HelpLayout>();
  layout->column_width(30);
  app.formatter(layout);
  app.footer(kExamples);
  app.set_help_flag("-h,--help", "Print this help and exit");
  add_mesh_command(app);
  add_inspect_command(app);
  add_calibrate_command(app);
  add_field_command(app);
  add_sample_command(app);
  add_simulate_command(app);
  add_studio_command(app);
  if (argc <= 1) {
    return show(kShortHelp);
  }
  catch_interrupts();
  return parse_and_run(app, argc, argv);
}

}  // namespace

}  // namespace tetsoup::cli

int main(int argc, char** argv) {
  try {
    return tetsoup::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return tetsoup::cli::fail(
        tetsoup::cli::kExitInternal,
        "out of memory; take fewer voxels (--voxels), or set a limit (--memory GB) to be told how many fit");
  } catch (const std::exception& error) {
    return tetsoup::cli::fail(
        tetsoup::cli::kExitInternal,
        fmt::format("internal: {}; this is a bug, please report it with the input", error.what()));
  }
}
