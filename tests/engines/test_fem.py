"""Finite elements on our meshes, by scikit-fem: what theory says of any valid mesh holds on them."""
import itertools
import subprocess

import meshio
import numpy
import pytest
from skfem import Basis, ElementTetP1, ElementTetP2, ElementVector, MeshTet, condense, solve
from skfem.helpers import ddot, sym_grad, trace, eye
from skfem import BilinearForm, LinearForm

from bodies import SIZES
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
        options = ["--lattice", lattice, "--tets", str(tets), "--quiet"]
        subprocess.run([TOOL, "mesh", soup, "-o", path, *options], check=True)
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


@pytest.mark.parametrize("tets", SIZES)
@pytest.mark.parametrize("body", ("bunny", "robot"))
def test_a_linear_displacement_of_the_boundary_is_linear_within_a_body(body, tets, write):
    written = write("paraview", body, tets)
    data = meshio.read(written.path(".vtu"))
    mesh = MeshTet(numpy.ascontiguousarray(data.points.T, float), data.cells_dict["tetra"].T.astype(numpy.int64))
    basis = Basis(mesh, ElementVector(ElementTetP1()))
    exact = numpy.zeros(basis.N)
    exact[basis.nodal_dofs] = numpy.array([[0.1, -0.2, 0.3], [0.05, 0.2, 0.1], [-0.1, 0.15, -0.05]]) @ mesh.p
    held = basis.get_dofs()
    assert len(held.all()) < basis.N  # There are vertices inside.
    found = solve(*condense(stiffness.assemble(basis), x=exact, D=held))
    assert abs(found - exact).max() < 1e-12 * abs(exact).max()


def deflection(mesh, element):
    """Of the free end under the beam's own weight, over beam theory's with bending and shear. Smoothing rounds the
    edges of a box, so the section is taken as the mesh has it, in the mean."""
    basis = Basis(mesh, ElementVector(element))
    sections = Basis(mesh, element)
    low, high = mesh.p[0].min(), mesh.p[0].max()
    near = 0.02 * LENGTH  # The ends are flat within that.
    _, _, z = sections.global_coordinates()
    area = sections.dx.sum() / (high - low)
    inertia = ((z - THICK / 2) ** 2 * sections.dx).sum() / (high - low)
    free = high - low - near
    load = LinearForm(lambda v, _: -v[2]).assemble(basis)
    moved = solve(*condense(stiffness.assemble(basis), load, D=basis.get_dofs(lambda x: x[0] < low + near)))
    tip = basis.get_dofs(lambda x: x[0] > high - near)
    found = -moved[tip.all("u^3")].mean()
    return found / (area * free**4 / (8 * YOUNG * inertia) + free**2 / (2 * 5 / 6 * MU))


def facets_on(mesh, triangles):
    """Boundary facets of a refined mesh that are parts of these triangles (M, corner, xyz) of the coarse one."""
    facets = mesh.boundary_facets()
    middles = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    found = numpy.zeros(len(facets), bool)
    for a, b, c in triangles:
        along = numpy.linalg.solve(numpy.stack([b - a, c - a, numpy.cross(b - a, c - a)], axis=1), middles - a[:, None])
        found |= (abs(along[2]) < 1e-6) & (along[0] > 0) & (along[1] > 0) & (along[0] + along[1] < 1)
    return facets[found]


def work_of(mesh, element, held):
    """What the beam's weight does while it sags, held at the same triangles however fine the mesh is. Of all measures
    of the deflection this is the one that grows with every refinement, whatever the shape (Galerkin orthogonality)."""
    basis = Basis(mesh, ElementVector(element))
    load = LinearForm(lambda v, _: -v[2]).assemble(basis)
    return load @ solve(*condense(stiffness.assemble(basis), load, D=basis.get_dofs(facets_on(mesh, held))))


@pytest.mark.parametrize("lattice", ("five", "bcc"))
def test_a_cantilever_converges_from_below(beam, lattice):
    mesh = beam(lattice, 300)
    end = mesh.facets_satisfying(lambda x: x[0] < mesh.p[0].min() + 0.02 * LENGTH, boundaries_only=True)
    held = mesh.p[:, mesh.facets[:, end]].transpose(2, 1, 0)
    finest = work_of(mesh.refined(1), ElementTetP2(), held)
    errors = [1 - work_of(mesh.refined(times), ElementTetP1(), held) / finest for times in range(3)]
    # Half the size: a quarter of the error where the solution is smooth, half of it next to the edges of the held end.
    # Measured: 0.36, 0.19, 0.08 for five tets a cube, 0.34, 0.15, 0.05 for bcc.
    assert 0 < errors[2] < 0.6 * errors[1] < 0.36 * errors[0], errors


@pytest.mark.parametrize("lattice", ("five", "bcc"))
def test_a_cantilever_bends_as_beam_theory_has_it(beam, lattice):
    # A beam four times as long as thick, held so that its end cannot shrink either, is a little stiffer than theory's.
    assert abs(deflection(beam(lattice, 4800), ElementTetP2()) - 1) < 0.1
