"""Linear elasticity by scikit-fem on the written meshes."""
import json
import subprocess

import meshio
import numpy
import pytest
from skfem import Basis, ElementTetP1, ElementVector, MeshTet, asm, condense, solve
from skfem.models.elasticity import lame_parameters, linear_elasticity

from conftest import TOOL

YOUNG, POISSON = 1e5, 0.3


def stiffness_of(mesh):
    basis = Basis(mesh, ElementVector(ElementTetP1()))
    return basis, asm(linear_elasticity(*lame_parameters(YOUNG, POISSON)), basis)


@pytest.mark.parametrize("tets", (500, 2000))
@pytest.mark.parametrize("body", ("bunny", "robot"))
def test_a_linear_field_on_the_boundary_is_linear_inside(body, tets, write, prove):
    written = write("paraview", body, tets)
    grid = meshio.read(written.path(".vtu"))
    mesh = MeshTet(numpy.ascontiguousarray(grid.points.T, float), grid.cells_dict["tetra"].T.astype(numpy.int64))
    basis, stiffness = stiffness_of(mesh)
    gradient = numpy.array([[0.1, 0.03, -0.02], [0.05, -0.04, 0.01], [0.02, 0.06, 0.08]])
    exact = numpy.zeros(basis.N)
    exact[basis.nodal_dofs] = gradient @ mesh.p
    inside = numpy.setdiff1d(numpy.arange(mesh.p.shape[1]), numpy.unique(mesh.facets[:, mesh.boundary_facets()]))
    assert len(inside) > 0
    held = numpy.setdiff1d(numpy.arange(basis.N), basis.nodal_dofs[:, inside].ravel())
    found = solve(*condense(stiffness, numpy.zeros(basis.N), x=exact, D=held))
    error = abs(found - exact).max() / abs(exact).max()
    prove("scikit-fem", "patch test", written, inside=len(inside), error=error)
    assert error < 1e-10


LENGTH, WIDTH = 5.0, 1.0
SIZES = (300, 1200, 5000, 20000)


def beam_deflection():
    """Timoshenko's, of the tip for a unit force: bending and shear, the section's shear coefficient being Cowper's."""
    shear_modulus = YOUNG / (2 * (1 + POISSON))
    coefficient = 10 * (1 + POISSON) / (12 + 11 * POISSON)
    return LENGTH**3 / (3 * YOUNG * WIDTH**4 / 12) + LENGTH / (coefficient * shear_modulus * WIDTH**2)


def tip_deflection(folder, lattice, tets):
    """Of a box of the given length, held at x = 0 by the tool's own pins, its other end loaded evenly by 1 N; and the
    number of tets."""
    source = folder / "beam.obj"
    corners = [(x, y, z) for z in (0, WIDTH) for y in (0, WIDTH) for x in (0, LENGTH)]
    quads = ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6")
    source.write_text("".join("v %g %g %g\n" % c for c in corners) + "".join(f"f {q}\n" for q in quads))
    target = folder / f"{lattice}_{tets}.vtu"
    report = folder / f"{lattice}_{tets}.report"
    subprocess.run([TOOL, "mesh", source, "-o", target, "--tets", str(tets), "--lattice", lattice, "--pin-below",
                    f"x:{0.02 * LENGTH}", "--json", report, "--quiet"], check=True)
    grid = meshio.read(target)
    mesh = MeshTet(numpy.ascontiguousarray(grid.points.T, float), grid.cells_dict["tetra"].T.astype(numpy.int64))
    basis, stiffness = stiffness_of(mesh)
    pinned = numpy.flatnonzero(grid.point_data["pin_below"])
    tip = numpy.flatnonzero(mesh.p[0] > 0.98 * LENGTH)
    assert len(pinned) and len(tip)
    force = numpy.zeros(basis.N)
    force[basis.nodal_dofs[2, tip]] = 1 / len(tip)
    moved = solve(*condense(stiffness, force, D=basis.nodal_dofs[:, pinned].ravel()))
    return moved[basis.nodal_dofs[2, tip]].mean(), json.loads(report.read_text())
