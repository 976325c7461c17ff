"""The same meshes and scenes in every engine: real-time factors at the engine's own step, and at the largest that is right."""
import math

from child import run_child
import engines
from judge import MOST_SOFT
import scenes

LADDER = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512]  # substeps of a frame
SECONDS = 1.0  # simulated
BUDGET = 20.0  # s of an engine's own clock, after which a run is cut short
REPEATS = 2
MOST_TRIES = 2  # of more substeps than usual, each twice as many
HEAP = (4, "bunny", 500)
CASES = [("bunny", 500), ("armadillo", 2000), ("robot", 10000)]
ALL_CASES = [(body, tets) for tets in (500, 2000, 10000) for body in ("bunny", "armadillo", "robot")]
QUICK_CASES = [("robot", 500)]


def run(name, scene, substeps, budget=BUDGET):
    """A row of numbers; {"stable": False, "why": ...} where the engine gives none."""
    row = {"asked": substeps, "substeps": substeps, "stable": False}
    return row | run_child("drop.py", name, scene["path"], substeps, SECONDS, budget, too_long="does not return")


class Case:
    """One body of one size in all engines."""

    def __init__(self, folder, body, tets):
        self.scene, self.column = scenes.drop(folder, body, tets), scenes.column(folder, tets)
        self.title, self.seen = title_of(body, tets), {}

    def look(self, name, substeps):
        """The column first: where it fails, the body need not be tried."""
        if (name, substeps) not in self.seen:
            column = run(name, self.column, substeps)
            row = column if not column["stable"] else run(name, self.scene, substeps)
            row["softness"] = column.get("softness", math.nan)
            row["right"] = bool(row["stable"] and 1 / MOST_SOFT < row["softness"] < MOST_SOFT)
            self.seen[name, substeps] = row
            print(f"    {name:22} {substeps:4} {describe(row)}", flush=True)
        return self.seen[name, substeps]

    def largest_right_step(self, name):
        """The fewest substeps with which the engine was right, in a walk from its own; None: with none."""
        usual = engines.ENGINES[name].usual
        place = min(range(len(LADDER)), key=lambda i: abs(LADDER[i] - usual))
        if self.look(name, LADDER[place])["right"] or self.look(name, usual)["right"]:
            while place > 0 and self.look(name, LADDER[place - 1])["right"]:
                place -= 1
        else:
            for substeps in LADDER[place + 1 : place + 1 + MOST_TRIES]:
                row = self.look(name, substeps)
                if row["right"] or row.get("simulated", SECONDS) < SECONDS / 2:
                    break  # found, or too slow to be tried further
        return min((n for (engine, n), row in self.seen.items() if engine == name and row["right"]), default=None)

    def measure(self, names):
        """Rows by engine."""
        print(f"  {self.title}", flush=True)
        picked = []
        for name in names:
            if self.scene["tets"] > engines.ENGINES[name].most_tets:
                continue
            usual = engines.ENGINES[name].usual
            self.look(name, usual)
            best = self.largest_right_step(name)
            picked += [(name, "its own", usual)] + ([(name, "largest right", best)] if best not in (None, usual) else [])
        repeat([(self.seen[name, substeps], name, self.scene) for name, _, substeps in picked])
        rows = {}
        for name, kind, substeps in picked:
            rows.setdefault(name, []).append(row_of(self.title, name, kind, self.seen[name, substeps]))
        return rows


def repeat(timed):
    """Every row again, in turns, and its least time: whatever else the machine does can only slow a run down."""
    for _ in range(REPEATS - 1):
        for row, name, scene in timed:
            if row["stable"] and row["seconds"] < BUDGET / 3:
                again = run(name, scene, row["asked"])
                if again["stable"] and again["factor"] > row["factor"]:
                    row.update({key: again[key] for key in ("seconds", "factor", "ns")})


class Heap:
    """Bodies that fall on each other, with the steps that were right for one of them."""

    def __init__(self, folder, single):
        count, body, tets = HEAP
        self.title, self.single = f"heap of {count}: {title_of(body, tets)} each", single
        self.scene = scenes.heap(folder, body, tets, count)

    def measure(self, names):
        print(f"  {self.title}", flush=True)
        timed = []
        for name in names:
            if not engines.ENGINES[name].between:
                continue
            kinds = {row["asked"]: row["kind"] for row in reversed(self.single.get(name, []))}
            for substeps, kind in sorted(kinds.items(), reverse=True):
                row = run(name, self.scene, substeps)
                row["softness"], row["right"] = math.nan, row["stable"]
                print(f"    {name:22} {substeps:4} {describe(row)}", flush=True)
                timed.append((row, name, self.scene, kind))
        repeat([line[:3] for line in timed])
        rows = {}
        for row, name, _, kind in timed:
            rows.setdefault(name, []).append(row_of(self.title, name, kind, row))
        return rows


def title_of(body, tets):
    return f"{body}, {tets:,} tets"


def row_of(case, name, kind, row):
    return {"case": case, "engine": name, "kind": kind} | row


def describe(row):
    if not row["stable"]:
        return f"not stable: {row['why']}"
    return f"{'right' if row['right'] else 'stable'}, softness {row['softness']:.2f}, factor {row['factor']:.3g}"


# --- table -----------------------------------------------------------------------------------------------------------

def brief(value):
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def number(value, form):
    return "–" if value is None or math.isnan(value) else form.format(value)


def table(rows):
    header = ["scene", "engine", "step", "substeps a frame", "real-time factor", "ns a tet and substep", "softness",
              "energy", "volume", "verdict", "ours is faster by"]
    own = {}
    for row in rows:
        if row["engine"] == "tetsoup" and row["right"]:
            own[row["case"]] = max(own.get(row["case"], 0), row["factor"])
    lines = []
    for row in rows:
        cells = [row["case"], row["engine"], row["kind"], str(row["substeps"])]
        if row["stable"]:
            verdict = "right" if row["right"] else "too soft" if row["softness"] > 1 else "too stiff"
            if math.isnan(row["softness"]):
                verdict = "stable"
            if row["simulated"] < SECONDS - 1e-6:
                verdict += f", first {row['simulated']:.2f} s"
            ratio = brief(own[row["case"]] / row["factor"]) if row["case"] in own and row["right"] else ""
            cells += [brief(row["factor"]), brief(row["ns"]), number(row["softness"], "{:.2f}"),
                      f"{100 * (row['energy'] - 1):+.1f} %", f"{100 * row['swelling']:.1f} %", verdict, ratio]
        else:
            cells += ["–", "–", "–", "–", "–", f"not stable: {row['why']}", ""]
        lines.append(cells)
    return header, lines
