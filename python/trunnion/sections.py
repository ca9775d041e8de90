"""Cross sections of pipes: standard sizes, section properties and masses per length.

Lengths in m, masses in kg/m.  A wall of half the outside diameter is a solid bar.
"""

from dataclasses import dataclass
from math import pi
from typing import NamedTuple

from .model import Section
from .names import UnknownName

WATER = 1000.0  # kg/m3, what fills the pipe in WW

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


class Properties(NamedTuple):
    """Properties of a round section.

    area : metal area [m2].
    bore : area of the bore [m2], 0 for a solid bar.
    inertia : second moment of area about a diameter [m4]; the polar one is twice this.
    modulus : elastic section modulus [m3].
    shear_area : area that carries shear in Timoshenko's beam [m2], half the metal area.
    """

    area: float
    bore: float
    inertia: float
    modulus: float
    shear_area: float


@dataclass(frozen=True, slots=True)
class LineMass:
    """Mass per length of axis [kg/m], part by part; `water` fills the bore in a hydrotest."""

    metal: float
    fluid: float
    lining: float
    insulation: float
    water: float


def section_properties(od: float, wall: float) -> Properties:
    """Properties of a round pipe or bar.

    Parameters
    ----------
    od : outside diameter [m].
    wall : wall thickness [m], od/2 for a solid bar.
    """
    bore_d = inside_diameter(od, wall)
    # differences of powers as products: a thin wall loses no digits
    area = pi / 4.0 * (od - bore_d) * (od + bore_d)
    inertia = area / 16.0 * (od * od + bore_d * bore_d)
    return Properties(area, pi / 4.0 * bore_d**2, inertia, 2.0 * inertia / od, 0.5 * area)


def inside_diameter(od: float, wall: float) -> float:
    """Bore of a pipe [m]; an impossible wall is a ValueError.

    Half an OD printed with a few digits (wall 2.33509 for OD 4.67017) is a solid bar.
    """
    if not 0.0 < wall <= 0.5 * od * (1.0 + 1e-5):
        raise ValueError(f"wall {wall:g} m is not between 0 and half the diameter {od:g} m")
    return max(0.0, od - 2.0 * wall)


def line_masses(section: Section, density: float) -> LineMass:
    """Mass per length of the pipe, its contents, lining (inside) and insulation (outside).

    Parameters
    ----------
    section : the section; its fluid fills the bore that the lining leaves.
    density : of the pipe's metal [kg/m3].
    """
    properties = section_properties(section.od, section.wall)
    bore_d = inside_diameter(section.od, section.wall)
    clear_d = bore_d - 2.0 * section.lining
    if clear_d < 0.0:
        raise ValueError(f"lining {section.lining:g} m is more than half the bore {bore_d:g} m")
    clear = pi / 4.0 * clear_d**2
    return LineMass(
        metal=density * properties.area,
        fluid=section.fluid * clear,
        lining=section.lining_density * (properties.bore - clear),
        insulation=section.insulation_density
        * (pi * section.insulation * (section.od + section.insulation)),
        water=WATER * clear,
    )


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
