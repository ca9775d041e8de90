"""The file's own units: constants that turn inch, lbf, psi, F into what the numbers are in.

The constants have 4 to 6 digits (25.4, 4.448, 0.5556).  Where one is a known unit to 0.1 % the
exact unit is taken, else the constant as it stands.
"""

from collections.abc import Iterable
from math import pi

from trunnion.formats.caesar.sections import Section
from trunnion.formats.caesar.text import Columns
from trunnion.formats.findings import Findings
from trunnion.frozen import frozen
from trunnion.model import Units

INCH, POUND, LBF = 0.0254, 0.45359237, 4.4482216152605
PSI = LBF / INCH**2
NEAR = 1e-3  # a constant this near to a known unit is that unit

LENGTHS = {"mm": 1e-3, "cm": 1e-2, "in": INCH, "ft": 0.3048, "m": 1.0}
FORCES = {
    "N": 1.0,
    "daN": 10.0,
    "kgf": 9.80665,
    "kN": 1e3,
    "lbf": LBF,
    "tf": 9806.65,
    "klbf": 1e3 * LBF,
}
PRESSURES = {
    **{"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "mbar": 1e2, "psi": PSI},
    **{"ksi": 1e3 * PSI, "kgf/cm2": 98066.5, "kgf/mm2": 9806650.0, "kgf/m2": 9.80665},
    **{"N/cm2": 1e4, "lbf/ft2": LBF / 0.3048**2, "atm": 101325.0},
}
DENSITIES = {
    **{"kg/m3": 1.0, "g/cm3": 1e3, "kg/cm3": 1e6, "kg/mm3": 1e9},
    **{"lb/in3": POUND / INCH**3, "lb/ft3": POUND / 0.3048**3},
}
# (degrees of the unit per F, what 0 F is in it): T [C] of a number x of the unit
_TEMPERATURES = {
    "C": (1 / 1.8, -32 / 1.8),
    "K": (1 / 1.8, 273.15 - 32 / 1.8),
    "F": (1.0, 0.0),
    "R": (1.0, 459.67),
}
_LABELS = {
    **{"mm": 1e-3, "cm": 1e-2, "in": INCH, "ft": 0.3048, "m": 1.0},
    **{"mm.": 1e-3, "cm.": 1e-2, "in.": INCH, "ft.": 0.3048, "m.": 1.0},
}


@frozen
class FileUnits:
    """Factors to SI of the quantities of a file; `names` are the deck's units.

    kt [N/m], kr [N m/rad], load [N/m], rigid [N/m]: from this stiffness on a support is rigid.
    """

    length: float
    compound: float
    diameter: float
    wall: float
    force: float
    moment: float
    pressure: float
    modulus: float
    pipe_density: float
    insulation_density: float
    fluid_density: float
    kt: float
    kr: float
    load: float
    temperature: tuple[float, float]  # T [C] = (x - shift) / scale, in F, then to C
    names: Units

    def celsius(self, value: float) -> float:
        """Temperature in C."""
        scale, shift = self.temperature
        if (scale, shift) == _TEMPERATURES["C"]:
            return value
        return ((value - shift) / scale - 32.0) / 1.8


def clean(x: float) -> float:
    """Drop what a conversion adds beyond 12 digits: a file's numbers have 7."""
    return float(f"{x:.12g}")


def scaled(x: float, factor: float) -> float:
    """Convert as a deck does (mm by division), so that a deck shows the file's own digits."""
    inverse = 1.0 / factor
    if factor < 1.0 and inverse == round(inverse):
        return x / inverse
    return clean(x * factor) if factor == round(factor) else x * factor


#: inch, lbf, psi, F: the program's own units
INTERNAL = (1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, *(1.0,) * 14)


def read_units(columns: Columns, section: Section) -> FileUnits:
    """Read 22 constants and 24 labels."""
    findings, first = columns.findings, section.header + 1
    constants = list(INTERNAL)
    if section.n_line < 4:
        findings.fault(
            section.header, f"UNITS has {section.n_line} lines; 4 of constants are needed"
        )
    else:
        constants = columns.many(first, 22)
    for k, value in enumerate(constants):
        if k != 7 and not 1e-12 < value < 1e12:
            findings.fault(first + k // 6, f"a constant of {value:g} cannot be", _field(k))
            constants[k] = INTERNAL[k]
    labels = [columns.text(n)[2:].strip() for n in range(first + 4, section.last + 1)]
    found = file_units(constants)
    if len(labels) > 2:
        _check_labels(findings, found, labels, first + 4)
    return found


def file_units(constants: Iterable[float]) -> FileUnits:
    """Make the factors to SI of the 22 constants, in the order of the file."""
    c = [0.0, *constants]  # counted from 1, as the vendor does
    per_force = {f / x for f in FORCES.values() for x in LENGTHS.values()}
    moments = {f * x for f in FORCES.values() for x in LENGTHS.values()}
    degree = 180.0 / pi
    return FileUnits(
        length=_exact(INCH / c[1], LENGTHS.values()),
        compound=_exact(INCH / c[20], LENGTHS.values()),
        diameter=_exact(INCH / c[21], LENGTHS.values()),
        wall=_exact(INCH / c[22], LENGTHS.values()),
        force=_exact(LBF / c[2], FORCES.values()),
        moment=_exact(LBF * INCH / c[4], moments),
        pressure=_exact(PSI / c[9], PRESSURES.values()),
        modulus=_exact(PSI / c[10], PRESSURES.values()),
        pipe_density=_exact(POUND / INCH**3 / c[11], DENSITIES.values()),
        insulation_density=_exact(POUND / INCH**3 / c[12], DENSITIES.values()),
        fluid_density=_exact(POUND / INCH**3 / c[13], DENSITIES.values()),
        kt=_exact(LBF / INCH / c[14], per_force),
        kr=degree * _exact(LBF * INCH / c[15], moments),
        load=_exact(LBF / INCH / c[16], per_force),
        temperature=_temperature(c[7], c[8]),
        names=_names(c),
    )


def _exact(factor: float, known: Iterable[float]) -> float:
    """Take the known unit that is nearest, if it is near enough."""
    best = min(known, key=lambda x: abs(x / factor - 1.0))
    return best if abs(best / factor - 1.0) <= NEAR else factor


def _temperature(scale: float, shift: float) -> tuple[float, float]:
    for known in _TEMPERATURES.values():
        if abs(known[0] / scale - 1.0) <= NEAR and abs(known[1] - shift) <= 0.1:
            return known
    return scale, shift


def _names(c: list[float]) -> Units:
    """Choose the units of the deck: those of the file where a deck has them."""
    scale, shift = _temperature(c[7], c[8])
    temperature = next((n for n, t in _TEMPERATURES.items() if t == (scale, shift)), "C")
    return Units(
        _named(INCH / c[20], LENGTHS, ("m", "mm", "cm", "in", "ft"), "mm"),
        _named(LBF / c[2], FORCES, ("N", "kN", "lbf", "kgf"), "N"),
        _named(PSI / c[9], PRESSURES, ("Pa", "kPa", "MPa", "bar", "psi"), "bar"),
        temperature if temperature in "CKF" else "C",
    )


def _named(factor: float, table: dict[str, float], names: tuple[str, ...], usual: str) -> str:
    return next((n for n in names if abs(table[n] / factor - 1.0) <= NEAR), usual)


def _check_labels(findings: Findings, found: FileUnits, labels: list[str], line: int) -> None:
    """A label of the length that contradicts its constant: one of them is wrong."""
    label = labels[2].lower()
    if label in _LABELS and abs(_LABELS[label] / found.length - 1.0) > 0.01:
        text = f"the label says {labels[2]}, the constant of lengths says {found.length:g} m"
        findings.fault(line + 2, text, (2, 2 + len(labels[2])))


def _field(k: int) -> tuple[int, int]:
    return 2 + 13 * (k % 6), 15 + 13 * (k % 6)
