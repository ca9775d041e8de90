"""Flexibility factors of bends that are not plain elbows: mitres, and walls of their own."""

from math import pi, tan

from trunnion.formats.caesar.geometry import Corner
from trunnion.formats.caesar.job import BendData, Element
from trunnion.frozen import frozen

SAME_WALL = 5e-3  # of the pipe's wall: a fitting wall this near to it is no wall of its own
RIGHT = 0.0087  # a turn this near to 90 degrees is a right angle [rad]


@frozen
class Factor:
    """Flexibility factor, None for that of a plain elbow; and where it comes from."""

    k: float | None = None
    text: str = ""


def factor_of(bend: BendData, e: Element, corner: Corner, modulus: float, *, b31j: bool) -> Factor:
    """Give the factor of a bend that has one of its own.

    ASME B31.3 Table D300: closely spaced mitres (s < r2 (1 + tan theta)) have h = cot theta T s /
    (2 r2^2), widely spaced ones h = (1 + cot theta) T / (2 r2), both k = 1.52 / h^(5/6); an elbow
    has h = T R / r2^2 and k = 1.65 / h, where T is the wall of the fitting and r2 the mean radius
    of the pipe.  Note 3 corrects for flanges, note 7 elbows for the largest pressure.

    Parameters
    ----------
    modulus : of the pipe [Pa], for the note on pressure.
    b31j : the job is one of ASME B31J, where an elbow of 90 degrees has k = 1.3/h.
    """
    if bend.k >= 1.0:
        return Factor(bend.k, f"flexibility factor {bend.k:g} as in the file")
    own_wall = bend.fitting_wall > 0.0 and abs(bend.fitting_wall - e.wall) > SAME_WALL * e.wall
    wall = bend.fitting_wall if own_wall else e.wall
    turn = bend.whole or corner.turn
    r2 = 0.5 * (e.od - e.wall)
    if not (r2 > 0.0 and wall > 0.0):
        return Factor()
    if bend.miters:
        theta = 0.5 * turn / bend.miters
        close = bend.miters > 1 and 2.0 * corner.radius * tan(theta) < r2 * (1.0 + tan(theta))
        h = wall * corner.radius / r2**2 if close else 0.5 * (1.0 + 1.0 / tan(theta)) * wall / r2
        k = 1.52 * h ** (-5.0 / 6.0) * min(1.0, h ** (bend.flanges / 6.0))
        spaced = f"{'closely' if close else 'widely'} spaced mitre bend of {bend.miters} cut"
        spaced += "s" if bend.miters > 1 else ""
        text = f"{spaced}: an arc with k = 1.52/h^(5/6), h = {h:.4g}, of ASME B31.3 Table D300"
        return Factor(_digits(k), text)
    right = b31j and abs(turn - 0.5 * pi) < RIGHT
    if not own_wall and not right:
        return Factor()
    top = 1.3 if right else 1.65
    h = wall * corner.radius / r2**2
    k = max(1.0, top / h * min(1.0, h ** (bend.flanges / 6.0)))
    pressure = max((p for p in e.p if p is not None), default=0.0)
    slender = (r2 / wall) ** (7.0 / 3.0) * (corner.radius / r2) ** (1.0 / 3.0)
    k /= 1.0 + 6.0 * max(0.0, pressure) / modulus * slender
    if not own_wall:
        return Factor(_digits(k), f"elbow of 90 degrees: k = 1.3/h of ASME B31J, h = {h:.4g}")
    text = f"bend with a wall of {1e3 * wall:.4g} mm: k = {top}/h with it, h = {h:.4g}"
    return Factor(_digits(k), f"{text}; its weight and section are those of the pipe")


def _digits(k: float) -> float:
    """Factor of at least 1, to 7 digits."""
    return float(f"{max(1.0, k):.7g}")
