"""Runs things and says how long they took. Every measurement becomes a row:

    what, soup, voxels, threads   which one; threads 0 = all cores
    best_ms, median_ms, cpu_ms    wall time; processor time of all threads, of the best
    repetitions, peak_mb          peak memory where it was a process of its own
    counters                      voxels, tets, ...: what was worked on, and what came out
    note                          why there is no time
"""
import dataclasses
import json
import os
import pathlib
import re
import signal
import statistics
import subprocess
import tempfile
import time


@dataclasses.dataclass
class Row:
    what: str
    soup: str = "input"
    voxels: int = 0
    threads: int = 0
    best_ms: float | None = None
    median_ms: float | None = None
    cpu_ms: float | None = None
    repetitions: int = 0
    peak_mb: float | None = None
    counters: dict = dataclasses.field(default_factory=dict)
    note: str = ""


@dataclasses.dataclass
class Child:
    seconds: float
    cpu_seconds: float
    peak_mb: float
    code: int | None  # None: ended because it took too long
    text: str


def run_child(command, timeout, folder=None):
    """Runs a process to its end; peak memory is that of the process (and no less than this script's own, some 20 MB)."""
    with tempfile.TemporaryFile("w+") as out:
        start = time.perf_counter()
        child = subprocess.Popen([str(part) for part in command], stdout=out, stderr=subprocess.STDOUT, cwd=folder,
                                 start_new_session=True)
        timed_out = False

        def stop(_signal, _frame):
            nonlocal timed_out
            timed_out = True
            os.killpg(child.pid, signal.SIGKILL)

        old = signal.signal(signal.SIGALRM, stop)
        signal.setitimer(signal.ITIMER_REAL, timeout)
        try:
            _, status, usage = os.wait4(child.pid, 0)
        except KeyboardInterrupt:
            os.killpg(child.pid, signal.SIGKILL)
            raise
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, old)
        seconds = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    return Child(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024,
                 None if timed_out else child.returncode, text)


def last_line(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1].strip()[:200] if lines else "no output"


# --- rows of tetsoup_bench -------------------------------------------------------------------------------------------

NAME = re.compile(r"^(?P<what>[\w-]+)(?:/(?P<voxels>\d+))?(?:/soup:(?P<soup>\w+))?(?:/threads:(?P<threads>\d+))?")
STANDARD = {"name", "run_name", "run_type", "family_index", "per_family_instance_index", "repetitions", "repetition_index",
            "threads", "iterations", "real_time", "cpu_time", "time_unit", "bytes_per_second", "items_per_second",
            "error_occurred", "error_message", "label"}


def parse_benchmarks(text):
    """Rows out of Google Benchmark's JSON, also of one that was cut off in the middle."""
    runs = {}
    for found in re.findall(r'\{[^{}]*"run_name"[^{}]*\}', text):
        run = json.loads(found)
        if run.get("run_type") == "iteration":
            runs.setdefault(run["run_name"], []).append(run)
    rows = []
    for name, repeated in runs.items():
        parts = NAME.match(name).groupdict()
        row = Row(parts["what"], parts["soup"] or "input", int(parts["voxels"] or 0), int(parts["threads"] or 0))
        errors = [run["error_message"] for run in repeated if run.get("error_occurred")]
        if errors:
            row.note = errors[0]
        else:
            best = min(repeated, key=lambda run: run["real_time"])
            row.best_ms, row.cpu_ms = best["real_time"], best["cpu_time"]
            row.median_ms = statistics.median(run["real_time"] for run in repeated)
            row.repetitions = len(repeated)
            row.counters = {key: value for key, value in best.items() if key not in STANDARD}
        rows.append(row)
    return rows


def run_benchmarks(program, source, pattern, voxels, repetitions, timeout):
    """The rows of tetsoup_bench whose names match; what a time-out leaves out is said in a row of its own."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.json"
        child = run_child([program, f"--input={source}", f"--voxels={voxels}", f"--benchmark_filter={pattern}",
                           f"--benchmark_repetitions={repetitions}", "--benchmark_min_time=0.05",
                           f"--benchmark_out={out}", "--benchmark_out_format=json"], timeout)
        rows = parse_benchmarks(out.read_text()) if out.exists() else []
    if len(rows) == 1:
        rows[0].peak_mb = child.peak_mb
    if child.code is None:
        print(f"    stopped after {timeout:.0f} s")
        if not rows:
            rows.append(Row(re.match(r"\^?\(?(\w+)", pattern).group(1), voxels=voxels, note=f"> {timeout:.0f} s"))
    elif child.code != 0:
        print(f"    {pattern} FAILED ({child.code}): {last_line(child.text)}")
    return rows


# --- the tool, file to file ------------------------------------------------------------------------------------------

def run_tool(tool, source, arguments, timeout):
    """One run of `tetsoup mesh`; returns the process and its report, None if it was too slow or failed."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        child = run_child([tool, "mesh", source, "-o", f"{folder}/mesh.msh", "--json", report, "--quiet", *arguments],
                          timeout)
        return child, json.loads(report.read_text()) if child.code == 0 else None


def why_not(child, timeout):
    return f"> {timeout:.0f} s" if child.code is None else f"failed ({child.code}): {last_line(child.text)}"


def measure_tool(tool, source, soup, voxels, tets, repetitions, timeout):
    """The whole tool, from reading the soup to the written mesh, as a process; and the seconds of its stages."""
    row = Row("tool", soup, voxels)
    size = ["--voxels", str(voxels), "--tets", str(tets)]
    with tempfile.TemporaryDirectory() as folder:
        runs = [run_child([tool, "mesh", source, "-o", f"{folder}/mesh.msh", "--quiet", *size], timeout)
                for _ in range(repetitions)]
    _, report = run_tool(tool, source, size, timeout)
    good = [run for run in runs if run.code == 0]
    if not good or report is None:
        row.note = why_not(runs[-1], timeout)
        return [row]
    best = min(good, key=lambda run: run.seconds)
    row.best_ms, row.cpu_ms = best.seconds * 1e3, best.cpu_seconds * 1e3
    row.median_ms = statistics.median(run.seconds for run in good) * 1e3
    row.repetitions, row.peak_mb = len(good), best.peak_mb
    grid = report["grid"]["size"]
    row.counters = {"voxels": grid[0] * grid[1] * grid[2], "tets": report["tet_count"],
                    "k": report["k"], "min_dihedral_deg": report["min_dihedral_deg"]}
    stages = [Row("tool_" + stage, soup, voxels, best_ms=seconds * 1e3, repetitions=1)
              for stage, seconds in report["seconds"].items()]
    return [row, *stages]
