"""Jobs for other programs, so that somebody else's solver can confirm an answer.

`build_job` takes a solved model apart; `files` writes it for one program, `FORMATS` are those
that it can be written for.
"""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module

import numpy as np

from trunnion.arrays import F8, SPRING, CaseResult, Results, System
from trunnion.cases.default_cases import with_cases
from trunnion.errors import Problem
from trunnion.exports.refusals import ExportError, chosen_cases
from trunnion.exports.scene import Scene, build_scene, stand
from trunnion.frozen import frozen
from trunnion.model import Case, Model
from trunnion.origin import origin_lines

FORMATS: Mapping[str, str] = {
    "opensees": "trunnion.exports.opensees",
    "calculix": "trunnion.exports.calculix",
}


@frozen(eq=False)
class Job:
    """What is written: the scene, words on top, and what was left out."""

    scene: Scene
    title: str
    source: str
    notes: tuple[str, ...]
    left_out: tuple[Problem, ...]


def build_job(
    model: Model,
    results: Results,
    cases: Sequence[str] = (),
    *,
    program: str = "opensees",
    permissive: bool = False,
) -> Job:
    """Choose the cases for a program and say what of them is carried over.

    Raises
    ------
    ExportError
        Cases that cannot be written, unless `permissive` leaves them out; or none is left.
    """
    model = with_cases(model)
    chosen, problems = chosen_cases(model, results, cases, finds=program == "opensees")
    if problems and not (permissive and chosen):
        raise ExportError(problems)
    if not chosen:
        raise ExportError([Problem("cases", "there is no case to write")])
    steps = {case.name: _steps(model, case) for case in chosen}
    scene = build_scene(results.system, _moduli(model, results.system), chosen, steps)
    source = model.file.name if model.file else model.origin.file if model.origin else "a model"
    return Job(scene, results.title, source, tuple(_notes(model, scene)), tuple(problems))


def files(job: Job, program: str, stem: str) -> dict[str, bytes]:
    """Write a job for one of `FORMATS`: contents by name of the file."""
    make: Callable[[Job, str], dict[str, bytes]] = import_module(FORMATS[program]).files
    return make(job, stem)


def _steps(model: Model, case: CaseResult) -> int:
    """Steps in which a case loads the pipe where it lies; 0 where it begins after another.

    So it is 0 where steps were cut, at events or because one step found no answer.
    """
    card = next((c for c in model.cases if isinstance(c, Case) and c.name == case.name), None)
    steps = 1 if card is None else card.steps
    events = card.events if card is not None and card.events is not None else model.settings.events
    later = card is not None and card.start is not None
    cut = steps == 1 and case.state is not None and bool(case.state.datum.any())
    return 0 if events or later or cut else steps


def _moduli(model: Model, system: System) -> tuple[F8, F8]:
    """E and G (n_elem,) [Pa]; 1 for springs."""
    rows = [model.materials[pipe.material] for pipe in model.pipes]
    young = np.array([*(m.e for m in rows), 1.0])[system.source]
    shear = np.array([*(0.5 * m.e / (1.0 + m.nu) for m in rows), 1.0])[system.source]
    springs = system.kind == SPRING
    return np.where(springs, 1.0, young), np.where(springs, 1.0, shear)


def _notes(model: Model, scene: Scene) -> list[str]:
    """What a reader must know of the cases."""
    notes = [] if model.origin is None else origin_lines(model.origin)[1:]
    for case in scene.cases:
        found = stand(case)
        modes = [rub.mode for rub in found.rubs]
        if modes:
            counts = ", ".join(f"{modes.count(m)} {m}" for m in ("stick", "slip", "open"))
            notes.append(f"{case.name}: friction is held as Trunnion found it ({counts})")
        if found.rings:
            n = len(found.rings)
            what = "1 gap all round a pipe is" if n == 1 else f"{n} gaps all round pipes are"
            notes.append(f"{case.name}: {what} held")
    by_name = {case.name: case for case in model.cases}
    for case in scene.cases:
        card = by_name.get(case.name)
        frozen_of = getattr(card, "about", None) or getattr(card, "on", None)
        if frozen_of:
            notes.append(f"{case.name}: linear, on the contacts that {frozen_of} left closed")
    beside = [what for what, there in (("CYCLE", model.cycles), ("MODES", model.modal)) if there]
    if beside:
        notes.append(f"not carried over: {', '.join(beside)}")
    return notes
