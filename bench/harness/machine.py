"""What stands beside every figure: commit, machine, compiler, date."""
import datetime
import os
import re
import subprocess

SIMD = ["sse4_2", "avx", "avx2", "fma", "bmi2", "avx512f", "avx512bw", "avx512vl", "avx512_vnni", "avx512_vbmi", "asimd", "sve"]
BUSY_LOAD = 0.3  # of all cores; above that the figures are not worth much


def output(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def cpu_info(field):
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = re.search(rf"^{field}\s*:\s*(.*)$", file.read(), re.MULTILINE)
    return found.group(1).strip() if found else ""


def cache_entry(build, name):
    """A value out of CMakeCache.txt."""
    found = re.search(rf"^{name}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)
    return found.group(1).strip() if found else ""


def describe(root, build):
    """Facts as a flat dictionary; part of every line of the CSV."""
    commit = output("git", "-C", str(root), "rev-parse", "--short=10", "HEAD") or "unknown"
    if output("git", "-C", str(root), "status", "--porcelain", "--", "src", "include", "apps", "cmake", "CMakeLists.txt"):
        commit += "+changes"
    compiler = cache_entry(build, "CMAKE_CXX_COMPILER")
    flags = " ".join(cache_entry(build, name) for name in ("CMAKE_CXX_FLAGS", "CMAKE_CXX_FLAGS_RELEASE")).strip()
    known = set((cpu_info("flags") or cpu_info("Features")).split())
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        "commit": commit,
        "cpu": cpu_info("model name") or output("uname", "-m"),
        "cores": len(os.sched_getaffinity(0)),
        "simd": " ".join(flag for flag in SIMD if flag in known),
        "compiler": f"{output(compiler, '--version').splitlines()[0] if compiler else 'unknown'}, {flags}",
        "load": round(os.getloadavg()[0], 2),
    }


def warn_if_busy():
    load, cores = os.getloadavg()[0], len(os.sched_getaffinity(0))
    if load > BUSY_LOAD * cores:
        print(f"note: the load is {load:.1f} on {cores} cores: something else is running, so trust ratios, not times.")
