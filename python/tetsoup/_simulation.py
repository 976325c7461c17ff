"""Bodies made of tets fall, bend, collide and come to rest."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from tetsoup import _core
from tetsoup._core import InvalidInput
from tetsoup._mesh import TetMesh
from tetsoup._simulation_input import (
    as_index,
    as_number,
    as_number_or_none,
    as_radians,
    as_rows,
    as_whole,
    body_number,
    body_vertex,
    body_vertices,
    handle_of,
)
from tetsoup._soup_input import as_points, as_soup, as_triple
from tetsoup.options import (
    BodyOptions,
    MaterialOptions,
    PoseOptions,
    SimulationOptions,
    Triple,
    documented,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from tetsoup._progress import Progress


class Simulation:
    """Deformable bodies, obstacles, and time. Metres, kilograms, seconds; gravity along -z.

    The same bits for any number of threads, on every instruction set, and as from the C++ library: `state_hash` tells.

    Raises:
        tetsoup.InvalidInput: if an option is out of range.

    Example:
        >>> simulation = tetsoup.Simulation(substeps=20)
        >>> simulation.add_plane()
        >>> body = simulation.add_body(mesh, translate=(0, 0, 2), young=3e5)
        >>> positions = simulation.positions(body)  # a view: every step moves it
        >>> surface = mesh.embed("bunny.obj")
        >>> for frame in range(120):
        ...     simulation.step(1 / 60)
        ...     draw(surface.deform(positions))

    One thread at a time: RuntimeError where another one calls during a step. Different simulations run in parallel.
    Ctrl-C is noticed between steps.
    """

    @documented(SimulationOptions)
    def __init__(self, **options: Unpack[SimulationOptions]) -> None:
        """An empty world."""
        self._lock = threading.Lock()
        self._core = _core.Simulation(dict(options))

    @contextmanager
    def _alone(self) -> Iterator[_core.Simulation]:
        if not self._lock.acquire(blocking=False):
            raise RuntimeError("this Simulation is at work; wait until it is done, or take another one")
        try:
            yield self._core
        finally:
            self._lock.release()

    @documented(MaterialOptions, PoseOptions)
    def add_body(self, mesh: TetMesh, **options: Unpack[BodyOptions]) -> int:
        """Adds a body.

        Args:
            mesh: at rest. Tets that cannot be simulated are left out and counted in `report`.

        Returns:
            The body's number: 0, 1, 2, ...

        Raises:
            tetsoup.InvalidInput: if an option is out of range, or a vertex would lie beyond 1e5 m.

        Example:
            >>> simulation.add_body(mesh, metres_per_unit=0.001, density=500, rotate=(90, 0, 0), velocity=(0, 1, 0))
            0
        """
        pose = {key: value for key, value in options.items() if key in PoseOptions.__annotations__}
        material = {key: value for key, value in options.items() if key not in pose}
        for angles in {"rotate", "spin"} & pose.keys():
            pose[angles] = as_radians(pose[angles], angles)
        with self._alone() as core:
            return core.add_bodies(handle_of(mesh), material, [pose])

    @documented(MaterialOptions)
    def add_bodies(
        self,
        mesh: TetMesh,
        translate: npt.ArrayLike,
        *,
        rotate: npt.ArrayLike = (0, 0, 0),
        scale: npt.ArrayLike = 1,
        velocity: npt.ArrayLike = (0, 0, 0),
        spin: npt.ArrayLike = (0, 0, 0),
        **material: Unpack[MaterialOptions],
    ) -> range:
        """Adds N bodies of one make, which share what they are made of and are faster for it.

        Args:
            mesh: at rest.
            translate: (N, 3), m.
            rotate: (N, 3), or one (3,) for all, degrees about x, then y, then z.
            scale: (N,), or one for all.
            velocity, spin: (N, 3), or one (3,) for all, m/s and degrees a second.

        Returns:
            Their numbers.

        Raises:
            tetsoup.InvalidInput: if a shape does not fit, or a number is out of range; no body is added then.

        Example:
            >>> simulation.add_bodies(mesh, [(0, 0, 1 + 2 * i) for i in range(10)], young=1e6)
            range(0, 10)
        """
        count = len(as_points(translate, "translate"))
        rows = {
            "translate": np.asarray(translate, np.float64).reshape(count, 3),
            "rotate": np.radians(as_rows(rotate, "rotate", (count, 3))),
            "scale": as_rows(scale, "scale", (count,)),
            "velocity": as_rows(velocity, "velocity", (count, 3)),
            "spin": np.radians(as_rows(spin, "spin", (count, 3))),
        }
        poses = [{name: values[i].tolist() for name, values in rows.items()} for i in range(count)]
        with self._alone() as core:
            first = core.add_bodies(handle_of(mesh), dict(material), poses)
        return range(first, first + count)

    def add_plane(self, normal: Triple = (0, 0, 1), offset: float = 0, friction: float | None = None) -> None:
        """Keeps bodies where dot(normal, p) >= offset.

        Args:
            normal: of any length.
            offset: m, times that length.
            friction: Coulomb's coefficient (0.5).

        Raises:
            tetsoup.InvalidInput: if a number is out of range.

        Example:
            >>> simulation.add_plane((0, 0, 1), -0.5)
        """
        towards, distance = as_triple(normal, "normal"), as_number(offset, "offset")
        with self._alone() as core:
            core.add_plane(towards, distance, as_number_or_none(friction, "friction"))

    def add_obstacle(
        self,
        vertices: Any,
        faces: Any = None,
        *,
        voxels: int | None = None,
        friction: float | None = None,
        progress: Progress | None = None,
    ) -> None:
        """Keeps bodies out of what any triangle soup intuitively occupies.

        Args:
            vertices, faces: as `tetrahedralize` takes, in metres: (N, 3) and (F, 3), or one object or file.
            voxels: along the longest axis of its signed distance (64).
            friction: Coulomb's coefficient (0.5).

        Raises:
            tetsoup.InvalidInput: if there is no finite triangle, or a number is out of range.
            tetsoup.IoError: if a file cannot be read.
            tetsoup.Cancelled: if `progress` answers False.

        Example:
            >>> simulation.add_obstacle("tree.obj", voxels=128)
        """
        soup = as_soup(vertices, faces)
        size = None if voxels is None else as_whole(voxels, "voxels")
        with self._alone() as core:
            core.add_obstacle(*soup, size, as_number_or_none(friction, "friction"), progress)

    def pin(self, body: int, vertices: npt.ArrayLike) -> None:
        """Holds vertices where they are.

        Args:
            body: its number.
            vertices: one index, or (n,), of the mesh's vertices; see `TetMesh.vertices_below` and its neighbours.

        Raises:
            tetsoup.InvalidInput: if there is no such body or vertex.

        Example:
            >>> simulation.pin(body, mesh.vertices_below(0.01))
        """
        with self._alone() as core:
            core.pin(*body_vertices(core, body, vertices))

    def unpin(self, body: int, vertices: npt.ArrayLike) -> None:
        """Lets go of what `pin` holds. Example: ``simulation.unpin(body, vertices)``."""
        with self._alone() as core:
            core.unpin(*body_vertices(core, body, vertices))

    def attach(self, body: int, vertex: int, other_body: int, other_vertex: int) -> None:
        """Makes two vertices one, as far as they can move.

        Raises:
            tetsoup.InvalidInput: if there is no such body or vertex.

        Example:
            >>> simulation.attach(0, 17, 1, 4)
        """
        with self._alone() as core:
            core.attach(*body_vertex(core, body, vertex), *body_vertex(core, other_body, other_vertex))

    def add_spring(self, body: int, vertex: int, target: Triple, stiffness: float) -> int:
        """Pulls a vertex to a point: what a mouse does.

        Args:
            target: (x, y, z), m.
            stiffness: N/m, > 0.

        Returns:
            The spring's number, for `move_spring` and `remove_spring`.

        Raises:
            tetsoup.InvalidInput: if there is no such body or vertex, or a number is out of range.

        Example:
            >>> spring = simulation.add_spring(body, 17, (0, 0, 2), stiffness=500)
        """
        point, strength = as_triple(target, "target"), as_number(stiffness, "stiffness")
        with self._alone() as core:
            return core.add_spring(*body_vertex(core, body, vertex), point, strength)

    def move_spring(self, spring: int, target: Triple) -> None:
        """Pulls elsewhere, m. Example: ``simulation.move_spring(spring, (0, 1, 2))``."""
        point = as_triple(target, "target")
        with self._alone() as core:
            core.move_spring(as_index(spring, "spring"), point)

    def remove_spring(self, spring: int) -> None:
        """Pulls no more. Example: ``simulation.remove_spring(spring)``."""
        with self._alone() as core:
            core.remove_spring(as_index(spring, "spring"))

    def step(self, dt: float) -> None:
        """Advances time by `dt` seconds, (0, 1]. The interpreter's lock is released.

        Raises:
            tetsoup.InvalidInput: if `dt` is out of range.
            KeyboardInterrupt: on Ctrl-C. Bodies and time then are where the last whole substep has left them, and the
                simulation can go on from there.

        Example:
            >>> simulation.step(1 / 60)
        """
        seconds = as_number(dt, "dt")
        with self._alone() as core:
            core.step(seconds)

    def positions(self, body: int) -> npt.NDArray[np.float32]:
        """Where the body's vertices are, (P, 3) float32, m, in the order of its mesh.

        The simulation's own memory: read-only, not copied, moved by every step, and there as long as you hold it.

        Example:
            >>> simulation.positions(0).mean(axis=0)
        """
        with self._alone() as core:
            return core.positions(body_number(core, body))

    def velocities(self, body: int) -> npt.NDArray[np.float32]:
        """How the body's vertices move, (P, 3) float32, m/s: a view as `positions` is. Half a substep ago."""
        with self._alone() as core:
            return core.velocities(body_number(core, body))

    def set_positions(self, body: int, positions: npt.ArrayLike) -> None:
        """Puts the body's vertices elsewhere; pinned ones too.

        Args:
            positions: (P, 3), m.

        Raises:
            tetsoup.InvalidInput: if there are not as many as vertices, or one is not finite or beyond 1e5 m.

        Example:
            >>> simulation.set_positions(body, simulation.positions(body) * (1, 1, 0))  # squeezed flat
        """
        rows = as_points(positions, "positions")
        with self._alone() as core:
            core.set_positions(body_number(core, body), rows)

    def set_velocities(self, body: int, velocities: npt.ArrayLike) -> None:
        """Sets how the body's vertices move, (P, 3), m/s; at most 1e4. Raises as `set_positions` does."""
        rows = as_points(velocities, "velocities")
        with self._alone() as core:
            core.set_velocities(body_number(core, body), rows)

    @property
    def body_count(self) -> int:
        """Bodies so far."""
        with self._alone() as core:
            return core.body_count()

    @property
    def time(self) -> float:
        """s, since the start."""
        with self._alone() as core:
            return core.time()

    @property
    def report(self) -> _core.SimulationReport:
        """What is simulated, what was left out, and what the last step did."""
        with self._alone() as core:
            return core.report()

    @property
    def energy(self) -> _core.Energy:
        """Kinetic, elastic, of gravity, and the total, J, of all bodies."""
        with self._alone() as core:
            return core.energy()

    def momentum(self, body: int | None = None) -> _core.Momentum:
        """Linear (kg m/s) and angular (kg m^2/s, about the origin), of one body or all."""
        with self._alone() as core:
            return core.momentum() if body is None else core.momentum_of(body_number(core, body))

    def volume(self, body: int) -> float:
        """m^3, signed, of the body's tets as they are now."""
        with self._alone() as core:
            return core.volume(body_number(core, body))

    @property
    def state_hash(self) -> int:
        """Of all positions and velocities, to the bit: 64 bits."""
        with self._alone() as core:
            return core.state_hash()

    def save_state(self) -> bytes:
        """All that steps have changed, for `restore_state`. Example: ``path.write_bytes(simulation.save_state())``."""
        with self._alone() as core:
            return core.save_state()

    def restore_state(self, state: bytes) -> None:
        """Goes on, to the bit, where a simulation stood that had been built in the same way.

        Raises:
            tetsoup.InvalidInput: if the bytes are damaged, or of what was built otherwise; nothing changes then.

        Example:
            >>> simulation.restore_state(path.read_bytes())
        """
        if not isinstance(state, (bytes, bytearray, memoryview)):
            raise InvalidInput(f"state is of the type {type(state).__name__}, must be bytes")
        with self._alone() as core:
            core.restore_state(bytes(state))

    def __repr__(self) -> str:
        return f"<tetsoup.Simulation: {self.body_count:,} bodies, {self.report.tet_count:,} tets, {self.time:.4g} s>"
