"""One run of one engine in a process of its own: drop.py ENGINE SCENE.json SUBSTEPS SECONDS BUDGET. One line of JSON.

The clock runs while the engine steps. What comes before (reading, compiling, the first frame of a scene that is thrown
away) and looking at positions between frames do not count. What counts is the lesser of wall time and the process's
processor time: on a machine that is busy with something else the latter is what one thread takes on a quiet one. A run ends
early when the clock shows more than BUDGET seconds; "simulated" says how far it came.
"""
import json
import pathlib
import resource
import sys
import time

import engines
from judge import Judge

LEAST = 0.4  # s; processor time comes in ticks of some milliseconds


class Clock:
    """The lesser of wall and processor time of what it has watched."""

    def __init__(self):
        self.wall = self.processor = 0.0

    def watch(self, work):
        wall, processor = time.perf_counter(), time.process_time()
        work()
        self.wall += time.perf_counter() - wall
        self.processor += time.process_time() - processor

    @property
    def seconds(self):
        return min(self.wall, self.processor)


def main(name, scene_path, substeps, seconds, budget):
    scene = json.loads(pathlib.Path(scene_path).read_text())
    engine, substeps, budget = engines.ENGINES[name], int(substeps), float(budget)
    resource.setrlimit(resource.RLIMIT_CPU, (int(4 * budget + 60),) * 2)  # an engine may never return
    engine(scene, substeps).frame()
    run = engine(scene, substeps)
    judge, clock, frames, most = Judge(scene, run.positions()), Clock(), 0, round(float(seconds) / engines.FRAME)
    while frames < most and clock.seconds < budget and judge.finite:
        clock.watch(run.frame)
        frames += 1
        judge.look(run.positions(), engines.FRAME)
    simulated = frames
    judge.wait_for_rest(run.frame, run.positions, engines.FRAME)
    while clock.processor < LEAST and judge.finite:  # the same again
        run = engine(scene, substeps)
        for _ in range(simulated):
            clock.watch(run.frame)
        frames += simulated
    tets, taken = len(judge.tets) * len(scene["places"]), clock.seconds
    print(json.dumps(judge.numbers() | {
        "seconds": taken, "simulated": simulated * engines.FRAME, "factor": frames * engines.FRAME / taken, "tets": tets,
        "substeps": run.substeps, "ns": taken / (run.substeps * frames) / tets * 1e9}))


if __name__ == "__main__":
    main(*sys.argv[1:])
