"""Supports that move: participation of a group, its static influence, and shapes' own forces."""

from dataclasses import dataclass, replace

import numpy as np

from trunnion.arrays import B1, F8, ModeSet, System
from trunnion.results.balance import local_forces
from trunnion.results.supports import contact_sums
from trunnion.solver.inertia import element_inertia
from trunnion.solver.pencil import Pencil
from trunnion.solver.quantities import Point
from trunnion.solver.structure import Structure


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Answers:
    """What several displacements at once do, item first, on the model's nodes and elements.

    u : (m, n_node, 6).  end_force, local_force : (m, n_elem, 2, 6).  reaction : (m, n_contact, 3).
    card_force : (m, n_card, 6).
    """

    u: F8
    end_force: F8
    local_force: F8
    reaction: F8
    card_force: F8


def recover(pencil: Pencil, modes: ModeSet, system: System, u: F8, low: F8, inertia: F8) -> Answers:
    """End forces and support forces of displacements u + low (m, n_node, 6).

    Parameters
    ----------
    pencil : of the modes' system, which may have extra nodes.
    inertia : (m, n_node, 6) what M takes to the loads that make these displacements.
    system : the model's; elements that were cut show the two ends that it has.
    """
    n_node, n_elem = len(system.labels), len(system.kind)
    structure = pencil.structure
    inside = element_inertia(pencil, inertia)
    ends, reactions = [], []
    for high, rest, own in zip(u, low, inside, strict=True):
        point = Point(np.ascontiguousarray(high), np.ascontiguousarray(rest))
        _, end, response = structure.residual(point, structure.frictionless(), structure.still)
        end = end - own
        ends.append(np.stack([end[:n_elem, 0], end[modes.last, 1]], axis=1))
        reactions.append(response.reaction[: len(system.contacts.k)])
    m = len(u)
    end_force = np.array(ends).reshape(m, n_elem, 2, 6)
    reaction = np.array(reactions).reshape(m, len(system.contacts.k), 3)
    local = [local_forces(system, force) for force in end_force]
    cards = [contact_sums(system, force) for force in reaction]
    return Answers(
        u=u[:, :n_node],
        end_force=end_force,
        local_force=np.array(local).reshape(end_force.shape),
        reaction=reaction,
        card_force=np.array(cards).reshape(m, len(system.cards), 6),
    )


def moving(system: System, nodes: set[int]) -> B1:
    """(n_contact,) supports on ground at some nodes; what stands on other nodes goes with them."""
    c = system.contacts
    found: B1 = np.isin(c.node, sorted(nodes)) & (c.cnode < 0) & ~c.rotational
    return found


def participation(moves: B1, direction: int, frequency: F8, reaction: F8) -> F8:
    """(m,) participation phi . M r of supports that move together [kg^0.5].

    With r the static displacements for a unit movement of those supports, K r is the sum of
    their k n (n . d), so that phi . M r = phi . K r / omega^2 is minus the force of the supports
    on the shape along the movement, over omega^2: no static solution is needed.

    Parameters
    ----------
    moves : (n_contact,) the supports that move.
    reaction : (m, n_contact, 3) support forces on the mass-normalised shapes.
    """
    found: F8 = -reaction[:, moves, direction].sum(axis=1) / (2.0 * np.pi * frequency) ** 2
    return found


def influence(structure: Structure, moves: B1 | None, direction: int) -> F8:
    """(n_node, 6) static displacements for a unit movement of supports; None: of everything."""
    n_node = structure.n_node
    if moves is None:
        r = np.zeros((n_node, 6))
        r[:, direction] = 1.0
        return r
    base = np.zeros_like(structure.still.base)
    base[: len(moves)][moves, direction] = 1.0
    law, forcing = structure.frictionless(), replace(structure.still, base=base)
    force, _, _ = structure.residual(Point.zero(n_node), law, forcing)
    hold(structure)
    return structure.solve(force)


def hold(structure: Structure) -> None:
    """Have the factor of the stiffness ready."""
    still = structure.still
    _, _, response = structure.residual(
        Point.zero(structure.n_node), structure.frictionless(), still
    )
    structure.factorise(response.tangent, response.slider_tangent)
