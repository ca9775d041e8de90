"""Manufactured scenes: displacements and contact states first, loads derived from them.

A smooth shape of the pipe is chosen (what some forces would do to it on some of its supports, in
60 digits).  Gaps, sides and stick stiffness are then chosen so that every support is in the state
that was drawn for it, and the forces that hold the pipe exactly there become the loads.  Gaps and
loads are rounded to doubles, as a deck has them.
"""

from dataclasses import dataclass

import numpy as np
from ballarithmetic import (
    BOTH,
    MINUS,
    OPEN,
    PLUS,
    SLIP,
    STICK,
    Judge,
    dot,
    size,
    unit,
    vector,
)
from flint import arb, arb_mat
from invent import SHAPES, log, pick, push
from plainscenes import Scene, Support

Rng = np.random.Generator
SIDE = {-1: (MINUS, "minus"), 1: (PLUS, "plus")}
WAYS = ((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
CLOSE = 1e-9  # a redraw where rounding loads and gaps alone moves the answer by more


@dataclass
class Made:
    """A scene with the answer that it was made for; `redrawn` scenes before it were no good."""

    scene: Scene
    u: list[arb]
    states: list[tuple[str, str]]
    redrawn: int


def manufactured(seed: int) -> Made:
    """The first good scene of a seed."""
    for n in range(50):
        made = _draw(np.random.default_rng((seed, n)), f"made {seed}")
        if made is None:
            continue
        scene, u, states = made
        judge = Judge(scene)
        exact = judge.polish(u, states)
        if exact is None or judge.law(exact, states, slack=1e-12) is not None:
            continue
        away = judge.measure([a - b for a, b in zip(u, exact, strict=True)])
        if away <= CLOSE * judge.measure(u):
            return Made(scene, u, states, n)
    raise AssertionError(f"seed {seed}: no scene that doubles can hold")


def _draw(rng: Rng, name: str) -> tuple[Scene, list[arb], list[tuple[str, str]]] | None:
    wild = pick(rng, 0.0, 0.2, 0.5, 1.0)
    mu = pick(rng, 0.0, 0.0, 0.1, 0.3, 0.6, 1.0, 2.0)
    xyz, pipes = pick(rng, *SHAPES)(rng, wild)
    if rng.random() < 0.1:
        xyz = [tuple(map(float, np.array(x) + 1e6)) for x in xyz]
    scene = Scene(name, xyz, pipes)
    scene.shear, scene.weight = bool(rng.integers(2)), bool(rng.integers(2))
    scene.heat = rng.random() < 0.5
    if rng.random() < 0.3 * wild:
        scene.k, scene.kr = log(rng, 1e8, 1e16), log(rng, 1e8, 1e16)
    if rng.random() < 0.85:
        scene.anchors = [0] + ([len(xyz) - 1] if rng.random() < 0.3 else [])
    pressed = [] if rng.random() < 0.2 else _drawn(rng, scene, wild, 0.4)
    u = _shape(rng, scene, pressed)
    if u is None:
        return None
    judge = Judge(scene)
    states: list[tuple[str, str]] = []
    for s in pressed:
        states.append(_press(rng, scene, judge, s, u, mu))
    for s in _drawn(rng, scene, wild, 0.6):
        found = _gapped(rng, scene, judge, s, u, mu)
        if found is not None:
            states.append(found)
    return (scene, u, states) if _load(scene, u, states) else None


def _drawn(rng: Rng, scene: Scene, wild: float, share: float) -> list[Support]:
    """Supports of any direction; some on top of each other, some between nodes."""
    out = []
    for node in range(len(scene.xyz)):
        if node in scene.anchors:
            continue
        while rng.random() < share:
            way = pick(rng, *WAYS, tuple(map(float, rng.normal(size=3))))
            k = log(rng, 1e8, 1e16) if rng.random() < wild else 1e12
            kf = log(rng, 1e4, 1e12) if rng.random() < wild else 1e8
            s = Support(node, way, k=k, kf=kf)
            if rng.random() < 0.05 and len(scene.xyz) > 2:
                s.cnode = (node + 2) % len(scene.xyz)
            out.append(s)
    return out


def _shape(rng: Rng, scene: Scene, pressed: list[Support]) -> list[arb] | None:
    """What some forces would do to the pipe on its anchors and these supports."""
    bare = Scene("shape", scene.xyz, scene.pipes, list(pressed), scene.anchors)
    bare.k, bare.kr, bare.shear = scene.k, scene.kr, scene.shear
    bare.weight, bare.heat = scene.weight and rng.random() < 0.5, scene.heat
    push(rng, bare, log(rng, 10.0, 1e4))
    judge = Judge(bare)
    zero = [arb(0)] * judge.n
    r, k = judge.equations(zero, [(BOTH, OPEN)] * len(pressed))
    if not scene.anchors:
        for i in range(judge.n):
            k[i, i] += arb(1e4)
    try:
        p = k.solve(arb_mat([[x] for x in r]), algorithm="approx")
    except ZeroDivisionError:
        return None
    u = [p[i, 0].mid() for i in range(judge.n)]
    move = size(x for i, x in enumerate(u) if i % 6 < 3)
    turn = size(x for i, x in enumerate(u) if i % 6 >= 3)
    if move == 0.0:
        return None
    share = min(log(rng, 1e-5, 1.0) / move, 0.5 / max(turn, 1e-300))
    return [(share * x).mid() for x in u]


def _press(
    rng: Rng, scene: Scene, judge: Judge, s: Support, u: list[arb], mu: float
) -> tuple[str, str]:
    """A support without gap that the shape presses: two-way, or one-way on that side."""
    n = _add(scene, judge, s)
    d = dot(judge.normal[n], judge.travel(n, u))
    side, s.sides = BOTH, "both"
    if rng.random() < 0.6 and float(d.mid()) != 0.0:
        side, s.sides = SIDE[1 if float(d.mid()) > 0 else -1]
    return side, _rub(rng, judge, n, s, side, u, mu)


def _gapped(
    rng: Rng, scene: Scene, judge: Judge, s: Support, u: list[arb], mu: float
) -> tuple[str, str] | None:
    """A support with a gap chosen for the state that is drawn."""
    n = _add(scene, judge, s)
    d = float(dot(judge.normal[n], judge.travel(n, u)).mid())
    sense = 1 if d > 0 else -1
    draw = rng.random()
    if draw < 0.5 and d != 0.0:  # closed
        force = min(log(rng, 1.0, 1e5), 0.9 * s.k * abs(d))
        gap = abs(d) - force / s.k
        if rng.random() < 0.05:
            gap = abs(d)  # a tie: contact at exactly the gap
        side, s.sides = SIDE[sense]
        other = gap * pick(rng, 1.0, 2.0)
        s.gap = (other, gap) if sense > 0 else (gap, other)
        if rng.random() < 0.5 and gap > 0.0:
            s.sides = "both"
        return side, _rub(rng, judge, n, s, side, u, mu)
    if rng.random() < 0.4 and d != 0.0:  # lifted off
        _, s.sides = SIDE[-sense]
    else:
        gap = abs(d) * float(rng.uniform(1.001, 3.0)) or 0.003
        s.gap, s.sides = (gap, gap), pick(rng, "minus", "plus", "both")
    s.mu = mu
    return OPEN, OPEN


def _add(scene: Scene, judge: Judge, s: Support) -> int:
    scene.supports.append(s)
    judge.normal.append(unit(vector(s.way)))
    return len(scene.supports) - 1


def _rub(rng: Rng, judge: Judge, n: int, s: Support, side: str, u: list[arb], mu: float) -> str:
    """Friction of a pressed support: its stick stiffness decides whether it slips."""
    normal = abs(float(judge.push(n, side, u)[0].mid()))
    w = judge.travel(n, u)
    across = dot(judge.normal[n], w)
    w = [a - across * b for a, b in zip(w, judge.normal[n], strict=True)]
    slide = float(dot(w, w).sqrt().mid())
    if not mu or rng.random() < 0.3 or slide == 0.0 or normal == 0.0:
        return OPEN
    s.mu = mu
    limit = mu * normal / slide  # stick stiffness at which it would just slip
    slips = rng.random() < 0.6
    kf = limit * log(rng, 1.05, 1e4) if slips else limit / log(rng, 1.05, 1e4)
    s.kf = min(max(kf, 1e4), 1e12)
    return SLIP if s.kf > limit else STICK


def _load(scene: Scene, u: list[arb], states: list[tuple[str, str]]) -> bool:
    """The forces that hold the pipe at u become loads, rounded to doubles."""
    judge = Judge(scene)
    r, _ = judge.equations(u, states)
    force = [-float(x.mid()) for x in r]
    most = max(map(abs, force), default=0.0)
    if not most < 1e12:
        return False
    for i in range(len(scene.xyz)):
        rows = [x if abs(x) > 1e-30 * most else 0.0 for x in force[6 * i : 6 * i + 6]]
        if any(rows):
            scene.forces[i] = tuple(rows)
    return True
