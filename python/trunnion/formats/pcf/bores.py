"""The bore of a PCF is a nominal size, written in one of several ways.

A 4 inch pipe is 4.0 (UNITS-BORE INCH), 100 (DN), 101.6 (inches times 25.4) or 114.3 (outside
diameter).  Which way a file in millimetres goes is decided once, by the way that fits most of
its sizes.
"""

from collections.abc import Iterable, Mapping
from functools import lru_cache

from trunnion.frozen import frozen
from trunnion.library.names import UnknownName
from trunnion.library.sections import nominal_inches, pipe_size

_DN = (
    *(6, 8, 10, 15, 20, 25, 32, 40, 50, 65, 80, 90, 100, 125, 150, 200, 250, 300, 350, 400, 450),
    *(500, 550, 600, 650, 700, 750, 800, 850, 900, 950, 1000, 1050, 1100, 1150, 1200),
)
WAYS = ("DN", "inches", "outside diameter")
_NEAR = {"DN": 0.1, "inches": 0.1, "outside diameter": 0.5}  # mm


@frozen
class Bores:
    """Nominal sizes in inches of all bores of a file as written; None where nothing fits."""

    way: str
    inches: Mapping[float, float | None]
    others: tuple[tuple[float, str], ...]  # sizes that fit another way only
    guessed: bool = True  # the way follows from the sizes, not from UNITS-BORE


def decide(bores: Iterable[float], unit: str) -> Bores:
    """Find the way of a file and the nominal size of each of its bores.

    Parameters
    ----------
    bores : as written.
    unit : "MM", "INCH", or "SIXTEENTH" (of an inch).
    """
    sizes = sorted(set(bores))
    if unit != "MM":
        divisor = 16.0 if unit == "SIXTEENTH" else 1.0
        table = _table("inches")
        found = {b: _nearest(table, b / divisor * 25.4, 0.5) for b in sizes}
        return Bores("inches", found, (), guessed=False)
    fits = {way: [b for b in sizes if _size(way, b) is not None] for way in WAYS}
    way = max(WAYS, key=lambda w: (len(fits[w]), -WAYS.index(w)))
    inches: dict[float, float | None] = {}
    others = []
    for bore in sizes:
        order = (way, *(w for w in WAYS if w != way))
        used = next((w for w in order if _size(w, bore) is not None), None)
        inches[bore] = None if used is None else _size(used, bore)
        if used is not None and used != way:
            others.append((bore, used))
    return Bores(way, inches, tuple(others))


def outside(inches: float) -> float | None:
    """Outside diameter [m] of a nominal size (ASME B36.10M); None if it has none."""
    for schedule in ("STD", "40", "10S", "XS"):
        try:
            return pipe_size(nps=inches, schedule=schedule)[0]
        except UnknownName:
            continue
    return None


def _size(way: str, bore: float) -> float | None:
    return _nearest(_table(way), bore, _NEAR[way])


def _nearest(table: Mapping[float, float], value: float, near: float) -> float | None:
    written = min(table, key=lambda x: abs(x - value))
    return table[written] if abs(written - value) <= near else None


@lru_cache(maxsize=3)
def _table(way: str) -> dict[float, float]:
    """Nominal inches by what a file writes [mm]."""
    inches = {dn: nominal_inches(dn=str(dn)) for dn in _DN}
    if way == "DN":
        return {float(dn): size for dn, size in inches.items()}
    if way == "inches":
        return {25.4 * size: size for size in inches.values()}
    pairs = ((outside(size), size) for size in inches.values())
    return {1000.0 * od: size for od, size in pairs if od is not None}
