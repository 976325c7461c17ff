// SOFA's scene: a Python scene for runSofa.
#include "io/engines/scene_parts.h"
#include "io/model_parts.h"

namespace tetsoup {

namespace {

constexpr StepLimit kLimit{0.01, 0};  // Implicit; SOFA's default step.

constexpr std::string_view kScene =
    R"("""A soft body falls on a plane, in SOFA (v24.06 or later): runSofa -l SofaPython3 @name@_sofa.py"""
import pathlib

HERE = pathlib.Path(__file__).parent
MESH = str(HERE / @file@)
SURFACE = HERE / "@name@.obj"  # drawn instead of the tets' boundary where it stands here, in metres
ROTATION, TRANSLATION = [@rotation@], [@x@, @y@, @lift@]  # degrees, m
YOUNG = [@youngs@]  # Pa: one, or one a tet; @why@
HELD = [@pins@]  # vertices


def createScene(root):
    root.gravity = [0, 0, -9.81]
    root.dt = 0.01
    root.addObject("RequiredPlugin", pluginName=[
        "Sofa.Component.Constraint.Projective", "Sofa.Component.IO.Mesh", "Sofa.Component.LinearSolver.Direct",
        "Sofa.Component.Mapping.Linear", "Sofa.Component.Mass", "Sofa.Component.MechanicalLoad",
        "Sofa.Component.ODESolver.Backward", "Sofa.Component.SolidMechanics.FEM.Elastic",
        "Sofa.Component.StateContainer", "Sofa.Component.Topology.Container.Dynamic", "Sofa.GL.Component.Rendering3D"])
    root.addObject("DefaultAnimationLoop")

    body = root.addChild("@name@")
    body.addObject("EulerImplicitSolver", rayleighStiffness=0.01, rayleighMass=0.0)
    body.addObject("SparseLDLSolver", template="CompressedRowSparseMatrixMat3x3d")
    body.addObject("MeshGmshLoader", name="loader", filename=MESH, rotation=ROTATION, translation=TRANSLATION)
    body.addObject("TetrahedronSetTopologyContainer", src="@loader")
    body.addObject("TetrahedronSetGeometryAlgorithms", template="Vec3d")
    body.addObject("MechanicalObject", template="Vec3d")
    body.addObject("MeshMatrixMass", totalMass=@mass@, lumping=True)
    body.addObject("TetrahedronFEMForceField", method="large", youngModulus=YOUNG, poissonRatio=@poisson@)
    # As stiff as a tet, N/m.
    body.addObject("PlaneForceField", normal=[0, 0, 1], d=0, stiffness=@contact@, damping=1, bilateral=False)
    if HELD:
        body.addObject("FixedProjectiveConstraint", indices=HELD)

    visual = body.addChild("visual")
    if SURFACE.exists():
        visual.addObject("MeshOBJLoader", name="loader", filename=str(SURFACE), rotation=ROTATION,
                         translation=TRANSLATION)
        visual.addObject("OglModel", src="@loader")
        visual.addObject("BarycentricMapping")
    else:
        visual.addObject("OglModel", src="@../loader")
        visual.addObject("IdentityMapping")
)";

std::string_view rotation_of(UpAxis up) {
  if (up == UpAxis::Y) return "90, 0, 0";
  return up == UpAxis::X ? "0, -90, 0" : "0, 0, 0";
}

// One number, or one a tet where they differ.
std::string youngs_of(const TetModel& model, const Drop& drop) {
  if (!has_regions(model) && model.stiffness_scale.empty()) return brief(drop.young);
  std::string text;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    if (!text.empty()) text += ", ";
    text += brief(drop.stiffening * stiffness_scale_of(model, t) * model.regions[region_of(model, t)].material.young);
  }
  return text;
}

}  // namespace

std::string sofa_scene(const SceneInput& input) {
  const Drop drop = plan_drop(input, kLimit);
  return filled(kScene, gaps_of(drop, {{"file", quoted_python(input.mesh_file)},
                                       {"rotation", std::string(rotation_of(input.model.up))},
                                       {"youngs", youngs_of(input.model, drop)},
                                       {"pins", pin_list(input.model, 0, ", ")},
                                       {"contact", brief(drop.young * drop.edge)}}));
}

}  // namespace tetsoup
