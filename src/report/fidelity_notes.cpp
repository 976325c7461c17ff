#include "report/fidelity_notes.h"

#include <algorithm>
#include <cmath>

#include "base/words.h"

namespace tetsoup {

namespace {

using Notes = std::vector<std::string>;

/// What the advice names: twice the voxels, and as many tets as hold the shape when tried.
struct Advice {
  std::string voxels, tets;
};

Advice advice_for(const Findings& found) {
  const GridFrame& frame = found.pipeline.grid();
  constexpr int kMostVoxels = 1024;
  const int voxels = *std::max_element(frame.size.begin(), frame.size.end()) - 2 * frame.pad;
  return {"--voxels " + std::to_string(std::min(2 * voxels, kMostVoxels)), "--tets auto tries how many"};
}

void note_lost(const Fidelity& f, const Advice& advice, Notes& notes) {
  if (f.lost_stretches > 0)
    notes.push_back(counted(f.lost_stretches, "stretch") + " of the model " + (f.lost_stretches == 1 ? "has" : "have") +
                    " no tets, the longest of " + rounded(f.lost_edges * f.mean_edge) + ", " +
                    rounded(f.lost_edges, 2) + " edges of a tet. What is thinner than a voxel needs more of them (" +
                    advice.voxels + "), what is thinner than a tet a lower --rho-min (0.2) or more tets (" +
                    advice.tets + ").");
  if (f.lost_pieces > 0)
    notes.push_back("Of the " + counted(f.soup_pieces, "piece") + " of the model " + grouped(f.lost_pieces) + " " +
                    (f.lost_pieces == 1 ? "has" : "have") +
                    " no tets. --min-part 0 drops nothing for its size; "
                    "more tets (" +
                    advice.tets + ") leave more for each.");
}

void note_volume(const Fidelity& f, const Advice& advice, Notes& notes) {
  if (!f.closed || !(f.soup_volume > 0)) return;
  const double wall = f.wall_edges * f.mean_edge;
  const std::string times = rounded(f.volume_ratio) + " times";
  constexpr double kMostStray = 0.02, kMost = 1.1, kLeast = 0.9, kThick = 0.5;
  if (f.stray_share > kMostStray)
    notes.push_back(percent(f.stray_share) +
                    " of the mesh stands outside the model, away from its surface, where a vessel, a room or a gap was "
                    "filled: its volume and mass are " +
                    times + " the model's. More voxels (" + advice.voxels +
                    ") keep what is open open, --cavities keep what is closed.");
  else if (f.volume_ratio > kMost && f.wall_edges < kThick)
    notes.push_back("The model's walls are about " + rounded(wall) + " thick, those of the mesh " + times +
                    " that, and its mass is " + times + " the model's: a tet is " + rounded(f.mean_edge) +
                    " long. Thinner walls take more tets (" + advice.tets + "); a density divided by " +
                    rounded(f.volume_ratio) + " (--density) gives the model's mass.");
  else if (f.volume_ratio > kMost)
    notes.push_back("The mesh has " + times + " the model's volume and mass. More voxels (" + advice.voxels +
                    ") or tets (" + advice.tets + ") follow it more closely.");
  else if (f.volume_ratio < kLeast)
    notes.push_back("The mesh has only " + times +
                    " the model's volume and mass. A lower --rho-min (0.3), more voxels (" + advice.voxels +
                    ") or tets (" + advice.tets + ") keep more of it.");
}

void note_pieces(const Fidelity& f, const Advice& advice, Notes& notes) {
  if (f.torn_pieces > 0)
    notes.push_back("The mesh falls into " + counted(f.mesh_pieces, "piece") + ", " + grouped(f.torn_pieces) +
                    " more than the model has there. A lower --rho-min (0.2) or more tets (" + advice.tets +
                    ") join them; --min-part 0.05 drops small ones.");
  if (f.joined_pieces > 0)
    notes.push_back(counted(f.joined_pieces, "piece") + " of the model, which touch" +
                    (f.joined_pieces == 1 ? "es" : "") + " no other, " + (f.joined_pieces == 1 ? "is" : "are") +
                    " joined to others in the mesh. More voxels (" + advice.voxels + ") and tets (" + advice.tets +
                    ") tell narrower gaps.");
  if (f.closed && f.soup_pieces == 1 && f.mesh_tunnels > f.soup_tunnels)
    notes.push_back(counted(static_cast<std::size_t>(f.mesh_tunnels - f.soup_tunnels), "hole") + " through the mesh " +
                    (f.mesh_tunnels - f.soup_tunnels > 1 ? "are" : "is") +
                    " not in the model. A lower --rho-min (0.2), more voxels (" + advice.voxels + ") or tets (" +
                    advice.tets + ") close thin walls.");
}

void note_surface(const Fidelity& f, const Advice& advice, Notes& notes) {
  constexpr double kMostTilted = 0.1;
  if (f.overlapping_pairs > 0)
    notes.push_back(counted(f.overlapping_pairs, "pair") + " of tets of one piece lie in each other, with " +
                    percent(f.overlap_share) + " of the volume. --snap off or fewer --passes leave them apart.");
  if (f.apart_pairs > 0)
    notes.push_back(counted(f.apart_pairs, "pair") + " of tets of two pieces share a place (" + percent(f.apart_share) +
                    " of the volume), where parts that do not touch are closer than a tet: collisions begin there. "
                    "More tets (" +
                    advice.tets + ") part them.");
  if (f.flat && f.tilted_share > kMostTilted)
    notes.push_back(percent(f.tilted_share) + " of the mesh's surface is dented where the model is flat. More tets (" +
                    advice.tets + ") or another place of the lattice (--fit, --rotate) make it even.");
}

}  // namespace

void note_fidelity(const Findings& found, std::vector<std::string>& notes) {
  const Advice advice = advice_for(found);
  note_lost(found.fidelity, advice, notes);
  note_volume(found.fidelity, advice, notes);
  note_pieces(found.fidelity, advice, notes);
  note_surface(found.fidelity, advice, notes);
}

}  // namespace tetsoup
