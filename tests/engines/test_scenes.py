"""Scenes with what users say of them: vertices that are held, a stiffness of their own, a window to look into."""
import json
import subprocess
import sys

import numpy
import pytest

from bodies import assert_silent
from checkers import sofa_scene
from drops import ENDINGS, assert_near_rest, judge, run
from test_load import READERS, load_newton

SCRIPTS = [engine for engine in ENDINGS if engine != "mujoco"]
HEAD = "-z:-2.2"  # The head of the robot, of which it hangs.


def held_vertices(write):
    written = write("godot", "robot", 500, "--pin-below", HEAD)
    (pin,) = json.loads(written.path(".json").read_text())["pins"]
    assert 3 < len(pin["vertices"]) < written.report["vertex_count"] / 4
    return pin["vertices"]


@pytest.mark.parametrize("engine", ENDINGS)
def test_held_vertices_stay_and_the_rest_hangs_from_them(engine, write, capfd):
    held = held_vertices(write)
    written = write(engine, "robot", 500, "--pin-below", HEAD)
    capfd.readouterr()
    (start, end, velocities), _ = run(engine, written)
    assert_silent(capfd)
    numbers = judge(start, end, velocities, READERS[engine](written)[1])
    height, moved = numpy.ptp(start[:, 2]), numpy.linalg.norm(end - start, axis=1)
    assert moved[held].max() < 0.002 * height
    free = numpy.setdiff1d(numpy.arange(len(start)), held)
    assert moved[free].max() > 0.002 * height  # It sags,
    assert end[:, 2].min() > 0.01 * height  # but does not fall.
    assert abs(numbers["swelling"]) < 0.1


@pytest.mark.parametrize("engine", ENDINGS)
def test_a_stiffness_of_ones_own_is_kept_and_runs(engine, write, capfd):
    """A bunny of 15 cm, many times stiffer than the explicit engines bear at their own step."""
    written = write(engine, "bunny", 500, "--young", "2e5")
    assert "2e+05" in written.path(ENDINGS[engine]).read_text()
    capfd.readouterr()
    (start, end, velocities), _ = run(engine, written)
    assert_silent(capfd)
    assert_near_rest(judge(start, end, velocities, READERS[engine](written)[1]))


@pytest.mark.parametrize("engine", SCRIPTS)
def test_a_scene_is_a_program_that_runs_wherever_one_stands(engine, write, tmp_path):
    written = write(engine, "bunny", 500)
    ran = subprocess.run([sys.executable, written.path(ENDINGS[engine])], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert "at the end: lowest point" in ran.stdout
    assert not list(tmp_path.iterdir())


def view_newton(monkeypatch):
    """The same calls on a viewer without a window, closed after a few frames."""
    import newton

    monkeypatch.setattr(newton.viewer, "ViewerGL", lambda: newton.viewer.ViewerNull(num_frames=70))


def view_bullet(monkeypatch):
    """A window that cannot be is a world without one, closed after a second and a bit."""
    import pybullet

    step, left = pybullet.stepSimulation, [400]

    def step_or_close():
        step()
        left[0] -= 1
        if left[0] == 0:
            pybullet.disconnect()

    monkeypatch.setattr(pybullet, "GUI", pybullet.DIRECT)
    monkeypatch.setattr(pybullet, "stepSimulation", step_or_close)


def view_drake(monkeypatch):
    """Meshcat serves whether or not a browser looks; its button is pressed from here."""
    import pydrake.all as drake

    monkeypatch.setattr(drake.Meshcat, "GetButtonClicks", lambda *_: 1)


@pytest.mark.parametrize("engine", SCRIPTS)
def test_a_scene_can_be_watched(engine, write, monkeypatch):
    written = write(engine, "bunny", 500)
    {"newton": view_newton, "bullet": view_bullet, "drake": view_drake}[engine](monkeypatch)
    (start, end, velocities), _ = run(engine, written, view=True)
    assert_near_rest(judge(start, end, velocities, READERS[engine](written)[1]))


def test_sofa_holds_and_stiffens_what_it_is_told(write):
    written = write("sofa", "robot", 500, "--pin-below", HEAD, "--young", "2e5")
    READERS["sofa"](written)
    (body,) = sofa_scene(written).children.values()
    data = dict(body.objects)
    assert data["FixedProjectiveConstraint"]["indices"] == held_vertices(write)
    assert data["TetrahedronFEMForceField"]["youngModulus"] == [2e5]
    assert data["MeshMatrixMass"]["totalMass"] == pytest.approx(1000 * written.volume, rel=1e-3)


def test_newton_reads_the_stiffness_from_the_mesh_file(write):
    import newton

    written = write("newton", "robot", 500, "--young", "2e5", "--poisson", "0.25", "--density", "500")
    mesh = newton.TetMesh.create_from_file(str(written.path(".npz")))
    assert numpy.allclose(mesh.k_mu, 8e4) and numpy.allclose(mesh.k_lambda, 8e4) and mesh.density == 500
    written.agrees_with(*load_newton(written))


def test_bullets_scene_says_that_several_pieces_cannot_be_loaded(write):
    written = write("bullet", "pr2", 500)
    ran = subprocess.run([sys.executable, written.path("_pybullet.py")], capture_output=True, text=True, timeout=60)
    assert ran.returncode == 1 and "pieces" in ran.stderr
