"""The HDF5 report: whole arrays with labels, enough to judge the certificate again.

The layout is docs/hdf5_layout.md.  No times are stored: the same results give the same bytes.
"""

from collections.abc import Sequence
from dataclasses import fields
from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np

from trunnion.arrays import CaseResult, CycleResult, ModeSet, Results, System
from trunnion.model import Model
from trunnion.origin import Origin
from trunnion.report.loops import step_names
from trunnion.results.balance import local_end_forces
from trunnion.results.stresses import end_stresses
from trunnion.results.supports import (
    STATES,
    card_forces,
    card_ids,
    card_levels,
    cause_of,
    envelope,
    is_good,
    solved,
)
from trunnion.results.tables import element_ids

if TYPE_CHECKING:
    import h5py

SCHEMA = 1


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Write the file; all that it holds of the model stands in the results."""
    return {f"{stem}.h5": hdf5_report(results, model.origin)}


def hdf5_report(results: Results, origin: Origin | None = None) -> bytes:
    """Write the whole file.

    Parameters
    ----------
    origin : the foreign file that the model came from, and what of it is not in the numbers.
    """
    import h5py

    stream = BytesIO()
    with h5py.File(stream, "w") as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["title"] = results.title
        _words(file, "case_names", list(results.cases))
        _words(file, "warnings", results.warnings)
        if origin is not None:
            _words(file, "left_out", [str(entry) for entry in origin.left_out])
            _words(file, "assumed", [str(entry) for entry in origin.assumed])
        _model(file.create_group("model"), results.system)
        cases = file.create_group("cases")
        for name, case in results.cases.items():
            _case(cases.create_group(name), case, results.system)
        _envelope(file.create_group("envelope"), results)
        cycles = file.create_group("cycles")
        for name, cycle in results.cycles.items():
            _cycle(cycles.create_group(name), cycle)
        if results.modes is not None:
            _modes(file.create_group("modes"), results.modes)
    return stream.getvalue()


def _words(group: "h5py.Group", name: str, texts: Sequence[str | None]) -> None:
    """Store text as UTF-8 of one length, that of the longest."""
    import h5py

    coded = [(text or "").encode() for text in texts]
    length = max((len(text) for text in coded), default=0) or 1
    group.create_dataset(name, data=np.array(coded, h5py.string_dtype("utf-8", length)))


def _model(group: "h5py.Group", system: System) -> None:
    """Labels and the numbered model that the cases' arrays refer to."""
    nodes = group.create_group("nodes")
    _words(nodes, "label", system.labels)
    nodes["xyz"] = system.xyz
    _words(nodes, "alias", list(system.alias))
    nodes["alias_of"] = np.array(list(system.alias.values()), np.int32)

    parts, elements = system.parts, group.create_group("elements")
    _words(elements, "id", element_ids(parts))
    _words(elements, "type", [part.type for part in parts])
    _words(elements, "section", [part.section for part in parts])
    _words(elements, "material", [part.material for part in parts])
    for name in ("ends", "kind", "axes", "length", "radius", "angle", "rigidity", "flex", "spring"):
        elements[name] = getattr(system, name)

    cards, supports = system.cards, group.create_group("supports")
    _words(supports, "id", card_ids(cards))
    _words(supports, "name", [card.name for card in cards])
    _words(supports, "kind", [card.kind for card in cards])
    _words(supports, "node", [card.label for card in cards])
    _words(supports, "cnode", [card.cnode for card in cards])
    supports["line"] = np.array([card.line for card in cards], np.int32)

    _supports(group, system)


def _supports(group: "h5py.Group", system: System) -> None:
    """Contacts and sliders; snubbers are those that static cases do not see."""
    for name, record in (
        ("contacts", system.contacts),
        ("sliders", system.sliders),
        ("snubbers", system.snubbers),
    ):
        inner = group.create_group(name)
        for field in fields(record):
            value = getattr(record, field.name)
            if isinstance(value, tuple):
                _words(inner, field.name, value)
            else:
                inner[field.name] = value


def _case(group: "h5py.Group", case: CaseResult, base: System) -> None:
    """One case; what is not certified has its cause and no numbers.

    A case on other contacts than the model's (frozen, snubbers locked) or another modulus brings
    its own.
    """
    good, found = is_good(case), case.certificate
    group.attrs["kind"], group.attrs["text"] = case.kind, case.text
    group.attrs["converged"] = good
    if not good:
        group.attrs["cause"] = cause_of(case)
    if found is not None:
        inner = group.create_group("certificate")
        inner.attrs["passed"], inner.attrs["inherited"] = found.passed, found.inherited
        inner.attrs["worst"], inner.attrs["where"] = found.worst, found.where
        _words(inner, "item", [item.name for item in found.items])
        _words(inner, "where", [item.where for item in found.items])
        inner["value"] = np.array([item.value for item in found.items], np.float64)
    for name, counts in (("work", case.work), ("penalty_effect", case.penalty_effect)):
        inner = group.create_group(name)
        for key, value in counts.items():
            inner.attrs[key] = value
    _words(group, "warnings", case.warnings)
    if not good:
        return
    _numbers(group, case)
    if case.system.contacts is not base.contacts:
        _supports(group, case.system)
    if case.system.rigidity is not base.rigidity:
        group["rigidity"] = case.system.rigidity
    if case.frozen_check:
        broken = group.create_group("frozen_check")
        broken["support"] = np.array([b.card for b in case.frozen_check], np.int32)
        _words(broken, "dir", [b.word for b in case.frozen_check])
        _words(broken, "what", [b.what for b in case.frozen_check])
        broken["amount"] = np.array([b.amount for b in case.frozen_check], np.float64)


def _numbers(group: "h5py.Group", case: CaseResult) -> None:
    state = solved(case)
    inner = group.create_group("state")
    for field in fields(state):
        inner[field.name] = getattr(state, field.name)
    if case.loads is not None:
        inner = group.create_group("loads")
        for field in fields(case.loads):
            inner[field.name] = getattr(case.loads, field.name)
    group["local_force"] = local_end_forces(case)
    group["support_force"] = card_forces(case)
    if case.gathered is None:
        group["support_state"] = card_levels(case).astype(np.int8)
        group["support_state"].attrs["words"] = ",".join(STATES)
    element, *ends = end_stresses(case)
    inner = group.create_group("stress")
    inner["element"] = element.astype(np.int32)
    for field in fields(ends[0]):
        inner[field.name] = np.column_stack([getattr(end, field.name) for end in ends])


def _envelope(group: "h5py.Group", results: Results) -> None:
    """Extremes of the support loads; the cases as rows of /case_names, -1: none."""
    at = [i for i, case in enumerate(results.cases.values()) if is_good(case)]
    if not at:
        return
    cases = list(results.cases.values())
    found, number = envelope([cases[i] for i in at]), np.array([*at, -1], np.int32)
    group["max"], group["max_case"] = found.highest, number[found.highest_case]
    group["min"], group["min_case"] = found.lowest, number[found.lowest_case]


def _cycle(group: "h5py.Group", cycle: CycleResult) -> None:
    """One cycle: ranges, and the support loads after every step."""
    group.attrs["cases"] = ", ".join(cycle.cases)
    group.attrs["loops"], group.attrs["repeats"] = cycle.loops, cycle.repeats
    group.attrs["change"] = cycle.change
    if cycle.cause:
        group.attrs["cause"] = cycle.cause
    for name in ("supports", "elements", "one_shot_supports", "one_shot_elements"):
        value = getattr(cycle, name)
        if value is not None:
            group[name] = value
    _words(group, "step", step_names(cycle))
    if cycle.path:
        group["path"] = np.stack([card_forces(step) for step in cycle.path])


def _modes(group: "h5py.Group", modes: ModeSet) -> None:
    """Natural modes; nodes added between those of the model follow them."""
    _words(group, "node", modes.system.labels)
    group["shape"] = modes.shape + modes.shape_low
    for name in ("frequency", "participation", "effective_mass", "total_mass", "residual"):
        group[name] = getattr(modes, name)
    for name in ("rigid", "added", "proven", "counted"):
        group.attrs[name] = getattr(modes, name)
