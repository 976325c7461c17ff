"""Whatever holds triangles, as the two arrays the library takes.

Objects of trimesh, pyvista, open3d and meshio are told by what they offer, so none of these has to be installed.
"""

from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from tetsoup import _core

Points = npt.NDArray[np.float32]
Faces = npt.NDArray[np.uint32]
#: An index no vertex has, for indices beyond 32 bits: the library drops and counts such triangles.
NO_VERTEX = np.iinfo(np.uint32).max


class Soup(NamedTuple):
    """Triangles in no order that matters.

    vertices: (N, 3) float32. faces: (F, 3) integers, indices into the vertices.
    """

    vertices: npt.NDArray[np.float32]
    faces: npt.NDArray[np.integer[Any]]


def as_soup(vertices: Any, faces: Any = None) -> tuple[Points, Faces]:
    """Contiguous float32 vertices (N, 3) and uint32 faces (F, 3).

    Raises:
        tetsoup.InvalidInput: if an array has the wrong type or shape, or a negative index.
        tetsoup.IoError: if a file cannot be read.
    """
    if faces is None:
        vertices, faces = _take_apart(vertices)
    return as_points(vertices, "vertices"), as_indices(faces, "faces", 3)


def as_points(values: Any, name: str) -> Points:
    return as_rows(values, name, 3)


def as_rows(values: Any, name: str, columns: int) -> Points:
    array = _as_array(values, name)
    _check_rows(array, name)
    if array.size == 0:
        array = array.reshape(0, columns).astype(np.float32)
    if array.dtype.kind not in "fiu":
        raise _core.InvalidInput(f"{name} has the type {array.dtype}, must be real numbers")
    if array.ndim != 2 or array.shape[1] != columns:
        raise _core.InvalidInput(f"{name} has the shape {array.shape}, must be (N, {columns})")
    with np.errstate(over="ignore"):  # beyond single precision is infinite, which the library counts
        return np.ascontiguousarray(array, dtype=np.float32)


def as_indices(values: Any, name: str, columns: int) -> Faces:
    array = _as_array(values, name)
    _check_rows(array, name)
    if array.size == 0:
        return np.empty((0, columns), np.uint32)
    if array.dtype.kind not in "iu":
        raise _core.InvalidInput(f"{name} has the type {array.dtype}, must be integers")
    if array.ndim != 2 or array.shape[1] != columns:
        raise _core.InvalidInput(f"{name} has the shape {array.shape}, must be (N, {columns})")
    if array.dtype.kind == "i" and array.min() < 0:
        row = int(np.argmax((array < 0).any(axis=1)))
        raise _core.InvalidInput(f"{name}[{row}] = {array[row].tolist()}, must not have a negative index")
    if array.dtype.itemsize > 4 and array.max() > NO_VERTEX:
        array = np.minimum(array, NO_VERTEX)
    return np.ascontiguousarray(array, dtype=np.uint32)


def as_index_list(values: Any, name: str) -> Faces:
    """(N,) uint32."""
    array = _as_array(values, name)
    if array.size and array.ndim != 1:
        raise _core.InvalidInput(f"{name} has the shape {array.shape}, must be (N,)")
    return as_indices(array.reshape(-1, 1), name, 1).ravel()


def as_choices(values: Any, name: str, count: int) -> Faces:
    """(N,) uint32, each below `count`, or -1 for none."""
    array = _as_array(values, name)
    if array.size == 0:
        return np.empty(0, np.uint32)
    if array.dtype.kind not in "iu" or array.ndim != 1:
        raise _core.InvalidInput(f"{name} has the type {array.dtype} and shape {array.shape}, must be (N,) integers")
    if array.max() >= count or array.min() < -1:
        raise _core.InvalidInput(f"{name} has an index out of range, must be below {count}, or -1 for none")
    return np.ascontiguousarray(array, np.int32).view(np.uint32)


def as_triple(values: Any, name: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(value) for value in values)
    except (TypeError, ValueError, OverflowError) as error:
        raise _core.InvalidInput(f"{name} = {values!r}, must be three numbers") from error
    return x, y, z


def _as_array(values: Any, name: str) -> npt.NDArray[Any]:
    try:
        return np.asarray(values)
    except (TypeError, ValueError, RuntimeError) as error:
        raise _core.InvalidInput(f"{name} cannot be made an array: {error}") from error


def _check_rows(array: npt.NDArray[Any], name: str) -> None:
    """Before anything is copied: an array of stride 0 has any number of rows in no memory."""
    if array.ndim > 0 and array.shape[0] >= NO_VERTEX:
        raise _core.InvalidInput(f"{name} has {array.shape[0]} rows, must have fewer than 2^32 - 1")


def _take_apart(source: Any) -> tuple[Any, Any]:
    """Vertices and faces of one object that has both."""
    if isinstance(source, (str, os.PathLike)):
        return _core.read_soup(os.fspath(source))
    if hasattr(source, "face_sizes") and hasattr(source, "triangles"):  # a RenderMesh
        return source.vertices, source.triangles
    if isinstance(source, (Soup, _core.CleanSoup)):
        return source.vertices, source.faces
    if hasattr(source, "extract_surface") or hasattr(source, "n_blocks"):
        return _from_pyvista(source)
    if hasattr(source, "cells_dict"):
        return _from_meshio(source)
    if hasattr(source, "to_mesh") and hasattr(source, "geometry"):  # a scene of trimesh
        source = source.to_mesh()
    if hasattr(source, "triangle") and hasattr(source, "vertex"):  # open3d.t.geometry.TriangleMesh
        return source.vertex.positions.cpu().numpy(), source.triangle.indices.cpu().numpy()
    if hasattr(source, "vertices"):
        faces = getattr(source, "faces", None)  # trimesh
        if faces is None:
            faces = getattr(source, "triangles", None)  # open3d.geometry.TriangleMesh
        if faces is not None:
            return source.vertices, faces
    return _from_corners(source)


def _from_corners(source: Any) -> tuple[Any, Any]:
    """(F, 3, 3): three corners a triangle, as in an STL file."""
    corners = _as_array(source, "vertices")
    if corners.ndim != 3 or corners.shape[1:] != (3, 3):
        kind = type(source).__name__
        raise _core.InvalidInput(
            f"faces is missing: {kind} of shape {corners.shape} is no mesh, no file's name, and no (F, 3, 3) corners"
        )
    return corners.reshape(-1, 3), np.arange(3 * len(corners), dtype=np.uint32).reshape(-1, 3)


def _from_pyvista(source: Any) -> tuple[Any, Any]:
    if hasattr(source, "n_blocks"):
        source = source.combine()
    if not hasattr(source, "verts"):  # volumes: their boundary
        source = _outer_surface(source)
    triangles = source.triangulate()
    return triangles.points, np.asarray(triangles.faces).reshape(-1, 4)[:, 1:]


def _outer_surface(volume: Any) -> Any:
    try:
        return volume.extract_surface(algorithm=None)
    except TypeError:  # pyvista before 0.47 knows no choice
        return volume.extract_surface()


def _from_meshio(source: Any) -> tuple[Any, Any]:
    points = np.asarray(source.points)
    if points.ndim == 2 and points.shape[1] == 2:  # flat meshes
        points = np.pad(points, ((0, 0), (0, 1)))
    fans = [np.empty((0, 3), np.int64)]
    for block in source.cells:
        if block.type.startswith(("triangle", "quad", "polygon")):
            fans += _cut_into_fans(block.type, np.asarray(block.data))
    return points, np.concatenate(fans)


def _cut_into_fans(kind: str, polygons: npt.NDArray[Any]) -> list[npt.NDArray[Any]]:
    """Triangles (0, i, i + 1); nodes on the edges of curved cells are left out."""
    corners = 3 if kind.startswith("triangle") else 4 if kind.startswith("quad") else polygons.shape[1]
    return [polygons[:, [0, i, i + 1]] for i in range(1, corners - 1)]
