"""OpenUSD's own schemas on the files for `--for usd`."""
import numpy
import pytest

from bodies import CASES, volumes_of


def polygons_of(path):
    """Numbers of vertices and polygons, and of their corners, that an OBJ or PLY of triangles holds."""
    if path.suffix == ".obj":
        lines = path.read_text(errors="replace").splitlines()
        faces = [len(line.split()) - 1 for line in lines if line.startswith("f ")]
        return sum(line.startswith("v ") for line in lines), len(faces), sum(faces)
    head = path.read_bytes()[:4096].split(b"end_header")[0].decode().splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in head if line.startswith("element")}
    return counts["vertex"], counts["face"], 3 * counts["face"]


def only(stage, schema):
    found = [schema(prim) for prim in stage.Traverse() if prim.IsA(schema)]
    assert len(found) == 1
    return found[0]


def turned(faces):
    """Triangles from their lowest corner on, sorted: the same for the same oriented set."""
    faces = numpy.asarray(faces)
    first = faces.argmin(axis=1)
    rolled = numpy.stack([faces[numpy.arange(len(faces)), (first + k) % 3] for k in range(3)], axis=1)
    return rolled[numpy.lexsort(rolled.T[::-1])]


@pytest.mark.parametrize("body,tets", CASES)
def test_the_stage_holds_the_tets_and_the_input_that_hangs_on_them(body, tets, write, capfd):
    from pxr import Usd, UsdGeom

    written = write("usd", body, tets)
    capfd.readouterr()
    stage = Usd.Stage.Open(str(written.path(".usda")))
    mesh, render = only(stage, UsdGeom.TetMesh), only(stage, UsdGeom.Mesh)
    assert mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.rightHanded
    points = numpy.array(mesh.GetPointsAttr().Get(), float)
    cells = numpy.array(mesh.GetTetVertexIndicesAttr().Get())
    written.agrees_with(points, cells)
    faces = UsdGeom.TetMesh.ComputeSurfaceFaces(mesh, Usd.TimeCode.Default())
    assert (turned(faces) == turned(mesh.GetSurfaceFaceVertexIndicesAttr().Get())).all()
    inverted = UsdGeom.TetMesh.FindInvertedElements(mesh, Usd.TimeCode.Default())
    assert len(inverted) == 0

    rest = numpy.array(render.GetPointsAttr().Get(), float)
    sizes = render.GetFaceVertexCountsAttr().Get()
    corners = render.GetFaceVertexIndicesAttr().Get()
    assert (len(rest), len(sizes), len(corners)) == polygons_of(written.source)

    primvars = UsdGeom.PrimvarsAPI(render)
    hosts = numpy.array(primvars.GetPrimvar("tetsoup:tet").Get())
    weights = numpy.array(primvars.GetPrimvar("tetsoup:weights").Get(), float)
    moved = numpy.einsum("nk,nkx->nx", weights, points[cells[hosts]])
    # Single precision, of weights and points alike; what is drawn closer on purpose lies elsewhere.
    off = numpy.linalg.norm(moved - rest, axis=1) > 1e-5 * numpy.ptp(rest, axis=0).max()
    assert off.sum() <= written.report["embedding"]["drawn_closer"]
    out, err = capfd.readouterr()
    assert out == "" and err == ""


def test_volumes_are_measured_as_the_schema_orients_them():
    """A right-handed tet of OpenUSD has the volume that this suite calls positive."""
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.TetMesh.Define(stage, "/tet")
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    mesh.CreatePointsAttr(points)
    mesh.CreateTetVertexIndicesAttr([(0, 1, 2, 3)])
    assert volumes_of(points, [(0, 1, 2, 3)])[0] > 0
    assert len(UsdGeom.TetMesh.FindInvertedElements(mesh, Usd.TimeCode.Default())) == 0
