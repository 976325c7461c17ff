// The pieces of a model in USD; see usda_text.cpp for the whole.
#pragma once

#include <string>

#include "io/model_parts.h"
#include "io/usda_writer.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

/// The input's own surface, with where its vertices lie in the tets if the model says so. Faces with a vertex that does
/// not exist are left out.
void write_usda_render_mesh(UsdaWriter& usd, const TetModel& model);

/// `float3[] extent` of the finite points.
void write_usda_extent(UsdaWriter& usd, std::span<const Vec3> points);

/// Elements of a geometry under a name: `type` is "face", "point" or "tetrahedron".
void write_usda_subset(UsdaWriter& usd, LegalNames& names, const std::string& name, std::string_view type,
                       std::string_view family, const std::vector<std::uint32_t>& elements);

}  // namespace tetsoup
