"""A soup becomes a mesh, the soup hangs on the mesh, the mesh bends, and the soup with it.

Here a formula bends; in a game or a film it is the simulation of the tets.

usage: embed_and_deform.py [SOUP.obj] [BENT.obj] [PICTURE.png]      the picture needs matplotlib
"""

import sys

import numpy as np
import tetsoup


def main(soup_path="", bent_path="bent.obj", picture="bent.png"):
    soup = tetsoup.read_surface(soup_path) if soup_path else sample_surface()
    mesh = tetsoup.tetrahedralize(soup, tets=2000, cover="enclose")
    embedding = mesh.embed(soup)
    print(f"{embedding.report.inside:,} of {len(embedding):,} vertices lie in {len(mesh.tets):,} tets")
    bent = soup.with_vertices(embedding.deform(bend(mesh.points)))
    bent.save(bent_path)
    error = np.linalg.norm(bent.vertices - bend(soup.vertices), axis=1).max() / np.ptp(soup.vertices, axis=0).max()
    print(f"bent in {bent_path}, at most {100 * error:.2f} % of its size from the exact map")
    draw([soup, bent], picture)


def sample_surface():
    vertices, faces = tetsoup.sample("tree")
    return tetsoup.RenderMesh(vertices, np.full(len(faces), 3), faces.ravel())


def bend(points):
    """Along the longest axis into a quarter of a circle."""
    low, high = points.min(axis=0), points.max(axis=0)
    along, across = np.argsort(low - high)[:2]
    radius = (high - low)[along] / (np.pi / 2)
    angle = (points[:, along] - low[along]) / radius
    bent = points.astype(np.float64)
    bent[:, along] = low[along] + (radius + points[:, across]) * np.sin(angle)
    bent[:, across] = (radius + points[:, across]) * np.cos(angle) - radius
    return bent


def draw(surfaces, picture):
    try:
        from matplotlib.figure import Figure
    except ImportError:
        return print("no picture: matplotlib is not installed")
    figure = Figure(figsize=(10, 5))
    for place, surface in enumerate(surfaces, 1):
        axis = figure.add_subplot(1, 2, place, projection="3d", proj_type="ortho")
        axis.plot_trisurf(*surface.vertices.T, triangles=surface.triangles, linewidth=0)
        axis.set_aspect("equal")
    figure.savefig(picture)
    print("drawn in", picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
