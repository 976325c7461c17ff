#include <array>
#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "base/base64.h"
#include "base/origin.h"
#include "report/page_template.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/quality.h"
#include "tetsoup/readiness.h"
#include "tetsoup/report.h"

namespace tetsoup {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

template <class T>
std::string encoded(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::string text;
  append_base64(text, {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  return text;
}

Json mesh_json(const TetMesh& mesh) {
  constexpr auto kDegrees = static_cast<float>(180 / std::numbers::pi);
  std::vector<float> angles;
  angles.reserve(mesh.tets.size());
  for (const TetQuality& tet : measure_tets(mesh)) angles.push_back(tet.min_dihedral * kDegrees);
  return {{"vertices", encoded<Vec3>(mesh.vertices)},
          {"tets", encoded<Tet>(mesh.tets)},
          {"angles", encoded<float>(angles)}};
}

Json surface_json(const TriangleSoup* soup, const Vec3d& origin) {
  if (!soup || soup->triangles.empty()) return nullptr;
  return {{"vertices", encoded<Vec3>(recounted(soup->vertices, soup->origin, origin))},
          {"triangles", encoded<Triangle>(soup->triangles)}};
}

Json parsed(const ReportPage& page) {
  Json json = Json::parse(page.json.empty() ? "{}" : page.json, nullptr, false);
  if (!json.is_object()) throw InvalidInput("report: json is not a JSON object");
  if (json.contains("quality") && json.contains("readiness")) return json;
  const Quality quality = measure_quality(*page.mesh);
  const Material material;
  json["quality"] = Json::parse(to_json(quality));
  json["readiness"] = Json::parse(to_json(assess_readiness(*page.mesh, quality, material), material));
  return json;
}

/// Inside a script element only "</" and "<!" could end or change it; in JSON's texts "<" may be written otherwise.
std::string without_tags(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string report_page(const ReportPage& page) {
  if (!page.mesh) throw InvalidInput("report: there is no mesh");
  if (page.up != "x" && page.up != "y" && page.up != "z")
    throw InvalidInput("report: up is \"" + page.up + "\"; give x, y or z");
  const Json data{{"title", page.title},
                  {"version", TETSOUP_VERSION},
                  {"up", page.up},
                  {"metres_per_unit", page.metres_per_unit},
                  {"mesh", mesh_json(*page.mesh)},
                  {"surface", surface_json(page.soup, page.mesh->origin)},
                  {"report", parsed(page)}};
  std::string html(page_template::kBeforeData);
  html += without_tags(data.dump(-1, ' ', false, Json::error_handler_t::replace));
  return html.append(page_template::kAfterData);
}

void write_report_page(const std::filesystem::path& path, const ReportPage& page) {
  const std::string html = report_page(page);
  write_file_atomic(path, std::as_bytes(std::span(html)));
}

}  // namespace tetsoup
