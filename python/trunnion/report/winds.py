"""Wind and snow of the input echo: every factor, and the load on each element."""

import numpy as np

from trunnion.arrays import System
from trunnion.loads.asce7 import FACTOR, GRADIENT, basic_pressure
from trunnion.loads.wind import WindLoad, wind_load
from trunnion.model import Model, Wind
from trunnion.report.columns import numbers, plain, section, table, words
from trunnion.report.units import Quantity, ReportUnits

_MPH = 0.44704  # [m/s]
_PSF = 47.880259  # [Pa]


def wind_echo(model: Model, system: System, units: ReportUnits) -> str:
    """Print the wind sets and the snow."""
    text = "".join(_wind(system, wind_load(model, system, w), units) for w in model.winds)
    if model.snows:
        total = sum(snow.weight for snow in model.snows)
        load = units.line_load.showing(total)
        text += section("SNOW", "set S")
        text += f"  {load.text(total)} {load.unit} downwards on every length of pipe\n"
    return text


def _wind(system: System, found: WindLoad, units: ReportUnits) -> str:
    wind = found.wind
    toward = ",".join(f"{x:g}" for x in wind.direction)
    text = section(f"WIND{wind.set}", f"towards ({toward}), on pipe and insulation")
    text += "".join(f"  {line}\n" for line in _words(wind, units))
    if wind.table:
        z, q = zip(*wind.table, strict=True)
        columns = [numbers("HEIGHT", z, units.length), numbers("q", q, _pressure(units))]
        text += table(columns) + "\n"
    at = np.flatnonzero(found.width > 0.0)
    line_load = units.line_load.showing(float(np.abs(found.load).max(initial=0.0)))
    parts = [system.parts[e] for e in at.tolist()]
    columns = [
        words("FROM", [p.start for p in parts]),
        words("TO", [p.end for p in parts]),
        numbers("HEIGHT 1", found.height[at, 0], units.length),
        numbers("HEIGHT 2", found.height[at, 1], units.length),
    ]
    if wind.speed is not None:
        basic = basic_pressure(wind.speed, wind.kzt, wind.kd)
        columns.append(plain("Kz", found.pressure[at] / basic, 4, 9))
    columns += [
        numbers("q", found.pressure[at], _pressure(units)),
        numbers("D", found.width[at], units.wall, 10),
        *(numbers(f"F{c}", found.load[at, i], line_load, 12) for i, c in enumerate("XYZ")),
    ]
    return text + table(columns)


def _words(wind: Wind, units: ReportUnits) -> list[str]:
    """State the rule and its factors; heights count from the ground."""
    up = units.length
    ground = f"ground at {up.text(wind.ground)} {up.unit}"
    law = "D |n| n, n the part normal to the pipe of the wind's unit vector; q is the mean"
    if wind.speed is None:
        return [f"f = q Cf {law}", f"Cf = {wind.shape:g}, {ground}, q linear between heights"]
    alpha, top = GRADIENT[wind.exposure]
    imperial = up.unit in ("in", "ft")
    speed = f"{wind.speed / _MPH:g} mph" if imperial else f"{wind.speed:g} m/s"
    return [
        f"f = q G Cf {law}",
        f"ASCE 7-16: q = {FACTOR:g} Kz Kzt Kd Ke V2 (SI), Kz = 2.01 (z/zg)^(2/alpha), constant"
        " below 4.572 m and above zg",
        f"V = {speed}, exposure {wind.exposure}: alpha = {alpha:g}, zg = {top:g} m; {ground}",
        f"Kzt = {wind.kzt:g}, Kd = {wind.kd:g}, Ke = 1, G = {wind.gust:g}, Cf = {wind.shape:g}",
    ]


def _pressure(units: ReportUnits) -> Quantity:
    """Wind in Pa, or psf: the deck's own unit may be bar."""
    if units.length.unit in ("in", "ft"):
        return Quantity("psf", 1.0 / _PSF, 2)
    return Quantity("Pa", 1.0, 1)
