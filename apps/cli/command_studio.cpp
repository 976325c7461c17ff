// tetsoup studio: the page in which meshes are shaped by hand, served to this machine's browser.
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "files.h"
#include "options.h"
#include "studio_server.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

namespace fs = std::filesystem;

struct StudioCommand {
  std::string input;
  std::optional<std::string> page;
  std::optional<int> port;
  bool open = false;
};

constexpr Range kPort{.low = 1, .high = 65535, .words = "a port, 1 to 65535"};

constexpr const char* kExamples =
    "Examples:\n"
    "  tetsoup studio                       prints an address; open it in a browser\n"
    "  tetsoup studio bunny.ply             with a model to begin with\n"
    "  tetsoup studio bunny.ply --open      and opens it\n"
    "  tetsoup studio --port 8080           where it was last time\n"
    "\n"
    "Nothing leaves this machine: the work is done in the page, and the address is good here only. Ctrl-C ends it.";

/// Beside the tool as installed, or in the tree it was built in.
fs::path find_page() {
  std::error_code error;
  const fs::path tool = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"../share/tetsoup/studio", "../../../studio/dist"}) {
    const fs::path page = (tool / place).lexically_normal();
    if (!error && fs::is_regular_file(page / "index.html", error)) return page;
    error.clear();
  }
  throw IoError(
      "the studio's page is not there; build it with scripts/studio in tetsoup's sources, then install again");
}

fs::path page_of(const StudioCommand& command) {
  if (!command.page) return find_page();
  std::error_code error;
  if (!fs::is_regular_file(fs::path(*command.page) / "index.html", error))
    throw IoError(*command.page + ": there is no index.html in it");
  return *command.page;
}

void open_in_browser(const std::string& address) {
  std::string program = "xdg-open", argument = address;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) != 0)
    fmt::print(stderr, "Note: no browser could be opened; open the address by hand\n");
}

void run_studio(const StudioCommand& command) {
  StudioFiles files{page_of(command), {}};
  if (!command.input.empty()) {
    check_input(command.input);
    files.model = command.input;
  }
  StudioServer server(files, command.port);
  write_stdout(fmt::format("The studio is at {}\nCtrl-C ends it.\n", server.address()));
  if (command.open) open_in_browser(server.address());
  server.serve();
}

}  // namespace

void add_studio_command(CLI::App& app) {
  const auto command = std::make_shared<StudioCommand>();
  CLI::App* const studio = app.add_subcommand("studio", "Shape a mesh by hand, in the browser");
  studio->group("Commands")->footer(kExamples);
  studio->add_option("IN", command->input, "Triangles: .obj .stl .ply .off .gltf .glb .3mf .dae")->option_text(" ");
  add_flag(
      *studio, "--port", "N",
      [command](const std::string& text) { command->port = parse_whole("--port", text, kPort); },
      "Port of 127.0.0.1 (one that is free)");
  add_flag(
      *studio, "--page", "FOLDER", [command](const std::string& text) { command->page = text; },
      "Serve this build of the page (the one that is installed)");
  studio->add_flag("--open", command->open, "Open it in the browser");
  studio->callback([command] { run_studio(*command); });
}

}  // namespace tetsoup::cli
