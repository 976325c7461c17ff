// What a user should know of a mesh, as sentences. A stage says its own in its report's `notes`; what only the whole
// shows is said here.
#include <algorithm>
#include <cmath>

#include "base/words.h"
#include "report/fidelity_notes.h"
#include "tetsoup/report.h"

namespace tetsoup {

namespace {

using Notes = std::vector<std::string>;

/// Beyond this share of tets judged without a voxel centre, the lattice is finer than the grid that it was cut from.
constexpr double kManySampled = 0.1;

double longest_side(const Box3& box) {
  return std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
}

int longest_of(const std::array<int, 3>& counts) {
  return *std::max_element(counts.begin(), counts.end());
}

/// Where the count is missed by more than was promised: shapes of a few flat sides lose or gain tets by the layer.
void note_budget(const Pipeline& pipeline, Notes& notes) {
  const LatticeOptions& options = pipeline.options().lattice;
  const auto note = [&](std::size_t wanted, std::size_t got, const char* noun) {
    const double tolerance = wanted < 200 ? 0.10 : 0.05;
    if (std::abs(static_cast<double>(got) / static_cast<double>(wanted) - 1) <= tolerance) return;
    notes.push_back("Of " + counted(wanted, noun) + " only a lattice with " + grouped(got) +
                    " came near; shift or turn it (--translate, --rotate).");
  };
  if (options.tets) note(*options.tets, pipeline.lattice().mesh.tets.size(), "tet");
  if (options.vertices) note(*options.vertices, pipeline.lattice().mesh.vertices.size(), "vertex");
}

void note_lattice(const Findings& found, Notes& notes) {
  const Pipeline& pipeline = found.pipeline;
  const LatticeReport& lattice = pipeline.lattice().report;
  constexpr int kMostCells = 1024, kMostVoxels = 4096;
  note_budget(pipeline, notes);
  if (lattice.kept_by_soup) {
    notes.push_back("No tet was filled enough (--rho-min " + rounded(pipeline.options().lattice.rho_min, 4) +
                    "), as happens with sheets and needles, so the tets that the soup passes through were kept. For a "
                    "thinner body use more cells (--cells " +
                    std::to_string(std::min(2 * longest_of(lattice.cells), kMostCells)) +
                    "); for a filled one a wider band (--band-voxels " +
                    rounded(2 * pipeline.pseudo_volume().report.band_voxels) + ").");
    return;
  }
  if (static_cast<double>(lattice.sampled_tets) > kManySampled * static_cast<double>(lattice.tet_count)) {
    const GridFrame& frame = pipeline.grid();
    notes.push_back("The lattice is finer than the voxel grid: " + counted(lattice.sampled_tets, "tet") +
                    " held no voxel centre and were judged by samples. More voxels (--voxels " +
                    std::to_string(std::min(2 * (longest_of(frame.size) - 2 * frame.pad), kMostVoxels)) +
                    ") show more of the shape.");
  }
}

void note_faults(const Quality& quality, Notes& notes) {
  if (quality.inverted_tets + quality.invalid_tets > 0)
    notes.push_back(counted(quality.inverted_tets + quality.invalid_tets, "tet") +
                    " of the mesh have no positive volume. This is a bug; please report it with the input.");
}

/// A model drawn in millimetres is a thousand times too large for an engine that takes its unit for the metre.
void note_size(const Findings& found, Notes& notes) {
  constexpr double kSmall = 0.001, kLarge = 10;  // metres
  const double size = longest_side(found.pipeline.soup().report.box) * found.metres_per_unit;
  if (found.engine.empty() || (size >= kSmall && size <= kLarge)) return;
  notes.push_back("For the engine the body is " + rounded(size) + " m long. If the model's unit is another than " +
                  rounded(found.metres_per_unit) + " m, say so: --metres-per-unit 0.001 for millimetres.");
}

/// Its tree of nodes is made by joining neighbours until one is left.
void note_pieces(const Findings& found, Notes& notes) {
  if (found.engine != "bullet" || found.quality.components < 2) return;
  notes.push_back("PyBullet's loadSoftBody() never returns for a body of several pieces, here " +
                  std::to_string(found.quality.components) +
                  ": join them (--rho-min 0.2, more tets) or drop the small ones (--min-part 0.05).");
}

void append(Notes& notes, const Notes& more) {
  notes.insert(notes.end(), more.begin(), more.end());
}

}  // namespace

std::vector<std::string> grid_notes(const CleanSoup& soup, const DistanceOptions& asked, const GridFrame& frame) {
  const double longest = longest_side(soup.report.box);
  constexpr int kDefaultVoxels = 128;
  const double wanted = asked.voxel_size.value_or(longest / asked.voxels.value_or(kDefaultVoxels));
  constexpr double kRounding = 1e-6;  // relative; a raised edge is larger by more than that
  if (frame.voxel_size <= wanted * (1 + kRounding)) return {};
  if (longest == 0) return {"The soup has no extent; the voxel edge is " + rounded(frame.voxel_size, 4) + "."};
  return {"The voxel edge was raised from " + rounded(wanted, 4) + " to " + rounded(frame.voxel_size, 4) +
          ": so far from the origin single precision tells no finer voxels apart. Move the model to the origin to get "
          "what was asked for."};
}

std::vector<std::string> notes_of(const Findings& found) {
  const Pipeline& pipeline = found.pipeline;
  Notes notes = pipeline.soup().report.notes;
  append(notes, grid_notes(pipeline.soup(), pipeline.options().distance, pipeline.grid()));
  append(notes, pipeline.body_notes());
  append(notes, pipeline.pseudo_volume().report.notes);
  note_lattice(found, notes);
  append(notes, pipeline.lattice().report.notes);
  append(notes, pipeline.smooth().report.notes);
  note_faults(found.quality, notes);
  note_fidelity(found, notes);
  note_size(found, notes);
  note_pieces(found, notes);
  return notes;
}

}  // namespace tetsoup
