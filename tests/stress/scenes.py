"""Scenes at random: nothing is chosen but what a user might write."""

from pipes import ZERO, Beam, Pipe, Rest, Scene, log_uniform, model_of, pipes_of

import numpy as np
from mpmath import mpf

KINDS = ("tree", "tree", "grid", "rests only", "lifting", "far away", "soft", "nothing")


def random_scene(seed: int) -> Scene:
    """The scene of a seed."""
    rng = np.random.default_rng(seed)
    kind = str(KINDS[rng.integers(len(KINDS))])
    n = int(rng.integers(1, 12))
    pipes = _grid(rng) if kind == "grid" else pipes_of(rng, n)
    nodes = 1 + max(max(p.a, p.b) for p in pipes)
    shear, k = bool(rng.integers(2)), log_uniform(rng, 1e8, 1e16)
    density = 0.0 if kind == "nothing" else float(rng.choice([0.0, 7850.0]))
    strain = 0.0 if kind == "nothing" else float(rng.choice([0.0, 0.001, 0.1]))
    anchored = kind not in ("rests only", "soft")
    rests = _supports(rng, nodes, kind)
    loads = [[0.0] * 6 for _ in range(nodes)]
    if kind != "nothing":
        for node in rng.choice(nodes, min(nodes, 2), replace=False):
            force = rng.normal(size=3) * log_uniform(rng, 1.0, 1e6)
            loads[node][:3] = [float(x) for x in force]
            if kind == "lifting":
                loads[node][1] = abs(loads[node][1]) * 1e3
    if kind == "nothing":
        loads = [[0.0] * 6 for _ in range(nodes)]
    at = (1e6, -1e6, 1e6) if kind == "far away" else (0.0, 0.0, 0.0)
    model = model_of(
        f"Random scene {seed}: {kind}", pipes, rests, loads, strain=strain, shear=shear, k=k,
        density=density, anchored=anchored, at=at,
    )  # fmt: skip
    weightless = not density and (strain or any(map(any, loads)))
    weight = 0.0 if weightless else (density or 1.0)  # a case needs a load: W of next to nothing
    beams = [Beam(pipe, 0.3, shear, weight) for pipe in pipes]
    friction = any("MU" in rest.keys for rest in rests)
    return Scene(seed, kind, model, [], rests, pipes, beams, loads, mpf(strain), k, friction)


def _grid(rng: np.random.Generator) -> list[Pipe]:
    """A lattice with closed loops; its coordinates are exact in doubles."""
    across, along = (int(x) for x in rng.integers(2, 4, 2))
    step, od, e = 2.0 ** int(rng.integers(-8, 8)), log_uniform(rng, 0.01, 3.0), 2e11
    number = np.arange(across * along).reshape(across, along)
    wall = max(0.0005, 0.05 * od)
    pipes = []
    for i in range(across):
        for j in range(along):
            if j:
                delta = np.array([step, 0.0, 0.0])
                pipes.append(Pipe(int(number[i, j - 1]), int(number[i, j]), delta, od, wall, e))
            if i:
                delta = np.array([0.0, 0.0, step])
                pipes.append(Pipe(int(number[i - 1, j]), int(number[i, j]), delta, od, wall, e))
    return sorted(pipes, key=lambda p: (max(p.a, p.b), min(p.a, p.b)))


def _supports(rng: np.random.Generator, nodes: int, kind: str) -> list[Rest]:
    rests = []
    for node in range(0 if kind in ("rests only", "soft") else 1, nodes):
        if rng.random() < 0.3 and kind != "rests only":
            continue
        words = ["+Y"] if kind in ("rests only", "lifting") or rng.random() < 0.6 else ["X", "Z"]
        if kind == "soft":
            words = ["X", "Y", "Z"]
        for word in words:
            keys: dict[str, object] = {}
            if kind == "soft":
                keys["K"] = log_uniform(rng, 1.0, 1e6)
            elif rng.random() < 0.3:
                keys["K"] = log_uniform(rng, 1e8, 1e16)
            if kind not in ("soft", "rests only") and rng.random() < 0.4:
                keys["GAP"] = float(rng.choice([0.0, 1e-9, 0.001, 0.01, 1.0]))
            if kind != "soft" and rng.random() < 0.6:
                keys |= {"MU": float(rng.choice([0.1, 0.3, 1.0, 2.0]))}
                keys |= {"KF": log_uniform(rng, 1e4, 1e12)}
            rests.append(Rest(node, word, keys, [ZERO] * 3, "free"))
    return rests
