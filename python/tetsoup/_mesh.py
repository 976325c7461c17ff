"""The tet mesh that comes out, and the reports on how it was made."""

from __future__ import annotations

import dataclasses
import os
import pathlib
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from tetsoup import _core, _interop, _model
from tetsoup._core import InvalidInput
from tetsoup._embedding import Embedding, embed
from tetsoup._model import Axis, Body, Material, PartKind, Regions, make_model
from tetsoup._page import Page, make_page
from tetsoup._soup_input import as_indices, as_points, as_soup, as_triple

if TYPE_CHECKING:
    from tetsoup._progress import Progress


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
    fidelity: _core.Fidelity
    """What became of the soup's shape."""
    notes: list[str]
    """What you should know of the mesh, and the option of `tetsoup mesh` that changes it (``--rho-min``: `rho_min`)."""

    def as_dict(self) -> dict[str, Any]:
        """The same as nested dicts.

        Example:
            >>> mesh.report.as_dict()["lattice"]["tet_count"]
            1974
        """
        parts = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return {name: part if isinstance(part, dict | list) else part.as_dict() for name, part in parts.items()}


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
    def cavity_surface(self) -> npt.NDArray[np.int32]:
        """Those triangles of `surface` that bound a closed space in the mesh's midst, (F, 3) int32: pressure on them blows
        it up. None without ``cavities="keep"``, or evidence of a hollow.

        Example:
            >>> numpy.unique(mesh.cavity_surface)      # the vertices that a pump moves
        """
        return self._handle.cavity_surface()

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

        A mesh with a report is also compared with the soup it was made of.

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
        report = self.__dict__.get("report")
        fidelity = None if report is None else report.fidelity
        return self._handle.readiness(self.quality, fidelity, density, young, poisson, metres_per_unit)

    def save(
        self,
        path: str | os.PathLike[str],
        format: str | None = None,
        *,
        engine: str | None = None,
        name: str = "body",
        up: Axis = "z",
        density: float | None = None,
        young: float | None = None,
        poisson: float | None = None,
        metres_per_unit: float | None = None,
        regions: tuple[npt.ArrayLike, list[str]] | None = None,
        materials: Mapping[str, Material] | None = None,
        pins: Mapping[str, npt.ArrayLike] | None = None,
        surface: Any = None,
        embedding: Embedding | None = None,
        calibration: _core.Calibration | None = None,
    ) -> list[pathlib.Path]:
        """Writes a file, or several, whole or not at all: existing ones stay as they were if anything fails.

        What a format has no place for is left out of it: docs/FORMATS.md says who has which.

        Args:
            path: its extension tells the format, one of `tetsoup.formats()`; .obj .stl .ply hold the boundary only.
            format: instead, one of `tetsoup.formats()`.
            engine: or what this one reads, in metres, and a scene beside it where there is one: one of
                `tetsoup.engines()`. The path may leave the extension out.
            name: of the body.
            up: axis of the mesh that points up.
            density, young, poisson: kg/m^3 (1000), Pa (1e5), [0, 0.5) (0.4). If any is given the scene keeps to them
                and shortens its time step where it must; else it is as stiff as the engine's own step allows.
            metres_per_unit: length of the mesh's unit (1); 0.001 for millimetres.
            regions: labels (T,) integers and their names, as from `regions`.
            materials: of regions by name, such as ``{"leaf": {"density": 300}}``; the rest is that of the body.
            pins: vertices to be held, (n,) integers by name; see `vertices_in_box`, `vertices_below`, `vertices_near`.
            surface: what is drawn: a `RenderMesh`, or what `embed` takes as one object.
            embedding: where the surface's vertices lie; None: `embed(surface)`.
            calibration: from `calibrate`: every tet's stiffness and density, or what the format has a place for.

        Returns:
            The files written, the mesh's first.

        Raises:
            tetsoup.IoError: if it cannot be written, or the extension is unknown.
            tetsoup.InvalidInput: for an unknown engine or format, or if an array or a number is out of range.

        Example:
            >>> mesh.save("bunny.msh")
            [PosixPath('bunny.msh')]
            >>> mesh.save("bunny", engine="isaac", surface="bunny.obj", pins={"feet": mesh.vertices_below(0.01)})
            [PosixPath('bunny.usda')]
        """
        if format is not None and engine is not None:
            raise InvalidInput("format and engine: at most one of them")
        body = Body(
            name,
            up,
            density,
            young,
            poisson,
            metres_per_unit,
            regions,
            materials,
            pins,
            surface,
            embedding,
            calibration,
        )
        model = make_model(self, body)
        if engine is None:
            return _core.write_tets(os.fspath(path), model, format)
        return _core.write_for_engine(os.fspath(path), model, engine, body.material_is_default)

    def calibrate(
        self,
        soup: Any,
        *,
        poisson: float | None = None,
        reference_tets: int | None = None,
        progress: Progress | None = None,
    ) -> _core.Calibration:
        """Finds what to multiply each tet's stiffness and density by, so that the mesh moves like a fine one.

        Args:
            soup: what the mesh was made of: whatever `tetrahedralize` takes as one object.
            poisson: Poisson ratio of the material, [0, 0.49] (0.3).
            reference_tets: of the fine mesh, 1000..400000 (40000).

        Returns:
            `Calibration`: stiffness_scale (T,) and density_scale (T,) float32, factor, the best one for all tets, and
            a report of eigenfrequencies, compliance and mass before and after.

        Raises:
            tetsoup.InvalidInput: if a number is out of range, or a tet is not positive.

        Example:
            >>> mesh.save("horse", engine="newton", calibration=mesh.calibrate("horse.obj"))
        """
        vertices, faces = as_soup(soup)
        return _core.calibrate(self._handle, vertices, faces, poisson, reference_tets, progress)

    def embed(
        self,
        surface: Any,
        faces: Any = None,
        *,
        max_extrapolation: float | None = None,
        progress: Progress | None = None,
    ) -> Embedding:
        """Hangs a surface's vertices on the tets: `tetsoup.embed` of this mesh, which says more.

        Example:
            >>> moved = mesh.embed("bunny.obj").deform(positions)
        """
        return embed(self, surface, faces, max_extrapolation=max_extrapolation, progress=progress)

    def regions(self, surface: Any, by: PartKind = "material", *, progress: Progress | None = None) -> Regions:
        """The part of the surface in which most of each tet lies, of open parts the nearest.

        A tet is of the closed part that contains it, of several the innermost.

        Args:
            surface: a `RenderMesh`, a file's name, or whatever `tetrahedralize` takes as one object.
            by: whose names make a region; "part": what is connected, for models that name nothing.

        Returns:
            `Regions`: labels (T,) int32 and names, in the order of the file; "" comes last and is what has no name.
            Parts are "part_1", the one of most triangles, and so on; those without a tet are left out.

        Raises:
            tetsoup.InvalidInput: for another `by`.

        Example:
            >>> labels, names = mesh.regions("tree.obj", by="material")
            >>> mesh.save("tree", engine="sofa", regions=(labels, names), materials={"leaf": {"density": 300}})
        """
        return _model.regions(self, surface, by, progress)

    def vertices_in_box(self, lo: Sequence[float], hi: Sequence[float]) -> npt.NDArray[np.int32]:
        """Vertices in a box, its faces included, (n,) int32 ascending. Example: ``mesh.vertices_in_box(lo, hi)``."""
        return _core.vertices_in_box(self._handle, as_triple(lo, "lo"), as_triple(hi, "hi"))

    def vertices_below(self, offset: float, normal: Sequence[float] = (0, 0, 1)) -> npt.NDArray[np.int32]:
        """Vertices with dot(normal, vertex) <= offset, (n,) int32 ascending. Example: ``mesh.vertices_below(0.1)``.

        Raises:
            tetsoup.InvalidInput: if the normal is zero or not finite.
        """
        return _core.vertices_below(self._handle, as_triple(normal, "normal"), offset)

    def vertices_near(self, surface: Any, name: str, *, progress: Progress | None = None) -> npt.NDArray[np.int32]:
        """Vertices to which faces of this object, group or material are nearest, (n,) int32 ascending.

        Raises:
            tetsoup.InvalidInput: listing the names, if none is so called.

        Example:
            >>> mesh.save("robot", engine="mujoco", pins={"hand": mesh.vertices_near("robot.obj", "hand")})
        """
        return _model.vertices_near(self, surface, name, progress)

    def show(self, surface: Any = None, *, title: str = "mesh", up: Axis = "z", height: int = 600) -> Page:
        """A page that shows the mesh in 3D, its angles, and how it was made: notebooks display it.

        Args:
            surface: shown around the mesh: what `tetrahedralize` takes as one object.
            title: of the page.
            up: axis of the mesh that points up.
            height: pixels in a notebook.

        Raises:
            tetsoup.InvalidInput: for another `up`, or if the surface cannot be understood.

        Example:
            >>> mesh.show("bunny.obj", up="y")
            >>> mesh.show().save("bunny.html")
        """
        return make_page(self, surface, title, up, height)

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

    def to_usd(self, stage: Any, path: str, *, surface: Any = None, embedding: Embedding | None = None) -> Any:
        """Defines a `UsdGeom.TetMesh` with its boundary on a stage.

        Args:
            surface: a `RenderMesh`, or what `embed` takes as one object: a `UsdGeom.Mesh` beside it, named as the path
                with "_render" behind, with texture coordinates, and its embedding as primvars `tetsoup:tet` and
                `tetsoup:weights`, as `save` writes them.
            embedding: where its vertices lie; None: `embed(surface)`.

        Returns:
            The `UsdGeom.TetMesh`.

        Example:
            >>> mesh.to_usd(stage, "/World/Bunny", surface="bunny.obj")
        """
        return _interop.to_usd(self, stage, path, surface, embedding)

    def __repr__(self) -> str:
        return f"<tetsoup.TetMesh: {len(self.points):,} points, {len(self.tets):,} tets>"

    def __reduce__(self) -> tuple[Any, ...]:
        return TetMesh, (self.points, self.tets)
