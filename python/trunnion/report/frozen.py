"""Whether the frozen contact state of a locked case holds: what would pull, what would close."""

from trunnion.arrays import CaseResult, FrozenBreak
from trunnion.report.columns import Column, section, table, words, wrapped
from trunnion.report.counts import counted
from trunnion.report.units import ReportUnits

MEANING = {"pulls": "closed, would have to pull", "closes": "open, moved beyond its gap"}


def frozen_table(case: CaseResult, units: ReportUnits) -> str:
    """Print the supports for which the frozen contact state of a locked case does not hold."""
    text = section(f"{case.name}: FROZEN CONTACT STATE")
    if not case.frozen_check:
        return text + "  holds at every support\n"
    found = sorted(case.frozen_check, key=lambda b: (b.what, -b.amount, b.card))
    cards = [case.system.cards[b.card] for b in found]
    shown = [_amount(b, units) for b in found]
    count = counted(len(found), "support direction")
    text += wrapped(
        f"does not hold at {count}: there this linear case is not the answer of the real supports"
    )
    return text + table(
        [
            words("RESTRAINT", [card.name for card in cards]),
            words("WORD", [b.word for b in found]),
            words("WHAT", [MEANING.get(b.what, b.what) for b in found]),
            Column("AMOUNT", "", "%14s", 14, [amount for amount, _ in shown]),
            words("  UNIT", [f"  {unit}" for _, unit in shown]),
        ]
    )


def frozen_warning(case: CaseResult, units: ReportUnits) -> list[str]:
    """Name the worst pull and the worst closed gap of a locked case, and count the others."""
    lines = []
    for what, form in (("pulls", "would have to pull {}"), ("closes", "goes {} beyond its gap")):
        found = [b for b in case.frozen_check if b.what == what]
        if not found:
            continue
        worst = max(found, key=lambda b: (b.amount, -b.card))
        amount = form.format(" ".join(_amount(worst, units)))
        more = f", and {len(found) - 1} more" if len(found) > 1 else ""
        name = case.system.cards[worst.card].name
        lines.append(f"{case.name}: frozen contact state: {name}: {worst.word} {amount}{more}")
    return lines


def si_unit(broken: FrozenBreak) -> str:
    """Unit of an amount: rotations have moments and angles."""
    turning = broken.word.lstrip("+-").startswith("R")
    if broken.what == "pulls":
        return "N m" if turning else "N"
    return "rad" if turning else "m"


def _amount(broken: FrozenBreak, units: ReportUnits) -> tuple[str, str]:
    quantity = {
        "N": units.force,
        "N m": units.moment,
        "m": units.movement,
        "rad": units.rotation,
    }[si_unit(broken)].showing(broken.amount)
    return quantity.text(broken.amount), quantity.unit
