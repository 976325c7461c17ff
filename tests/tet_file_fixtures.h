// Meshes by formula and a folder of their own for the tests of files.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tetsoup/error.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// Two tets with coordinates that need all digits, very small and very large ones, and a vertex that no tet uses.
inline TetMesh few_tets() {
  TetMesh mesh;
  mesh.vertices = {{0.1F, -0.0F, 1e-30F}, {1.0F / 3, 0, 0},  {0, 16777217.0F, 0},
                   {0, 0, 3.4028235e38F}, {-1, -1e-45F, -1}, {1.1754944e-38F, 5, 6}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  return mesh;
}

/// Cubes of six tets each, vertices moved by a fixed noise; 6 cells^3 positive tets.
inline TetMesh block_of_tets(int cells) {
  TetMesh mesh;
  std::mt19937 random(7);
  const auto noise = [&] { return static_cast<float>(random() % 1000) * 1e-4F; };
  for (int z = 0; z <= cells; ++z)
    for (int y = 0; y <= cells; ++y)
      for (int x = 0; x <= cells; ++x)
        mesh.vertices.push_back(
            {static_cast<float>(x) + noise(), static_cast<float>(y) + noise(), static_cast<float>(z) + noise()});
  const auto at = [&](int x, int y, int z) {
    return static_cast<std::uint32_t>(x + (cells + 1) * (y + (cells + 1) * z));
  };
  constexpr int kPaths[6][2] = {{0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}};  // Even ones first.
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        for (int path = 0; path < 6; ++path) {
          std::array<int, 3> p{x, y, z};
          Tet tet{at(x, y, z), 0, 0, at(x + 1, y + 1, z + 1)};
          for (std::size_t step = 0; step < 2; ++step) {
            ++p[static_cast<std::size_t>(kPaths[path][step])];
            tet[step + 1] = at(p[0], p[1], p[2]);
          }
          if (path >= 3) std::swap(tet[1], tet[2]);
          mesh.tets.push_back(tet);
        }
  return mesh;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_file(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A new, empty folder, removed at the end.
class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("tetsoup-" + std::to_string(::getpid()) + "-" + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Names of all files in the folder, hidden ones too.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::filesystem::path folder_;
};

/// The text of the IoError that `act` throws.
template <class Act>
std::string io_error_of(const Act& act) {
  try {
    act();
  } catch (const IoError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no IoError";
  return {};
}

}  // namespace tetsoup
