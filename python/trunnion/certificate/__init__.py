"""The certificate: whether reported numbers are an answer, checked from the numbers alone.

Imports no kernel and nothing of the solver.  Every item is the largest relative error of one law;
at most `LIMIT` passes, NaN counts as inf.  Relative to what (`scales`): forces to the largest
support force or non-thermal load, moments to the largest moment (or that force times 1 cm),
displacements to the largest displacement, deformations to the largest deformation, rotations
apart.  A quantity that is only the round-off of a larger kin is measured against a small part of
the kin (`floor`), and one that has no kin at all against 1 N, 1 N m, 1 m, 1 rad.
"""

import math

import numpy as np

from trunnion.arrays import Certificate, Item, Loads, State, System
from trunnion.certificate import contactlaw
from trunnion.certificate.deformation import columns
from trunnion.certificate.elements import ElementErrors, element_errors
from trunnion.certificate.items import (
    LIMIT,
    contact,
    element,
    item,
    node,
    number,
    six,
    slider,
    verdict,
)
from trunnion.certificate.scales import Scale, measure

__all__ = ["LIMIT", "certify", "examine"]


def certify(
    system: System, loads: Loads, state: State, *, correction_u: float, correction_r: float
) -> Certificate:
    """Check the numbers of one case.

    Parameters
    ----------
    correction_u, correction_r : next consistent correction of displacements and of reactions,
        relative to the largest, as the solver found it.
    """
    return examine(system, loads, state, (correction_u, correction_r))[0]


def examine(
    system: System, loads: Loads, state: State, corrections: tuple[float, float]
) -> tuple[Certificate, Scale, ElementErrors]:
    """Check the numbers of one case; also give what they were measured against."""
    with np.errstate(all="ignore"):  # numbers that are none show in the items
        scale = measure(system, loads, state)
        elements = element_errors(system, loads, state, scale)
        contacts = contactlaw.contact_errors(system, loads, state, scale)
        sliders = contactlaw.slider_errors(system, loads, state, scale)
        on_contact, on_slider, on_element = contact(system), slider(system), element(system)
        items = [
            _finite(system, state),
            _equilibrium(system, loads, state, scale),
            item("element_balance", elements.balance, on_element),
            item("element_law", elements.law, on_element),
            *(item(name, error, on_contact) for name, error in contacts.items()),
            *(item(name, error, on_slider) for name, error in sliders.items()),
            Item("correction_u", number(corrections[0]), ""),
            Item("correction_r", number(corrections[1]), ""),
        ]
    return verdict(items), scale, elements


def _finite(system: System, state: State) -> Item:
    """Nothing reported may be NaN or infinite."""
    at_node, at_element = node(system), element(system)
    at_contact, at_slider = contact(system), slider(system)
    for name, array, where in (
        ("u", state.u, at_node),
        ("u_low", state.u_low, at_node),
        ("end_force", state.end_force, at_element),
        ("reaction", state.reaction, at_contact),
        ("friction", state.friction, at_slider),
        ("normal", state.normal, at_slider),
        ("slide", state.slide, at_slider),
        ("datum", state.datum, at_slider),
        ("datum_end", state.datum_end, at_slider),
    ):
        if not math.isfinite(float(array.sum())):
            rows = ~np.isfinite(array.reshape(len(array), -1)).all(axis=1)
            return Item("finite", math.inf, f"{where(int(np.argmax(rows)))} ({name})")
    return Item("finite", 0.0, "")


def _equilibrium(system: System, loads: Loads, state: State, scale: Scale) -> Item:
    """Support forces and nodal loads less reported end forces are zero at every node."""
    contacts, sliders = system.contacts, system.sliders
    push, moment = columns(state.reaction), np.zeros(state.reaction.T.shape)
    rubbing = columns(state.friction)
    if contacts.rotational.any():
        turning = contacts.rotational
        push, moment = np.where(turning, 0.0, push), np.where(turning, push, 0.0)
    nodes = [system.ends.ravel(), contacts.node, sliders.node]
    end = columns(state.end_force.reshape(-1, 6))
    forces = [-end[:3], push, rubbing]
    moments = [-end[3:], moment, np.zeros(rubbing.shape)]
    for cnode, force, torque in (
        (contacts.cnode, push, moment),
        (sliders.cnode, rubbing, np.zeros(rubbing.shape)),
    ):
        on = np.flatnonzero(cnode >= 0)
        if on.size:
            nodes.append(cnode[on])
            forces.append(-force[:, on])
            moments.append(-torque[:, on])
    at = np.concatenate(nodes)
    residual = columns(loads.nodal)
    parts = np.concatenate(forces, axis=1), np.concatenate(moments, axis=1)
    for i, part in enumerate((*parts[0], *parts[1])):
        residual[i] += np.bincount(at, part, len(system.labels))
    return item("equilibrium", six(residual, scale.force, scale.moment), node(system))
