"""Why a case may be believed: balance, certificate, iterations, price of the penalty, work."""

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from trunnion.arrays import CaseResult
from trunnion.report.answers import largest
from trunnion.report.columns import Column, integers, numbers, section, table, words, wrapped
from trunnion.report.counts import counted
from trunnion.report.units import ReportUnits
from trunnion.results.balance import load_sum, reaction_sum
from trunnion.results.supports import card_forces

FIRST, LAST = 8, 16  # iterations printed of a long history


def balance_table(case: CaseResult, units: ReportUnits) -> str:
    """Print the sums of loads and reactions and what is left between them."""
    if case.loads is None or not case.linear:
        return ""
    loads, reactions = load_sum(case.system, case.loads), reaction_sum(case)
    rows = np.stack([loads, reactions, loads + reactions])
    held = card_forces(case)  # sums may cancel to round-off
    q = units.force.showing(largest(np.vstack([rows, held])[:, :3]))
    m = units.moment.showing(largest(np.vstack([rows, held])[:, 3:]))
    columns = [words("", ["loads", "restraints on the pipe", "balance"], most=24)]
    for i, head in enumerate(("FX", "FY", "FZ", "MX", "MY", "MZ")):
        columns.append(numbers(head, rows[:, i], m if i > 2 else q, 14))
    return section(f"{case.name}: SUMS", "moments about the origin") + table(columns)


def certificate_table(case: CaseResult) -> str:
    """Print every item of the certificate and where it is worst."""
    text = section(f"{case.name}: CERTIFICATE")
    found = case.certificate
    if found is None:
        return text + "  none\n"
    verdict = "PASSED" if found.passed else "FAILED"
    parents = "the modes" if case.kind == "spectrum" else "the cases it combines"
    inherited = f", inherited from {parents}" if found.inherited else ""
    text += wrapped(f"{verdict}: worst {found.worst:.1e}, {found.where}{inherited}")
    if found.items:
        values = [f"{item.value:.1e}" if item.value else "0" for item in found.items]
        places = [f"  {item.where}" if item.value else "" for item in found.items]
        text += table(
            [
                words("ITEM", [item.name for item in found.items], least=20),
                Column("VALUE", "", "%10s", 10, values),
                words("  WORST AT", places),
            ]
        )
    for name, value in case.penalty_effect.items():
        what = {"u": "displacements", "R": "support forces"}.get(name, name)
        text += wrapped(
            f"rigid supports instead of the penalty would change {what} by {value:.1e} "
            "of the largest"
        )
    if case.digits is not None:
        left, where = case.digits
        text += wrapped(
            f"{left:.0f} digits of the displacements stand against the last bit of the input, "
            f"fewest at {where}"
        )
    for name in case.frozen:
        text += wrapped(f"frozen engaged: {name}")
    return text


def history_table(case: CaseResult) -> str:
    """Print the iterations (the middle of a long history left out) and who changed state."""
    history = case.history
    if not history:
        return ""
    left_out = max(len(history) - FIRST - LAST, 0)
    shown = history if not left_out else [*history[:FIRST], *history[-LAST:]]
    keys = list(dict.fromkeys(key for record in shown for key in record))
    columns = [_column(key, [record.get(key) for record in shown]) for key in keys]
    columns.sort(key=lambda column: column.left and column.head != "  WHAT")
    text = section(f"{case.name}: ITERATIONS", f"{len(history)} in all") + table(columns)
    if left_out:
        text += f"  {counted(left_out, 'iteration')} after number {FIRST} of this table left out\n"
    return text + _restless(case)


def _restless(case: CaseResult) -> str:
    """Print the supports that changed state most often, and when they did last."""
    count: Counter[str] = Counter()
    last: dict[str, int] = {}
    for number, record in enumerate(case.history, 1):
        for value in record.values():
            for name in _names(value):
                count[name] += 1
                last[name] = number
    if not count:
        return ""
    most = count.most_common(20)
    return "\n" + table(
        [
            words("SUPPORT", [name for name, _ in most]),
            integers("CHANGES", [n for _, n in most], 10),
            integers("LAST AT", [last[name] for name, _ in most], 10),
        ]
    )


def _column(key: str, values: Sequence[object]) -> Column:
    """Set one entry of the history: numbers to the right, words and names of supports left."""
    if any(_names(value) or isinstance(value, str) for value in values):
        cells = [value if isinstance(value, str) else _few(_names(value)) for value in values]
        return words(f"  {key.upper()}", [f"  {cell}" for cell in cells])
    return Column(key.upper(), "", "%12s", 12, [_cell(value) for value in values])


def _names(value: object) -> list[str]:
    """Names of supports in one cell of the history."""
    if isinstance(value, Mapping):
        return [str(key) for key in value]
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [str(item) for item in value]
    return []


def _few(names: Sequence[str]) -> str:
    """Print three names and the number of the others."""
    rest = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + rest


def _cell(value: object) -> str:
    if value is None or isinstance(value, list | tuple | dict):
        return ""
    return f"{value:.3e}" if isinstance(value, float | np.floating) else str(value)[:11]


def ledger_table(work: Mapping[str, Mapping[str, int]]) -> str:
    """Print counts of work, one row a case."""
    work = {name: counts for name, counts in work.items() if counts}
    keys = list(dict.fromkeys(key for counts in work.values() for key in counts))
    columns = [words("CASE", list(work), least=12)]
    columns += [
        integers(key.upper(), [counts.get(key, 0) for counts in work.values()], 12)
        for key in keys[:9]
    ]
    return table(columns)
