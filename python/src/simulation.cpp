// Bodies that fall, bend and collide. Python's side lets one thread at a time in.
#include "tetsoup/simulate.h"

#include "arrays.h"
#include "bindings.h"
#include "options.h"
#include "progress.h"
#include "records.h"

namespace tetsoup::python {

namespace {

using Triple = std::array<double, 3>;

Vec3d vector_of(const Triple& v) {
  return {v[0], v[1], v[2]};
}

/// The simulation's own memory, which stays where it is for as long as `owner`, the simulation, lives.
Rows<float, 3> view_of(std::span<const Vec3> rows, nb::handle owner) {
  return Rows<float, 3>(reinterpret_cast<const float*>(rows.data()), {rows.size(), std::size_t{3}}, owner);
}

std::size_t add_bodies(Simulation& self, const TetMesh& mesh, nb::dict material, nb::list poses) {
  const SimMaterial made_of = read_material(material);
  std::vector<Pose> placed;
  for (const nb::handle pose : poses) placed.push_back(read_pose(nb::cast<nb::dict>(pose)));
  return call_unlocked([&] { return self.add_bodies(mesh, made_of, placed); });
}

void add_obstacle(Simulation& self, PointsIn vertices, FacesIn faces, std::optional<int> voxels,
                  std::optional<double> friction, nb::object progress) {
  const TriangleSoup soup = copy_soup(vertices, faces);
  call_library(progress, [&](const Progress& watch) {
    self.add_obstacle(soup, voxels.value_or(kDefaultObstacleVoxels), friction.value_or(kDefaultFriction), watch);
  });
}

nb::bytes save_state(const Simulation& self) {
  const std::vector<std::byte> state = call_unlocked([&] { return self.save_state(); });
  return nb::bytes(state.data(), state.size());
}

void restore_state(Simulation& self, nb::bytes state) {
  const std::span bytes(static_cast<const std::byte*>(state.data()), state.size());
  call_unlocked([&] { self.restore_state(bytes); });
}

void bind_results(nb::module_& m) {
  using E = Energy;
  Record<E>(m, "Energy", "Of all bodies of a simulation, J; pinned vertices and springs do not count.")
      .field("kinetic", &E::kinetic, "Of motion.")
      .field("elastic", &E::elastic, "Of deformation.")
      .field("gravity", &E::gravity, "Potential; zero at the origin.")
      .field("total", &E::total, "Of the three.");
  using M = Momentum;
  Record<M>(m, "Momentum", "Of one body or all.")
      .field("linear", &M::linear, "(x, y, z), kg m/s.")
      .field("angular", &M::angular, "(x, y, z), kg m^2/s, about the origin.");
  using R = SimulationReport;
  Record<R>(m, "SimulationReport", "What is simulated, and what the last step did.")
      .field("tet_count", &R::tet_count, "That are simulated.")
      .field("left_out", &R::left_out, "Tets without positive volume, or invalid.")
      .field("loose_vertices", &R::loose_vertices, "Of no simulated tet; they stay where they are placed.")
      .field("parts", &R::parts, "Pieces that share no vertex.")
      .field("substeps", &R::substeps, "Of the last step.")
      .field("contacts", &R::contacts, "Between bodies, that pushed in the last substep.")
      .field("touching", &R::touching, "With obstacles, that pushed in the last substep.")
      .field("clamped", &R::clamped, "Times a vertex was held back since it was to move unreasonably far.");
}

void bind_scene(nb::class_<Simulation>& simulation) {
  using S = Simulation;
  simulation.def("__init__", [](S* self, nb::dict options) { new (self) S(read_simulation_options(options)); })
      .def("add_bodies", &add_bodies)
      .def(
          "add_plane",
          [](S& self, const Triple& normal, double offset, std::optional<double> friction) {
            self.add_plane(vector_of(normal), offset, friction.value_or(kDefaultFriction));
          },
          nb::arg("normal"), nb::arg("offset"), nb::arg("friction").none())
      .def("add_obstacle", &add_obstacle, nb::arg("vertices"), nb::arg("faces"), nb::arg("voxels").none(),
           nb::arg("friction").none(), nb::arg("progress").none())
      .def("pin",
           [](S& self, std::size_t body, IndicesIn vertices) {
             for (const std::uint32_t v : span_of<std::uint32_t>(vertices)) self.pin({body, v});
           })
      .def("unpin",
           [](S& self, std::size_t body, IndicesIn vertices) {
             for (const std::uint32_t v : span_of<std::uint32_t>(vertices)) self.unpin({body, v});
           })
      .def("attach",
           [](S& self, std::size_t body, std::uint32_t vertex, std::size_t other_body, std::uint32_t other_vertex) {
             self.attach({body, vertex}, {other_body, other_vertex});
           })
      .def("add_spring",
           [](S& self, std::size_t body, std::uint32_t vertex, const Triple& target, double stiffness) {
             return self.add_spring({body, vertex}, vector_of(target), stiffness);
           })
      .def("move_spring",
           [](S& self, std::size_t spring, const Triple& target) { self.move_spring(spring, vector_of(target)); })
      .def("remove_spring", &S::remove_spring);
}

}  // namespace

void bind_simulation(nb::module_& m) {
  using S = Simulation;
  bind_results(m);
  nb::class_<S> simulation(m, "Simulation");
  bind_scene(simulation);
  simulation
      .def("step",
           [](S& self, double dt) { call_library(nb::none(), [&](const Progress& watch) { self.step(dt, watch); }); })
      .def("body_count", &S::body_count)
      .def("time", &S::time)
      .def("positions", [](nb::handle_t<S> self,
                           std::size_t body) { return view_of(nb::cast<const S&>(self).positions(body), self); })
      .def("velocities", [](nb::handle_t<S> self,
                            std::size_t body) { return view_of(nb::cast<const S&>(self).velocities(body), self); })
      .def("set_positions",
           [](S& self, std::size_t body, PointsIn rows) { self.set_positions(body, span_of<Vec3>(rows)); })
      .def("set_velocities",
           [](S& self, std::size_t body, PointsIn rows) { self.set_velocities(body, span_of<Vec3>(rows)); })
      .def("report", [](const S& self) { return self.report(); })
      .def("energy", [](const S& self) { return call_unlocked([&] { return self.energy(); }); })
      .def("momentum", [](const S& self) { return self.momentum(); })
      .def("momentum_of", [](const S& self, std::size_t body) { return self.momentum(body); })
      .def("volume", &S::volume)
      .def("state_hash", &S::state_hash)
      .def("save_state", &save_state)
      .def("restore_state", &restore_state);
}

}  // namespace tetsoup::python
