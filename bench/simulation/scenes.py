"""The bodies and the scenes, as files that every engine reads."""
import json
import os
import pathlib

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODELS = ROOT.parent / "shared/models"
SIZE = 0.5  # m, height of a body
LIFT = 0.1  # m, from its lowest point to the ground
MATERIAL = {"density": 1000.0, "young": 3e5, "poisson": 0.4, "damping_time": 0.002}
OBJECTS = {  # file or sample, and the rows that turn it z up
    "bunny": ("bunny-69k.ply", ((1, 0, 0), (0, 0, -1), (0, 1, 0))),
    "armadillo": ("armadillo-29k.obj", ((1, 0, 0), (0, 0, -1), (0, 1, 0))),
    "robot": ("", ((1, 0, 0), (0, 1, 0), (0, 0, 1))),
}


def soup_of(name):
    """Vertices z up, standing on the ground, SIZE high; triangles. None where the model is not here."""
    import tetsoup

    file, rows = OBJECTS[name]
    if file and not (MODELS / file).exists():
        return None
    soup = tetsoup.read(MODELS / file) if file else tetsoup.sample(name)
    vertices = soup.vertices.astype(float) @ numpy.array(rows, float).T
    vertices -= [*(vertices.max(0) + vertices.min(0))[:2] / 2, vertices[:, 2].min()]
    return vertices * (SIZE / vertices[:, 2].max()), soup.faces


def standing(points):
    """On the ground, in the middle, SIZE high."""
    moved = points - [*(points.max(0) + points.min(0))[:2] / 2, points[:, 2].min()]
    return moved * (SIZE / moved[:, 2].max())


def write_scene(folder, name, mesh, places):
    """SCENE.json and the mesh as .npz, .msh and .vtk; the scene as a dictionary."""
    import tetsoup

    folder.mkdir(parents=True, exist_ok=True)
    mesh = tetsoup.TetMesh(standing(mesh.points), mesh.tets)
    paths = {kind: str(folder / f"{name}.{kind}") for kind in ("npz", "msh", "vtk")}
    part = folder / f"{name}.{os.getpid()}"  # another run may be reading the files
    numpy.savez(f"{part}.npz", points=mesh.points, tets=mesh.tets)
    os.replace(f"{part}.npz", paths["npz"])
    mesh.save(paths["msh"], engine="mujoco")
    mesh.save(paths["vtk"], engine="bullet")
    a, b = (mesh.points[mesh.tets[:, list(corner)]] for corner in ((0, 0, 0, 1, 1, 2), (1, 2, 3, 2, 3, 3)))
    scene = MATERIAL | {
        "name": name, "mesh": paths["npz"], "msh": paths["msh"], "vtk": paths["vtk"], "places": places, "size": SIZE,
        "tets": len(mesh.tets), "mass": mesh.quality.volume * MATERIAL["density"],
        "edge": float(numpy.linalg.norm(a - b, axis=2).mean()),
    }
    scene["path"] = str(folder / f"{name}.json")
    pathlib.Path(f"{part}.json").write_text(json.dumps(scene))
    os.replace(f"{part}.json", scene["path"])
    return scene


def column(folder, tets):
    """A square column of five-tet cubes, 0.4 as wide as high: how much it sags is known."""
    import tetsoup

    def cells_for(fine):
        return 2 * fine, 2 * fine, 5 * fine

    fine = min(range(1, 9), key=lambda n: abs(numpy.log(5 * numpy.prod(cells_for(n)) / tets)))
    counts = cells_for(fine)
    grid = numpy.stack(numpy.meshgrid(*(numpy.arange(n + 1) for n in counts), indexing="ij"), -1)
    number = numpy.arange(grid[..., 0].size).reshape(grid.shape[:3])
    five = [(0, 1, 2, 4), (3, 1, 7, 2), (5, 1, 4, 7), (6, 2, 7, 4), (1, 2, 4, 7)]  # corner = x + 2 y + 4 z
    found = []
    for cell in numpy.ndindex(counts):
        mirrored = sum(cell) % 2  # about x, so that neighbours share diagonals
        corners = [number[cell[0] + ((c & 1) ^ mirrored), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)] for c in range(8)]
        found += [[corners[c] for c in tet] for tet in five]
    points, found = grid.reshape(-1, 3) / counts[2], numpy.array(found)
    a, b, c, d = (points[found[:, i]] for i in range(4))
    turned = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) < 0
    found[turned] = found[turned][:, [0, 1, 3, 2]]
    return write_scene(folder, f"column_{tets}", tetsoup.TetMesh(points, found), [[0, 0, 0.01 * SIZE]])


def drop(folder, name, tets):
    """One body over the ground."""
    import tetsoup

    soup = soup_of(name)
    if soup is None:
        return None
    mesh = tetsoup.tetrahedralize(*soup, tets=tets)
    return write_scene(folder, f"{name}_{tets}", mesh, [[0, 0, LIFT]])


def heap(folder, name, tets, count=4):
    """Bodies that fall on each other, a little beside."""
    import tetsoup

    soup = soup_of(name)
    if soup is None:
        return None
    mesh = tetsoup.tetrahedralize(*soup, tets=tets)
    places = [[0.05 * (i % 2), 0.05 * (i // 2 % 2), LIFT + 1.1 * SIZE * i] for i in range(count)]
    return write_scene(folder, f"{count}_{name}_{tets}", mesh, places)
