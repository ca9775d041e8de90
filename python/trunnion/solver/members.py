"""Members: what the equations see as elements, each described at its tip.

Every element of the model is one, or chains of elements are (`chains`): then the equations have
the kept nodes only, and `end_forces` finds what is inside the chains.
"""

from dataclasses import dataclass

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, I4, Loads, System
from trunnion.forms import forms, part_load, tip_vectors
from trunnion.solver.chains import Chains, find_chains
from trunnion.solver.quantities import Forcing, Inside, Point

SWEEPS = 6  # through a chain, until it closes


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Members:
    """Members of a system, and the elements they are made of.

    ends : (n_member, 2) node numbers of the equations.
    axes : (n_member, 3, 3), d : (n_member, 3) from base to tip [m], k : (n_member, 6, 6) tip
        stiffness in `axes`.
    form : (n_elem, 8) of elements, see `forms`.
    arm : (n_elem, 3) vector from end to end [m].
    chains : None where every element is a member.
    """

    ends: I4
    axes: F8
    d: F8
    k: F8
    form: F8
    arm: F8
    chains: Chains | None

    @property
    def elements(self) -> int:
        """Number of elements."""
        return len(self.arm)


def whole_members(system: System) -> Members:
    """Every element a member."""
    form = forms(system)
    arm = tip_vectors(system, form)
    k = _stiffness(system, form, arm)
    ends = np.ascontiguousarray(system.ends, np.int32)
    return Members(ends, system.axes, arm, k, form, arm, None)


def chain_members(system: System) -> Members:
    """Chains between supports, branches and ends; every element where there are none."""
    if not len(system.kind):
        return whole_members(system)
    chains = find_chains(system)
    n_chain = len(chains.base)
    if n_chain == len(system.kind):
        return whole_members(system)
    form = forms(system)
    arm = tip_vectors(system, form)
    k = np.zeros((n_chain, 6, 6))
    alone = chains.alone
    which = chains.element[chains.first[alone]]
    if len(which):
        k[alone] = _stiffness(system, form, arm, which)
    axes, d = kernels.chain_stiffness(
        chains.first, chains.element, chains.flip, chains.f, system.axes, arm, k
    )
    return Members(chains.ends, axes, d, k, form, arm, chains)


def same_joints(a: Members, b: Members) -> bool:
    """Tell whether members of two systems with the same ends join the same nodes."""
    if a.chains is None or b.chains is None:
        return a.chains is b.chains
    return np.array_equal(a.chains.kept, b.chains.kept) and np.array_equal(a.ends, b.ends)


def member_loads(members: Members, system: System, loads: Loads) -> tuple[F8, F8, F8, Inside]:
    """Free tip deformation, load resultant and nodal loads; and the loads inside the members."""
    if members.elements:
        free, resultant = kernels.element_loads(
            system.kind,
            members.form,
            system.rigidity,
            system.flex,
            system.axes,
            part_load(loads.dist, loads.vary, np.ones(members.elements)),
            loads.strain,
            loads.curvature,
        )
    else:
        free = resultant = np.zeros((0, 6))
    nodal = np.ascontiguousarray(loads.nodal)
    inside = Inside(free, resultant, nodal)
    c = members.chains
    if c is None:
        return free, resultant, nodal, inside
    free, resultant = kernels.chain_loads(
        c.first,
        c.element,
        c.flip,
        c.far,
        c.f,
        system.axes,
        members.arm,
        members.axes,
        free,
        resultant,
        nodal,
    )
    return free, resultant, nodal[c.kept], inside


def end_forces(
    members: Members,
    system: System,
    forcing: Forcing,
    point: Point,
    r: F8,
    bias: F8,
    most: int = SWEEPS,
) -> tuple[Point, F8]:
    """Displacements of all nodes and (n_elem, 2, 6) end forces, the latter taken off `r`.

    The law of a chain holds to the last digits here, however its stiffness was rounded.

    Parameters
    ----------
    bias : (n_member, 6) what rounding takes off the tip forces; kept from call to call.
    most : sweeps through a chain.
    """
    c = members.chains
    if c is None:
        return point, member_end_forces(members, forcing, point, r)
    whole = Point.zero(len(system.labels))
    whole.u[c.kept], whole.low[c.kept] = point.u, point.low
    inside = forcing.inside
    end = kernels.chain_end_forces(
        c.first,
        c.element,
        c.flip,
        c.far,
        c.base,
        c.place[:-1],
        c.f,
        system.axes,
        members.arm,
        members.k,
        members.axes,
        members.d,
        inside.free,
        inside.resultant,
        forcing.free,
        forcing.resultant,
        inside.nodal,
        most,
        bias,
        whole.u,
        whole.low,
        r,
    )
    return whole, end


def expand(members: Members, system: System, v: F8) -> F8:
    """Displacements of all nodes for those `v` of the equations, without loads (n_node, 6)."""
    if members.chains is None:
        return v
    six, every = np.zeros((len(members.ends), 6)), np.zeros((members.elements, 6))
    none = np.zeros((0, 3))
    inside = Inside(every, every, np.zeros((len(system.labels), 6)))
    still = Forcing(six, six, np.zeros_like(v), inside, none, none, none, 1.0)
    point, bias = Point(v, np.zeros_like(v)), np.zeros_like(six)
    return end_forces(members, system, still, point, np.zeros_like(v), bias, most=1)[0].u


def member_end_forces(members: Members, forcing: Forcing, point: Point, r: F8) -> F8:
    """(n_member, 2, 6) forces on the members at their ends, taken off `r`."""
    if not len(members.ends):
        return np.zeros((0, 2, 6))
    return kernels.element_end_forces(
        members.ends,
        members.axes,
        members.d,
        members.k,
        forcing.free,
        forcing.resultant,
        point.u,
        point.low,
        r,
    )


def _stiffness(s: System, form: F8, arm: F8, which: I4 | None = None) -> F8:
    """Tip stiffness of all elements or some, their own axes."""
    if which is None:
        return kernels.element_stiffness(s.kind, form, s.rigidity, s.flex, s.spring, s.axes, arm)
    form, rigidity, flex, spring, axes, arm = (
        np.ascontiguousarray(a[which]) for a in (form, s.rigidity, s.flex, s.spring, s.axes, arm)
    )
    return kernels.element_stiffness(s.kind[which], form, rigidity, flex, spring, axes, arm)
