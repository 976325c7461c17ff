"""The render surface: what an artist draws, with polygons, texture coordinates, normals and names."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from tetsoup import _core
from tetsoup._core import InvalidInput
from tetsoup._soup_input import as_choices, as_index_list, as_points, as_rows, as_soup, as_triple


class Part(NamedTuple):
    """Names that a file gives a face; empty where it gives none."""

    object: str
    group: str
    material: str


class RenderMesh:
    """A surface with all that its file says about it besides the geometry, in the order of the file.

    Made by `read_surface`, or from arrays. Arrays are read-only, the library's own memory, and live as long as you hold
    them. An index of -1 stands for "none".

    Args:
        vertices: (V, 3).
        face_sizes: (F,) corners of every face, 3 or more.
        corners: (C,) vertex of every corner, face after face.
        texcoords: (M, 2) texture coordinates, (u, v) with v upwards.
        corner_texcoords: (C,) one of them for every corner, -1: none.
        normals, corner_normals: (K, 3) and (C,), likewise.
        parts: names (object, group, material).
        face_parts: (F,) one of them for every face.

    Raises:
        tetsoup.InvalidInput: if an array has the wrong type or shape, or what belongs together differs in length.

    Example:
        >>> tetsoup.RenderMesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], face_sizes=[4], corners=[0, 1, 2, 3])
        <tetsoup.RenderMesh: 4 vertices, 1 faces, 0 parts>
    """

    _handle: _core.RenderMesh

    def __init__(
        self,
        vertices: npt.ArrayLike,
        face_sizes: npt.ArrayLike,
        corners: npt.ArrayLike,
        *,
        texcoords: npt.ArrayLike = (),
        corner_texcoords: npt.ArrayLike = (),
        normals: npt.ArrayLike = (),
        corner_normals: npt.ArrayLike = (),
        parts: Sequence[tuple[str, str, str]] = (),
        face_parts: npt.ArrayLike = (),
    ) -> None:
        sizes = as_index_list(face_sizes, "face_sizes")
        if sizes.size and int(sizes.min()) < 3:
            raise InvalidInput(f"face_sizes has {sizes.min()}, must be at least 3")
        coordinates, directions = as_rows(texcoords, "texcoords", 2), as_points(normals, "normals")
        self._handle = _core.RenderMesh(
            as_points(vertices, "vertices"),
            sizes,
            as_index_list(corners, "corners"),
            coordinates,
            as_choices(corner_texcoords, "corner_texcoords", len(coordinates)),
            directions,
            as_choices(corner_normals, "corner_normals", len(directions)),
            [Part(*part) for part in parts],
            as_index_list(face_parts, "face_parts"),
        )

    @classmethod
    def _wrap(cls, core: _core.RenderMesh) -> RenderMesh:
        surface = cls.__new__(cls)
        surface._handle = core
        return surface

    @cached_property
    def vertices(self) -> npt.NDArray[np.float32]:
        """(V, 3) float32; an embedding's points are these, in this order."""
        return self._handle.vertices

    @cached_property
    def face_sizes(self) -> npt.NDArray[np.int32]:
        """Corners of every face, (F,) int32."""
        return self._handle.face_sizes

    @cached_property
    def corners(self) -> npt.NDArray[np.integer[Any]]:
        """Vertex of every corner, face after face, (C,) integers."""
        return signed(self._handle.corners)

    @cached_property
    def texcoords(self) -> npt.NDArray[np.float32]:
        """Texture coordinates (u, v), (M, 2) float32."""
        return self._handle.texcoords

    @cached_property
    def corner_texcoords(self) -> npt.NDArray[np.int32]:
        """Texture coordinate of every corner, -1: none; (C,) int32, or empty if the file has none."""
        return self._handle.corner_texcoords

    @cached_property
    def normals(self) -> npt.NDArray[np.float32]:
        """Normals as given, (K, 3) float32."""
        return self._handle.normals

    @cached_property
    def corner_normals(self) -> npt.NDArray[np.int32]:
        """Normal of every corner, -1: none; (C,) int32, or empty if the file has none."""
        return self._handle.corner_normals

    @cached_property
    def parts(self) -> list[Part]:
        """Names of objects, groups and materials as they occur together, in the order of the file."""
        return [Part(*names) for names in self._handle.parts]

    @cached_property
    def face_parts(self) -> npt.NDArray[np.int32]:
        """Part of every face, (F,) int32."""
        return self._handle.face_parts

    @cached_property
    def triangles(self) -> npt.NDArray[np.integer[Any]]:
        """The faces cut into fans, (T, 3) integers: what `tetsoup.read` gives."""
        return signed(self._handle.triangles())

    @cached_property
    def triangle_faces(self) -> npt.NDArray[np.int32]:
        """The face of every one of `triangles`, (T,) int32."""
        return self._handle.triangle_faces()

    def with_vertices(self, vertices: npt.ArrayLike) -> RenderMesh:
        """The same faces, texture coordinates and names elsewhere, without normals, which would no longer fit.

        Raises:
            tetsoup.InvalidInput: if the shape is not that of `vertices`.

        Example:
            >>> surface.with_vertices(embedding.deform(positions)).save("bent.obj")
        """
        moved = as_points(vertices, "vertices")
        if len(moved) != len(self.vertices):
            raise InvalidInput(f"vertices has {len(moved)} rows, must have {len(self.vertices)}")
        return RenderMesh._wrap(self._handle.with_vertices(moved))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes an .obj with polygons, texture coordinates, normals and names. Raises tetsoup.IoError."""
        self._handle.save(os.fspath(path))

    def __repr__(self) -> str:
        sizes = f"{len(self.vertices):,} vertices, {len(self.face_sizes):,} faces, {len(self.parts):,} parts"
        return f"<tetsoup.RenderMesh: {sizes}>"

    def __reduce__(self) -> tuple[Any, ...]:
        choices = (self.texcoords, self.corner_texcoords, self.normals, self.corner_normals)
        return _surface, (self.vertices, self.face_sizes, self.corners, *choices, self.parts, self.face_parts)


def _surface(vertices: Any, sizes: Any, corners: Any, uv: Any, uvs: Any, n: Any, ns: Any, parts: Any, of: Any) -> Any:
    named = {"texcoords": uv, "corner_texcoords": uvs, "normals": n, "corner_normals": ns}
    return RenderMesh(vertices, sizes, corners, **named, parts=parts, face_parts=of)


def signed(indices: npt.NDArray[np.uint32]) -> npt.NDArray[np.integer[Any]]:
    """As NumPy's users expect them; in 64 bits if a file holds wild ones."""
    wild = indices.size > 0 and int(indices.max()) > np.iinfo(np.int32).max
    return indices.astype(np.int64) if wild else indices.view(np.int32)


def read_surface(path: str | os.PathLike[str]) -> RenderMesh:
    """Reads what `read` reads, with polygons, texture coordinates, normals, and names of objects, groups and materials.

    Raises:
        tetsoup.IoError: if the file cannot be read or is damaged; the text names the line or the byte.

    Example:
        >>> surface = tetsoup.read_surface("bunny.obj")
        >>> surface.parts[0]
        Part(object='bunny', group='', material='fur')
    """
    return RenderMesh._wrap(_core.read_render_mesh(os.fspath(path)))


class LabelSurfaces(NamedTuple):
    """Surfaces of labelled voxels: what `from_labels` makes."""

    hull: RenderMesh
    """Between what has a label and what is outside: for `tetrahedralize`."""
    regions: RenderMesh
    """Of every label by itself, an object each: for `TetMesh.regions`."""


def from_labels(
    labels: npt.ArrayLike,
    spacing: Sequence[float] = (1, 1, 1),
    origin: Sequence[float] = (0, 0, 0),
    *,
    directions: npt.ArrayLike = ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    names: Mapping[int, str] | None = None,
) -> LabelSurfaces:
    """Surfaces of an image whose voxels have labels, such as a segmented scan; 0 is outside.

    Args:
        labels: (nz, ny, nx) whole numbers or bools, as SimpleITK gives them and as all grids here are; nibabel's
            arrays are the other way round: give their `.T`.
        spacing: of voxels along x, y and z.
        origin: (x, y, z) of the first voxel's centre.
        directions: rows are the unit vectors along which x, y and z of the array run.
        names: of labels; without one label 3 is "label_3".

    Raises:
        tetsoup.InvalidInput: if the array has another shape, or holds anything but labels from 0 to 2^32 - 1.

    Example:
        >>> scan = tetsoup.from_labels(labels, spacing=(0.5, 0.5, 1.2), names={1: "flesh", 2: "bone"})
        >>> mesh = tetsoup.tetrahedralize(scan.hull)
        >>> mesh.save("leg", engine="sofa", regions=mesh.regions(scan.regions, by="object"))
    """
    array = np.asarray(labels)
    if array.ndim != 3 or array.size == 0:
        raise InvalidInput(f"labels has the shape {array.shape}, must be (nz, ny, nx)")
    if array.dtype.kind not in "biu":
        raise InvalidInput(f"labels has the type {array.dtype}, must be integers or bools")
    if int(array.min()) < 0 or int(array.max()) > 0xFFFFFFFF:
        raise InvalidInput("labels must be from 0 to 2^32 - 1")
    steps = np.asarray(directions, np.float64)
    if steps.shape != (3, 3):
        raise InvalidInput(f"directions has the shape {steps.shape}, must be (3, 3)")
    steps = steps * np.asarray(as_triple(spacing, "spacing"))[:, None]
    nz, ny, nx = array.shape
    hull, regions = _core.label_surfaces(
        np.ascontiguousarray(array, np.uint32).ravel(),
        [nx, ny, nz],
        steps.tolist(),
        as_triple(origin, "origin"),
        [(int(label), str(name)) for label, name in (names or {}).items()],
    )
    return LabelSurfaces(RenderMesh._wrap(hull), RenderMesh._wrap(regions))


def as_surface(source: Any) -> RenderMesh:
    """A render mesh, a file's name, or whatever `tetrahedralize` takes as one object."""
    if isinstance(source, RenderMesh):
        return source
    if isinstance(source, (str, os.PathLike)):
        return read_surface(source)
    vertices, faces = as_soup(source)
    return RenderMesh(vertices, np.full(len(faces), 3, np.uint32), faces.ravel())
