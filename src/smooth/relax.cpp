#include "smooth/relax.h"

#include <cmath>

#include "smooth/local_model.h"

namespace tetsoup {

namespace {

// What the terms weigh against the shape of one regular tet, 1. Lengths are in mean edges, areas in their squares.
// Measured at 2,000 tets on all models: twice the distance or half the others leaves 1 degree more of roughness for
// .003 of overlap, and the other way round.
constexpr double kDistance = 2000;  // Squared distance of a boundary point from the surface, a unit of area.
constexpr double kPull = 300;       // Squared distance from a point of the soup that was let go.
constexpr double kFlat = 100;       // Squared distance of a corner from where its triangle's mean normal would have it.
constexpr double kBend = 100;       // Squared distance from where the boundary would bend as it does around.

class Relaxation {
 public:
  Relaxation(const Connectivity& links, const BoundaryAims& aims, double edge, GuardedMesh& mesh)
      : links_(links), aims_(aims), edge_(edge), to_edges_(1 / edge), mesh_(mesh) {}

  void visit(std::uint32_t v) {
    LocalModel model;
    for (const std::uint32_t tet : links_.tets[v]) add_shape(v, mesh_.mesh().tets[tet], mesh_, to_edges_, model);
    if (!links_.boundary_triangles[v].empty()) add_boundary(v, model);
    const Vec3d step = model.step() * edge_;
    if (std::isfinite(step.x + step.y + step.z)) mesh_.move(v, mesh_.at(v) + step);
  }

 private:
  /// From v to w.
  Vec3d arm(const Vec3d& v, std::uint32_t w) const { return (mesh_.at(w) - v) * to_edges_; }

  void add_boundary(std::uint32_t v, LocalModel& model) const {
    const Vec3d at = mesh_.at(v);
    Vec3d normal;
    for (const std::uint32_t triangle : links_.boundary_triangles[v]) {
      const Triangle& corners = links_.triangles[triangle];
      const std::size_t own = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
      const Vec3d b = arm(at, corners[(own + 1) % 3]), c = arm(at, corners[(own + 2) % 3]);
      normal += cross(b, c);
      const TriangleAim& aim = aims_.triangles[triangle];
      const double area = aim.area * to_edges_ * to_edges_;
      model.add_plane(aim.normal, -dot(aim.normal, b + c) / 2, kFlat * area);
      add_distance(aim, own, at, b, c, area, model);
      if (aims_.pulls.size() > 0) add_pulls(triangle, own, at, b, c, model);
    }
    if (!is_creased(v)) add_bend(v, normal, model);
  }

  bool is_creased(std::uint32_t v) const { return !aims_.creased.empty() && aims_.creased[v] != 0; }

  void add_distance(const TriangleAim& aim, std::size_t own, const Vec3d& at, const Vec3d& b, const Vec3d& c,
                    double area, LocalModel& model) const {
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Aim& sample = aim.samples[i];
      if (!sample.in_reach) continue;
      const auto& w = kSampleWeights[i];
      const double away = way_beyond(sample, w, own, at, b, c);
      // A move of the vertex moves the sample by its share of it.
      model.add_plane(sample.normal * w[own], away, kDistance * area / static_cast<double>(kSamples));
    }
  }

  /// How far a place of the triangle lies beyond dot(normal, x) = offset, in mean edges.
  template <class Plane>
  double way_beyond(const Plane& plane, const std::array<double, 3>& weights, std::size_t own, const Vec3d& at,
                    const Vec3d& b, const Vec3d& c) const {
    return (dot(plane.normal, at) - plane.offset) * to_edges_ +
           dot(plane.normal, b * weights[(own + 1) % 3] + c * weights[(own + 2) % 3]);
  }

  void add_pulls(std::uint32_t triangle, std::size_t own, const Vec3d& at, const Vec3d& b, const Vec3d& c,
                 LocalModel& model) const {
    for (const Pull& pull : aims_.pulls[triangle]) {
      const auto& w = pull.weights;
      const double away = way_beyond(pull, w, own, at, b, c);
      if (away < 0) model.add_plane(pull.normal * w[own], away, kPull);
    }
  }

  /// Mean of the arms to the neighbours on the boundary.
  Vec3d umbrella(std::uint32_t v) const {
    const auto neighbours = links_.boundary_neighbours[v];
    const Vec3d at = mesh_.at(v);
    Vec3d sum;
    for (const std::uint32_t w : neighbours) sum += arm(at, w);
    return sum * (1 / static_cast<double>(neighbours.size()));
  }

  /// How far the umbrella is from the mean one of the neighbours, along the normal.
  void add_bend(std::uint32_t v, const Vec3d& area_normal, LocalModel& model) const {
    const double size = length(area_normal);
    if (!(size > 0)) return;
    const auto neighbours = links_.boundary_neighbours[v];
    const double share = 1 / static_cast<double>(neighbours.size());
    Vec3d mean;
    double count = 0;
    for (const std::uint32_t w : neighbours) {
      if (!is_creased(w)) mean += umbrella(w), ++count;
    }
    if (count == 0) return;
    mean = mean * (1 / count);
    const Vec3d normal = area_normal * (1 / size);
    // A move of v changes its own umbrella by as much, and each neighbour's by about its share.
    const double reply = 1 + share;
    model.add_plane(normal * reply, dot(normal, mean - umbrella(v)), kBend);
  }

  const Connectivity& links_;
  const BoundaryAims& aims_;
  double edge_, to_edges_;
  GuardedMesh& mesh_;
};

}  // namespace

void relax(const Connectivity& links, const BoundaryAims& aims, double edge, Sweep sweep, GuardedMesh& mesh,
           StageWatch& watch) {
  Relaxation relaxation(links, aims, edge, mesh);
  const std::size_t count = mesh.mesh().vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kVerticesPerStep == 0) watch.step(static_cast<double>(i) / static_cast<double>(count));
    const auto v = static_cast<std::uint32_t>(sweep == Sweep::Forwards ? i : count - 1 - i);
    if (!links.tets[v].empty()) relaxation.visit(v);
  }
}

}  // namespace tetsoup
