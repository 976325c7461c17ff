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


def main(name, scene_path, substeps, seconds, budget):
    scene = json.loads(pathlib.Path(scene_path).read_text())
    engine, substeps, budget = engines.ENGINES[name], int(substeps), float(budget)
    resource.setrlimit(resource.RLIMIT_CPU, (int(4 * budget + 60),) * 2)  # an engine may never return
    engine(scene, substeps).frame()
    run = engine(scene, substeps)
    judge, wall, processor, frames = Judge(scene, run.positions()), 0.0, 0.0, 0
    while frames < round(float(seconds) / engines.FRAME) and min(wall, processor) < budget and judge.finite:
        start = time.perf_counter(), time.process_time()
        run.frame()
        wall += time.perf_counter() - start[0]
        processor += time.process_time() - start[1]
        frames += 1
        judge.look(run.positions(), engines.FRAME)
    tets, taken = len(judge.tets) * len(scene["places"]), min(wall, processor)
    print(json.dumps(judge.numbers() | {
        "seconds": taken, "simulated": frames * engines.FRAME, "factor": frames * engines.FRAME / taken, "tets": tets,
        "substeps": run.substeps, "ns": taken / (run.substeps * frames) / tets * 1e9}))


if __name__ == "__main__":
    main(*sys.argv[1:])
