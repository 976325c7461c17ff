"""What an engine's file may say about a mesh besides its tets: materials, regions, pins, the render surface."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict

import numpy as np
import numpy.typing as npt

from tetsoup import _core
from tetsoup._core import InvalidInput
from tetsoup._embedding import Embedding, embed
from tetsoup._soup_input import as_index_list, as_soup
from tetsoup._surface import Part, RenderMesh, as_surface

if TYPE_CHECKING:
    from tetsoup._mesh import TetMesh
    from tetsoup._progress import Progress

PartKind = Literal["object", "group", "material", "part"]
Axis = Literal["x", "y", "z"]


class Material(TypedDict, total=False):
    """Of a region; what is left out is that of the whole body."""

    density: float
    young: float
    poisson: float


class Regions(NamedTuple):
    """Which part of the input every tet belongs to.

    labels: (T,) int32, indices into the names. names: of the regions, "" for what has none.
    """

    labels: npt.NDArray[np.int32]
    names: list[str]


class Body(NamedTuple):
    """The keywords of `TetMesh.save`."""

    name: str
    up: Axis
    density: float | None
    young: float | None
    poisson: float | None
    metres_per_unit: float | None
    regions: tuple[npt.ArrayLike, list[str]] | None
    materials: Mapping[str, Material] | None
    pins: Mapping[str, npt.ArrayLike] | None
    surface: Any
    embedding: Embedding | None
    calibration: _core.Calibration | None = None

    @property
    def material_is_default(self) -> bool:
        own = (self.density, self.young, self.poisson)
        return all(value is None for value in own) and not any((self.materials or {}).values())


def make_model(mesh: TetMesh, body: Body) -> _core.TetModel:
    """The library's model, checked."""
    model = _core.TetModel(mesh._handle, body.name, body.up)
    _add_regions(model, mesh, body)
    for name, vertices in (body.pins or {}).items():
        model.add_pin(name, np.unique(_below(vertices, f"pins[{name!r}]", len(mesh.points))))
    _add_surface(model, mesh, body)
    if body.calibration is not None:
        if len(body.calibration.stiffness_scale) != len(mesh.tets):
            raise InvalidInput(
                f"calibration is of {len(body.calibration.stiffness_scale)} tets, must be of {len(mesh.tets)}: the mesh's"
            )
        model.set_calibration(body.calibration)
    return model


def _add_regions(model: _core.TetModel, mesh: TetMesh, body: Body) -> None:
    names = [body.name]
    if body.regions is not None:
        labels, given = body.regions
        names = [name or body.name for name in given]
        of_tets = _below(labels, "regions", len(names))
        if len(of_tets) != len(mesh.tets):
            raise InvalidInput(f"regions has {len(of_tets)} labels, must have {len(mesh.tets)}, one for every tet")
        model.set_tet_regions(of_tets)
    materials = body.materials or {}
    for name, material in materials.items():
        if name not in names:
            raise InvalidInput(f"materials has {name!r}, must be names of regions: {names}")
        if unknown := set(material) - {"density", "young", "poisson"}:
            raise InvalidInput(f"materials[{name!r}] has {sorted(unknown)}, must be density, young, poisson")
    for name in names:
        own = materials.get(name, {})
        model.add_region(
            name,
            own.get("density", body.density),
            own.get("young", body.young),
            own.get("poisson", body.poisson),
            body.metres_per_unit,
        )


def _add_surface(model: _core.TetModel, mesh: TetMesh, body: Body) -> None:
    surface = None if body.surface is None else as_surface(body.surface)
    embedding = body.embedding
    if surface is not None:
        if embedding is None:
            embedding = embed(mesh, surface)
        if len(embedding) != len(surface.vertices):
            raise InvalidInput(
                f"embedding has {len(embedding)} points, must have {len(surface.vertices)}: the surface's"
            )
        model.set_render(surface._handle)
    if embedding is not None:
        model.set_embedding(embedding._handle)


def _below(values: npt.ArrayLike, name: str, count: int) -> npt.NDArray[np.uint32]:
    indices = as_index_list(values, name)
    if indices.size and int(indices.max()) >= count:
        raise InvalidInput(f"{name} has the index {indices.max()}, must be below {count}")
    return indices


def regions(mesh: TetMesh, surface: Any, by: PartKind, progress: Progress | None) -> Regions:
    if by not in (*Part._fields, "part"):
        raise InvalidInput(f"by = {by!r}, must be one of 'object', 'group', 'material', 'part'")
    source = as_surface(surface)
    if by == "part":
        parts = np.asarray(_core.label_parts(*as_soup(source)), np.uint32)
        of_tets = _core.label_tets(mesh._handle, *as_soup(source), parts, progress)
        found, places = np.unique(of_tets, return_inverse=True)  # of thousands of loose leaves most have no tet
        return Regions(places.astype(np.int32), [f"part_{part + 1}" for part in found])
    of_parts = [getattr(part, by) for part in source.parts] or [""]
    names = sorted(dict.fromkeys(of_parts), key=lambda name: not name)  # in the order of the file, the nameless last
    labels = _label_triangles(source, [names.index(name) for name in of_parts])
    return Regions(_core.label_tets(mesh._handle, *as_soup(source), labels, progress), names)


def vertices_near(mesh: TetMesh, surface: Any, name: str, progress: Progress | None) -> npt.NDArray[np.int32]:
    source = as_surface(surface)
    if any(name in part for part in source.parts):
        others = _label_triangles(source, [int(name not in part) for part in source.parts])
    else:
        others = _other_parts(source, name)
    labels = _core.label_vertices(mesh._handle, *as_soup(source), others, progress)
    return np.flatnonzero(labels == 0).astype(np.int32)


def _other_parts(source: RenderMesh, name: str) -> npt.NDArray[np.uint32]:
    """0 for the triangles of a connected part, 1 for all others."""
    parts = _core.label_parts(*as_soup(source))
    count = int(parts.max(initial=-1)) + 1
    names = [f"part_{part + 1}" for part in range(count)]
    if name not in names:
        known = sorted({word for part in source.parts for word in part if word})
        raise InvalidInput(
            f"name = {name!r}, must be of an object, a group or a material: {known}, or of a connected part: "
            f"'part_1' to 'part_{count}'"
        )
    return np.asarray(parts != names.index(name), np.uint32)


def _label_triangles(source: RenderMesh, of_parts: list[int]) -> npt.NDArray[np.uint32]:
    """A label for every triangle from one for every part."""
    faces = source.triangle_faces
    if not source.face_parts.size:
        return np.zeros(len(faces), np.uint32)
    return np.array(of_parts, np.uint32)[source.face_parts[faces]]
