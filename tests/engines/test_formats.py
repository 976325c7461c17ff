"""Every `--format` by itself, in the model's own unit: by meshio where it reads it, by pyvista, trimesh and Newton."""
import subprocess

import meshio
import numpy
import pytest

from bodies import CASES, assert_silent, volumes_of

# What meshio reads of what is written.
BY_MESHIO = {"msh": ".msh", "msh22": ".msh", "vtk": ".vtk", "vtu": ".vtu", "mesh": ".mesh", "tetgen": ".node",
             "inp": ".inp", "vol": ".vol"}
# Boundaries only, and formats that others read: test_load.py, test_usd.py.
BY_OTHERS = {"tet", "veg", "npz", "json", "usd", "objtets", "surface"}


def test_every_format_of_the_tool_is_tried():
    from conftest import TOOL

    text = subprocess.run([TOOL, "mesh", "--help"], capture_output=True, text=True, check=True).stdout
    listing = text[text.index("--format NAME"):text.index("--for ENGINE")]
    names = {line.split()[0] for line in listing.splitlines()[1:] if line.strip()}
    assert {*BY_MESHIO, *BY_OTHERS} == names


def in_own_unit(written, points, tets):
    volumes = volumes_of(points, tets)
    assert len(points) == written.report["vertex_count"] and len(tets) == written.report["tet_count"]
    assert (volumes > 0).all()
    assert abs(volumes.sum() / written.report["volume"] - 1) < 1e-5


@pytest.mark.parametrize("body,tets", CASES)
@pytest.mark.parametrize("name", BY_MESHIO)
def test_meshio_reads_points_tets_and_volume(name, body, tets, write, capfd):
    written = write(name, body, tets, by="--format", ending=BY_MESHIO[name])
    capfd.readouterr()
    mesh = meshio.read(written.path(BY_MESHIO[name]))
    assert_silent(capfd)
    in_own_unit(written, mesh.points, mesh.cells_dict["tetra"])  # It turns Netgen's over.


@pytest.mark.parametrize("body,tets", CASES)
@pytest.mark.parametrize("name", ("vtk", "vtu"))
def test_pyvista_reads_points_tets_and_volume(name, body, tets, write, capfd):
    import pyvista

    written = write(name, body, tets, by="--format", ending="." + name)
    capfd.readouterr()
    grid = pyvista.read(written.path("." + name))
    assert_silent(capfd)
    in_own_unit(written, grid.points, grid.cells_dict[pyvista.CellType.TETRA])
    assert abs(grid.volume / written.report["volume"] - 1) < 1e-5


@pytest.mark.parametrize("body,tets", CASES)
@pytest.mark.parametrize("ending", (".obj", ".stl", ".ply"))
def test_trimesh_finds_the_boundary_watertight_and_turned_outwards(ending, body, tets, write):
    import trimesh

    written = write("surface", body, tets, by="--format", ending=ending)
    mesh = trimesh.load(written.path(ending))  # Equal corners of a .stl become one.
    assert mesh.is_watertight and mesh.is_winding_consistent
    assert len(mesh.faces) == written.report["quality"]["boundary_triangles"]
    assert abs(mesh.volume / written.report["volume"] - 1) < 1e-5


@pytest.mark.parametrize("body,tets", CASES)
def test_newton_reads_the_usd_with_its_material(body, tets, write, recwarn):
    import newton
    from pxr import Usd, UsdGeom

    written = write("usd", body, tets)
    stage = Usd.Stage.Open(str(written.path(".usda")))
    prim = next(prim for prim in stage.Traverse() if prim.IsA(UsdGeom.TetMesh))
    mesh = newton.TetMesh.create_from_usd(prim, compat_namespaces=())
    written.agrees_with(mesh.vertices, numpy.asarray(mesh.tet_indices).reshape(-1, 4))
    young, poisson = 1e5, 0.4  # The tool's defaults.
    assert numpy.allclose(mesh.k_mu, young / (2 * (1 + poisson)))
    assert numpy.allclose(mesh.k_lambda, young * poisson / ((1 + poisson) * (1 - 2 * poisson)))
    assert mesh.density == 1000
    assert not mesh.custom_attributes
    assert not [str(warning.message) for warning in recwarn if "newton" in str(warning.filename)]


def test_newton_imports_the_usd_as_a_soft_body(write):
    """The whole stage, as users do: one deformable body of as many tets, in metres."""
    import newton

    written = write("isaac", "bunny", 500)
    builder = newton.ModelBuilder()
    builder.add_usd(str(written.path(".usda")))
    assert builder.tet_count == written.report["tet_count"]
    assert builder.particle_count == written.report["vertex_count"]
    assert sum(builder.particle_mass) == pytest.approx(1000 * written.volume, rel=1e-3)
