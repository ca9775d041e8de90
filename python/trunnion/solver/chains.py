"""Chains: runs of elements between supports, branches and ends, condensed to their two ends.

Nothing inside such a run can change its state, so the iteration need not see it: a chain is a
cantilever like every element (`fortran/chains.f90`), with a stiffness, a free deformation and a
load resultant at its tip.  What is inside follows from statics and the members' own laws when
an answer is reported.
"""

from dataclasses import dataclass, replace

import numpy as np

from trunnion import kernels
from trunnion.arrays import B1, F8, I4, SPRING, Contacts, Sliders, System
from trunnion.forms import forms

APART = 1e5  # ratio of bending stiffnesses EI/L³ at a node at which a chain ends
LONGEST = 64  # elements of a chain: its forces are carried from end to end, so round-off grows


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Chains:
    """Elements in chains from kept node to kept node.

    kept : (n_kept,) nodes of the model that stay, ascending.
    place : (n_node + 1,) number of a node among the kept ones; -1 inside chains, and at the end
        for the ground, whose number is -1.
    first : (n_chain + 1,) members of chain c are first[c] to first[c + 1].
    element, flip : (n_elem,) element of a member, and 1 where it runs from its second end to its
        first.
    far : (n_elem,) node at a member's far end.
    base : (n_chain,) node at a chain's base.
    ends : (n_chain, 2) base and tip, numbers among the kept nodes.
    f : (n_elem, 6, 6) tip flexibilities of the elements that may join.
    """

    kept: I4
    place: I4
    first: I4
    element: I4
    flip: I4
    far: I4
    base: I4
    ends: I4
    f: F8

    @property
    def alone(self) -> I4:
        """Chains of one element."""
        return np.flatnonzero(np.diff(self.first) == 1).astype(np.int32)


def find_chains(system: System) -> Chains:
    """Chains of a system; nodes with contacts, sliders or snubbers stay."""
    n, rigid = len(system.labels), system.rigidity[:, :3]
    joins = (system.kind != SPRING) & (system.length > 0.0)
    joins &= (rigid > 0.0).all(axis=1) & (system.flex > 0.0)
    keep = np.zeros(n, np.int32)
    held = (system.contacts, system.sliders, system.snubbers)
    for nodes in (part for item in held for part in (item.node, item.cnode)):
        keep[nodes[nodes >= 0]] = 1
    ends = np.ascontiguousarray(system.ends, np.int32)
    may = joins.astype(np.int32)
    kernels.keep_uneven(ends, may, system.rigidity, system.length, APART, keep)
    count, first, element, flip, far = kernels.link_chains(ends, may, LONGEST, keep)
    first = np.ascontiguousarray(first[: count + 1])
    kept = np.flatnonzero(keep).astype(np.int32)
    place = np.full(n + 1, -1, np.int32)
    place[kept] = np.arange(len(kept), dtype=np.int32)
    start, last = first[:-1], first[1:] - 1
    lead = element[start]
    base = np.where(flip[start] == 1, ends[lead, 1], ends[lead, 0])
    joined = np.ascontiguousarray(np.column_stack((place[base], place[far[last]])))
    f = _flexibilities(system, joins)
    return Chains(kept, place, first, element, flip, far, base, joined, f)


def _flexibilities(s: System, joins: B1) -> F8:
    """Tip flexibility of the elements that may join; zero of the rest."""
    form = forms(s)
    if joins.all():
        return kernels.tip_flexibility(s.kind, form, s.rigidity, s.flex)
    at, f = np.flatnonzero(joins), np.zeros((len(joins), 6, 6))
    if len(at):
        form, rigidity, flex = (np.ascontiguousarray(a[at]) for a in (form, s.rigidity, s.flex))
        f[at] = kernels.tip_flexibility(s.kind[at], form, rigidity, flex)
    return f


def at_kept_nodes(system: System, chains: Chains) -> tuple[Contacts, Sliders, Contacts]:
    """Contacts, sliders and snubbers with the numbers of the kept nodes."""
    place, c, s, b = chains.place, system.contacts, system.sliders, system.snubbers
    return (
        replace(c, node=place[c.node], cnode=place[c.cnode]),
        replace(s, node=place[s.node], cnode=place[s.cnode]),
        replace(b, node=place[b.node], cnode=place[b.cnode]),
    )
