"""Whatever is handed over: a mesh, or an error that says what is wrong. Never a crash."""

from __future__ import annotations

import math

import numpy as np
import pytest
import tetsoup
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

TRIANGLE = np.eye(3)
FACE = np.array([[0, 1, 2]])


@pytest.mark.parametrize(
    ("vertices", "faces", "says"),
    [
        (TRIANGLE * 1j, FACE, "vertices has the type complex128"),
        (TRIANGLE.astype(str), FACE, "vertices has the type <U"),
        (TRIANGLE.astype(object), FACE, "vertices has the type object"),
        (TRIANGLE > 0, FACE, "vertices has the type bool"),
        (TRIANGLE[:, :2], FACE, "vertices has the shape"),
        (TRIANGLE[0], FACE, "vertices has the shape"),
        (TRIANGLE[None], FACE, "vertices has the shape"),
        ([[0, 0, 0], [1, 1]], FACE, "vertices cannot be made an array"),
        (TRIANGLE, FACE.astype(float), "faces has the type float64"),
        (TRIANGLE, FACE > 0, "faces has the type bool"),
        (TRIANGLE, [[0, 1, 2, 0]], "faces has the shape"),
        (TRIANGLE, [0, 1, 2], "faces has the shape"),
        (TRIANGLE, [[0, 1, 2], [2, -1, 0]], r"faces\[1\] = \[2, -1, 0\]"),
        (TRIANGLE, [[0, 1, 10**30]], "faces has the type object"),
        (TRIANGLE, np.empty((0, 3), int), "no finite triangle"),
        (TRIANGLE, [], "no finite triangle"),
        ([], [], "no finite triangle"),
        ([], FACE, "no finite triangle"),
        (TRIANGLE, [[0, 1, 3]], "no finite triangle"),
        (TRIANGLE, [[0, 1, 2**40]], "no finite triangle"),
        (TRIANGLE * np.nan, FACE, "no finite triangle"),
        (TRIANGLE * 1e300, FACE, "no finite triangle"),
        (TRIANGLE, None, "faces is missing"),
        (None, None, "faces is missing"),
        (42, None, "faces is missing"),
        (object(), FACE, "vertices has the type object"),
    ],
)
def test_wrong_arrays_are_value_errors_that_name_them(vertices, faces, says):
    with pytest.raises(ValueError, match=says):
        tetsoup.tetrahedralize(vertices, faces)


@pytest.mark.parametrize(
    ("option", "says"),
    [
        ({"voxels": 0}, "voxels = 0"),
        ({"voxels": 2.5}, "voxels = 2.5, must be a whole number, or None"),
        ({"voxels": "many"}, "voxels = 'many'"),
        ({"voxels": 10**30}, "voxels = 1000"),
        ({"voxels": True}, "voxels = True"),
        ({"voxels": 9, "voxel_size": 1.0}, "voxel"),
        ({"voxel_size": math.nan}, "voxel_size"),
        ({"tets": -1}, "tets = -1, must be a whole number of at least 0"),
        ({"rho_min": 2}, "rho_min = 2"),
        ({"cells": 4, "cell_size": 1.0}, "cell"),
        ({"thin": "maybe"}, "thin = 'maybe', must be one of 'keep', 'drop'"),
        ({"separate": True}, "separate = True, must be one of 'on', 'off'"),
        ({"k": 3}, "k = 3"),
        ({"rays": 7}, "rays = 7"),
        ({"rotate": (1, 2)}, "rotate = .*three numbers"),
        ({"rotate": "xyz"}, "three numbers"),
        ({"rotate": 1}, "three numbers"),
        ({"box": ((0, 0, 0), (1, 1))}, "two corners"),
        ({"box": ((0, 0, 0), (0.5, 1, 1))}, "box"),
        ({"passes": -1}, "passes = -1"),
        ({"min_dihedral": 2}, "min_dihedral = 2"),
        ({"memory_limit": 1000}, "voxels = 128 needs"),
    ],
)
def test_options_out_of_range_are_value_errors_that_name_them(cube, option, says):
    with pytest.raises(tetsoup.InvalidInput, match=says) as caught:
        tetsoup.tetrahedralize(*cube, **option)
    assert isinstance(caught.value, ValueError)


def test_unknown_options_are_type_errors(cube):
    with pytest.raises(TypeError, match="rhomin"):
        tetsoup.tetrahedralize(*cube, rhomin=1)
    with pytest.raises(TypeError, match="tets"):
        tetsoup.unsigned_distance(cube[0][cube[1]], tets=3)


def test_bad_files_are_os_errors_that_name_them(tmp_path):
    with pytest.raises(tetsoup.IoError, match="nowhere.obj") as caught:
        tetsoup.read(tmp_path / "nowhere.obj")
    assert isinstance(caught.value, OSError)
    (tmp_path / "bad.ply").write_bytes(b"ply\nformat ascii 1.0\nelement vertex 3\n")
    for call in (tetsoup.read, tetsoup.tetrahedralize, tetsoup.read_tets):
        with pytest.raises(tetsoup.IoError, match="bad.ply"):
            call(tmp_path / "bad.ply")


def test_saving_where_one_cannot_leaves_nothing(cube, tmp_path):
    mesh = tetsoup.tetrahedralize(*cube, voxels=16)
    for path in (tmp_path / "no folder" / "x.msh", tmp_path / "x.docx", tmp_path):
        with pytest.raises(tetsoup.IoError):
            mesh.save(path)
    with pytest.raises(ValueError, match="format = 'docx', must be one of msh, "):
        mesh.save(tmp_path / "x.msh", format="docx")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("points", "tets"),
    [
        (TRIANGLE, [[0, 1, 2, 3]]),
        (TRIANGLE, [[0, 1, 2, -1]]),
        (TRIANGLE, FACE),
        (TRIANGLE * 1j, [[0, 1, 2, 0]]),
        (None, None),
    ],
)
def test_wrong_tets_are_value_errors(points, tets):
    with pytest.raises(tetsoup.InvalidInput):
        tetsoup.TetMesh(points, tets)


def test_an_empty_mesh_is_a_mesh():
    mesh = tetsoup.TetMesh([], [])
    assert (mesh.points.shape, mesh.tets.shape, mesh.surface.shape) == ((0, 3), (0, 4), (0, 3))
    assert mesh.quality.tet_count == 0
    assert len(tetsoup.smooth(mesh).mesh.tets) == 0


def test_an_inverted_tet_is_measured_but_not_smoothed():
    mesh = tetsoup.TetMesh([[0, 0, 0], [0, 1, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    assert mesh.quality.inverted_tets == 1
    with pytest.raises(ValueError):
        tetsoup.smooth(mesh)


@given(st.data())
def test_random_arrays_give_a_mesh_or_a_value_error(data):
    floats = hnp.arrays(
        data.draw(st.sampled_from([np.float32, np.float64, np.float16])),
        st.tuples(st.integers(0, 12), st.just(3)),
        elements={"allow_nan": True, "allow_infinity": True},
    )
    integers = hnp.arrays(
        data.draw(st.sampled_from([np.int64, np.uint64, np.int32, np.uint8, np.int8])),
        st.tuples(st.integers(0, 12), st.just(3)),
        elements=data.draw(st.sampled_from([None, st.integers(0, 12)])),
    )
    check(data.draw(floats), data.draw(integers))


@given(hnp.arrays(np.float64, st.tuples(st.integers(1, 12), st.just(3), st.just(3)), elements=st.floats(-10, 10)))
def test_random_triangles_always_give_a_mesh(corners):
    check(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), must=True)


def check(vertices, faces, must=False):
    try:
        mesh = tetsoup.tetrahedralize(vertices, faces, voxels=12, cells=5)
    except tetsoup.InvalidInput as error:
        assert str(error) and not must
        return
    assert len(mesh.tets) > 0 and np.isfinite(mesh.points).all()
    assert 0 <= mesh.tets.min() and mesh.tets.max() < len(mesh.points)
    assert mesh.quality.inverted_tets == 0


@given(
    st.fixed_dictionaries(
        {},
        optional={
            name: st.one_of(st.none(), st.integers(-2, 40), st.floats(), st.text(max_size=4), st.just([1, 2, 3]))
            for name in tetsoup.default_options()
            if name not in ("edge", "cell_size", "voxel_size", "passes")
        },
    )
)
def test_random_options_give_a_mesh_or_a_value_error(options):
    options.setdefault("voxels", 8)
    try:
        assert len(tetsoup.tetrahedralize([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], **options).tets) > 0
    except tetsoup.InvalidInput as error:
        assert str(error)
