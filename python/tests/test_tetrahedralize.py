"""What comes in, what comes out, and that it is the tool's mesh."""

from __future__ import annotations

import gc
import pickle
import subprocess
import sys

import numpy as np
import pytest
import tetsoup


def same(a: tetsoup.TetMesh, b: tetsoup.TetMesh) -> bool:
    return a.points.tobytes() == b.points.tobytes() and a.tets.tobytes() == b.tets.tobytes()


def test_a_cube_becomes_its_volume_in_positive_tets(cube):
    mesh = tetsoup.tetrahedralize(*cube, voxels=32, cells=4)
    assert (mesh.points.dtype, mesh.points.shape[1]) == (np.float32, 3)
    assert (mesh.tets.dtype, mesh.tets.shape[1]) == (np.int32, 4)
    assert (mesh.surface.dtype, mesh.surface.shape[1]) == (np.int32, 3)
    a, b, c, d = (mesh.points[mesh.tets[:, i]].astype(float) for i in range(4))
    volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
    assert volumes.min() > 0
    assert volumes.sum() == pytest.approx(mesh.quality.volume)
    assert volumes.sum() == pytest.approx(1, abs=0.1)
    assert mesh.quality.boundary_manifold


def test_the_surface_is_closed_and_looks_outwards(cube):
    mesh = tetsoup.tetrahedralize(*cube, voxels=32, cells=4)
    a, b, c = (mesh.points[mesh.surface[:, i]].astype(float) for i in range(3))
    assert np.einsum("ij,ij->i", np.cross(a, b), c).sum() / 6 == pytest.approx(mesh.quality.volume)


def test_a_closed_space_in_the_midst_has_a_surface_of_its_own(cube):
    vertices, faces = (np.asarray(a) for a in cube)
    both = np.concatenate([vertices, vertices.mean(0) + (vertices - vertices.mean(0)) / 2])
    room = np.concatenate([faces, faces[:, ::-1] + len(vertices)])
    mesh = tetsoup.tetrahedralize(both, room, voxels=48, cavities="keep")
    a, b, c = (mesh.points[mesh.cavity_surface[:, i]].astype(float) for i in range(3))
    assert np.einsum("ij,ij->i", np.cross(a, b), c).sum() / 6 == pytest.approx(-1 / 8, abs=0.02)
    assert tetsoup.tetrahedralize(*cube, voxels=32).cavity_surface.shape == (0, 3)


def test_any_real_type_any_strides_and_lists_give_the_same_bits(cube):
    vertices, faces = cube
    wanted = tetsoup.tetrahedralize(vertices, faces, voxels=16)
    padded = np.zeros((8, 6), np.float32)
    padded[:, ::2] = vertices
    for v in (
        vertices.astype(np.float32),
        vertices.astype(int),
        vertices.astype(">f8"),
        vertices.tolist(),
        np.asfortranarray(vertices),
        padded[:, ::2],
        vertices.astype(np.float16),
    ):
        assert same(wanted, tetsoup.tetrahedralize(v, faces, voxels=16))
    for f in (
        faces.astype(np.uint8),
        faces.astype(np.uint64),
        faces.astype(">i4"),
        faces.tolist(),
        faces[::-1],
        np.asfortranarray(faces),
    ):
        assert same(wanted, tetsoup.tetrahedralize(vertices, f, voxels=16))
    assert same(wanted, tetsoup.tetrahedralize(vertices[faces], voxels=16))
    assert same(wanted, tetsoup.tetrahedralize(tetsoup.Soup(vertices, faces), voxels=16))


def test_the_input_is_not_touched_and_may_go_away(cube):
    vertices, faces = (np.array(a) for a in cube)
    before = vertices.tobytes(), faces.tobytes()
    pipeline = tetsoup.Pipeline(vertices, faces)
    assert before == (vertices.tobytes(), faces.tobytes())
    wanted = pipeline.run(voxels=16)
    vertices[:] = np.nan
    faces[:] = 0
    del vertices, faces
    gc.collect()
    assert same(wanted, pipeline.run(voxels=16))


def test_arrays_outlive_the_mesh_and_are_not_copies(cube):
    mesh = tetsoup.tetrahedralize(*cube, voxels=16)
    points, tets, surface = mesh.points, mesh.tets, mesh.surface
    assert points is mesh.points and not points.flags.owndata and not points.flags.writeable
    with pytest.raises(ValueError):
        points[0] = 0
    copies = points.copy(), tets.copy(), surface.copy()
    del mesh
    gc.collect()
    trash = [np.ones_like(points) for _ in range(100)]
    assert all(np.array_equal(a, b) for a, b in zip((points, tets, surface), copies)), trash


def test_the_same_bits_as_the_tool(cube, tmp_path):
    soup = tetsoup.sample("robot")
    (tmp_path / "soup.obj").write_text(
        "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in soup.vertices.astype(float).tolist())
        + "".join(f"f {a} {b} {c}\n" for a, b, c in (soup.faces + 1).tolist())
    )
    command = [
        sys.executable,
        "-m",
        "tetsoup",
        "mesh",
        "soup.obj",
        "-o",
        "tool.msh",
        "--quiet",
        "--voxels",
        "64",
        "--rho-min",
        "0.3",
    ]
    subprocess.run(command, check=True, cwd=tmp_path)
    mesh = tetsoup.tetrahedralize(*soup, voxels=64, rho_min=0.3)
    mesh.save(tmp_path / "python.msh")
    assert (tmp_path / "python.msh").read_bytes() == (tmp_path / "tool.msh").read_bytes()
    assert same(mesh, tetsoup.tetrahedralize(tmp_path / "soup.obj", voxels=64, rho_min=0.3))


def test_the_same_bits_for_any_number_of_threads(cube):
    try:
        tetsoup.set_thread_count(1)
        one = tetsoup.tetrahedralize(*tetsoup.sample("torus"), voxels=48)
        tetsoup.set_thread_count(3)
        assert same(one, tetsoup.tetrahedralize(*tetsoup.sample("torus"), voxels=48))
    finally:
        tetsoup.set_thread_count(0)


def test_what_was_found_and_done_is_reported(cube):
    mesh = tetsoup.tetrahedralize(*cube, voxels=16, cells=4)
    assert mesh.report.soup.kind == "closed"
    assert mesh.report.soup.box == ((0, 0, 0), (1, 1, 1))
    assert mesh.report.lattice.cells == (4, 4, 4)
    assert mesh.report.options["cells"] == 4 and mesh.report.options["voxels"] == 16
    assert set(mesh.report.seconds) == {"soup", "distance", "pseudo_volume", "lattice", "smooth"}
    assert mesh.report.notes == mesh.report.as_dict()["notes"] and all("--" in note for note in mesh.report.notes)
    nested = mesh.report.as_dict()
    assert nested["lattice"]["topology"]["parts_dropped"] == mesh.report.lattice.topology.parts_dropped
    assert nested["pseudo_volume"]["candidates"] == []  # a sound soup: nothing was voted on
    assert "triangle_count=12" in repr(mesh.report.soup)
    assert sum(mesh.quality.dihedral_histogram) == 6 * len(mesh.tets)


def test_readiness_scales_with_the_material(cube):
    mesh = tetsoup.tetrahedralize(*cube, voxels=16)
    assert mesh.readiness(density=500).mass == pytest.approx(500 * mesh.quality.volume)
    assert mesh.readiness(young=4e5).stable_time_step == pytest.approx(mesh.readiness().stable_time_step / 2)
    assert all(check.advice for check in mesh.readiness().checks)
    with pytest.raises(ValueError, match="density"):
        mesh.readiness(density=-1)


def test_meshes_are_saved_read_and_pickled(cube, tmp_path):
    mesh = tetsoup.tetrahedralize(*cube, voxels=16)
    for extension in (".msh", ".vtk", ".vtu", ".mesh"):
        assert mesh.save(tmp_path / f"cube{extension}") == [tmp_path / f"cube{extension}"]
        assert same(mesh, tetsoup.read_tets(tmp_path / f"cube{extension}"))
    assert len(mesh.save(tmp_path / "cube.node")) == 3
    mesh.save(tmp_path / "old.txt", format="msh22")
    surface = tetsoup.read(mesh.save(tmp_path / "cube.stl")[0])
    assert len(surface.faces) == len(mesh.surface)
    assert same(mesh, pickle.loads(pickle.dumps(mesh)))
    with pytest.raises(AttributeError, match="no report"):
        tetsoup.read_tets(tmp_path / "cube.msh").report


def test_samples_are_listed_and_made():
    assert "torus" in tetsoup.sample_names()
    assert len(tetsoup.sample("torus", damage=0.5).faces) < len(tetsoup.sample("torus").faces)
    with pytest.raises(ValueError, match="torus"):
        tetsoup.sample("no such thing")
