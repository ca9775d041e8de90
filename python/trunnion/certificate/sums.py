"""The certificate of weighted sums of certified answers, where no contact can change.

All laws are linear there, so the errors of a sum are at most the weighted sum of the errors of its
parts, and the rounding of the sum.  What they are measured against is read off the sum's own
numbers at the few places where its parts are largest, which is never too much.  That numbers and
loads are the sum is an item of its own (`sum`), by scattered checksums (Freivalds 1977).  So every
item is an upper bound of what `certify` finds from the same numbers, but for its round-off.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8, Certificate, Item, Loads, State, System
from trunnion.certificate.deformation import columns
from trunnion.certificate.elements import ALONG, SHAPE, ElementErrors, own_deformations, rows
from trunnion.certificate.items import number, verdict
from trunnion.certificate.scales import Scale, largest, measure_each

ROUNDING = 16.0 * 2.0**-53  # of the largest number, of a sum or a product of a few
MATCH = 1e-13  # of all sizes summed: checksums of rounded numbers agree so far
WRONG = 1.0
_HALVES = slice(0, 3), slice(3, 6)
_LAWS = {  # what an item of the certificate is measured against
    "finite": (),
    "equilibrium": ("force", "moment"),
    "element_balance": ("force", "moment"),
    "element_law": ("stretch", "swing", "force"),
    "contact_law": ("length", "angle"),
    "contact_state": ("force", "moment"),
    "correction_u": ("travel",),
    "correction_r": ("push", "torque"),
}
_CORRECTED = ("travel", "push", "torque")
Corrected = tuple[float, float, float]  # displacement, force and moment of supports


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Part:
    """A certified answer of which sums are made.

    size : by name what its errors are measured against [N, N m, m, rad].
    most : the same of its largest numbers, of which rounding is a part.
    elements, nodes, contacts : where it is largest.
    checks : checksums of its arrays; sums : of the sizes in them.
    """

    certificate: Certificate
    size: dict[str, float]
    most: dict[str, float]
    elements: frozenset[int]
    nodes: frozenset[int]
    contacts: frozenset[int]
    checks: F8
    sums: F8


def part(
    system: System,
    loads: Loads,
    state: State,
    examined: tuple[Certificate, Scale, ElementErrors],
    solver: Corrected,
) -> Part:
    """Take what sums need from an answer.

    Parameters
    ----------
    examined : what `certificate.examine` gives.
    solver : what the solver's corrections are measured against.
    """
    certificate, scale, found = examined
    end = columns(state.end_force.reshape(-1, 6))
    push = np.abs(state.reaction).max(axis=1, initial=0.0)
    force = max(largest(end[:3]), largest(push), largest(loads.nodal))
    force = max(force, largest(columns(loads.dist) * system.length))
    moment = largest(end[3:]) + largest(system.length) * force
    moved = columns(state.u)
    most = {"force": force, "moment": moment}
    most |= {"length": largest(moved[:3]), "angle": largest(moved[3:])}
    across, turned = np.maximum(found.across, found.own.max(axis=1))
    carried = most["angle"] * largest(system.length)  # of which a deformation is the rest
    most |= {"stretch": float(across) + carried, "swing": float(turned)}
    size = {"force": scale.force, "moment": scale.moment}
    size |= {"length": scale.length, "angle": scale.angle}
    size |= dict(zip(_CORRECTED, solver, strict=True))
    size |= {"stretch": found.length, "swing": found.angle}
    stiff = np.where(system.rigidity[:, 0] > 0.0, system.rigidity[:, 0], np.inf)
    turning = system.contacts.rotational
    return Part(
        certificate,
        size,
        most,
        frozenset(int(np.argmax(row)) for row in (*found.own, -stiff)),
        frozenset(int(np.abs(moved[half]).argmax()) % len(state.u) for half in _HALVES),
        frozenset(int(np.argmax(push * way)) for way in (turning, ~turning) if push.size),
        _checksums([loads], [state])[0],
        np.array([np.abs(a).sum() for a in _arrays(loads, state)]),
    )


def certify_sums(
    system: System,
    loads: Sequence[Loads],
    states: Sequence[State],
    factors: F8,
    parts: Sequence[Part],
    solver: Sequence[Corrected],
) -> list[Certificate]:
    """Judge weighted sums of certified answers.

    Parameters
    ----------
    loads, states : numbers of the sums.
    factors : (n_sum, n_part) weights.
    solver : of every sum, as in `part`.
    """
    with np.errstate(all="ignore"):  # numbers that are none show in the items
        sizes = _sizes(system, loads, states, parts)
        sizes |= dict(zip(_CORRECTED, np.array(solver).T, strict=True))
        checked = _checked(loads, states, factors, parts)
        weights = np.abs(factors)
        bounds = [_bounds(i, parts, weights, sizes) for i in range(len(parts[0].certificate.items))]
    return [
        verdict([Item("sum", float(checked[c]), ""), *(items[c] for items in bounds)])
        for c in range(len(states))
    ]


def _bounds(i: int, parts: Sequence[Part], weights: F8, sizes: dict[str, F8]) -> list[Item]:
    """Item i of every sum."""
    given = [p.certificate.items[i] for p in parts]
    name, values = given[0].name, np.array([item.value for item in given])
    bound = np.zeros(len(weights))
    for against in _LAWS[name]:
        errors = [
            item.value * p.size[against] + ROUNDING * p.most.get(against, 0.0)
            for item, p in zip(given, parts, strict=True)
        ]
        size = sizes[against]
        share = (weights * errors).sum(axis=1)
        own = np.where(size > 0.0, share / size, np.where(share > 0.0, np.inf, 0.0))
        bound = np.maximum(bound, own)
    first = (weights * values).argmax(axis=1)
    return [Item(name, number(b), given[k].where) for b, k in zip(bound, first, strict=True)]


def _sizes(
    system: System, loads: Sequence[Loads], states: Sequence[State], parts: Sequence[Part]
) -> dict[str, F8]:
    """What errors of the sums are measured against: at least this much."""
    elements = _union(p.elements for p in parts)
    ends, contacts = system.ends[elements].ravel(), _union(p.contacts for p in parts)
    nodes = np.concatenate((ends, _union(p.nodes for p in parts)))
    turning = replace(system.contacts, rotational=system.contacts.rotational[contacts])
    some = replace(system, contacts=turning, **rows(system, SHAPE, elements))
    few = [
        (
            replace(own, nodal=own.nodal[nodes], **rows(own, ALONG, elements)),
            replace(
                state,
                u=state.u[nodes],
                u_low=state.u_low[nodes],
                end_force=state.end_force[elements],
                reaction=state.reaction[contacts],
            ),
        )
        for own, state in zip(loads, states, strict=True)
    ]
    scales = measure_each(some, *zip(*few, strict=True))
    found = {
        name: np.array([getattr(scale, name) for scale in scales])
        for name in ("force", "moment", "length", "angle")
    }
    stretch, swing = _deformations(some, system.xyz[ends], few).max(axis=2)
    return found | {
        "stretch": np.maximum(stretch, 1e-3 * swing),
        "swing": np.maximum(swing, 1e-3 * stretch),
    }


def _deformations(some: System, xyz: F8, few: Sequence[tuple[Loads, State]]) -> F8:
    """(2, n_sum, n) deformations of some elements of every sum, in one go [m, rad]."""
    n, m = len(few), len(some.kind)
    once = {name: getattr(some, name) for name in SHAPE}
    every: dict[str, Any] = {
        name: np.tile(a, (n,) + (1,) * (a.ndim - 1)) for name, a in once.items() if len(a)
    }
    every["ends"] = np.arange(2 * n * m).reshape(-1, 2)
    system = replace(some, xyz=np.tile(xyz, (n, 1)), **every)
    along: dict[str, Any] = {
        name: np.concatenate([getattr(own, name) for own, _ in few]) for name in ALONG
    }
    loads = replace(few[0][0], **along)
    state = replace(
        few[0][1],
        u=np.concatenate([s.u[: 2 * m] for _, s in few]),
        u_low=np.concatenate([s.u_low[: 2 * m] for _, s in few]),
        end_force=np.concatenate([s.end_force for _, s in few]),
    )
    return own_deformations(system, loads, state).reshape(2, n, m)


def _union(places: Iterable[frozenset[int]]) -> NDArray[np.intp]:
    every: set[int] = set().union(*places)
    return np.array(sorted(every), np.intp)


def _checked(
    loads: Sequence[Loads], states: Sequence[State], factors: F8, parts: Sequence[Part]
) -> F8:
    """Whether the numbers are the sums that they should be: 0, or `WRONG`."""
    due = factors @ np.stack([p.checks for p in parts])
    sizes = np.abs(factors) @ np.stack([p.sums for p in parts])
    same = np.abs(_checksums(loads, states) - due) <= MATCH * sizes
    return np.where(same.all(axis=1), 0.0, WRONG)


def _checksums(loads: Sequence[Loads], states: Sequence[State]) -> F8:
    """(n_state, 8) sums of all numbers with scattered weights."""
    most = max(a.size for a in _arrays(loads[0], states[0]))
    weights = np.arange(1, most + 1) * (0.5 * (5.0**0.5 - 1.0))
    weights -= np.floor(weights) + 0.5
    return np.array(
        [
            [a.ravel() @ weights[: a.size] for a in _arrays(own, state)]
            for own, state in zip(loads, states, strict=True)
        ]
    )


def _arrays(loads: Loads, state: State) -> tuple[F8, ...]:
    """Displacements, forces and what causes them."""
    causes = loads.dist, loads.strain, loads.curvature, loads.nodal, loads.base
    return state.u, state.end_force, state.reaction, *causes
