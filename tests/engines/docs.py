"""Writes the table of docs/ENGINES.md, between its two marks, from what the suite kept: python docs.py RESULTS PAGE"""
import collections
import datetime
import importlib.metadata
import json
import pathlib
import shutil
import subprocess
import sys

from bodies import BODIES, SIZES
from drops import ENDINGS, SHORTCOMINGS

PACKAGES = {
    "abaqus": "meshio", "blender": "trimesh", "bullet": "pybullet", "drake": "drake", "genesis": "meshio",
    "gmsh": "gmsh", "isaac": "usd-core", "mmg": "meshio", "mujoco": "mujoco", "netgen": "netgen-mesher",
    "newton": "newton", "paraview": "pyvista", "tetgen": "meshio", "usd": "usd-core"}
BEGIN, END = "<!-- table: written by scripts/test_engines --docs -->", "<!-- end of table -->"


def version_of(engine):
    if engine == "calculix":
        ccx = shutil.which("ccx")
        return "ccx " + subprocess.run([ccx, "-v"], capture_output=True, text=True).stdout.split()[-1] if ccx else "–"
    package = PACKAGES.get(engine)
    return f"{package} {importlib.metadata.version(package)}" if package else "none: rules checked only"


def table(rows):
    proven = collections.defaultdict(lambda: collections.defaultdict(dict))
    for row in rows:
        proven[row["engine"]][row["what"]][row["body"], row["tets"]] = row
    total = len(BODIES) * len(SIZES)
    columns = ["`--for`", "read by", "counts and volume", "a second's fall ends near rest",
               "seconds simulated a processor's second, 500 / 2,000 tets"]
    text = [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
    for engine in sorted(proven):
        kept = proven[engine]
        loaded, rest = len(kept["load"]), len(kept["rest"])
        fall = speed = "–"
        if engine in ENDINGS:
            fall = f"{rest} of {total}"
            rates = []
            for size in SIZES:
                seconds = sorted(row["seconds"] for (_, tets), row in kept["drop"].items() if tets == size)
                rates.append(f"{1 / seconds[len(seconds) // 2]:.2g}" if seconds else "–")
            speed = " / ".join(rates)
        text.append(f"| `{engine}` | {version_of(engine)} | {loaded} of {total} | {fall} | {speed} |")
    text += ["", f"{datetime.date.today():%d %B %Y}; bodies: {', '.join(BODIES)}, each of {SIZES[0]} and "
             f"{SIZES[1]:,} tets. Not taken:", ""]
    for (engine, body, tets), reason in SHORTCOMINGS.items():
        text.append(f"- `{engine}`, {body} of {tets:,} tets: {reason}.")
    return "\n".join(text)


if __name__ == "__main__":
    results, page = map(pathlib.Path, sys.argv[1:])
    rows = [json.loads(line) for file in sorted(results.glob("*.jsonl")) for line in file.read_text().splitlines()]
    before, rest = page.read_text().split(BEGIN)
    page.write_text(before + BEGIN + "\n\n" + table(rows) + "\n\n" + END + rest.split(END)[1])
