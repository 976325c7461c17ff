"""Distance fields and inside/outside with Python peers: fields.py WHAT SOUP.bin GRID [TRUTH.npy]

WHAT: distance-igl, distance-open3d, winding-igl, occupancy-open3d. The clock runs from the soup in memory to the values of
all voxels in memory, building of trees included, imports and making of the query points not. One line of JSON.
"""
import json
import sys
import time

import numpy

import soup_files
from grids import grid_of, grid_points, iou


def distance_igl(vertices, triangles, grid):
    import igl
    points, vertices = grid_points(grid), vertices.astype(float)
    start = time.perf_counter()
    squared, _, _ = igl.point_mesh_squared_distance(points, vertices, triangles)
    seconds = time.perf_counter() - start
    return {"seconds": seconds, "in_band": int(numpy.count_nonzero(squared < (3 * grid.h) ** 2))}


def open3d_scene(vertices, triangles):
    import open3d
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(vertices.astype(numpy.float32)), open3d.core.Tensor(triangles.astype(numpy.uint32)))
    return scene


def distance_open3d(vertices, triangles, grid):
    import open3d
    points = open3d.core.Tensor(grid_points(grid, numpy.float32))
    start = time.perf_counter()
    distance = open3d_scene(vertices, triangles).compute_distance(points).numpy()
    seconds = time.perf_counter() - start
    return {"seconds": seconds, "in_band": int(numpy.count_nonzero(distance < 3 * grid.h))}


def winding_igl(vertices, triangles, grid):
    import igl
    points, vertices = grid_points(grid), vertices.astype(float)
    start = time.perf_counter()
    winding = igl.fast_winding_number(vertices, triangles, points)
    seconds = time.perf_counter() - start
    return {"seconds": seconds, "inside": numpy.abs(winding) > 0.5, "inside_quarter": numpy.abs(winding) > 0.25}


def occupancy_open3d(vertices, triangles, grid):
    import open3d
    points = open3d.core.Tensor(grid_points(grid, numpy.float32))
    start = time.perf_counter()
    inside = open3d_scene(vertices, triangles).compute_occupancy(points).numpy()
    return {"seconds": time.perf_counter() - start, "inside": inside > 0.5}


def main(what, soup, *rest):
    vertices, triangles = soup_files.read_raw(soup)
    functions = {"distance-igl": distance_igl, "distance-open3d": distance_open3d, "winding-igl": winding_igl,
                 "occupancy-open3d": occupancy_open3d}
    result = functions[what](vertices, triangles.astype(numpy.int64), grid_of(rest[:7]))
    for name in ("inside", "inside_quarter"):
        if name in result:
            inside = result.pop(name)
            if len(rest) > 7:
                result[name.replace("inside", "iou")] = iou(inside, numpy.load(rest[7]))
    print(json.dumps(result))


if __name__ == "__main__":
    main(*sys.argv[1:])
