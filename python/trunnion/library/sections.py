"""Standard sizes of steel pipes by NPS or DN and schedule."""

from trunnion.library.names import UnknownName

SCHEDULES = (
    *("5", "10", "20", "30", "40", "60", "80", "100", "120", "140", "160"),
    *("STD", "XS", "XXS", "5S", "10S", "40S", "80S"),
)

# ASME B36.10M: nominal size in inches of each DN
_INCHES = {
    **{"6": 0.125, "8": 0.25, "10": 0.375, "15": 0.5, "20": 0.75, "25": 1.0, "32": 1.25},
    **{"40": 1.5, "50": 2.0, "65": 2.5, "80": 3.0, "90": 3.5, "100": 4.0, "125": 5.0},
    **{"150": 6.0, "200": 8.0, "250": 10.0, "300": 12.0, "350": 14.0, "400": 16.0},
    **{"450": 18.0, "500": 20.0, "550": 22.0, "600": 24.0, "650": 26.0, "700": 28.0},
    **{"750": 30.0, "800": 32.0, "850": 34.0, "900": 36.0, "950": 38.0, "1000": 40.0},
    **{"1050": 42.0, "1100": 44.0, "1150": 46.0, "1200": 48.0},
}


def pipe_size(
    nps: str | float | None = None, dn: str | float | None = None, schedule: str = "40"
) -> tuple[float, float]:
    """Outside diameter and wall [m] of a standard steel pipe, as nominal in millimetres.

    The walls are those of `fluids.piping` (ASME B36.10M and, with an S, B36.19M).

    Parameters
    ----------
    nps : nominal pipe size in inches: 10, "0.75", "3/4", "1-1/2".
    dn : nominal diameter in mm, instead of nps: 250.
    schedule : "40", "STD", "XS", "10S" ...
    """
    from fluids.piping import schedule_lookup

    name = schedule.strip().upper().removeprefix("SCH")
    if name not in SCHEDULES:
        raise UnknownName("pipe schedule", schedule, SCHEDULES)
    inches = nominal_inches(nps, dn)
    sizes, _, outside, walls = schedule_lookup[name]
    if inches not in sizes:
        asked = f"NPS {nps}" if nps is not None else f"DN {dn}"
        raise UnknownName(f"schedule {name} of pipe size", asked, [f"NPS {s:g}" for s in sizes])
    i = sizes.index(inches)
    # the tables hold hundredths of millimetres: give the double nearest to the printed number
    return round(outside[i] / 1000.0, 5), round(walls[i] / 1000.0, 5)


def nominal_inches(nps: str | float | None = None, dn: str | float | None = None) -> float:
    """Nominal pipe size in inches of NPS ("3/4", 10) or DN (250)."""
    if nps is not None:
        try:
            return sum(_fraction(part) for part in str(nps).replace("-", " ").split())
        except (ValueError, ZeroDivisionError):
            listed = [f"{inches:g}" for inches in _INCHES.values()]
            raise UnknownName("pipe size NPS", str(nps), listed) from None
    wanted = dn if isinstance(dn, str) else f"{dn:g}" if dn is not None else ""
    if wanted.strip() not in _INCHES:
        raise UnknownName("pipe size DN", wanted, _INCHES)
    return _INCHES[wanted.strip()]


def _fraction(text: str) -> float:
    """Value of "3/4" or "0.75"."""
    top, _, bottom = text.partition("/")
    return float(top) / (float(bottom) if bottom else 1.0)
