"""Pictures of docs/ENGINES.md: a body at the start and a second later, in each engine's own run."""
import numpy
import pyvista
from PIL import Image


def draw(path, start, end, cells):
    plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), border=False, window_size=(720, 360))
    height = numpy.ptp(start[:, 2])
    middle = (start.min(axis=0) + start.max(axis=0)) / 2
    size = max(numpy.ptp(points, axis=0).max() for points in (start, end))
    for side, points in enumerate((start, end)):
        plotter.subplot(0, side)
        grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: cells}, points)
        plotter.add_mesh(pyvista.Plane(center=(middle[0], middle[1], -0.01 * height), i_size=30 * height,
                                       j_size=30 * height), color="#eef0f4", lighting=False)
        plotter.add_mesh(grid, color="#5b8fd0", show_edges=True, edge_color="#274b7a", line_width=1)
        plotter.camera_position = [(middle[0] + 1.4 * size, middle[1] - 2.4 * size, 1.2 * size),
                                   (middle[0], middle[1], 0.4 * height), (0, 0, 1)]
        plotter.set_background("white")
    image = plotter.screenshot(return_img=True)
    plotter.close()
    Image.fromarray(image).quantize(64).save(path, optimize=True)
