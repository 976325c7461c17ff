"""The tet mesh that comes out, and the reports on how it was made."""

from __future__ import annotations

import dataclasses
import os
import pathlib
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from tetsoup import _core, _interop
from tetsoup._core import InvalidInput
from tetsoup._soup_input import as_indices, as_points


@dataclasses.dataclass(frozen=True)
class Report:
    """What `tetrahedralize` found, assumed and did, stage by stage."""

    soup: _core.SoupReport
    pseudo_volume: _core.PseudoVolumeReport
    lattice: _core.LatticeReport
    smooth: _core.SmoothReport
    seconds: dict[str, float]
    """Wall time of every stage."""
    options: dict[str, Any]
    """Every option the mesh was made with, those left to their defaults too."""

    def as_dict(self) -> dict[str, Any]:
        """The same as nested dicts.

        Example:
            >>> mesh.report.as_dict()["lattice"]["tet_count"]
            1974
        """
        parts = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return {name: part if isinstance(part, dict) else part.as_dict() for name, part in parts.items()}


class TetMesh:
    """Tetrahedra for simulation.

    Made by `tetrahedralize`, `read_tets`, or from arrays: ``TetMesh(points, tets)`` with points (P, 3) and tets (T, 4).
    Tets are positive (the fourth vertex lies on the side that the first three, seen counter-clockwise, turn their backs
    to) if tetsoup made them.

    Raises:
        tetsoup.InvalidInput: if an array has the wrong type or shape, or an index is negative or beyond the points.

    Example:
        >>> corner = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
        >>> corner.quality.volume
        0.16666666666666666
    """

    _handle: _core.TetMesh

    def __init__(self, points: npt.ArrayLike, tets: npt.ArrayLike) -> None:
        vertices, corners = as_points(points, "points"), as_indices(tets, "tets", 4)
        if corners.size and int(corners.max()) >= len(vertices):
            raise InvalidInput(f"tets has the index {corners.max()}, must be below {len(vertices)}")
        self._handle = _core.TetMesh(vertices, corners)

    @classmethod
    def _wrap(cls, core: _core.TetMesh, make_report: Callable[[], Report] | None = None) -> TetMesh:
        mesh = cls.__new__(cls)
        mesh._handle = core
        if make_report is not None:
            mesh.report = make_report()
        return mesh

    @cached_property
    def points(self) -> npt.NDArray[np.float32]:
        """Vertices, (P, 3) float32, read-only: the library's own memory, which lives as long as the array."""
        return self._handle.points

    @cached_property
    def tets(self) -> npt.NDArray[np.int32]:
        """Corners of the tets, (T, 4) int32, indices into `points`; read-only, not copied."""
        return self._handle.tets

    @cached_property
    def surface(self) -> npt.NDArray[np.int32]:
        """Boundary triangles, (F, 3) int32, indices into `points`, counter-clockwise seen from outside."""
        return self._handle.surface()

    @cached_property
    def quality(self) -> _core.Quality:
        """Volumes, angles (radians), topology; measured at the first access.

        Example:
            >>> numpy.degrees(mesh.quality.min_dihedral)
            15.0
        """
        return self._handle.quality()

    @cached_property
    def report(self) -> Report:
        """What was found, assumed and done. Meshes that were read, built or unpickled have none: AttributeError."""
        raise AttributeError("this mesh was not made by tetrahedralize() or a Pipeline, so it has no report")

    def readiness(
        self,
        *,
        density: float | None = None,
        young: float | None = None,
        poisson: float | None = None,
        metres_per_unit: float | None = None,
    ) -> _core.Readiness:
        """Will an engine simulate this well, what to change if not; mass, and a stable explicit time step.

        Args:
            density: kg/m^3 (1000).
            young: Young's modulus, Pa (1e5).
            poisson: Poisson ratio, [0, 0.5) (0.4).
            metres_per_unit: length of the mesh's unit (1); 0.001 for millimetres.

        Raises:
            tetsoup.InvalidInput: if a number is out of range.

        Example:
            >>> [check.advice for check in mesh.readiness().checks if not check.passed]
            []
        """
        return self._handle.readiness(self.quality, density, young, poisson, metres_per_unit)

    def save(self, path: str | os.PathLike[str], format: str | None = None) -> list[pathlib.Path]:
        """Writes a file, whole or not at all: an existing one stays as it was if anything fails.

        Args:
            path: its extension tells the format: .msh .vtk .vtu .mesh .node .tet .veg .inp .vol .npz .json .usda, or the
                boundary only: .obj .stl .ply.
            format: instead, one of `tetsoup.formats()`.

        Returns:
            The files written; three for TetGen.

        Raises:
            tetsoup.IoError: if it cannot be written, or the extension is unknown.

        Example:
            >>> mesh.save("bunny.msh")
            [PosixPath('bunny.msh')]
        """
        return _core.write_tets(os.fspath(path), self._handle, format)

    def to_meshio(self) -> Any:
        """A `meshio.Mesh` with one block of tetra. Example: ``mesh.to_meshio().write("bunny.xdmf")``."""
        return _interop.to_meshio(self)

    def to_pyvista(self) -> Any:
        """A `pyvista.UnstructuredGrid`. Example: ``mesh.to_pyvista().plot(show_edges=True)``."""
        return _interop.to_pyvista(self)

    def to_trimesh(self) -> Any:
        """The boundary as a `trimesh.Trimesh`, without the points inside. Example: ``mesh.to_trimesh().area``."""
        return _interop.to_trimesh(self)

    def to_polyscope(self, name: str = "tetsoup") -> Any:
        """Registers a volume mesh with polyscope, initialised before. Example: ``mesh.to_polyscope("bunny")``."""
        return _interop.to_polyscope(self, name)

    def to_usd(self, stage: Any, path: str) -> Any:
        """Defines a `UsdGeom.TetMesh` with its surface on a stage. Example: ``mesh.to_usd(stage, "/World/Bunny")``."""
        return _interop.to_usd(self, stage, path)

    def __repr__(self) -> str:
        return f"<tetsoup.TetMesh: {len(self.points):,} points, {len(self.tets):,} tets>"

    def __reduce__(self) -> tuple[Any, ...]:
        return TetMesh, (self.points, self.tets)
