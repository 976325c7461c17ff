"""Bodies fall, bend and collide; their arrays are views that never dangle."""

from __future__ import annotations

import gc
import json
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import tetsoup

FRAME = 1 / 60
CORNER = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])


SOUP = tetsoup.sample("torus")
SOUP = tetsoup.Soup(SOUP.vertices / np.ptp(SOUP.vertices, axis=0).max(), SOUP.faces)  # one metre


@pytest.fixture(scope="module")
def torus():
    return tetsoup.tetrahedralize(SOUP, voxels=32, cells=8)


@pytest.fixture
def fallen(torus):
    """A simulation of two bodies that have met the ground."""
    simulation = tetsoup.Simulation()
    simulation.add_plane()
    for height in (0.6, 1.4):
        simulation.add_body(torus, translate=(0, 0, height), rotate=(10, 20, 30), young=2e5)
    for _ in range(20):
        simulation.step(FRAME)
    return simulation


def address(array):
    return array.__array_interface__["data"][0]


def test_free_fall_is_exact(torus):
    simulation = tetsoup.Simulation()
    body = simulation.add_body(torus, translate=(0, 0, 20), velocity=(1, 2, 3))
    start = simulation.positions(body).mean(axis=0)
    for _ in range(60):
        simulation.step(FRAME)
    assert simulation.time == pytest.approx(1)
    assert np.allclose(simulation.positions(body).mean(axis=0) - start, [1, 2, 3 - 9.81 / 2], atol=1e-4)
    assert np.allclose(simulation.velocities(body).mean(axis=0), [1, 2, 3 - 9.81], atol=0.1)


def test_a_body_is_scaled_turned_and_shifted():
    simulation = tetsoup.Simulation()
    body = simulation.add_body(
        CORNER, scale=2, metres_per_unit=0.5, rotate=np.float32([90, 0, 90]), translate=[1, 2, 3]
    )
    # (x, y, z) -> about x: (x, -z, y) -> about z: (z, x, y)
    assert np.allclose(simulation.positions(body), CORNER.points[:, [2, 0, 1]] + [1, 2, 3], atol=1e-6)
    assert simulation.volume(body) == pytest.approx(1 / 6)
    assert (simulation.body_count, simulation.report.tet_count, simulation.report.left_out) == (1, 1, 0)


def test_angles_of_bodies_are_degrees():
    one, many = tetsoup.Simulation(gravity=(0, 0, 0)), tetsoup.Simulation(gravity=(0, 0, 0))
    one.add_body(CORNER, spin=(0, 0, 180))
    many.add_bodies(CORNER, [(0, 0, 0)], spin=(0, 0, 180))
    fast = np.pi * np.linalg.norm(CORNER.points[:, :2] - 0.25, axis=1)
    for simulation in (one, many):
        assert np.allclose(np.linalg.norm(simulation.velocities(0), axis=1), fast, rtol=1e-5)


def test_views_show_every_step_and_cannot_be_written(torus):
    simulation = tetsoup.Simulation()
    body = simulation.add_body(torus)
    for view in (simulation.positions(body), simulation.velocities(body)):
        assert (view.shape, view.dtype) == ((len(torus.points), 3), np.float32)
        before = view.copy()
        simulation.step(FRAME)
        assert not np.array_equal(view, before)
        with pytest.raises(ValueError):
            view[0] = 0
        with pytest.raises(ValueError):
            view.flags.writeable = True


def test_views_outlive_the_simulation(torus):
    simulation = tetsoup.Simulation()
    body = simulation.add_body(torus, translate=(1, 2, 3))
    views = simulation.positions(body), simulation.velocities(body)
    simulation.step(FRAME)
    before = [view.tobytes() for view in views]
    del simulation
    gc.collect()
    assert [np.zeros_like(view).sum() for view in views for _ in range(100)] == [0] * 200  # freed memory is reused
    assert [view.tobytes() for view in views] == before


def test_views_stay_where_they_are_when_bodies_are_added_and_states_restored(torus):
    simulation = tetsoup.Simulation()
    body = simulation.add_body(torus)
    views = simulation.positions(body), simulation.velocities(body)
    state = simulation.save_state()
    simulation.step(FRAME)
    simulation.restore_state(state)
    simulation.pin(body, 0)
    for _ in range(50):
        simulation.add_body(CORNER, translate=(0, 9, 0))
    simulation.add_bodies(torus, [(2 * i, 0, 0) for i in range(1, 101)])
    simulation.step(FRAME)
    assert [address(view) for view in views] == [address(simulation.positions(0)), address(simulation.velocities(0))]
    assert np.array_equal(views[0], simulation.positions(body))
    assert np.abs(views[0][0] - torus.points[0]).max() < 1e-6 < np.abs(views[0] - torus.points).max()


def test_an_embedded_surface_moves_along(torus):
    surface = torus.embed(SOUP)
    simulation = tetsoup.Simulation()
    body = simulation.add_body(torus, translate=(0, 0, 5))
    positions = simulation.positions(body)
    assert np.allclose(surface.deform(positions), SOUP.vertices + [0, 0, 5], atol=1e-5)
    for _ in range(30):
        simulation.step(FRAME)
    assert np.allclose(surface.deform(positions), SOUP.vertices + [0, 0, 5 - 9.81 / 8], atol=1e-3)


def test_bodies_come_to_rest_on_the_ground_and_on_each_other(torus):
    simulation = tetsoup.Simulation()
    simulation.add_plane((0, 0, 2), 0, friction=1)
    low, high = simulation.add_bodies(torus, [(0, 0, 0.4), (0, 0, 1.1)], young=2e5, damping_time=0.01)
    start = simulation.energy.total
    for _ in range(180):
        simulation.step(FRAME)
    assert simulation.positions(low)[:, 2].min() > -0.02
    assert simulation.positions(high)[:, 2].mean() > simulation.positions(low)[:, 2].mean() + 0.1
    assert np.abs(simulation.velocities(high)).max() < 0.2
    assert simulation.energy.total < start
    assert simulation.report.touching > 0
    assert simulation.volume(low) == pytest.approx(torus.quality.volume, rel=0.05)


@pytest.mark.parametrize("kind", ["arrays", "soup", "file", "corners"])
def test_an_obstacle_may_be_whatever_holds_triangles(cube, tmp_path, kind):
    vertices, faces = cube[0] * 4 - [2, 2, 4], cube[1]
    if kind == "file":
        tetsoup.RenderMesh(vertices, np.full(12, 3), faces.ravel()).save(tmp_path / "cube.obj")
    sources = {
        "arrays": (vertices, faces),
        "soup": (tetsoup.Soup(vertices.astype(np.float32), faces),),
        "file": (tmp_path / "cube.obj",),
        "corners": (vertices[faces],),
    }
    simulation = tetsoup.Simulation()
    simulation.add_obstacle(*sources[kind], voxels=24, friction=0.9)
    body = simulation.add_body(CORNER, translate=(-0.3, -0.3, 0.3), young=1e6)
    for _ in range(60):
        simulation.step(FRAME)
    assert -0.1 < simulation.positions(body)[:, 2].min() < 0.1


def test_obstacles_report_progress_and_are_cancelled(cube):
    simulation, seen = tetsoup.Simulation(), []
    simulation.add_obstacle(*cube, voxels=16, progress=lambda *call: seen.append(call))
    assert seen and seen[-1][1] == 1
    with pytest.raises(tetsoup.Cancelled):
        simulation.add_obstacle(*cube, voxels=16, progress=lambda *_: False)


def test_pins_hold_springs_pull_and_attachments_keep_together(torus):
    simulation = tetsoup.Simulation(contacts="none")
    held, hung, other = (simulation.add_body(torus, translate=(3 * i, 0, 0)) for i in range(3))
    low = torus.vertices_below(float(np.quantile(torus.points[:, 2], 0.2)))
    simulation.pin(held, low)
    spring = simulation.add_spring(hung, 0, (3, 0, 1), stiffness=1e6)
    simulation.attach(hung, 1, other, 2)
    for _ in range(10):
        simulation.step(FRAME)
    assert np.allclose(simulation.positions(held)[low], torus.points[low])
    assert np.linalg.norm(simulation.positions(hung)[0] - [3, 0, 1]) < 0.5
    gap = np.linalg.norm(simulation.positions(hung)[1] - simulation.positions(other)[2])
    assert gap < 0.1
    simulation.unpin(held, low)
    simulation.move_spring(spring, (3, 0, 2))
    simulation.remove_spring(spring)
    for _ in range(10):
        simulation.step(FRAME)
    assert (simulation.positions(held)[low, 2] < torus.points[low, 2] - 0.05).all()
    with pytest.raises(ValueError, match="spring"):
        simulation.move_spring(spring, (0, 0, 0))


def test_positions_and_velocities_can_be_set(torus):
    simulation = tetsoup.Simulation(gravity=(0, 0, 0))
    body = simulation.add_body(torus, damping_time=0.01)
    simulation.set_positions(body, simulation.positions(body) * (1, 1, 0))
    assert simulation.volume(body) == pytest.approx(0, abs=1e-6)
    for _ in range(120):
        simulation.step(FRAME)
    assert simulation.volume(body) == pytest.approx(torus.quality.volume, rel=0.05)
    simulation.set_velocities(body, np.tile([1, 0, 0], (len(torus.points), 1)))
    mass = torus.quality.volume * 1000
    assert np.allclose(simulation.momentum(body).linear, (mass, 0, 0), rtol=1e-4, atol=1e-3)
    assert simulation.energy.kinetic == pytest.approx(mass / 2, rel=1e-4)


def test_the_explicit_solver_takes_as_many_substeps_as_it_needs(torus):
    simulation = tetsoup.Simulation(solver="potentials", contacts="none", distance_stiffness=50, volume_stiffness=50)
    simulation.add_body(torus)
    simulation.step(FRAME)
    assert simulation.report.substeps > 10
    assert np.isfinite(simulation.positions(0)).all()


def test_many_bodies_at_once_are_the_same_as_one_after_the_other(torus):
    places = np.array([[0, 0, 1], [0.5, 0, 2], [3, 1, 1]], np.float32)
    turns = np.array([[0, 0, 0], [0, 45, 0], [90, 0, 10.0]])
    together, one_by_one = tetsoup.Simulation(), tetsoup.Simulation()
    assert together.add_bodies(torus, places, rotate=turns, velocity=(0, 0, 1), young=3e5) == range(3)
    for place, turn in zip(places, turns):
        one_by_one.add_body(torus, translate=place, rotate=turn, velocity=(0, 0, 1), young=3e5)
    for simulation in (together, one_by_one):
        for _ in range(10):
            simulation.step(FRAME)
    assert np.allclose(together.positions(1), one_by_one.positions(1), atol=1e-5)
    assert together.add_bodies(torus, []) == range(3, 3) and together.body_count == 3


def test_the_same_bits_for_any_number_of_threads_and_in_another_process(fallen, torus, tmp_path):
    wanted = fallen.state_hash
    tetsoup.set_thread_count(1)
    try:
        again = tetsoup.Simulation()
        again.add_plane()
        for height in (0.6, 1.4):
            again.add_body(torus, translate=(0, 0, height), rotate=(10, 20, 30), young=2e5)
        for _ in range(20):
            again.step(FRAME)
    finally:
        tetsoup.set_thread_count(0)
    assert again.state_hash == wanted
    np.savez(tmp_path / "torus.npz", points=torus.points, tets=torus.tets)
    program = """
import numpy, tetsoup
data = numpy.load("torus.npz")
simulation = tetsoup.Simulation()
simulation.add_plane()
for height in (0.6, 1.4):
    mesh = tetsoup.TetMesh(data["points"], data["tets"])
    simulation.add_body(mesh, translate=(0, 0, height), rotate=(10, 20, 30), young=2e5)
for _ in range(20):
    simulation.step(1 / 60)
print(simulation.state_hash)
"""
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert int(done.stdout) == wanted


def test_the_tool_plays_the_same_scene_to_the_same_bits(torus, tmp_path):
    torus.save(tmp_path / "torus.npz")
    place = {"translate": [0, 0, 0.6], "rotate": [10, 20, 30], "velocity": [0.5, 0, 0], "spin": [0, 90, 0]}
    body = {"tets_file": "torus.npz", "surface": False, "material": {"young": 2e5}, "place": place}
    scene = {"seconds": 0.5, "bodies": [body], "obstacles": [{"plane": {}}]}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    command = [sys.executable, "-m", "tetsoup", "simulate", "scene.json", "--json", "-", "--quiet"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    simulation = tetsoup.Simulation()
    simulation.add_plane()
    simulation.add_body(torus, young=2e5, **place)
    for _ in range(30):
        simulation.step(FRAME)
    assert simulation.report.touching > 0
    assert int(json.loads(done.stdout)["state_hash"], 16) == simulation.state_hash


def test_a_saved_state_goes_on_to_the_bit(fallen):
    state = fallen.save_state()
    for _ in range(5):
        fallen.step(FRAME)
    wanted, moment = fallen.state_hash, fallen.time
    fallen.restore_state(bytearray(state))
    assert fallen.time == pytest.approx(moment - 5 * FRAME)
    for _ in range(5):
        fallen.step(FRAME)
    assert (fallen.state_hash, fallen.time) == (wanted, moment)


def test_states_that_are_damaged_or_of_something_else_change_nothing(fallen, torus):
    state, before = fallen.save_state(), fallen.state_hash
    other = tetsoup.Simulation()
    other.add_body(torus)
    flipped = bytearray(state)
    flipped[len(flipped) // 2] ^= 1
    for bad in (b"", state[:-1], state[: len(state) // 2], bytes(flipped), other.save_state(), "text", None, 3):
        with pytest.raises(ValueError, match="state"):
            fallen.restore_state(bad)
        assert fallen.state_hash == before


def test_simulations_run_in_parallel_but_one_lets_a_single_thread_in(torus):
    busy, other = tetsoup.Simulation(substeps=10000), tetsoup.Simulation()
    busy.add_body(tetsoup.tetrahedralize(SOUP, voxels=32, tets=2000))  # a fifth of a second
    other.add_body(torus)
    refused, done = [], threading.Event()

    def work():
        busy.step(FRAME)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        other.step(FRAME)  # nobody holds the interpreter's lock
        try:
            busy.positions(0)
        except RuntimeError as error:
            refused.append(str(error))
    thread.join()
    assert any("is at work" in text for text in refused)
    assert busy.time == FRAME


def interrupted(program: str) -> tuple[str, str]:
    """What a program says on standard output after "begins", and on standard error, when Ctrl-C comes soon after."""
    process = subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a shell ignores it in the background
    )
    assert process.stdout is not None and process.stdout.readline() == "begins\n"
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    return process.communicate(timeout=20)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_a_loop_of_steps():
    _, said = interrupted("""
import tetsoup
simulation = tetsoup.Simulation()
simulation.add_body(tetsoup.tetrahedralize(tetsoup.sample("torus"), voxels=32, cells=8))
print("begins", flush=True)
while True:
    simulation.step(1 / 60)
""")
    assert said.splitlines()[-1].startswith("KeyboardInterrupt")


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_a_long_step_and_the_simulation_can_go_on():
    answer, said = interrupted("""
import tetsoup
simulation = tetsoup.Simulation(substeps=10000)
simulation.add_body(tetsoup.tetrahedralize(tetsoup.sample("torus"), voxels=32, cells=30))
print("begins", flush=True)
try:
    while True:
        simulation.step(1)
except KeyboardInterrupt:
    then = simulation.time
    simulation.step(0.001)
    print(then % 1 != 0 and simulation.time == then + 0.001)
    raise
""")
    assert said.splitlines()[-1].startswith("KeyboardInterrupt")
    assert answer == "True\n"


def test_it_says_what_it_is(fallen):
    assert repr(fallen).startswith("<tetsoup.Simulation: 2 bodies, ")
    assert set(fallen.report.as_dict()) >= {"tet_count", "substeps", "contacts", "touching"}
    assert fallen.energy.as_dict()["total"] == pytest.approx(
        fallen.energy.kinetic + fallen.energy.elastic + fallen.energy.gravity
    )
