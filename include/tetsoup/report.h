// tetsoup::io: what every stage has to say, as JSON for scripts and pages. Member names are a promise; numbers that do
// not exist (NaN, infinity) are null; angles are degrees.
#pragma once

#include <string>

#include "tetsoup/pipeline.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

/// "closed", "open", "soup" or "empty".
const char* soup_class_name(SoupClass kind);

std::string to_json(const SoupReport& soup);
std::string to_json(const DistanceField& field);  ///< Its grid, and the memory that takes.
std::string to_json(const PseudoVolumeReport& report);
std::string to_json(const LatticeReport& report);
std::string to_json(const SmoothReport& report);
std::string to_json(const Quality& quality);
std::string to_json(const Readiness& readiness, const Material& material);
std::string to_json(const EmbedReport& report);
std::string to_json(const MeshOptions& options);
std::string to_json(const SimulationReport& report);
std::string to_json(const Energy& energy);
/// Arrays: name, material and number of tets of every region; name and number of vertices of all pins.
std::string regions_json(const TetModel& model);
std::string pins_json(const TetModel& model);

}  // namespace tetsoup
