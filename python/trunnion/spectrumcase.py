"""Response spectrum cases: from modes and shocks to displacements, forces and support loads."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from trunnion.arrays import BOTH, F8, CaseResult, Certificate, Loads, State, System, sizes
from trunnion.balance import local_forces
from trunnion.errors import ModelError, Problem
from trunnion.model import Case, Group, Shock, Spectrum, SpectrumUse
from trunnion.solver.spectrum import Drive, amplitudes, combine, missed, zero_period
from trunnion.solver.structure import Point, Sliding, Structure
from trunnion.supports import contact_sums

AXES = {"X": 0, "Y": 1, "Z": 2}

# What a shock's inertia does statically: displacements (n_node, 6) under M r for given r.
Rigid = Callable[[F8], F8]


class Modal(Protocol):
    """Modes as a spectrum takes them: mass-normalised, of a held structure.

    frequency : (m,) [Hz]; shape : (m, n_node, 6); participation : (m, 3) phi . M r [kg^0.5].
    """

    frequency: F8
    shape: F8
    participation: F8


@dataclass(frozen=True, slots=True)
class Answers:
    """Responses to several displacements at once, item first.

    u : (m, n_node, 6).  end_force, local_force : (m, n_elem, 2, 6).  reaction : (m, n_contact, 3).
    card_force : (m, n_card, 6).
    """

    u: F8
    end_force: F8
    local_force: F8
    reaction: F8
    card_force: F8


NAMES = ("u", "end_force", "local_force", "reaction", "card_force")


def spectrum_case(
    case: Case,
    structure: Structure,
    modes: Modal,
    spectra: dict[str, Spectrum],
    groups: Sequence[Group] = (),
    rigid: Rigid | None = None,
    certificate: Certificate | None = None,
) -> CaseResult:
    """Solve one response spectrum case.

    Parameters
    ----------
    structure : the frozen structure that the modes belong to.
    rigid : static displacements under the inertia M r of unit acceleration; needed for the
        missing mass.
    certificate : of the modes; the case inherits it.

    Raises
    ------
    ModelError
        The structure is not held, or a group names a node without support.
    """
    use = case.spectrum
    if use is None:
        raise ValueError(f"{case.name} is no response spectrum case")
    if not (modes.frequency > 0.0).all():
        text = f"CASE {case.name}: the structure moves freely (modes of 0 Hz), a spectrum needs"
        raise ModelError([Problem(case.place, f"{text} it held")])
    shapes = recover(structure, modes.shape)
    pushed = [_participation(case, s, structure.system, modes, shapes, groups) for s in use.shocks]
    left = _left_out(structure, modes, shapes, use, spectra, pushed, rigid)
    found = {name: _largest(name, modes, shapes, use, spectra, pushed, left) for name in NAMES}
    system = structure.system
    return CaseResult(
        name=case.name,
        kind="spectrum",
        text=spectrum_text(use),
        system=system,
        loads=_no_loads(system),
        state=_state(system, found),
        converged=True,
        certificate=certificate and replace(certificate, inherited=True),
        linear=False,
        gathered=sizes(found["card_force"], found["local_force"]),
    )


def recover(structure: Structure, shapes: F8) -> Answers:
    """End forces and support forces of displaced shapes (m, n_node, 6), without loads."""
    n, s = len(structure.sliders.mu), structure.system
    law = Sliding(np.zeros(n), structure.sliders.kf, np.zeros(n), np.zeros((n, 3)))
    ends, reactions = [], []
    for shape in shapes:
        point = Point(np.ascontiguousarray(shape), np.zeros_like(shape))
        _, end, response = structure.residual(point, law, structure.still)
        ends.append(end)
        reactions.append(response.reaction[: len(s.contacts.k)])
    m = len(shapes)
    end_force = np.array(ends).reshape(m, -1, 2, 6)
    reaction = np.array(reactions).reshape(m, -1, 3)
    return Answers(
        u=shapes,
        end_force=end_force,
        local_force=np.array([local_forces(s, f) for f in end_force]).reshape(end_force.shape),
        reaction=reaction,
        card_force=np.array([contact_sums(s, r) for r in reaction]).reshape(m, -1, 6),
    )


def group_participation(
    system: System, nodes: set[int], direction: int, frequency: F8, reaction: F8
) -> F8:
    """(m,) participation of the supports at some nodes that move together [kg^0.5].

    With r the static displacements for a unit movement of those supports, K r is the sum of
    their k n (n . d), so that phi . M r = phi . K r / omega^2 is minus the force of the supports
    on the shape along the movement, over omega^2.
    """
    c = system.contacts
    moves = np.isin(c.node, sorted(nodes)) & (c.cnode < 0) & ~c.rotational
    found: F8 = -reaction[:, moves, direction].sum(axis=1) / (2.0 * np.pi * frequency) ** 2
    return found


def group_influence(structure: Structure, nodes: set[int], direction: int) -> F8:
    """(n_node, 6) static displacements for a unit movement of the supports at some nodes."""
    c, s = structure.contacts, structure.system
    moves = np.isin(c.node, sorted(nodes)) & (c.cnode < 0) & ~c.rotational
    base = np.zeros((len(c.node), 3))
    base[moves, direction] = 1.0
    n = len(structure.sliders.mu)
    law = Sliding(np.zeros(n), structure.sliders.kf, np.zeros(n), np.zeros((n, 3)))
    forcing = replace(structure.still, base=base)
    r, _, response = structure.residual(Point.zero(len(s.labels)), law, forcing)
    structure.factorise(response.tangent, response.slider_tangent)
    return structure.solve(r)


def spectrum_text(use: SpectrumUse) -> str:
    """The case as on its card: "SPECTRUM(SSE,X) + SPECTRUM(SSE,Y,0.667,UPPER)"."""
    return " + ".join(_shock_text(shock) for shock in use.shocks)


def _shock_text(shock: Shock) -> str:
    words = [shock.spectrum, shock.direction]
    if shock.factor != 1.0 or shock.group:
        words.append(f"{shock.factor:g}")
    return f"SPECTRUM({','.join([*words, *filter(None, [shock.group])])})"


def _participation(
    case: Case,
    shock: Shock,
    system: System,
    modes: Modal,
    shapes: Answers,
    groups: Sequence[Group],
) -> tuple[F8, set[int] | None]:
    """Participation of one shock, and the nodes of its group; None for uniform motion."""
    axis = AXES[shock.direction]
    if shock.group is None:
        return modes.participation[:, axis], None
    group = next((g for g in groups if g.name == shock.group), None)
    if group is None:
        text = f"CASE {case.name}: group {shock.group} is not defined"
        raise ModelError([Problem(case.place, text)])
    nodes = _supported(group, system)
    return group_participation(system, nodes, axis, modes.frequency, shapes.reaction), nodes


def _supported(group: Group, system: System) -> set[int]:
    """Node numbers of a group; every one must have a support on ground."""
    index = {label: i for i, label in enumerate(system.labels)} | system.alias
    grounded = set(system.contacts.node[system.contacts.cnode < 0].tolist())
    without = [node for node in group.nodes if index.get(node) not in grounded]
    if without:
        text = f"GROUP {group.name}: no support stands at {', '.join(without)}"
        raise ModelError([Problem(group.place, text)])
    return {index[node] for node in group.nodes}


def _left_out(
    structure: Structure,
    modes: Modal,
    shapes: Answers,
    use: SpectrumUse,
    spectra: dict[str, Spectrum],
    pushed: list[tuple[F8, set[int] | None]],
    rigid: Rigid | None,
) -> Answers | None:
    """What each shock does to the mass that the modes leave out; an item a shock."""
    if not use.missing_mass:
        return None
    if rigid is None:
        raise ValueError("the missing mass needs the static response to inertia")
    moves = []
    for shock, (gamma, nodes) in zip(use.shocks, pushed, strict=True):
        axis = AXES[shock.direction]
        if nodes is None:
            influence = np.zeros((structure.n_node, 6))
            influence[:, axis] = 1.0
        else:
            influence = group_influence(structure, nodes, axis)
        zpa = zero_period(shock, spectra[shock.spectrum], use.zpa)
        flat = shapes.u.reshape(len(gamma), -1)
        part = missed(rigid(influence).ravel(), flat, modes.frequency, gamma, zpa)
        moves.append(part.reshape(-1, 6))
    return recover(structure, np.array(moves))


def _largest(
    name: str,
    modes: Modal,
    shapes: Answers,
    use: SpectrumUse,
    spectra: dict[str, Spectrum],
    pushed: list[tuple[F8, set[int] | None]],
    left: Answers | None,
) -> F8:
    """Combine one kind of answer over all shocks."""
    modal = getattr(shapes, name)
    drives = []
    for i, (shock, (gamma, _)) in enumerate(zip(use.shocks, pushed, strict=True)):
        spectrum = spectra[shock.spectrum]
        drives.append(
            Drive(
                shock.direction,
                amplitudes(spectrum, shock.factor, modes.frequency, gamma),
                None if left is None else getattr(left, name)[i].ravel(),
            )
        )
    found = combine(modal.reshape(len(modal), -1), modes.frequency, drives, use)
    return found.reshape(modal.shape[1:])


def _state(system: System, found: dict[str, F8]) -> State:
    """A state of largest values; the supports of a frozen structure all hold both ways."""
    n_contact, n_slider = len(system.contacts.k), len(system.sliders.mu)
    return State(
        u=found["u"],
        u_low=np.zeros_like(found["u"]),
        end_force=found["end_force"],
        side=np.full(n_contact, BOTH, np.int32),
        reaction=found["reaction"],
        friction=np.zeros((n_slider, 3)),
        mode=np.zeros(n_slider, np.int32),
        normal=np.zeros(n_slider),
        slide=np.zeros((n_slider, 3)),
        datum=np.zeros((n_slider, 3)),
        datum_end=np.zeros((n_slider, 3)),
    )


def _no_loads(system: System) -> Loads:
    n_elem, n_node, n_card = len(system.kind), len(system.labels), len(system.cards)
    return Loads(
        dist=np.zeros((n_elem, 3)),
        strain=np.zeros(n_elem),
        curvature=np.zeros(n_elem),
        nodal=np.zeros((n_node, 6)),
        base=np.zeros((n_card, 6)),
        preload=np.zeros(n_card),
        pressure=np.zeros(n_elem),
    )
