"""Stiffness and density of tets with which a mesh moves like a fine one, and the files that hold them."""

from __future__ import annotations

import json

import numpy as np
import pytest
import tetsoup

# A bar of 4 x 1 x 1, closed.
CORNERS = np.array([[x, y, z] for x in (0, 4) for y in (0, 1) for z in (0, 1)], dtype=np.float32)
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
FACES = np.array([[q[0], q[i], q[i + 1]] for q in QUADS for i in (1, 2)], dtype=np.uint32)


class Bar:
    """What `tetrahedralize` takes as one object."""

    vertices, faces = CORNERS, FACES


@pytest.fixture(scope="module")
def mesh():
    return tetsoup.tetrahedralize(Bar(), tets=300)


@pytest.fixture(scope="module")
def calibration(mesh):
    return mesh.calibrate(Bar(), poisson=0.4, reference_tets=10000)


def test_a_coarse_bar_gets_frequencies_and_mass_of_the_fine_one(mesh, calibration):
    report = calibration.report
    assert report.reference_tets > 8000
    assert report.before.low > 5 * report.after.low
    assert report.after.low < 0.02 and report.after.high < 0.04 and report.after.load < 0.05
    assert 0.3 < calibration.factor < 1
    assert calibration.stiffness_scale.shape == calibration.density_scale.shape == (len(mesh.tets),)
    assert calibration.stiffness_scale.dtype == np.float32
    corners = mesh.points[mesh.tets].astype(float)
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert volumes @ calibration.density_scale == pytest.approx(4, rel=0.01)
    assert calibration.as_dict()["report"]["after"]["low"] == report.after.low


def test_files_hold_what_they_have_a_place_for(mesh, calibration, tmp_path):
    mesh.save(tmp_path / "body.npz", young=1e6, poisson=0.25, calibration=calibration)
    arrays = np.load(tmp_path / "body.npz")
    assert (arrays["stiffness_scale"] == calibration.stiffness_scale).all()
    assert (arrays["density_scale"] == calibration.density_scale).all()
    assert arrays["k_mu"] == pytest.approx(4e5 * calibration.stiffness_scale)
    mesh.save(tmp_path / "body.json", calibration=calibration)
    assert json.loads((tmp_path / "body.json").read_text())["stiffness_factor"] == pytest.approx(calibration.factor)
    scene = mesh.save(tmp_path / "body", engine="mujoco", young=1e6, calibration=calibration)[1].read_text()
    assert "calibrated: " in scene
    assert "calibrated" not in mesh.save(tmp_path / "body", engine="mujoco", young=1e6)[1].read_text()


def test_what_does_not_fit_is_refused(mesh, calibration, tmp_path):
    other = tetsoup.tetrahedralize(Bar(), tets=100)
    with pytest.raises(tetsoup.InvalidInput, match="calibration is of"):
        other.save(tmp_path / "body.npz", calibration=calibration)
    with pytest.raises(tetsoup.InvalidInput, match="poisson"):
        mesh.calibrate(Bar(), poisson=0.5)
    with pytest.raises(tetsoup.InvalidInput, match="reference_tets"):
        mesh.calibrate(Bar(), reference_tets=10)


def test_it_tells_how_far_it_is_and_stops_when_told(mesh):
    stages = []
    mesh.calibrate(Bar(), reference_tets=1000, progress=lambda stage, fraction: stages.append(stage))
    assert "calibrate" in stages
    with pytest.raises(tetsoup.Cancelled):
        mesh.calibrate(Bar(), reference_tets=1000, progress=lambda stage, fraction: stage != "calibrate")
