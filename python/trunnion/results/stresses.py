"""Nominal stresses of pipe sections: what beam theory and Lame give, intensification 1.

Longitudinal stress is the section's axial force over the metal area, plus the pressure's own
p d2 / (D2 - d2), plus bending.  The axial force of a pipe model is that of loads and supports;
the thrust of the pressure on closed ends is in no element force and so is added wherever pressure
acts.  (A fully held pipe whose pressure elongation is on then carries 2 nu p d2 / (D2 - d2), as
it must; with it off the sum is on the safe side.)

Principal stresses, von Mises and Tresca are taken where one of them can be largest: both extreme
fibres of bending with torsion, and the neutral axis with torsion and direct shear, each on the
inner wall (radial stress -p) and on the outer; the largest of the six points is given.
"""

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8, SPRING, TAPER, CaseResult, System
from trunnion.frozen import frozen
from trunnion.results.balance import section_forces
from trunnion.results.interior import mid_points

RIGID = ("rigid", "valve", "flange")  # bodies whose stresses are not those of a pipe


@frozen(eq=False)
class Stresses:
    """Stresses [Pa] at n sections; bending, shear and torsion are sizes.

    axial : N / A, tension positive, without pressure.
    pressure : longitudinal stress of the internal pressure.
    bending : M / Z at the outer fibre.
    shear : largest direct shear, at the neutral axis.
    torsion : T / 2Z at the outer wall.
    hoop_inner, hoop_outer : Lame's.
    barlow : p D / 2t.
    principal_max, principal_min : largest and smallest principal stress of all points.
    von_mises : equivalent stress.
    max_shear : half of Tresca's stress intensity.
    """

    axial: F8
    pressure: F8
    bending: F8
    shear: F8
    torsion: F8
    hoop_inner: F8
    hoop_outer: F8
    barlow: F8
    principal_max: F8
    principal_min: F8
    von_mises: F8
    max_shear: F8

    @property
    def longitudinal(self) -> F8:
        """Axial and pressure with bending, on the fibre where the sum is largest in size."""
        direct = self.axial + self.pressure
        return direct + np.where(direct < 0.0, -self.bending, self.bending)


def pipe_stresses(od: F8, wall: F8, force: F8, pressure: F8) -> Stresses:
    """Stresses of round pipe sections.

    Parameters
    ----------
    od, wall : (n,) outside diameter and wall [m]; a solid bar has wall = od / 2.
    force : (n, 6) N Vy Vz T My Mz of the section, N > 0 tension [N, N m].
    pressure : (n,) internal pressure [Pa].
    """
    bore = od - 2.0 * wall
    squares, area = od**2 + bore**2, 0.25 * np.pi * (od**2 - bore**2)
    modulus = np.pi / 32.0 * (od**4 - bore**4) / od
    axial = force[:, 0] / area
    bending = np.hypot(force[:, 4], force[:, 5]) / modulus
    torsion = np.abs(force[:, 3]) / (2.0 * modulus)
    # V Q / (I 2t) of a ring (Timoshenko, Strength of Materials I, art. 26): 2 V / A when thin
    rise = 4.0 / 3.0 * (squares + od * bore) / squares
    shear = np.hypot(force[:, 1], force[:, 2]) / area * rise
    # Lame (Timoshenko, Strength of Materials II, art. 40)
    end = pressure * bore**2 / (od**2 - bore**2)
    hoop_inner, hoop_outer = end + pressure * od**2 / (od**2 - bore**2), 2.0 * end

    direct, inner = axial + end, bore / od
    walls = ((1.0, hoop_outer, np.zeros_like(pressure)), (inner, hoop_inner, -pressure))
    points = [
        _combined(direct + fibre * ratio * bending, hoop, radial, ratio * torsion + cut * shear)
        for ratio, hoop, radial in walls
        for fibre, cut in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0))
    ]
    high, low, mises, tresca = (np.stack(rows) for rows in zip(*points, strict=True))
    return Stresses(
        axial=axial,
        pressure=end,
        bending=bending,
        shear=shear,
        torsion=torsion,
        hoop_inner=hoop_inner,
        hoop_outer=hoop_outer,
        barlow=pressure * od / (2.0 * wall),
        principal_max=high.max(axis=0),
        principal_min=low.min(axis=0),
        von_mises=mises.max(axis=0),
        max_shear=tresca.max(axis=0),
    )


def _combined(along: F8, around: F8, radial: F8, shear: F8) -> tuple[F8, F8, F8, F8]:
    """Largest and smallest principal stress, von Mises stress and largest shear at a point."""
    middle, radius = 0.5 * (along + around), np.hypot(0.5 * (along - around), shear)
    high = np.maximum(middle + radius, radial)
    low = np.minimum(middle - radius, radial)
    squares = (along - around) ** 2 + (around - radial) ** 2 + (radial - along) ** 2
    return high, low, np.sqrt(0.5 * squares + 3.0 * shear**2), 0.5 * (high - low)


def pipe_elements(system: System) -> NDArray[np.intp]:
    """Numbers of the elements that have pipe stresses: no springs and no rigid bodies."""
    rigid = np.array([part.type in RIGID for part in system.parts], bool)
    return np.flatnonzero((system.kind != SPRING) & (system.od > 0.0) & ~rigid)


def end_stresses(case: CaseResult) -> tuple[NDArray[np.intp], Stresses, Stresses]:
    """Elements of a solved case with pipe stresses, and these at their first and second ends."""
    if case.state is None:
        raise ValueError(f"{case.name} has no numbers")
    system = case.system
    element = pipe_elements(system)
    od, wall = system.od[element], system.wall[element]
    pressure = np.zeros(len(element)) if case.loads is None else case.loads.pressure[element]
    force = section_forces(case)[element]
    first = pipe_stresses(od, wall, force[:, 0], pressure)
    if len(system.taper):
        narrow = system.kind[element] == TAPER
        od = np.where(narrow, system.taper[element, 0], od)
        wall = np.where(narrow, system.taper[element, 1], wall)
    return element, first, pipe_stresses(od, wall, force[:, 1], pressure)


def mid_stresses(case: CaseResult) -> tuple[tuple[str, ...], Stresses]:
    """Labels of the bends' middles that are no nodes (30M), and the stresses there.

    Both are empty where interior points have no meaning.
    """
    middle, system = mid_points(case), case.system
    if middle is None or case.loads is None:
        nothing = np.zeros(0)
        return (), pipe_stresses(nothing, nothing, np.zeros((0, 6)), nothing)
    at = middle.element
    force, pressure = middle.section_force, case.loads.pressure[at]
    return tuple(system.mid), pipe_stresses(system.od[at], system.wall[at], force, pressure)
