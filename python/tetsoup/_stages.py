"""The stages one by one, and all of them in a row."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from tetsoup import _core
from tetsoup._mesh import Report, TetMesh
from tetsoup._soup_input import as_points, as_soup
from tetsoup.options import (
    ALL_GROUPS,
    DistanceOptions,
    LatticeOptions,
    MeshOptions,
    PseudoVolumeOptions,
    SmoothOptions,
    complete,
    documented,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from tetsoup._progress import Progress

Stage = Literal["soup", "distance", "pseudo_volume", "lattice", "smooth"]


class LatticeMesh(NamedTuple):
    """A lattice cut by density: the mesh, and what was kept."""

    mesh: TetMesh
    report: _core.LatticeReport


class SmoothResult(NamedTuple):
    """A smoothed mesh, and what smoothing did."""

    mesh: TetMesh
    report: _core.SmoothReport


def clean_soup(vertices: Any, faces: Any = None, *, progress: Progress | None = None) -> _core.CleanSoup:
    """Stage 1: drops what cannot be used, counts it, and says what the rest is.

    Args:
        vertices: (N, 3), any real type; or an object with triangles, as `tetrahedralize` takes.
        faces: (F, 3) integers.

    Raises:
        tetsoup.InvalidInput: if an array has the wrong type or shape. Geometry is never an error.

    Example:
        >>> tetsoup.clean_soup(tetsoup.read("bunny.ply")).report.boundary_edges
        223
    """
    return _core.clean_soup(*as_soup(vertices, faces), progress)


def _clean(soup: Any) -> _core.CleanSoup:
    return soup if isinstance(soup, _core.CleanSoup) else clean_soup(soup)


@documented(DistanceOptions)
def unsigned_distance(
    soup: Any, *, progress: Progress | None = None, **options: Unpack[DistanceOptions]
) -> _core.DistanceField:
    """Stage 2: the distance from every voxel to the nearest triangle.

    Args:
        soup: a `CleanSoup`, or whatever `tetrahedralize` takes as one object.

    Returns:
        A field; its `values` are (z, y, x) float32 in the soup's unit, infinite beyond the band.

    Raises:
        tetsoup.InvalidInput: if an option is out of range, or the soup has no finite triangle.

    Example:
        >>> field = tetsoup.unsigned_distance("bunny.ply", voxels=64, distance_mode="full")
        >>> plt.imshow(field.values[32], origin="lower")
    """
    return _core.unsigned_distance(_clean(soup), dict(options), progress)


def widen_distance(
    field: _core.DistanceField, soup: Any, band_voxels: float, *, progress: Progress | None = None
) -> _core.DistanceField:
    """A field with a wider band; the same as `unsigned_distance` with that band, but cheaper.

    `classify_volume` says in its report's `wants_band_voxels` how wide the automatic choice of k wants it.

    Example:
        >>> field = tetsoup.widen_distance(field, soup, band_voxels=6)
    """
    return _core.widen_distance(field, _clean(soup), band_voxels, progress)


@documented(PseudoVolumeOptions)
def classify_volume(
    field: _core.DistanceField, *, progress: Progress | None = None, **options: Unpack[PseudoVolumeOptions]
) -> _core.PseudoVolume:
    """Stage 3: which voxels does the soup intuitively occupy?

    Returns:
        A volume; `inside` (z, y, x) bool and `votes` (z, y, x) uint8, 0..rays.

    Raises:
        tetsoup.InvalidInput: if an option is out of range, or the field's band is too narrow for it.

    Example:
        >>> volume = tetsoup.classify_volume(tetsoup.unsigned_distance("bunny.ply"))
        >>> plt.imshow(volume.votes[volume.shape[0] // 2], origin="lower")
    """
    return _core.classify_volume(field, dict(options), progress)


@documented(LatticeOptions)
def fill_lattice(
    volume: _core.PseudoVolume, soup: Any, *, progress: Progress | None = None, **options: Unpack[LatticeOptions]
) -> LatticeMesh:
    """Stage 4: a lattice of tets, cut by density.

    Raises:
        tetsoup.InvalidInput: if an option is out of range.

    Example:
        >>> mesh, report = tetsoup.fill_lattice(volume, soup, cells=20)
        >>> report.overlap
        0.91
    """
    mesh, report = _core.fill_lattice(volume, _clean(soup), dict(options), progress)
    return LatticeMesh(TetMesh._wrap(mesh), report)


@documented(SmoothOptions)
def smooth(
    mesh: TetMesh,
    volume: _core.PseudoVolume | None = None,
    soup: Any = None,
    *,
    enclosed: Any = (),
    progress: Progress | None = None,
    **options: Unpack[SmoothOptions],
) -> SmoothResult:
    """Stage 5: rounds the lattice's corners off, keeps the volume, never harms a tet.

    Args:
        mesh: positive tets.
        volume: what the boundary is drawn to; None: it is only faired.
        soup: with a volume: what the mesh reaches of it at first is held on to (rims, tips); None: it may draw back.
        enclosed: (N, 3) points; those that lie in the mesh at the start stay in it.

    Raises:
        tetsoup.InvalidInput: if an option is out of range or a tet is not positive.

    Example:
        >>> smoothed, report = tetsoup.smooth(mesh, volume, passes=20)
    """
    points = as_points(enclosed, "enclosed")
    smoothed, report = _core.smooth_tets(
        mesh._handle, volume, None if soup is None else _clean(soup), points, dict(options), progress
    )
    return SmoothResult(TetMesh._wrap(smoothed), report)


class Pipeline:
    """All stages in a row, remembered: a changed option repeats only what depends on it. For sliders and sweeps.

    Args:
        vertices, faces: as `tetrahedralize` takes.

    Example:
        >>> pipeline = tetsoup.Pipeline("bunny.ply")
        >>> coarse = pipeline.run(tets=500)
        >>> fine = pipeline.run(tets=5000)            # lattice and smoothing only
        >>> pipeline.run_counts["distance"]
        1

    One thread at a time: RuntimeError where another one, or a progress callback, calls during a run. Different
    pipelines run in parallel.
    """

    def __init__(self, vertices: Any, faces: Any = None, *, progress: Progress | None = None) -> None:
        self._lock = threading.Lock()
        self._core = _core.Pipeline(*as_soup(vertices, faces), progress)

    @contextmanager
    def _alone(self) -> Iterator[_core.Pipeline]:
        if not self._lock.acquire(blocking=False):
            raise RuntimeError("this Pipeline is running; wait until it is done, or take another one")
        try:
            yield self._core
        finally:
            self._lock.release()

    @documented(*ALL_GROUPS)
    def run(self, *, progress: Progress | None = None, **options: Unpack[MeshOptions]) -> TetMesh:
        """Brings every stage up to date and returns the mesh.

        Raises:
            tetsoup.InvalidInput: if an option is out of range or the soup has no finite triangle.
            tetsoup.Cancelled: if `progress` answers False; finished stages are kept.
        """
        with self._alone() as core:
            chosen = complete(options)
            if chosen.get("tets") == "auto":
                del chosen["tets"]
                core.find_tet_count(chosen, progress)
            else:
                core.run_until("smooth", chosen, progress)
            return TetMesh._wrap(core.mesh(), lambda: _report(core))

    @documented(*ALL_GROUPS)
    def run_until(self, stage: Stage, *, progress: Progress | None = None, **options: Unpack[MeshOptions]) -> None:
        """Runs the stages up to and including this one.

        Example:
            >>> pipeline.run_until("pseudo_volume", voxels=256)
            >>> votes = pipeline.pseudo_volume.votes
        """
        with self._alone() as core:
            core.run_until(stage, complete(options), progress)

    @property
    def soup(self) -> _core.CleanSoup:
        """The soup as it is used. This and all below: a copy, of the last run."""
        with self._alone() as core:
            return core.soup()

    @property
    def distance(self) -> _core.DistanceField:
        with self._alone() as core:
            return core.distance()

    @property
    def pseudo_volume(self) -> _core.PseudoVolume:
        with self._alone() as core:
            return core.pseudo_volume()

    @property
    def lattice(self) -> LatticeMesh:
        """The mesh before smoothing."""
        with self._alone() as core:
            return LatticeMesh(TetMesh._wrap(core.lattice()), core.lattice_report())

    @property
    def mesh(self) -> TetMesh:
        """The finished mesh."""
        with self._alone() as core:
            return TetMesh._wrap(core.mesh(), lambda: _report(core))

    @property
    def seconds(self) -> dict[str, float]:
        """Wall time of every stage in the last run that reached it."""
        with self._alone() as core:
            return core.seconds()

    @property
    def run_counts(self) -> dict[str, int]:
        """Times every stage has run."""
        with self._alone() as core:
            return core.run_counts()

    def save_fields(self, path: str | os.PathLike[str]) -> None:
        """Writes distance, votes and inside as .vti, for ParaView. Raises tetsoup.IoError."""
        with self._alone() as core:
            core.save_fields(os.fspath(path))

    def save_preview(self, path: str | os.PathLike[str], *, title: str = "", width: int = 1600) -> None:
        """Draws soup, votes, lattice and mesh side by side into a .png, without a screen. Raises tetsoup.IoError."""
        with self._alone() as core:
            core.save_preview(os.fspath(path), title, _captions(core), width)


def _report(core: _core.Pipeline) -> Report:
    fidelity = core.fidelity()
    return Report(
        core.soup_report(),
        core.volume_report(),
        core.lattice_report(),
        core.smooth_report(),
        core.seconds(),
        core.options(),
        fidelity,
        core.notes(fidelity),
    )


def _captions(core: _core.Pipeline) -> list[str]:
    return [
        f"{core.soup_report().used_triangles:,} triangles",
        f"votes, k = {core.volume_report().k:.4g}",
        f"lattice, {core.lattice_report().tet_count:,} tets",
        f"mesh, volume {core.smooth_report().volume_after:.4g}",
    ]


@documented(*ALL_GROUPS)
def tetrahedralize(
    vertices: Any, faces: Any = None, *, progress: Progress | None = None, **options: Unpack[MeshOptions]
) -> TetMesh:
    """Turns any triangle soup into a coarse, well-shaped tet mesh.

    Nothing has to be repaired first: holes, sheets, loose, crossing and inverted triangles are normal input; NaN,
    duplicates and indices beyond the vertices are dropped and counted in the report.

    Args:
        vertices: (N, 3), any real type, lists too; converted to float32. Without `faces`: a mesh of trimesh, pyvista,
            open3d or meshio, a `Soup`, a file's name, or corners (F, 3, 3).
        faces: (F, 3) integers of any type, indices into the vertices.
        progress: called now and then with a stage's name and the done fraction, 0..1; answering False cancels.

    Returns:
        A `TetMesh`, never empty: positive tets with the quality floor kept. The same bits for any number of threads,
        order or winding of the triangles, and as from the command-line tool.

    Raises:
        tetsoup.InvalidInput (a ValueError): if an array has the wrong type or shape or a negative index, an option is
            out of range, or there is no finite triangle.
        tetsoup.IoError (an OSError): if a file cannot be read.
        tetsoup.Cancelled: if `progress` answers False. Ctrl-C raises KeyboardInterrupt within 100 ms.

    Example:
        >>> mesh = tetsoup.tetrahedralize(vertices, faces, tets=2000)
        >>> mesh.points.shape, mesh.tets.shape
        ((611, 3), (1974, 4))
    """
    return Pipeline(vertices, faces, progress=progress).run(progress=progress, **options)
