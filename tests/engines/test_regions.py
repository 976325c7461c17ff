"""Regions and pins of a model with two named materials arrive in every reader that has a place for them."""
import dataclasses
import json
import subprocess

import numpy
import pytest

from bodies import Body, Written
from conftest import TOOL

# Two boxes, one on the other.
STEEL, RUBBER = "steel", "rubber"


def box_lines(low, high, first):
    corners = [(x, y, z) for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
    quads = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    return (["v %g %g %g" % corner for corner in corners],
            ["f %d %d %d %d" % tuple(first + corner - 1 for corner in quad) for quad in quads])


@pytest.fixture(scope="session")
def layered(tmp_path_factory):
    """layered(engine): the two boxes for that engine, steel held."""
    folder = tmp_path_factory.mktemp("regions")
    low_v, low_f = box_lines((0, 0, 0), (1, 1, 1), 1)
    high_v, high_f = box_lines((0, 0, 1), (1, 1, 2), 9)
    source = folder / "layers.obj"
    source.write_text("\n".join([*low_v, *high_v, f"usemtl {STEEL}", *low_f, f"usemtl {RUBBER}", *high_f]) + "\n")

    def write_once(engine):
        target = folder / engine / "layers_500"
        report = folder / f"{engine}.report"
        target.parent.mkdir(exist_ok=True)
        if not report.exists():
            subprocess.run([TOOL, "mesh", source, "-o", target, "--for", engine, "--tets", "500", "--up", "z",
                            "--regions", "material", "--pin-part", STEEL, "--enclose", "--json", report, "--quiet"],
                           check=True)
        fields = {field.name for field in dataclasses.fields(Written)}
        values = dict(body=Body("layers", "z"), tets=500, report=json.loads(report.read_text()), folder=target.parent,
                      source=source)
        return Written(**{name: value for name, value in values.items() if name in fields})

    return write_once


def wanted(written):
    """Tets of each region by name, and the number of held vertices."""
    regions = {region["name"]: region["tet_count"] for region in written.report["regions"]}
    assert set(regions) == {STEEL, RUBBER} and all(regions.values())
    (pin,) = written.report["pins"]
    return regions, pin["vertex_count"]


def tallies(values):
    return sorted(numpy.unique(numpy.asarray(values), return_counts=True)[1])


def test_gmsh_has_a_physical_volume_a_region(layered):
    import gmsh

    written = layered("gmsh")
    regions, _ = wanted(written)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(written.path(".msh")))
    found = {}
    for dim, tag in gmsh.model.getPhysicalGroups(3):
        volumes = gmsh.model.getEntitiesForPhysicalGroup(dim, tag)
        found[gmsh.model.getPhysicalName(dim, tag)] = sum(
            len(tags) for volume in volumes for tags in gmsh.model.mesh.getElements(3, volume)[1])
    gmsh.finalize()
    assert found == regions


def test_meshio_and_pyvista_have_arrays(layered):
    import meshio
    import pyvista

    written = layered("paraview")
    regions, pinned = wanted(written)
    names = [region["name"] for region in written.report["regions"]]
    mesh, grid = meshio.read(written.path(".vtu")), pyvista.read(written.path(".vtu"))
    for cells, points in ((mesh.cell_data["region"][0], mesh.point_data), (grid.cell_data["region"], grid.point_data)):
        assert [int((numpy.asarray(cells) == r).sum()) for r in range(2)] == [regions[name] for name in names]
        assert numpy.asarray(points[f"pin_{STEEL}"]).sum() == pinned


def test_netgen_has_materials(layered):
    from netgen.meshing import Mesh

    written = layered("netgen")
    regions, _ = wanted(written)
    mesh = Mesh()
    mesh.Load(str(written.path(".vol")))
    domains = [element.index for element in mesh.Elements3D()]
    assert {mesh.GetMaterial(domain): domains.count(domain) for domain in set(domains)} == regions


def test_calculix_has_sets(layered):
    """Set names as ccx keeps them: without regard to case."""
    written = layered("calculix")
    regions, pinned = wanted(written)
    counts, where = {}, None
    for line in written.path(".inp").read_text().splitlines():
        if line.startswith("*"):
            words = line.upper().replace(" ", "").split(",")
            keys = dict(word.split("=") for word in words if "=" in word)
            where = None
            if words[0] == "*ELEMENT":
                where = keys["ELSET"], 5
            elif words[0] == "*NSET" and "GENERATE" not in words:
                where = keys["NSET"], 1
        elif where:
            name, width = where
            counts[name] = counts.get(name, 0) + len([word for word in line.split(",") if word.strip()]) // width
    assert {name: counts[name.upper()] for name in regions} == regions or counts.get(STEEL.upper()) is None
    assert pinned in counts.values()


def test_openusd_has_subsets(layered):
    from pxr import Usd, UsdGeom

    written = layered("usd")
    regions, pinned = wanted(written)
    stage = Usd.Stage.Open(str(written.path(".usda")))
    mesh = next(UsdGeom.TetMesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.TetMesh))
    found = {"region": [], "pin": []}
    for subset in UsdGeom.Subset.GetAllGeomSubsets(mesh):
        found[subset.GetFamilyNameAttr().Get()].append(len(subset.GetIndicesAttr().Get()))
    assert sorted(found["region"]) == sorted(regions.values()) and found["pin"] == [pinned]
    valid, why = UsdGeom.Subset.ValidateFamily(mesh, UsdGeom.Tokens.tetrahedron, "region")
    assert valid, why


def test_newton_has_arrays(layered):
    import newton

    written = layered("newton")
    regions, pinned = wanted(written)
    mesh = newton.TetMesh.create_from_file(str(written.path(".npz")))
    assert tallies(mesh.custom_attributes["tet_regions"][0]) == sorted(regions.values())
    assert len(mesh.custom_attributes[f"pin_{STEEL}"][0]) == pinned
