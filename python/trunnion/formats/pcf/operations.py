"""Temperatures and pressures: every pipe has the same sets, and who lacks one is named."""

import re
from collections.abc import Collection, Mapping, Sequence

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.network import Run
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.properties import Properties
from trunnion.model import Operation

#: beginnings of what a header says of temperature and pressure, in whatever units
_HEADS = ("PIPELINE-TEMP", "DESIGN-TEMP", "DESIGN-PRES", "OPERATING-TEMP", "OPERATING-PRES")


def one_operation(
    made: list[tuple[Run, Properties]], findings: Findings
) -> list[tuple[Run, Properties]]:
    """Give all pipes the same sets: a deck carries temperatures over, and cannot blank them."""
    t = sorted({n for _, p in made for n in p.operation.t})
    p_sets = sorted({n for _, p in made for n in p.operation.p})
    for n in t:
        cold = {run.part.line: run.part for run, p in made if n not in p.operation.t}
        _say_cold(f"T{n}", "stay cold", cold.values(), findings)
    for n in p_sets:
        free = {run.part.line: run.part for run, p in made if n not in p.operation.p}
        _say_cold(f"P{n}", "have none", free.values(), findings)
    known: dict[int, Operation] = {}
    result = []
    for run, what in made:
        old = what.operation
        if id(old) not in known:
            known[id(old)] = Operation(
                {n: old.t.get(n, old.tref) for n in t},
                {n: old.p.get(n, 0.0) for n in p_sets},
                old.tref,
            )
        result.append((run, Properties(what.section, what.material, known[id(old)])))
    return result


def _say_cold(name: str, what: str, parts: Collection[Part], findings: Findings) -> None:
    """Say that some components have no temperature or pressure of a set that others have."""
    first = next(iter(parts), None)
    if first is not None:
        more = f" and of {len(parts) - 1} more" if len(parts) > 1 else ""
        findings.assume(f"{name} of {first.name}{more} is not given: they {what}", first.line)


def say_unread(parts: Sequence[Part], meanings: Mapping[str, str], findings: Findings) -> None:
    """Name temperatures and pressures of a header that the side table gives no meaning."""
    unread = {
        (a.name, a.value): a
        for part in reversed(parts)
        for a in reversed(part.shared)
        if a.name.startswith(_HEADS) and a.name not in meanings and re.search("[1-9]", a.value)
    }
    for a in unread.values():
        text = f"{a.name} {a.value[:40]} is not read; give it a meaning under [attributes]"
        findings.assume(f"{text} of the side table", a.line)
