"""A small library of piping materials: modulus and expansion against temperature, sourced.

Modulus: ASME B31.1-1995 Table C-1 as reprinted at
https://www.engineeringtoolbox.com/young-modulus-d_773.html (read there; the austenitic row
above 500 F was also read in a reprint of B31.3-2010 Table C-6 and is the same).

Expansion: total expansion in inches per 100 ft from 70 F, as reprinted at
https://www.hyspan.com/thermal-expansion/ (read there).  Its steel column has the 3.62 at
500 F and the 4.11 at 550 F that ASME B31.3-2006 Appendix S takes from its Table C-1, so it is
that table.  The grouping "carbon, C-Mo to 3Cr-Mo", "5 to 9 Cr-Mo", "austenitic stainless" was
read at https://efp-web.com/pipe-thermal-expansion/ (ANSI B31.1 Appendix B; same values but
for 0.01 here and there).  B31.3 replaced this table in 2010 by that of ASME II Part D, which
gives 3.7 where this has 3.62.

Grades that end in -IID have the mean coefficients of ASME II-D Table TE-1, carbon and low alloy
steels (group 1), columns B of the 2001 and 2010 editions as reprinted at
https://pdfslide.us/documents/asme-sec-ii-d-sb-pt2-phys-prop-tables2003.html and
https://ru.scribd.com/doc/231109310 (read there; both have the same numbers).  It is what
B31.3 takes since 2010.  It begins at 70 F; below stand the values of Table C-1.

The mean coefficient is total / (1200 (T - 70 F)).  Totals of two digits near 70 F would give
it to 2-4 % only, so rows between 0 and 150 F are left out; interpolation there is better.

Density: stainless by EN 10088-1 as reprinted at https://rolextube.com/
ambient-temperature-physical-properties-of-stainless-steels-to-bs-en-10088-1; other steels
7850 kg/m3 (0.283 lb/in3, Callister, table B.1), which is about 1 % heavy for 9Cr steels.
Poisson's ratio 0.3 for every steel.

Left out because no source could be read that has their tables: duplex, copper-nickel,
aluminium, and expansions of Table C-1 above 800 F.
"""

from trunnion.library.names import UnknownName
from trunnion.model import Material, TablePoint

PSI = 6894.757293168  # Pa, exact to the digits shown
_T0 = 70.0  # F, from which the mean coefficients count

# temperatures [F] and modulus [1e6 psi]
_E_F = (-325, -200, -100, 70, 200, 300, 400, 500, 600, 700, 800, 900, 1000, 1100, 1200)
_MODULUS: dict[str, tuple[float, ...]] = {
    "carbon steel, C <= 0.3 %": (
        *(31.4, 30.8, 30.2, 29.5, 28.8, 28.3, 27.7, 27.3, 26.7, 25.5),
        *(24.2, 22.4, 20.4, 18.0),
    ),
    "Cr-Mo steel, Cr 1/2 to 2 %": (
        *(31.6, 31.0, 30.4, 29.7, 29.0, 28.5, 27.9, 27.5, 26.9, 26.3),
        *(25.5, 24.8, 23.9, 23.0, 21.8),
    ),
    "Cr-Mo steel, Cr 2 1/4 to 3 %": (
        *(32.6, 32.0, 31.4, 30.6, 29.8, 29.4, 28.8, 28.3, 27.7, 27.1),
        *(26.3, 25.6, 24.6, 23.7, 22.5),
    ),
    "Cr-Mo steel, Cr 5 to 9 %": (
        *(32.9, 32.3, 31.7, 30.9, 30.1, 29.7, 29.0, 28.6, 28.0, 27.3),
        *(26.1, 24.7, 22.7, 20.4, 18.2),
    ),
    "austenitic stainless steel": (
        *(30.3, 29.7, 29.1, 28.3, 27.6, 27.0, 26.5, 25.8, 25.3, 24.8),
        *(24.1, 23.5, 22.8, 22.1, 21.2),
    ),
}

# temperatures [F] and total expansion from 70 F [in/100 ft]
_X_F = (
    *(-325, -300, -250, -200, -150, -100, -50, 0, 150, 200, 250, 300),
    *(350, 400, 450, 500, 550, 600, 650, 700, 750, 800),
)
_EXPANSION: dict[str, tuple[float, ...]] = {
    "carbon steel, C-Mo to 3Cr-Mo": (
        *(-2.37, -2.24, -1.98, -1.71, -1.45, -1.15, -0.84, -0.49, 0.61, 0.99, 1.40, 1.82),
        *(2.26, 2.70, 3.16, 3.62, 4.11, 4.60, 5.11, 5.63, 6.16, 6.70),
    ),
    "5Cr-Mo to 9Cr-Mo": (
        *(-2.22, -2.10, -1.86, -1.62, -1.37, -1.08, -0.79, -0.46, 0.58, 0.94, 1.33, 1.71),
        *(2.10, 2.50, 2.93, 3.35, 3.80, 4.24, 4.69, 5.14, 5.62, 6.10),
    ),
    "austenitic 18Cr-8Ni": (
        *(-3.85, -3.63, -3.19, -2.73, -2.27, -1.75, -1.24, -0.72, 0.90, 1.46, 2.03, 2.61),
        *(3.20, 3.80, 4.41, 5.01, 5.62, 6.24, 6.87, 7.50, 8.15, 8.80),
    ),
}

# temperatures [F] and mean coefficient from 70 F [1e-6 / F]
_A_F = (70, *range(100, 1301, 50))
_MEAN: dict[str, tuple[float, ...]] = {
    "carbon and low alloy steel, II-D group 1": (
        *(6.4, 6.5, 6.6, 6.7, 6.8, 6.9, 7.0, 7.1, 7.2, 7.3, 7.3, 7.4, 7.5, 7.6, 7.7, 7.8, 7.9),
        *(7.9, 8.0, 8.1, 8.1, 8.2, 8.3, 8.3, 8.4, 8.4),
    ),
}
_IID = "carbon and low alloy steel, II-D group 1"

_CARBON = ("carbon steel, C <= 0.3 %", "carbon steel, C-Mo to 3Cr-Mo", 7850.0)
_CR1 = ("Cr-Mo steel, Cr 1/2 to 2 %", "carbon steel, C-Mo to 3Cr-Mo", 7850.0)
_CR2 = ("Cr-Mo steel, Cr 2 1/4 to 3 %", "carbon steel, C-Mo to 3Cr-Mo", 7850.0)
_CR9 = ("Cr-Mo steel, Cr 5 to 9 %", "5Cr-Mo to 9Cr-Mo", 7850.0)
_304 = ("austenitic stainless steel", "austenitic 18Cr-8Ni", 7900.0)
_316 = ("austenitic stainless steel", "austenitic 18Cr-8Ni", 8000.0)

# grade: row of the modulus table, column of the expansion table, density [kg/m3]
GRADES: dict[str, tuple[str, str, float]] = {
    **dict.fromkeys(("A106-B", "A53-B", "A333-6", "API5L-B"), _CARBON),
    **dict.fromkeys(("A335-P11", "A335-P12"), _CR1),
    **dict.fromkeys(("A335-P22", "A335-P21"), _CR2),
    **dict.fromkeys(("A335-P5", "A335-P9", "A335-P91"), _CR9),
    **dict.fromkeys(("A312-TP304", "A312-TP304L", "A312-TP321", "A312-TP347"), _304),
    **dict.fromkeys(("A312-TP316", "A312-TP316L"), _316),
    "A106-B-IID": (_CARBON[0], _IID, 7850.0),
    "A335-P11-IID": (_CR1[0], _IID, 7850.0),
    "A335-P22-IID": (_CR2[0], _IID, 7850.0),
}


def library_material(grade: str) -> Material:
    """Material of the library: modulus at 70 F, nu, density and the table over temperature.

    Parameters
    ----------
    grade : a key of `GRADES`, in any case, with spaces or none for hyphens: "A106-B",
        "A312 TP304L".
    """
    name = _key(grade)
    known = {_key(g): g for g in GRADES}
    if name not in known:
        raise UnknownName("material grade", grade, GRADES)
    row, column, density = GRADES[known[name]]
    modulus = dict(zip(_E_F, _MODULUS[row], strict=False))  # carbon steel ends at 1100 F
    alpha = _coefficients(column)
    table = tuple(
        TablePoint(
            t=_celsius(f),
            e=modulus[f] * 1e6 * PSI if f in modulus else None,
            alpha=alpha.get(f),
        )
        for f in sorted({*modulus, *alpha})
    )
    return Material(
        name=known[name],
        grade=known[name],
        e=modulus[70] * 1e6 * PSI,
        alpha=alpha[200],
        density=density,
        table=table,
        table_tref=_celsius(_T0),
    )


def _key(grade: str) -> str:
    return "".join(c for c in grade.upper() if c.isalnum())


def _celsius(fahrenheit: float) -> float:
    return (fahrenheit - 32.0) / 1.8


def _coefficients(column: str) -> dict[int, float]:
    """Mean coefficients from 70 F by temperature [F], [1/K]."""
    late = column in _MEAN
    totals = zip(_X_F, _EXPANSION[_CARBON[1] if late else column], strict=True)
    found = {f: _mean_alpha(f, total) for f, total in totals if f < _T0 or not late}
    if late:
        found |= {f: 1.8e-6 * a for f, a in zip(_A_F, _MEAN[column], strict=True)}
    return found


def _mean_alpha(fahrenheit: float, total: float) -> float:
    """Mean coefficient from 70 F [1/K] of a total expansion in inches per 100 ft."""
    return total / 1200.0 / (fahrenheit - _T0) * 1.8
