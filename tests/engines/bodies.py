"""The bodies that engines are tried with, and what is measured on them."""
import dataclasses
import pathlib

import numpy


@dataclasses.dataclass(frozen=True)
class Body:
    name: str
    up: str
    metres_per_unit: float = 1.0
    file: str = ""  # in ../shared/models
    sample: str = ""  # or by formula


BODIES = {body.name: body for body in (
    Body("bunny", "y", 0.001, file="bunny-69k.ply"),
    Body("armadillo", "y", file="armadillo-29k.obj"),
    Body("chair", "y", 0.01, file="chair.obj"),
    Body("pr2", "z", file="pr2-robot.obj"),
    Body("bonsai", "y", 0.01, file="bonsai-tree.obj"),
    Body("robot", "z", sample="robot"))}
SIZES = (500, 2000)
CASES = [(name, tets) for name in BODIES for tets in SIZES]


@dataclasses.dataclass
class Written:
    body: Body
    tets: int
    report: dict
    folder: pathlib.Path
    source: pathlib.Path

    def path(self, ending):
        return self.folder / f"{self.body.name}_{self.tets}{ending}"

    @property
    def volume(self):
        return self.report["volume"] * self.body.metres_per_unit**3

    def agrees_with(self, points, tets, sign=1):
        """Numbers of vertices and tets and the total volume are those of the tool's report, no tet is turned over."""
        volumes = sign * volumes_of(points, tets)
        assert len(points) == self.report["vertex_count"]
        assert len(tets) == self.report["tet_count"]
        assert (volumes > 0).all()
        assert abs(volumes.sum() / self.volume - 1) < 1e-5  # single precision


def volumes_of(points, tets):
    a, b, c, d = (numpy.asarray(points, float)[numpy.asarray(tets)[:, i]] for i in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6


def assert_silent(capture):
    """Nothing that sounds like a complaint was printed; what a package says of the machine it is on is let pass."""
    out, err = capture.readouterr()
    for line in (out + err).splitlines():
        if "CUDA" in line or "pybullet build time" in line:
            continue
        assert not any(word in line.lower() for word in ("warn", "error", "fail", "invalid")), line
