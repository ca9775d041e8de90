"""Static wind and snow as uniform loads on elements.

Wind acts normal to the pipe.  The force on the area projected against the wind, D sin(a) for a
length of one, acts along the wind; its part along the pipe would be skin friction and is left
out.  What remains, with w the unit vector of the wind and n its part normal to the pipe,

    f = q G Cf D |n| n,    |n| = sin(a),

is the cross-flow principle: the velocity normal to a cylinder alone makes the force, q sin^2(a)
(Hoerner, Fluid-Dynamic Drag, 1965, chapter III, inclined cylinders).  Programs that take
q sin(a) differ by sin(a), on the safe side for oblique pipes.

An element carries one uniform load.  Its resultant is that of the true load: on a straight
the pressure is averaged over the heights exactly, on an arc force and pressure are integrated
(to round-off, to 1e-4 where a knee of the pressure lies within).  What a resultant cannot say,
where along a long riser the load is heaviest, a node in between gives.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, SPRING, System
from trunnion.errors import Problem
from trunnion.frozen import frozen
from trunnion.loads.asce7 import (
    GRADIENT,
    SMALL_SHAPE,
    basic_pressure,
    exposure_coefficient,
    exposure_integral,
    is_small,
)
from trunnion.model import Model, Wind

Index = NDArray[np.integer]

AIR = 1.225  # density of air at sea level and 15 C, International Standard Atmosphere [kg/m3]
UNEVEN = 0.1  # change of the pressure along an element, of its mean, that is remarked on
_LEVEL = 1e-4  # rise of an element [m] below which its middle stands for its mean
_PANELS, _POINTS = 4, 8  # of the integration along an arc


@frozen(eq=False)
class WindLoad:
    """One wind set on the elements of a system; all zero where it does not act.

    load : (n_elem, 3) per length of axis, global [N/m].
    pressure : (n_elem,) mean velocity pressure q over the length [Pa].
    change : (n_elem,) largest less smallest pressure along the element [Pa].
    height : (n_elem, 2) of the ends above ground [m].
    width : (n_elem,) diameter of pipe and insulation [m].
    """

    wind: Wind
    load: F8
    pressure: F8
    change: F8
    height: F8
    width: F8


def pressure_of(speed: float) -> float:
    """Velocity pressure [Pa] of a speed [m/s]: rho v^2/2 with rho = 1.225 kg/m3."""
    return 0.5 * AIR * speed**2


def wind_loads(model: Model, system: System) -> dict[str, WindLoad]:
    """Evaluate every wind set by the name of its term, WIND1 ... WIND9."""
    return {f"WIND{wind.set}": wind_load(model, system, wind) for wind in model.winds}


def wind_load(model: Model, system: System, wind: Wind) -> WindLoad:
    """Evaluate one wind set, which `wind_problems` found sound."""
    width = widths(model, system)
    height = (system.xyz @ system.up)[system.ends] - wind.ground
    toward = np.array(wind.direction) / np.linalg.norm(wind.direction)
    n = len(width)
    pressure, force, change = np.zeros(n), np.zeros((n, 3)), np.zeros(n)
    at = np.flatnonzero((system.kind != SPRING) & (system.kind != ARC) & (width > 0.0))
    pressure[at] = _mean_pressure(wind, height[at])
    force[at] = pressure[at, None] * _cross_flow(toward, system.axes[at, 0])
    between = height[at, :1] + np.diff(height[at]) * np.linspace(0.0, 1.0, 9)
    change[at] = np.ptp(_pressure(wind, between), axis=1)
    at = np.flatnonzero((system.kind == ARC) & (width > 0.0))
    if at.size:
        weight, tangent, rise = _along_arcs(system, at)
        local = _pressure(wind, height[at, :1] + rise)
        pressure[at] = local @ weight
        force[at] = np.einsum("p,ep,epi->ei", weight, local, _cross_flow(toward, tangent))
        change[at] = np.ptp(local, axis=1)
    gust = wind.gust if wind.speed is not None else 1.0
    load = gust * wind.shape * width[:, None] * force
    return WindLoad(wind, load, pressure, change, height, width)


def snow_load(model: Model, system: System) -> F8:
    """Snow or ice (n_elem, 3) [N/m], downwards on every length of pipe whatever its slope.

    Ice covers a riser too; bodies without weight of their own (construction aids) carry none.
    """
    total = sum(snow.weight for snow in model.snows)
    carries = (widths(model, system) > 0.0).astype(np.float64)
    load: F8 = -np.outer(total * carries, system.up)
    return load


def widths(model: Model, system: System) -> F8:
    """Diameter of pipe and insulation (n_elem,) [m].

    A rigid has that of its own SECTION, a reducer the mean of its ends; 0 for a rigid without
    weight, a construction aid that is not there, for springs and expansion joints.
    """
    cover = {name: s.od + 2.0 * s.insulation for name, s in model.sections.items()}
    rows = [
        0.0 if p.joint or (p.rigid and p.weight == 0.0) else cover[p.section] for p in model.pipes
    ]
    for i, pipe in enumerate(model.pipes):
        if pipe.reducer is not None:
            rows[i] = 0.5 * (rows[i] + cover[pipe.reducer.section])
    found: F8 = np.where(system.kind == SPRING, 0.0, np.array([*rows, 0.0])[system.source])
    return found


def wind_problems(winds: Sequence[Wind]) -> list[Problem]:
    """List what keeps wind sets from being evaluated."""
    problems: list[Problem] = []
    for i, wind in enumerate(winds):
        faults = _faults(wind)
        if wind.set in {other.set for other in winds[:i]}:
            faults.append("the set is given twice")
        problems += [Problem(wind.place, f"WIND{wind.set}: {fault}") for fault in faults]
    return problems


def wind_remarks(system: System, found: WindLoad) -> tuple[str, ...]:
    """Say where one load an element is coarse, and where the force coefficient may be low."""
    wind, name = found.wind, f"WIND{found.wind.set}"
    remarks: list[str] = []
    force = np.linalg.norm(found.load, axis=1)
    struck = force > 1e-9 * force.max(initial=0.0)
    part = found.change / np.where(found.pressure > 0.0, found.pressure, 1.0)
    part[~struck] = 0.0
    uneven = np.flatnonzero(part > UNEVEN)
    if uneven.size:
        worst = system.parts[int(np.argmax(part))]
        more = f" and {uneven.size - 1} more" if uneven.size > 1 else ""
        remarks.append(
            f"{name}: the pressure changes by {part.max():.0%} along {worst.start}-{worst.end}"
            f"{more}: the mean acts, nodes in between follow it closer"
        )
    small = is_small(found.width, found.pressure) & struck
    if wind.speed is not None and wind.shape < SMALL_SHAPE and small.any():
        count = f"{small.sum()} element{'s' if small.sum() > 1 else ''}"
        remarks.append(
            f"{name}: {count} with D sqrt(q) up to 5.3: ASCE 7 Figure 29.4-1 gives small pipes"
            f" a force coefficient of {SMALL_SHAPE:g}, SHAPE is {wind.shape:g}"
        )
    return tuple(remarks)


def _cross_flow(toward: F8, tangent: F8) -> F8:
    """Return |n| n (..., 3), n the part of the unit vector `toward` normal to unit tangents."""
    normal = toward - (tangent @ toward)[..., None] * tangent
    made: F8 = np.linalg.norm(normal, axis=-1, keepdims=True) * normal
    return made


def _along_arcs(system: System, at: Index) -> tuple[F8, F8, F8]:
    """Points of arcs: weights (n_point,) of sum 1, tangents (n, n_point, 3), rises from end 1."""
    x, w = np.polynomial.legendre.leggauss(_POINTS)
    fraction = ((np.arange(_PANELS)[:, None] + 0.5 * (x + 1.0)) / _PANELS).ravel()
    turned = (system.angle[at, None] * fraction)[..., None]
    ex, ey = system.axes[at, None, 0], system.axes[at, None, 1]
    tangent = np.cos(turned) * ex + np.sin(turned) * ey
    chord = np.sin(turned) * ex + (1.0 - np.cos(turned)) * ey
    return (
        np.tile(0.5 * w / _PANELS, _PANELS),
        tangent,
        system.radius[at, None] * (chord @ system.up),
    )


def _mean_pressure(wind: Wind, height: F8) -> F8:
    """Mean over the heights from height[:, 0] to height[:, 1] (n,)."""
    rise = height[:, 1] - height[:, 0]
    level = np.abs(rise) < _LEVEL
    total = _pressure_integral(wind, height)
    mean = (total[:, 1] - total[:, 0]) / np.where(level, 1.0, rise)
    return np.where(level, _pressure(wind, height.mean(axis=1)), mean)


def _pressure(wind: Wind, height: F8) -> F8:
    """Velocity pressure at heights above ground; a table is linear, its ends hold beyond it."""
    if wind.speed is not None:
        basic = basic_pressure(wind.speed, wind.kzt, wind.kd)
        return basic * exposure_coefficient(height, wind.exposure)
    z, q = np.array(wind.table, dtype=np.float64).T
    found: F8 = np.interp(height, z, q)
    return found


def _pressure_integral(wind: Wind, height: F8) -> F8:
    """Integral of the pressure over the height up to each `height`, from any fixed start."""
    if wind.speed is not None:
        basic = basic_pressure(wind.speed, wind.kzt, wind.kd)
        return basic * exposure_integral(height, wind.exposure)
    z, q = np.array(wind.table, dtype=np.float64).T
    whole = np.append(0.0, np.cumsum(0.5 * (q[1:] + q[:-1]) * np.diff(z)))
    inside = np.clip(height, z[0], z[-1])
    i = np.clip(np.searchsorted(z, inside, side="right") - 1, 0, max(len(z) - 2, 0))
    total = whole[i] + 0.5 * (q[i] + np.interp(inside, z, q)) * (inside - z[i])
    total += q[0] * np.minimum(height - z[0], 0.0) + q[-1] * np.maximum(height - z[-1], 0.0)
    found: F8 = total
    return found


def _faults(wind: Wind) -> list[str]:
    faults: list[str] = []
    if not (np.isfinite(wind.direction).all() and np.any(wind.direction)):
        faults.append("the wind has no direction")
    if not wind.shape > 0.0:
        faults.append(f"the shape factor {wind.shape:g} is not positive")
    if (wind.speed is not None) == bool(wind.table):
        faults.append("give either a table or a speed for ASCE 7")
    if wind.speed is not None:
        if wind.exposure not in GRADIENT:
            faults.append(f"exposure {wind.exposure} is not one of B C D")
        given = {"speed": wind.speed, "Kzt": wind.kzt, "Kd": wind.kd, "gust factor": wind.gust}
        faults += [f"{what} {x:g} is not positive" for what, x in given.items() if not x > 0.0]
    if wind.table:
        z, q = np.array(wind.table, dtype=np.float64).T
        if not (np.diff(z) >= 0.0).all():
            faults.append("the elevations do not ascend")
        if not (np.isfinite(z).all() and np.isfinite(q).all() and (q >= 0.0).all()):
            faults.append("elevations must be finite and pressures not negative")
    return faults
