"""Every preset, read by the package that reads it for users: counts and total volume are the tool's own."""
import shutil
import subprocess

import numpy
import pytest

import checkers
from bodies import CASES, assert_silent
from drops import HANGS, SHORTCOMINGS


def load_mujoco(written):
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(written.path(".xml")))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data.flexvert_xpos.copy(), model.flex_elem.reshape(-1, 4)[:, [1, 0, 2, 3]]  # It turns all of them over.


def load_newton(written):
    import newton

    mesh = newton.TetMesh.create_from_file(str(written.path(".npz")))
    return mesh.vertices, numpy.asarray(mesh.tet_indices).reshape(-1, 4)


def load_bullet(written):
    import pybullet

    pybullet.connect(pybullet.DIRECT)
    pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD)
    body = pybullet.loadSoftBody(str(written.path(".vtk")), mass=1, useNeoHookean=1)
    points = numpy.array(pybullet.getMeshData(body, -1, flags=pybullet.MESH_DATA_SIMULATION_MESH)[1])
    pybullet.disconnect()
    return points, checkers.read_vtk(written.path(".vtk"))[1]  # It does not tell its tets, but prints their number.


def load_drake(written):
    import pydrake.all as drake

    _, cells = checkers.read_vtk(written.path(".vtk"))
    builder = drake.DiagramBuilder()
    plant, scene = drake.AddMultibodyPlant(drake.MultibodyPlantConfig(time_step=0.01), builder)
    geometry = drake.GeometryInstance(drake.RigidTransform(), drake.Mesh(str(written.path(".vtk"))), "body")
    geometry.set_proximity_properties(drake.ProximityProperties())
    body = plant.mutable_deformable_model().RegisterDeformableBody(geometry, drake.DeformableBodyConfig(), 1.0)
    positions = plant.deformable_model().GetReferencePositions(body)
    return numpy.asarray(positions).reshape(-1, 3), cells


def load_usd(written):
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.Open(str(written.path(".usda")))
    mesh = next(UsdGeom.TetMesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.TetMesh))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1
    return numpy.array(mesh.GetPointsAttr().Get()), numpy.array(mesh.GetTetVertexIndicesAttr().Get())


def load_gmsh(written):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 1)
    gmsh.option.setNumber("General.Verbosity", 2)
    gmsh.open(str(written.path(".msh")))
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    _, nodes = gmsh.model.mesh.getElementsByType(4)
    gmsh.finalize()
    order = numpy.argsort(tags)
    return coordinates.reshape(-1, 3)[order], numpy.asarray(nodes).reshape(-1, 4).astype(int) - 1


def load_meshio(ending):
    def load(written):
        import meshio

        mesh = meshio.read(written.path(ending))
        return mesh.points, mesh.cells_dict["tetra"]

    return load


def load_paraview(written):
    import pyvista

    grid = pyvista.read(written.path(".vtu"))
    return grid.points, grid.cells_dict[pyvista.CellType.TETRA]


def load_netgen(written):
    from netgen.meshing import Mesh

    mesh = Mesh()
    mesh.Load(str(written.path(".vol")))
    points = numpy.array([point.p for point in mesh.Points()])
    cells = numpy.array([[vertex.nr - 1 for vertex in element.vertices] for element in mesh.Elements3D()])
    return points, cells[:, [1, 0, 2, 3]]  # Its tets are negative.


def load_trimesh(written):
    import trimesh

    mesh = trimesh.load(written.path(".obj"), process=False, maintain_order=True)
    faces = numpy.array([line.split()[1:] for line in written.path(".obj").read_text().splitlines()
                         if line.startswith("f ")], int) - 1
    assert len(mesh.faces) == 2 * len(faces)  # It cuts four corners into two triangles.
    return mesh.vertices, faces


def load_calculix(written):
    ccx = shutil.which("ccx")
    if not ccx:
        pytest.skip("ccx is not installed (Debian package calculix-ccx)")
    job = f"{written.body.name}_{written.tets}_gravity"
    log = subprocess.run([ccx, job], cwd=written.folder, capture_output=True, text=True)
    assert log.returncode == 0 and "*ERROR" not in log.stdout and "*WARNING" not in log.stdout, log.stdout[-2000:]
    volume = float((written.folder / f"{job}.dat").read_text().split()[-1])
    assert abs(volume / written.volume - 1) < 1e-5
    displacements = [line for line in (written.folder / f"{job}.frd").read_text().splitlines() if line[:3] == " -1"]
    assert displacements and not any("NaN" in line for line in displacements)
    return checkers.read_inp(written.path(".inp"))


READERS = {
    "abaqus": load_meshio(".inp"), "bullet": load_bullet, "calculix": load_calculix, "drake": load_drake,
    "gmsh": load_gmsh, "isaac": load_usd, "mmg": load_meshio(".mesh"), "mujoco": load_mujoco, "netgen": load_netgen,
    "newton": load_newton, "paraview": load_paraview, "tetgen": load_meshio(".node"), "usd": load_usd,
    "blender": load_trimesh,
    # By rules: their packages cannot be installed here.
    "dart": checkers.read_dart, "genesis": load_meshio(".msh"), "godot": checkers.read_json, "jolt": checkers.read_json,
    "isaacgym": checkers.read_isaacgym, "libuipc": checkers.read_libuipc, "sofa": checkers.read_sofa,
    "threejs": checkers.read_json, "unity-json": checkers.read_json, "vega": checkers.read_vega}


@pytest.mark.parametrize("body,tets", CASES)
@pytest.mark.parametrize("engine", READERS)
def test_counts_and_volume_agree(engine, body, tets, write, prove, capfd):
    if (engine, body) in HANGS:
        pytest.xfail(SHORTCOMINGS[engine, body, tets])
    written = write(engine, body, tets)
    capfd.readouterr()
    points, cells = READERS[engine](written)
    assert_silent(capfd)
    written.agrees_with(points, cells)
    prove(engine, "load", written)


def test_every_preset_of_the_tool_is_tried(write):
    from conftest import TOOL

    text = subprocess.run([TOOL, "mesh", "--help"], capture_output=True, text=True, check=True).stdout
    listing = text[text.index("--for ENGINE"):].split("\n\n")[0]
    names = listing[listing.index("abaqus"):].split()
    assert sorted(names) == sorted(READERS)
