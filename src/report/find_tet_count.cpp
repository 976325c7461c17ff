// How many tets a shape needs: tried, from few to many.
#include <algorithm>
#include <array>

#include "tetsoup/report.h"

namespace tetsoup {

namespace {

constexpr std::array<std::size_t, 7> kTried{500, 1000, 2000, 4000, 8000, 16000, 32000};

/// Who asks for as many as it takes wants walls of about their thickness, not what readiness lets pass for a few tets.
constexpr double kMostVolume = 1.25;

/// Checks that only more tets or voxels mend; the others are of the mesh by itself.
bool holds(const Pipeline& pipeline) {
  const TetMesh& mesh = pipeline.smooth().mesh;
  const Readiness alone = assess_readiness(mesh, measure_quality(mesh));
  const Fidelity fidelity = measure_fidelity(mesh, pipeline.soup());
  if (fidelity.closed && fidelity.volume_ratio > kMostVolume) return false;
  const Readiness compared = assess_readiness(mesh, measure_quality(mesh), fidelity);
  return std::all_of(compared.checks.begin() + static_cast<std::ptrdiff_t>(alone.checks.size()), compared.checks.end(),
                     [](const ReadinessCheck& check) { return check.passed; });
}

}  // namespace

std::string CountSearch::note() const {
  if (held) return {};
  return "No count of tets up to 32,000 holds the shape in all that is checked; more voxels (--voxels) may.";
}

CountSearch find_tet_count(Pipeline& pipeline, const MeshOptions& options, const Progress& progress) {
  MeshOptions tried = options;
  CountSearch found;
  for (const std::size_t count : kTried) {
    tried.lattice.tets = count;
    pipeline.run(tried, progress);
    found = {count, holds(pipeline)};
    if (found.held) break;
  }
  return found;
}

}  // namespace tetsoup
