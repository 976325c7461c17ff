// tetsoup: all stages in a row, remembered, so that a changed option recomputes only what depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "tetsoup/distance.h"
#include "tetsoup/lattice.h"
#include "tetsoup/progress.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/smooth.h"
#include "tetsoup/soup.h"
#include "tetsoup/types.h"

namespace tetsoup {

struct MeshOptions {
  DistanceOptions distance;
  PseudoVolumeOptions pseudo_volume;
  LatticeOptions lattice;
  SmoothOptions smooth;
  std::optional<std::size_t> memory_limit;  ///< Bytes; a grid that needs more is refused before it is made.
  bool operator==(const MeshOptions&) const = default;
};

enum class Stage { Soup, Distance, PseudoVolume, Lattice, Smooth };
inline constexpr std::size_t kStageCount = 5;

/// Bytes that the stages up to the pseudo volume take at their peak for this grid.
std::size_t grid_memory(const GridFrame& frame);

/// Remembers a soup and every stage's last result.
///
/// @code
///   tetsoup::Pipeline pipeline(soup);
///   tetsoup::MeshOptions options;
///   const auto& first = pipeline.run(options);
///   options.lattice.rho_min = 0.3;               // runs the lattice and the smoothing only
///   const auto& second = pipeline.run(options);
/// @endcode
class Pipeline {
 public:
  explicit Pipeline(const TriangleSoup& soup, const Progress& progress = {});

  /// Brings every stage up to date and returns the final mesh; the reference holds until the next run.
  ///
  /// A stage runs again only if its options or a stage before it changed. A k whose band is wider than the distance
  /// known so far widens the field; known distances stay.
  /// @throws InvalidInput  if an option is out of range, the soup has no finite triangle, or memory_limit is too small
  /// (the
  ///                       text says how many voxels would fit); Cancelled: finished stages are kept.
  const SmoothResult& run(const MeshOptions& options = {}, const Progress& progress = {});

  /// Runs stages up to and including `last` only.
  void run_until(Stage last, const MeshOptions& options = {}, const Progress& progress = {});

  const MeshOptions& options() const { return options_; }  ///< Of the last run.
  const CleanSoup& soup() const { return soup_; }
  const DistanceField& distance() const { return *distance_; }  ///< After the stage has run, as all below.
  const PseudoVolume& pseudo_volume() const { return *volume_; }
  const LatticeMesh& lattice() const { return *lattice_; }
  const SmoothResult& smooth() const { return *smooth_; }

  std::size_t run_count(Stage stage) const;  ///< Times the stage has run.
  double seconds(
      Stage stage) const;  ///< Wall time of the stage in the last run that reached it; widening counts as distance.

 private:
  CleanSoup soup_;
  MeshOptions options_;
  std::optional<DistanceField> distance_;
  std::optional<PseudoVolume> volume_;
  std::optional<LatticeMesh> lattice_;
  std::optional<SmoothResult> smooth_;
  std::array<std::size_t, kStageCount> run_counts_{};
  std::array<double, kStageCount> seconds_{};
};

}  // namespace tetsoup
