"""UNITS of an input XML: labels give the exact unit, factors check it.

A factor has six decimals: 0.006895 for MPa in psi.  It turns the program's internal unit into the
file's.  The temperature has no offset there: C and F are told apart by the label.
"""

from collections.abc import Mapping

from trunnion.formats.caesar.units import (
    DENSITIES,
    FORCES,
    INCH,
    INTERNAL,
    LBF,
    LENGTHS,
    POUND,
    PRESSURES,
    PSI,
    FileUnits,
    file_units,
)
from trunnion.formats.caesar_xml.tags import Numbers, Tag

NEAR = 1e-3
ROUNDED = 6e-7  # half of the last of six decimals, and a little

#: quantity -> number of its constant in a neutral file
NUMBERS = {
    **{"LENGTH": 1, "FORCE": 2, "MASS-DYNAMICS": 3, "MOMENT-INPUT": 4, "MOMENT-OUTPUT": 5},
    **{"STRESS": 6, "TEMP": 7, "PRESSURE": 9, "EMOD": 10, "PDENS": 11, "IDENS": 12, "FDENS": 13},
    **{"TRANS_STIFF": 14, "ROTL_STIFF": 15, "UNIF_LOAD": 16, "G_LOAD": 17, "WIND_LOAD": 18},
    **{"ELEVATION": 19, "COMPOUND_LENGTH": 20, "DIAMETER": 21, "THICKNESS": 22},
}
#: what a quantity follows where the file does not have it
_LIKE = {
    **{"COMPOUND_LENGTH": "LENGTH", "DIAMETER": "LENGTH", "THICKNESS": "LENGTH"},
    **{"ELEVATION": "LENGTH", "IDENS": "PDENS", "FDENS": "PDENS", "PRESSURE": "STRESS"},
    **{"EMOD": "STRESS"},
}
_NEEDED = ("LENGTH", "FORCE", "TEMP", "STRESS", "PDENS")
_LENGTHS = {**LENGTHS, "inch": INCH, "inches": INCH, "feet": LENGTHS["ft"]}
_FORCES = {
    **{name.lower(): value for name, value in FORCES.items()},
    **{"lb": LBF, "lbs": LBF, "kg": FORCES["kgf"], "newtons": 1.0, "dan": 10.0},
}
_PRESSURES = {
    **{name.lower(): value for name, value in PRESSURES.items()},
    **{"bars": 1e5, "lb/sqin": PSI, "lbs/sqin": PSI, "n/sqmm": 1e6, "n/sqcm": 1e4, "n/sqm": 1.0},
    **{"kg/sqcm": 98066.5, "kg/sqmm": 9806650.0, "kg/sqm": 9.80665, "kn/sqm": 1e3},
    **{"kn/sqmm": 1e9, "kg/cm2": 98066.5, "n/mm2": 1e6},
}
_DENSITIES = {
    **{name.lower(): value for name, value in DENSITIES.items()},
    **{"kg/cucm": 1e6, "kg/cum": 1.0, "kg/cumm": 1e9, "lb/cuin": POUND / INCH**3},
    **{"lbs/cuin": POUND / INCH**3, "lb/cuft": POUND / 0.3048**3, "g/cucm": 1e3, "gm/cucm": 1e3},
}


def read_units(units: Tag | None, model: Tag, numbers: Numbers) -> FileUnits:
    """Read the units of a file."""
    constants = [0.0, *INTERNAL]
    if units is None:
        numbers.fault(model, "there is no UNITS: what the numbers mean is not known")
        return file_units(INTERNAL)
    said = {tag.name: tag for tag in units.inside}
    missing = [name for name in _NEEDED if name not in said]
    if missing:
        numbers.fault(units, f"{' and '.join(missing)} missing")
        return file_units(INTERNAL)
    for name, k in NUMBERS.items():
        tag = said.get(name) or said.get(_LIKE.get(name, ""))
        if tag is not None and name not in ("TEMP", "G_LOAD"):
            constants[k] = _constant(name, tag, numbers)
    _coherent(constants, said, numbers)
    scale, shift = _temperature(said["TEMP"], numbers)
    constants[7], constants[8] = scale, shift
    return file_units(constants[1:])


def _plain(label: str) -> str:
    """Label as it is compared: without blanks, dots and capitals."""
    return "".join(c for c in label.lower() if c not in " .").replace("/in2", "/sqin")


def _constant(name: str, tag: Tag, numbers: Numbers) -> float:
    """Constant of a quantity: of its label where that is known, else its factor."""
    factor = numbers.of(tag, "FACTOR", 0.0)
    label = tag.attributes.get("LABEL", "")
    exact = _internal(name, _plain(label))
    if exact is None:
        if not 1e-9 < factor < 1e12:
            numbers.fault(tag, f"factor {factor:g} and label {label!r} say no unit")
            return 1.0
        return factor
    if factor and abs(factor - exact) > NEAR * exact + ROUNDED:
        text = f"label {label!r} means a factor of {exact:.6g}, the factor is {factor:g}"
        numbers.fault(tag, text)
    return exact


def _internal(name: str, label: str) -> float | None:
    """What one internal unit (inch, lbf, psi, lb/in3 ...) is in the unit of a label."""
    tables: dict[str, tuple[Mapping[str, float], float]] = {
        **dict.fromkeys(("LENGTH", "ELEVATION", "COMPOUND_LENGTH"), (_LENGTHS, INCH)),
        **dict.fromkeys(("DIAMETER", "THICKNESS"), (_LENGTHS, INCH)),
        "FORCE": (_FORCES, LBF),
        **dict.fromkeys(("STRESS", "PRESSURE", "EMOD", "WIND_LOAD"), (_PRESSURES, PSI)),
        **dict.fromkeys(("PDENS", "IDENS", "FDENS"), (_DENSITIES, POUND / INCH**3)),
    }
    if name in tables:
        table, internal = tables[name]
        return internal / table[label] if label in table else None
    if name in ("MOMENT-INPUT", "MOMENT-OUTPUT", "TRANS_STIFF", "UNIF_LOAD", "ROTL_STIFF"):
        return _product(name, label)
    return None


def _product(name: str, label: str) -> float | None:
    """Units made of a force and a length: nm, n/cm, nm/deg, in-lb."""
    label = label.removesuffix("/deg") if name == "ROTL_STIFF" else label
    if name in ("TRANS_STIFF", "UNIF_LOAD"):
        force, _, length = label.partition("/")
        if force in _FORCES and length in _LENGTHS:
            return LBF / INCH / (_FORCES[force] / _LENGTHS[length])
        return None
    label = label.replace("-", "").replace("*", "")
    for force, f in _FORCES.items():
        for length, x in _LENGTHS.items():
            if label in (force + length, length + force):
                return LBF * INCH / (f * x)
    return None


def _coherent(constants: list[float], said: Mapping[str, Tag], numbers: Numbers) -> None:
    """Make up constants that the file does not have from those of force and length."""
    force, length = constants[2], constants[1]
    made = {
        "MOMENT-INPUT": force * length,
        "TRANS_STIFF": force / length,
        "ROTL_STIFF": force * length,
        "UNIF_LOAD": force / length,
    }
    for name, value in made.items():
        if name not in said:
            constants[NUMBERS[name]] = value
            text = f"UNITS has no {name}: taken from those of force and length"
            numbers.findings.assume(text, next(iter(said.values())).line)


def _temperature(tag: Tag, numbers: Numbers) -> tuple[float, float]:
    """Scale and shift against F: by the label C, F, K or R."""
    label = _plain(tag.attributes.get("LABEL", "")).removeprefix("deg").strip("°")
    known = {"c": (1 / 1.8, -32 / 1.8), "f": (1.0, 0.0), "k": (1 / 1.8, 273.15 - 32 / 1.8)}
    if label not in known:
        numbers.fault(tag, f"label {tag.attributes.get('LABEL', '')!r} is none of C, F, K")
        return known["f"]
    scale, shift = known[label]
    factor = numbers.of(tag, "FACTOR", scale)
    if abs(factor - scale) > NEAR:
        numbers.fault(tag, f"label {label.upper()} means a factor of {scale:.4f}, not {factor:g}")
    return scale, shift
