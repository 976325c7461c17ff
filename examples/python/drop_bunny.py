"""A soup becomes tets that fall on the ground, and the soup with them, into a GIF. Needs pyvista and Pillow.

usage: drop_bunny.py [SOUP] [PICTURE.gif] [FRAMES]      its y is up; without arguments: the sample "heart" """

import sys

import pyvista
import tetsoup
from PIL import Image

path, picture, frames = sys.argv[1:] + ["", "drop.gif", "60"][len(sys.argv) - 1 :]
soup = tetsoup.read(path) if path else tetsoup.sample("heart")
mesh = tetsoup.tetrahedralize(soup, tets=1500)
simulation = tetsoup.Simulation(substeps=20)
simulation.add_plane()
scale = 0.15 / mesh.quality.volume ** (1 / 3)  # a bunny is then 0.3 m long
body = simulation.add_body(mesh, young=3e4, scale=scale, rotate=(60, 0, 0), translate=(0, 0, 0.3))
surface, positions = mesh.embed(soup), simulation.positions(body)  # the latter a view: every step moves it
drawn = pyvista.PolyData.from_regular_faces(surface.deform(positions), soup.faces)
plotter, images = pyvista.Plotter(off_screen=True, window_size=(400, 400)), []
plotter.add_mesh(pyvista.Plane(i_size=3, j_size=3), color="tan")
plotter.add_mesh(drawn, color="lightsteelblue")
plotter.camera_position = [(0.3, -1.3, 0.6), (0, 0, 0.24), (0, 0, 1)]
for _ in range(int(frames)):
    simulation.step(1 / 60)
    drawn.points = surface.deform(positions)
    plotter.render()
    images.append(Image.fromarray(plotter.screenshot()))
images[0].save(picture, save_all=True, append_images=images[1:], duration=20, loop=0)
