"""Every option of the library, by stage: the keywords of the functions that take them.

Each is one line: keyword, type, meaning. Defaults are the library's own (`tetsoup.default_options()`); leaving a
keyword out takes them. Lengths are in the soup's own unit unless a name ends in ``_voxels`` or ``_cells``; angles are
radians, but degrees for how a body of a simulation is turned and spins.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypedDict, TypeVar, get_args, get_origin, get_type_hints

from tetsoup import _core

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    import numpy.typing as npt

    Triple = Sequence[float] | npt.NDArray[np.floating[Any]]
    Corners = Sequence[Triple] | npt.NDArray[np.floating[Any]]
else:
    Triple = Corners = object

Function = TypeVar("Function", bound=Callable[..., Any])


class DistanceOptions(TypedDict, total=False):
    """The voxel grid and the distances on it. At most one of `voxels` and `voxel_size`; none: 128 voxels."""

    voxels: Annotated[int | None, "voxels along the longest axis of the soup's box, 1..4096"]
    voxel_size: Annotated[float | None, "edge of a voxel, instead of `voxels`"]
    box: Annotated[Corners | None, "corners of the space to cover, which must hold the soup (the soup's box)"]
    distance_band_voxels: Annotated[float, "half width of the band in which distances are exact, in voxels, >= 3"]
    distance_mode: Annotated[Literal["band", "full"], "distances in the band, all that meshing needs, or everywhere"]


class PseudoVolumeOptions(TypedDict, total=False):
    """What is inside. At most one of `k`, `band_voxels` and `band`; none: chosen automatically."""

    k: Annotated[float | None, "event threshold, 0..1; less bridges wider gaps between triangles"]
    band_voxels: Annotated[float | None, "half width of the event band in voxels: about half the widest gap to close"]
    band: Annotated[float | None, "the same as a length"]
    rays: Annotated[int, "rays that vote on every voxel: 26 or 13"]
    placement: Annotated[Literal["closest", "entry"], "where a ray crosses the band; 'entry' thickens the result"]
    cavities: Annotated[
        Literal["auto", "fill", "keep"],
        "enclosed space: hollow where closed shells turn their outside to it; solid; hollow where rays say so",
    ]
    thickness: Annotated[float | None, "of sheets, and of nothing else"]


class LatticeOptions(TypedDict, total=False):
    """The tets. At most one of `tets`, `mesh_vertices`, `edge`, `cells` and `cell_size`; none: 2,000 tets."""

    tets: Annotated[
        int | Literal["auto"] | None,
        "tets wanted, 1..2^27; 'auto': the fewest of 500, 1000, 2000 ... 32000 at which the shape holds",
    ]
    mesh_vertices: Annotated[int | None, "vertices wanted"]
    edge: Annotated[float | None, "mean edge of the lattice's tets"]
    cells: Annotated[int | None, "cubic cells along the longest axis of the soup's box, 1..1024"]
    cell_size: Annotated[float | None, "edge of a cubic cell"]
    lattice: Annotated[Literal["five", "bcc"], "five tets a cube, or body-centred cubic: twelve equal tets a cube"]
    translate_cells: Annotated[Triple, "shift of the lattice (x, y, z), in fractions of a cell"]
    rotate: Annotated[Triple, "rotation of the lattice about x, then y, then z, radians"]
    fit: Annotated[Literal["off", "search"], "'search' moves and turns the lattice to match the volume best"]
    rho_min: Annotated[float, "a tet stays if at least this share of it is inside, (0, 1]"]
    thin: Annotated[Literal["keep", "drop"], "parts of the soup too thin for the lattice"]
    cover: Annotated[
        Literal["density", "enclose", "inside"],
        "'enclose': the soup's vertices lie in the mesh; 'inside': it in the volume",
    ]
    separate: Annotated[Literal["on", "off"], "keep apart what shares a cell without touching"]
    stairs: Annotated[Literal["even", "leave"], "tets that stick out, and notches, where density hardly tells"]
    touching: Annotated[Literal["mend", "leave"], "tets joined by a vertex or an edge only"]
    min_part: Annotated[float, "parts with a smaller share of the volume are dropped, [0, 1)"]
    bubbles: Annotated[Literal["fill", "keep"], "voids in the mesh without a way out"]
    boundary_only: Annotated[Literal["leave", "remove", "split"], "tets with all four vertices on the boundary"]


class SmoothOptions(TypedDict, total=False):
    """Rounding the lattice's corners off. The limits hold for every tet that did not begin beyond them."""

    passes: Annotated[int, "smoothing passes, 0..1000; 0 leaves the lattice as it is"]
    strength: Annotated[float, "of the fairing, > 0; 1: a time step of one squared edge"]
    min_dihedral: Annotated[float, "least dihedral angle, radians in [0, pi/3)"]
    max_dihedral: Annotated[float, "largest dihedral angle, radians in [pi/2, pi]"]
    max_edge_ratio: Annotated[float, "longest over shortest edge of a tet, >= 1"]
    snap: Annotated[Literal["on", "off"], "draw the boundary to the surface of the volume, or only fair it"]


class RunOptions(TypedDict, total=False):
    """What the machine may give."""

    join: Annotated[Literal["touching", "near", "all"], "which parts of the soup are one body"]
    memory_limit: Annotated[int | None, "bytes that the voxel grid may take; None: no limit (what is free now)"]


class MeshOptions(DistanceOptions, PseudoVolumeOptions, LatticeOptions, SmoothOptions, RunOptions, total=False):
    """All options there are."""


class SimulationOptions(TypedDict, total=False):
    """How bodies move. Metres, kilograms, seconds."""

    solver: Annotated[
        Literal["implicit", "potentials"],
        "position based and stable at any step; or explicit forces that keep lengths, areas and volumes",
    ]
    gravity: Annotated[Triple, "(x, y, z), m/s^2"]
    substeps: Annotated[int, "of each 1/60 s, at least, 1..10000; 'potentials' takes more where its stability asks for it,"]
    max_substeps: Annotated[int, "and 'implicit' up to so many where bodies would else be softer than their material"]
    contact_interval: Annotated[int, "of `substeps`, from one search for contacts to the next, >= 1"]
    contacts: Annotated[
        Literal["all", "between", "none"], "'between': bodies not with themselves; 'none': not even with obstacles"
    ]
    distance_stiffness: Annotated[float | None, "of 'potentials', J; None: from the material"]
    area_stiffness: Annotated[float | None, "likewise"]
    volume_stiffness: Annotated[float | None, "likewise"]


class MaterialOptions(TypedDict, total=False):
    """What a body is made of."""

    density: Annotated[float, "kg/m^3"]
    young: Annotated[float, "Young's modulus, Pa"]
    poisson: Annotated[float, "Poisson ratio, [0, 0.5)"]
    damping_time: Annotated[float, "s: stress grows by this much of what the rate of strain would add in a second"]
    friction: Annotated[float, "Coulomb's coefficient; between two bodies the geometric mean counts"]
    metres_per_unit: Annotated[float, "length of the mesh's unit; 0.001 for millimetres"]


class PoseOptions(TypedDict, total=False):
    """Where a body is placed and how it moves there: scaled, turned about x, then y, then z, and shifted."""

    translate: Annotated[Triple, "(x, y, z), m"]
    rotate: Annotated[Triple, "about x, then y, then z, degrees, as in the tool's scenes"]
    scale: Annotated[float, "> 0"]
    velocity: Annotated[Triple, "(x, y, z), m/s"]
    spin: Annotated[Triple, "(x, y, z), degrees a second, about the centre of mass"]


class BodyOptions(MaterialOptions, PoseOptions, total=False):
    """Material and pose."""


GROUPS = {
    DistanceOptions: "distance",
    PseudoVolumeOptions: "pseudo_volume",
    LatticeOptions: "lattice",
    SmoothOptions: "smooth",
    RunOptions: "run",
    SimulationOptions: "simulation",
    MaterialOptions: "material",
    PoseOptions: "pose",
}
ALL_GROUPS = (DistanceOptions, PseudoVolumeOptions, LatticeOptions, SmoothOptions, RunOptions)


def default_options() -> dict[str, Any]:
    """The library's default for every keyword of `tetrahedralize`.

    Example:
        >>> tetsoup.default_options()["rho_min"]
        0.5
    """
    return {**_core.default_options(""), "memory_limit": _core.usable_memory()}


def complete(options: MeshOptions) -> dict[str, Any]:
    """The options as given, with the limit that keeps a run from exhausting the machine."""
    return {"memory_limit": _core.usable_memory(), **options}


def documented(*groups: Any) -> Callable[[Function], Function]:
    """Shows the options of these groups as keywords in `help()` and to completers, with defaults and meaning."""

    def show(function: Function) -> Function:
        signature = inspect.signature(function)
        parameters = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        lines = []
        for group in groups:
            defaults = _core.default_options(GROUPS[group])
            lines += ["", f"    {group.__name__}: {inspect.getdoc(group)}"]
            for name, hint in get_type_hints(group, include_extras=True).items():
                kind, meaning = get_args(hint) if get_origin(hint) is Annotated else (hint, "")
                keyword = inspect.Parameter(
                    name, inspect.Parameter.KEYWORD_ONLY, default=defaults[name], annotation=kind
                )
                parameters.append(keyword)
                default = "" if defaults[name] is None else f" ({defaults[name]!r})"
                lines.append(f"        {name}: {meaning}{default}")
        function.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        function.__doc__ = f"{inspect.getdoc(function)}\n\nOptions:{chr(10).join(lines)}\n"
        return function

    return show
