#include "bench_rows.h"
#include "tetsoup/io.h"

namespace tetsoup::bench {

void add_file_rows() {
  for (const char* kind : {"ply", "obj"}) {
    add_row(std::string("read_") + kind, [kind](benchmark::State& state) {
      const auto path = input_file(std::string(".") + kind);
      for (auto _ : state) benchmark::DoNotOptimize(read_soup(path).triangles.data());
      state.counters["triangles"] = static_cast<double>(raw_soup(SoupName::Input).triangles.size());
    });
    add_row(std::string("read_render_mesh_") + kind, [kind](benchmark::State& state) {
      const auto path = input_file(std::string(".") + kind);
      for (auto _ : state) benchmark::DoNotOptimize(read_render_mesh(path).corners.data());
      state.counters["triangles"] = static_cast<double>(raw_soup(SoupName::Input).triangles.size());
    });
  }
  for (const SoupName name : {SoupName::Input, SoupName::ManyTriangles}) {
    add_row(row_name("clean_soup", {.soup = name}), [name](benchmark::State& state) {
      const TriangleSoup& soup = raw_soup(name);
      for (auto _ : state) benchmark::DoNotOptimize(clean_soup(soup).report.used_triangles);
      state.counters["triangles"] = static_cast<double>(soup.triangles.size());
    });
  }
}

}  // namespace tetsoup::bench
