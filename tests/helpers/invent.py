"""Random and extreme scenes from a seed, one kind after another over all axes of trouble."""

from collections.abc import Callable

import numpy as np
from plainscenes import Pipe, Scene, Support, Triple

Rng = np.random.Generator
AXES = np.vstack((np.eye(3), -np.eye(3)))


def log(rng: Rng, low: float, high: float) -> float:
    """A number of any size between two."""
    return float(10.0 ** rng.uniform(np.log10(low), np.log10(high)))


def pick(rng: Rng, *things):
    return things[int(rng.integers(len(things)))]


def length(rng: Rng, wild: float) -> float:
    """From 1 mm to 1 km; near a metre where it is not wild."""
    return log(rng, 1e-3, 1e3) if rng.random() < wild else log(rng, 0.5, 10.0)


def pipe(rng: Rng, i: int, j: int, wild: float) -> Pipe:
    """Any pipe: 10 mm to 3 m, 0.5 mm wall to solid, modulus 1e6 to 1e13 Pa."""
    extreme = rng.random() < wild
    od = log(rng, 0.01, 3.0) if extreme else log(rng, 0.05, 0.6)
    thin = min(5e-4, 0.4 * od)
    solid = rng.random() < 0.2 * extreme
    wall = od / 2 * (1 - 1e-9) if solid else log(rng, thin, 0.49 * od)
    e = log(rng, 1e6, 1e13) if extreme else 2e11
    hot = pick(rng, 0.0, 150.0, 150.0, -180.0, 900.0 if extreme else 300.0)
    return Pipe(i, j, e, od, wall, pick(rng, 0.0, 7850.0), pick(rng, 0.0, 1.2e-5, 2e-5), hot)


def tree(rng: Rng, wild: float) -> tuple[list[Triple], list[Pipe]]:
    """A random tree in space, long and short pipes side by side."""
    n = int(rng.integers(1, 8))
    xyz, pipes = [np.zeros(3)], []
    like = pipe(rng, 0, 0, wild)
    for j in range(1, n + 1):
        i = j - 1 if rng.random() < 0.75 else int(rng.integers(j))
        way = pick(rng, *AXES) if rng.random() < 0.7 else rng.normal(size=3)
        xyz.append(xyz[i] + way / np.linalg.norm(way) * length(rng, wild))
        p = pipe(rng, i, j, wild)
        pipes.append(p if rng.random() < wild else Pipe(i, j, *_rest(like)))
    return _triples(xyz), pipes


def _rest(p: Pipe) -> tuple[float, ...]:
    return p.e, p.od, p.wall, p.density, p.alpha, p.hot


def _triples(xyz) -> list[Triple]:
    return [(float(x), float(y), float(z)) for x, y, z in xyz]


def line(rng: Rng, wild: float) -> tuple[list[Triple], list[Pipe]]:
    """A straight run, level or not, with spans of any length."""
    n = int(rng.integers(2, 10))
    way = pick(rng, np.array([1.0, 0, 0]), np.array([0.6, 0, 0.8]), np.array([0, 1.0, 0]),
               np.array([0.99, 0.01, 0.1]))  # fmt: skip
    at = np.cumsum([0.0, *(length(rng, wild) for _ in range(n))])
    like = pipe(rng, 0, 0, wild)
    xyz = [way * x for x in at]
    return _triples(xyz), [Pipe(i, i + 1, *_rest(like)) for i in range(n)]


def grid(rng: Rng, wild: float) -> tuple[list[Triple], list[Pipe]]:
    """Closed loops: a lattice in two or three directions."""
    shape = pick(rng, (2, 2, 1), (3, 2, 1), (2, 2, 2), (4, 2, 1), (3, 3, 1))
    step = [length(rng, wild) for _ in range(3)]
    nodes = [(i, j, k) for i in range(shape[0]) for k in range(shape[2]) for j in range(shape[1])]
    number = {at: n for n, at in enumerate(nodes)}
    like = pipe(rng, 0, 0, wild)
    pipes = []
    for at in nodes:
        for axis in range(3):
            to = tuple(x + (a == axis) for a, x in enumerate(at))
            if to in number:
                p = pipe(rng, number[at], number[to], wild)
                same = Pipe(number[at], number[to], *_rest(like))
                pipes.append(p if rng.random() < 0.3 * wild else same)
    # lattice directions x, z, y: mostly level
    return [(i * step[0], k * step[2], j * step[1]) for i, j, k in nodes], pipes


def contacts(rng: Rng, scene: Scene, wild: float, mu: float, share: float = 0.7) -> None:
    """Supports of all kinds on many nodes, some on top of each other, some between nodes."""
    n = len(scene.xyz)
    for i in range(n):
        if i in scene.anchors or rng.random() > share:
            continue
        for _ in range(1 + (rng.random() < 0.4) + 2 * (rng.random() < 0.1)):
            scene.supports.append(support(rng, i, wild, mu))
    if n > 3 and rng.random() < 0.15 and scene.supports:
        s = scene.supports[int(rng.integers(len(scene.supports)))]
        other = int(rng.integers(n))
        if other != s.node:
            s.cnode = other
    if scene.supports and rng.random() < 0.15:
        twin = scene.supports[int(rng.integers(len(scene.supports)))]
        scene.supports.append(Support(**vars(twin)))
    if scene.supports and rng.random() < 0.2:
        grounded = [s for s in scene.supports if s.cnode is None]
        s = pick(rng, *grounded) if grounded else Support(0, (0.0, 1.0, 0.0))
        d = rng.normal(size=3) * log(rng, 1e-4, 0.1)
        s.base = (float(d[0]), float(d[1]), float(d[2]))


def support(rng: Rng, node: int, wild: float, mu: float) -> Support:
    """Rest, guide, stop or skew contact, with or without gap and friction."""
    extreme = rng.random() < wild
    k = log(rng, 1e8, 1e16) if extreme else 1e12
    kf = log(rng, 1e4, 1e12) if extreme else 1e8
    gap = pick(rng, 0.0, 0.003, log(rng, 1e-6, 1.0))
    kind = pick(rng, "rest", "rest", "rest", "guide", "skew", "stop", "hold")
    up, side = (0.0, 1.0, 0.0), pick(rng, (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    rub = mu if rng.random() < 0.8 else 0.0
    if kind == "rest":
        rest = gap if rng.random() < 0.3 else 0.0
        return Support(node, up, "minus", (rest, 0.0), k, rub, kf)
    if kind == "skew":
        v = rng.normal(size=3)
        way = (float(v[0]), float(v[1]), float(v[2]))
        return Support(node, way, pick(rng, "minus", "plus", "both"), (gap, gap), k, rub, kf)
    if kind == "stop":
        return Support(node, side, pick(rng, "minus", "plus"), (gap, gap), k, rub, kf)
    if kind == "guide":
        return Support(
            node, side, "both", (gap, gap if rng.random() < 0.8 else 2 * gap), k, rub, kf
        )
    return Support(node, pick(rng, up, side), "both", (0.0, 0.0), k, rub, kf)


def push(rng: Rng, scene: Scene, strong: float) -> None:
    """One to three nodal forces and moments."""
    for _ in range(int(rng.integers(1, 4))):
        f = np.concatenate((rng.normal(size=3), 0.3 * rng.normal(size=3))) * strong
        if rng.random() < 0.3:
            f[3:] = 0.0
        scene.forces[int(rng.integers(len(scene.xyz)))] = tuple(map(float, f))


SHAPES: tuple[Callable, ...] = (tree, tree, line, grid)


def invented(seed: int) -> Scene:
    """The scene of a seed."""
    rng = np.random.default_rng(seed)
    wild = pick(rng, 0.0, 0.2, 0.5, 1.0)
    theme = pick(rng, *THEMES)
    mu = pick(rng, 0.0, 0.0, 0.1, 0.3, 0.3, 0.6, 1.0, 2.0)
    xyz, pipes = pick(rng, *SHAPES)(rng, wild)
    scene = Scene(f"{theme.__name__} {seed}", xyz, pipes)
    scene.shear = bool(rng.integers(2))
    scene.weight = rng.random() < 0.8
    scene.heat = rng.random() < 0.7
    if rng.random() < 0.3 * wild:
        scene.k, scene.kr = log(rng, 1e8, 1e16), log(rng, 1e8, 1e16)
    theme(rng, scene, wild, mu)
    if not scene.weight and not scene.heat and not scene.forces:
        scene.weight = True
    return scene


def anchored(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    scene.anchors = [0] + ([len(scene.xyz) - 1] if rng.random() < 0.4 else [])
    contacts(rng, scene, wild, mu)
    if rng.random() < 0.5:
        push(rng, scene, log(rng, 10, 1e5))


def resting(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """No anchor: the pipe only rests, by friction or not at all."""
    for i in range(len(scene.xyz)):
        if rng.random() < 0.8:
            k = log(rng, 1e8, 1e16) if rng.random() < wild else 1e12
            scene.supports.append(Support(i, (0.0, 1.0, 0.0), "minus", (0.0, 0.0), k, mu))
    scene.weight = True
    if rng.random() < 0.3:
        push(rng, scene, log(rng, 1, 1e3))


def lifting(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """All supports lift off an anchored pipe."""
    scene.anchors = [0]
    for i in range(1, len(scene.xyz)):
        scene.supports.append(Support(i, (0.0, 1.0, 0.0), "minus", (0.0, 0.0), 1e12, mu))
    strong = log(rng, 1e3, 1e6)
    for i in range(1, len(scene.xyz)):
        scene.forces[i] = (0.0, strong, 0.0, 0.0, 0.0, 0.0)


def shaky(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """Nearly a mechanism: springs of next to nothing, or supports next to each other."""
    n = len(scene.xyz)
    for i in range(n):
        for way in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
            if rng.random() < 0.5:
                k = pick(rng, 1e12, log(rng, 1.0, 1e6))
                scene.supports.append(Support(i, way, "both", (0.0, 0.0), k))
    if rng.random() < 0.5:
        push(rng, scene, log(rng, 1, 1e3))


def far(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """A thousand kilometres from the origin."""
    anchored(rng, scene, wild, mu)
    off = rng.normal(size=3) * 1e6
    scene.xyz = _triples(np.array(scene.xyz) + off)


def still(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """Loads of zero."""
    anchored(rng, scene, wild, mu)
    scene.heat, scene.forces = False, {}
    scene.pipes = [Pipe(p.i, p.j, p.e, p.od, p.wall) for p in scene.pipes]
    scene.weight = True
    for s in scene.supports:
        s.base = None


def tied(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """Contact at exactly the gap, and friction at exactly mu N, where nothing else pushes."""
    still(rng, scene, wild, mu)
    for s in scene.supports:
        gap = float(2.0 ** -rng.integers(4, 12))
        s.way, s.sides = (0.0, 1.0, 0.0), pick(rng, "minus", "plus", "both")
        s.gap = (gap, gap)
        s.base = (0.0, gap if rng.random() < 0.5 else -gap, 0.0)
        s.cnode = None


def scorched(rng: Rng, scene: Scene, wild: float, mu: float) -> None:
    """Huge heat between anchors and stops."""
    anchored(rng, scene, wild, mu)
    scene.heat = True
    for p in scene.pipes:
        p.alpha, p.hot = 2e-5, pick(rng, 3000.0, 1000.0, -270.0)


THEMES = (anchored, anchored, anchored, resting, lifting, shaky, far, still, tied, scorched)
