"""Meshes of the same objects by several meshers, each simulated by tetsoup.Simulation."""
import json
import resource

from child import run_child
from compare_engines import brief

PACKAGES = ["tetsoup", "pytetwild", "tetgen", "gmsh", "pymeshfix", "scipy"]
QUICK_OBJECTS = ["robot"]
BUDGET = 120  # s of processor time, after which a mesher is given up


def limit_time():
    resource.setrlimit(resource.RLIMIT_CPU, (BUDGET, BUDGET))


def child(script, *arguments):
    return run_child(script, *arguments, too_long=f"> {BUDGET} s", before=limit_time)


def meshed(maker, name, path, keep):
    """What meshers.py says, now or, if it is to be kept, in the run before."""
    said = path.with_suffix(".said.json")
    if not (keep and said.exists()):
        said.write_text(json.dumps(child("meshers.py", maker, name, path)))
    return json.loads(said.read_text())


def measure(name, folder, makers, keep):
    """A row for every mesher, one after the other."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = {}
    for maker in makers:
        path = folder / f"{name}_{maker.replace(', ', '_')}.npz"
        row = {"object": name, "maker": maker, "meshing": meshed(maker, name, path, keep)}
        if "why" not in row["meshing"]:
            row |= child("simulate_mesh.py", path)
        print(f"  {name:10} {maker:22} {describe(row)}", flush=True)
        rows[maker] = [row]
    return rows


def describe(row):
    if "potentials" not in row:
        return row.get("why") or row["meshing"].get("why", "")
    return f"{row['tets']} tets, step {1e6 * row['step']:.0f} us, {row['implicit']['per_second']:.3g} s a second"


def table(rows):
    header = ["object", "mesh", "tets", "smallest angle", "meshing s", "largest explicit step, us", "explicit work, M tet steps a second",
              "Implicit: substeps a frame", "s a second", "stable", "Potentials: step, us", "Potentials: s a second"]
    lines = []
    for row in rows:
        cells = [row["object"], row["maker"]]
        if "potentials" not in row:
            lines.append([*cells, "–", "–", "–", "–", "–", "–", "–", row.get("why") or row["meshing"]["why"], "–", "–"])
            continue
        implicit, potentials = row["implicit"], row["potentials"]
        lines.append([
            *cells, f"{row['tets']:,}", f"{row['angle']:.1f}", f"{row['meshing']['seconds']:.2g}", f"{1e6 * row['step']:.3g}",
            brief(row["tets"] / row["step"] / 1e6), f"{1 / 60 / implicit['step']:.0f}", f"{implicit['per_second']:.3g}",
            "yes" if implicit["stable"] else implicit["why"], f"{1e6 * potentials['step']:.3g}",
            brief(potentials["per_second"])])
    return header, lines
