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
    plant.Finalize()
    if view:
        drake.AddDefaultVisualization(builder, drake.StartMeshcat())
    diagram = builder.Build()
    simulator = drake.Simulator(diagram)
    context = plant.GetMyContextFromRoot(simulator.get_context())
    start = bodies.GetPositions(context, body).T.copy()
    if view:
        simulator.set_target_realtime_rate(1.0)
        seconds = 60.0
    simulator.AdvanceTo(seconds)
    return start, bodies.GetPositions(context, body).T, bodies.GetVelocities(context, body).T


if __name__ == "__main__":
    _, ends, velocities = simulate(view="--view" in sys.argv)
    speed = numpy.sqrt((velocities**2).sum(axis=1).mean())
    print(f"after one second: lowest point {ends[:, 2].min():.4f} m, speed {speed:.4f} m/s")
)";

}  // namespace

std::string drake_scene(const SceneInput& input) {
  const Drop drop = plan_drop(input, kLimit);
  return filled(kScene, {{"name", drop.name},
                         {"file", quoted_python(input.mesh_file)},
                         {"height", brief(drop.height)},
                         {"young", brief(drop.young)},
                         {"why", drop.stiffness_why},
                         {"poisson", brief(drop.poisson)},
                         {"density", brief(drop.density)},
                         {"pins", pin_list(input.model, 0, ", ")},
                         {"x", brief(drop.x)},
                         {"y", brief(drop.y)},
                         {"lift", brief(drop.lift)},
                         {"quat", upright_wxyz(input.model.up, ", ")}});
}

}  // namespace tetsoup
