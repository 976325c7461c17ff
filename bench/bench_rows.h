// What is measured: each function registers rows with Google Benchmark. A row is named <what>/<voxels>, with
// /soup:<name> where it is not the input and /threads:<count> where it is not all cores.
#pragma once

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench_soups.h"

namespace tetsoup::bench {

/// One soup on one grid with so many threads; 0 threads are all cores.
struct Case {
  SoupName soup = SoupName::Input;
  int voxels = 0;
  int threads = 0;
};

std::string row_name(const std::string& what, const Case& which);

/// Wall time decides and is given in milliseconds; the processor time of all threads stands beside it.
template <class Body>
void add_row(const std::string& name, const Body& body) {
  benchmark::RegisterBenchmark(name.c_str(), body)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

void add_read_field_rows();                     ///< The yardstick: one pass over memory.
void add_file_rows();                           ///< Reading, and cleaning what was read.
void add_kernel_rows();                         ///< The inner loops, on every instruction set.
void add_stage_rows(const Case& which);         ///< Every stage from distance to smoothing.
void add_full_distance_row(const Case& which);  ///< Apart, since it takes long.
void add_thread_rows(const Case& which);        ///< Distance and signs with 1, 2, all and four times all cores.
void add_slider_rows(int voxels);               ///< One option changed, the distance known.
void add_embed_rows(int voxels);                ///< A million vertices in the tets, and moved with them.
void add_simulation_rows();                     ///< The scenes that come with the tool, and tets that only bend.

}  // namespace tetsoup::bench
