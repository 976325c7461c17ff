"""What is measured on a run: whether it may be called a simulation of these bodies at all, and how soft they came out."""
import numpy

GRAVITY = 9.81
# A run is stable if nothing is NaN, energy never grows beyond what the fall gives, no body's volume leaves these bounds
# at any frame (a Poisson ratio of 0.4 is compressible, and the impact squeezes), and nobody ends up fast or in the ground.
MOST_ENERGY, MOST_SWELLING = 1.02, 0.15
MOST_SPEED, MOST_SUNK = 1.0, 0.1  # m/s: less than that of the fall; share of the height
MOST_PATIENCE = 1.0  # s: a body that stood on its feet may still topple when the run ends
# It is right if the column sags under its own weight as the theory of bars says, within this factor.
MOST_SOFT = 1.5


def volumes_of(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6


def masses_of(points, tets, density):
    masses = numpy.zeros(len(points))
    numpy.add.at(masses, tets.ravel(), numpy.repeat(volumes_of(points, tets) * density / 4, 4))
    return masses


class Judge:
    """Looks at every frame; `numbers` are of the whole run."""

    def __init__(self, scene, start):
        data = numpy.load(scene["mesh"])
        self.rest, self.tets, self.scene = data["points"].astype(float), data["tets"], scene
        self.masses = masses_of(self.rest, self.tets, scene["density"])
        self.size, self.volume = scene["size"], volumes_of(self.rest, self.tets).sum()
        self.before, self.finite, self.heights = [p.astype(float) for p in start], True, []
        self.energy_at_start = self.energy(self.before, self.before, 1)
        self.most_energy, self.most_swelling, self.speed = 1.0, 0.0, 0.0

    def energy(self, now, before, dt):
        """Kinetic and of gravity, above that of bodies that lie as flat as they can; what is elastic only adds."""
        total = 0.0
        for p, q in zip(now, before):
            total += GRAVITY * (self.masses @ p[:, 2]) + (self.masses @ (((p - q) / dt) ** 2).sum(1)) / 2
        return total

    def look(self, positions, dt):
        now = [p.astype(float) for p in positions]
        if not self.finite or not all(numpy.isfinite(p).all() and numpy.abs(p).max() < 1e6 for p in now):
            self.finite = False
            return
        self.most_energy = max(self.most_energy, self.energy(now, self.before, dt) / self.energy_at_start)
        for p in now:
            self.most_swelling = max(self.most_swelling, abs(volumes_of(p, self.tets).sum() / self.volume - 1))
        motion = sum(self.masses @ ((p - q) ** 2).sum(1) for p, q in zip(now, self.before))
        self.speed = float(numpy.sqrt(motion / (self.masses.sum() * len(now)))) / dt
        self.heights.append(numpy.ptp(now[0][:, 2]))
        self.before = now

    def wait_for_rest(self, step, positions, dt):
        """Looks on while nobody's clock runs, until a body that is alone is at rest or patience ends."""
        for _ in range(round(MOST_PATIENCE / dt)):
            if self.speed < MOST_SPEED or not self.finite or len(self.before) > 1:
                return
            step()
            self.look(positions(), dt)

    def softness(self):
        """How much the column sags in the mean of the second half, over what it should: density g height^2 / (2 E)."""
        sag = self.size - float(numpy.mean(self.heights[len(self.heights) // 2 :]))
        return sag / (self.scene["density"] * GRAVITY * self.size**2 / (2 * self.scene["young"]))

    def numbers(self):
        if not self.finite:
            return {"stable": False, "why": "not finite"}
        low = float(min(p[:, 2].min() for p in self.before) / self.size)
        limits = [("energy grows", self.most_energy < MOST_ENERGY), ("volume lost", self.most_swelling < MOST_SWELLING),
                  ("not at rest", self.speed < MOST_SPEED), ("in the ground", low > -MOST_SUNK)]
        if len(self.before) > 1:
            limits.pop(2)  # a heap is not at rest so soon
        why = ", ".join(name for name, kept in limits if not kept)
        return {"stable": not why, "why": why, "energy": self.most_energy, "swelling": self.most_swelling,
                "speed": self.speed, "low": low, "softness": self.softness()}
