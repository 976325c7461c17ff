#include "io/model_parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/elementary.h"
#include "base/origin.h"
#include "base/require.h"
#include "base/tet_geometry.h"
#include "base/tet_geometry.h"

namespace tetsoup {

namespace {

constexpr std::size_t kLongestName = 60;  // Of 80 that Abaqus and CalculiX take: writers and numbers add to it.

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// Whatever stands between letters and digits becomes one underscore.
std::string word_of(std::string_view wanted, std::string_view fallback) {
  std::string word;
  for (const char c : wanted) {
    if (is_letter_or_digit(c))
      word += c;
    else if (!word.empty() && word.back() != '_')
      word += '_';
  }
  if (word.ends_with('_')) word.pop_back();
  if (word.empty()) return std::string(fallback);
  if (word[0] >= '0' && word[0] <= '9') word = std::string(fallback) + '_' + word;
  return word.substr(0, kLongestName);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::vector<RegionSize> region_sizes(const TetModel& model) {
  std::vector<RegionSize> sizes(model.regions.size());
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const Material& material = model.regions[region_of(model, t)].material;
    const double volume = signed_volume(corners_of(model.mesh, model.mesh.tets[t]));
    RegionSize& size = sizes[region_of(model, t)];
    ++size.tet_count;
    size.volume += volume;
    size.mass += density_scale_of(model, t) * material.density * volume * elementary::cube(material.metres_per_unit);
  }
  return sizes;
}

double mass_of(const TetModel& model) {
  double mass = 0;
  for (const RegionSize& size : region_sizes(model)) mass += size.mass;
  return mass;
}

void require_valid(const TetModel& model) {
  const std::size_t vertices = model.mesh.vertices.size(), tets = model.mesh.tets.size();
  for (const Tet& tet : model.mesh.tets)
    for (const std::uint32_t vertex : tet)
      require(vertex < vertices, "vertex of a tet", vertex, "below the number of vertices");
  require(!model.regions.empty(), "number of regions", model.regions.size(), "at least 1");
  require(model.tet_regions.empty() || model.tet_regions.size() == tets, "number of tets with a region",
          model.tet_regions.size(), "0 or the number of tets");
  for (const std::uint32_t region : model.tet_regions)
    require(region < model.regions.size(), "region of a tet", region, "below the number of regions");
  for (const auto* scales : {&model.stiffness_scale, &model.density_scale}) {
    require(scales->empty() || scales->size() == tets, "number of tets with a scale", scales->size(),
            "0 or the number of tets");
    for (const float scale : *scales) require(scale > 0 && std::isfinite(scale), "scale of a tet", scale, "above 0");
  }
  require(model.midsides.places.size() == model.midsides.edges.size(), "number of nodes of edges",
          model.midsides.places.size(), "that of the edges");
  require(model.midsides.edges.empty() || model.midsides.edges == unique_edges(model.mesh), "edges with nodes",
          model.midsides.edges.size(), "those of the mesh");
  for (const VertexSet& pin : model.pins)
    for (const std::uint32_t vertex : pin.vertices)
      require(vertex < vertices, "pinned vertex", vertex, "below the number of vertices");
  const Embedding& embedding = model.embedding;
  require(embedding.weights.size() == embedding.tets.size(), "number of embedded points with weights",
          embedding.weights.size(), "the number of those with a tet");
  for (const std::uint32_t tet : embedding.tets)
    require(tet < tets, "tet of an embedded point", tet, "below the number of tets");
}

std::vector<std::vector<std::uint32_t>> tets_by_region(const TetModel& model) {
  std::vector<std::vector<std::uint32_t>> lists(model.regions.size());
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
    lists[region_of(model, t)].push_back(static_cast<std::uint32_t>(t));
  return lists;
}

std::vector<std::uint32_t> pin_marks(const TetModel& model) {
  std::vector<std::uint32_t> marks(model.mesh.vertices.size());
  for (std::size_t i = model.pins.size(); i-- > 0;)
    for (const std::uint32_t vertex : model.pins[i].vertices) marks[vertex] = static_cast<std::uint32_t>(i + 1);
  return marks;
}

std::vector<std::uint32_t> pinned_vertices(const TetModel& model) {
  const std::vector<std::uint32_t> marks = pin_marks(model);
  std::vector<std::uint32_t> vertices;
  for (std::size_t v = 0; v < marks.size(); ++v)
    if (marks[v] != 0) vertices.push_back(static_cast<std::uint32_t>(v));
  return vertices;
}

std::vector<std::array<std::uint32_t, 2>> unique_edges(const TetMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(6 * mesh.tets.size());
  for (const Tet& tet : mesh.tets)
    for (const auto& edge : kTetEdges) {
      const std::uint32_t a = tet[static_cast<std::size_t>(edge[0])], b = tet[static_cast<std::size_t>(edge[1])];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<std::array<std::uint32_t, 10>> ten_nodes(const TetModel& model) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kOrder{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  const auto& edges = model.midsides.edges;
  std::vector<std::array<std::uint32_t, 10>> nodes;
  for (const Tet& tet : model.mesh.tets) {
    auto& own = nodes.emplace_back();
    std::copy(tet.begin(), tet.end(), own.begin());
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = std::minmax(tet[kOrder[e][0]], tet[kOrder[e][1]]);
      const auto place = std::lower_bound(edges.begin(), edges.end(), std::array{a, b}) - edges.begin();
      own[4 + e] = static_cast<std::uint32_t>(model.mesh.vertices.size() + static_cast<std::size_t>(place));
    }
  }
  return nodes;
}

std::vector<Vec3d> placed_nodes(const TetModel& model) {
  std::vector<Vec3d> points = placed_points(model.mesh.vertices, model.mesh.origin);
  const std::vector<Vec3d> between = placed_points(model.midsides.places, model.mesh.origin);
  points.insert(points.end(), between.begin(), between.end());
  return points;
}

std::vector<std::uint32_t> nodes_of(const TetModel& model, const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint8_t> is_in(model.mesh.vertices.size(), 0);
  for (const std::uint32_t v : vertices) is_in[v] = 1;
  std::vector<std::uint32_t> nodes = vertices;
  for (std::size_t e = 0; e < model.midsides.edges.size(); ++e) {
    const auto [a, b] = model.midsides.edges[e];
    if (is_in[a] != 0 && is_in[b] != 0) nodes.push_back(static_cast<std::uint32_t>(model.mesh.vertices.size() + e));
  }
  return nodes;
}

LegalNames::LegalNames(std::initializer_list<std::string_view> reserved) {
  for (const std::string_view name : reserved) used_.push_back(lower(std::string(name)));
}

std::string LegalNames::make(std::string_view wanted, std::string_view fallback) {
  const std::string word = word_of(wanted, fallback);
  std::string name = word;
  for (int number = 2; std::find(used_.begin(), used_.end(), lower(name)) != used_.end(); ++number)
    name = word + '_' + std::to_string(number);
  used_.push_back(lower(name));
  return name;
}

std::vector<std::string> region_names(const TetModel& model, LegalNames& names) {
  std::vector<std::string> made;
  for (const Region& region : model.regions) made.push_back(names.make(region.name, "region"));
  return made;
}

std::vector<std::string> pin_names(const TetModel& model, LegalNames& names) {
  std::vector<std::string> made;
  for (const VertexSet& pin : model.pins) made.push_back(names.make(pin.name, "pin"));
  return made;
}

Material in_mesh_units(const Material& material) {
  const double unit = material.metres_per_unit;
  Material scaled = material;
  scaled.density *= unit * unit * unit;  // kg/m^3
  scaled.young *= unit;                  // Pa = kg/(m s^2)
  return scaled;
}

void recentre(TetModel& model) {
  model.render.vertices = recounted(model.render.vertices, model.render.origin, model.mesh.origin);
  model.render.origin = {};
  model.mesh.origin = {};
}

}  // namespace tetsoup
