"""Scenes: small pipe systems as plain numbers, given to Trunnion and to an exact judge alike.

Nothing here knows how Trunnion numbers or solves; `model` writes a scene with the words of a deck.
"""

from dataclasses import dataclass, field

import numpy as np

from trunnion.model import Model

INF = float("inf")
NU = 0.3
G = 9.80665
Triple = tuple[float, float, float]


@dataclass
class Pipe:
    """A straight pipe from node i to node j; `e` [Pa], sizes [m], `hot` [K], `density`."""

    i: int
    j: int
    e: float
    od: float
    wall: float
    density: float = 0.0
    alpha: float = 0.0
    hot: float = 0.0


@dataclass
class Support:
    """One contact along `way` (any length); `sides` says which sense it stops."""

    node: int
    way: Triple
    sides: str = "both"  # both (two-way, or gapped on both sides), minus (+Y), plus (-Y)
    gap: tuple[float, float] = (0.0, 0.0)
    k: float = 1e12
    mu: float = 0.0
    kf: float = 1e8
    cnode: int | None = None
    base: Triple | None = None


@dataclass
class Scene:
    """Nodes, pipes, contacts and loads of one case; anchors hold six freedoms by `k` and `kr`."""

    name: str
    xyz: list[Triple]
    pipes: list[Pipe]
    supports: list[Support] = field(default_factory=list)
    anchors: list[int] = field(default_factory=list)
    forces: dict[int, tuple[float, ...]] = field(default_factory=dict)
    k: float = 1e12
    kr: float = 1e12
    shear: bool = True
    weight: bool = True
    heat: bool = True

    @property
    def two_way(self) -> list[bool]:
        return [s.sides == "both" and s.gap == (0.0, 0.0) for s in self.supports]


def model(scene: Scene, order: np.random.Generator | None = None) -> Model:
    """The scene in the words of a deck; cards shuffled by `order` where their order is free."""
    m = Model(title=scene.name)
    m.default(K=scene.k, KR=scene.kr, SHEAR="ON" if scene.shear else "OFF", G=G)

    def shuffled(things: list) -> list:
        return things if order is None else [things[i] for i in order.permutation(len(things))]

    for i in shuffled(list(range(len(scene.xyz)))):
        x, y, z = scene.xyz[i]
        m.node(label(i), X=x, Y=y, Z=z)
    seen: dict[tuple[float, ...], str] = {}
    for p in shuffled(scene.pipes):
        for what, key in (
            ("M", (p.e, p.alpha, p.density)),
            ("S", (p.od, p.wall)),
        ):
            name = seen.get(key)
            if name is None:
                name = seen[key] = f"{what}{len(seen)}"
                if what == "M":
                    m.material(name, E=p.e, NU=NU, ALPHA=p.alpha, DENSITY=p.density)
                else:
                    m.section(name, OD=p.od, WALL=p.wall)
            elif what == "M":
                m.material(name)
            else:
                m.section(name)
        m.operate(T1=20.0 + p.hot, TREF=20.0)
        m.pipe(label(p.i), label(p.j))
    for i in shuffled(scene.anchors):
        m.anchor(label(i))
    for n, s in enumerate(scene.supports):
        keys: dict[str, object] = {"K": s.k}
        if s.sides == "both" and s.gap != (0.0, 0.0):
            keys["GAP"] = list(s.gap)
        elif s.sides != "both":
            keys["GAP"] = s.gap[0] if s.sides == "minus" else s.gap[1]
        if s.mu:
            keys |= {"MU": s.mu, "KF": s.kf}
        sign = {"both": "", "minus": "+", "plus": "-"}[s.sides]
        word = sign + "(" + ",".join(repr(float(x)) for x in s.way) + ")"
        common: dict[str, object] = {"NAME": f"S{n}"}
        if s.cnode is not None:
            common["CNODE"] = label(s.cnode)
        m.support(label(s.node), (word, keys), **common)
    bases = {s.node: s.base for s in reversed(scene.supports) if s.base is not None}
    for i, d in bases.items():
        m.displacement(label(i), "D1", DX=d[0], DY=d[1], DZ=d[2])
    for i, f in scene.forces.items():
        names = ("FX", "FY", "FZ", "MX", "MY", "MZ")
        m.force(label(i), "F1", **dict(zip(names, f, strict=True)))
    terms = ["W"] if scene.weight else []
    terms += ["T1"] if scene.heat else []
    terms += ["F1"] if scene.forces else []
    terms += ["D1"] if bases else []
    m.case("C", " + ".join(terms) or "W")
    return m


def label(i: int) -> str:
    return str(10 * (i + 1))
