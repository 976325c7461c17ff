"""How well a mesh simulates, in a process of its own: simulate_mesh.py MESH.npz. One line of JSON.

`step` is the largest with which explicit integration of linear elasticity is stable, 2 / omega of the stiffest mode, by
scipy: what any explicit solver must keep to, whoever wrote it. Then the mesh is dropped, once with Solver.Implicit as it is
when nothing is said, once with Solver.Potentials, which takes as many substeps as its own bound asks for; without damping
there, which would shorten explicit steps for every mesh alike.
"""
import json
import sys

import numpy
import scipy.sparse
import scipy.sparse.linalg

import scenes
from drop import Clock
from judge import Judge

FRAME = 1 / 60
BUDGET = 2.0  # s for each solver


def largest_step(points, tets):
    """Of explicit linear finite elements with masses in the vertices; tets without volume are left out."""
    p = points[tets]
    matrices = (p[:, 1:] - p[:, :1]).transpose(0, 2, 1)
    volumes = numpy.linalg.det(matrices) / 6
    kept = volumes > 1e-12 * volumes.sum()
    tets, volumes = tets[kept], volumes[kept]
    inverse = numpy.linalg.inv(matrices[kept])
    gradients = numpy.concatenate([-inverse.sum(1, keepdims=True), inverse], 1)  # (T, 4, 3)
    young, poisson = scenes.MATERIAL["young"], scenes.MATERIAL["poisson"]
    shear, lame = young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    # K of corners a and b: V (lambda ga gb^T + mu gb ga^T + mu (ga . gb) I)
    outer = numpy.einsum("tai,tbj->tabij", gradients, gradients)
    dots = numpy.einsum("tabii->tab", outer)
    blocks = lame * outer + shear * outer.transpose(0, 1, 2, 4, 3) + shear * dots[..., None, None] * numpy.eye(3)
    blocks *= volumes[:, None, None, None, None]
    indices = 3 * tets[:, :, None] + numpy.arange(3)  # (T, 4, 3)
    rows = numpy.broadcast_to(indices[:, :, None, :, None], blocks.shape).ravel()
    columns = numpy.broadcast_to(indices[:, None, :, None, :], blocks.shape).ravel()
    masses = numpy.zeros(len(points))
    numpy.add.at(masses, tets.ravel(), numpy.repeat(volumes * scenes.MATERIAL["density"] / 4, 4))
    scale = numpy.repeat(numpy.where(masses > 0, 1 / numpy.sqrt(numpy.maximum(masses, 1e-300)), 0), 3)
    stiffness = scipy.sparse.coo_matrix((blocks.ravel() * scale[rows] * scale[columns], (rows, columns))).tocsr()
    start = numpy.random.default_rng(1).normal(size=stiffness.shape[0])
    most = scipy.sparse.linalg.eigsh(stiffness, 1, which="LA", tol=1e-3, v0=start, return_eigenvectors=False)[0]
    return 2 / float(numpy.sqrt(most))


def dropped(points, tets, solver, path):
    """Numbers of a second's fall, or of what of it fits the budget."""
    import tetsoup

    mesh = tetsoup.TetMesh(points, tets)
    explicit = solver == "potentials"
    simulation = tetsoup.Simulation(solver=solver, contacts="between", **({"substeps": 1} if explicit else {}))
    simulation.add_plane()
    material = scenes.MATERIAL | ({"damping_time": 0} if explicit else {})
    body = simulation.add_body(mesh, translate=(0, 0, scenes.LIFT), **material)
    scene = scenes.MATERIAL | {"mesh": path, "size": scenes.SIZE, "places": [[0, 0, scenes.LIFT]]}
    judge, clock, frames = Judge(scene, [simulation.positions(body)]), Clock(), 0
    # Potentials take tens of thousands of substeps in a second on a bad mesh: some of a frame tell how long it takes.
    dt = FRAME / 10 if explicit else FRAME
    while frames * dt < 1 - 1e-9 and clock.seconds < BUDGET:
        clock.watch(lambda: simulation.step(dt))
        frames += 1
        if not explicit:
            judge.look([simulation.positions(body)], dt)
    numbers = {"per_second": clock.seconds / (frames * dt), "step": dt / simulation.report.substeps,
               "left_out": simulation.report.left_out}
    if not explicit:
        judge.wait_for_rest(lambda: simulation.step(dt), lambda: [simulation.positions(body)], dt)
        numbers |= {key: value for key, value in judge.numbers().items() if key != "softness"}
    return numbers


def main(path):
    import tetsoup

    data = numpy.load(path)
    points, tets = data["points"].astype(float), data["tets"]
    quality = tetsoup.TetMesh(points, tets).quality
    print(json.dumps({
        "tets": len(tets), "angle": float(numpy.degrees(quality.min_dihedral)), "inverted": quality.inverted_tets,
        "step": largest_step(points, tets), "implicit": dropped(points, tets, "implicit", path),
        "potentials": dropped(points, tets, "potentials", path)}))


if __name__ == "__main__":
    main(*sys.argv[1:])
