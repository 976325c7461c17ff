"""Every soup of a folder becomes a .msh and a row of batch.csv; a bad file is a row, too, and stops nobody.

The interpreter is free while tetsoup works, so a few threads mesh a few files at once.

usage: batch.py FOLDER OUT_FOLDER [TETS]
"""

import csv
import pathlib
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import tetsoup

SUFFIXES = {".obj", ".stl", ".ply", ".off", ".gltf", ".glb"}


def mesh_file(path, out, tets):
    row = {"file": path.name, "tets": "", "parts": "", "min angle": "", "error": ""}
    try:
        mesh = tetsoup.tetrahedralize(path, tets=tets)
        mesh.save(out / f"{path.stem}.msh")
    except (tetsoup.InvalidInput, tetsoup.IoError) as error:
        return row | {"error": str(error)}
    quality = mesh.quality
    return row | {
        "tets": quality.tet_count,
        "parts": quality.components,
        "min angle": round(float(np.degrees(quality.min_dihedral)), 1),
    }


def main(folder, out, tets="2000"):
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    paths = sorted(p for p in pathlib.Path(folder).iterdir() if p.suffix.lower() in SUFFIXES)
    with ThreadPoolExecutor(max_workers=2) as pool:
        rows = list(pool.map(lambda path: mesh_file(path, out, int(tets)), paths))
    with open(out / "batch.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, ["file", "tets", "parts", "min angle", "error"])
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print(row["file"], row["error"] or f"{row['tets']} tets, {row['parts']} part(s)")


if __name__ == "__main__":
    main(*sys.argv[1:])
