"""Loads of expansion joints, cold spring, and uniform loads on lengths of pipe."""

from math import pi

import numpy as np

from trunnion.arrays import F8, SPRING, System
from trunnion.loads.weights import WATER
from trunnion.model import Model


def joint_weights(model: Model, system: System) -> dict[str, F8]:
    """Weight (n_node,) of expansion joints and their contents in W, WNC, WW: half at each end [N].

    The contents fill the bore of the section over the length of the joint.
    """
    n = len(system.xyz)
    found = {name: np.zeros(n) for name in ("WNC", "W", "WW")}
    for e, i in _joints(model, system):
        pipe = model.pipes[i]
        section = model.sections[pipe.section]
        bore = section.od - 2.0 * (section.wall + section.lining)
        room = model.settings.g * 0.25 * pi * bore**2 * float(system.length[e])
        for name, density in (("WNC", 0.0), ("W", section.fluid), ("WW", WATER)):
            found[name][system.ends[e]] += 0.5 * (pipe.weight + density * room)
    return found


def thrusts(model: Model, system: System) -> dict[str, F8]:
    """Pressure thrust (n_node, 6) of expansion joints by P set: P area, ends pushed apart [N]."""
    found: dict[str, F8] = {}
    for e, i in _joints(model, system):
        pipe = model.pipes[i]
        assert pipe.joint is not None
        for name, pressure in pipe.operation.p.items() if pipe.joint.area else ():
            push = pressure * pipe.joint.area * system.axes[e, 0]
            nodal = found.setdefault(name, np.zeros((len(system.xyz), 6)))
            nodal[system.ends[e, 0], :3] -= push
            nodal[system.ends[e, 1], :3] += push
    return found


def cold_spring(model: Model, system: System) -> F8 | None:
    """Free strain (n_elem,) of set CS: what is cut short (or long) over the length of its element.

    None where nothing is cut.  A pipe that leads into a bend is cut in its straight part.
    """
    cut = np.array([*(pipe.cut for pipe in model.pipes), 0.0])
    if not cut.any():
        return None
    straight = np.array([part.type != "bend" for part in system.parts], bool)
    own = np.where(straight, cut[system.source], 0.0)
    strain: F8 = -own / np.where(system.length > 0.0, system.length, 1.0)
    return strain


def uniform_loads(model: Model, system: System, weight: F8) -> dict[str, F8]:
    """Uniform loads (n_elem, 3) of sets Q1 to Q9 per length of axis [N/m].

    Parameters
    ----------
    weight : (n_elem,) W per length, on which loads in g stand [N/m].
    """
    found: dict[str, F8] = {}
    pipes = (system.source >= 0) & (system.kind != SPRING)
    for which in sorted({q.set for pipe in model.pipes for q in pipe.uniform}):
        rows = np.zeros((2, len(model.pipes) + 1, 3))
        for i, pipe in enumerate(model.pipes):
            for q in pipe.uniform:
                if q.set == which:
                    rows[int(q.in_g), i] += q.load
        plain, in_g = rows[:, system.source] * pipes[:, None]
        found[f"Q{which}"] = plain + weight[:, None] * in_g
    return found


def _joints(model: Model, system: System) -> list[tuple[int, int]]:
    """Elements that are expansion joints, with their pipes."""
    at = np.flatnonzero((system.kind == SPRING) & (system.source >= 0))
    own = [(e, int(system.source[e])) for e in at.tolist()]
    return [(e, i) for e, i in own if model.pipes[i].joint is not None]
