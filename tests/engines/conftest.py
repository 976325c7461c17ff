"""Meshes written by the tool for every engine, and the list of what was proven with them."""
import json
import os
import pathlib
import subprocess

import pytest

from bodies import BODIES, Written

ROOT = pathlib.Path(__file__).parents[2]
TOOL = pathlib.Path(os.environ.get("TETSOUP", ROOT / "build/release/bin/tetsoup"))
RESULTS = pathlib.Path(os.environ.get("TETSOUP_ENGINE_RESULTS", ROOT / "build/engine_results"))


@pytest.fixture(scope="session")
def write(tmp_path_factory):
    """write(engine, body, tets, option...): the files that the tool writes, once a process. With `by="--format"` it is
    a format instead of an engine, and `ending` the file's."""
    folder, made = tmp_path_factory.mktemp("written"), {}

    def source_of(body):
        if body.sample:
            path = folder / (body.name + ".obj")
            if not path.exists():
                subprocess.run([TOOL, "sample", body.sample, "-o", path], check=True, capture_output=True)
            return path
        path = ROOT.parent / "shared/models" / body.file
        if not path.exists():
            pytest.skip(f"the model {body.file} is not here")
        return path

    def write_once(engine, name, tets=500, *options, by="--for", ending=""):
        key = engine, name, tets, options, ending
        if key not in made:
            body = BODIES[name]
            target = folder / str(len(made)) / f"{name}_{tets}{ending}"
            target.parent.mkdir()
            report = target.parent / "report"
            subprocess.run(
                [TOOL, "mesh", source_of(body), "-o", target, by, engine, "--tets", str(tets), "--up", body.up,
                 "--metres-per-unit", str(body.metres_per_unit), "--json", report, "--quiet", *options], check=True)
            made[key] = Written(body, tets, json.loads(report.read_text()), target.parent, source_of(body))
        return made[key]

    return write_once


@pytest.fixture
def prove(request):
    """prove(engine, what, body, tets, **numbers): keeps a row for docs/ENGINES.md; docs.py reads them."""

    def keep(engine, what, written, **numbers):
        RESULTS.mkdir(parents=True, exist_ok=True)
        worker = os.environ.get("PYTEST_XDIST_WORKER", "main")
        row = dict(engine=engine, what=what, body=written.body.name, tets=written.tets, **numbers)
        with open(RESULTS / f"{worker}.jsonl", "a") as file:
            file.write(json.dumps(row) + "\n")

    return keep
