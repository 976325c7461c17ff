#include "summary.h"

#include <fmt/format.h>

#include "angles.h"
#include "calibration.h"
#include "mesh_model.h"
#include "readiness_page.h"
#include "report_json.h"

namespace tetsoup::cli {

namespace {

/// "a", "a and b", "a, b and c"
std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::string describe_dropped(const SoupReport& soup) {
  const std::size_t dropped = soup.non_finite + soup.index_out_of_range + soup.duplicates;
  if (dropped == 0) return {};
  std::vector<std::string> reasons;
  if (soup.non_finite > 0) reasons.push_back(grouped(soup.non_finite) + " with non-finite coordinates");
  if (soup.index_out_of_range > 0) reasons.push_back(grouped(soup.index_out_of_range) + " with indices out of range");
  if (soup.duplicates > 0) reasons.push_back(grouped(soup.duplicates) + " that repeat another exactly");
  return fmt::format(" {} {} dropped: {}.", counted(dropped, "triangle"), dropped == 1 ? "was" : "were",
                     listed(reasons));
}

std::string describe_edges(const SoupReport& soup) {
  std::string text;
  if (soup.kind == SoupClass::Soup)
    text = fmt::format(" It is mostly loose: {}; taken for the solid that they outline.",
                       counted(soup.boundary_edges, "open edge"));
  else if (soup.boundary_edges > 0)
    text = fmt::format(" The surface has {}; treated as closed.", counted(soup.boundary_edges, "open edge"));
  else
    text = " The surface is closed.";
  std::vector<std::string> oddities;
  if (soup.non_manifold_edges > 0)
    oddities.push_back(counted(soup.non_manifold_edges, "edge") + " of three or more triangles");
  if (soup.inconsistent_edges > 0)
    oddities.push_back(counted(soup.inconsistent_edges, "edge") + " with inconsistent winding");
  if (soup.zero_area > 0)
    oddities.push_back(counted(soup.zero_area, "triangle") + " without area, used as segments or points");
  if (!oddities.empty()) text += " It has " + listed(oddities) + ": no harm here.";
  return text;
}

/// What was kept beyond density, and what the clean-up did.
std::string describe_care(const LatticeReport& lattice) {
  const TopologyReport& topology = lattice.topology;
  std::vector<std::string> done;
  const auto say = [&](std::size_t count, std::string_view noun, std::string_view what) {
    if (count > 0) done.push_back(counted(count, noun) + " " + std::string(what));
  };
  say(lattice.evened_tets, "tet", "dropped or added to even the stairs");
  say(lattice.thin_tets, "tet", "kept for thin parts");
  say(lattice.enclosing_tets, "tet", "added to enclose every vertex");
  say(lattice.doubled_tets, "tet", "doubled to keep apart what does not touch");
  say(lattice.parted_vertices, "vertex", "doubled to keep apart what does not touch");
  say(topology.bubbles_filled, "bubble", "filled");
  say(topology.parts_dropped, "crumb", "dropped (--min-part 0 keeps them)");
  say(topology.touching_mended, "place", "mended where tets merely touched");
  say(topology.boundary_only_tets, "tet", "with boundary vertices only taken care of");
  return done.empty() ? std::string() : "Care taken: " + listed(done) + ".\n";
}

std::string describe_lattice(const LatticeReport& lattice, const SmoothReport& smooth) {
  std::string text =
      fmt::format("Lattice: {} x {} x {} cells of edge {:.4g}; {} kept.", lattice.cells[0], lattice.cells[1],
                  lattice.cells[2], lattice.cell_size, counted(lattice.tet_count, "tet"));
  if (lattice.pseudo_volume > 0)
    text += fmt::format(" They reach beyond the volume by {:.0f} % of it and lack {:.0f} %.",
                        100 * lattice.excess_volume / lattice.pseudo_volume,
                        100 * lattice.lacking_volume / lattice.pseudo_volume);
  if (lattice.overlap_unfitted > 0)
    text += fmt::format(" The search for a fit raised the overlap with the inside voxels from {:.3f} to {:.3f}.",
                        lattice.overlap_unfitted, lattice.overlap);
  if (smooth.passes == 0) return text + " Not smoothed.\n" + describe_care(lattice);
  return text +
         fmt::format(" Smoothed in {}{}.\n", counted(static_cast<std::size_t>(smooth.passes), "pass"),
                     smooth.shortened_moves > 0 ? fmt::format("; {} cut short for the sake of the angles",
                                                              counted(smooth.shortened_moves, "move"))
                                                : std::string()) +
         describe_care(lattice);
}

std::string describe_result(const MeshRun& run) {
  const Quality& q = run.quality;
  return fmt::format(
      "Result: {}, {}, volume {:.4g}; dihedral angles {:.1f} to {:.1f} degrees; {}; boundary {}; overlap with the "
      "inside voxels (IoU) {:.3f}; boundary {:.2f} edges from the model on average, 95 % of it within {:.2f}.\n",
      counted(q.tet_count, "tet"), counted(q.vertex_count, "vertex"), q.volume, to_degrees(q.min_dihedral),
      to_degrees(q.max_dihedral), counted(q.components, "piece"), q.boundary_manifold ? "manifold" : "not manifold",
      run.iou, run.distance.mean, run.distance.percentile95);
}

std::string describe_seconds(const Timings& seconds) {
  std::string text = fmt::format("Time: {:.2f} s (", seconds.total);
  const std::pair<const char*, double> steps[] = {
      {"read", seconds.read},         {"clean", seconds.soup},
      {"distance", seconds.distance}, {"pseudo volume", seconds.pseudo_volume},
      {"lattice", seconds.lattice},   {"smooth", seconds.smooth},
      {"measure", seconds.quality},   {"calibrate", seconds.calibrate},
      {"preview", seconds.preview},   {"write", seconds.write}};
  const char* comma = "";
  for (const auto& [name, value] : steps) {
    if (value == 0) continue;
    text += fmt::format("{}{} {:.2f}", comma, name, value);
    comma = ", ";
  }
  return text + ")\n";
}

}  // namespace

std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, 1, ',');
  return digits;
}

std::string counted(std::size_t count, std::string_view noun) {
  std::string plural(noun);
  if (noun == "vertex")
    plural = "vertices";
  else if (noun == "pass")
    plural = "passes";
  else
    plural += "s";
  return fmt::format("{} {}", grouped(count), count == 1 ? noun : plural);
}

std::string describe_soup(const std::string& name, const SoupReport& soup) {
  return fmt::format("{}: {} with {} in {}.{}{}\n", name, counted(soup.triangle_count, "triangle"),
                     counted(soup.merged_vertices, "vertex"), counted(soup.components, "part"), describe_edges(soup),
                     describe_dropped(soup));
}

std::string describe_volume(const GridFrame& frame, const PseudoVolumeReport& volume, const SoupReport& soup) {
  const std::array<int, 3> size = unpadded_size(frame);
  std::string text = fmt::format("Grid: {} x {} x {} voxels of edge {:.4g}. k = {:.4g} {} (band {:.3g} voxels)",
                                 size[0], size[1], size[2], frame.voxel_size, volume.k,
                                 volume.automatic ? "was chosen" : "was used", volume.band_voxels);
  text += volume.floored ? "; the band asked for was below 0.9 voxels, where rays miss surfaces. " : ". ";
  text += counted(volume.inside_voxels, "voxel") + (volume.inside_voxels == 1 ? " is inside" : " are inside");
  if (volume.cavity_voxels > 0)
    text += fmt::format(", {} of them in cavities that the soup encloses (--cavities keep leaves those hollow)",
                        grouped(volume.cavity_voxels));
  text += ".";
  if (soup.boundary_edges > 0) {
    text += volume.largest_closure > 0
                ? fmt::format(" The largest hole that was closed is about {:.3g} wide.", volume.largest_closure)
                : std::string(" No hole had to be closed.");
  }
  return text + "\n";
}

std::string describe_run(const MeshRun& run) {
  const Pipeline& pipeline = *run.pipeline;
  const GridFrame& frame = pipeline.grid();
  std::string text = describe_soup(run.input, pipeline.soup().report) +
                     describe_volume(frame, pipeline.pseudo_volume().report, pipeline.soup().report) +
                     describe_lattice(pipeline.lattice().report, pipeline.smooth().report) + describe_result(run);
  for (const std::string& note : run.notes) text += "Note: " + note + "\n";
  text += describe_model(run.model);
  if (run.calibration) text += describe_calibration(*run.calibration, run.calibrated);
  text += describe_readiness(run.readiness, run.material);
  text += describe_seconds(run.seconds);
  for (const auto& path : run.outputs) text += "Wrote " + path.string() + "\n";
  if (!run.next_step.empty()) text += "Next: " + run.next_step + "\n";
  return text;
}

}  // namespace tetsoup::cli
