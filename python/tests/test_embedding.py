"""A surface hangs on the tets and moves with them; render surfaces keep what their file says."""

from __future__ import annotations

import gc
import pickle
import subprocess
import sys

import numpy as np
import pytest
import tetsoup
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

CORNER = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
OBJ = """o box
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
g floor
usemtl stone
f 1/1/1 2/2/1 3/3/1 4/4/1
g wall
usemtl wood
f 1 2 6 5
"""


@pytest.fixture
def box(tmp_path):
    (tmp_path / "box.obj").write_text(OBJ)
    return tmp_path / "box.obj"


@pytest.fixture
def torus():
    return tetsoup.tetrahedralize(*tetsoup.sample("torus"), voxels=32, cells=8)


def test_a_surface_keeps_polygons_texture_coordinates_normals_and_names(box):
    surface = tetsoup.read_surface(box)
    assert surface.vertices.shape == (6, 3) and surface.vertices.dtype == np.float32
    assert surface.face_sizes.tolist() == [4, 4] and surface.face_sizes.dtype == np.int32
    assert surface.corners.tolist() == [0, 1, 2, 3, 0, 1, 5, 4]
    assert surface.texcoords.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert surface.corner_texcoords.tolist() == [0, 1, 2, 3, -1, -1, -1, -1]
    assert surface.normals.tolist() == [[0, 0, 1]] and surface.corner_normals.tolist() == [0] * 4 + [-1] * 4
    assert surface.parts == [("box", "floor", "stone"), ("box", "wall", "wood")]
    assert surface.parts[1].material == "wood" and surface.face_parts.tolist() == [0, 1]
    assert surface.triangle_faces.tolist() == [0, 0, 1, 1]
    soup = tetsoup.read(box)
    assert np.array_equal(soup.vertices, surface.vertices) and np.array_equal(soup.faces, surface.triangles)


def test_surfaces_are_pickled_saved_and_moved(box, tmp_path):
    surface = tetsoup.read_surface(box)
    surface.save(tmp_path / "again.obj")
    for again in (pickle.loads(pickle.dumps(surface)), tetsoup.read_surface(tmp_path / "again.obj")):
        for name in ("vertices", "face_sizes", "corners", "texcoords", "corner_texcoords", "normals", "face_parts"):
            assert np.array_equal(getattr(again, name), getattr(surface, name)), name
        assert again.parts == surface.parts
    moved = surface.with_vertices(surface.vertices + 1)
    assert np.array_equal(moved.vertices, surface.vertices + 1) and moved.normals.size == 0
    assert np.array_equal(moved.corner_texcoords, surface.corner_texcoords) and moved.parts == surface.parts
    with pytest.raises(ValueError, match="vertices has 5 rows, must have 6"):
        surface.with_vertices(surface.vertices[:5])
    with pytest.raises(tetsoup.IoError):
        surface.save(tmp_path / "again.stl")


def test_arrays_outlive_what_they_belong_to_and_cannot_be_written(box):
    surface = tetsoup.read_surface(box)
    embedding = tetsoup.embed(CORNER, surface)
    arrays = [surface.vertices, surface.corners, surface.texcoords, surface.triangles, surface.triangle_faces]
    arrays += [embedding.tets, embedding.weights, embedding.distances]
    before = [array.tobytes() for array in arrays]
    del surface, embedding
    gc.collect()
    assert before == [array.tobytes() for array in arrays]
    assert not any(array.flags.writeable for array in arrays)


def test_wild_indices_and_names_of_a_file_do_no_harm(tmp_path):
    (tmp_path / "wild.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\ng caf\xe9\nf 1 2 3\nf 1 2 4294967294\n")
    surface = tetsoup.read_surface(tmp_path / "wild.obj")
    assert surface.corners.min() >= 0
    assert surface.parts[0].group == "caf\ufffd"
    assert len(tetsoup.embed(CORNER, surface)) == 3


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"vertices": [[0, 0]]}, "vertices has the shape"),
        ({"vertices": [["a", "b", "c"]]}, "vertices has the type"),
        ({"face_sizes": [2, 2]}, "face_sizes has 2, must be at least 3"),
        ({"face_sizes": [3, 3]}, "corners = 4"),
        ({"face_sizes": [[4]]}, "face_sizes has the shape"),
        ({"corners": [0, 1, 2, -3]}, "corners.*negative"),
        ({"corners": [0.0, 1.0, 2.0, 3.0]}, "corners has the type float64"),
        ({"texcoords": [[0, 0]], "corner_texcoords": [0, 0, 0, 1]}, "corner_texcoords.*below 1"),
        ({"texcoords": [[0, 0]], "corner_texcoords": [0, 0, 0]}, "corner_texcoords = 3"),
        ({"texcoords": [[0, 0, 0]]}, "texcoords has the shape"),
        ({"normals": [[0, 0, 1]], "corner_normals": [0, 0, 0, -2]}, "corner_normals"),
        ({"face_parts": [0]}, "part of a face"),
    ],
)
def test_wrong_surfaces_are_value_errors_that_name_the_array(change, says):
    good = {"vertices": np.eye(4, 3), "face_sizes": [4], "corners": [0, 1, 2, 3]}
    assert len(tetsoup.RenderMesh(**good).triangles) == 2
    with pytest.raises(tetsoup.InvalidInput, match=says):
        tetsoup.RenderMesh(**{**good, **change})


def test_points_have_barycentric_weights_inside_and_a_distance_outside():
    embedding = CORNER.embed([[0.1, 0.2, 0.3], [0.2, 0.2, -0.5], [np.nan, 0, 0]])
    assert (embedding.tets.dtype, embedding.weights.dtype, embedding.distances.dtype) == (
        np.int32,
        np.float32,
        np.float32,
    )
    assert embedding.weights.shape == (3, 4) and len(embedding) == 3
    assert np.allclose(embedding.weights[0], [0.4, 0.1, 0.2, 0.3])
    assert np.allclose(embedding.distances[:2], [0, 0.5])
    report = embedding.report
    assert (report.inside, report.outside, report.non_finite) == (1, 1, 1)
    assert report.max_distance == pytest.approx(0.5)
    drawn = CORNER.embed([[0, 0, -9]], max_extrapolation=1)
    assert drawn.report.drawn_closer == 1 and np.allclose(drawn.deform(CORNER.points), [[0, 0, -1]])


def test_whatever_holds_a_surface_gives_the_same_embedding(torus, tmp_path):
    vertices, faces = tetsoup.sample("torus")
    wanted = torus.embed(vertices, faces)
    subprocess.run([sys.executable, "-m", "tetsoup", "sample", "torus", "-o", "torus.obj"], cwd=tmp_path, check=True)
    surface = tetsoup.read_surface(tmp_path / "torus.obj")
    assert np.array_equal(surface.vertices, vertices)
    for source in (tetsoup.Soup(vertices, faces), (vertices, faces), surface, tmp_path / "torus.obj"):
        again = tetsoup.embed(torus, *source) if type(source) is tuple else tetsoup.embed(torus, source)
        assert again.weights.tobytes() == wanted.weights.tobytes() and np.array_equal(again.tets, wanted.tets)
    alone = torus.embed(vertices.astype(np.float64).tolist())
    assert np.array_equal(alone.tets, wanted.tets)


@given(hnp.arrays(np.float64, (3, 3), elements=st.floats(-2, 2)), hnp.arrays(np.float64, 3, elements=st.floats(-9, 9)))
def test_any_affine_map_of_the_mesh_moves_the_points_alike(matrix, shift):
    points = np.random.default_rng(1).uniform(-0.5, 1, (50, 3)).astype(np.float32)
    moved = CORNER.embed(points).deform(CORNER.points @ matrix.T + shift)
    assert np.abs(moved - (points @ matrix.T + shift)).max() < 1e-5


def test_normals_stay_upright_on_what_moves_along(torus):
    vertices, _ = tetsoup.sample("torus")
    embedding = torus.embed(vertices)
    normals = np.tile(np.float32([0, 0, 1]), (len(vertices), 1))
    x, y, z = torus.points.T
    tilted = embedding.deform_normals(np.stack([x, y, z + x], axis=1), normals)
    assert np.allclose(tilted, np.array([-1, 0, 1]) / np.sqrt(2), atol=1e-4)
    upright = embedding.deform_normals(np.stack([x + z, y, z], axis=1), normals)
    assert np.allclose(upright, [0, 0, 1], atol=1e-4)


@pytest.mark.parametrize("name", ["e.npz", "e.embedding"])
def test_embeddings_are_written_and_read_back(torus, tmp_path, name):
    vertices, faces = tetsoup.sample("torus")
    embedding = torus.embed(vertices, faces)
    embedding.save(tmp_path / name)
    again = tetsoup.read_embedding(tmp_path / name, torus)
    bent = torus.points * np.float32([1, 2, 3])
    copies = (again, pickle.loads(pickle.dumps(embedding)))
    for copy in copies:
        assert copy.weights.tobytes() == embedding.weights.tobytes()
        assert copy.deform(bent).tobytes() == embedding.deform(bent).tobytes()
    assert copies[1].report.as_dict() == embedding.report.as_dict()
    with pytest.raises(ValueError, match="mesh is missing"):
        tetsoup.read_embedding(tmp_path / name).deform(bent)
    with pytest.raises(ValueError, match="mesh has 1 tets"):
        tetsoup.read_embedding(tmp_path / name, CORNER)
    if name == "e.npz":
        assert np.array_equal(np.load(tmp_path / name)["weights"], embedding.weights)


def test_the_tools_embedding_is_the_same(torus, tmp_path):
    command = ["tetsoup", "sample", "torus", "-o", "torus.obj"]
    subprocess.run([sys.executable, "-m", *command], cwd=tmp_path, check=True)
    command = ["tetsoup", "mesh", "torus.obj", "-o", "torus.msh", "--embed", "torus.npz"]
    done = subprocess.run([sys.executable, "-m", *command], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    mesh = tetsoup.tetrahedralize(tmp_path / "torus.obj")
    assert (
        tetsoup.read_embedding(tmp_path / "torus.npz").weights.tobytes()
        == mesh.embed(tmp_path / "torus.obj").weights.tobytes()
    )


def test_wrong_input_to_an_embedding_is_a_value_error(torus, tmp_path):
    vertices, faces = tetsoup.sample("torus")
    embedding = torus.embed(vertices, faces)
    for call, says in (
        (lambda: torus.embed(vertices, [[0, 1, -1]]), "negative"),
        (lambda: torus.embed(vertices[:, :2]), "vertices has the shape"),
        (lambda: torus.embed(vertices * 1j), "complex"),
        (lambda: torus.embed(42), "faces is missing"),
        (lambda: torus.embed(vertices, max_extrapolation=-1), "max_extrapolation = -1"),
        (lambda: torus.embed(vertices, max_extrapolation=np.nan), "max_extrapolation"),
        (lambda: tetsoup.TetMesh([], []).embed(vertices), "no tet"),
        (lambda: embedding.deform(torus.points[1:]), "positions has .* one for every vertex"),
        (lambda: embedding.deform(torus.points[:, :2]), "positions has the shape"),
        (lambda: embedding.deform_normals(torus.points, vertices[1:]), "normals"),
    ):
        with pytest.raises(tetsoup.InvalidInput, match=says):
            call()
    assert np.isnan(embedding.deform(torus.points * np.nan)).all()
    with pytest.raises(tetsoup.IoError, match="nowhere"):
        tetsoup.read_embedding(tmp_path / "nowhere.npz")
    with pytest.raises(tetsoup.IoError):
        embedding.save(tmp_path / "e.txt")
    (tmp_path / "bad.embedding").write_bytes(b"tetembed\1")
    with pytest.raises(tetsoup.IoError, match="bad.embedding"):
        tetsoup.read_embedding(tmp_path / "bad.embedding")
    assert [p.name for p in tmp_path.iterdir()] == ["bad.embedding"]


def test_a_progress_callback_answers_by_truth_of_any_kind(torus):
    vertices, faces = tetsoup.sample("torus")
    for yes in ("go on", [1], 2.5, None):
        torus.embed(vertices, faces, progress=lambda *_, yes=yes: yes)
    for no in ("", [], 0):
        with pytest.raises(tetsoup.Cancelled):
            torus.embed(vertices, faces, progress=lambda *_, no=no: no)


def test_arrays_of_no_memory_and_endless_rows_are_refused():
    points = np.zeros((3, 3), np.float32)
    for dtype in (np.int32, np.uint32):
        endless = np.lib.stride_tricks.as_strided(np.zeros(3, dtype), (2**33, 3), (0, dtype().itemsize))
        with pytest.raises(tetsoup.InvalidInput, match="faces has 8589934592 rows"):
            tetsoup.clean_soup(points, endless)


def test_embedding_reports_progress_and_is_cancelled(torus):
    vertices, faces = tetsoup.sample("torus")
    seen = []
    torus.embed(vertices, faces, progress=lambda *call: seen.append(call))
    assert {stage for stage, _ in seen} == {"embed"} and seen[-1][1] == 1
    with pytest.raises(tetsoup.Cancelled):
        torus.embed(vertices, faces, progress=lambda *_: False)

    def fail(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        torus.embed(vertices, faces, progress=fail)
