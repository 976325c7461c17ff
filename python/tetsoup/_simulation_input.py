"""What a simulation's caller gave, as the extension takes it; InvalidInput says what does not fit."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
import numpy.typing as npt

from tetsoup import _core
from tetsoup._core import InvalidInput
from tetsoup._mesh import TetMesh
from tetsoup._soup_input import as_index_list, as_triple


def handle_of(mesh: TetMesh) -> _core.TetMesh:
    if not isinstance(mesh, TetMesh):
        raise InvalidInput(f"mesh is of the type {type(mesh).__name__}, must be a TetMesh")
    return mesh._handle


def as_number(value: Any, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidInput(f"{name} = {value!r}, must be a number") from error


def as_number_or_none(value: Any, name: str) -> float | None:
    return None if value is None else as_number(value, name)


def as_whole(value: Any, name: str) -> int:
    try:
        number = operator.index(value)
    except TypeError as error:
        raise InvalidInput(f"{name} = {value!r}, must be a whole number") from error
    if abs(number) >= 2**31:
        raise InvalidInput(f"{name} = {value!r}, must be below 2^31")
    return number


def as_index(value: Any, name: str) -> int:
    number = as_whole(value, name)
    if number < 0:
        raise InvalidInput(f"{name} = {value!r}, must be at least 0")
    return number


def body_number(core: _core.Simulation, body: Any) -> int:
    number, count = as_index(body, "body"), core.body_count()
    if number >= count:
        raise InvalidInput(f"body = {number}, must be the number of a body, and there are {count}")
    return number


def body_vertex(core: _core.Simulation, body: Any, vertex: Any) -> tuple[int, int]:
    return body_number(core, body), as_index(vertex, "vertex")


def body_vertices(core: _core.Simulation, body: Any, vertices: npt.ArrayLike) -> tuple[int, npt.NDArray[np.uint32]]:
    number, indices = body_number(core, body), as_index_list(np.atleast_1d(vertices), "vertices")
    count = len(core.positions(number))
    if indices.size and int(indices.max()) >= count:
        raise InvalidInput(f"vertices has the index {indices.max()}, must be below {count}")
    return number, indices


def as_radians(degrees: Any, name: str) -> tuple[float, float, float]:
    x, y, z = as_triple(degrees, name)
    return math.radians(x), math.radians(y), math.radians(z)


def as_rows(values: npt.ArrayLike, name: str, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    try:
        return np.array(np.broadcast_to(np.asarray(values, np.float64), shape))
    except (TypeError, ValueError) as error:
        wanted = " or ".join(str(end) for end in (shape, shape[1:]))
        raise InvalidInput(f"{name} has the shape {np.shape(values)}, must be {wanted}") from error
