"""Stored modes and response spectra judged again, without a search for modes.

Every stored mode must satisfy K x = w2 M x on the deck's frozen structure, be mass-normalised and
orthogonal to the others; what follows from it must agree.  A response spectrum is combined again
from the stored modes.  Stiffness and mass are the program's own: unlike the certificate of a
case, this judges with the matrices that the solver had.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import F8, CaseResult, ModeSet, System, sizes
from trunnion.cases.dynamics import Dynamics
from trunnion.compare.claims import false_claim
from trunnion.compare.judgement import Verdict, has_numbers
from trunnion.compare.restored import moved
from trunnion.compare.stored import SHAPE
from trunnion.compare.written import far, written
from trunnion.errors import ModelError
from trunnion.frozen import frozen
from trunnion.model import Case
from trunnion.report.json_modes import mode_entries
from trunnion.solver.eigen import residuals
from trunnion.solver.mesh import Mesh
from trunnion.threads import one_thread

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run

LIMIT = 1e-9  # of a mode's residual
APART = 1e-8  # of x M x' from the unit matrix
FOLLOWS = ("frequency_hz", "period_s", "participation", "effective_mass", "effective_mass_percent",
           "effective_mass_sum_percent", "total_mass", "rigid", "added_nodes")  # fmt: skip
ANSWER = ("kind", "text", "nodes", "supports", "elements", "stresses")
Stored = Mapping[str, Any]


@frozen(eq=False)
class StoredModes:
    """The modes of a file, put on the mesh of the deck; see `cases.dynamics.Known`."""

    entry: Stored
    system: System

    @property
    def cut(self) -> float:
        """Cut-off of the mesh [Hz]."""
        cut = float(self.entry["mesh_hz"])
        if not 0.0 < cut < np.inf:
            raise ValueError(f"mesh_hz is {cut:g}")
        return cut

    def modes(self, mesh: Mesh) -> ModeSet:
        """Read the modes back."""
        e, n = self.entry, len(self.system.labels)
        m = len(e["frequency_hz"])
        if mesh.added != e["added_nodes"]:
            raise ValueError(f"{e['added_nodes']} added nodes, the deck has {mesh.added}")
        shape = np.zeros((m, n + mesh.added, 6))
        for i, by_label in enumerate(e["shapes"]):
            shape[i, :n] = [by_label[label] for label in self.system.labels]
        if mesh.added:
            shape[:, n:] = np.array(e["shapes_added"], np.float64)
        low = np.zeros_like(shape)
        if "shapes_low" in e:
            low += np.array(e["shapes_low"], np.float64)
        return ModeSet(
            system=mesh.system,
            frequency=np.array(e["frequency_hz"], np.float64),
            shape=shape,
            shape_low=low,
            participation=_table(e["participation"]),
            effective_mass=_table(e["effective_mass"]),
            total_mass=np.array(e["total_mass"], np.float64),
            residual=np.array([np.inf if x is None else x for x in e["residual"]], np.float64),
            rigid=int(e["rigid"]),
            added=mesh.added,
            part_of=mesh.part_of,
            last=mesh.last,
            proven=bool(e["proven"]),
            counted=float(e["counted_hz"]),
            cut=self.cut,
        )


def _table(rows: Sequence[Sequence[float]]) -> F8:
    return np.array(rows, np.float64).reshape(-1, 3)


@one_thread()
def judge_dynamics(
    run: "Run", report: Stored, spectra: Sequence[Case]
) -> tuple[Verdict, dict[str, Verdict]]:
    """Judge the modes, then every response spectrum case on them."""
    run.ledger.watch.begin("modes")
    about = run.model.modal.about if run.model.modal else None
    if about is not None and not has_numbers(run, about):
        return _neither(f"they stand on {about}, not judged", spectra)
    try:
        stored = report["modes"]
        if "shapes" not in stored:
            return _neither("the file has none", spectra)
        if "mesh_hz" not in stored:
            return _neither("the file does not have all of their numbers", spectra)
        dynamics = Dynamics(run, StoredModes(stored, run.system))
        if dynamics.modes is None:
            return _neither(str(dynamics.cause), spectra)
        verdict = _modes(dynamics, dynamics.modes, stored, run.system)
    except SHAPE as error:
        said = f"its tables do not fit the deck: {error!r}"
        _, none = _neither("the modes fail", spectra)
        return Verdict("modes", False, said), none
    if not verdict.passed:
        return verdict, _neither("the modes fail", spectra)[1]
    return verdict, {case.name: _guarded(run, dynamics, case, report) for case in spectra}


def _neither(why: str, spectra: Sequence[Case]) -> tuple[Verdict, dict[str, Verdict]]:
    told = {case.name: Verdict(case.name, None, f"modes: {why}") for case in spectra}
    return Verdict("modes", None, why), told


def _modes(dynamics: Dynamics, modes: ModeSet, stored: Stored, system: System) -> Verdict:
    """Judge the modes as eigenpairs, and what the file says follows from them."""
    pencil, m = dynamics.pencil, len(modes.frequency)
    x, low = (a.reshape(m, -1) for a in (modes.shape, modes.shape_low))
    residual = residuals(pencil, (2.0 * np.pi * modes.frequency) ** 2, x, low)
    image = pencil.mass_product(x)
    apart = np.abs(x @ image.T - np.eye(m)).max(axis=1, initial=0.0)
    for i in range(m):
        if not residual[i] <= max(LIMIT, 1.01 * modes.residual[i]):
            said = f"mode {i + 1}: |K x - w2 M x| is {residual[i]:.1e} of |w2 M x|"
            return Verdict("modes", False, said)
        if not apart[i] <= APART:
            said = f"mode {i + 1}: not mass-normalised, or not orthogonal to the others"
            return Verdict("modes", False, f"{said}: {apart[i]:.1e}")
    unit = np.tile(np.eye(6)[:3], modes.shape.shape[1])
    carried = pencil.mass_product(unit)
    participation = x @ carried.T
    again = replace(
        modes,
        participation=participation,
        effective_mass=participation**2,
        total_mass=np.einsum("ij,ij->i", unit, carried),
    )
    fault = far(json.loads(mode_entries(again, system)), stored, FOLLOWS)
    text = f"{m} eigenpairs, largest residual {residual.max(initial=0.0):.1e}"
    text += "; their count is taken from the file" if modes.proven else ""
    return Verdict("modes", not fault, fault or text)


def _guarded(run: "Run", dynamics: Dynamics, case: Case, report: Stored) -> Verdict:
    run.ledger.watch.begin(case.name)
    stored = report["cases"][case.name]
    if not stored["converged"]:
        return Verdict(case.name, None, f"no numbers: {stored.get('cause')}")
    try:
        return _spectrum(run, dynamics, case, stored)
    except (*SHAPE, ModelError) as error:
        return Verdict(case.name, False, f"its tables do not fit the deck: {error!r}")


def _spectrum(run: "Run", dynamics: Dynamics, case: Case, stored: Stored) -> Verdict:
    """Combine the stored modes again; what stands on the case takes the numbers of the file."""
    (found,) = dynamics.spectra([case])
    if found.state is None:
        return Verdict(case.name, False, str(found.cause))
    again, supports = written(found), stored["supports"]
    fault = far(again, stored, ANSWER)
    fault = fault or false_claim(found.certificate, stored)
    if fault:
        return Verdict(case.name, False, fault)
    run.found[case.name] = _restored(found, stored, supports)
    text = "the same from the stored modes"
    if case.spectrum is not None and case.spectrum.missing_mass:
        text += "; the static part of the missing mass was solved again"
    return Verdict(case.name, True, text)


def _restored(found: CaseResult, stored: Stored, supports: Sequence[Stored]) -> CaseResult:
    """The case with the numbers of the file, to their last digit."""
    assert found.state is not None
    u, low, ends = moved(stored, found.system)
    card = np.array([s["force"] + s["moment"] for s in supports], np.float64).reshape(-1, 6)
    local = [[e["local_from"], e["local_to"]] for e in stored["elements"]]
    gathered = sizes(card, np.array(local, np.float64).reshape(-1, 2, 6))
    state = replace(found.state, u=u, u_low=low, end_force=ends)
    return replace(found, state=state, gathered=gathered)
