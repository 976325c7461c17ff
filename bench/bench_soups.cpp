#include "bench_soups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include <unistd.h>

#include "tetsoup/io.h"
#include "tetsoup/samples.h"

namespace tetsoup::bench {

namespace {

constexpr double kManyTriangles = 900e3;
constexpr double kStandInTriangles = 69e3;  // as many as the bunny has

// A folder for files that are made here, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() : path_(std::filesystem::temp_directory_path() / ("tetsoup-bench-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::filesystem::path g_input_path;

// The point with these weights, which sum to n. Sums run in the order of the corners.
Vec3 blend(const std::array<Vec3, 3>& corners, const std::array<int, 3>& weights, int n) {
  const auto along = [&](float Vec3::*axis) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * static_cast<double>(corners[i].*axis);
    return static_cast<float>(sum / n);
  };
  return {along(&Vec3::x), along(&Vec3::y), along(&Vec3::z)};
}

// Cuts every triangle into n * n equal ones, unconnected, so that about `target` come out.
TriangleSoup subdivided(const TriangleSoup& soup, double target) {
  const int n =
      std::max(1, static_cast<int>(std::lround(std::sqrt(target / static_cast<double>(soup.triangles.size())))));
  TriangleSoup fine;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(fine.vertices.size());
    fine.vertices.insert(fine.vertices.end(), {a, b, c});
    fine.triangles.push_back({first, first + 1, first + 2});
  };
  for (Triangle triangle : soup.triangles) {
    std::sort(triangle.begin(), triangle.end());  // so that neighbours agree on the points of the edge between them
    const std::array<Vec3, 3> corners{soup.vertices[triangle[0]], soup.vertices[triangle[1]],
                                      soup.vertices[triangle[2]]};
    const auto point = [&](int i, int j) { return blend(corners, {n - i - j, i, j}, n); };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < n) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
    }
  }
  return fine;
}

TriangleSoup make_soup(SoupName name) {
  switch (name) {
    case SoupName::OneTriangle:
      return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5F}}, {{0, 1, 2}}};
    case SoupName::ManyTriangles:
      return subdivided(make_sample("torus"), kManyTriangles);
    case SoupName::Input:
      break;
  }
  if (!g_input_path.empty()) return read_soup(g_input_path);
  return subdivided(make_sample("torus"), kStandInTriangles);
}

}  // namespace

std::string text_of(SoupName name) {
  switch (name) {
    case SoupName::OneTriangle:
      return "one_triangle";
    case SoupName::ManyTriangles:
      return "many_triangles";
    case SoupName::Input:
      break;
  }
  return "input";
}

void set_input(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) {
    g_input_path = path;
    return;
  }
  g_input_path.clear();
  std::fprintf(stderr, "No file %s: measuring %s instead.\n", path.c_str(), input_summary().c_str());
}

std::string input_summary() {
  return g_input_path.empty() ? "the sample torus, subdivided" : g_input_path.filename().string();
}

const TriangleSoup& raw_soup(SoupName name) {
  static std::map<SoupName, TriangleSoup> soups;
  const auto found = soups.find(name);
  return found != soups.end() ? found->second : soups.emplace(name, make_soup(name)).first->second;
}

const CleanSoup& clean_soup_of(SoupName name) {
  static std::map<SoupName, CleanSoup> soups;
  const auto found = soups.find(name);
  return found != soups.end() ? found->second : soups.emplace(name, clean_soup(raw_soup(name))).first->second;
}

std::filesystem::path input_file(const std::string& extension) {
  static const ScratchFolder scratch;
  if (g_input_path.extension() == extension) return g_input_path;
  const std::filesystem::path path = scratch.path() / ("input" + extension);
  const TriangleSoup& soup = raw_soup(SoupName::Input);
  if (!std::filesystem::exists(path)) write_surface(path, soup.vertices, soup.triangles);
  return path;
}

LatticeOptions lattice_for(const PseudoVolume& volume) {
  constexpr double kTetsPerCell = 5;
  LatticeOptions options;
  // A soup without an inside, such as one triangle, has no volume to divide: the default lattice serves.
  if (volume.report.volume > 0) options.cell_size = std::cbrt(kTetsPerCell * volume.report.volume / kTetCount);
  return options;
}

Prepared& prepared(SoupName name, int voxels) {
  static std::optional<Prepared> kept;
  static std::pair<SoupName, int> kept_for;
  if (!kept || kept_for != std::pair(name, voxels)) {
    kept.reset();
    kept.emplace(Prepared{Pipeline(raw_soup(name)), {}});
    kept_for = {name, voxels};
    kept->options.distance.voxels = voxels;
    kept->pipeline.run_until(Stage::PseudoVolume, kept->options);
    kept->options.lattice = lattice_for(kept->pipeline.pseudo_volume());
    kept->pipeline.run(kept->options);
  }
  return *kept;
}

}  // namespace tetsoup::bench
