#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tetsoup/io.h"

namespace tetsoup {

namespace {

namespace fs = std::filesystem;

constexpr double kUsableShare = 0.9;  // the rest is for the lattice, the mesh, and what else the machine does meanwhile
constexpr std::uint64_t kBytesPerKiB = 1024;

/// The number behind a key in lines of "key value" or "key: value kB".
std::optional<std::uint64_t> find_value(const fs::path& path, std::string_view key) {
  std::ifstream file(path);
  std::string word;
  std::uint64_t value = 0;
  for (std::string rest; file >> word; std::getline(file, rest))
    if (word == key) return file >> value ? std::optional(value) : std::nullopt;
  return {};
}

/// A file that holds one number; nothing for "max" or if there is no such file.
std::optional<std::uint64_t> read_number(const fs::path& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? std::optional(value) : std::nullopt;
}

/// The names by which one version of the control groups tells its memory numbers.
struct GroupFiles {
  fs::path root;
  const char* limit;
  const char* usage;
  const char* reclaimable;  ///< Key in memory.stat: cached files, which the kernel gives up under pressure.
};

/// Free bytes below the limit of a group or of any group around it.
std::optional<std::uint64_t> free_in_group(const GroupFiles& files, fs::path group) {
  std::optional<std::uint64_t> least;
  for (;; group = group.parent_path()) {
    const fs::path folder = files.root / group.relative_path();
    const auto limit = read_number(folder / files.limit);
    const auto usage = read_number(folder / files.usage);
    if (limit && usage) {
      const std::uint64_t cached = find_value(folder / "memory.stat", files.reclaimable).value_or(0);
      const std::uint64_t taken = *usage - std::min(*usage, cached);
      const std::uint64_t free = *limit - std::min(*limit, taken);
      least = std::min(least.value_or(free), free);
    }
    if (!group.has_relative_path()) return least;
  }
}

std::optional<std::uint64_t> free_in_groups() {
  const GroupFiles version1{"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                            "total_inactive_file"};
  const GroupFiles version2{"/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};
  std::ifstream file("/proc/self/cgroup");
  std::optional<std::uint64_t> least;
  for (std::string line; std::getline(file, line);) {  // "4:memory:/group" or "0::/group"
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controller = line.substr(first + 1, second - first - 1);
    if (!controller.empty() && controller != "memory") continue;
    const auto free = free_in_group(controller.empty() ? version2 : version1, line.substr(second + 1));
    if (free) least = std::min(least.value_or(*free), *free);
  }
  return least;
}

}  // namespace

std::optional<std::size_t> usable_memory() {
  const auto free_kib = find_value("/proc/meminfo", "MemAvailable:");
  std::optional<std::uint64_t> free = free_in_groups();
  if (free_kib) free = std::min(free.value_or(*free_kib * kBytesPerKiB), *free_kib * kBytesPerKiB);
  if (!free) return {};
  return static_cast<std::size_t>(static_cast<double>(*free) * kUsableShare);
}

}  // namespace tetsoup
