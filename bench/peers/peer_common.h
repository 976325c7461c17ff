// What the C++ peers share: the soup as bench/peers/prepare.py writes it, the grid from the command line, threads, a
// clock, and the one line of JSON that the runner reads.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

namespace peers {

struct Soup {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Grid {
  int nx, ny, nz;
  double ox, oy, oz, h;
};

/// Two counts (uint32), float vertices, uint32 triangles.
inline Soup read_raw_soup(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::uint32_t counts[2] = {0, 0};
  file.read(reinterpret_cast<char*>(counts), sizeof counts);
  Soup soup;
  soup.vertices.resize(counts[0]);
  soup.triangles.resize(counts[1]);
  file.read(reinterpret_cast<char*>(soup.vertices.data()), static_cast<std::streamsize>(counts[0] * 12ULL));
  file.read(reinterpret_cast<char*>(soup.triangles.data()), static_cast<std::streamsize>(counts[1] * 12ULL));
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path);
    std::exit(3);
  }
  return soup;
}

/// nx ny nz ox oy oz h
inline Grid grid_of(char** text) {
  return {std::atoi(text[0]), std::atoi(text[1]), std::atoi(text[2]), std::atof(text[3]),
          std::atof(text[4]), std::atof(text[5]), std::atof(text[6])};
}

/// body(y, z) for all rows, on all cores.
template <class Body>
void for_rows(const Grid& grid, const Body& body) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int row = next++; row < grid.ny * grid.nz; row = next++) body(row % grid.ny, row / grid.ny);
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Voxels closer than three voxels, by which the tools can be compared: the same work gives the same count.
inline std::size_t count_in_band(const std::vector<float>& distance, double h) {
  std::size_t count = 0;
  for (const float d : distance) count += d < 3 * h ? 1 : 0;
  return count;
}

inline void report(double seconds, std::size_t in_band) {
  std::printf("{\"seconds\": %.6f, \"in_band\": %zu}\n", seconds, in_band);
}

}  // namespace peers
