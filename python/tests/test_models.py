"""Regions, pins, materials and engines: what a mesh's files say besides its tets."""

from __future__ import annotations

import json

import numpy as np
import pytest
import tetsoup
from conftest import real_package

# Two bars end to end along x, named.
BARS = """o bars
v 0 0 0
v 4 0 0
v 4 1 0
v 0 1 0
v 0 0 1
v 4 0 1
v 4 1 1
v 0 1 1
v 8 0 0
v 8 1 0
v 8 0 1
v 8 1 1
vt 0 0
g left
usemtl wood
f 1/1 4/1 3/1 2/1
f 5/1 6/1 7/1 8/1
f 1 2 6 5
f 4 8 7 3
f 1 5 8 4
g right
usemtl rubber
f 2 3 10 9
f 6 11 12 7
f 2 9 11 6
f 3 7 12 10
f 9 10 12 11
"""


@pytest.fixture
def bars(tmp_path):
    (tmp_path / "bars.obj").write_text(BARS)
    return tmp_path / "bars.obj"


@pytest.fixture
def mesh(bars):
    return tetsoup.tetrahedralize(bars, voxels=64, tets=300)


def saved(mesh, tmp_path, **keywords):
    (path,) = mesh.save(tmp_path / "body.json", **keywords)
    return json.loads(path.read_text())


def test_regions_are_the_nearest_named_part(mesh, bars):
    labels, names = mesh.regions(bars, by="material")
    assert names == ["wood", "rubber"] and labels.dtype == np.int32 and len(labels) == len(mesh.tets)
    centres = mesh.points[mesh.tets].mean(axis=1)[:, 0]
    clear = np.abs(centres - 4) > 0.5
    assert np.array_equal(labels[clear], (centres > 4)[clear])
    surface = tetsoup.read_surface(bars)
    assert mesh.regions(surface, by="group").names == ["left", "right"]
    assert mesh.regions(surface, by="object").names == ["bars"]
    plain = mesh.regions(tetsoup.sample("torus"))
    assert plain.names == [""] and not plain.labels.any()
    with pytest.raises(ValueError, match="by = 'colour', must be one of"):
        mesh.regions(surface, by="colour")
    with pytest.raises(tetsoup.Cancelled):
        mesh.regions(surface, progress=lambda *_: False)


def test_regions_may_be_the_connected_parts():
    points, faces = tetsoup.sample("sphere")
    crumb = [[0.9, 0, 0], [0.9, 0.01, 0], [0.9, 0, 0.01]]
    n = len(points)
    last = [[2 * n, 2 * n + 1, 2 * n + 2]]
    soup = tetsoup.Soup(np.vstack([points - [3, 0, 0], points, crumb]), np.vstack([faces, faces + n, last]))
    mesh = tetsoup.tetrahedralize(soup, voxels=64, tets=300)
    labels, names = mesh.regions(soup, by="part")
    assert names[:2] == ["part_1", "part_2"] and labels.dtype == np.int32
    centres = mesh.points[mesh.tets].mean(axis=1)[:, 0]
    assert np.array_equal(labels == 0, centres < -1.5)
    near = mesh.vertices_near(soup, "part_1")
    assert np.array_equal(near, np.flatnonzero(mesh.points[:, 0] < -1.5))
    with pytest.raises(tetsoup.InvalidInput, match="'part_1' to 'part_3'"):
        mesh.vertices_near(soup, "part_4")


def test_vertices_to_be_held_are_chosen_by_place_and_by_name(mesh, bars):
    x = mesh.points[:, 0]
    assert np.array_equal(mesh.vertices_below(1, (1, 0, 0)), np.flatnonzero(x <= 1))
    assert np.array_equal(mesh.vertices_below(-1, [-1, 0, 0]), np.flatnonzero(x >= 1))
    assert np.array_equal(mesh.vertices_below(0.5), np.flatnonzero(mesh.points[:, 2] <= 0.5))
    assert np.array_equal(mesh.vertices_in_box((1, -9, -9), (2, 9, 9)), np.flatnonzero((x >= 1) & (x <= 2)))
    near = mesh.vertices_near(bars, "rubber")
    assert near.dtype == np.int32 and np.array_equal(near, mesh.vertices_near(bars, "right"))
    assert x[near].min() > 3.4 and len(near) == pytest.approx((x > 4).sum(), rel=0.2)
    for call, says in (
        (lambda: mesh.vertices_near(bars, "hand"), "name = 'hand', must be .*'left', 'right'"),
        (lambda: mesh.vertices_below(0, (0, 0, 0)), "normal"),
        (lambda: mesh.vertices_below(0, (0, 1)), "normal = .*three numbers"),
        (lambda: mesh.vertices_in_box((0, 0, 0), "abc"), "hi = .*three numbers"),
    ):
        with pytest.raises(tetsoup.InvalidInput, match=says):
            call()


def test_all_that_is_said_lands_in_the_file(mesh, bars, tmp_path):
    pins = {"end": mesh.vertices_below(0.5, (1, 0, 0))[::-1], "nothing": []}
    body = saved(
        mesh,
        tmp_path,
        name="beam",
        up="y",
        density=500,
        metres_per_unit=0.01,
        regions=mesh.regions(bars),
        materials={"rubber": {"young": 1e4, "poisson": 0.45}},
        pins=pins,
        surface=bars,
    )
    assert (body["name"], body["up"], body["metres_per_unit"]) == ("beam", "y", 0.01)
    assert np.array_equal(np.float32(body["vertices"]).reshape(-1, 3), mesh.points)
    assert np.array_equal(np.reshape(body["tets"], (-1, 4)), mesh.tets)
    assert body["regions"][0] == {"name": "wood", "density": 500, "young": 1e5, "poisson": 0.4}
    assert body["regions"][1] == {"name": "rubber", "density": 500, "young": 1e4, "poisson": 0.45}
    assert body["tet_regions"] == mesh.regions(bars).labels.tolist()
    assert body["pins"][0] == {"name": "end", "vertices": sorted(pins["end"].tolist())}
    assert body["pins"][1]["vertices"] == []
    assert body["embedding"]["tets"] == mesh.embed(bars).tets.tolist()


def test_a_mesh_alone_says_nothing_more(mesh, tmp_path):
    body = saved(mesh, tmp_path)
    assert body["regions"] == [{"name": "body", "density": 1000, "young": 1e5, "poisson": 0.4}]
    assert body["tet_regions"] == [] and body["pins"] == [] and "embedding" not in body


@pytest.mark.parametrize("engine", tetsoup.engines())
def test_every_engine_gets_its_files_in_metres(mesh, bars, tmp_path, engine):
    files = mesh.save(
        tmp_path / "body",
        engine=engine,
        metres_per_unit=0.5,
        regions=mesh.regions(bars),
        pins={"end": mesh.vertices_below(0.5, (1, 0, 0))},
        surface=bars,
    )
    assert files and all(path.stat().st_size > 0 for path in files)
    assert sorted(files) == sorted(set(tmp_path.iterdir()) - {bars})
    if files[0].suffix == ".json":
        assert np.allclose(json.loads(files[0].read_text())["vertices"], mesh.points.ravel() / 2)
    if files[0].suffix in (".msh", ".vtk", ".vtu", ".mesh", ".npz"):
        read = tetsoup.read_tets(files[0])
        assert np.array_equal(read.tets, mesh.tets) and np.allclose(read.points, mesh.points / 2)


def test_engines_go_by_other_names_and_unknown_ones_are_listed(mesh, tmp_path):
    assert list(tetsoup.engines()) == sorted(tetsoup.engines())
    assert mesh.save(tmp_path / "a", engine="pybullet")[0].suffix == ".vtk"
    with pytest.raises(tetsoup.InvalidInput, match="engine mujocco: .*did you mean mujoco.*newton"):
        mesh.save(tmp_path / "b", engine="mujocco")
    with pytest.raises(tetsoup.InvalidInput, match="extension"):
        mesh.save(tmp_path / "b.stl", engine="mujoco")
    with pytest.raises(tetsoup.InvalidInput, match="at most one"):
        mesh.save(tmp_path / "b", "msh", engine="mujoco")


@pytest.mark.parametrize(
    ("keywords", "says"),
    [
        ({"density": -1}, "density = -1"),
        ({"young": np.nan}, "young = nan"),
        ({"poisson": 0.5}, "poisson = 0.5"),
        ({"metres_per_unit": 0}, "metres_per_unit = 0"),
        ({"up": "w"}, "up = 'w', must be one of 'x', 'y', 'z'"),
        ({"pins": {"a": [-1]}}, r"pins\['a'\].*negative"),
        ({"pins": {"a": [10**6]}}, r"pins\['a'\] has the index 1000000, must be below"),
        ({"pins": {"a": [0.5]}}, r"pins\['a'\] has the type float64"),
        ({"pins": {"a": [[1, 2]]}}, r"pins\['a'\] has the shape"),
        ({"regions": ([0, 0], ["a"])}, "regions has 2 labels"),
        ({"regions": (np.full(9, 1), ["a"])}, "regions has the index 1, must be below 1"),
        ({"materials": {"a": {"young": 1}}}, "materials has 'a', must be names of regions"),
        ({"materials": {"body": {"colour": 1}}}, r"materials\['body'\] has \['colour'\]"),
        ({"materials": {"body": {"density": 0}}}, "density = 0"),
    ],
)
def test_what_cannot_be_is_a_value_error_and_leaves_no_file(mesh, bars, tmp_path, keywords, says):
    for engine in (None, "mujoco", "jolt"):
        with pytest.raises(tetsoup.InvalidInput, match=says):
            mesh.save(tmp_path / ("body" if engine else "body.json"), engine=engine, **keywords)
    with pytest.raises(tetsoup.InvalidInput, match="embedding has 1 points, must have 12"):
        mesh.save(tmp_path / "body.json", surface=bars, embedding=mesh.embed([[0, 0, 0]]))
    assert list(tmp_path.iterdir()) == [bars]


def test_a_material_given_is_no_default():
    nothing = ("body", "z", None, None, None, 1.0, None)
    from tetsoup._model import Body

    assert Body(*nothing, {"body": {}}, None, None, None).material_is_default
    assert not Body(*nothing, {"body": {"young": 1e6}}, None, None, None).material_is_default
    assert not Body("body", "z", None, None, 0.3, None, None, None, None, None, None).material_is_default


def test_usd_holds_the_render_surface_and_its_embedding(mesh, bars):
    real_package("pxr")
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.CreateInMemory()
    mesh.to_usd(stage, "/World/Bars", surface=bars)
    surface, embedding = tetsoup.read_surface(bars), mesh.embed(bars)
    drawn = UsdGeom.Mesh.Get(stage, "/World/Bars_render")
    assert np.array_equal(np.array(drawn.GetPointsAttr().Get()), surface.vertices)
    assert np.array_equal(np.array(drawn.GetFaceVertexCountsAttr().Get()), surface.face_sizes)
    assert np.array_equal(np.array(drawn.GetFaceVertexIndicesAttr().Get()), surface.corners)
    primvars = UsdGeom.PrimvarsAPI(drawn)
    assert np.array_equal(np.array(primvars.GetPrimvar("tetsoup:tet").Get()), embedding.tets)
    assert np.array_equal(np.array(primvars.GetPrimvar("tetsoup:weights").Get()), embedding.weights)
    assert len(primvars.GetPrimvar("st").ComputeFlattened()) == len(surface.corners)


def test_labelled_voxels_become_tets_with_their_labels_as_regions() -> None:
    z, y, x = np.meshgrid(np.arange(12), np.arange(20), np.arange(24), indexing="ij")
    away = np.sqrt((x - 11.5) ** 2 + (y - 9.5) ** 2 + (2 * (z - 5.5)) ** 2)
    labels = np.where(away < 5, 2, np.where(away < 9, 1, 0)).astype(np.uint8)
    scan = tetsoup.from_labels(labels, (1, 1, 2), (100, 0, 0), names={2: "bone"})
    assert [part.object for part in scan.regions.parts] == ["label_1", "bone"]
    mesh = tetsoup.tetrahedralize(scan.hull, voxels=64)
    assert abs(mesh.quality.volume - 2 * np.count_nonzero(labels)) < 0.05 * mesh.quality.volume
    assert mesh.points[:, 0].min() > 100
    found = mesh.regions(scan.regions, by="object")
    assert found.names == ["label_1", "bone"]
    assert 0.05 < np.mean(np.asarray(found.labels) == 1) < 0.4
    for wrong in (labels[0], labels / 2, labels.astype(np.int64) - 1):
        with pytest.raises(tetsoup.InvalidInput):
            tetsoup.from_labels(wrong)
    with pytest.raises(tetsoup.InvalidInput, match="voxel"):
        tetsoup.from_labels(labels, (1, 0, 1))
