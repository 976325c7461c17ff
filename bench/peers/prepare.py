"""The damaged inputs, the truth, and the scores of what the meshers made of them.

  prepare.py inputs IN.ply FOLDER           o.ply o.bin a.ply ...: intact; half of the triangles removed; windings
                                            flipped at random; every triangle detached, shuffled and jittered by 0.2 %
                                            of the diagonal
  prepare.py truth SOUP.bin OUT.npy GRID    voxels whose generalised winding number in the intact soup is above 0.5
  prepare.py score MESH.mesh TRUTH.npy GRID
  prepare.py score-field FIELD.vti TRUTH.npy
GRID is nx ny nz ox oy oz h. Scores are one line of JSON.
"""
import json
import pathlib
import sys

import numpy

import soup_files
from grids import grid_of, grid_points, iou


def damaged(vertices, triangles, kind):
    random = numpy.random.default_rng(1)
    if kind == "o":
        return vertices, triangles
    if kind == "a":
        return vertices, triangles[random.permutation(len(triangles))[:len(triangles) // 2]]
    if kind == "b":
        flip = random.random(len(triangles)) < 0.5
        return vertices, numpy.where(flip[:, None], triangles[:, ::-1], triangles)
    diagonal = numpy.linalg.norm(vertices.max(0) - vertices.min(0))
    loose = vertices[triangles[random.permutation(len(triangles))]].reshape(-1, 3).astype(float)
    loose += random.uniform(-0.002, 0.002, loose.shape) * diagonal / numpy.sqrt(3)
    return loose, numpy.arange(len(loose)).reshape(-1, 3)


def write_inputs(source, folder):
    vertices, triangles = soup_files.read_ply(source)
    for kind in "oabc":
        soup = damaged(vertices, triangles, kind)
        soup_files.write_ply(pathlib.Path(folder) / f"{kind}.ply", *soup)
        soup_files.write_raw(pathlib.Path(folder) / f"{kind}.bin", *soup)


def write_truth(soup, out, grid):
    import igl
    vertices, triangles = soup_files.read_raw(soup)
    winding = igl.fast_winding_number(vertices.astype(float), triangles.astype(numpy.int64), grid_points(grid))
    numpy.save(out, numpy.abs(winding) > 0.5)


def dihedral_angles(vertices, tets):
    """Six angles of each tet, in degrees."""
    corners = vertices[tets]
    normals = [numpy.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a])
               for a, b, c in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))]
    with numpy.errstate(all="ignore"):
        normals = [normal / numpy.linalg.norm(normal, axis=1, keepdims=True) for normal in normals]
        cosines = [-(normals[i] * normals[j]).sum(1) for i in range(4) for j in range(i)]
        return numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1)))


def voxels_inside(vertices, tets, grid):
    """Which voxel centres lie in a tet."""
    inside = numpy.zeros(grid.shape, bool)  # z, y, x
    where = (vertices - grid.origin) / grid.h
    size = numpy.array(grid.shape[::-1])
    for corners in where[tets]:
        low = numpy.maximum(numpy.ceil(corners.min(0)), 0).astype(int)
        high = numpy.minimum(numpy.floor(corners.max(0)), size - 1).astype(int)
        edges = (corners[1:] - corners[0]).T
        if (high < low).any() or abs(numpy.linalg.det(edges)) < 1e-12:
            continue
        x, y, z = (numpy.arange(low[i], high[i] + 1) for i in range(3))
        points = numpy.stack(numpy.broadcast_arrays(x[None, None, :], y[None, :, None], z[:, None, None]), -1)
        weights = (points - corners[0]) @ numpy.linalg.inv(edges).T
        found = (weights >= -1e-9).all(-1) & (weights.sum(-1) <= 1 + 1e-9)
        inside[low[2]:high[2] + 1, low[1]:high[1] + 1, low[0]:high[0] + 1] |= found
    return inside


def score(mesh, truth, grid):
    vertices, tets = soup_files.read_medit(mesh)
    if len(tets) == 0:
        return {"tets": 0, "iou": 0.0, "min_dihedral": None}
    angles = dihedral_angles(vertices, tets)
    angles = angles[numpy.isfinite(angles)]
    return {"tets": len(tets), "min_dihedral": float(angles.min()) if len(angles) else None,
            "iou": iou(voxels_inside(vertices, tets, grid), numpy.load(truth).reshape(grid.shape))}


def score_field(field, truth):
    """`inside` out of a .vti of `tetsoup field`: the last array, behind the distances and votes."""
    data = open(field, "rb").read()
    truth = numpy.load(truth).ravel()
    end = data.rindex(b"</AppendedData>")
    block = numpy.uint64(truth.size).tobytes()  # the array's length in bytes stands before it
    start = data.rindex(block, 0, end - truth.size) + 8
    inside = numpy.frombuffer(data, "u1", truth.size, start)
    return {"iou": iou(inside > 0, truth)}


def main(arguments):
    command, *rest = arguments
    if command == "inputs":
        write_inputs(*rest)
    elif command == "truth":
        write_truth(rest[0], rest[1], grid_of(rest[2:]))
    elif command == "score":
        print(json.dumps(score(rest[0], rest[1], grid_of(rest[2:]))))
    elif command == "score-field":
        print(json.dumps(score_field(*rest)))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
