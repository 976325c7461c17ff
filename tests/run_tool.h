// Runs the built command-line tool as a user would: its own process, its own folder, its exit code and its two streams.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tetsoup::test {

namespace fs = std::filesystem;

inline std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Outcome {
  int exit_code = -1;  ///< -1: did not start, or a signal ended it.
  std::string out, err;
};

/// A fresh folder for every test, and the tool started in it.
class ToolTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "tetsoup_cli_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path in_folder(const std::string& name) const { return folder_ / name; }

  /// Names of all files in the folder but the streams' own.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (const std::string name = entry.path().filename().string(); name != "out.txt" && name != "err.txt")
        names.push_back(name);
    std::sort(names.begin(), names.end());
    return names;
  }

  Outcome run(const std::vector<std::string>& arguments, const std::string& out_path = {}) const {
    const std::string out = out_path.empty() ? in_folder("out.txt").string() : out_path;
    const std::string err = in_folder("err.txt").string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int kMode = 0600;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    const pid_t child = start(arguments, actions);
    posix_spawn_file_actions_destroy(&actions);
    return {wait_for(child), out_path.empty() ? read_text(out) : std::string(), read_text(err)};
  }

  /// With standard error on a terminal. @param interrupt  Press Ctrl-C as soon as something is drawn there.
  Outcome run_on_terminal(const std::vector<std::string>& arguments, bool interrupt) const {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) return {};
    const std::string slave = ptsname(terminal);
    // Held open here too, so that what the tool wrote last can still be read after it has ended.
    const int own_slave = open(slave.c_str(), O_RDWR | O_NOCTTY);
    const std::string out = in_folder("out.txt").string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int kMode = 0600;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, slave.c_str(), O_RDWR | O_NOCTTY, 0);
    const pid_t child = start(arguments, actions);
    posix_spawn_file_actions_destroy(&actions);
    Outcome outcome;
    int status = 0;
    bool ended = child < 0, pressed = false;
    while (!ended) {
      ended = waitpid(child, &status, WNOHANG) != 0;
      outcome.err += read_waiting(terminal);
      if (interrupt && !pressed && !outcome.err.empty()) {
        kill(child, SIGINT);
        pressed = true;
      }
    }
    outcome.err += read_waiting(terminal);
    close(own_slave);
    close(terminal);
    outcome.exit_code = child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.out = read_text(out);
    return outcome;
  }

  /// The tool runs in the test's folder, so that tests may use plain file names.
  pid_t start(const std::vector<std::string>& arguments, posix_spawn_file_actions_t& actions) const {
    std::vector<std::string> words{"sh", "-c", "cd \"$0\" && TERM=xterm exec \"$@\"", folder_.string(), TETSOUP_CLI};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;  // whoever started the tests in the background may have had SIGINT ignored
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGINT);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t child = -1;
    const int error = posix_spawn(&child, "/bin/sh", &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    return error == 0 ? child : -1;
  }

  static int wait_for(pid_t child) {
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    return WEXITSTATUS(status);
  }

 private:
  /// What a terminal has to show within a moment.
  static std::string read_waiting(int terminal) {
    std::string text;
    constexpr int kPatienceMs = 20;
    pollfd waiting{terminal, POLLIN, 0};
    while (poll(&waiting, 1, kPatienceMs) > 0 && (waiting.revents & POLLIN) != 0) {
      std::array<char, 4096> buffer;
      const ssize_t count = read(terminal, buffer.data(), buffer.size());
      if (count <= 0) break;
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

  fs::path folder_;
};

// A unit cube of twelve triangles: small enough to mesh in a moment at these numbers of voxels.
inline constexpr const char* kCube =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

/// With a cube to work on.
class Tool : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    write_text(in_folder("cube.obj"), kCube);
  }

  /// Meshes the cube quickly, with more words behind.
  Outcome mesh_cube(std::vector<std::string> more) const {
    std::vector<std::string> words{"mesh", "cube.obj", "-o", "cube.msh", "--voxels", "24", "--cells", "5"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  /// One line that says "tetsoup: error: " and something, and names all of `parts`.
  static void expect_error_line(const Outcome& outcome, const std::vector<std::string>& parts) {
    EXPECT_TRUE(outcome.err.starts_with("tetsoup: error: ")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  }
};

}  // namespace tetsoup::test
