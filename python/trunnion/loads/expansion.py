"""Material properties at temperature: modulus and free strain from the table of a material."""

from itertools import pairwise

from trunnion.model import Material


class OutsideTableError(ValueError):
    """A temperature lies outside the table, or there is no table."""


def interpolate(points: list[tuple[float, float]], t: float, what: str) -> float:
    """Linear interpolation between (temperature, value) points in rising temperature.

    Parameters
    ----------
    points : temperature [C] and value, at least one.
    t : temperature [C].
    what : words for the refusal outside the table.
    """
    low, high = points[0][0], points[-1][0]
    if not low <= t <= high:
        raise OutsideTableError(f"{t:g} C is outside the table of {what}, {low:g} to {high:g} C")
    for (t0, v0), (t1, v1) in pairwise(points):
        if t <= t1:
            return v0 + (v1 - v0) * ((t - t0) / (t1 - t0))
    return points[-1][1]


def modulus_at(material: Material, t: float) -> float:
    """Young's modulus at `t` [Pa].

    The modulus of the MATERIAL card stands at the table's reference temperature, unless the table
    begins below it.
    """
    points = [(p.t, p.e) for p in material.table if p.e is not None]
    if not points:
        raise OutsideTableError("there is no table of the modulus")
    if points[0][0] > material.table_tref:
        points.insert(0, (material.table_tref, material.e))
    return interpolate(points, t, "the modulus")


def free_strain(material: Material, t: float, tref: float) -> float:
    """Thermal strain of a free pipe that was built at `tref` and stands at `t` [C].

    With a table of mean coefficients a(T) from T0: a(T)(T - T0) - a(TREF)(TREF - T0); else
    alpha (T - TREF).
    """
    points = [(p.t, p.alpha) for p in material.table if p.alpha is not None]
    if not points:
        return material.alpha * (t - tref)

    def from_t0(temperature: float) -> float:
        rise = temperature - material.table_tref
        return 0.0 if rise == 0.0 else rise * interpolate(points, temperature, "expansion")

    return from_t0(t) - from_t0(tref)
