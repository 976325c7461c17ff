"""A program that mypy --strict must accept; test_package.py runs it through mypy, nobody executes it."""

import pathlib

import numpy as np
import numpy.typing as npt
import tetsoup


def watch(stage: str, fraction: float) -> bool | None:
    return fraction < 0.5


def main(vertices: npt.NDArray[np.float64], faces: npt.NDArray[np.int64]) -> float:
    mesh = tetsoup.tetrahedralize(vertices, faces, tets=2000, thin="keep", rotate=(0, 0, 0.1), progress=watch)
    points: npt.NDArray[np.float32] = mesh.points
    tets: npt.NDArray[np.int32] = mesh.tets
    files: list[pathlib.Path] = mesh.save("mesh.msh")
    options: tetsoup.LatticeOptions = {"rho_min": 0.3, "lattice": "bcc"}
    pipeline = tetsoup.Pipeline(tetsoup.read(files[0]), progress=tetsoup.tqdm_progress())
    again: tetsoup.TetMesh = pipeline.run(voxels=64, **options)
    enough: tetsoup.TetMesh = pipeline.run(tets="auto")
    votes: npt.NDArray[np.uint8] = pipeline.pseudo_volume.votes
    lattice, report = tetsoup.fill_lattice(pipeline.pseudo_volume, pipeline.soup, cells=20)
    parts: int = enough.quality.components + report.topology.parts_dropped + len(lattice.tets)
    seconds: dict[str, float] = again.report.seconds
    surface = tetsoup.read_surface("bunny.obj")
    embedding: tetsoup.Embedding = mesh.embed(surface, max_extrapolation=2, progress=watch)
    moved: npt.NDArray[np.float32] = embedding.deform(points * 2)
    pins = {"floor": mesh.vertices_below(0.1)}
    mesh.save("bunny", engine="newton", up="y", regions=mesh.regions(surface), pins=pins, embedding=embedding)
    simulation = tetsoup.Simulation(substeps=20, gravity=(0, 0, -1.6), contacts="between")
    simulation.add_plane(friction=0.3)
    body: int = simulation.add_body(mesh, young=1e6, translate=points[0], rotate=(90, 0, 0))
    for other in simulation.add_bodies(mesh, points, rotate=points, poisson=0.3):
        simulation.pin(other, mesh.vertices_below(0.1))
    simulation.step(1 / 60)
    positions: npt.NDArray[np.float32] = simulation.positions(body)
    state: bytes = simulation.save_state()
    parts += simulation.report.contacts + simulation.state_hash + len(state) + len(embedding.deform(positions))
    seconds["energy"] = simulation.energy.total + simulation.momentum(body).linear[2]
    parts += int(moved.size) + len(surface.parts[0].material)
    return parts + seconds["lattice"] + float(points[tets].sum()) + int(votes.max()) + mesh.readiness(density=500).mass
