"""The package itself: command, types, docs, examples."""

from __future__ import annotations

import inspect
import pathlib
import re
import subprocess
import sys
import typing

import numpy as np
import pytest
import tetsoup
from conftest import ROOT, real_package
from tetsoup import _core

EXAMPLES = ROOT / "examples" / "python"
PUBLIC = [getattr(tetsoup, name) for name in tetsoup.__all__ if not name.startswith("_")]


def run(*command, cwd=None, code=0):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


def test_the_version_is_the_projects():
    wanted = re.search(r"project\(tetsoup VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert wanted and tetsoup.__version__ == wanted[1]


def test_the_command_is_the_tool():
    assert tetsoup.__version__ in run(sys.executable, "-m", "tetsoup", "--version")
    run(sys.executable, "-m", "tetsoup", "mesh", "nowhere.obj", "-o", "x.msh", code=3)


def test_every_option_of_the_library_has_a_keyword_with_a_type():
    for group, stage in (
        (tetsoup.DistanceOptions, "distance"),
        (tetsoup.PseudoVolumeOptions, "pseudo_volume"),
        (tetsoup.LatticeOptions, "lattice"),
        (tetsoup.SmoothOptions, "smooth"),
        (tetsoup.MeshOptions, ""),
        (tetsoup.SimulationOptions, "simulation"),
        (tetsoup.MaterialOptions, "material"),
        (tetsoup.PoseOptions, "pose"),
    ):
        assert set(typing.get_type_hints(group)) == set(_core.default_options(stage))
    signature = inspect.signature(tetsoup.tetrahedralize)
    assert signature.parameters["rho_min"].default == tetsoup.default_options()["rho_min"]
    assert "rho_min" in tetsoup.tetrahedralize.__doc__ and "rho_min" not in tetsoup.smooth.__doc__
    assert inspect.signature(tetsoup.Simulation.add_body).parameters["young"].default == 1e5


def test_defaults_are_the_librarys(cube):
    plain, spelled = (tetsoup.tetrahedralize(*cube, **options) for options in ({}, tetsoup.default_options()))
    assert plain.points.tobytes() == spelled.points.tobytes()


@pytest.mark.parametrize(
    "thing", [p for p in PUBLIC if inspect.isfunction(p) or inspect.isclass(p)], ids=lambda p: p.__name__
)
def test_everything_public_is_documented(thing):
    assert inspect.getdoc(thing)
    if inspect.isfunction(thing) and thing.__name__ not in ("sample_names", "formats", "thread_count"):
        assert "Example" in inspect.getdoc(thing)


def test_types_hold_in_a_typed_program_and_mistakes_are_found(tmp_path):
    real_package("mypy")
    here = pathlib.Path(__file__).parent
    config = ["--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", str(tmp_path)]
    run(sys.executable, "-m", "mypy", *config, "-p", "tetsoup", cwd=tmp_path)
    run(sys.executable, "-m", "mypy", *config, str(here / "typed_sample.py"), cwd=tmp_path)
    found = run(sys.executable, "-m", "mypy", *config, str(here / "typed_mistakes.py"), cwd=tmp_path, code=1)
    marked = [i for i, line in enumerate((here / "typed_mistakes.py").read_text().splitlines(), 1) if "# wrong" in line]
    assert sorted({int(line) for line in re.findall(r"typed_mistakes\.py:(\d+): error", found)}) == marked


def test_example_mesh_and_show(tmp_path):
    assert "tets>" in run(sys.executable, EXAMPLES / "mesh_and_show.py", cwd=tmp_path)
    assert (tmp_path / "tree.png").read_bytes().startswith(b"\x89PNG")


def test_example_sweep(tmp_path):
    assert "computed 1 time(s)" in run(sys.executable, EXAMPLES / "sweep.py", cwd=tmp_path).replace("  ", " ")


def test_example_embed_and_deform(tmp_path):
    said = run(sys.executable, EXAMPLES / "embed_and_deform.py", cwd=tmp_path)
    error = re.search(r"at most ([0-9.]+) % of its size", said)
    assert error and float(error[1]) < 1, said
    assert len(tetsoup.read(tmp_path / "bent.obj").faces) == len(tetsoup.sample("tree").faces)


def test_example_batch(tmp_path):
    for name in ("torus", "robot"):
        run(sys.executable, "-m", "tetsoup", "sample", name, "-o", f"{name}.obj", cwd=tmp_path)
    (tmp_path / "bad.ply").write_text("ply\n")
    (tmp_path / "empty.obj").write_text("# nothing\n")
    run(sys.executable, EXAMPLES / "batch.py", tmp_path, tmp_path / "out", cwd=tmp_path)
    assert {p.name for p in (tmp_path / "out").iterdir()} == {"torus.msh", "robot.msh", "batch.csv"}
    assert len((tmp_path / "out" / "batch.csv").read_text().splitlines()) == 5


@pytest.fixture(scope="module")
def off_screen(tmp_path_factory):
    """What makes pyvista draw without a screen, or the test is skipped where it cannot."""
    real_package("pyvista")
    lines = "import pyvista; pyvista.OFF_SCREEN = True\n"
    probe = [sys.executable, "-c", f"{lines}pyvista.Sphere().plot(screenshot='probe.png')"]
    if subprocess.run(probe, cwd=tmp_path_factory.mktemp("probe"), capture_output=True, check=False).returncode != 0:
        pytest.skip("pyvista cannot draw off screen here")
    return lines


@pytest.mark.parametrize("source", ["heart", "bunny"])
def test_example_drop_bunny(off_screen, source, request, tmp_path):
    image = real_package("PIL.Image")
    example, path = EXAMPLES / "drop_bunny.py", "" if source == "heart" else request.getfixturevalue("bunny")
    assert len(example.read_text().splitlines()) < 30
    run(sys.executable, example, path, "drop.gif", "15", cwd=tmp_path)
    with image.open(tmp_path / "drop.gif") as picture:
        frames = []
        for frame in range(picture.n_frames):
            picture.seek(frame)
            frames.append(np.asarray(picture.convert("L"), float))
    assert len(frames) == 15
    heights = [np.flatnonzero((frame - frames[-1]).any(axis=1)).min() for frame in frames[:-1]]
    assert heights[0] < heights[-1]  # rows count downwards: it falls


def test_the_readmes_lines_mesh_the_bunny_and_show_it(off_screen, bunny, tmp_path):
    pyvista = real_package("pyvista")
    readme = (ROOT / "python" / "README.md").read_text()
    lines = re.search(r"```python\n(.*?)```", readme, re.DOTALL)
    assert lines and lines[1].count("\n") <= 12
    (tmp_path / "bunny.ply").symlink_to(bunny)
    run(sys.executable, "-c", off_screen + lines[1].replace("cpos=", "screenshot='bunny.png', cpos="), cwd=tmp_path)
    assert len(tetsoup.read_tets(tmp_path / "bunny.msh").tets) == pytest.approx(2000, rel=0.05)
    assert pyvista.read(tmp_path / "bunny.png").get_array("PNGImage").std() > 10  # something is drawn
