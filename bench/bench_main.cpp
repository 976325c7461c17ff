// Own flags, then Google Benchmark's (--help lists those):
//   --input=FILE           the soup to measure
//   --voxels=64,128        grids
//   --save=SOUP:FILE       writes input, one_triangle or many_triangles as .ply or .obj and stops
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string_view>

#include "bench_rows.h"
#include "tetsoup/io.h"

namespace tetsoup::bench {

namespace {

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "tetsoup_bench: %s\n", why.c_str());
  std::exit(2);
}

struct Flags {
  std::filesystem::path input = TETSOUP_BENCH_INPUT;
  std::vector<int> voxels{64, 128, 256};
  std::string save;
};

std::vector<int> numbers(std::string_view text) {
  std::vector<int> values;
  while (!text.empty()) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || value < 1) fail("--voxels takes numbers with commas between");
    values.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.empty()) text.remove_prefix(1);
  }
  return values;
}

// Takes our flags out of argv and leaves the rest to Google Benchmark.
Flags take_flags(int& argc, char** argv) {
  Flags flags;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const auto value_of = [&](std::string_view flag) -> std::optional<std::string_view> {
      if (!argument.starts_with(flag)) return {};
      return argument.substr(flag.size());
    };
    if (const auto input = value_of("--input=")) {
      flags.input = *input;
    } else if (const auto voxels = value_of("--voxels=")) {
      flags.voxels = numbers(*voxels);
    } else if (const auto save = value_of("--save=")) {
      flags.save = *save;
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  return flags;
}

void save_soup(const std::string& what) {
  const std::size_t colon = what.find(':');
  for (const SoupName name : {SoupName::Input, SoupName::OneTriangle, SoupName::ManyTriangles}) {
    if (colon == std::string::npos || what.substr(0, colon) != text_of(name)) continue;
    const TriangleSoup& soup = raw_soup(name);
    write_surface(what.substr(colon + 1), soup.vertices, soup.triangles);
    return;
  }
  fail("--save takes input:FILE, one_triangle:FILE or many_triangles:FILE");
}

constexpr int kEmbedVoxels = 128;  // The grid does not matter to it: one is enough.

void add_rows(const std::vector<int>& sizes) {
  add_read_field_rows();
  add_file_rows();
  add_kernel_rows();
  add_simulation_rows();
  for (const int voxels : sizes) {
    add_stage_rows({.voxels = voxels});
    add_full_distance_row({.voxels = voxels});
    add_slider_rows(voxels);
    if (voxels == kEmbedVoxels) add_embed_rows(voxels);
    add_thread_rows({.voxels = voxels});
  }
  for (const SoupName soup : {SoupName::OneTriangle, SoupName::ManyTriangles})
    for (const int voxels : sizes) add_stage_rows({.soup = soup, .voxels = voxels});
}

int run(int argc, char** argv) {
  const Flags flags = take_flags(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  set_input(flags.input);
  if (!flags.save.empty()) {
    save_soup(flags.save);
    return 0;
  }
  benchmark::AddCustomContext("input", input_summary());
  add_rows(flags.voxels);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

}  // namespace tetsoup::bench

int main(int argc, char** argv) {
  try {
    return tetsoup::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tetsoup_bench: %s\n", error.what());
    return 1;
  }
}
