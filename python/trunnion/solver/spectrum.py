"""Response spectra: what each mode answers to each shock, and how the answers combine.

A shock moves supports in one direction: all of them (uniform motion), or those of one group
(independent support motion).  With relative displacements u about the moving base, and r the
displacements that a unit movement of the shock's supports makes statically,

    M u" + K u = - M r a(t),

so that mode i (mass-normalised) reaches u_i = phi_i gamma_i Sa(f_i) / omega_i^2 at most, with
the participation gamma_i = phi_i . M r.  All that combines methods acts on these amplitudes: the
forces of a mode are its amplitude times those of its shape.
"""

from dataclasses import dataclass

import numpy as np

from trunnion.arrays import F8
from trunnion.model import Shock, Spectrum, SpectrumUse
from trunnion.solver.combination import OVER, combine_modes, srss


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Drive:
    """One shock made numbers.

    amplitude : (m,) of the mass-normalised modes [kg^0.5 m].
    missed : (q,) response that the modes leave out, or None.
    """

    direction: str
    amplitude: F8
    missed: F8 | None = None


def acceleration(spectrum: Spectrum, frequency: F8) -> F8:
    """Spectral acceleration [m/s2] at frequencies [Hz]; the end values hold beyond the ends.

    Between its points a spectrum is a straight line in the logarithms of both, or in frequency
    or period and acceleration, as its INTERP= and X= say.
    """
    f, a = np.array(spectrum.frequency), np.array(spectrum.acceleration)
    found: F8
    if spectrum.log:
        found = np.exp(np.interp(np.log(frequency), np.log(f), np.log(a)))
    elif spectrum.by_period:
        found = np.interp(-1.0 / frequency, -1.0 / f, a)
    else:
        found = np.interp(frequency, f, a)
    return found


def amplitudes(spectrum: Spectrum, factor: float, frequency: F8, participation: F8) -> F8:
    """(m,) largest amplitudes of mass-normalised modes under one shock [kg^0.5 m].

    Parameters
    ----------
    frequency : (m,) [Hz].
    participation : (m,) of the shock [kg^0.5].
    """
    found: F8 = (
        factor * participation * acceleration(spectrum, frequency) / (2.0 * np.pi * frequency) ** 2
    )
    return found


def zero_period(shock: Shock, spectrum: Spectrum, zpa: float | None) -> float:
    """Acceleration of what is too stiff to vibrate [m/s2].

    That of the case (ZPA=), else the spectrum at its highest frequency; times the shock's factor.
    """
    return shock.factor * (spectrum.acceleration[-1] if zpa is None else zpa)


def missed(rigid: F8, modal: F8, frequency: F8, participation: F8, zpa: float) -> F8:
    """Response of the mass that the modes leave out, at zero period acceleration.

    The inertia that is left out, M (r - sum gamma_i phi_i), acts statically; K^-1 M phi_i is
    phi_i / omega_i^2.

    Parameters
    ----------
    rigid : (q,) static response to the inertia M r of unit acceleration.
    modal : (m, q) response of each mass-normalised shape.
    """
    found: F8 = zpa * (rigid - (participation / (2.0 * np.pi * frequency) ** 2) @ modal)
    return found


def combine(modal: F8, frequency: F8, drives: list[Drive], use: SpectrumUse) -> F8:
    """(q,) largest responses, positive.

    Groups that move in one direction combine first, mode by mode (GROUPS=).  Then the modes of
    each direction (MODAL=) and after them the directions (SPATIAL=); with FIRST=DIRECTIONS the
    directions of each mode, and after them the modes, which then have lost their signs.  What
    the modes left out counts as one more mode, far from all others.
    """
    directions = list(dict.fromkeys(drive.direction for drive in drives))
    moving = [[d for d in drives if d.direction == name] for name in directions]
    amplitude = np.array([_grouped([d.amplitude for d in same], use) for same in moving])
    left = [[d.missed for d in same if d.missed is not None] for same in moving]
    rest = [_grouped(parts, use) if parts else None for parts in left]
    over_directions = OVER[use.spatial]
    if use.first == "DIRECTIONS":
        rigids = [part for part in rest if part is not None]
        rigid = over_directions(np.array(rigids)) if rigids else None
        shared = amplitude[0] if len(amplitude) == 1 else over_directions(amplitude)
        return _modes(shared[:, None] * modal, frequency, rigid, use)
    each = [
        _modes(a[:, None] * modal, frequency, rigid, use)
        for a, rigid in zip(amplitude, rest, strict=True)
    ]
    return over_directions(np.array(each))


def _grouped(parts: list[F8], use: SpectrumUse) -> F8:
    """Groups of supports combined; a single one keeps its sign."""
    return parts[0] if len(parts) == 1 else OVER[use.groups](np.array(parts))


def _modes(r: F8, frequency: F8, rigid: F8 | None, use: SpectrumUse) -> F8:
    """Modes combined, and the missing mass with them."""
    found = combine_modes(r, frequency, use.modal, damping=use.damping, duration=use.duration)
    if rigid is None:
        return found
    last = np.array([found, np.abs(rigid)])
    return OVER["ABS"](last) if use.modal == "ABS" else srss(last)
