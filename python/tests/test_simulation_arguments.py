"""What a simulation is given: whatever is wrong is a ValueError and changes nothing, whatever is taken stays finite."""

from __future__ import annotations

import math

import numpy as np
import pytest
import tetsoup
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

FRAME = 1 / 60
CORNER = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])


@pytest.mark.parametrize(
    ("option", "says"),
    [
        ({"substeps": 0}, "substeps = 0"),
        ({"substeps": 2.5}, "substeps = 2.5, must be a whole number"),
        ({"solver": "fast"}, "solver = 'fast', must be one of 'implicit', 'potentials'"),
        ({"contacts": True}, "contacts = True"),
        ({"contact_interval": 0}, "contact_interval"),
        ({"gravity": (0, 0)}, "gravity = .*three numbers"),
        ({"gravity": (0, math.nan, 0)}, "gravity"),
        ({"distance_stiffness": -1}, "distance"),
        ({"volume_stiffness": "much"}, "volume_stiffness = 'much', must be a number, or None"),
    ],
)
def test_options_out_of_range_are_value_errors(option, says):
    with pytest.raises(tetsoup.InvalidInput, match=says):
        tetsoup.Simulation(**option)
    with pytest.raises(TypeError, match="substep"):
        tetsoup.Simulation(substep=3)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda s: s.add_body(CORNER, young=-1), "young = -1"),
        (lambda s: s.add_body(CORNER, young="stiff"), "young = 'stiff'"),
        (lambda s: s.add_body(CORNER, density=math.nan), "density"),
        (lambda s: s.add_body(CORNER, poisson=0.5), "poisson = 0.5"),
        (lambda s: s.add_body(CORNER, friction=-1), "friction"),
        (lambda s: s.add_body(CORNER, damping_time=math.inf), "damping_time"),
        (lambda s: s.add_body(CORNER, metres_per_unit=0), "metres_per_unit"),
        (lambda s: s.add_body(CORNER, translate=(0, 0)), "translate"),
        (lambda s: s.add_body(CORNER, translate=(0, 0, 1e9)), "translate"),
        (lambda s: s.add_body(CORNER, rotate="abc"), "rotate"),
        (lambda s: s.add_body(CORNER, rotate=(0, 0, math.nan)), "rotate"),
        (lambda s: s.add_body(CORNER, scale=0), "scale = 0"),
        (lambda s: s.add_body(CORNER, scale=10**400), "scale"),
        (lambda s: s.add_body(CORNER, velocity=(0, 0, 1e9)), "velocity"),
        (lambda s: s.add_body(CORNER, spin=None), "spin"),
        (lambda s: s.add_body("bunny.ply"), "mesh is of the type str, must be a TetMesh"),
        (lambda s: s.add_bodies(CORNER, [(0, 0)]), "translate has the shape"),
        (lambda s: s.add_bodies(CORNER, [(0, 0, 1)] * 3, scale=[1, 2]), "scale has the shape"),
        (lambda s: s.add_bodies(CORNER, [(0, 0, 1)] * 3, rotate=[[1, 2, "a"]]), "rotate has the shape"),
        (lambda s: s.add_bodies(CORNER, [(0, 0, 1), (0, 0, math.inf)]), "translate"),
        (lambda s: s.add_plane((0, 0, 0)), "normal"),
        (lambda s: s.add_plane((0, 0, 1), math.nan), "offset"),
        (lambda s: s.add_plane((0, 0, 1), 0, -1), "friction"),
        (lambda s: s.add_plane("up"), "normal"),
        (lambda s: s.add_obstacle([[0, 0, math.nan]] * 3, [[0, 1, 2]]), "no finite triangle"),
        (lambda s: s.add_obstacle(np.eye(3), [[0, 1, 2]], voxels=0), "voxels"),
        (lambda s: s.add_obstacle(np.eye(3), [[0, 1, 2]], voxels=1.5), "voxels"),
        (lambda s: s.add_obstacle(np.eye(3), [[0, 1, -2]]), "negative"),
        (lambda s: s.pin(0, 4), "vertices has the index 4, must be below 4"),
        (lambda s: s.pin(0, [0, -1]), "negative"),
        (lambda s: s.pin(0, [0.5]), "vertices has the type"),
        (lambda s: s.pin(1, 0), "body = 1"),
        (lambda s: s.pin(-1, 0), "body = -1"),
        (lambda s: s.pin("a", 0), "body = 'a'"),
        (lambda s: s.attach(0, 0, 0, 4), "vertex"),
        (lambda s: s.add_spring(0, 2**40, (0, 0, 0), 1), "vertex"),
        (lambda s: s.add_spring(0, 0, (0, 0, math.nan), 1), "target"),
        (lambda s: s.add_spring(0, 0, (0, 0, 0), 0), "stiffness"),
        (lambda s: s.move_spring(0, (0, 0, 0)), "spring"),
        (lambda s: s.remove_spring(-1), "spring"),
        (lambda s: s.step(0), "dt = 0"),
        (lambda s: s.step(math.nan), "dt"),
        (lambda s: s.step("long"), "dt = 'long'"),
        (lambda s: s.positions(1), "body = 1"),
        (lambda s: s.velocities(None), "body = None"),
        (lambda s: s.volume(9), "body = 9"),
        (lambda s: s.momentum(9), "body = 9"),
        (lambda s: s.set_positions(0, CORNER.points[1:]), "positions = 3"),
        (lambda s: s.set_positions(0, CORNER.points[:, :2]), "positions has the shape"),
        (lambda s: s.set_positions(0, CORNER.points * np.nan), "position"),
        (lambda s: s.set_velocities(0, CORNER.points * 1e9), "velocity"),
    ],
)
def test_wrong_calls_are_value_errors_and_change_nothing(call, says):
    simulation = tetsoup.Simulation()
    simulation.add_body(CORNER)
    before = simulation.state_hash
    with pytest.raises(tetsoup.InvalidInput, match=says):
        call(simulation)
    assert (simulation.state_hash, simulation.body_count) == (before, 1)


def test_meshes_without_a_tet_that_can_move_are_bodies_that_stay():
    simulation = tetsoup.Simulation()
    empty = simulation.add_body(tetsoup.TetMesh([], []))
    flat = simulation.add_body(tetsoup.TetMesh(np.zeros((4, 3)), [[0, 1, 2, 3]]), translate=(0, 0, 1))
    lost = simulation.add_body(tetsoup.TetMesh(CORNER.points * np.nan, CORNER.tets))
    simulation.step(FRAME)
    assert simulation.positions(empty).shape == (0, 3)
    assert simulation.positions(flat).tolist() == [[0, 0, 1]] * 4
    assert np.isfinite(simulation.positions(lost)).all()
    assert (simulation.report.left_out, simulation.report.loose_vertices) == (2, 8)


SMALL = st.floats(-3, 3)


@given(
    points=hnp.arrays(np.float32, (8, 3), elements=st.floats(-2, 2, width=32)),
    tets=hnp.arrays(np.int32, st.tuples(st.integers(0, 10), st.just(4)), elements=st.integers(0, 7)),
    options=st.fixed_dictionaries(
        {},
        optional={
            "solver": st.sampled_from(["implicit", "potentials"]),
            "gravity": st.tuples(SMALL, SMALL, SMALL),
            "substeps": st.integers(1, 12),
            "contact_interval": st.integers(1, 12),
            "contacts": st.sampled_from(["all", "between", "none"]),
        },
    ),
    body=st.fixed_dictionaries(
        {},
        optional={
            "young": st.floats(1, 1e7),
            "density": st.floats(0.1, 1e4),
            "poisson": st.floats(0, 0.49),
            "damping_time": st.floats(0, 1),
            "friction": st.floats(0, 3),
            "rotate": st.tuples(SMALL, SMALL, SMALL),
            "scale": st.floats(0.1, 3),
            "velocity": st.tuples(SMALL, SMALL, SMALL),
            "spin": st.tuples(SMALL, SMALL, SMALL),
        },
    ),
    thrown=hnp.arrays(np.float32, (8, 3), elements=st.floats(-9, 9, width=32)),
)
def test_random_bodies_stay_finite(points, tets, options, body, thrown):
    simulation = tetsoup.Simulation(**options)
    simulation.add_plane((0, 0, 1), -1)
    mesh = tetsoup.TetMesh(points, tets)
    for height in (0, 0.5):
        simulation.add_body(mesh, translate=(0, 0, height), **body)
    simulation.set_positions(0, thrown)
    simulation.pin(1, 0)
    for _ in range(4):
        simulation.step(FRAME)
    for number in range(2):
        assert np.isfinite(simulation.positions(number)).all() and np.isfinite(simulation.velocities(number)).all()
    assert math.isfinite(simulation.energy.total)


@given(
    values=hnp.arrays(
        st.sampled_from([np.float16, np.float32, np.float64, np.int8, np.uint64]),
        st.tuples(st.integers(0, 5), st.integers(1, 4)),
    ),
    number=st.one_of(st.none(), st.integers(), st.floats(), st.text(max_size=3)),
)
def test_random_arguments_are_taken_or_refused(values, number):
    simulation = tetsoup.Simulation(contacts="none")
    simulation.add_body(CORNER)
    for call in (
        lambda: simulation.set_positions(0, values),
        lambda: simulation.set_velocities(0, values),
        lambda: simulation.add_bodies(CORNER, values, scale=number),
        lambda: simulation.pin(0, values[0] if len(values) else number),
        lambda: simulation.pin(number, 0),
        lambda: simulation.add_spring(number, 0, values[0] if len(values) else (), number),
        lambda: simulation.add_plane((0, 0, number), number, number),
        lambda: simulation.step(number),
    ):
        try:
            call()
        except tetsoup.InvalidInput as error:
            assert str(error)
    simulation.step(FRAME)
    assert np.isfinite(simulation.positions(0)).all()
