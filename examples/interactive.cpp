// A program with sliders: Pipeline runs again only the stages that a moved slider reaches.
#include <array>
#include <cstdio>

#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace {

constexpr std::array<const char*, tetsoup::kStageCount> kStageNames{"soup", "distance", "pseudo volume", "lattice",
                                                                    "smooth"};

// Runs the pipeline and says which stages had to work for it.
void run_and_tell(tetsoup::Pipeline& pipeline, const tetsoup::MeshOptions& options, const char* what) {
  std::array<std::size_t, tetsoup::kStageCount> before{};
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = pipeline.run_count(static_cast<tetsoup::Stage>(i));
  const tetsoup::SmoothResult& result = pipeline.run(options);

  std::printf("%-28s %6zu tets; ran:", what, result.mesh.tets.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto stage = static_cast<tetsoup::Stage>(i);
    if (pipeline.run_count(stage) > before[i]) std::printf(" %s (%.3f s)", kStageNames[i], pipeline.seconds(stage));
  }
  std::printf("\n");
}

}  // namespace

int main() {
  tetsoup::Pipeline pipeline(tetsoup::make_sample("heart"));
  tetsoup::MeshOptions options;
  options.distance.voxels = 64;

  run_and_tell(pipeline, options, "first run");
  options.lattice.rho_min = 0.2;
  run_and_tell(pipeline, options, "cover more space around it");
  options.smooth.passes = 10;
  run_and_tell(pipeline, options, "smooth more");
  options.pseudo_volume.k = 0.95;
  run_and_tell(pipeline, options, "another event threshold");
}
