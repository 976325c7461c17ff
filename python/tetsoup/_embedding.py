"""A surface of any fineness hangs on the tets, and moves with them."""

from __future__ import annotations

import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from tetsoup import _core
from tetsoup._core import InvalidInput
from tetsoup._soup_input import as_points, as_soup
from tetsoup._surface import RenderMesh, read_surface

if TYPE_CHECKING:
    from tetsoup._mesh import TetMesh
    from tetsoup._progress import Progress


class Embedding:
    """Where N points lie in a tet mesh: a tet and four weights each. Made by `embed` and `read_embedding`.

    Keeps the mesh it belongs to, so it moves points wherever the mesh's vertices go.

    Example:
        >>> embedding = mesh.embed("bunny.obj")
        >>> embedding.deform(mesh.points * 2).shape
        (34834, 3)
    """

    _handle: _core.Embedding
    _mesh: _core.TetMesh | None

    @classmethod
    def _wrap(cls, core: _core.Embedding, mesh: _core.TetMesh | None) -> Embedding:
        embedding = cls.__new__(cls)
        embedding._handle, embedding._mesh = core, mesh
        return embedding

    @cached_property
    def tets(self) -> npt.NDArray[np.int32]:
        """Tet of every point, (N,) int32, read-only."""
        return self._handle.tets

    @cached_property
    def weights(self) -> npt.NDArray[np.float32]:
        """Barycentric weights of the tet's corners, (N, 4) float32, sum 1; negative or above 1 outside. Read-only."""
        return self._handle.weights

    @cached_property
    def distances(self) -> npt.NDArray[np.float32]:
        """Distance of every point from the mesh in its unit, (N,) float32; 0 inside. Read-only."""
        return self._handle.distances

    @property
    def report(self) -> _core.EmbedReport:
        """How many points lie inside, outside, and how far."""
        return self._handle.report

    def deform(self, positions: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """The points after the mesh's vertices have moved; exact under any affine map but for rounding.

        Args:
            positions: (P, 3), of the mesh's vertices.

        Returns:
            (N, 3) float32, a new array.

        Raises:
            tetsoup.InvalidInput: if there are not as many positions as the mesh has vertices, or the embedding was read
                without its mesh.

        Example:
            >>> bent = embedding.deform(simulated_positions)
        """
        mesh = self._its_mesh()
        return self._handle.deform(mesh, self._as_positions(mesh, positions))

    def deform_normals(self, positions: npt.ArrayLike, normals: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Unit normals of the points after the mesh's vertices have moved.

        Args:
            positions: (P, 3), of the mesh's vertices.
            normals: (N, 3), of the points at rest.

        Returns:
            (N, 3) float32; where a tet is flat or a normal zero, the normal as given.

        Raises:
            tetsoup.InvalidInput: if a number of rows does not fit, or the embedding was read without its mesh.

        Example:
            >>> embedding.deform_normals(positions, normals)
        """
        mesh = self._its_mesh()
        return self._handle.deform_normals(mesh, self._as_positions(mesh, positions), as_points(normals, "normals"))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .npz (arrays `tets`, `weights`, `distances`) or .embedding (layout in docs/FORMATS.md), atomically.

        Raises:
            tetsoup.IoError: if it cannot be written, or has another extension.
        """
        self._handle.save(os.fspath(path))

    def _its_mesh(self) -> _core.TetMesh:
        if self._mesh is None:
            raise InvalidInput("mesh is missing: read the embedding with it, read_embedding(path, mesh)")
        return self._mesh

    @staticmethod
    def _as_positions(mesh: _core.TetMesh, positions: npt.ArrayLike) -> npt.NDArray[np.float32]:
        moved, wanted = as_points(positions, "positions"), len(mesh.points)
        if len(moved) != wanted:
            raise InvalidInput(f"positions has {len(moved)} rows, must have {wanted}, one for every vertex of the mesh")
        return moved

    def __len__(self) -> int:
        return len(self.tets)

    def __repr__(self) -> str:
        return f"<tetsoup.Embedding: {len(self):,} points, {self.report.outside:,} of them outside>"

    def __reduce__(self) -> tuple[Any, ...]:
        mesh = None if self._mesh is None else (self._mesh.points, self._mesh.tets)
        return _embedding, (self.tets, self.weights, self.distances, self.report.as_dict(), mesh)


def _embedding(tets: Any, weights: Any, distances: Any, report: dict[str, Any], mesh: Any) -> Embedding:
    core = _core.Embedding(tets.view(np.uint32), weights, distances, *report.values())
    return Embedding._wrap(core, None if mesh is None else _core.TetMesh(mesh[0], mesh[1].view(np.uint32)))


def embed(
    mesh: TetMesh,
    surface: Any,
    faces: Any = None,
    *,
    max_extrapolation: float | None = None,
    progress: Progress | None = None,
) -> Embedding:
    """Hangs every vertex of a surface on the tet that holds it, or on the nearest one.

    Where tets lie in one place twice, kept apart, the surface's faces tell which of them a vertex belongs to.

    Args:
        surface: a `RenderMesh`, a file's name, whatever `tetrahedralize` takes as one object, or vertices (N, 3):
            without `faces` every point stands alone.
        faces: (F, 3) integers.
        max_extrapolation: how far beyond the mesh a point may be, in heights of its tet, >= 0 (4).

    Returns:
        An `Embedding` of the vertices in their own order.

    Raises:
        tetsoup.InvalidInput: if the mesh has no tet, or an array or the option is wrong. NaN is counted, not refused.
        tetsoup.IoError: if a file cannot be read.
        tetsoup.Cancelled: if `progress` answers False.

    Example:
        >>> embedding = tetsoup.embed(mesh, tetsoup.read_surface("bunny.obj"))
        >>> embedding.report.outside
        0
    """
    vertices, triangles = _points_and_faces(surface, faces)
    return Embedding._wrap(
        _core.embed_points(mesh._handle, vertices, triangles, max_extrapolation, progress), mesh._handle
    )


def _points_and_faces(surface: Any, faces: Any) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.uint32]]:
    if faces is None and isinstance(surface, (str, os.PathLike)):
        surface = read_surface(surface)
    if faces is None and not isinstance(surface, (RenderMesh, tuple)) and not hasattr(surface, "vertices"):
        points = np.asarray(surface) if isinstance(surface, (list, np.ndarray)) else None
        if points is not None and (points.size == 0 or points.ndim == 2):
            return as_points(surface, "vertices"), np.empty((0, 3), np.uint32)
    return as_soup(surface, faces)


def read_embedding(path: str | os.PathLike[str], mesh: TetMesh | None = None) -> Embedding:
    """Reads what `Embedding.save` writes.

    Args:
        mesh: the one that it belongs to, which `deform` needs.

    Raises:
        tetsoup.IoError: if the file cannot be read or is damaged.
        tetsoup.InvalidInput: if a point hangs on a tet that the mesh does not have.

    Example:
        >>> embedding = tetsoup.read_embedding("bunny.npz", mesh)
    """
    core = _core.read_embedding(os.fspath(path))
    if mesh is None:
        return Embedding._wrap(core, None)
    if core.tets.size and int(core.tets.view(np.uint32).max()) >= len(mesh.tets):
        raise InvalidInput(f"mesh has {len(mesh.tets)} tets, must have those that {os.fspath(path)} hangs points on")
    return Embedding._wrap(core, mesh._handle)
