// PyBullet's scene: a script with a deformable world.
#include <algorithm>
#include <cmath>

#include "io/engines/scene_parts.h"

namespace tetsoup {

namespace {

// PyBullet's default step. On the models that were tried one step took 5 explicit ones always, 10 not always.
constexpr StepLimit kLimit{1.0 / 240, 5};

constexpr std::string_view kScene =
    R"("""A soft body falls on a plane, in PyBullet: python @name@_pybullet.py [--view]"""
import pathlib
import sys

import numpy
import pybullet

MESH = str(pathlib.Path(__file__).with_name(@file@))
STEP = @step@  # s
HEIGHT = @height@  # m, of the body
MASS = @mass@  # kg
# Young's modulus of @young@ Pa and a Poisson ratio of @poisson@: @why@.
MU, LAMBDA = @mu@, @lambda@  # Pa
HELD = [@pins@]  # vertices
PIECES = @pieces@  # of the body: loadSoftBody() never returns for several


def simulate(seconds=1.0, view=False):
    """Positions at the start, positions at the end, velocities at the end."""
    if PIECES > 1:
        sys.exit(f"PyBullet cannot load a body of {PIECES} pieces: write it anew with --min-part 0.05 or --rho-min 0.2")
    pybullet.connect(pybullet.GUI if view else pybullet.DIRECT)
    pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD)
    pybullet.setGravity(0, 0, -9.81)
    pybullet.setTimeStep(STEP)
    # A box: soft bodies stop 0.1 m above a shape of type plane.
    box = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[20 * HEIGHT, 20 * HEIGHT, HEIGHT])
    pybullet.createMultiBody(0, box, basePosition=[0, 0, -HEIGHT])
    body = pybullet.loadSoftBody(
        MESH, basePosition=[@x@, @y@, @lift@], baseOrientation=[@quat@], mass=MASS, collisionMargin=0.005 * HEIGHT,
        useNeoHookean=1, NeoHookeanMu=MU, NeoHookeanLambda=LAMBDA, NeoHookeanDamping=0.01,
        frictionCoeff=0.5, useSelfCollision=0)
    for vertex in HELD:
        pybullet.createSoftBodyAnchor(body, vertex, -1, -1)

    def positions():
        return numpy.array(pybullet.getMeshData(body, -1, flags=pybullet.MESH_DATA_SIMULATION_MESH)[1])

    start = before = now = positions()
    for _ in range(round(seconds / STEP)):
        before = now
        pybullet.stepSimulation()
        now = positions()
    while view and pybullet.isConnected():
        pybullet.stepSimulation()
    return start, now, (now - before) / STEP
)";

std::size_t piece_count(const TetMesh& mesh) {
  Unions pieces = pieces_of(mesh);
  std::vector<bool> is_piece(mesh.vertices.size());
  for (const Tet& t : mesh.tets) is_piece[pieces.find(t[0])] = true;
  return static_cast<std::size_t>(std::count(is_piece.begin(), is_piece.end(), true));
}

}  // namespace

std::string pybullet_scene(const SceneInput& input) {
  const Drop drop = plan_drop(input, kLimit);
  const auto [lambda, mu] = lame(drop);
  return filled_script(kScene, gaps_of(drop, {{"file", quoted_python(input.mesh_file)},
                                              {"step", "1 / " + brief(std::round(1 / drop.time_step))},
                                              {"mu", brief(mu)},
                                              {"lambda", brief(lambda)},
                                              {"pins", pin_list(input.model, 0, ", ")},
                                              {"pieces", std::to_string(piece_count(input.model.mesh))},
                                              {"quat", upright_xyzw(input.model.up, ", ")}}));
}

}  // namespace tetsoup
