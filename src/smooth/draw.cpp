#include "smooth/draw.h"

#include <cmath>

#include "base/groups.h"
#include "smooth/local_model.h"

namespace tetsoup {
namespace {

// Squared distance of an aim from its plane, a unit of area, against the shape of one regular tet, 1, with lengths in
// mean edges: as where the boundary is fitted.
constexpr double kDistance = 2000;

class Drawing {
 public:
  Drawing(const Connectivity& links, std::span<const FaceAim> aims, GuardedMesh& mesh)
      : links_(links),
        aims_(aims),
        edge_(mean_edge(links, mesh)),
        mesh_(mesh),
        of_vertex_(mesh.mesh().vertices.size(), [&](const auto& put) {
          for (std::uint32_t i = 0; i < aims.size(); ++i)
            for (const std::uint32_t v : aims[i].corners) put(v, i);
        }) {}

  void visit(std::uint32_t v) {
    LocalModel model;
    for (const std::uint32_t tet : links_.tets[v]) add_shape(v, mesh_.mesh().tets[tet], mesh_, 1 / edge_, model);
    for (const std::uint32_t i : of_vertex_[v]) add_aim(v, aims_[i], model);
    const Vec3d step = model.step() * edge_;
    if (std::isfinite(step.x + step.y + step.z)) mesh_.move(v, mesh_.at(v) + step);
  }

 private:
  void add_aim(std::uint32_t v, const FaceAim& aim, LocalModel& model) const {
    Vec3d at;
    double own = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      at += mesh_.at(aim.corners[i]) * aim.weights[i];
      if (aim.corners[i] == v) own = aim.weights[i];
    }
    // A move of the vertex moves the point by its share of it.
    model.add_plane(aim.normal * own, (dot(aim.normal, at) - aim.offset) / edge_,
                    kDistance * aim.area / (edge_ * edge_));
  }

  const Connectivity& links_;
  std::span<const FaceAim> aims_;
  double edge_;
  GuardedMesh& mesh_;
  Groups<std::uint32_t> of_vertex_;  ///< Aims.
};

}  // namespace

double mean_edge(const Connectivity& links, const GuardedMesh& mesh) {
  double sum = 0, count = 0;
  for (std::uint32_t v = 0; v < mesh.mesh().vertices.size(); ++v) {
    for (const std::uint32_t w : links.neighbours[v]) sum += length(mesh.at(v) - mesh.at(w)), ++count;
  }
  return sum / count;
}

void draw(const Connectivity& links, std::span<const FaceAim> aims, GuardedMesh& mesh, StageWatch& watch) {
  Drawing drawing(links, aims, mesh);
  const std::size_t count = mesh.mesh().vertices.size();
  for (std::size_t i = 0; i < 2 * count; ++i) {
    if (i % kVerticesPerStep == 0) watch.step(static_cast<double>(i) / static_cast<double>(2 * count));
    const auto v = static_cast<std::uint32_t>(i < count ? i : 2 * count - 1 - i);
    if (!links.tets[v].empty()) drawing.visit(v);
  }
}

}  // namespace tetsoup
