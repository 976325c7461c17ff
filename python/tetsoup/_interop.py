"""A tet mesh as the objects of other packages. Each function imports its package when it is called."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from tetsoup._mesh import TetMesh


def to_meshio(mesh: TetMesh) -> Any:
    import meshio

    return meshio.Mesh(mesh.points, [("tetra", mesh.tets)])


def to_pyvista(mesh: TetMesh) -> Any:
    import pyvista

    return pyvista.UnstructuredGrid({pyvista.CellType.TETRA: mesh.tets}, mesh.points)


def to_trimesh(mesh: TetMesh) -> Any:
    import trimesh

    used, faces = np.unique(mesh.surface, return_inverse=True)
    return trimesh.Trimesh(mesh.points[used], faces.reshape(-1, 3), process=False)


def to_polyscope(mesh: TetMesh, name: str) -> Any:
    import polyscope

    return polyscope.register_volume_mesh(name, mesh.points, tets=mesh.tets)


def to_usd(mesh: TetMesh, stage: Any, path: str) -> Any:
    from pxr import UsdGeom, Vt

    prim = UsdGeom.TetMesh.Define(stage, path)
    prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.array(mesh.points)))
    prim.CreateTetVertexIndicesAttr(Vt.Vec4iArray.FromNumpy(np.array(mesh.tets)))
    prim.CreateSurfaceFaceVertexIndicesAttr(Vt.Vec3iArray.FromNumpy(np.array(mesh.surface)))
    prim.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.array([mesh.points.min(axis=0), mesh.points.max(axis=0)])))
    return prim
