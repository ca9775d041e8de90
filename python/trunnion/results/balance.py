"""Sums over the whole system: applied loads, support reactions, and end forces in local axes."""

import numpy as np

from trunnion.arrays import F8, CaseResult, Loads, System
from trunnion.certificate.deformation import load_moment
from trunnion.results.interior import section_axes
from trunnion.results.supports import card_forces


def load_sum(system: System, loads: Loads) -> F8:
    """(6,) sum of the applied loads, moments about the origin [N, N m].

    Hanger loads are support forces and not in it.
    """
    weight = loads.dist * system.length[:, None]
    start = system.xyz[system.ends[:, 0]]
    about = np.cross(start, weight) + load_moment(system, loads.dist.T, loads.vary).T
    total: F8 = loads.nodal.sum(axis=0)
    total[:3] += weight.sum(axis=0)
    total[3:] += np.cross(system.xyz, loads.nodal[:, :3]).sum(axis=0) + about.sum(axis=0)
    return total


def reaction_sum(case: CaseResult) -> F8:
    """(6,) sum of the support forces on the pipe, moments about the origin [N, N m].

    A support on another node (CNODE) pushes both ways and cancels.
    """
    system, force = case.system, card_forces(case)
    number = {label: i for i, label in enumerate(system.labels)} | system.alias
    total = np.zeros(6)
    at = [number[card.label] for card in system.cards]
    other = [(i, number[card.cnode]) for i, card in enumerate(system.cards) if card.cnode]
    total += force.sum(axis=0)
    total[3:] += np.cross(system.xyz[at], force[:, :3]).sum(axis=0)
    if other:
        cards, nodes = np.array(other).T
        total -= force[cards].sum(axis=0)
        total[3:] -= np.cross(system.xyz[nodes], force[cards, :3]).sum(axis=0)
    return total


def end_axes(system: System) -> F8:
    """(n_elem, 2, 3, 3) rows ex ey ez at both ends; ex is the pipe's tangent there."""
    every = np.arange(len(system.kind))
    ends = [section_axes(system, every, np.full(len(every), end)) for end in (0.0, 1.0)]
    return np.stack(ends, axis=1)


def local_forces(system: System, end_force: F8) -> F8:
    """(n_elem, 2, 6) end forces and moments on the elements in the axes of each end."""
    split = end_force.reshape(-1, 2, 2, 3)
    turned: F8 = np.einsum("eaij,eafj->eafi", end_axes(system), split)
    return turned.reshape(-1, 2, 6)


def local_end_forces(case: CaseResult) -> F8:
    """(n_elem, 2, 6) end forces of a case in the axes of each end."""
    if case.gathered is not None and case.gathered.local_force is not None:
        return case.gathered.local_force
    assert case.state is not None
    return local_forces(case.system, case.state.end_force)


def section_forces(case: CaseResult) -> F8:
    """(n_elem, 2, 6) forces of the sections at both ends, in their axes; tension positive."""
    if case.gathered is not None and case.gathered.section_force is not None:
        return case.gathered.section_force
    force: F8 = local_end_forces(case) * np.array([-1.0, 1.0])[:, None]
    return force
