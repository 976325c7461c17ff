"""A tet mesh as the objects of other packages. Each function imports its package when it is called."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tetsoup._surface import as_surface

if TYPE_CHECKING:
    from tetsoup._embedding import Embedding
    from tetsoup._mesh import TetMesh
    from tetsoup._surface import RenderMesh


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


def to_usd(mesh: TetMesh, stage: Any, path: str, surface: Any, embedding: Embedding | None) -> Any:
    from pxr import UsdGeom, Vt

    prim = UsdGeom.TetMesh.Define(stage, path)
    prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.array(mesh.points)))
    prim.CreateTetVertexIndicesAttr(Vt.Vec4iArray.FromNumpy(np.array(mesh.tets)))
    prim.CreateSurfaceFaceVertexIndicesAttr(Vt.Vec3iArray.FromNumpy(np.array(mesh.surface)))
    prim.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.array([mesh.points.min(axis=0), mesh.points.max(axis=0)])))
    if surface is not None:
        drawn = as_surface(surface)
        _add_render_mesh(stage, f"{path}_render", drawn, mesh.embed(drawn) if embedding is None else embedding)
    return prim


def _add_render_mesh(stage: Any, path: str, surface: RenderMesh, embedding: Embedding) -> None:
    """As the library writes it into .usda files."""
    from pxr import Sdf, UsdGeom, Vt

    prim = UsdGeom.Mesh.Define(stage, path)
    prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.array(surface.vertices)))
    prim.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.array(surface.face_sizes)))
    prim.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(surface.corners.astype(np.int32)))
    prim.CreateSubdivisionSchemeAttr("none")
    primvars, types = UsdGeom.PrimvarsAPI(prim), Sdf.ValueTypeNames
    if surface.corner_texcoords.size:
        st = primvars.CreatePrimvar("st", types.TexCoord2fArray, "faceVarying")
        # Corners without a texture coordinate get the last, at zero.
        st.Set(Vt.Vec2fArray.FromNumpy(np.vstack([surface.texcoords, np.zeros((1, 2), np.float32)])))
        last = len(surface.texcoords)
        st.SetIndices(Vt.IntArray.FromNumpy(np.where(surface.corner_texcoords < 0, last, surface.corner_texcoords)))
    tets = primvars.CreatePrimvar("tetsoup:tet", types.IntArray, "vertex")
    tets.Set(Vt.IntArray.FromNumpy(np.array(embedding.tets)))
    weights = primvars.CreatePrimvar("tetsoup:weights", types.Float4Array, "vertex")
    weights.Set(Vt.Vec4fArray.FromNumpy(np.array(embedding.weights)))
