// 3MF: the objects that are to be built, where the build puts them, with their components; in the file's own unit.
#include "io/instance_budget.h"
#include "io/threemf_package.h"

namespace tetsoup::readers {
namespace {

using threemf::Object, threemf::Package, threemf::Part, threemf::Placement;

template <class Sink>
class ObjectBuilder {
 public:
  ObjectBuilder(std::string_view name, const Package& package, Sink& sink)
      : name_(name), package_(package), budget_(name, package.unpacked_bytes), sink_(sink) {}

  void add(const Placement& placement, const Affine& parent, const std::string& parent_name, std::size_t depth) {
    if (depth > kDeepestNesting) fail(name_, "its components are nested too deeply, or in a circle");
    const auto part = package_.parts.find(placement.part);
    const auto found = part->second.objects.find(placement.object);
    if (found == part->second.objects.end())
      fail(name_, "object " + in_quotes(placement.object.substr(0, 32)) + " does not exist");
    const Object& object = found->second;
    const Affine place = parent * placement.place;
    const std::string& own_name = object.name.empty() ? parent_name : object.name;
    budget_.take(object.vertices.size(), object.triangles.size());
    if (!object.triangles.empty()) add_surface(part->second, object, place, own_name);
    for (const Placement& component : object.components) add(component, place, own_name, depth + 1);
  }

 private:
  /// An index beyond the object's own vertices must not reach the next one's.
  void add_surface(const Part& part, const Object& object, const Affine& place, const std::string& object_name) {
    const std::size_t first = sink_.vertex_count();
    for (const Vec3d& vertex : object.vertices) sink_.add_vertex(place.apply(vertex));
    if constexpr (Sink::kDetails) sink_.set_object(object_name);
    std::uint32_t material = 0;
    if constexpr (Sink::kDetails) sink_.set_material("");
    for (std::size_t i = 0; i < object.triangles.size(); ++i) {
      if constexpr (Sink::kDetails) {
        if (object.materials[i] != material) sink_.set_material(part.materials[object.materials[i]]);
        material = object.materials[i];
      }
      Triangle triangle = object.triangles[i];
      for (std::uint32_t& corner : triangle)
        corner = corner < object.vertices.size() ? vertex_index(static_cast<std::int64_t>(first + corner)) : kNoVertex;
      sink_.add_triangle(triangle[0], triangle[1], triangle[2]);
    }
  }

  std::string_view name_;
  const Package& package_;
  InstanceBudget budget_;
  Sink& sink_;
};

}  // namespace

template <class Sink>
void read_3mf(const Source& source, Sink& sink) {
  const Package package = threemf::read_package(source);
  const Part& root = package.parts.at(package.root);
  ObjectBuilder<Sink> builder(source.name, package, sink);
  for (const Placement& item : root.items) builder.add(item, {}, "", 0);
  if (!root.items.empty()) return;
  for (const auto& [id, object] : root.objects) builder.add({package.root, id, {}}, {}, "", 0);
}

template void read_3mf(const Source&, SoupSink&);
template void read_3mf(const Source&, MeshSink&);

}  // namespace tetsoup::readers
