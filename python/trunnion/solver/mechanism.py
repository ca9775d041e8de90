"""Motions that nothing resists, found as null vectors of the tangent and named for the user."""

from dataclasses import dataclass

import numpy as np

from trunnion.arrays import F8, System
from trunnion.solver.newton import proximal_factor
from trunnion.solver.quantities import Response
from trunnion.solver.structure import Structure

BLOCK = 8  # vectors iterated together
ITERATIONS = 12
ROUND_OFF = 1e-24  # energy of a null motion, of the largest stiffness
RITZ, RESOLVED = 3, 1e-12  # energies below this part of the largest are taken apart once more
AXES = "XYZ"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Motion:
    """A motion without energy: `text` is for the user, `v` (n_node, 6) its shape."""

    text: str
    v: F8


def null_motions(structure: Structure, tangent: F8, slider_tangent: F8) -> list[Motion]:
    """Motions that these tangents do not resist: inverse iteration, energy at round-off.

    A small pivot or a poor condition number is not enough to call a line a mechanism: long
    flexible lines have both.  The energy of the motion is: it is formed from deformations, so
    that it vanishes to round-off squared for a true mechanism only.
    """
    structure = structure.full
    proximal_factor(structure, tangent, slider_tangent)
    n = structure.n_node
    count = min(BLOCK, 6 * n)
    v = np.random.default_rng(1).normal(size=(count, n, 6))
    v[:, structure.absent] = 0.0
    for _ in range(ITERATIONS):
        v = _orthonormal(structure.solve(v))
    stiffest = max(structure.scale, float(structure.contacts.k.max(initial=0.0)))
    for _ in range(RITZ):
        value, v = _ritz(structure, tangent, slider_tangent, v)
        near = np.abs(value) <= RESOLVED * float(np.abs(value).max(initial=0.0))
        if near.all() or not near.any():
            break
        value, v = value[near], v[near]
    null = np.abs(value) <= ROUND_OFF * stiffest * 6 * n
    if not null.any():
        return []
    return _named([Motion(describe(structure.system, x), x) for x in _separate(v[null])])


def _named(motions: list[Motion]) -> list[Motion]:
    """Give the six motions of a line that nothing holds one name."""
    of: dict[str, list[Motion]] = {}
    for motion in motions:
        who = motion.text.partition(" turns ")[0].partition(" moves ")[0]
        of.setdefault(who, []).append(motion)
    named = []
    for who, own in of.items():
        every = Motion(f"{who} moves freely in all six ways: no restraint holds it", own[0].v)
        named += [every] if len(own) == 6 else own
    return named


def _ritz(structure: Structure, tangent: F8, slider_tangent: F8, v: F8) -> tuple[F8, F8]:
    """Energies of the span of v and its shapes without coupling; exact to eps of the largest."""
    image = np.stack([structure.product(tangent, slider_tangent, x) for x in v])
    energy = np.einsum("ani,bni->ab", v, image)
    value, turn = np.linalg.eigh(0.5 * (energy + energy.T))
    return value, np.einsum("ab,ani->bni", turn, v)


def _orthonormal(v: F8) -> F8:
    q, _ = np.linalg.qr(v.reshape(len(v), -1).T)
    out: F8 = np.ascontiguousarray(q.T).reshape(v.shape)
    return out


def _separate(shapes: F8) -> F8:
    """Turn null vectors so that each moves as few freedoms as possible (row echelon form)."""
    rows = shapes.reshape(len(shapes), -1).copy()
    for i in range(len(rows)):
        _, column = np.unravel_index(np.argmax(np.abs(rows[i:])), rows[i:].shape)
        pivot = i + int(np.argmax(np.abs(rows[i:, column])))
        rows[[i, pivot]] = rows[[pivot, i]]
        rows[i] /= rows[i, column]
        for j in range(len(rows)):
            if j != i:
                rows[j] -= rows[j, column] * rows[i]
    return rows.reshape(shapes.shape)


def describe(system: System, v: F8) -> str:
    """Name a motion: which nodes, and along or about which axis."""
    travel = np.abs(v[:, :3]).max(axis=1)
    turn = np.abs(v[:, 3:]).max(axis=1)
    size = max(float(np.ptp(system.xyz, axis=0).max(initial=0.0)), 1.0)
    moving = np.flatnonzero(np.maximum(travel, turn * size) > 1e-6 * max(travel.max(), turn.max()))
    labels = [system.labels[i] for i in moving]
    who = f"node {labels[0]}" if len(labels) == 1 else f"line {labels[0]}-{labels[-1]}"
    omega = v[moving, 3:].mean(axis=0)
    slide = v[moving, :3].mean(axis=0)
    reach = float(np.ptp(system.xyz[moving], axis=0).max(initial=0.0))
    if np.linalg.norm(omega) * max(reach, 1e-3 * size) > 1e-6 * np.linalg.norm(slide):
        return f"{who} turns about {_direction(omega)}: no restraint holds it"
    return f"{who} moves along {_direction(slide)}: no restraint holds it"


def _direction(a: F8) -> str:
    a = a / np.linalg.norm(a)
    k = int(np.argmax(np.abs(a)))
    if abs(a[k]) > 0.9999:
        return AXES[k]
    a = np.where(np.abs(a) < 1e-6, 0.0, a * np.sign(a[k]))
    return "({:.3g},{:.3g},{:.3g})".format(*a)


def structural_motions(structure: Structure) -> list[Motion]:
    """Motions left with every contact closed and every support stuck: errors of the input."""
    return null_motions(structure, structure.closed_tangent, structure.stuck_tangent)


def motions_at(structure: Structure, response: Response) -> list[Motion]:
    """Motions undetermined at an answer, where contacts are open or slide."""
    return null_motions(structure, response.tangent, response.slider_tangent)
