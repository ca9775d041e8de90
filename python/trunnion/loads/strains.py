"""Free strains: by temperature, and of closed-end pipe by pressure."""

from math import pi

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, TAPER, System
from trunnion.errors import Problem
from trunnion.forms import BORE2, forms, part_of, rigidity_at
from trunnion.loads.expansion import OutsideTableError, free_strain
from trunnion.model import Model


def strains(
    model: Model, system: System, problems: list[Problem]
) -> tuple[dict[str, F8], dict[str, int]]:
    """Free thermal strain by set; no strain where an element has no such temperature."""
    names = sorted({name for pipe in model.pipes for name in pipe.operation.t})
    rows = {name: [0.0] * (len(model.pipes) + 1) for name in names}
    bare = dict.fromkeys(names, 0)
    known: dict[tuple[str, float, float], float] = {}
    for i, pipe in enumerate(model.pipes):
        for name in names:
            t = pipe.operation.t.get(name)
            if t is None:
                bare[name] += 1
                continue
            key = (pipe.material, t, pipe.operation.tref)
            if key not in known:
                material = model.materials[pipe.material]
                known[key] = 0.0
                try:
                    known[key] = free_strain(material, t, pipe.operation.tref)
                except OutsideTableError as error:
                    text = f"MATERIAL {material.name}: T{name} of {pipe.start}-{pipe.end}: {error}"
                    problems.append(Problem(pipe.place, text))
            rows[name][i] = known[key]
    return {name: np.array(row)[system.source] for name, row in rows.items()}, bare


def pressures(model: Model, system: System) -> dict[str, F8]:
    """Return the pressure in each element by set; 0 where an element has none."""
    names = sorted({name for pipe in model.pipes for name in pipe.operation.p})
    return {
        name: np.array([*(p.operation.p.get(name, 0.0) for p in model.pipes), 0.0])[system.source]
        for name in names
    }


def pressure_effects(model: Model, system: System) -> tuple[F8, F8]:
    """Free strain and curvature of closed-end pipe by pressure, times EA/P.

    The end thrust P pi ri^2 gives the axial stress s = P ri^2/(ro^2 - ri^2) and, with the hoop
    stress 2 s on average, the strain s (1 - 2 nu)/E.

    A bend also opens.  In the torus (Timoshenko and Woinowsky-Krieger, Theory of Plates and
    Shells, art. 108 b) the membrane forces are N_axial = P r/2 everywhere and
    N_hoop = (P r/2) (2 R + r sin f)/(R + r sin f), f from the crown.  Let the angle of the bend
    change by the part w.  A fibre at rho = R + r sin f with strain e(f) moves outwards by
    rho (e - w).  Its slope round the section at the crown (f = 0) must be r e_hoop cos f, or the
    section would kink there: r (e - w) + R e' = r e_hoop at f = 0.  With
    e = P r (1 - 2 nu)/(2 E t), R e'/r = nu P r/(2 E t) and e_hoop = P r (2 - nu)/(2 E t):
    w = -P r/(2 E t) = -s/E, whatever R and nu.  The change of curvature is w/R.  Betti's theorem
    gives the same: the bore of a bend that a moment closes loses volume, pressure opens it.
    """
    settings = model.settings
    nothing = np.zeros(len(system.ends))
    if settings.bourdon == "OFF":
        return nothing, nothing
    nu = np.array([*(model.materials[p.material].nu for p in model.pipes), 0.0])[system.source]
    bore = system.od - 2.0 * system.wall
    thrust = 0.25 * pi * bore**2
    narrow = np.flatnonzero(system.kind == TAPER)
    if narrow.size:
        thrust[narrow] = _mean_thrust(system, narrow)
    elongation = thrust * (1.0 - 2.0 * nu)
    arcs = system.kind == ARC
    if settings.bourdon == "OPENING" and arcs.any():
        return elongation, np.where(arcs, -thrust / np.where(arcs, system.radius, 1.0), 0.0)
    return elongation, nothing


def _mean_thrust(system: System, at: NDArray[np.intp]) -> F8:
    """Bore area over EA, mean along reducers, times EA of their first end [m2]."""
    form, rigidity = forms(system)[at], system.rigidity[at]
    x, w = np.polynomial.legendre.leggauss(24)
    mean = np.zeros(len(at))
    for s, weight in zip(0.5 * (1.0 + x), 0.5 * w, strict=True):
        bore = part_of(form, 0.0, s)[:, BORE2]
        mean += weight * 0.25 * pi * bore**2 * rigidity[:, 0] / rigidity_at(form, rigidity, s)[:, 0]
    return mean
