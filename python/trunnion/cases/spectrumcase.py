"""Response spectrum cases: from modes and shocks to displacements, forces and support loads."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from trunnion.arrays import (
    B1,
    BOTH,
    F8,
    CaseResult,
    Certificate,
    Item,
    ModeSet,
    State,
    System,
    no_loads,
    sizes,
)
from trunnion.errors import ModelError, Problem
from trunnion.frozen import frozen
from trunnion.model import Case, Group, Model, Shock, SpectrumUse
from trunnion.solver.pencil import Pencil
from trunnion.solver.spectrum import Drive, amplitudes, combine, missed, zero_period
from trunnion.solver.structure import Structure
from trunnion.solver.supportmotion import (
    Answers,
    hold,
    influence,
    moving,
    participation,
    recover,
)
from trunnion.threads import one_thread

AXES = {"X": 0, "Y": 1, "Z": 2}
NAMES = ("u", "end_force", "local_force", "reaction", "card_force")
RESIDUAL = 1e-9  # of a mode whose forces may be reported
ENOUGH = 0.9  # part of the mass below which a case without missing mass warns


@frozen(eq=False)
class Push:
    """A shock with its participation (m,) and the supports that it moves; None: all."""

    shock: Shock
    participation: F8
    moves: B1 | None


@dataclass
class SpectrumPass:
    """The response spectrum cases of a run: they share modes, and the forces of their shapes.

    system : the frozen system of the model, without the extra nodes of the modes.
    pencil : stiffness and mass of the modes' own system.
    """

    model: Model
    system: System
    modes: ModeSet
    pencil: Pencil

    @property
    def structure(self) -> Structure:
        """The structure of the modes."""
        return self.pencil.structure

    @cached_property
    def shapes(self) -> Answers:
        """Forces of the mass-normalised shapes."""
        m = self.modes
        inertia = m.shape * ((2.0 * np.pi * m.frequency) ** 2)[:, None, None]
        return recover(self.pencil, m, self.system, m.shape, m.shape_low, inertia)

    @one_thread()
    def solve(self, case: Case) -> CaseResult:
        """Solve one response spectrum case.

        Raises
        ------
        ModelError
            The structure is not held, or a group names a node without support.
        """
        use = case.spectrum
        if use is None:
            raise ValueError(f"{case.name} is no response spectrum case")
        if not (self.modes.frequency > 0.0).all():
            text = f"CASE {case.name}: a spectrum needs a held structure, this one moves freely"
            raise ModelError([Problem(case.place, text)])
        pushes = [self._push(case, shock) for shock in use.shocks]
        left = self._left_out(use, pushes) if use.missing_mass else None
        found = {name: self._largest(name, use, pushes, left) for name in NAMES}
        certificate = mode_certificate(self.modes)
        remarks = _warnings(self.modes, use) + _below(self.modes, self.model, use)
        return CaseResult(
            name=case.name,
            kind="spectrum",
            text=spectrum_text(use),
            system=self.system,
            loads=no_loads(self.system),
            state=_state(self.system, found) if certificate.passed else None,
            converged=certificate.passed,
            cause=None if certificate.passed else f"{certificate.where} is not accurate",
            certificate=certificate,
            warnings=remarks + _unmoved(self.system, pushes),
            linear=False,
            gathered=sizes(found["card_force"], found["local_force"]),
        )

    def _push(self, case: Case, shock: Shock) -> Push:
        """Participation of one shock."""
        axis = AXES[shock.direction]
        if shock.group is None:
            return Push(shock, self.modes.participation[:, axis], None)
        group = next((g for g in self.model.groups if g.name == shock.group), None)
        if group is None:
            text = f"CASE {case.name}: group {shock.group} is not defined"
            raise ModelError([Problem(case.place, text)])
        moves = moving(self.system, _supported(group, self.system))
        gamma = participation(moves, axis, self.modes.frequency, self.shapes.reaction)
        return Push(shock, gamma, moves)

    def _left_out(self, use: SpectrumUse, pushes: list[Push]) -> Answers:
        """What each shock does to the mass that the modes leave out; an item a shock."""
        u, inertia = [], []
        for push in pushes:
            shock, modes = push.shock, self.modes
            r = influence(self.structure, push.moves, AXES[shock.direction])
            hold(self.structure)
            rigid = self.structure.solve(self.pencil.mass_product(r.reshape(1, -1))).ravel()
            flat = modes.shape.reshape(len(modes.shape), r.size)
            zpa = zero_period(shock, self.model.spectra[shock.spectrum], use.zpa)
            part = missed(rigid, flat, modes.frequency, push.participation, zpa)
            u.append(part.reshape(-1, 6))
            carried = np.tensordot(push.participation, modes.shape, axes=1)
            inertia.append(zpa * (r - carried))
        every = np.array(u)
        low = np.zeros_like(every)
        return recover(self.pencil, self.modes, self.system, every, low, np.array(inertia))

    def _largest(self, name: str, use: SpectrumUse, pushes: list[Push], left: Answers | None) -> F8:
        """Combine one kind of answer over all shocks."""
        modal: F8 = getattr(self.shapes, name)
        frequency, drives = self.modes.frequency, []
        for i, push in enumerate(pushes):
            spectrum = self.model.spectra[push.shock.spectrum]
            amplitude = amplitudes(spectrum, push.shock.factor, frequency, push.participation)
            rest = None if left is None else getattr(left, name)[i].ravel()
            drives.append(Drive(push.shock.direction, amplitude, rest))
        flat = modal.reshape(len(modal), math.prod(modal.shape[1:]))
        return combine(flat, frequency, drives, use).reshape(modal.shape[1:])


def mode_certificate(modes: ModeSet) -> Certificate:
    """How well the worst mode satisfies its equation."""
    if not len(modes.residual):
        return Certificate(True, 0.0, "no modes", (), inherited=True)
    i = int(np.argmax(modes.residual))
    worst, where = float(modes.residual[i]), f"mode {i + 1} at {modes.frequency[i]:.4g} Hz"
    item = Item("mode", worst, where)
    return Certificate(worst <= RESIDUAL, worst, where, (item,), inherited=True)


def spectrum_text(use: SpectrumUse) -> str:
    """The case as on its card: "SPECTRUM(SSE,X) + SPECTRUM(SSE,Y,0.667,UPPER)"."""
    return " + ".join(_shock_text(shock) for shock in use.shocks)


def _shock_text(shock: Shock) -> str:
    words = [shock.spectrum, shock.direction]
    if shock.factor != 1.0 or shock.group:
        words.append(f"{shock.factor:g}")
    return f"SPECTRUM({','.join([*words, *filter(None, [shock.group])])})"


def _supported(group: Group, system: System) -> set[int]:
    """Node numbers of a group; every one must have a support on ground."""
    index = {label: i for i, label in enumerate(system.labels)} | system.alias
    grounded = set(system.contacts.node[system.contacts.cnode < 0].tolist())
    without = [node for node in group.nodes if index.get(node) not in grounded]
    if without:
        text = f"GROUP {group.name}: no support stands at {', '.join(without)}"
        raise ModelError([Problem(group.place, text)])
    return {index[node] for node in group.nodes}


def _warnings(modes: ModeSet, use: SpectrumUse) -> tuple[str, ...]:
    """What may be missing from the combination: modes, and the mass that they do not carry."""
    found = []
    if not modes.proven:
        found.append("the count of modes is not proven: some may be missing from the combination")
    share = modes.effective_mass.sum(axis=0) / np.where(modes.total_mass > 0.0, modes.total_mass, 1)
    shaken = dict.fromkeys(shock.direction for shock in use.shocks)
    low = [f"{100 * share[AXES[d]]:.0f} % in {d}" for d in shaken if share[AXES[d]] < ENOUGH]
    if low and not use.missing_mass:
        found.append(f"the modes carry {', '.join(low)} of the mass; MISSING=ON adds the rest")
    return tuple(found)


def _below(modes: ModeSet, model: Model, use: SpectrumUse) -> tuple[str, ...]:
    """Say which spectra begin above the lowest mode; an end value above the last is the ZPA."""
    lowest = float(modes.frequency.min(initial=np.inf))
    spectra = [model.spectra[name] for name in dict.fromkeys(s.spectrum for s in use.shocks)]
    return tuple(
        f"mode 1 at {lowest:.4g} Hz lies below spectrum {spectrum.name}, whose value at "
        f"{spectrum.frequency[0]:.4g} Hz is taken"
        for spectrum in spectra
        if lowest < spectrum.frequency[0] * (1.0 - 1e-9)
    )


def _unmoved(system: System, pushes: list[Push]) -> tuple[str, ...]:
    """Say which groups hold nothing in the direction in which they are shaken."""
    return tuple(
        f"no support of group {push.shock.group} holds the pipe in {push.shock.direction}"
        for push in pushes
        if push.moves is not None
        and not (
            np.abs(system.contacts.normal[push.moves, :, AXES[push.shock.direction]]) > 1e-9
        ).any()
    )


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
