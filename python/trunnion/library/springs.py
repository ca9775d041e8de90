"""Tables of variable spring hangers, which SPRINGSIZE cards replace.

GENERIC is no maker's catalogue.  Largest loads are preferred numbers of ISO 3 (series R10) from
0.4 to 200 kN; the least working load is half the largest, and the rate is such that this range
of load is the working travel of the series: 32, 63 or 125 mm (R5), as the three common travel
series of the trade have it.  Makers' tables differ in size and rate: give theirs before buying.

ANVIL has the sizes of ASC Engineered Solutions (Anvil), figures 82, B-268, 98, triple and
quadruple spring: least and largest load [lbf] and spring scale [lbf/in] of the table "Spring
Hanger Size and Series Selection", submittal PP-SUB-82-C82 of 2022, pages 6 and 7.  It is the
default table of CAESAR II.
"""

from functools import lru_cache

from trunnion.model import SpringSize

_R10 = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)  # ISO 3
_SERIES = (("SHORT", 0.032), ("MEDIUM", 0.063), ("LONG", 0.125))  # working travel [m]
_FIRST, _LAST = 400.0, 200e3  # largest loads of the first and the last size [N]

LBF, POUND_AN_INCH = 4.4482216152605, 4.4482216152605 / 0.0254  # [N], [N/m]
# size, least and largest load [lbf], and the rates of figures 82, B-268, 98, triple, quadruple
_FIGURES = ("82", "B-268", "98", "TRIPLE", "QUADRUPLE")
_ANVIL: tuple[tuple[str, int, int, tuple[int, ...]], ...] = (
    ("000", 7, 31, (0, 7, 0, 0, 0)),
    ("00", 19, 72, (0, 15, 0, 0, 0)),
    ("0", 43, 95, (30, 15, 7, 5, 4)),
    ("1", 63, 137, (42, 21, 10, 7, 5)),
    ("2", 81, 176, (54, 27, 13, 9, 7)),
    ("3", 105, 228, (70, 35, 17, 12, 9)),
    ("4", 141, 306, (94, 47, 23, 16, 12)),
    ("5", 189, 410, (126, 63, 31, 21, 16)),
    ("6", 252, 546, (168, 84, 42, 28, 21)),
    ("7", 336, 728, (224, 112, 56, 37, 28)),
    ("8", 450, 975, (300, 150, 75, 50, 38)),
    ("9", 600, 1300, (400, 200, 100, 67, 50)),
    ("10", 780, 1690, (520, 260, 130, 87, 65)),
    ("11", 1020, 2210, (680, 340, 170, 113, 85)),
    ("12", 1350, 2925, (900, 450, 225, 150, 113)),
    ("13", 1800, 3900, (1200, 600, 300, 200, 150)),
    ("14", 2400, 5200, (1600, 800, 400, 267, 200)),
    ("15", 3240, 7020, (2160, 1080, 540, 360, 270)),
    ("16", 4500, 9750, (3000, 1500, 750, 500, 375)),
    ("17", 6000, 13000, (4000, 2000, 1000, 667, 500)),
    ("18", 7990, 17300, (5320, 2660, 1330, 887, 665)),
    ("19", 10610, 23000, (7080, 3540, 1770, 1180, 885)),
    ("20", 14100, 30550, (9400, 4700, 2350, 1567, 1175)),
    ("21", 18750, 40625, (12500, 6250, 3125, 2083, 1563)),
    ("22", 25005, 54178, (16670, 8335, 4167, 2778, 2084)),
)


def spring_table(name: str) -> tuple[SpringSize, ...]:
    """Table of the library: GENERIC or ANVIL."""
    return anvil_springs() if name == "ANVIL" else generic_springs()


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


@lru_cache(maxsize=1)
def anvil_springs() -> tuple[SpringSize, ...]:
    """Sizes of the maker's table, by figure and load."""
    return tuple(
        SpringSize(f"{figure}-{size}", figure, least * LBF, most * LBF, rates[k] * POUND_AN_INCH)
        for k, figure in enumerate(_FIGURES)
        for size, least, most, rates in _ANVIL
        if rates[k]
    )
