"""Units of the text report: the deck's own, with mm and degrees for movements."""

from collections.abc import Callable
from math import floor, isfinite, log10, pi

from trunnion.deck.units import derived, scale_of, to_celsius
from trunnion.frozen import frozen
from trunnion.model import Units

DIGITS = 5  # significant digits that the largest number of a kind shows at least

_DECIMALS = {
    "N": 0, "kN": 3, "lbf": 0, "kgf": 1,
    "N.m": 0, "kN.m": 3, "mm": 3, "cm": 4, "m": 4, "in": 4, "ft": 4, "deg": 4,
    "MPa": 2, "Pa": 0, "kPa": 1, "bar": 2, "psi": 0,
    "kg/m3": 1, "lb/ft3": 2, "C": 1, "K": 1, "F": 1,
}  # fmt: skip


@frozen
class Quantity:
    """One kind of number in the report: value in SI times `factor`, with `decimals`."""

    unit: str
    factor: float
    decimals: int

    def showing(self, largest: float) -> "Quantity":
        """Give it the decimals that a largest value [SI] needs."""
        size = abs(largest) * self.factor
        if size == 0.0 or not isfinite(size):
            return self
        needed = DIGITS - 1 - floor(log10(size))
        return Quantity(self.unit, self.factor, min(max(self.decimals, needed), 9))

    def text(self, value: float, width: int = 0) -> str:
        """Write one value without its unit."""
        return f"{value * self.factor:{width}.{self.decimals}f}"


@frozen
class ReportUnits:
    """Every kind of number that the report prints."""

    length: Quantity
    wall: Quantity
    movement: Quantity
    rotation: Quantity
    force: Quantity
    moment: Quantity
    stress: Quantity
    modulus: Quantity
    pressure: Quantity
    density: Quantity
    line_load: Quantity
    stiffness: Quantity
    rotational_stiffness: Quantity
    mass: Quantity
    temperature: str
    degrees: Callable[[float], float]  # degrees Celsius -> the deck's temperature


def report_units(units: Units) -> ReportUnits:
    """Units that follow from a UNITS card."""
    names = derived(units)
    imperial = units.length in ("in", "ft")
    small = "in" if imperial else "mm"
    stress = "psi" if imperial else "MPa"

    def of(dimension: str, unit: str | None = None, decimals: int | None = None) -> Quantity:
        name = unit or names[dimension]
        places = _DECIMALS.get(name, 3) if decimals is None else decimals
        return Quantity(name, 1.0 / scale_of(name, dimension)(1.0), places)

    return ReportUnits(
        length=of("length"),
        wall=of("length", small),
        movement=of("length", small),
        rotation=Quantity("deg", 180.0 / pi, 4),
        force=of("force"),
        moment=of("moment", decimals=3 if units.force == "kN" else 0),
        stress=of("modulus", stress),
        modulus=of("modulus", stress, 0),
        pressure=of("pressure"),
        density=of("density"),
        line_load=of("line load"),
        stiffness=of("stiffness", decimals=1),
        rotational_stiffness=of("rotational stiffness", decimals=1),
        mass=of("mass", decimals=1),
        temperature=units.temperature,
        degrees=_from_celsius(units.temperature),
    )


def _from_celsius(unit: str) -> Callable[[float], float]:
    zero, one = to_celsius(unit)(0.0), to_celsius(unit)(1.0)
    return lambda t: (t - zero) / (one - zero)
