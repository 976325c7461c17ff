"""What readers that cannot be installed here ask of a file, from their published sources and manuals (docs/FORMATS.md
names them). Each returns points and tets as that reader would see them, or fails."""
import importlib.util
import json

import numpy


def rows(lines, kind=float):
    return numpy.array([line.split() for line in lines], kind)


def read_vtk(path):
    """Bullet: version 3.0, one point a line, lines `4 a b c d` only."""
    lines = path.read_text().splitlines()
    assert lines[0] == "# vtk DataFile Version 3.0" and lines[2] == "ASCII"
    at = next(i for i, line in enumerate(lines) if line.startswith("POINTS"))
    count = int(lines[at].split()[1])
    points = rows(lines[at + 1:at + 1 + count])
    at = next(i for i, line in enumerate(lines) if line.startswith("CELLS"))
    count = int(lines[at].split()[1])
    cells = rows(lines[at + 1:at + 1 + count], int)
    assert (cells[:, 0] == 4).all() and cells.shape[1] == 5
    return points, cells[:, 1:]


def read_inp(path):
    points, cells, mode = [], [], ""
    for line in path.read_text().splitlines():
        if line.startswith("*"):
            mode = line.split(",")[0].upper()
            continue
        if mode == "*NODE":
            assert all(len(word.strip()) <= 20 for word in line.split(","))
            points.append(line.split(",")[1:])
        elif mode == "*ELEMENT":
            cells.append(line.split(","))
    cells = numpy.array(sorted(cells, key=lambda cell: int(cell[0])), int)
    return numpy.array(points, float), cells[:, 1:] - 1


def read_msh22(path):
    lines = path.read_text().splitlines()
    assert lines[0] == "$MeshFormat" and lines[1].split()[:2] == ["2.2", "0"]
    at = lines.index("$Nodes")
    count = int(lines[at + 1])
    nodes = rows(lines[at + 2:at + 2 + count])
    assert lines[at + 2 + count] == "$EndNodes"
    assert (nodes[:, 0] == numpy.arange(1, count + 1)).all()
    at = lines.index("$Elements")
    count = int(lines[at + 1])
    elements = rows(lines[at + 2:at + 2 + count], int)
    assert lines[at + 2 + count] == "$EndElements"
    assert (elements[:, 1] == 4).all()  # tets only
    return lines, nodes[:, 1:], elements[:, 3 + elements[0, 2]:] - 1


def read_libuipc(written):
    """libigl's readMSH: version 2.0 to 2.2."""
    return read_msh22(written.path(".msh"))[1:]


def read_dart(written):
    return read_msh22(written.path(".msh"))[1:]


# Components of SOFA 24.06 that a scene may use: the plugin that has each, and the data that it takes.
SOFA_COMPONENTS = {
    "RequiredPlugin": ("", "pluginName"),
    "DefaultAnimationLoop": ("", ""),
    "EulerImplicitSolver": ("Sofa.Component.ODESolver.Backward", "rayleighStiffness rayleighMass"),
    "SparseLDLSolver": ("Sofa.Component.LinearSolver.Direct", "template"),
    "MeshGmshLoader": ("Sofa.Component.IO.Mesh", "name filename rotation translation"),
    "MeshOBJLoader": ("Sofa.Component.IO.Mesh", "name filename rotation translation"),
    "TetrahedronSetTopologyContainer": ("Sofa.Component.Topology.Container.Dynamic", "src"),
    "TetrahedronSetGeometryAlgorithms": ("Sofa.Component.Topology.Container.Dynamic", "template"),
    "MechanicalObject": ("Sofa.Component.StateContainer", "template"),
    "MeshMatrixMass": ("Sofa.Component.Mass", "totalMass lumping"),
    "TetrahedronFEMForceField": ("Sofa.Component.SolidMechanics.FEM.Elastic", "method youngModulus poissonRatio"),
    "PlaneForceField": ("Sofa.Component.MechanicalLoad", "normal d stiffness damping bilateral"),
    "FixedProjectiveConstraint": ("Sofa.Component.Constraint.Projective", "indices"),
    "OglModel": ("Sofa.GL.Component.Rendering3D", "src"),
    "BarycentricMapping": ("Sofa.Component.Mapping.Linear", ""),
    "IdentityMapping": ("Sofa.Component.Mapping.Linear", "")}


class SofaNode:
    """What runSofa hands to createScene(), keeping what is made of it: objects are (component, data) in their order."""

    def __init__(self):
        self.objects, self.children = [], {}

    def addObject(self, component, **data):
        self.objects.append((component, data))

    def addChild(self, name):
        return self.children.setdefault(name, SofaNode())

    def everything(self):
        return self.objects + [one for child in self.children.values() for one in child.everything()]


def sofa_scene(written):
    """The root that the scene makes: components that exist, with data that they have, of plugins that are asked for."""
    spec = importlib.util.spec_from_file_location("scene", written.path("_sofa.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    root = SofaNode()
    module.createScene(root)
    asked = root.objects[0][1]["pluginName"]
    for component, data in root.everything():
        plugin, known = SOFA_COMPONENTS[component]
        assert not plugin or plugin in asked, component
        assert set(data) <= set(known.split()), component
    return root


def read_sofa(written):
    """MeshGmshLoader: ASCII, $Elements right behind $EndNodes, tets only. In the scene every force has a state before
    it, every state a topology, and what is given per tet or vertex fits their numbers."""
    lines, points, cells = read_msh22(written.path(".msh"))
    assert lines[lines.index("$EndNodes") + 1] == "$Elements"
    (body,) = sofa_scene(written).children.values()
    order = [component for component, _ in body.objects]
    needs = ["MeshGmshLoader", "TetrahedronSetTopologyContainer", "MechanicalObject", "MeshMatrixMass",
             "TetrahedronFEMForceField", "PlaneForceField"]
    assert sorted(needs, key=order.index) == needs
    data = dict(body.objects)
    assert data["MeshGmshLoader"]["filename"] == str(written.path(".msh"))
    assert len(data["TetrahedronFEMForceField"]["youngModulus"]) in (1, len(cells))
    assert 0 <= data["TetrahedronFEMForceField"]["poissonRatio"] < 0.5
    held = data.get("FixedProjectiveConstraint", {}).get("indices", [])
    assert all(0 <= vertex < len(points) for vertex in held)
    assert len(held) == sum(pin["vertex_count"] for pin in written.report["pins"])
    return points, cells


def read_isaacgym(written):
    """Comments, then all `v x y z`, then all `t a b c d` from 0."""
    lines = [line for line in written.path(".tet").read_text().splitlines() if line and line[0] != "#"]
    kinds = "".join(line[0] for line in lines)
    assert set(kinds) == {"v", "t"} and kinds == "".join(sorted(kinds, reverse=True))
    points = rows([line[1:] for line in lines if line[0] == "v"])
    return points, rows([line[1:] for line in lines if line[0] == "t"], int)


def read_vega(written):
    """VolumetricMesh: `n 3 0 0`, numbers from 1, `n 4 0`, at most 1023 characters a line, every tet in a region."""
    text = written.path(".veg").read_text()
    assert max(map(len, text.splitlines())) <= 1023
    lines = [line for line in text.splitlines() if line and line[0] != "#"]
    at = lines.index("*VERTICES")
    count, *tail = map(int, lines[at + 1].split())
    assert tail == [3, 0, 0]
    points = rows(lines[at + 2:at + 2 + count])
    assert (points[:, 0] == numpy.arange(1, count + 1)).all()
    at = lines.index("*ELEMENTS")
    assert lines[at + 1] == "TET"
    count, *tail = map(int, lines[at + 2].split())
    assert tail == [4, 0]
    cells = rows(lines[at + 3:at + 3 + count], int)
    materials = [line.split()[1] for line in lines if line.startswith("*MATERIAL")]
    regions = [lines[i + 1].split(",") for i, line in enumerate(lines) if line.startswith("*REGION")]
    assert regions and all(region[1].strip() in materials for region in regions)
    return points[:, 1:], cells[:, 1:] - 1


def read_json(written):
    """Flat arrays from 0: what Unity's JsonUtility, Godot, Jolt and Three.js can fill buffers with."""
    data = json.loads(written.path(".json").read_text())
    points, cells = numpy.reshape(data["vertices"], (-1, 3)), numpy.reshape(data["tets"], (-1, 4))
    edges = numpy.reshape(data["edges"], (-1, 2))
    pairs = numpy.sort(cells[:, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]].reshape(-1, 2), axis=1)
    assert (numpy.unique(pairs, axis=0) == numpy.unique(numpy.sort(edges, axis=1), axis=0)).all()
    a, b, c = (points[numpy.reshape(data["surface"], (-1, 3))[:, i]] for i in range(3))
    enclosed = numpy.einsum("ij,ij->i", numpy.cross(a, b), c).sum() / 6
    d = [points[cells[:, i]] for i in range(4)]
    volume = numpy.einsum("ij,ij->i", numpy.cross(d[1] - d[0], d[2] - d[0]), d[3] - d[0]).sum() / 6
    assert abs(enclosed / volume - 1) < 1e-6
    return points, cells
