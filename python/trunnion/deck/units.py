"""Units: what a deck's plain numbers mean, and what the suffix of a number means.

The UNITS card names four units; every other dimension follows by the table `DERIVED`.  A unit
is a ratio of whole numbers where it can be, so that 6000 mm is 6 m to the last bit.  Suffixes
made of the units below are read here; any other one is read by pint, imported only then.
"""

import math
import re
from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

from trunnion.model import Units

Exponents = tuple[int, int, int, int]  # length, mass, time, temperature


class Unit(NamedTuple):
    """One unit: SI value num/den, and its exponents; angles count as plain numbers."""

    num: float
    den: int
    exponents: Exponents


# fmt: off
_ATOMS: dict[str, Unit] = {
    "m": Unit(1, 1, (1, 0, 0, 0)), "mm": Unit(1, 1000, (1, 0, 0, 0)),
    "cm": Unit(1, 100, (1, 0, 0, 0)), "in": Unit(254, 10000, (1, 0, 0, 0)),
    "ft": Unit(3048, 10000, (1, 0, 0, 0)),
    "kg": Unit(1, 1, (0, 1, 0, 0)), "lb": Unit(45359237, 10**8, (0, 1, 0, 0)),
    "s": Unit(1, 1, (0, 0, 1, 0)),
    "n": Unit(1, 1, (1, 1, -2, 0)), "kn": Unit(1000, 1, (1, 1, -2, 0)),
    "mn": Unit(10**6, 1, (1, 1, -2, 0)), "kgf": Unit(980665, 10**5, (1, 1, -2, 0)),
    "lbf": Unit(44482216152605, 10**13, (1, 1, -2, 0)),
    "pa": Unit(1, 1, (-1, 1, -2, 0)), "kpa": Unit(1000, 1, (-1, 1, -2, 0)),
    "mpa": Unit(10**6, 1, (-1, 1, -2, 0)), "gpa": Unit(10**9, 1, (-1, 1, -2, 0)),
    "bar": Unit(10**5, 1, (-1, 1, -2, 0)),
    # lbf/in2
    "psi": Unit(44482216152605 * 10**8, 10**13 * 254**2, (-1, 1, -2, 0)),
    "mph": Unit(1609344, 3600000, (1, 0, -1, 0)),
    "rad": Unit(1, 1, (0, 0, 0, 0)), "deg": Unit(math.pi, 180, (0, 0, 0, 0)),
    "c": Unit(1, 1, (0, 0, 0, 1)), "degc": Unit(1, 1, (0, 0, 0, 1)),
    "k": Unit(1, 1, (0, 0, 0, 1)),
    "f": Unit(5, 9, (0, 0, 0, 1)), "degf": Unit(5, 9, (0, 0, 0, 1)),
}
# fmt: on

LENGTHS = ("m", "mm", "cm", "in", "ft")
FORCES = ("N", "kN", "lbf", "kgf")
PRESSURES = ("Pa", "kPa", "MPa", "bar", "psi")
TEMPERATURES = ("C", "K", "F")

# dimension -> (meaning, suffix of the SI unit, exponents)
DIMENSIONS: dict[str, tuple[str, str, Exponents]] = {
    "length": ("length, displacement, diameter, wall, gap, radius", "m", (1, 0, 0, 0)),
    "force": ("force, weight of a body", "N", (1, 1, -2, 0)),
    "moment": ("moment", "N.m", (2, 1, -2, 0)),
    "stiffness": ("stiffness of a translation", "N/m", (0, 1, -2, 0)),
    "rotational stiffness": ("stiffness of a rotation", "N.m/rad", (2, 1, -2, 0)),
    "pressure": ("pressure", "Pa", (-1, 1, -2, 0)),
    "modulus": ("modulus of elasticity", "Pa", (-1, 1, -2, 0)),
    "line load": ("weight per length", "N/m", (0, 1, -2, 0)),
    "area": ("effective area of an expansion joint", "m2", (2, 0, 0, 0)),
    "density": ("density", "kg/m3", (-3, 1, 0, 0)),
    "mass": ("mass", "kg", (0, 1, 0, 0)),
    "temperature": ("temperature, an offset unit", "C", (0, 0, 0, 1)),
    "expansion": ("coefficient of expansion", "/K", (0, 0, 0, -1)),
    "angle": ("rotation, angular gap", "rad", (0, 0, 0, 0)),
    "gravity": ("acceleration of gravity", "m/s2", (1, 0, -2, 0)),
    "in g": ("acceleration, in g", "g", (1, 0, -2, 0)),
    "speed": ("speed of wind", "m/s", (1, 0, -1, 0)),
    "wind pressure": ("pressure of wind", "Pa", (-1, 1, -2, 0)),
    "number": ("plain number", "", (0, 0, 0, 0)),
}


class SuffixError(ValueError):
    """A unit suffix that is unknown or of another dimension."""


def derived(units: Units) -> dict[str, str]:
    """Give the unit of every dimension under one UNITS card: the table of the reference page."""
    length, force = units.length, units.force
    imperial = length in ("in", "ft")
    arm = length if imperial else "m"
    degree = "F" if units.temperature == "F" else "K"
    return {
        "length": length,
        "force": force,
        "moment": f"{force}.{arm}",
        "stiffness": f"{force}/{length}",
        "rotational stiffness": f"{force}.{arm}/rad",
        "pressure": units.pressure,
        "modulus": "psi" if imperial else "Pa" if length == "m" else "MPa",
        "line load": f"{force}/ft" if imperial else f"{force}/m",
        "area": f"{length}2",
        "density": "lb/ft3" if imperial else "kg/m3",
        "mass": "lb" if imperial else "kg",
        "temperature": units.temperature,
        "expansion": f"/{degree}",
        "angle": "rad",
        "gravity": "m/s2",
        "in g": "g",
        "speed": "mph" if imperial else "m/s",
        "wind pressure": "lbf/ft2" if imperial else "Pa",
        "number": "",
    }


Scale = Callable[[float], float]  # value in a unit -> value in SI (and C, and g)


def to_celsius(unit: str) -> Scale:
    """Scale of a temperature: C, K or F, with or without "deg"."""
    match unit.lower().removeprefix("deg"):
        case "c":
            return lambda x: x
        case "k":
            return lambda x: x - 273.15
        case "f":
            return lambda x: (x - 32.0) / 1.8
    raise SuffixError(f"unit {unit} is no temperature; C, K and F are")


def _ratio(num: float, den: int) -> Scale:
    """Scale by num/den with one rounding where the ratio or its inverse is a whole number."""
    if isinstance(num, int):
        shared = math.gcd(num, den)
        num, den = num // shared, den // shared
    if num == den:
        return lambda x: x
    if num == 1:
        divisor = float(den)
        return lambda x: x / divisor
    factor = num / den
    return lambda x: x * factor


@lru_cache(maxsize=512)
def scale_of(unit: str, dimension: str) -> Scale:
    """Scale from `unit` (a suffix: "kN/mm") to the SI unit of `dimension`.

    Raises
    ------
    SuffixError : the unit is unknown, or of another dimension.
    """
    if dimension == "temperature":
        return to_celsius(unit)
    if dimension == "number":
        if not unit:
            return lambda x: x
        raise SuffixError(f"unit {unit} on a plain number")
    if dimension == "in g" and unit.lower() == "g":
        return lambda x: x
    found = _compound(unit) or _by_pint(unit)
    meaning, si, exponents = DIMENSIONS[dimension]
    if found.exponents != exponents:
        raise SuffixError(f"unit {unit} does not fit: this is a {meaning.split(',')[0]} [{si}]")
    if dimension == "in g":
        return _ratio(found.num / 9.80665, found.den)
    return _ratio(found.num, found.den)


_PART = re.compile(r"([./*]?)([A-Za-z]+)(?:\^|\*\*)?([1-9]?)")


def _compound(text: str) -> Unit | None:
    """Read a product of the units of `_ATOMS` (kg/m3, N.m/rad, /K); None if one is not there."""
    num: float = 1
    den, exponents, at = 1, (0, 0, 0, 0), 0
    while at < len(text):
        part = _PART.match(text, at)
        if part is None or ((at > 0) != bool(part[1]) and part[1] != "/"):
            return None
        atom = _ATOMS.get(part[2].lower())
        if atom is None:
            return None
        power = int(part[3] or 1)
        over = part[1] == "/"
        if over and isinstance(atom.num, float):
            num, den = num * (atom.den / atom.num) ** power, den
        elif over:
            num, den = num * atom.den**power, den * int(atom.num) ** power
        else:
            num, den = num * atom.num**power, den * atom.den**power
        sign = -power if over else power
        old, add = exponents, atom.exponents
        exponents = (
            old[0] + sign * add[0],
            old[1] + sign * add[1],
            old[2] + sign * add[2],
            old[3] + sign * add[3],
        )
        at = part.end()
    return Unit(num, den, exponents) if text else None


@lru_cache(maxsize=1)
def _registry() -> Any:
    """Load the registry of pint, which takes half a second."""
    import pint

    return pint.UnitRegistry(cache_folder=None)


def _by_pint(text: str) -> Unit:
    """Read any other unit (ksi, kip, tonne, inHg); 15 digits of its factor are kept."""
    unknown = SuffixError(f"unit {text} is not known")
    if len(text) > 40 or not re.fullmatch(r"/?[A-Za-z]+[\w./*^-]*", text, re.ASCII):
        raise unknown
    try:
        registry = _registry()
    except ImportError as error:
        raise SuffixError(f"unit {text} needs the package pint") from error
    spelled = "1" + text if text.startswith("/") else text
    spelled = re.sub(r"(?<=[A-Za-z])([1-9])", r"**\1", spelled.replace(".", "*"))
    for sensitive in (True, False):
        try:
            unit = registry.parse_units(spelled, case_sensitive=sensitive)
            base = (1 * unit).to_base_units()
        except Exception:  # pint and its parser raise many kinds; all mean: no such unit
            continue
        dims = dict(base.dimensionality)
        known = ("[length]", "[mass]", "[time]", "[temperature]")
        if any(name not in known for name in dims):
            raise unknown
        exponents = tuple(int(dims.get(name, 0)) for name in known)
        factor = float(f"{base.magnitude:.15g}")
        length, mass, time, temperature = exponents
        return Unit(factor, 1, (length, mass, time, temperature))
    raise unknown


def scales(units: Units) -> dict[str, Scale]:
    """Scale of every dimension for numbers without suffix."""
    return {dim: scale_of(unit, dim) for dim, unit in derived(units).items()}


def in_unit(unit: str, metres: float) -> str:
    """Write a length in a unit of LENGTHS, for messages."""
    return f"{metres / scale_of(unit, 'length')(1.0):.6g} {unit}"


def small_length(units: Units, metres: float) -> str:
    """Write a short length in mm, or in inches where the deck has inches or feet."""
    return in_unit("in" if units.length in ("in", "ft") else "mm", metres)


SI = Units()
