"""Writes what was proven (rows that the fixture `prove` kept) into the table of docs/ENGINES.md."""
import collections
import datetime
import importlib.metadata
import json
import pathlib
import shutil
import subprocess

from conftest import RESULTS, ROOT

PAGE = ROOT / "docs/ENGINES.md"
BEGIN, END = "<!-- engines:table -->", "<!-- engines:table end -->"

# The package that read each preset; presets without one were read by the checkers of this suite.
PACKAGES = {
    "abaqus": "meshio", "blender": "trimesh", "bullet": "pybullet", "calculix": "ccx", "drake": "drake", "gmsh": "gmsh",
    "isaac": "usd-core", "mmg": "meshio", "mujoco": "mujoco", "netgen": "netgen-mesher", "newton": "newton",
    "paraview": "pyvista", "tetgen": "meshio", "usd": "usd-core"}
# Readers of the format that are not the engine: its rules stay unproven by itself.
STRANGERS = {"abaqus", "blender", "isaac", "mmg", "tetgen"}


def version_of(package):
    if package != "ccx":
        return importlib.metadata.version(package)
    path = shutil.which("ccx")
    return subprocess.run([path, "-v"], capture_output=True, text=True).stdout.split()[-1] if path else ""


def proven_by(engine, rows):
    kinds = {row["what"] for row in rows}
    package = PACKAGES.get(engine)
    words = []
    if "load" in kinds:
        words.append("loads, counts, volume" if package else "rules only")
    if engine in STRANGERS:
        words.append("not by the engine itself")
    if "rest" in kinds:
        words.append("falls and rests")
    elif "drop" in kinds:
        words.append("falls")
    return ", ".join(words)


def table_of(results, date):
    lines = ["| `--for` | read by | date | proven | bodies |", "|---|---|---|---|---|"]
    for engine in sorted(results):
        rows = results[engine]
        package = PACKAGES.get(engine)
        reader = f"{package} {version_of(package)}" if package else "-"
        bodies = len({(row["body"], row["tets"]) for row in rows if row["what"] == "load"})
        lines.append(f"| `{engine}` | {reader} | {date} | {proven_by(engine, rows)} | {bodies} |")
    return "\n".join(lines)


def main():
    results = collections.defaultdict(list)
    for path in sorted(pathlib.Path(RESULTS).glob("*.jsonl")):
        for line in path.read_text().splitlines():
            row = json.loads(line)
            if row["what"] in ("load", "drop", "rest"):
                results[row["engine"]].append(row)
    if not results:
        raise SystemExit(f"{RESULTS} holds no results: nothing was proven")
    text = PAGE.read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        raise SystemExit(f"{PAGE}: must hold {BEGIN} and {END} once each")
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    PAGE.write_text(f"{head}{BEGIN}\n{table_of(results, datetime.date.today())}\n{END}{tail}")


if __name__ == "__main__":
    main()
