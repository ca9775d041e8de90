"""Straight pipes in 50 digits: vectors, tip flexibility, and the scenes that are made of them."""

from dataclasses import dataclass

import mpmath
import numpy as np
from mpmath import mpf

from trunnion.model import Model

mpmath.mp.dps = 50
ZERO = mpf(0)
Vector = list[mpf]
G = 9.80665  # the program's own [m/s2]


@dataclass
class Pipe:
    """A straight pipe from node a to node b."""

    a: int
    b: int
    delta: np.ndarray
    od: float
    wall: float
    e: float


@dataclass
class Rest:
    """One direction of a support with the state that was chosen for it."""

    node: int
    word: str
    keys: dict[str, object]
    force: Vector
    state: str


@dataclass
class Scene:
    """A model and all that it is made of; `u` where the displacements were chosen."""

    seed: int
    kind: str
    model: Model
    u: list[Vector]
    rests: list[Rest]
    pipes: list[Pipe]
    beams: list["Beam"]
    loads: list[list[float]]
    strain: mpf
    k: float
    friction: bool = False


def dot(a: Vector, b: Vector) -> mpf:
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


def cross(a: Vector, b: Vector) -> Vector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a: Vector, b: Vector, f: mpf | int = 1) -> Vector:
    return [x + f * y for x, y in zip(a, b, strict=True)]


class Beam:
    """Tip flexibility of a straight pipe fixed at its first end, and its inverse."""

    def __init__(self, pipe: Pipe, nu: float, shear: bool, density: float = 0.0):
        self.d = [mpf(float(x)) for x in pipe.delta]
        self.length = length = mpmath.sqrt(dot(self.d, self.d))
        self.ex = [x / length for x in self.d]
        outer, e = mpf(pipe.od), mpf(pipe.e)
        inner = outer - 2 * mpf(pipe.wall)
        area = mpmath.pi / 4 * (outer**2 - inner**2)
        inertia = mpmath.pi / 64 * (outer**4 - inner**4)
        g = e / (2 * (1 + mpf(nu)))
        self.axial, self.twist = length / (e * area), length / (2 * g * inertia)
        self.sway = length**3 / (3 * e * inertia) + (length / (g * area / 2) if shear else 0)
        self.slip = length**2 / (g * area) if shear else ZERO
        self.load = [ZERO, -mpf(density) * area * mpf(G), ZERO]  # weight per length, Y up
        self.mixed, self.turn = length**2 / (2 * e * inertia), length / (e * inertia)

    def _parts(self, v: Vector) -> tuple[mpf, Vector]:
        along = dot(v, self.ex)
        return along, add(v, self.ex, -along)

    def deformation(self, f: Vector, m: Vector) -> tuple[Vector, Vector]:
        """Translation and rotation of the tip under a force and a moment there."""
        n, q = self._parts(f)
        t, b = self._parts(m)
        bent = cross(b, self.ex)  # a moment about y pushes the tip of a beam along x to -z
        u = [self.axial * n * e + self.sway * s + self.mixed * c
             for e, s, c in zip(self.ex, q, bent, strict=True)]  # fmt: skip
        tilt = cross(self.ex, q)
        r = [self.twist * t * e + self.mixed * c + self.turn * x
             for e, c, x in zip(self.ex, tilt, b, strict=True)]  # fmt: skip
        return u, r

    def sag(self) -> tuple[Vector, Vector]:
        """Translation and rotation of the tip under the own weight."""
        n, q = self._parts(self.load)
        length = self.length
        sway = self.turn * length**3 / 8 + self.slip
        u = [self.axial * length / 2 * n * e + sway * s for e, s in zip(self.ex, q, strict=True)]
        return u, [self.turn * length**2 / 6 * c for c in cross(self.ex, q)]

    def force(self, u: Vector, r: Vector) -> tuple[Vector, Vector]:
        """Force and moment at the tip that make a deformation."""
        n, q = self._parts(u)
        t, b = self._parts(r)
        det = self.sway * self.turn - self.mixed**2
        bent, tilt = cross(b, self.ex), cross(self.ex, q)
        f = [n / self.axial * e + (self.turn * s - self.mixed * c) / det
             for e, s, c in zip(self.ex, q, bent, strict=True)]  # fmt: skip
        m = [t / self.twist * e + (self.sway * x - self.mixed * c) / det
             for e, x, c in zip(self.ex, b, tilt, strict=True)]  # fmt: skip
        return f, m


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(10 ** rng.uniform(np.log10(low), np.log10(high)))


def direction(rng: np.random.Generator) -> np.ndarray:
    if rng.random() < 0.7:
        return np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])
    way = rng.normal(size=3)
    return way / np.linalg.norm(way)


def pipes_of(rng: np.random.Generator, n: int) -> list[Pipe]:
    """A tree of n pipes; lengths side by side from 1 mm to 1 km, or alike.

    Bore and modulus belong to the scene, with sections up to three times apart; in one scene of
    twenty they are anything from pipe to pipe.
    """
    wild, anything = rng.random() < 0.6, rng.random() < 0.05
    centre = log_uniform(rng, 1e-2, 1e2)
    od, e = log_uniform(rng, 0.01, 3.0), log_uniform(rng, 1e6, 1e13)
    pipes = []
    for b in range(1, n + 1):
        a = b - 1 if rng.random() < 0.8 else int(rng.integers(b))
        length = log_uniform(rng, 1e-3, 1e3) if wild else centre * rng.uniform(0.5, 2.0)
        own = min(max(od * rng.uniform(0.3, 1.0), 0.01), 3.0)
        modulus = e
        if anything:
            own, modulus = log_uniform(rng, 0.01, 3.0), log_uniform(rng, 1e6, 1e13)
        wall = own / 2 if rng.random() < 0.1 else own / 2 * rng.uniform(0.02, 1.0)
        wall = min(max(wall, 0.0005), own / 2)
        pipes.append(Pipe(a, b, direction(rng) * length, own, wall, modulus))
    return pipes


def model_of(
    scene: str,
    pipes: list[Pipe],
    rests: list[Rest],
    loads: list[list[float]],
    *,
    strain: float = 0.0,
    shear: bool = True,
    k: float = 1e12,
    density: float = 0.0,
    anchored: bool = True,
    at: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> Model:
    """Describe a scene in the words of the program."""
    model = Model(title=scene)
    model.default(K=k, KR=k, SHEAR="ON" if shear else "OFF")
    model.operate(TREF=0, **({"T1": 100.0} if strain else {}))
    model.node("0", **dict(zip("XYZ", at, strict=True)))
    placed = {0}
    for i, pipe in enumerate(pipes):
        model.material(f"M{i}", E=pipe.e, NU=0.3, ALPHA=strain / 100.0, DENSITY=density or 1.0)
        model.section(f"S{i}", OD=pipe.od, WALL=pipe.wall)
        step = {f"D{x}": float(d) for x, d in zip("XYZ", pipe.delta, strict=True) if d}
        if {pipe.a, pipe.b} <= placed:
            step = {}  # closes a loop
        placed |= {pipe.a, pipe.b}
        model.pipe(str(pipe.a), str(pipe.b), SECTION=f"S{i}", MATERIAL=f"M{i}", **step)
    if anchored:
        model.anchor("0")
    for rest in rests:
        model.support(str(rest.node), (rest.word, rest.keys))
    names = ("FX", "FY", "FZ", "MX", "MY", "MZ")
    loaded = False
    for node, load in enumerate(loads):
        keys = {name: x for name, x in zip(names, load, strict=True) if x}
        if keys:
            model.force(str(node), "F1", **keys)
            loaded = True
    sets = [*(["F1"] if loaded else []), *(["T1"] if strain else []), *(["W"] if density else [])]
    model.case("A", " + ".join(sets or ["W"]))
    return model
