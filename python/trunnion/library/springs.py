"""Generic table of variable spring hangers, which SPRINGSIZE cards replace.

This is no maker's catalogue.  Largest loads are preferred numbers of ISO 3 (series R10) from 0.4
to 200 kN; the least working load is half the largest, and the rate is such that this range of
load is the working travel of the series: 32, 63 or 125 mm (R5), as the three common travel
series of the trade have it.  Makers' tables differ in size and rate: give theirs before buying.
"""

from functools import lru_cache

from trunnion.model import SpringSize

_R10 = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)  # ISO 3
_SERIES = (("SHORT", 0.032), ("MEDIUM", 0.063), ("LONG", 0.125))  # working travel [m]
_FIRST, _LAST = 400.0, 200e3  # largest loads of the first and the last size [N]


@lru_cache(maxsize=1)
def generic_springs() -> tuple[SpringSize, ...]:
    """Sizes of the generic table, by series and load."""
    loads = [round(x * 10**n, 6) for n in range(2, 6) for x in _R10]
    loads = [load for load in loads if _FIRST <= load <= _LAST]
    return tuple(
        SpringSize(f"{series}-{i:02d}", series, 0.5 * load, load, 0.5 * load / travel)
        for series, travel in _SERIES
        for i, load in enumerate(loads, 1)
    )
