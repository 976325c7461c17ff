"""The engines behind one interface: built from a scene, they go on by a frame of 1/60 s and say where vertices are.

A scene is a dictionary: "mesh" (.npz of points and tets, in metres, z up), "msh" and "vtk" (the same as files), "places"
(where each copy of the body begins), "density", "young", "poisson", "damping_time", "size" (height of the body),
"edge" (mean edge). Each class has its engine's own step as `usual`, in substeps of a frame.
"""
import numpy

FRAME = 1 / 60
FRICTION = 0.5
MANY = 10**9
FEW = 1000  # tets; what is not right with these is not tried with more
THICKNESS = 0.005  # of the contact layer, as a share of the body's height, where an engine wants one


def lame(scene):
    young, poisson = scene["young"], scene["poisson"]
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))


class Tetsoup:
    """Contacts as the others have them: with the ground and between bodies, not of a body with itself.

    Its own step is what it takes when nothing is said: ten substeps a frame, or as many as keep the body as stiff as its
    material. What the search asks for it gets exactly.
    """

    name, usual, between, package, most_tets = "tetsoup", 10, True, "tetsoup", MANY

    def __init__(self, scene, substeps):
        import tetsoup

        data = numpy.load(scene["mesh"])
        mesh = tetsoup.TetMesh(data["points"], data["tets"])
        self.simulation = tetsoup.Simulation(
            contacts="between", **({} if substeps == self.usual else {"substeps": substeps, "max_substeps": 1}))
        self.simulation.add_plane(friction=FRICTION)
        numbers = self.simulation.add_bodies(
            mesh, scene["places"], density=scene["density"], young=scene["young"], poisson=scene["poisson"],
            damping_time=scene["damping_time"], friction=FRICTION)
        self.views = [self.simulation.positions(number) for number in numbers]

    @property
    def substeps(self):
        return self.simulation.report.substeps

    def frame(self):
        self.simulation.step(FRAME)

    def positions(self):
        return self.views


class MuJoCo:
    """Its default step of 0.002 s is 8.3 to a frame; "discrete" takes elasticity implicitly."""

    name, usual, between, package, most_tets = "MuJoCo flex", 8, True, "mujoco", MANY

    def __init__(self, scene, substeps):
        import mujoco

        count = len(numpy.load(scene["mesh"])["points"])
        bodies = "".join(self.body(scene, number, place) for number, place in enumerate(scene["places"]))
        self.mujoco, self.substeps = mujoco, substeps
        self.model = mujoco.MjModel.from_xml_string(f"""<mujoco>
  <option timestep="{FRAME / substeps!r}" integrator="discrete"/>
  <size memory="2G"/>
  <worldbody><geom type="plane" size="9 9 .1"/>{bodies}</worldbody></mujoco>""")
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.counts = [count] * len(scene["places"])

    @staticmethod
    def body(scene, number, place):
        x, y, z = place
        return f"""<flexcomp name="b{number}" type="gmsh" dim="3" file="{scene["msh"]}" mass="{scene["mass"]!r}"
            radius="{THICKNESS * scene["size"]!r}" pos="{x} {y} {z}">
      <elasticity young="{scene["young"]}" poisson="{scene["poisson"]}" damping="{scene["damping_time"]}"/>
      <contact selfcollide="none" friction="{FRICTION} .005 .0001"/></flexcomp>"""

    def frame(self):
        self.mujoco.mj_step(self.model, self.data, self.substeps)

    def positions(self):
        # Those of the vertices at the beginning of the last substep, unless asked for anew.
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_flex(self.model, self.data)
        return numpy.split(self.data.flexvert_xpos.copy(), numpy.cumsum(self.counts)[:-1])


class Newton:
    """Newton by Warp on the CPU; a solver of its own in each class below."""

    between, package, most_tets = False, "newton", MANY
    iterations = 10
    damped = 1.0  # k_damp over damping_time x Young's modulus

    def __init__(self, scene, substeps):
        import newton
        import warp

        warp.config.quiet = True
        data = numpy.load(scene["mesh"])
        k_lambda, k_mu = lame(scene)
        builder = newton.ModelBuilder()
        builder.default_particle_radius = THICKNESS * scene["size"]
        builder.add_ground_plane()
        for place in scene["places"]:
            builder.add_soft_mesh(
                pos=warp.vec3(*place), rot=warp.quat_identity(), scale=1.0, vel=warp.vec3(0.0),
                vertices=[warp.vec3(*p) for p in data["points"].tolist()], indices=data["tets"].ravel().tolist(),
                density=scene["density"], k_mu=k_mu, k_lambda=k_lambda,
                k_damp=self.damped * scene["damping_time"] * scene["young"],
                particle_radius=THICKNESS * scene["size"])
        if self.solver == "vbd":
            builder.color()
        self.model = builder.finalize(device="cpu")
        self.model.soft_contact_ke = scene["young"] * scene["edge"]  # N/m: as stiff as a tet
        self.model.soft_contact_kd = self.contact_damping * self.model.soft_contact_ke
        self.model.soft_contact_mu = FRICTION
        self.solve = self.make_solver(newton, scene)
        self.state, self.after = self.model.state(), self.model.state()
        self.control, self.pipeline = self.model.control(), newton.CollisionPipeline(self.model)
        self.contacts = self.pipeline.contacts()
        self.substeps, self.bodies = substeps, len(scene["places"])

    def frame(self):
        for _ in range(self.substeps):
            self.state.clear_forces()
            self.pipeline.collide(self.state, self.contacts)
            self.solve.step(self.state, self.after, self.control, self.contacts, FRAME / self.substeps)
            self.state, self.after = self.after, self.state

    def positions(self):
        return numpy.split(self.state.particle_q.numpy().copy(), self.bodies)


class NewtonVBD(Newton):
    """As its soft body examples have it: ten substeps of ten iterations."""

    name, usual, between, solver, contact_damping = "Newton VBD", 10, True, "vbd", 0.0

    def make_solver(self, newton, scene):
        layer = THICKNESS * scene["size"]
        return newton.solvers.SolverVBD(
            self.model, iterations=self.iterations, particle_enable_tile_solve=False,
            particle_enable_self_contact=len(scene["places"]) > 1, particle_self_contact_radius=2 * layer,
            particle_self_contact_margin=3 * layer)


class NewtonXPBD(Newton):
    """As its example of soft contact has it: 32 substeps of ten iterations. With damping it does not stay together."""

    name, usual, solver, contact_damping, damped = "Newton XPBD", 32, "xpbd", 0.0, 0.0
    most_tets = FEW

    def make_solver(self, newton, scene):
        return newton.solvers.SolverXPBD(self.model, iterations=self.iterations)


class NewtonSemiImplicit(Newton):
    """Explicit forces; 32 substeps, and next to no damping, as its example of soft contact has it."""

    name, usual, solver, contact_damping, damped = "Newton semi-implicit", 32, "semi-implicit", 0.001, 0.0
    most_tets = FEW

    def make_solver(self, newton, scene):
        return newton.solvers.SolverSemiImplicit(self.model)


class PyBullet:
    """Its default step is 1/240 s."""

    name, usual, between, package, most_tets = "PyBullet", 4, True, "pybullet", MANY

    def __init__(self, scene, substeps):
        import pybullet

        k_lambda, k_mu = lame(scene)
        size = scene["size"]
        if not pybullet.isConnected():
            pybullet.connect(pybullet.DIRECT)
        pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD)
        pybullet.setGravity(0, 0, -9.81)
        pybullet.setTimeStep(FRAME / substeps)
        # A box: soft bodies stop 0.1 m above a shape of type plane.
        box = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[20 * size, 20 * size, size])
        pybullet.createMultiBody(0, box, basePosition=[0, 0, -size])
        self.pybullet, self.substeps = pybullet, substeps
        self.bodies = [
            pybullet.loadSoftBody(
                scene["vtk"], basePosition=place, mass=scene["mass"], collisionMargin=THICKNESS * size, useNeoHookean=1,
                NeoHookeanMu=k_mu, NeoHookeanLambda=k_lambda, NeoHookeanDamping=0.01, frictionCoeff=FRICTION,
                useSelfCollision=0)
            for place in scene["places"]]

    def frame(self):
        for _ in range(self.substeps):
            self.pybullet.stepSimulation()

    def positions(self):
        flags = self.pybullet.MESH_DATA_SIMULATION_MESH
        return [numpy.array(self.pybullet.getMeshData(body, -1, flags=flags)[1]) for body in self.bodies]


ENGINES = {engine.name: engine for engine in (Tetsoup, MuJoCo, NewtonVBD, NewtonXPBD, NewtonSemiImplicit, PyBullet)}
PACKAGES = ["tetsoup", "mujoco", "newton", "warp-lang", "pybullet"]
