"""tetsoup: any triangle soup in, a coarse and well-shaped tetrahedral mesh out, and a simulation of it.

Example:
    >>> import tetsoup
    >>> mesh = tetsoup.tetrahedralize("bunny.ply", tets=2000)
    >>> mesh.save("bunny.msh")
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from tetsoup import _core
from tetsoup._core import (
    BandScore,
    BoundaryDistance,
    CalibrateReport,
    Calibration,
    Cancelled,
    CleanSoup,
    DistanceField,
    EmbedReport,
    Energy,
    InvalidInput,
    IoError,
    LatticeReport,
    Momentum,
    MotionError,
    PseudoVolume,
    PseudoVolumeReport,
    Fidelity,
    Quality,
    Readiness,
    ReadinessCheck,
    SimulationReport,
    SmoothReport,
    SoupReport,
    TopologyReport,
)
from tetsoup._embedding import Embedding, embed, read_embedding
from tetsoup._mesh import Report, TetMesh
from tetsoup._model import Material, Regions
from tetsoup._page import Page
from tetsoup._progress import Progress, tqdm_progress
from tetsoup._simulation import Simulation
from tetsoup._soup_input import Soup, as_soup
from tetsoup._stages import (
    LatticeMesh,
    Pipeline,
    SmoothResult,
    classify_volume,
    clean_soup,
    fill_lattice,
    smooth,
    tetrahedralize,
    unsigned_distance,
    widen_distance,
)
from tetsoup._surface import LabelSurfaces, Part, RenderMesh, from_labels, read_surface
from tetsoup.options import (
    BodyOptions,
    DistanceOptions,
    LatticeOptions,
    MaterialOptions,
    MeshOptions,
    PoseOptions,
    PseudoVolumeOptions,
    SimulationOptions,
    SmoothOptions,
    default_options,
)

__version__: str = _core.VERSION
for _error in (InvalidInput, IoError, Cancelled):
    _error.__module__ = "tetsoup"


def read(path: str | os.PathLike[str]) -> Soup:
    """Reads triangles: .obj .stl .ply .off .gltf .glb .3mf .dae. Polygons are cut into fans; nothing else is changed.

    Returns:
        A `Soup`: vertices (N, 3) float32, faces (F, 3) integers.

    Raises:
        tetsoup.IoError: if the file cannot be read or is damaged; the text names the line or the byte.

    Example:
        >>> vertices, faces = tetsoup.read("bunny.ply")
    """
    return _as_soup(*_core.read_soup(os.fspath(path)))


def read_tets(path: str | os.PathLike[str]) -> TetMesh:
    """Reads a tet mesh: .msh .vtk .vtu .mesh .npz .node.

    Raises:
        tetsoup.IoError: if the file cannot be read or is damaged.

    Example:
        >>> tetsoup.read_tets("bunny.msh").quality.min_dihedral
        0.2617993877991494
    """
    return TetMesh._wrap(_core.read_tets(os.fspath(path)))


def overlap(mesh: TetMesh, volume: PseudoVolume) -> float:
    """Intersection over union of a mesh with the inside voxels of a volume, 0..1.

    Example:
        >>> tetsoup.overlap(pipeline.mesh, pipeline.pseudo_volume)
        0.93
    """
    return volume.overlap(mesh._handle)


def fidelity(mesh: TetMesh, soup: Any) -> Fidelity:
    """What became of a soup's shape in a mesh of it: what was lost, filled, torn, joined; `mesh.report` has it too.

    Args:
        soup: whatever `tetrahedralize` takes as one object.

    Example:
        >>> tetsoup.fidelity(mesh, "bunny.ply").volume_ratio
        1.01
    """
    return _core.fidelity(mesh._handle, *as_soup(soup))


def boundary_distance(mesh: TetMesh, soup: Any, unit: float = 1) -> BoundaryDistance:
    """How far the mesh's boundary lies from the triangles: mean, and what 95 % of it is within.

    Args:
        soup: whatever `tetrahedralize` takes as one object.
        unit: length in multiples of which the result is given, such as `mesh.report.lattice.mean_edge`.

    Example:
        >>> tetsoup.boundary_distance(mesh, "bunny.ply").percentile95
        0.0021
    """
    return _core.boundary_distance(mesh._handle, *as_soup(soup), unit)


def sample(name: str, *, damage: float = 0, seed: int = 1, wall: float | None = None) -> Soup:
    """A shape made by formula, to play with; the same bits on every machine.

    Args:
        name: one of `sample_names()`.
        damage: share of the triangles removed at random, [0, 1).
        seed: of whatever is random.
        wall: thickness of a cup's, pipe's or tray's wall, a comb's tooth, a chain's wire, as a share of the length; None:
            the sample's own.

    Raises:
        tetsoup.InvalidInput: for an unknown name, a damage or wall out of range, or a wall where there is none.

    Example:
        >>> tetsoup.tetrahedralize(tetsoup.sample("torus", damage=0.9))
        <tetsoup.TetMesh: 696 points, 1,980 tets>
    """
    return _as_soup(*_core.make_sample(name, damage, seed, wall))


def sample_names() -> list[str]:
    """Names that `sample` knows."""
    return _core.sample_names()


def formats() -> dict[str, str]:
    """Names and meanings of the formats that `TetMesh.save` takes."""
    return _core.tet_formats()


def engines() -> dict[str, str]:
    """Names of the engines that `TetMesh.save` takes, and what each is given.

    Example:
        >>> tetsoup.engines()["newton"]
        'NumPy arrays (.npz), 0-based, positive, metres'
    """
    return _core.engines()


def set_thread_count(threads: int) -> None:
    """Upper bound on the threads that everything uses from now on; 0 takes all cores. Results never depend on it.

    Raises:
        tetsoup.InvalidInput: if negative.

    Example:
        >>> tetsoup.set_thread_count(4)
    """
    _core.set_thread_count(threads)


def thread_count() -> int:
    """Threads that may be used now."""
    return _core.thread_count()


def _as_soup(vertices: npt.NDArray[np.float32], faces: npt.NDArray[np.uint32]) -> Soup:
    """Faces signed, as NumPy's users expect; in 64 bits if a file holds wild indices."""
    wild = faces.size > 0 and int(faces.max()) > np.iinfo(np.int32).max
    return Soup(vertices, faces.astype(np.int64) if wild else faces.view(np.int32))


__all__ = [
    "BandScore",
    "BodyOptions",
    "BoundaryDistance",
    "CalibrateReport",
    "Calibration",
    "Cancelled",
    "CleanSoup",
    "DistanceField",
    "DistanceOptions",
    "EmbedReport",
    "Embedding",
    "Energy",
    "Fidelity",
    "InvalidInput",
    "IoError",
    "LabelSurfaces",
    "LatticeMesh",
    "LatticeOptions",
    "LatticeReport",
    "Material",
    "MaterialOptions",
    "MeshOptions",
    "Momentum",
    "MotionError",
    "Page",
    "Part",
    "Pipeline",
    "PoseOptions",
    "Progress",
    "PseudoVolume",
    "PseudoVolumeOptions",
    "PseudoVolumeReport",
    "Quality",
    "Readiness",
    "ReadinessCheck",
    "Regions",
    "RenderMesh",
    "Report",
    "Simulation",
    "SimulationOptions",
    "SimulationReport",
    "SmoothOptions",
    "SmoothReport",
    "SmoothResult",
    "Soup",
    "SoupReport",
    "TetMesh",
    "TopologyReport",
    "__version__",
    "boundary_distance",
    "classify_volume",
    "clean_soup",
    "default_options",
    "embed",
    "engines",
    "fidelity",
    "fill_lattice",
    "formats",
    "from_labels",
    "overlap",
    "read",
    "read_embedding",
    "read_surface",
    "read_tets",
    "sample",
    "sample_names",
    "set_thread_count",
    "smooth",
    "tetrahedralize",
    "thread_count",
    "tqdm_progress",
    "unsigned_distance",
    "widen_distance",
]
