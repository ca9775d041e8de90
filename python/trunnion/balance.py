"""Sums over the whole system: applied loads, support reactions, and end forces in local axes."""

import numpy as np

from trunnion.arrays import F8, CaseResult, Loads, System
from trunnion.deformation import load_moment
from trunnion.interior import section_axes
from trunnion.supports import solved


def load_sum(system: System, loads: Loads) -> F8:
    """(6,) sum of the applied loads, moments about the origin [N, N m].

    Hanger loads are support forces and not in it.
    """
    weight = loads.dist * system.length[:, None]
    start = system.xyz[system.ends[:, 0]]
    about = np.cross(start, weight) + load_moment(system, loads.dist.T).T
    total: F8 = loads.nodal.sum(axis=0)
    total[:3] += weight.sum(axis=0)
    total[3:] += np.cross(system.xyz, loads.nodal[:, :3]).sum(axis=0) + about.sum(axis=0)
    return total


def reaction_sum(case: CaseResult) -> F8:
    """(6,) sum of the support forces on the pipe, moments about the origin [N, N m].

    A support on another node (CNODE) pushes both ways and cancels.
    """
    system, state = case.system, solved(case)
    contacts, sliders = system.contacts, system.sliders
    total = np.zeros(6)
    for force, node, cnode, turning in (
        (state.reaction, contacts.node, contacts.cnode, contacts.rotational),
        (state.friction, sliders.node, sliders.cnode, np.zeros(len(sliders.mu), bool)),
    ):
        grounded = cnode < 0
        total[3:] += force[turning & grounded].sum(axis=0)
        push = np.where(turning[:, None], 0.0, force)
        total[:3] += push[grounded].sum(axis=0)
        total[3:] += np.cross(system.xyz[node], push).sum(axis=0)
        total[3:] -= np.cross(system.xyz[cnode[~grounded]], push[~grounded]).sum(axis=0)
    return total


def end_axes(system: System) -> F8:
    """(n_elem, 2, 3, 3) rows ex ey ez at both ends; ex is the pipe's tangent there."""
    every = np.arange(len(system.kind))
    ends = [section_axes(system, every, np.full(len(every), end)) for end in (0.0, 1.0)]
    return np.stack(ends, axis=1)


def case_local_forces(case: CaseResult) -> F8:
    """(n_elem, 2, 6) end forces in the axes of each end; of an envelope its own largest values."""
    if case.envelope is not None:
        return case.envelope.local_force
    return local_forces(case.system, solved(case).end_force)


def local_forces(system: System, end_force: F8) -> F8:
    """(n_elem, 2, 6) end forces and moments on the elements in the axes of each end."""
    split = end_force.reshape(-1, 2, 2, 3)
    turned: F8 = np.einsum("eaij,eafj->eafi", end_axes(system), split)
    return turned.reshape(-1, 2, 6)
