"""The text report of a study: what varies, every variant, failures, envelopes; and the screen."""

from collections.abc import Sequence
from itertools import chain

import numpy as np

from trunnion.arrays import F8
from trunnion.many.study import Study
from trunnion.model import Model
from trunnion.origin import origin_lines
from trunnion.report.causes import in_units
from trunnion.report.columns import (
    PAGE,
    Column,
    chapter,
    headings,
    integers,
    numbers,
    section,
    table,
    words,
    wrapped,
)
from trunnion.report.counts import counted
from trunnion.report.origin import origin_text
from trunnion.report.proof import ledger_table
from trunnion.report.screen import PIPE, Room, messages
from trunnion.report.units import ReportUnits, report_units
from trunnion.results.supports import STATES

COMPONENTS = ("FX", "FY", "FZ", "MX", "MY", "MZ")
SHOWN = 8  # failures, and supports of the envelope, on the screen


def study_report(study: Study, model: Model) -> bytes:
    """Write the whole report."""
    units = report_units(model.units)
    parts = ["TRUNNION   study of variants\n", f"{study.title or '(no title)'}\n"]
    parts.append(origin_text(model.origin))
    parts += [chapter("1  WHAT VARIES"), _axes(study), wrapped(verdict(study))]
    parts += [chapter("2  FAILURES"), *(_failures(study, units) or ["\n  none\n"])]
    parts.append(chapter("3  ENVELOPE OF LOADS ON RESTRAINTS"))
    parts += [_envelope(study, name, units) for name in study.cases]
    parts.append(chapter("4  VARIANTS"))
    parts += [_variants(study, j, units) for j in range(len(study.cases))]
    parts += [chapter("5  WORK"), ledger_table({"all variants": study.work})]
    parts.append(f"\n{'END OF REPORT':^{PAGE}}".rstrip() + "\n")
    return "".join(parts).encode(errors="replace")


def study_screen(study: Study, model: Model, room: Room = PIPE) -> str:
    """Print what is missing, the largest loads with their variants, and the failures."""
    units = report_units(model.units)
    lines = [study.title] if study.title else []
    if model.origin is not None:
        lines += chain(*messages(origin_lines(model.origin), room))
    lines += [_largest(study, name, units, room.columns) for name in study.cases]
    failures = study.failures
    said = [_told(study, *failure, units) for failure in failures[:SHOWN]]
    if len(failures) > SHOWN:
        said.append(f"... and {counted(len(failures) - SHOWN, 'more failure')} in the report")
    lines += chain(*messages([*said, verdict(study)], room))
    return "\n".join(lines)


def verdict(study: Study) -> str:
    """Count what is certified."""
    n, good = len(study.names), study.good
    answers = f"{int(good.sum())} of {counted(good.size, 'answer')} certified"
    worst = np.nanmax(study.answers.worst) if good.any() else 0.0
    work = study.work
    return (
        f"{counted(n, 'variant')} of {counted(len(study.cases), 'case')}: "
        f"{answers}, worst {worst:.1e}; symbolic analyses {work['analyse']}, "
        f"assemblies {work['assemble']}, factorisations {work['factorise']}"
    )


def _axes(study: Study) -> str:
    shown = [", ".join(axis.texts) for axis in study.axes]
    text = table(
        [
            words("QUANTITY", [axis.name for axis in study.axes], least=12),
            integers("VALUES", [len(axis.values) for axis in study.axes]),
            words("  ", [f"  {text}" for text in shown], most=100),
        ]
    )
    return f"\n{text}"


def _failures(study: Study, units: ReportUnits) -> list[str]:
    return [wrapped(_told(study, *failure, units)) for failure in study.failures]


def _told(study: Study, i: int, j: int, cause: str, units: ReportUnits) -> str:
    return f"variant {i + 1} ({study.names[i]}), {study.cases[j]}: {in_units(cause, units)}"


# ------------------------------------------------------------------ envelope
def _on_restraint(study: Study, name: str) -> tuple[F8, F8, F8, F8] | None:
    """Largest and smallest load on every restraint, and their variants from 1 on (0: none)."""
    found = study.envelope(name)
    if found is None:
        return None
    extremes, good = found
    low, high = (
        np.where(which < 0, 0.0, good[which] + 1.0)
        for which in (extremes.lowest_case, extremes.highest_case)
    )
    return -extremes.lowest, -extremes.highest, low, high


def _envelope(study: Study, name: str, units: ReportUnits) -> str:
    """Print a block a support: extremes of each component and the variants that govern them."""
    note = "ON THE RESTRAINT, global; states with numbers of variants; governing variants (see 4)"
    text = section(f"{name}: EVERY RESTRAINT", note)
    found = _on_restraint(study, name)
    cards = study.system.cards
    if found is None or not cards:
        return text + "  none\n"
    load = np.stack(found[:2], axis=1)
    which = np.stack(found[2:], axis=1).astype(int)
    q = units.force.showing(float(np.abs(load[..., :3]).max()))
    m = units.moment.showing(float(np.abs(load[..., 3:]).max()))
    flat = load.reshape(-1, 6)
    columns: list[Column] = [
        numbers(head, flat[:, i], m if i > 2 else q, 13) for i, head in enumerate(COMPONENTS)
    ]
    lead = words("", ["VARIANT"], least=12)
    row = "  " + lead.form + "".join(c.form for c in columns) + "\n"
    cells = list(zip(*(c.cells for c in columns), strict=True))
    out, states = [headings([lead, *columns])], study.states(name)
    for i, card in enumerate(cards):
        if not which[i].any():
            continue
        seen = [f"{word} {n}" for word, n in zip(STATES, states[i].tolist(), strict=True) if n]
        out.append(f"  {card.name}   {', '.join(seen)}".rstrip() + "\n")
        for k, word in enumerate(("MAX", "MIN")):
            out.append(row % (word, *cells[2 * i + k]))
            names = [str(v) if v else "-" for v in which[i, k].tolist()]
            out.append("  " + lead.form % "variant" + ("%13s" * 6) % tuple(names) + "\n")
    return text + "".join(out)


def _largest(study: Study, name: str, units: ReportUnits, width: int) -> str:
    """Print the supports with the largest forces of a case and the variants that govern them."""
    found = _on_restraint(study, name)
    if found is None or not study.system.cards:
        return f"{name}: no loads"
    load, which = (
        np.concatenate([a[:, :3] for a in pair], axis=1) for pair in (found[:2], found[2:])
    )
    column = np.abs(load).argmax(axis=1)
    card = np.arange(len(load))
    value, variant, axis = load[card, column], which[card, column].astype(int), column % 3
    order = np.argsort(-np.abs(value), kind="stable")[:SHOWN]
    q = units.force.showing(float(np.abs(value).max(initial=0.0)))
    names = [study.names[v - 1] if v else "-" for v in variant[order].tolist()]
    text = table(
        [
            words("RESTRAINT", [study.system.cards[i].name for i in order.tolist()], least=16),
            words("LOAD", [COMPONENTS[a] for a in axis[order].tolist()]),
            numbers("LARGEST", value[order], q, 13),
            words("  GOVERNED BY", [f"  {name}" for name in names]),
        ],
        width=width,
    )
    return f"{name}: LARGEST FORCES ON RESTRAINTS\n{text}"


# ------------------------------------------------------------------ variants
def _variants(study: Study, j: int, units: ReportUnits) -> str:
    """Print one row a variant: values, states of the supports, certificate, largest load."""
    a, axes = study.answers, study.axes
    good, count = study.good[:, j], a.count[:, j]
    force = np.linalg.norm(np.nan_to_num(a.force[:, j, :, :3]), axis=2)
    at = force.argmax(axis=1) if force.shape[1] else np.zeros(len(good), int)
    largest = force.max(axis=1, initial=0.0)
    q = units.force.showing(float(largest.max(initial=0.0)))
    cards = [card.name for card in study.system.cards]
    where = [
        f"  {cards[i]}" if ok and cards else "" for i, ok in zip(at.tolist(), good, strict=True)
    ]
    columns = [
        integers("NO", list(range(1, len(good) + 1)), 6),
        words("", [""] * len(good), least=1),
    ]
    columns += [
        words(axis.name, [axis.texts[i] for i in _numbers(study, k)], least=8, most=20)
        for k, axis in enumerate(axes)
    ]
    columns.append(words("STATUS", ["certified" if ok else "FAILED" for ok in good], least=9))
    columns.append(
        words(
            "WORST", [f"{w:.1e}" if ok else "-" for w, ok in zip(a.worst[:, j], good, strict=True)]
        )
    )
    columns += [
        integers(state.upper()[:7], count[:, k].tolist(), 8)
        for k, state in enumerate(STATES)
        if count[:, k].any()
    ]
    columns.append(numbers("LARGEST", np.where(good, largest, np.nan), q, 12))
    columns.append(words("  ON RESTRAINT", where))
    return section(study.cases[j], "supports by state; largest force") + table(columns)


def _numbers(study: Study, k: int) -> list[int]:
    """Number of the value on axis k of every variant: the last axis is the fastest."""
    sizes: Sequence[int] = [len(axis.values) for axis in study.axes]
    found = np.unravel_index(np.arange(len(study.names)), sizes)[k]
    return [int(i) for i in found]
