"""To and from other packages, with the real ones; what is not installed is skipped and named."""

from __future__ import annotations

import numpy as np
import pytest
import tetsoup
from conftest import real_package


@pytest.fixture
def mesh(cube):
    return tetsoup.tetrahedralize(*cube, voxels=24, cells=5)


def assert_meshes_like(source, vertices, faces):
    """The same mesh as from plain arrays."""
    a = tetsoup.tetrahedralize(source, voxels=16)
    b = tetsoup.tetrahedralize(vertices, faces, voxels=16)
    assert np.array_equal(a.points, b.points) and np.array_equal(a.tets, b.tets)


def test_meshio(cube, mesh, tmp_path):
    meshio = real_package("meshio")
    mesh.to_meshio().write(tmp_path / "cube.vtu")
    again = meshio.read(tmp_path / "cube.vtu")
    assert np.array_equal(again.points, mesh.points) and np.array_equal(again.cells_dict["tetra"], mesh.tets)
    vertices, faces = cube
    assert_meshes_like(meshio.Mesh(vertices, [("triangle", faces), ("line", [[0, 1]])]), vertices, faces)
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    assert_meshes_like(meshio.Mesh(vertices, [("quad", quads)]), vertices, faces)
    with pytest.raises(ValueError, match="no finite triangle"):
        tetsoup.tetrahedralize(meshio.Mesh(vertices, [("line", [[0, 1]])]))


def test_trimesh(cube, mesh):
    trimesh = real_package("trimesh")
    surface = mesh.to_trimesh()
    assert surface.is_watertight and surface.is_winding_consistent
    assert surface.volume == pytest.approx(mesh.quality.volume)
    assert len(surface.vertices) == mesh.quality.boundary_vertices
    box = trimesh.Trimesh(*cube)
    assert_meshes_like(box, *cube)
    assert_meshes_like(trimesh.Scene(box), *cube)


def test_pyvista(cube, mesh):
    pyvista = real_package("pyvista")
    grid = mesh.to_pyvista()
    assert grid.n_cells == len(mesh.tets) and grid.volume == pytest.approx(mesh.quality.volume)
    assert (grid.compute_cell_sizes()["Volume"] > 0).all()
    vertices, faces = cube
    assert_meshes_like(pyvista.PolyData.from_regular_faces(vertices, faces), vertices, faces)
    box = pyvista.Cube(center=(0.5, 0.5, 0.5)).clean()
    cut = box.points, box.triangulate().regular_faces  # along other diagonals than the cube's
    assert_meshes_like(box, *cut)
    assert_meshes_like(pyvista.MultiBlock([box]), *cut)
    assert_meshes_like(grid, mesh.points, mesh.surface)


def test_votes_in_two_lines_of_pyvista(cube):
    pyvista = real_package("pyvista")
    volume = tetsoup.classify_volume(tetsoup.unsigned_distance(tetsoup.Soup(*cube), voxels=16))
    grid = pyvista.ImageData(dimensions=volume.shape[::-1], origin=volume.origin, spacing=[volume.voxel_size] * 3)
    grid["votes"] = volume.votes.ravel()
    assert grid["votes"][grid.find_closest_point((0.5, 0.5, 0.5))] == 26
    assert grid["votes"][grid.find_closest_point((-0.1, 0.5, 0.5))] == 0


def test_polyscope(mesh, tmp_path, monkeypatch):
    polyscope = real_package("polyscope")
    monkeypatch.chdir(tmp_path)  # it leaves files with its settings
    polyscope.set_use_prefs_file(False)
    try:
        polyscope.init("openGL_mock")  # draws nothing, needs no screen
    except Exception as reason:
        pytest.skip(f"polyscope cannot start here: {reason}")
    shown = mesh.to_polyscope("cube")
    assert shown.n_vertices() == len(mesh.points) and shown.n_cells() == len(mesh.tets)


def test_usd(mesh):
    real_package("pxr")
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.CreateInMemory()
    prim = mesh.to_usd(stage, "/World/Cube")
    assert prim.GetPrim().IsA(UsdGeom.TetMesh)
    assert np.array_equal(np.array(prim.GetPointsAttr().Get()), mesh.points)
    assert np.array_equal(np.array(prim.GetTetVertexIndicesAttr().Get()), mesh.tets)
    assert len(UsdGeom.TetMesh.FindInvertedElements(prim, Usd.TimeCode.Default())) == 0
    theirs = np.array(UsdGeom.TetMesh.ComputeSurfaceFaces(prim, Usd.TimeCode.Default()))
    assert as_cycles(theirs) == as_cycles(np.array(prim.GetSurfaceFaceVertexIndicesAttr().Get()))


def as_cycles(triangles):
    """Triangles up to where they start, but not up to their orientation."""
    return sorted(tuple(np.roll(t, -int(np.argmin(t)))) for t in triangles.tolist())


def test_open3d(cube):
    open3d = real_package("open3d")
    vertices, faces = cube
    legacy = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices), open3d.utility.Vector3iVector(faces))
    assert_meshes_like(legacy, vertices, faces)
    assert_meshes_like(open3d.t.geometry.TriangleMesh.from_legacy(legacy), vertices, faces)
