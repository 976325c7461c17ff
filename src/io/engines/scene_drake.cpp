// Drake's scene: a script with a deformable body in a discrete plant.
#include "io/engines/scene_parts.h"

namespace tetsoup {

namespace {

constexpr StepLimit kLimit{0.01, 0};  // Implicit.

constexpr std::string_view kScene = R"("""A soft body falls on a plane, in Drake: python @name@_drake.py [--view]"""
import pathlib
import sys

import numpy
import pydrake.all as drake

MESH = str(pathlib.Path(__file__).with_name(@file@))
STEP = 0.01  # s
HEIGHT = @height@  # m, of the body
YOUNG = @young@  # Pa: @why@.
HELD = [@pins@]  # vertices


def contact():
    properties = drake.ProximityProperties()
    drake.AddContactMaterial(friction=drake.CoulombFriction(0.5, 0.5), properties=properties)
    return properties


def simulate(seconds=1.0, view=False):
    """Positions at the start, positions at the end, velocities at the end."""
    builder = drake.DiagramBuilder()
    config = drake.MultibodyPlantConfig(time_step=STEP, discrete_contact_approximation="lagged")
    plant, _ = drake.AddMultibodyPlant(config, builder)
    ground = contact()
    drake.AddRigidHydroelasticProperties(1.0, ground)
    plant.RegisterCollisionGeometry(
        plant.world_body(), drake.RigidTransform([0, 0, -HEIGHT]),
        drake.Box(20 * HEIGHT, 20 * HEIGHT, 2 * HEIGHT), "ground", ground)
    pose = drake.RigidTransform(drake.Quaternion(@quat@), [@x@, @y@, @lift@])
    geometry = drake.GeometryInstance(pose, drake.Mesh(MESH), "@name@")
    geometry.set_proximity_properties(contact())
    material = drake.DeformableBodyConfig()
    material.set_youngs_modulus(YOUNG)
    material.set_poissons_ratio(@poisson@)
    material.set_mass_density(@density@)
    material.set_stiffness_damping_coefficient(0.02)  # s
    bodies = plant.mutable_deformable_model()
    body = bodies.RegisterDeformableBody(geometry, material, 1.0)
    rest = bodies.GetReferencePositions(body).reshape(-1, 3)
    for vertex in HELD:  # whatever of the body lies in a tiny ball is fixed to the world
        bodies.AddFixedConstraint(
            body, plant.world_body(), pose, drake.Sphere(1e-5 * HEIGHT), drake.RigidTransform(rest[vertex]))
    plant.Finalize()
    if view:
        meshcat = drake.StartMeshcat()  # prints the address to open in a browser
        meshcat.AddButton("Stop", "Escape")
        drake.AddDefaultVisualization(builder, meshcat)
    diagram = builder.Build()
    simulator = drake.Simulator(diagram)
    context = plant.GetMyContextFromRoot(simulator.get_context())
    start = bodies.GetPositions(context, body).T.copy()
    simulator.set_target_realtime_rate(1.0 if view else 0.0)
    simulator.AdvanceTo(seconds)
    while view and meshcat.GetButtonClicks("Stop") == 0:
        simulator.AdvanceTo(context.get_time() + STEP)
    return start, bodies.GetPositions(context, body).T, bodies.GetVelocities(context, body).T
)";

}  // namespace

std::string drake_scene(const SceneInput& input) {
  const Drop drop = plan_drop(input, kLimit);
  return filled_script(kScene, gaps_of(drop, {{"file", quoted_python(input.mesh_file)},
                                              {"pins", pin_list(input.model, 0, ", ")},
                                              {"quat", upright_wxyz(input.model.up, ", ")}}));
}

}  // namespace tetsoup
