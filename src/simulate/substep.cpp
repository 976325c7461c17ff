#include "simulate/substep.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "kernel/rigid_motion.h"
#include "simulate/check.h"
#include "simulate/rigid_fit.h"

namespace tetsoup::simulate {
namespace {

/// Tets that are worth a task.
constexpr std::size_t kTaskTets = 1500;
/// Factors of larger ones do not pay, or take too long to make.
constexpr std::size_t kMostWholeTets = 4000;
/// Edges of a free body from the origin within which strain is right to 1e-5 without what the floats of places lack.
/// Held bodies rest on what is smaller.
constexpr double kNearEdges = 200;

bool is_near_origin(const Rest& rest, const kernel::Movers& movers) {
  const kernel::Place& p = movers.places[0];
  return !rest.is_held() && static_cast<double>(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})) <
                                kNearEdges * rest.piece.mean_edge;
}

/// All batches; the runs of a large piece's rounds on all threads.
void relax(const Rest& rest, Part& part, const kernel::Substep& substep, StageWatch& watch) {
  std::size_t first = 0;  // batch of the round
  for (const std::vector<std::size_t>& ends : rest.rounds) {
    const auto relax_run = [&](std::int64_t i, std::int64_t) {
      const auto run = static_cast<std::size_t>(i);
      const std::size_t begin = run == 0 ? first : ends[run - 1], count = ends[run] - begin;
      kernel::relax_tets(std::span(rest.batches).subspan(begin, count), std::span(part.rotations).subspan(begin, count),
                         substep);
    };
    if (ends.size() == 1)
      relax_run(0, 1);
    else
      parallel_for(static_cast<std::int64_t>(ends.size()), 1, watch, relax_run);
    first = ends.back();
  }
}

/// What elasticity took from the momenta is given back. Held parts have no momentum of their own.
void settle_momenta(World& world, Part& part, double h) {
  const kernel::Movers movers = world.movers(part);
  const auto step = static_cast<float>(h);
  // No sound body's vertices are moved by an edge in a substep; those of tets that are nearly flat may be, and far.
  part.clamped +=
      kernel::hold_back(movers.moves, movers.motions, static_cast<float>(world.rest_of(part).piece.mean_edge), step);
  Vec3 centre{movers.places[0].x, movers.places[0].y, movers.places[0].z};
  kernel::RigidDisplacement missing;
  if (!world.rest_of(part).is_held()) {
    const RigidFit fit = fit_rigid_motion(kernel::sum_motion(movers, centre, step));
    centre = to_float(to_double(centre) + fit.centre);
    missing = fit.displacement;
  }
  kernel::correct_motion(movers, centre, missing, step);
}

void move_implicitly(World& world, Part& part, double h, StageWatch& watch) {
  const Vec3 kick = to_float(world.options.gravity * ((part.last_h + h) / 2));
  const kernel::Movers movers = world.movers(part);
  kernel::predict(movers, kick, static_cast<float>(h));
  const Rest& rest = world.rest_of(part);
  const kernel::Offset* remainders = is_near_origin(rest, movers) ? nullptr : movers.remainders.data();
  const auto damped = static_cast<float>(share_of(rest.damping_time(h, rest.piece.mean_edge), h));
  relax(rest, part, {movers.places.data(), remainders, movers.moves.data(), damped}, watch);
  settle_momenta(world, part, h);
}

HeldState held_state(const World& world, const Part& part) {
  HeldState state{world.places_of(part), {}};
  for (std::size_t v = 0; v < state.places.size(); ++v) {
    const kernel::Motion& m = world.motions[part.begin + v];
    const bool held = world.rest_of(part).held[v] != 0;
    state.velocities.push_back(held ? Vec3d{} : Vec3d{m.x, m.y, m.z});
  }
  return state;
}

/// Rotations of the tets, between a part and its system.
template <class Visit>
void for_turns(const Rest& rest, Part& part, const Visit& visit) {
  part.system->turns.resize(rest.piece.tets.size());
  for (std::size_t t = 0; t < rest.piece.tets.size(); ++t)
    visit(part.system->turns[t], part.rotations[rest.lanes[t] / kernel::kTetLanes], rest.lanes[t] % kernel::kTetLanes);
}

void solve_whole(World& world, Part& part, double length) {
  const Rest& rest = world.rest_of(part);
  if (part.system == nullptr) part.system = std::make_unique<HeldSystem>();
  for_turns(rest, part, [](Turn& turn, const kernel::TetRotations& r, std::size_t lane) {
    turn = unit({{r.q[0][lane], r.q[1][lane], r.q[2][lane]}, r.q[3][lane]});
  });
  const HeldState start = held_state(world, part);
  const HeldState end = held_step(rest, *part.system, start, world.options.gravity, length);
  for_turns(rest, part, [](const Turn& turn, kernel::TetRotations& r, std::size_t lane) {
    const std::array<double, 4> q{turn.v.x, turn.v.y, turn.v.z, turn.w};
    for (std::size_t i = 0; i < 4; ++i) r.q[i][lane] = static_cast<float>(q[i]);
  });
  part.change.resize(start.places.size());
  for (std::size_t v = 0; v < start.places.size(); ++v) {
    const Vec3d mean = (end.places[v] - start.places[v]) * (1 / length);
    part.change[v] = end.velocities[v] - mean;
    kernel::Motion& m = world.motions[part.begin + v];
    const Vec3 velocity = to_float(mean);
    m = {velocity.x, velocity.y, velocity.z, m.mass};
  }
}

void end_stretch(World& world, Part& part) {
  for (std::size_t v = 0; v < part.change.size(); ++v) {
    kernel::Motion& m = world.motions[part.begin + v];
    const Vec3 velocity = to_float(Vec3d{m.x, m.y, m.z} + part.change[v]);
    m = {velocity.x, velocity.y, velocity.z, m.mass};
  }
  part.change.clear();
}

/// Evenly from solve to solve; what pushes it in between changes its velocities as it does those of others.
void move_whole(World& world, Part& part, double h, const Stretch& stretch) {
  const kernel::Movers movers = world.movers(part);
  if (stretch.begins) {
    kernel::arrive(movers);
    end_stretch(world, part);
    solve_whole(world, part, stretch.length);
  }
  kernel::predict(movers, {}, static_cast<float>(h));
}

/// Verlet's scheme: forces where the part is, then velocities, then places [THMG04].
void move_by_potentials(World& world, Part& part, double h) {
  const Rest& rest = world.rest_of(part);
  const kernel::Movers movers = world.movers(part);
  kernel::arrive(movers);
  const double kick = (part.last_h + h) / 2;
  const double most = rest.piece.mean_edge / h;
  part.clamped += add_forces(world.nets[part.rest], rest, world.places_of(part), movers.motions, kick, most);
  kernel::predict(movers, to_float(world.options.gravity * kick), static_cast<float>(h));
}

/// Parts [begin, end) of about kTaskTets each.
std::vector<std::size_t> task_ends(const World& world) {
  std::vector<std::size_t> ends;
  std::size_t tets = 0;
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    tets += world.rest_of(world.parts[i]).piece.tets.size();
    if (tets < kTaskTets && i + 1 < world.parts.size()) continue;
    ends.push_back(i + 1);
    tets = 0;
  }
  return ends;
}

}  // namespace

int count_stretches(const World& world, double dt) {
  constexpr double kRounding = 1e-9;
  // Crossed bars pressed on each other hold with two substeps, and sink in by a third with five.
  const bool may_meet = world.options.contacts != Contacts::None && world.bodies.size() > 1;
  const int most = may_meet ? 2 : 5;
  const double longest = std::min(most * longest_substep(world), kSubstepsTime);
  return static_cast<int>(std::ceil(dt / longest * (1 - kRounding)));
}

bool choose_schemes(World& world) {
  bool any = false;
  for (const Part& part : world.parts) {
    Rest& rest = world.rests[part.rest];
    rest.is_solved_whole =
        world.options.solver == Solver::Implicit && rest.is_held() && rest.piece.tets.size() <= kMostWholeTets;
  }
  const auto let_go = [&](std::uint32_t slot) {
    world.rests[world.parts[world.owners[slot]].rest].is_solved_whole = false;
  };
  for (const Spring& spring : world.springs)
    if (spring.stiffness > 0) let_go(spring.slot);
  for (const Attachment& link : world.attachments) {
    let_go(link.a);
    let_go(link.b);
  }
  for (const Part& part : world.parts) any = any || world.rest_of(part).is_solved_whole;
  return any;
}

int count_substeps(const World& world, double dt) {
  constexpr double kRounding = 1e-9;  // ten in 1/60 s
  const bool implicit = world.options.solver == Solver::Implicit;
  double h = longest_substep(world);
  if (implicit)
    for (const Rest& rest : world.rests)
      h = rest.is_solved_whole ? h : std::min(h, kMostEdges * rest.wave_time(rest.piece.mean_edge));
  else
    for (const SpringNet& net : world.nets) h = std::min(h, net.stable_time_step);
  const int most = implicit ? std::max(world.options.substeps, world.options.max_substeps) : kMaxSubsteps;
  return static_cast<int>(std::ceil(dt / std::max(h, kSubstepsTime / most) * (1 - kRounding)));
}

double longest_substep(const World& world) {
  return kSubstepsTime / world.options.substeps;
}

void prepare_substeps(World& world, double h) {
  if (world.options.solver != Solver::Implicit) return;
  for (Rest& rest : world.rests)
    if (!rest.is_solved_whole) prepare(rest, h);
}

void move_freely(World& world, double h, const Stretch& stretch) {
  const Progress nobody;
  StageWatch watch(nobody, "simulate");
  const std::vector<std::size_t> ends = task_ends(world);
  parallel_for(static_cast<std::int64_t>(ends.size()), 1, watch, [&](std::int64_t begin, std::int64_t) {
    const auto task = static_cast<std::size_t>(begin);
    for (std::size_t i = task == 0 ? 0 : ends[task - 1]; i < ends[task]; ++i) {
      Part& part = world.parts[i];
      if (world.rest_of(part).is_solved_whole)
        move_whole(world, part, h, stretch);
      else if (world.options.solver == Solver::Implicit)
        move_implicitly(world, part, h, watch);
      else
        move_by_potentials(world, part, h);
      part.last_h = h;
    }
  });
}

void end_stretch(World& world) {
  for (Part& part : world.parts) end_stretch(world, part);
}

void arrive(World& world) {
  for (const Part& part : world.parts) kernel::arrive(world.movers(part));
}

}  // namespace tetsoup::simulate
