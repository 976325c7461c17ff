"""Other tools on the same input and grid, one at a time, each as a process; ours beside them in the same run."""
import json
import pathlib
import re
import statistics
import subprocess
import tempfile

from harness import measure, tables
from harness.machine import output
from harness.measure import Row

KINDS = "oabc"
PROGRAMS = ["cgal_distance", "cgal_wrap", "cgal_mesh", "embree_distance", "openvdb_distance"]
MODULES = {"numpy": "numpy", "igl": "libigl", "open3d": "open3d", "pytetwild": "pytetwild", "tetgen": "tetgen", "gmsh": "gmsh"}
DEBIAN = {"cgal": "libcgal-dev", "embree": "libembree-dev", "openvdb": "libopenvdb-dev"}
TETS = 5000
MESH_PARTS = 26  # Mesh_3's edges as a part of the diagonal, for about as many tets
WRAP_PARTS = 20  # alpha as a part of the diagonal
OWN_GRIDS = (64, 128)  # ours, file to file; both with TETS
OWN_TIMEOUT = 600


class Peers:
    def __init__(self, root, session, sizes, timeout):
        self.root, self.session, self.sizes, self.timeout = root, session, sizes, timeout
        self.scripts, self.cpp = root / "bench/peers", root / "build/peers/cpp"
        self.python = root / "build/peers/venv/bin/python"
        self.folder = pathlib.Path(session.results_folder) / "peers"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.missing, self.versions = [], {}
        self.grids, self.widest = {}, {}
        self.look_for_peers()

    # --- what is there

    def look_for_peers(self):
        for module, package in MODULES.items():
            code = f"import {module}, importlib.metadata as m; print(m.version('{package}'))"
            version = output(str(self.python), "-c", code).splitlines()
            if version:
                self.versions[module] = version[-1]
            else:
                self.missing.append(f"{package} (pip)")
        for name in PROGRAMS:
            if (self.cpp / name).exists():
                library = name.split("_")[0]
                self.versions[library] = output("dpkg-query", "-W", "-f=${Version}", DEBIAN[library]) or "?"
            else:
                self.missing.append(name)

    def has(self, *needs):
        return all((self.cpp / need).exists() if need in PROGRAMS else need in self.versions for need in needs)

    # --- running

    def run(self, command):
        """Runs a peer; (process, its line of JSON or None, why not)."""
        child = measure.run_child(command, self.timeout, self.folder)  # some leave files where they run
        if child.code is None:
            return child, None, f"> {self.timeout:.0f} s"
        found = re.findall(r"^\{.*\}$", child.text, re.MULTILINE)
        if child.code != 0 or not found:
            why = "crashed" if child.code < 0 else "failed"
            print(f"    {' '.join(str(part) for part in command[:3])}: {why}: {measure.last_line(child.text)}")
            return child, None, why
        return child, json.loads(found[-1]), ""

    def add(self, row):
        self.session.rows.append(row)
        grid = f"{row.voxels}^3" if row.voxels else ""
        print(f"    {row.what:48} {row.soup} {grid} {row.note or tables.ms(row.best_ms) + ' ms'}", flush=True)

    def timed_row(self, what, kind, voxels, command):
        child, answer, why = self.run(command)
        row = Row(what, kind, voxels, note=why)
        row.peak_mb = child.peak_mb
        if answer:
            row.best_ms = row.median_ms = answer.pop("seconds") * 1e3
            row.cpu_ms, row.repetitions, row.counters = child.cpu_seconds * 1e3, 1, answer
        self.add(row)
        return row

    # --- the inputs, the grids, the truth

    def prepare(self):
        source = self.folder / "input.ply"
        subprocess.run([self.session.program, f"--save=input:{source}", f"--input={self.session.source}"], check=True)
        self.script("prepare.py", "inputs", source, self.folder)
        for voxels in self.sizes:
            self.grids[voxels], self.widest[voxels] = self.grid_of("o", voxels)
        if self.has("igl"):
            self.script("prepare.py", "truth", self.raw("o"), self.truth(), *self.grids[self.sizes[0]])

    def grid_of(self, kind, voxels):
        """Our grid over a soup as nx ny nz ox oy oz h, and the largest distance in voxels."""
        child, report = measure.run_tool(self.session.tool, self.soup(kind), ["--voxels", str(voxels)], OWN_TIMEOUT)
        if report is None:
            raise SystemExit(f"tetsoup at {voxels}^3: {measure.why_not(child, OWN_TIMEOUT)}")
        grid = report["grid"]
        words = [str(value) for value in (*grid["size"], *grid["origin"], grid["voxel_size"])]
        return words, grid["d_max"] / grid["voxel_size"]

    def script(self, name, *arguments):
        command = [str(part) for part in (self.python, self.scripts / name, *arguments)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{name} failed: {measure.last_line(done.stderr)}")
        return done.stdout

    def soup(self, kind):
        return self.folder / f"{kind}.ply"

    def raw(self, kind):
        return self.folder / f"{kind}.bin"

    def truth(self):
        return self.folder / "truth.npy"

    # --- distance

    def distances(self):
        program, fields = self.cpp, self.scripts / "fields.py"
        for voxels in self.sizes:
            grid, soup = self.grids[voxels], self.raw("o")
            everything = str(self.widest[voxels] + 2)
            for what, need, command in [
                    ("distance full: Embree point query", "embree_distance", [program / "embree_distance", soup, *grid]),
                    ("distance full: Open3D", "open3d", [self.python, fields, "distance-open3d", soup, *grid]),
                    ("distance full: libigl", "igl", [self.python, fields, "distance-igl", soup, *grid]),
                    ("distance full: CGAL AABB tree", "cgal_distance", [program / "cgal_distance", soup, *grid]),
                    ("distance full: OpenVDB, band over everything", "openvdb_distance",
                     [program / "openvdb_distance", soup, *grid, everything]),
                    ("distance band: OpenVDB, 3 voxels", "openvdb_distance", [program / "openvdb_distance", soup, *grid, "3"])]:
                if self.has(need):
                    self.timed_row(what, "o", voxels, command)

    # --- inside or outside

    def insides(self):
        first = self.sizes[0]
        for voxels in self.sizes:
            for kind in KINDS if voxels == first else "o":
                truth = [self.truth()] if voxels == first else []
                for what, need, script in [("inside: fast winding number", "igl", "winding-igl"),
                                           ("inside: Open3D occupancy", "open3d", "occupancy-open3d")]:
                    if self.has(need, "igl"):
                        self.timed_row(what, kind, voxels, [self.python, self.scripts / "fields.py", script, self.raw(kind),
                                                            *self.grids[voxels], *truth])
        if not self.has("igl"):
            return
        for kind in KINDS:
            self.own_inside(kind, first)

    def own_inside(self, kind, voxels):
        """Ours is judged on its own grid: the box of a damaged soup, and so its grid, may differ a little."""
        with tempfile.TemporaryDirectory() as folder:
            field, truth = pathlib.Path(folder) / "field.vti", pathlib.Path(folder) / "truth.npy"
            child = measure.run_child([self.session.tool, "field", self.soup(kind), "-o", field, "--voxels", voxels,
                                       "--band-only", "--quiet"], self.timeout)
            row = Row("inside: tetsoup", kind, voxels, peak_mb=child.peak_mb, note="" if child.code == 0 else "failed")
            if child.code == 0:
                row.best_ms = child.seconds * 1e3
                self.script("prepare.py", "truth", self.raw("o"), truth, *self.grid_of(kind, voxels)[0])
                row.counters = json.loads(self.script("prepare.py", "score-field", field, truth))
            self.add(row)

    # --- tet meshes

    def score(self, row, mesh):
        if row.best_ms is not None and mesh.exists():
            answer = self.script("prepare.py", "score", mesh, self.truth(), *self.grids[self.sizes[0]]) \
                if self.has("igl") else "{}"
            row.counters |= json.loads(answer)

    def own_mesh(self, kind, voxels):
        mesh = self.folder / f"own-{voxels}-{kind}.mesh"
        size = ["--voxels", str(voxels)]
        child, report = measure.run_tool(self.session.tool, self.soup(kind), size, self.timeout)
        if report is None:
            self.add(Row(f"mesh: tetsoup, {voxels}^3", kind, note=measure.why_not(child, self.timeout)))
            return
        edge = report["lattice"]["cell_size"] * (report["tet_count"] / TETS) ** (1 / 3)
        command = [self.session.tool, "mesh", self.soup(kind), "-o", mesh, "--quiet", *size, "--cell-size", f"{edge:.9g}"]
        runs = [measure.run_child(command, self.timeout) for _ in range(3)]
        best = min(runs, key=lambda run: run.seconds)
        row = Row(f"mesh: tetsoup, {voxels}^3", kind, 0, best_ms=best.seconds * 1e3, cpu_ms=best.cpu_seconds * 1e3,
                  median_ms=statistics.median(run.seconds for run in runs) * 1e3, repetitions=3, peak_mb=best.peak_mb)
        self.score(row, mesh)
        self.add(row)

    def python_mesh(self, what, name, kind, source, before=None):
        """`before` is the row of the wrap that the mesher starts from; its time counts."""
        mesh = self.folder / f"{name}-{kind}.mesh"
        mesh.unlink(missing_ok=True)
        command = [self.python, self.scripts / "meshers.py", name, source, mesh] if name != "cgal_mesh" else \
            [self.cpp / "cgal_mesh", source, mesh, str(MESH_PARTS)]
        child, answer, why = self.run(command)
        row = Row(what, kind, 0, note=why, peak_mb=max(child.peak_mb, before.peak_mb if before else 0))
        if answer:
            row.best_ms = row.median_ms = answer["seconds"] * 1e3 + (before.best_ms if before else 0)
            row.cpu_ms, row.repetitions = child.cpu_seconds * 1e3, 1
            self.score(row, mesh)
        self.add(row)

    def meshes(self, quick):
        for voxels in OWN_GRIDS:
            for kind in KINDS:
                self.own_mesh(kind, voxels)
        for kind in KINDS:
            if self.has("cgal_wrap"):
                wrap = self.folder / f"wrap-{kind}.off"
                row = self.timed_row("alpha wrap", kind, 0, [self.cpp / "cgal_wrap", self.soup(kind), wrap, str(WRAP_PARTS)])
                for what, name in [("CGAL Mesh_3", "cgal_mesh"), ("TetGen", "tetgen"), ("Gmsh HXT", "gmsh")]:
                    if self.has(name) and row.best_ms is not None:
                        self.python_mesh(f"mesh: alpha wrap + {what}", name, kind, wrap, row)
        raw = [("TetGen, raw", "tetgen", "tetgen"), ("Gmsh HXT, raw", "gmsh", "gmsh"),
               ("fTetWild, coarse", "ftetwild-coarse", "pytetwild")]
        for what, name, need in raw if not quick else raw[:2]:
            for kind in KINDS if self.has(need) else []:
                self.python_mesh(f"mesh: {what}", name, kind, self.soup(kind))
                if self.session.rows[-1].note.startswith(">"):
                    break  # what is too slow here is not tried on worse
        if self.has("pytetwild") and not quick:
            self.python_mesh("mesh: fTetWild, default", "ftetwild", "o", self.soup("o"))

    def measure(self, quick):
        self.prepare()
        for voxels in self.sizes:
            times = 2 if quick else 3
            for name in ("distance_full", "distance_band", "signs_one_k", "signs_auto"):
                rows = measure.run_benchmarks(self.session.program, self.soup("o"), f"^{name}/{voxels}/process_time", voxels,
                                              times, self.session.timeout)
                for row in rows:
                    self.add(row)
        self.distances()
        self.insides()
        self.meshes(quick)


# --- tables ----------------------------------------------------------------------------------------------------------

def seconds(row):
    if row is None:
        return "–"
    return row.note if row.best_ms is None else f"{row.best_ms / 1e3:.3g}"


def ratio(row, own_ms):
    return f"{row.best_ms / own_ms:.3g}" if row and row.best_ms is not None and own_ms else "–"


def names_of(results, start):
    return list(dict.fromkeys(row.what for row in results.rows if row.what.startswith(start)))


def distance_table(results, sizes):
    lines = []
    header = ["tool"]
    for voxels in sizes:
        header += [f"{voxels}^3 s", "x ours", "in band"]
    for label, own, start in [("full", "distance_full", "distance full: "), ("band of 3", "distance_band", "distance band: ")]:
        names = [own, *names_of(results, start)]
        if len(names) == 1:
            continue
        for name in names:
            line = [f"**tetsoup, {label}**" if name == own else name.removeprefix("distance ")]
            for voxels in sizes:
                own_row = results.find(own, voxels)
                row = own_row if name == own else results.find(name, voxels, "o")
                count = f"{row.counters['in_band']:,}" if row and "in_band" in row.counters else "–"
                line += [seconds(row), ratio(row, own_row.best_ms if own_row else None), count]
            peak = results.find(name, sizes[-1], "input" if name == own else "o")
            lines.append([*line, f"{peak.peak_mb:,.0f}" if peak and peak.peak_mb else "–"])
    return ([*header, f"MB at {sizes[-1]}^3"], lines) if lines else None


def inside_table(results, sizes):
    """Ours takes the distance and the signs; the time of the signs alone stands in the other tables."""
    def own_ms(voxels):
        rows = [results.find(what, voxels) for what in ("distance_band", "signs_auto")]
        return sum(row.best_ms for row in rows) if all(row and row.best_ms is not None for row in rows) else None

    def cells(name, counter):
        found = [results.find(name, sizes[0], kind) for kind in KINDS]
        return [f"{row.counters[counter]:.4g}" if row and counter in row.counters else "–" for row in found]

    lines = []
    if names_of(results, "inside: tetsoup"):
        times = [cell for voxels in sizes for cell in (f"{own_ms(voxels) / 1e3:.3g}" if own_ms(voxels) else "–", "1")]
        lines.append(["**tetsoup**, distance and signs", *cells("inside: tetsoup", "iou"), *times])
    for name in names_of(results, "inside: "):
        if name == "inside: tetsoup":
            continue
        times = []
        for voxels in sizes:
            row = results.find(name, voxels, "o")
            times += [seconds(row), ratio(row, own_ms(voxels))]
        label = name.removeprefix("inside: ")
        lines.append([label + (" > 0.5" if "winding" in name else ""), *cells(name, "iou"), *times])
        if "winding" in name:
            lines.append([label + " > 0.25", *cells(name, "iou_quarter"), *times])
    header = ["tool", *(f"IoU {kind}" for kind in KINDS)]
    for voxels in sizes:
        header += [f"{voxels}^3 s", "x ours"]
    return (header, lines) if lines else None


def mesh_table(results):
    lines = []
    names = names_of(results, "mesh: ")
    own = results.find(f"mesh: tetsoup, {OWN_GRIDS[-1]}^3", 0, "o")
    for name in names:
        rows = [results.find(name, 0, kind) for kind in KINDS]
        intact = rows[0]
        if intact is None:
            continue
        ious = [f"{row.counters['iou']:.3f}" if row and "iou" in row.counters else row.note if row else "not tried" for row in rows]
        angle = intact.counters.get("min_dihedral")
        label = name.removeprefix("mesh: ")
        lines.append([f"**{label}**" if "tetsoup" in label else label, seconds(intact), ratio(intact, own.best_ms if own else None),
                      f"{intact.peak_mb:,.0f}" if intact.peak_mb else "–", f"{intact.counters.get('tets', 0):,}",
                      f"{angle:.1f}" if angle is not None else "–", *ious])
    header = ["tool", "s", f"x ours at {OWN_GRIDS[-1]}^3", "MB", "tets", "min dihedral",
              *(f"IoU {kind}" for kind in KINDS)]
    return (header, lines) if lines else None


def sections(peers, results):
    versions = ", ".join(f"{name} {version}" for name, version in sorted(peers.versions.items()))
    lines = [f"- versions: {versions or 'none'}", f"- not here, so left out: {', '.join(peers.missing) or 'nothing'}",
             f"- given up after {peers.timeout:.0f} s, and then not tried on the inputs that follow"]
    found = [("peers", "Peers", "\n".join(lines), "\n".join(lines))]
    for name, title, table in [("peers-distance", "Distance field", distance_table(results, peers.sizes)),
                               ("peers-inside", "Inside or outside", inside_table(results, peers.sizes)),
                               ("peers-mesh", "Tet meshes, file to file", mesh_table(results))]:
        if table:
            found.append((name, title, tables.text(table), tables.markdown(table)))
    return found
