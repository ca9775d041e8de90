"""Why a case has no answer, in the units of the deck.

The solver knows no deck: its texts have newtons, as the JSON has them.
"""

import re

from trunnion.arrays import CaseResult
from trunnion.report.units import ReportUnits
from trunnion.results.supports import cause_of

#: a number and the word N behind it; not N m, nor a label (100N)
NEWTONS = re.compile(r"(?<![\w.+-])(-?\d+(?:\.\d+)?(?:e[+-]?\d+)?) N\b(?! m\b|/)")
LEAST = 5  # digits: two numbers that are nearly equal must not become the same


def told_cause(case: CaseResult, units: ReportUnits) -> str:
    """Say why a case is not good."""
    return in_units(cause_of(case), units)


def in_units(text: str, units: ReportUnits) -> str:
    """Give a text of the solver with its forces in the deck's unit, with as many digits."""
    if units.force.unit == "N":
        return text

    def shown(found: re.Match[str]) -> str:
        digits = sum(c.isdigit() for c in found[1].partition("e")[0])
        value = float(found[1]) * units.force.factor
        return f"{value:.{max(digits, LEAST)}g} {units.force.unit}"

    return NEWTONS.sub(shown, text)
