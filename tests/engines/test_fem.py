"""Finite elements on our meshes, by scikit-fem: what theory says of any valid mesh holds on them."""
import itertools
import subprocess

import meshio
import numpy
import pytest
from skfem import Basis, ElementTetP1, ElementTetP2, ElementVector, MeshTet, condense, solve
from skfem.helpers import ddot, sym_grad, trace, eye
from skfem import BilinearForm, LinearForm

from conftest import TOOL

YOUNG, POISSON = 1e5, 0.3
LAMBDA = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
MU = YOUNG / (2 * (1 + POISSON))
LENGTH, THICK = 4.0, 1.0


@BilinearForm
def stiffness(u, v, _):
    strain = sym_grad(u)
    return ddot(2 * MU * strain + LAMBDA * eye(trace(strain), 3), sym_grad(v))


@pytest.fixture(scope="module")
def beam(tmp_path_factory):
    folder = tmp_path_factory.mktemp("beam")
    corners = list(itertools.product((0, LENGTH), (0, THICK), (0, THICK)))
    quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    soup = folder / "beam.obj"
    soup.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) +
                    "".join("f " + " ".join(map(str, quad)) + "\n" for quad in quads))

    def mesh(lattice, tets):
        path = folder / f"{lattice}_{tets}.vtk"
        subprocess.run([TOOL, "mesh", soup, "-o", path, "--lattice", lattice, "--tets", str(tets), "--quiet"], check=True)
        data = meshio.read(path)
        return MeshTet(data.points.T.copy(), data.cells_dict["tetra"].T.copy().astype(numpy.int64))

    return mesh


@pytest.mark.parametrize("lattice", ("five", "bcc"))
def test_a_linear_displacement_is_reproduced_to_rounding(beam, lattice):
    basis = Basis(beam(lattice, 500), ElementVector(ElementTetP1()))
    gradient = numpy.array([[0.1, -0.2, 0.3], [0.05, 0.2, 0.1], [-0.1, 0.15, -0.05]])
    exact = numpy.zeros(basis.N)
    exact[basis.nodal_dofs] = gradient @ basis.mesh.p
    found = solve(*condense(stiffness.assemble(basis), x=exact, D=basis.get_dofs()))
    assert abs(found - exact).max() < 1e-12


def deflection(mesh):
    """Of the free end's middle, over beam theory's, with bending and shear, for an end load."""
    low, high = mesh.p[0].min(), mesh.p[0].max()
    # The ends of a smoothed lattice are flat within a small share of a tet.
    near = 0.02 * LENGTH
    basis = Basis(mesh, ElementVector(ElementTetP2()))
    facets = mesh.facets_satisfying(lambda x: x[0] > high - near, boundaries_only=True)
    end = basis.boundary(facets)
    area = end.dx.sum()
    load = LinearForm(lambda v, _: -v[2] / area).assemble(end)
    held = basis.get_dofs(lambda x: x[0] < low + near)
    moved = solve(*condense(stiffness.assemble(basis), load, D=held))
    sides = numpy.ptp(mesh.p, axis=1)
    length, inertia = sides[0], sides[1] * sides[2]**3 / 12
    theory = length**3 / (3 * YOUNG * inertia) + length / (5 / 6 * MU * sides[1] * sides[2])
    return (load @ moved) / theory


@pytest.mark.parametrize("lattice", ("five", "bcc"))
def test_a_cantilever_converges_to_beam_theory(beam, lattice):
    ratios = [deflection(beam(lattice, tets)) for tets in (200, 800, 3000)]
    print(lattice, ratios)
    assert abs(ratios[2] - ratios[1]) < abs(ratios[1] - ratios[0]) + 0.01
    assert abs(ratios[2] - 1) < 0.05
