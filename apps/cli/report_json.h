// The reports for scripts. Member names are a promise; numbers that do not exist (NaN, infinity) are null.
#pragma once

#include <string>
#include <vector>

#include "mesh_run.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"
#include "tetsoup/soup.h"

namespace tetsoup::cli {

std::string mesh_report_json(const MeshRun& run);
std::string soup_report_json(const std::string& input, const SoupReport& report, const std::vector<PartName>& parts);
std::string tets_report_json(const std::string& input, const Quality& quality, const Readiness& readiness,
                             const Material& material);

/// "object", "group" or "material".
const char* kind_name(PartKind kind);

}  // namespace tetsoup::cli
