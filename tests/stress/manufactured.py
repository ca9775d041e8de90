"""Scenes whose answer is chosen first: displacements and contact states, then the loads for them.

All of it is written in 50-digit arithmetic, with closed forms of its own: the tip flexibility of
a straight pipe (Timoshenko), the contact and Coulomb laws of the design.  Only the loads are
rounded to doubles in the end, so the chosen displacements are the answer to about 1e-15.
"""

from pipes import ZERO, Beam, Rest, Scene, Vector, add, cross, dot, log_uniform, model_of, pipes_of

import mpmath
import numpy as np
from mpmath import mpf

LEAST = mpf(1)  # size of the forces in a scene [N]


def manufactured(seed: int) -> Scene:
    """The scene of a seed."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 9)) if rng.random() < 0.8 else int(rng.integers(9, 25))
    nu, shear, k = 0.3, bool(rng.integers(2)), log_uniform(rng, 1e8, 1e16)
    strain = mpf(float(rng.choice([0.0, 0.0, 0.001, 0.02])))  # by temperature
    scale = ZERO
    while scale < LEAST:  # a km of 10 mm tube of rubber carries nothing: draw again
        pipes = pipes_of(rng, n)
        beams = [Beam(pipe, nu, shear) for pipe in pipes]
        root, tips = rng.normal(size=6), [rng.normal(size=6) for _ in pipes]
        u, scale = _displaced(beams, pipes, root, tips, k, strain, rng)
    rests = _rests(rng, u, n, scale, k)
    loads = _loads(beams, pipes, u, strain, k)
    for rest in rests:
        loads[rest.node] = add(loads[rest.node][:3], rest.force, -1) + loads[rest.node][3:]
    rounded = [[float(x) for x in load] for load in loads]
    title = f"Manufactured scene, seed {seed}"
    model = model_of(title, pipes, rests, rounded, strain=float(strain), shear=shear, k=k)
    friction = any("MU" in rest.keys for rest in rests)
    return Scene(seed, "manufactured", model, u, rests, pipes, beams, rounded, strain, k, friction)


def _displaced(beams, pipes, root, tips, k, strain, rng):
    """Displacements of all nodes for tip forces of one size, chosen so that the largest fits."""
    trial = _carried(beams, pipes, root, tips, k, ZERO, mpf(1))
    largest = max(abs(x) for row in trial for x in row[:3])
    scale = mpf(log_uniform(rng, 1e-6, 1e-2)) * max(b.length for b in beams) / largest
    return _carried(beams, pipes, root, tips, k, strain, scale), scale


def _carried(beams, pipes, root, tips, k, strain, scale) -> list[Vector]:
    """Displacements from node to node, out from the root on its anchor."""
    u = [[-scale * mpf(float(x)) / mpf(k) for x in root]]
    for pipe, beam, tip in zip(pipes, beams, tips, strict=True):
        f = [scale * mpf(float(x)) for x in tip[:3]]
        m = [scale * beam.length * mpf(float(x)) for x in tip[3:]]
        v, r = beam.deformation(f, m)
        before = u[pipe.a]
        moved = add(add(before[:3], cross(before[3:], beam.d)), add(v, beam.d, strain))
        u.append(moved + add(before[3:], r))
    return u


def _rests(rng, u, n, scale, k) -> list[Rest]:
    """Supports whose gaps, stiffnesses and friction fit the displacements and a chosen state.

    `u` is moved by round-off so that contacts that are closed are so by just the force chosen.
    """
    rests = []
    for node in range(1, n + 1):
        if rng.random() < 0.4:
            continue
        for axis in rng.permutation(3)[: int(rng.integers(1, 4))]:
            rests += _rest(rng, u, node, int(axis), scale, k)
    for rest in rests:  # friction last: it depends on all displacements
        if "MU" in rest.keys:
            _rub(rng, u, rest)
    return rests


def _rest(rng, u, node, axis, scale, default) -> list[Rest]:
    x = u[node][axis]
    side = 1 if x > 0 else -1
    name = "XYZ"[axis]
    k = default if rng.random() < 0.5 else log_uniform(rng, 1e8, 1e16)
    keys: dict[str, object] = {} if k == default else {"K": k}
    kind = rng.choice(["two-way", "open", "closed", "tie"], p=[0.15, 0.3, 0.45, 0.1])
    if kind == "two-way":
        force = [ZERO] * 3
        force[axis] = -mpf(k) * x
        if abs(force[axis]) > 1e3 * abs(scale):
            return []
        return [Rest(node, name, keys, force, "engaged")]
    one_way = rng.random() < 0.5
    word = ("-" if side > 0 else "+") + name if one_way else name
    if kind == "open":
        gap = float(abs(x)) * float(rng.uniform(1.001, 3.0)) + (
            float(rng.uniform(0, 1)) if rng.random() < 0.2 else 0.0
        )
        return [Rest(node, word, {**keys, "GAP": gap}, [ZERO] * 3, "open")]
    push = ZERO if kind == "tie" else abs(scale) * mpf(log_uniform(rng, 1e-3, 3.0))
    gap = float(abs(x) - push / mpf(k))
    if gap < 0.0:
        return []
    u[node][axis] = side * (mpf(gap) + push / mpf(k))
    keys["GAP"] = gap
    force = [ZERO] * 3
    force[axis] = -side * push
    if rng.random() < 0.5:
        keys["MU"] = float(rng.choice([0.1, 0.3, 0.6, 1.0, 2.0]))
    rests = [Rest(node, word, keys, force, kind)]
    if rng.random() < 0.15:  # a second support on top of the first shares the load
        soft = float(k * rng.uniform(0.1, 1.0))
        twin = [ZERO] * 3
        twin[axis] = -side * mpf(soft) * (abs(u[node][axis]) - mpf(gap))
        rests.append(Rest(node, word, {"GAP": gap, "K": soft}, twin, kind))
    return rests


def _rub(rng, u, rest: Rest) -> None:
    """Friction at mu N, below it, or just there: the stick stiffness decides."""
    axis = "XYZ".index(rest.word[-1])
    slide = [ZERO if i == axis else u[rest.node][i] for i in range(3)]
    travel = mpmath.sqrt(dot(slide, slide))
    push = abs(rest.force[axis])
    capacity = mpf(rest.keys["MU"]) * push
    if travel == 0 or capacity == 0:
        rest.keys["KF"] = 1e8
        return
    ratio = float(rng.choice([0.1, 0.9, 1.0, 1.1, 100.0]))
    kf = min(max(float(ratio * capacity / travel), 1e4), 1e12)
    rest.keys["KF"] = kf
    friction = min(mpf(kf) * travel, capacity)
    rest.state = "stick" if mpf(kf) * travel <= capacity else "slip"
    rest.force = add(rest.force, slide, -friction / travel)


def _loads(beams, pipes, u, strain, k) -> list[Vector]:
    """Nodal loads that hold the pipes and the root's anchor in balance, before the rests."""
    loads = [[ZERO] * 6 for _ in u]
    for pipe, beam in zip(pipes, beams, strict=True):
        a, b = u[pipe.a], u[pipe.b]
        moved = add(add(b[:3], a[:3], -1), cross(a[3:], beam.d), -1)
        moved = add(moved, beam.d, -strain)
        f, m = beam.force(moved, add(b[3:], a[3:], -1))
        back = cross(beam.d, f)
        loads[pipe.b] = add(loads[pipe.b], f + m)
        loads[pipe.a] = add(loads[pipe.a], [*f, *add(m, back)], -1)
    loads[0] = add(loads[0], u[0], mpf(k))
    return loads
