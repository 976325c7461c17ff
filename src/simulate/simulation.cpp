#include "tetsoup/simulate.h"

#include <cmath>

#include "base/parallel.h"
#include "base/require.h"
#include "simulate/build.h"
#include "simulate/check.h"
#include "simulate/measures.h"
#include "simulate/saved_state.h"
#include "simulate/substep.h"

namespace tetsoup {

using namespace simulate;

struct Simulation::State {
  World world;

  const Body& body(std::size_t number) const {
    require(number < world.bodies.size(), "body", number, "the number of a body that was added");
    return world.bodies[number];
  }
  /// kNoSlot for a loose vertex.
  std::uint32_t slot_of(const BodyVertex& v) const {
    const Body& b = body(v.body);
    require(v.vertex < b.slots.size(), "vertex", v.vertex, "one of the body's vertices");
    return b.slots[v.vertex];
  }
  Spring& spring(std::size_t number) {
    require(number < world.springs.size() && world.springs[number].stiffness > 0, "spring", number,
            "the number of a spring that was added and not removed");
    return world.springs[number];
  }
};

namespace {

/// When contacts are looked for within a step, in substeps.
struct ContactTimes {
  int interval = 1, edges_interval = 1;

  ContactTimes(const World& world, double h) {
    const auto substeps = [&](double time) {
      constexpr double kRounding = 1e-9;
      return std::min(std::ceil(time / h * (1 - kRounding)), 60.0 * kMaxSubsteps);
    };
    interval = static_cast<int>(substeps(world.options.contact_interval * longest_substep(world)));
    // Edges once in 1/60 s, with a search for vertices.
    edges_interval = interval * static_cast<int>(std::ceil(substeps(kSubstepsTime) / interval));
  }
  bool is_due(int substep) const { return substep % interval == 0; }
  Edges edges_at(int substep) const { return substep % edges_interval == 0 ? Edges::Find : Edges::Keep; }
};

}  // namespace

Simulation::Simulation(const SimulationOptions& options) : state_(std::make_unique<State>()) {
  check(options);
  state_->world.options = options;
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

std::size_t Simulation::add_body(const TetMesh& mesh, const SimMaterial& material, const Pose& pose) {
  return add_bodies(mesh, material, std::span(&pose, 1));
}

std::size_t Simulation::add_bodies(const TetMesh& mesh, const SimMaterial& material, std::span<const Pose> poses) {
  const std::size_t first = state_->world.bodies.size();
  World& world = state_->world;
  simulate::add_bodies(world, mesh, material, poses);
  for (std::size_t i = first; i < world.bodies.size(); ++i) publish(world, world.bodies[i]);
  return first;
}

void Simulation::add_plane(const Vec3d& normal, double offset, double friction) {
  check_point(normal, "normal", kMaxCoordinate);
  const double size = length(normal);
  require(size > 0, "length of the normal", size, "above 0");
  require(std::abs(offset) <= kMaxCoordinate * size, "offset", offset, "at most 1e5 m from the origin");
  check_friction(friction);
  state_->world.obstacles.push_back({normal * (1 / size), offset / size, friction, {}});
}

void Simulation::add_obstacle(const TriangleSoup& soup, int voxels, double friction, const Progress& progress) {
  check_friction(friction);
  state_->world.obstacles.push_back({{}, 0, friction, signed_distance(soup, voxels, progress)});
}

void Simulation::pin(const BodyVertex& vertex) {
  const std::uint32_t slot = state_->slot_of(vertex);
  if (slot != kNoSlot) hold_vertex(state_->world, slot, Hold::Held);
}

void Simulation::unpin(const BodyVertex& vertex) {
  const std::uint32_t slot = state_->slot_of(vertex);
  if (slot != kNoSlot) hold_vertex(state_->world, slot, Hold::Free);
}

void Simulation::attach(const BodyVertex& a, const BodyVertex& b) {
  const std::uint32_t first = state_->slot_of(a), second = state_->slot_of(b);
  require(first != kNoSlot && second != kNoSlot, "vertex", first == kNoSlot ? a.vertex : b.vertex,
          "one that a simulated tet has");
  state_->world.attachments.push_back({first, second});
}

std::size_t Simulation::add_spring(const BodyVertex& vertex, const Vec3d& target, double stiffness) {
  const std::uint32_t slot = state_->slot_of(vertex);
  require(slot != kNoSlot, "vertex", vertex.vertex, "one that a simulated tet has");
  check_point(target, "target", kMaxCoordinate);
  require(stiffness > 0 && stiffness <= kMaxSpring, "stiffness", stiffness, "above 0 and at most 1e12 N/m");
  state_->world.springs.push_back({slot, target, stiffness});
  return state_->world.springs.size() - 1;
}

void Simulation::move_spring(std::size_t spring, const Vec3d& target) {
  check_point(target, "target", kMaxCoordinate);
  state_->spring(spring).target = target;
}

void Simulation::remove_spring(std::size_t spring) {
  state_->spring(spring).stiffness = 0;
}

void Simulation::step(double dt, const Progress& progress) {
  require(dt > 0 && dt <= 1, "dt", dt, "above 0 and at most 1 s");
  World& world = state_->world;
  const int stretches = choose_schemes(world) ? count_stretches(world, dt) : 1;
  const int per_stretch = (count_substeps(world, dt) + stretches - 1) / stretches, substeps = per_stretch * stretches;
  const double h = dt / substeps;
  const ContactTimes times(world, h);
  prepare_substeps(world, h);
  StageWatch watch(progress, "simulate");
  int done = 0;
  try {
    watch.enter_part(0, 0);
    for (int i = 0; i < substeps; ++i) {
      if (times.is_due(i)) {
        arrive(world);
        find_contacts(world, h * std::min(times.interval, substeps - i), times.edges_at(i), watch);
      }
      move_freely(world, h, {h * per_stretch, i % per_stretch == 0});
      solve_springs(world, h);
      solve_contacts(world, h);
      solve_attachments(world, h);
      done = i + 1;
      const double share = static_cast<double>(done) / substeps;
      watch.enter_part(share, share);
    }
  } catch (const Cancelled&) {  // thrown again below: whole substeps are kept
  }
  world.time += done == substeps ? dt : done * h;
  world.report.substeps = done;
  end_stretch(world);
  arrive(world);
  publish(world);
  watch.throw_if_stopped();
}

std::size_t Simulation::body_count() const {
  return state_->world.bodies.size();
}

double Simulation::time() const {
  return state_->world.time;
}

std::span<const Vec3> Simulation::positions(std::size_t body) const {
  return state_->body(body).positions;
}

std::span<const Vec3> Simulation::velocities(std::size_t body) const {
  return state_->body(body).velocities;
}

void Simulation::set_positions(std::size_t body, std::span<const Vec3> positions) {
  World& world = state_->world;
  const std::vector<std::uint32_t>& slots = state_->body(body).slots;
  require(positions.size() == slots.size(), "positions", positions.size(), "as many as the body has vertices");
  for (const Vec3& p : positions) check_point(to_double(p), "position", kMaxCoordinate);
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (slots[v] == kNoSlot) continue;
    kernel::Place& place = world.places[slots[v]];
    place = {positions[v].x, positions[v].y, positions[v].z, place.inverse_mass};
    world.remainders[slots[v]] = {};
  }
  publish(world, world.bodies[body]);
}

void Simulation::set_velocities(std::size_t body, std::span<const Vec3> velocities) {
  World& world = state_->world;
  const std::vector<std::uint32_t>& slots = state_->body(body).slots;
  require(velocities.size() == slots.size(), "velocities", velocities.size(), "as many as the body has vertices");
  for (const Vec3& v : velocities) check_point(to_double(v), "velocity", kMaxSpeed);
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (slots[v] == kNoSlot) continue;
    kernel::Motion& motion = world.motions[slots[v]];
    motion = {velocities[v].x, velocities[v].y, velocities[v].z, motion.mass};
  }
  publish(world, world.bodies[body]);
}

const SimulationReport& Simulation::report() const {
  state_->world.report.clamped = 0;
  for (const Part& part : state_->world.parts) state_->world.report.clamped += part.clamped;
  return state_->world.report;
}

Energy Simulation::energy() const {
  return measure_energy(state_->world);
}

Momentum Simulation::momentum() const {
  return measure_momentum(state_->world, 0, state_->world.parts.size());
}

Momentum Simulation::momentum(std::size_t body) const {
  const Body& b = state_->body(body);
  return measure_momentum(state_->world, b.first_part, b.part_count);
}

double Simulation::volume(std::size_t body) const {
  return measure_volume(state_->world, state_->body(body));
}

std::uint64_t Simulation::state_hash() const {
  return hash_state(state_->world);
}

std::vector<std::byte> Simulation::save_state() const {
  return simulate::save_state(state_->world);
}

void Simulation::restore_state(std::span<const std::byte> state) {
  simulate::restore_state(state_->world, state);
  publish(state_->world);
}

}  // namespace tetsoup
