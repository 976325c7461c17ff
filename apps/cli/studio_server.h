// Serves the page of the studio to this machine's own browser, and to nobody else.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace tetsoup::cli {

/// What is served.
struct StudioFiles {
  std::filesystem::path page;                  ///< The folder with index.html.
  std::optional<std::filesystem::path> model;  ///< Under /model/ and its own name.
};

/// A port of 127.0.0.1. The page may use threads, since it is isolated from all others (COOP and COEP); requests under
/// another host's name, as a hostile page could make them, are refused.
class StudioServer {
 public:
  /// Takes the port, or one that is free.
  /// @throws IoError  if it is taken.
  StudioServer(const StudioFiles& files, std::optional<int> port);
  ~StudioServer();

  /// With the model for the page to load.
  std::string address() const;
  /// Until Ctrl-C.
  void serve();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tetsoup::cli
