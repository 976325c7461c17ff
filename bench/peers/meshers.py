"""Tet meshers with Python bindings, file to file: meshers.py WHAT IN.ply|IN.off OUT.mesh

WHAT: ftetwild (default options), ftetwild-coarse (-l 0.1 -e 0.005), tetgen, gmsh. The clock runs from opening the input to the
written mesh; imports do not count. One line of JSON.
"""
import json
import sys
import time

import numpy

import soup_files


def ftetwild(vertices, triangles, **options):
    import pytetwild
    return pytetwild.tetrahedralize(vertices.astype(float), triangles.astype(numpy.int32), **options)


def tetgen_mesh(vertices, triangles):
    import tetgen
    result = tetgen.TetGen(vertices.astype(float), triangles.astype(numpy.int32)).tetrahedralize(mindihedral=10, minratio=1.5)
    return result[0], result[1]


def gmsh_mesh(vertices, triangles):
    """HXT in the volume; the surface stays as it is."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.Algorithm3D", 10)
    gmsh.model.addDiscreteEntity(2, 1)
    tags = numpy.arange(1, len(vertices) + 1)
    gmsh.model.mesh.addNodes(2, 1, tags, vertices.astype(float).ravel())
    gmsh.model.mesh.addElementsByType(1, 2, [], triangles.astype(numpy.uint64).ravel() + 1)
    gmsh.model.geo.addSurfaceLoop([1], 1)
    gmsh.model.geo.addVolume([1], 1)
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    tags, points, _ = gmsh.model.mesh.getNodes()
    _, corners = gmsh.model.mesh.getElementsByType(4)
    place = numpy.zeros(int(tags.max()) + 1, numpy.int64)
    place[tags] = numpy.arange(len(tags))
    gmsh.finalize()
    return points.reshape(-1, 3), place[corners].reshape(-1, 4)


def main(what, source, out):
    functions = {
        "ftetwild": ftetwild,
        "ftetwild-coarse": lambda vertices, triangles: ftetwild(vertices, triangles, edge_length_fac=0.1, epsilon=0.005),
        "tetgen": tetgen_mesh,
        "gmsh": gmsh_mesh,
    }
    __import__({"ftetwild-coarse": "pytetwild", "ftetwild": "pytetwild"}.get(what, what))
    start = time.perf_counter()
    vertices, tets = functions[what](*soup_files.read_surface(source))
    soup_files.write_medit(out, vertices, tets)
    print(json.dumps({"seconds": time.perf_counter() - start, "tets": len(tets)}))


if __name__ == "__main__":
    main(*sys.argv[1:])
