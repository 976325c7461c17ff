// Newton's scene: a script with the VBD solver.
#include "io/engines/scene_parts.h"

namespace tetsoup {

namespace {

// Implicit; a tenth of a frame, as Newton's own examples have it.
constexpr StepLimit kLimit{1.0 / 600, 0};

constexpr std::string_view kScene = R"("""A soft body falls on a plane, in Newton: python @name@_newton.py [--view]"""
import pathlib
import sys

import newton
import numpy
import warp

MESH = str(pathlib.Path(__file__).with_name(@file@))
FRAME, SUBSTEPS, ITERATIONS = 1 / 60, 10, 10
HEIGHT = @height@  # m, of the body
YOUNG = @young@  # Pa: @why@.
STIFFENING = @stiffening@  # of the stiffness in the mesh file


def simulate(seconds=1.0, view=False):
    """Positions at the start, positions at the end, velocities at the end."""
    mesh = newton.TetMesh.create_from_file(MESH)
    arrays = {name: mesh.custom_attributes.pop(name)[0] for name in list(mesh.custom_attributes)}
    builder = newton.ModelBuilder()
    builder.add_ground_plane()
    # Damping relaxes a deformation within 0.01 s.
    builder.add_soft_mesh(
        mesh=mesh, pos=warp.vec3(@x@, @y@, @lift@), rot=warp.quat(@quat@), scale=1.0, vel=warp.vec3(0.0),
        k_mu=STIFFENING * mesh.k_mu, k_lambda=STIFFENING * mesh.k_lambda, k_damp=0.01 * YOUNG,
        particle_radius=0.005 * HEIGHT)
    for name in arrays:
        if name.startswith("pin_"):
            for vertex in arrays[name]:  # held
                builder.particle_mass[vertex] = 0.0
                builder.particle_flags[vertex] = 0
    builder.color()
    model = builder.finalize()
    model.soft_contact_ke = @contact@  # N/m: as stiff as a tet
    model.soft_contact_kd = 0.0
    model.soft_contact_mu = 0.5
    solver = newton.solvers.SolverVBD(model, iterations=ITERATIONS, particle_enable_tile_solve=False)
    state, after = model.state(), model.state()
    control, pipeline = model.control(), newton.CollisionPipeline(model)
    contacts = pipeline.contacts()
    viewer = newton.viewer.ViewerGL() if view else None
    if viewer:
        viewer.set_model(model)
    start = state.particle_q.numpy().copy()
    frame = 0
    while frame < round(seconds / FRAME) or (viewer and viewer.is_running()):
        for _ in range(SUBSTEPS):
            state.clear_forces()
            pipeline.collide(state, contacts)
            solver.step(state, after, control, contacts, FRAME / SUBSTEPS)
            state, after = after, state
        frame += 1
        if viewer:
            viewer.begin_frame(frame * FRAME)
            viewer.log_state(state)
            viewer.end_frame()
    return start, state.particle_q.numpy(), state.particle_qd.numpy()
)";

}  // namespace

std::string newton_scene(const SceneInput& input) {
  const Drop drop = plan_drop(input, kLimit);
  return filled_script(kScene, gaps_of(drop, {{"file", quoted_python(input.mesh_file)},
                                              {"stiffening", brief(drop.stiffening)},
                                              {"contact", brief(drop.young * drop.edge)},
                                              {"quat", upright_xyzw(input.model.up, ", ")}}));
}

}  // namespace tetsoup
