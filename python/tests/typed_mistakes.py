"""A program in which mypy must find exactly the marked mistakes; nobody executes it."""

import tetsoup

mesh = tetsoup.tetrahedralize("bunny.ply", tets="many")  # wrong
mesh = tetsoup.tetrahedralize("bunny.ply", rhomin=0.5)  # wrong
mesh = tetsoup.tetrahedralize("bunny.ply", thin="maybe")  # wrong
print(mesh.quality.min_dihedral, mesh.report.lattice.tet_count)
print(mesh.quality.minimum_dihedral)  # wrong
tetsoup.smooth(mesh, tets=3)  # wrong
mesh.save(3)  # wrong
mesh.save("bunny", engine=3)  # wrong
mesh.regions("bunny.obj", by="colour")  # wrong
mesh.embed("bunny.obj").bend  # wrong
simulation = tetsoup.Simulation(solver="fast")  # wrong
simulation = tetsoup.Simulation(substep=3)  # wrong
simulation.add_body(mesh, young="stiff")  # wrong
simulation.add_bodies(mesh, [(0, 0, 1)], youngs=3)  # wrong
simulation.energy.heat  # wrong
simulation.step("long")  # wrong
