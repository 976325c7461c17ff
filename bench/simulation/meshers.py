"""Meshes of one object by each mesher, in a process of its own: meshers.py MAKER OBJECT OUT.npz. One line of JSON.

TetGen and Gmsh want a closed surface without crossings, which none of the objects is: they get what pymeshfix makes of it.
fTetWild takes the object as it is, as tetsoup does. Coarse rows are meant to have as many tets as ours, so they begin with
fewer triangles.
"""
import json
import pathlib
import sys
import time

import numpy

import scenes

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "peers"))
import meshers as peers  # noqa: E402

TETS = 5000  # of ours, and about that many of the coarse ones
COARSE_TRIANGLES = 1600  # for TetGen and Gmsh, whose surface stays as it is
FTETWILD_TRIANGLES = 4000  # with all of the bunny's, the wheel's fTetWild does not end within minutes


def ours(soup, **options):
    import tetsoup

    mesh = tetsoup.tetrahedralize(*soup, **{"tets": TETS, **options})
    return mesh.points, mesh.tets


def decimated(soup, triangles):
    import pyvista

    points, faces = soup
    if len(faces) > triangles:
        surface = pyvista.PolyData.from_regular_faces(points, faces).decimate(1 - triangles / len(faces))
        points, faces = surface.points, surface.regular_faces
    return numpy.array(points, float), numpy.array(faces, numpy.int32)


def repaired(soup, triangles=None):
    import pymeshfix

    points, faces = pymeshfix.clean_from_arrays(soup[0].astype(float), soup[1].astype(numpy.int32), joincomp=True)
    if triangles:
        points, faces = pymeshfix.clean_from_arrays(*decimated((points, faces), triangles), joincomp=True)
    return points, faces.astype(numpy.int32)


MAKERS = {
    "tetsoup, five": lambda soup: ours(soup, lattice="five"),
    "tetsoup, bcc": lambda soup: ours(soup, lattice="bcc"),
    "tetsoup, five, raw": lambda soup: ours(soup, lattice="five", passes=0),
    "tetsoup, bcc, raw": lambda soup: ours(soup, lattice="bcc", passes=0),
    "fTetWild, coarse": lambda soup: peers.ftetwild(
        *decimated(soup, FTETWILD_TRIANGLES), edge_length_fac=0.1, epsilon=0.005),
    "TetGen": lambda soup: peers.tetgen_mesh(*repaired(soup)),
    "TetGen, coarse": lambda soup: peers.tetgen_mesh(*repaired(soup, COARSE_TRIANGLES)),
    "Gmsh": lambda soup: peers.gmsh_mesh(*repaired(soup)),
    "Gmsh, coarse": lambda soup: peers.gmsh_mesh(*repaired(soup, COARSE_TRIANGLES)),
    "fTetWild": lambda soup: peers.ftetwild(*soup),
}
NEEDS = {"tetsoup": ["tetsoup"], "fTetWild": ["pytetwild"], "TetGen": ["tetgen", "pymeshfix"],
         "Gmsh": ["gmsh", "pymeshfix"]}


def needs_of(maker):
    return NEEDS[maker.split(",")[0]]


def upright(points, tets):
    """Tets turned positive where a mesher counts the other way; those without volume stay."""
    a, b, c, d = (numpy.asarray(points, float)[tets[:, i]] for i in range(4))
    volumes = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a)
    tets = numpy.array(tets)
    if volumes.sum() < 0:
        tets = tets[:, [0, 1, 3, 2]]
    return tets


def main(maker, name, out):
    soup = scenes.soup_of(name)
    start = time.perf_counter(), time.process_time()
    points, tets = MAKERS[maker](soup)
    taken = min(time.perf_counter() - start[0], time.process_time() - start[1])
    numpy.savez(out, points=scenes.standing(numpy.asarray(points, float)), tets=upright(points, tets).astype(numpy.int32))
    print(json.dumps({"seconds": taken, "tets": len(tets)}))


if __name__ == "__main__":
    main(*sys.argv[1:])
