// Collada: the chosen scene's geometries where its nodes put them, in metres and with z up, as the file says what its
// unit and its axes are. Skins stand in the pose they were bound in.
#include <algorithm>

#include "io/collada_document.h"
#include "io/instance_budget.h"

namespace tetsoup::readers {
namespace {

using namespace collada;

template <class Sink>
class SceneBuilder {
 public:
  SceneBuilder(const Source& source, const Document& document, Sink& sink)
      : name_(source.name), document_(document), budget_(source.name, source.bytes.size()), sink_(sink) {}

  void add_node(std::size_t index, const Affine& parent, std::size_t depth) {
    if (depth > kDeepestNesting) fail(name_, "its nodes are nested too deeply, or in a circle");
    budget_.take(0, 0);
    const Node& node = document_.nodes[index];
    const Affine place = parent * node.place;
    for (const Shown& shown : node.geometries) add_geometry(shown.id, shown, place, node.name);
    for (const Shown& shown : node.controllers) add_controller(shown, node.name);
    for (const std::size_t child : node.children) add_node(child, place, depth + 1);
    for (const Shown& shown : node.nodes) {
      const auto found = document_.node_of_id.find(shown.id);
      if (found == document_.node_of_id.end()) fail_missing("node", shown.id);
      add_node(found->second, place, depth + 1);
    }
  }

  void add_geometry(const std::string& id, const Shown& shown, const Affine& place, const std::string& node_name) {
    const auto found = document_.geometries.find(id);
    if (found == document_.geometries.end()) fail_missing("geometry", id);
    const Geometry& geometry = found->second;
    std::size_t corners = 0;
    for (const Primitives& primitives : geometry.primitives) corners += primitives.corners.size();
    budget_.take(geometry.vertices.size(), corners);
    if (corners == 0) return;
    if constexpr (Sink::kDetails) sink_.set_object(node_name.empty() ? geometry.name : node_name);
    first_ = sink_.vertex_count();
    count_ = geometry.vertices.size();
    for (const Vec3d& vertex : geometry.vertices) sink_.add_vertex(place.apply(vertex));
    for (const Primitives& primitives : geometry.primitives) add_primitives(primitives, shown);
  }

 private:
  /// Its node does not move it: its bones do.
  void add_controller(const Shown& shown, const std::string& node_name) {
    auto found = document_.controllers.find(shown.id);
    if (found == document_.controllers.end()) fail_missing("controller", shown.id);
    Affine bound = found->second.bound;
    // A skin of morph targets, and no longer chain.
    const auto inner = document_.controllers.find(found->second.geometry);
    if (inner != document_.controllers.end()) found = inner;
    add_geometry(found->second.geometry, shown, base_place() * bound, node_name);
  }

 public:
  Affine base_place() const {
    Affine scale;
    for (std::size_t i = 0; i < 3; ++i) scale.rows[i][i] = document_.metres;
    return document_.upright * scale;
  }

 private:
  void add_primitives(const Primitives& primitives, const Shown& shown) {
    if constexpr (Sink::kDetails) {
      const auto bound = shown.materials.find(primitives.material);
      const auto material = document_.materials.find(bound == shown.materials.end() ? "" : bound->second);
      sink_.set_material(material == document_.materials.end() ? primitives.material : material->second);
    }
    std::size_t at = 0;
    for (const std::uint32_t size : primitives.sizes) {
      const std::size_t end = at + std::min<std::size_t>(size, primitives.corners.size() - at);
      if (primitives.kind == Kind::Strips) {
        Strip<Sink> strip(sink_);
        for (; at < end; ++at) strip.add(corner(primitives.corners[at]));
      } else if (primitives.kind == Kind::Fans) {
        Fan<Sink> fan(sink_);
        for (; at < end; ++at) fan.add(corner(primitives.corners[at]));
      } else {
        typename Sink::Polygon polygon(sink_);
        for (; at < end; ++at) polygon.add(corner(primitives.corners[at]));
        polygon.finish();
      }
    }
  }

  /// An index beyond the geometry's own vertices must not reach the next one's.
  std::uint32_t corner(std::uint32_t index) const {
    return index < count_ ? vertex_index(static_cast<std::int64_t>(first_ + index)) : kNoVertex;
  }

  [[noreturn]] void fail_missing(const char* what, const std::string& id) const {
    fail(name_, std::string(what) + " " + in_quotes(id.substr(0, 64)) + " does not exist");
  }

  std::string_view name_;
  const Document& document_;
  InstanceBudget budget_;
  std::size_t first_ = 0, count_ = 0;
  Sink& sink_;
};

}  // namespace

bool is_collada(std::span<const std::byte> bytes) {
  constexpr std::size_t kProbe = 4096;  // bytes of declarations and comments to look behind
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(kProbe, bytes.size()));
  const std::size_t begin = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return begin != text.npos && text[begin] == '<' && text.find("<COLLADA") != text.npos;
}

template <class Sink>
void read_collada(const Source& source, Sink& sink) {
  const Document document = collada::read_document(source);
  SceneBuilder<Sink> builder(source, document, sink);
  const Affine base = builder.base_place();
  auto scene = document.scenes.find(document.scene);
  if (scene == document.scenes.end()) scene = document.scenes.begin();
  if (scene != document.scenes.end()) {
    for (const std::size_t node : scene->second) builder.add_node(node, base, 0);
    return;
  }
  for (const auto& [id, geometry] : document.geometries) builder.add_geometry(id, {}, base, "");
}

template void read_collada(const Source&, SoupSink&);
template void read_collada(const Source&, MeshSink&);

}  // namespace tetsoup::readers
