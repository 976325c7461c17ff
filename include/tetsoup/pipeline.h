// tetsoup: all stages in a row, remembered, so that a changed option recomputes only what depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tetsoup/bodies.h"
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
  Join join = Join::Touching;  ///< Which parts of the soup are one body; bodies are meshed on grids of their own.
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
  /// After the stage has run, as all below. Of several bodies this is all of them on one grid of the whole soup; each
  /// was found on a finer one.
  const PseudoVolume& pseudo_volume() const;
  const LatticeMesh& lattice() const;  ///< Of all bodies, one after the other.
  const SmoothResult& smooth() const;
  std::size_t body_count() const { return bodies_.size(); }
  /// What was made of the soup's parts, for the user: bodies apart, specks left out, shares of the budget, walls that
  /// are too thin for any grid.
  std::vector<std::string> body_notes() const;
  /// The grid of the whole soup.
  const GridFrame& grid() const { return grid_; }
  /// The distance to all of the soup on that grid. The mesher measures only what it needs, near parts that are open:
  /// unless a run ended with the stages Distance or PseudoVolume, this is measured when first asked for.
  const DistanceField& distance() const;
  /// IoU of a mesh with the pseudo volume, each body's on its own grid.
  double overlap(const TetMesh& mesh) const;

  std::size_t run_count(Stage stage) const;  ///< Times the stage has run.
  double seconds(
      Stage stage) const;  ///< Wall time of the stage in the last run that reached it; widening counts as distance.

 private:
  /// What is meshed by itself: one of several bodies has a soup of its own.
  struct Body {
    CleanSoup own_soup;
    DistanceOptions distance;  ///< The size of its voxels, as chosen.
    GridFrame grid;
    BodySize size;
    std::optional<PseudoVolume> volume;
    std::optional<LatticeMesh> lattice;
    std::optional<SmoothResult> smooth;
  };
  const CleanSoup& soup_of(const Body& body) const { return bodies_.size() == 1 && whole_ ? soup_ : body.own_soup; }

  void forget_changed(const MeshOptions& options);
  void split(const Progress& progress);
  void choose_grids(const Progress& progress);
  void find_volumes(const Progress& progress);
  void fill_lattices(const Progress& progress);
  void smooth_all(const Progress& progress);
  LatticeMesh lattice_of(Body& body, std::size_t tets, const Progress& progress);
  void note_thin_walls(std::vector<std::string>& notes) const;
  Vec3d place_of(std::uint32_t triangle) const;
  void measure_distance(const Progress& progress) const;

  CleanSoup soup_;
  MeshOptions options_;
  std::optional<Bodies> split_;
  std::vector<BodySize> sizes_;
  std::vector<Body> bodies_;
  bool whole_ = true;  ///< The only body is all of the soup.
  bool gridded_ = false, volumed_ = false, latticed_ = false, smoothed_ = false;
  GridFrame grid_;
  mutable std::optional<DistanceField> distance_;
  std::optional<PseudoVolume> volume_;  ///< Of several bodies.
  std::optional<LatticeMesh> lattice_;
  std::optional<SmoothResult> smooth_;
  std::array<std::size_t, kStageCount> run_counts_{};
  std::array<double, kStageCount> seconds_{};
};

}  // namespace tetsoup
