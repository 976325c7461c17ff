"""The grid that tetsoup lays over a soup, for the Python peers."""
import collections

import numpy

Grid = collections.namedtuple("Grid", "shape origin h")  # shape: z, y, x


def grid_of(words):
    nx, ny, nz = (int(word) for word in words[:3])
    return Grid((nz, ny, nx), numpy.array([float(word) for word in words[3:6]]), float(words[6]))


def grid_points(grid, dtype=float):
    """Voxel centres, x fastest."""
    nz, ny, nx = grid.shape
    points = numpy.empty((nz, ny, nx, 3), dtype)
    points[..., 0] = grid.origin[0] + grid.h * numpy.arange(nx)
    points[..., 1] = (grid.origin[1] + grid.h * numpy.arange(ny))[:, None]
    points[..., 2] = (grid.origin[2] + grid.h * numpy.arange(nz))[:, None, None]
    return points.reshape(-1, 3)


def iou(a, b):
    union = numpy.count_nonzero(a | b)
    return float(numpy.count_nonzero(a & b) / union) if union else 1.0
