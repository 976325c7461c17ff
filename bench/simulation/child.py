"""A script of this folder as a process of its own, since engines and meshers may crash, hang, and leave logs where they run."""
import json
import signal
import subprocess
import sys
import tempfile

import scenes


def run_child(script, *arguments, too_long, before=None):
    """Its line of JSON, or {"why": ...}: that it was ended by a limit of time, in the words of `too_long`, or what failed."""
    command = [sys.executable, str(scenes.ROOT / "bench/simulation" / script), *map(str, arguments)]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder, preexec_fn=before)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return {"why": too_long}
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode == 0 and lines:
        return json.loads(lines[-1])
    last = (done.stderr.strip().splitlines() or ["no output"])[-1]
    return {"why": "crashes" if done.returncode < 0 else last[:80]}
