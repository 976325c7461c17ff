#include "simulate/build.h"

#include <cmath>
#include <iterator>

#include "base/elementary.h"
#include "base/require.h"
#include "simulate/check.h"

namespace tetsoup::simulate {
namespace {

struct Quaternion {
  Vec3d v;
  double w = 1;

  Quaternion operator*(const Quaternion& o) const { return {v * o.w + o.v * w + cross(v, o.v), w * o.w - dot(v, o.v)}; }
  Vec3d turned(const Vec3d& p) const { return p + cross(v, cross(v, p) + p * w) * 2; }
};

/// About x, then y, then z.
Quaternion rotation_of(const Vec3d& angles) {
  const auto half = [](double angle, const Vec3d& axis) {
    return Quaternion{axis * elementary::sin(angle / 2), elementary::cos(angle / 2)};
  };
  return half(angles.z, {0, 0, 1}) * half(angles.y, {0, 1, 0}) * half(angles.x, {1, 0, 0});
}

/// What bodies of one mesh and scale share.
struct Make {
  std::vector<Rest> rests;
  std::vector<RestSurface> surfaces;
  std::vector<SpringNet> nets;
  Vec3d centre;       ///< Of mass.
  double radius = 0;  ///< Of all places, about the origin.
  std::size_t tet_count = 0;
};

Make make(const TetMesh& mesh, const SimMaterial& material, double scale, const SimulationOptions& options) {
  Make m;
  double mass = 0;
  for (Piece& piece : split_pieces(mesh, scale)) {
    Rest& rest = m.rests.emplace_back(make_rest(std::move(piece), material));
    m.surfaces.push_back(make_rest_surface(rest.piece));
    m.nets.push_back(options.solver == Solver::Potentials ? make_spring_net(rest, options.potentials) : SpringNet{});
    m.tet_count += rest.piece.tets.size();
    for (std::size_t v = 0; v < rest.masses.size(); ++v) {
      m.centre += rest.piece.places[v] * rest.masses[v];
      m.radius = std::max(m.radius, length(rest.piece.places[v]));
      mass += rest.masses[v];
    }
  }
  if (mass > 0) m.centre = m.centre * (1 / mass);
  return m;
}

void check_reach(const Make& m, const Pose& pose) {
  for (const Rest& rest : m.rests)  // masses of smaller ones leave single precision
    require(rest.piece.mean_edge >= kMinEdge, "mean edge of the tets", rest.piece.mean_edge, "at least 1e-6 m");
  const double out = m.radius + length(pose.translate);
  require(out <= kMaxCoordinate, "distance of a vertex from the origin", out, "at most 1e5 m");
  const double speed = length(pose.velocity) + 2 * m.radius * length(pose.spin);
  require(speed <= kMaxSpeed, "speed of a vertex", speed, "at most 1e4 m/s");
}

void add_part(World& world, std::size_t which, std::size_t surface, const Pose& pose, const Vec3d& centre) {
  const Rest& rest = world.rests[which];
  const Quaternion rotation = rotation_of(pose.rotate);
  Part part{which, surface, world.bodies.size() - 1, static_cast<std::uint32_t>(world.places.size()), 0, 0, {}, {},
            {},    {}};
  // Tets know how they are turned from the start.
  kernel::TetRotations turned{};
  for (int lane = 0; lane < kernel::kTetLanes; ++lane) {
    const std::array<double, 4> q{rotation.v.x, rotation.v.y, rotation.v.z, rotation.w};
    for (std::size_t i = 0; i < 4; ++i) turned.q[i][lane] = static_cast<float>(q[i]);
  }
  part.rotations.assign(rest.batches.size(), turned);
  const std::size_t end = part.begin + rest.padded_count;
  world.places.resize(end);
  world.remainders.resize(end);
  world.moves.resize(end);
  world.motions.resize(end);
  world.owners.resize(end, static_cast<std::uint32_t>(world.parts.size()));
  for (std::size_t v = 0; v < rest.masses.size(); ++v) {
    const Vec3d at = rotation.turned(rest.piece.places[v]) + pose.translate;
    const Vec3 p = to_float(at), r = to_float(at - to_double(p));
    const Vec3 m = to_float(pose.velocity + cross(pose.spin, rotation.turned(rest.piece.places[v] - centre)));
    world.places[part.begin + v] = {p.x, p.y, p.z, static_cast<float>(1 / rest.masses[v])};
    world.remainders[part.begin + v] = {r.x, r.y, r.z, 0};
    world.motions[part.begin + v] = {m.x, m.y, m.z, static_cast<float>(rest.masses[v])};
    world.bodies.back().slots[rest.piece.vertices[v]] = static_cast<std::uint32_t>(part.begin + v);
  }
  world.parts.push_back(std::move(part));
  ++world.rests[which].part_count;
}

void add_body(World& world, const TetMesh& mesh, const Pose& pose, double scale, const Make& m, std::size_t first_rest,
              std::size_t first_surface) {
  Body& body = world.bodies.emplace_back();
  body.first_part = world.parts.size();
  body.part_count = m.rests.size();
  body.slots.assign(mesh.vertices.size(), kNoSlot);
  body.velocities.resize(mesh.vertices.size());
  const Quaternion rotation = rotation_of(pose.rotate);
  for (const Vec3& v : mesh.vertices) {
    const Vec3d at = to_double(v) * scale;
    body.positions.push_back(to_float((std::isfinite(dot(at, at)) ? rotation.turned(at) : Vec3d{}) + pose.translate));
  }
  for (std::size_t r = 0; r < m.rests.size(); ++r) add_part(world, first_rest + r, first_surface + r, pose, m.centre);
  for (const std::uint32_t slot : body.slots) world.report.loose_vertices += slot == kNoSlot ? 1 : 0;
  world.report.tet_count += m.tet_count;
  world.report.left_out += mesh.tets.size() - m.tet_count;
  world.report.parts += m.rests.size();
}

/// One by one: where memory runs out, insert() may leave what was there empty.
template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  for (const T& item : from) to.push_back(item);
}

template <class T>
void shorten(std::vector<T>& list, std::size_t size) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(size), list.end());
}

/// Takes back what has been added since it was made, unless that was kept: memory may run out half way.
class Addition {
 public:
  explicit Addition(World& world)
      : world_(world),
        rests_(world.rests.size()),
        surfaces_(world.surfaces.size()),
        nets_(world.nets.size()),
        bodies_(world.bodies.size()),
        parts_(world.parts.size()),
        slots_(world.places.size()),
        report_(world.report) {}
  ~Addition() {
    if (kept_) return;
    shorten(world_.rests, rests_);
    shorten(world_.surfaces, surfaces_);
    shorten(world_.nets, nets_);
    shorten(world_.bodies, bodies_);
    shorten(world_.parts, parts_);
    shorten(world_.places, slots_);
    shorten(world_.remainders, slots_);
    shorten(world_.moves, slots_);
    shorten(world_.motions, slots_);
    shorten(world_.owners, slots_);
    world_.report = report_;
  }
  Addition(const Addition&) = delete;
  Addition& operator=(const Addition&) = delete;
  void keep() { kept_ = true; }

 private:
  World& world_;
  std::size_t rests_, surfaces_, nets_, bodies_, parts_, slots_;
  SimulationReport report_;
  bool kept_ = false;
};

/// Copies what a part shares with others, for good: it is not copied again however often vertices are pinned and let
/// go.
void give_own_rest(World& world, Part& part) {
  world.nets.push_back(world.nets[part.rest]);
  try {
    world.rests.push_back(world.rests[part.rest]);
  } catch (...) {
    world.nets.pop_back();
    throw;
  }
  --world.rests[part.rest].part_count;
  part.rest = world.rests.size() - 1;
  world.rests[part.rest].part_count = 1;
}

}  // namespace

void add_bodies(World& world, const TetMesh& mesh, const SimMaterial& material, std::span<const Pose> poses) {
  check(material);
  std::vector<Make> makes;  // of poses with one scale after the other
  // What the vertices are counted from is placed along with them.
  std::vector<Pose> placed_poses(poses.begin(), poses.end());
  for (Pose& pose : placed_poses) {
    const Vec3d origin = mesh.origin * (pose.scale * material.elastic.metres_per_unit);
    if (!(mesh.origin == Vec3d{})) pose.translate += rotation_of(pose.rotate).turned(origin);
    check(pose);
  }
  poses = placed_poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i == 0 || poses[i].scale != poses[i - 1].scale)
      makes.push_back(make(mesh, material, poses[i].scale * material.elastic.metres_per_unit, world.options));
    check_reach(makes.back(), poses[i]);
  }
  Addition addition(world);
  auto m = makes.begin();
  std::size_t first_rest = 0, first_surface = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i == 0 || poses[i].scale != poses[i - 1].scale) {
      if (i > 0) ++m;
      first_rest = world.rests.size();
      first_surface = world.surfaces.size();
      append(world.rests, m->rests);
      append(world.surfaces, m->surfaces);
      append(world.nets, m->nets);
    }
    add_body(world, mesh, poses[i], poses[i].scale * material.elastic.metres_per_unit, *m, first_rest, first_surface);
  }
  addition.keep();
}

void hold_vertex(World& world, std::uint32_t slot, Hold hold) {
  Part& part = world.parts[world.owners[slot]];
  const std::size_t v = slot - part.begin;
  const bool held = hold == Hold::Held;
  if ((world.rests[part.rest].held[v] != 0) == held) return;
  if (world.rests[part.rest].part_count > 1) give_own_rest(world, part);
  Rest& rest = world.rests[part.rest];
  rest.held[v] = held ? 1 : 0;
  rest.held_count = held ? rest.held_count + 1 : rest.held_count - 1;
  rest.prepared_for = 0;
  world.places[slot].inverse_mass = static_cast<float>(rest.inverse_mass(v));
  kernel::Motion& m = world.motions[slot];
  if (held) m = {0, 0, 0, m.mass};
}

void publish(const World& world, Body& body) {
  for (std::size_t v = 0; v < body.slots.size(); ++v) {
    const std::uint32_t slot = body.slots[v];
    if (slot == kNoSlot) continue;
    const kernel::Place& p = world.places[slot];
    const kernel::Motion& m = world.motions[slot];
    body.positions[v] = {p.x, p.y, p.z};
    body.velocities[v] = {m.x, m.y, m.z};
  }
}

void publish(World& world) {
  for (Body& body : world.bodies) publish(world, body);
}

}  // namespace tetsoup::simulate
