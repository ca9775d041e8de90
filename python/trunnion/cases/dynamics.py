"""MODES and response spectra of a run: the frozen structure, its masses, and who asks for what."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Protocol

import numpy as np

from trunnion.arrays import OPEN, CaseResult, ModeSet, State, System
from trunnion.cases.spectrumcase import SpectrumPass
from trunnion.loads.masses import model_masses
from trunnion.model import Case, Modes
from trunnion.solver.locked import frozen_system
from trunnion.solver.mesh import Mesh
from trunnion.solver.modal import modes_of, pencil_of, with_friction
from trunnion.solver.quantities import Point
from trunnion.solver.structure import Structure

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run


class Known(Protocol):
    """Modes that were found before: the cut-off of their mesh, and themselves on it."""

    @property
    def cut(self) -> float:
        """Cut-off of the mesh [Hz]."""

    def modes(self, mesh: Mesh) -> ModeSet:
        """Give the modes on a mesh."""


DEFAULT = Modes(33, fmax=33.0)  # what a spectrum case takes where the deck asks for no modes


class Dynamics:
    """Modes about the frozen state of one case, snubbers locked, and the spectra on them.

    `cause` tells why there are none: the case they stand on has no answer.

    Parameters
    ----------
    known : gives modes that were found before, on their K and M; None: they are searched for.
    """

    def __init__(self, run: "Run", known: "Known | None" = None) -> None:
        self.run = run
        self.card = run.model.modal or DEFAULT
        self.cause: str | None = None
        self.modes: ModeSet | None = None
        structure, state = self._about()
        if state is None:
            self.cause = f"MODES ABOUT={self.card.about}: {self.card.about} has no answer"
            return
        system = structure.system
        self.frozen, keep = frozen_system(system, state, snubbers=True)
        frozen = self.frozen
        if self.card.friction > 0.0:
            frozen, keep = with_friction(system, state, frozen, keep, self.card.friction)
        masses, ledger = model_masses(run.model, system), run.ledger
        if known is None:
            self.modes, self.pencil = modes_of(frozen, masses, self.card, ledger, structure, keep)
        else:
            cut = known.cut
            mesh, pencil = pencil_of(frozen, masses, self.card, ledger, cut, structure, keep)
            self.modes, self.pencil = known.modes(mesh), pencil

    def _about(self) -> tuple[Structure, State | None]:
        """The structure and the state that is frozen; without ABOUT= the pipe at rest."""
        if self.card.about is None:
            structure = self.run.structure_of("")
            return structure, state_at_rest(structure)
        about = self.run.found[self.card.about]
        structure = next(s for s in self.run.structures.values() if s.system is about.system)
        return structure, about.state

    def spectra(self, cases: list[Case]) -> Iterator[CaseResult]:
        """Solve the response spectrum cases; they share the modes and the forces of shapes."""
        if self.modes is None:
            yield from (self._refused(case) for case in cases)
            return
        solver = SpectrumPass(self.run.model, self.frozen, self.modes, self.pencil)
        for case in cases:
            yield solver.solve(case)

    def _refused(self, case: Case) -> CaseResult:
        return CaseResult(
            name=case.name,
            kind="case",
            text="",
            system=self.run.system,
            loads=None,
            state=None,
            converged=False,
            cause=self.cause,
        )


def state_at_rest(structure: Structure) -> State:
    """Contacts of the undeformed pipe: closed where the gap is zero, nothing carried."""
    law = structure.frictionless()
    nothing = np.zeros((structure.n_node, 6))
    response = structure.respond(Point.zero(structure.n_node), law, structure.still, nothing)
    system: System = structure.system
    contacts, sliders = len(system.contacts.k), len(system.sliders.mu)
    flat = np.zeros((sliders, 3))
    return State(
        u=np.zeros((len(system.labels), 6)),
        u_low=np.zeros((len(system.labels), 6)),
        end_force=np.zeros((len(system.ends), 2, 6)),
        side=response.side[:contacts],
        reaction=response.reaction[:contacts],
        friction=flat,
        mode=np.full(sliders, OPEN, np.int32),
        normal=np.zeros(sliders),
        slide=flat,
        datum=flat,
        datum_end=flat,
    )
