"""Forces of relief valves and slugs as static loads: what FORCE cards take.

A transient force becomes a static one by a dynamic load factor (DLF): 2 covers a force that
comes at once and stays, whatever the piping.  Each function gives a force *on the pipe*, global.

    fx, fy, fz = open_discharge(flow=..., velocity=..., pressure=..., area=..., jet=(0, 1, 0))
    model.force("40", "F1", FX=fx, FY=fy, FZ=fz)
"""

from math import pi, sin, sqrt

from trunnion.system.vectors import Vec, scale, sub, unit

ATMOSPHERE = 101325.0  # [Pa]
SUDDEN = 2.0  # DLF of a force that comes at once and stays
LEAST = 1.1  # DLF below which ASME B31.1 Appendix II does not go
GAS = 8314.46  # [J/(kmol K)]
_BTU_LB = 2326.0  # [J/kg]

# ASME B31.1 Appendix II, II-2.2: a [J/kg] and b of steam expanding to the exit
STEAM = {
    "WET": (291.0 * _BTU_LB, 11.0),  # below 90 % quality
    "SATURATED": (823.0 * _BTU_LB, 4.33),  # 90 % and above
    "SUPERHEATED": (831.0 * _BTU_LB, 4.33),
}


def open_discharge(
    *,
    flow: float,
    velocity: float,
    pressure: float,
    area: float,
    jet: Vec,
    dlf: float = SUDDEN,
    atmosphere: float = ATMOSPHERE,
) -> Vec:
    """Force of an open discharge: DLF (W V + (P - Pa) A) against the jet.

    ASME B31.1 Appendix II, II-2.2.1 (F = W V / gc + (P - Pa) A in US units).

    Parameters
    ----------
    flow : mass flow W [kg/s]; B31.1 takes 1.11 times the stamped capacity.
    velocity : V at the exit [m/s].
    pressure : static pressure P at the exit, absolute [Pa].
    area : flow area A at the exit [m2].
    jet : direction in which the fluid leaves, of any length.
    dlf : dynamic load factor, see `dynamic_load_factor`.
    """
    return scale(-dlf * (flow * velocity + (pressure - atmosphere) * area), _along("jet", jet))


def steam_exit(flow: float, area: float, enthalpy: float, condition: str) -> tuple[float, float]:
    """Velocity [m/s] and absolute pressure [Pa] where steam leaves an open pipe at the sonic limit.

    ASME B31.1 Appendix II, II-2.2.1: V = sqrt(2 (h0 - a)/(2 b - 1)),
    P = W/A (b - 1)/b sqrt(2 (h0 - a)/(2 b - 1)), with J and gc 1 in SI.

    Parameters
    ----------
    flow, area : mass flow [kg/s], flow area [m2].
    enthalpy : stagnation enthalpy h0 at the valve's inlet [J/kg].
    condition : WET, SATURATED or SUPERHEATED.
    """
    if condition not in STEAM:
        raise ValueError(f"condition {condition} is not one of {' '.join(STEAM)}")
    a, b = STEAM[condition]
    if enthalpy <= a:
        raise ValueError(f"the enthalpy {enthalpy:g} J/kg is below {a:g} of {condition} steam")
    velocity = sqrt(2.0 * (enthalpy - a) / (2.0 * b - 1.0))
    return velocity, flow / area * (b - 1.0) / b * velocity


def gas_exit(
    flow: float, area: float, temperature: float, molar_mass: float, kappa: float
) -> tuple[float, float]:
    """Velocity [m/s] and absolute pressure [Pa] of an ideal gas leaving at the speed of sound.

    V = sqrt(2 k R T/((k + 1) M)), the momentum of API 520 Part II (129 W sqrt(k T/((k + 1) M)));
    P = W/A V/k by continuity.  A pressure below the atmosphere says that the flow is not choked:
    then V is too high and P is the atmosphere's.

    Parameters
    ----------
    flow, area : mass flow [kg/s], flow area [m2].
    temperature : stagnation temperature [K].
    molar_mass : [kg/kmol].
    kappa : ratio of specific heats.
    """
    velocity = sqrt(2.0 * kappa * GAS * temperature / ((kappa + 1.0) * molar_mass))
    return velocity, flow / area * velocity / kappa


def dynamic_load_factor(opening: float, period: float) -> float:
    """DLF of a force that rises evenly in the `opening` time [s] on a system of `period` [s].

    Largest response of one mass to a ramp that then stays, 1 + |sin(pi r)|/(pi r), r =
    opening/period (Biggs, Introduction to Structural Dynamics, 1964, section 2.3); from r = 1/2
    on its envelope 1 + 1/(pi r), as times are never that sure; at least 1.1.  ASME B31.1
    Appendix II draws such a curve as Figure II-3-2.
    """
    x = pi * opening / period
    if x == 0.0:
        return SUDDEN
    return max(LEAST, 1.0 + (sin(x) if x < 0.5 * pi else 1.0) / x)


def installation_period(mass: float, height: float, ei: float) -> float:
    """Period [s] of a valve of `mass` [kg] on a stub of `height` [m] and `ei` [N m2].

    2 pi sqrt(m h^3/(3 E I)), which is 0.1846 sqrt(W h^3/(E I)) of ASME B31.1 Appendix II,
    II-3.5.1.3, in lb, in, psi.
    """
    return 2.0 * pi * sqrt(mass * height**3 / (3.0 * ei))


def slug(
    *,
    density: float,
    area: float,
    velocity: float,
    inlet: Vec,
    outlet: Vec,
    dlf: float = SUDDEN,
) -> Vec:
    """Force of a slug at a bend: DLF rho A v^2 (inlet - outlet), change of its momentum.

    Along the inlet DLF rho A v^2 (1 - cos(a)), across it DLF rho A v^2 sin(a), together
    DLF rho A v^2 sqrt(2 (1 - cos(a))), outwards at the bend.

    Parameters
    ----------
    density, velocity : of the liquid slug [kg/m3], [m/s].
    area : flow area [m2].
    inlet, outlet : directions of the flow before and after the bend, of any length.
    """
    turn = sub(_along("inlet", inlet), _along("outlet", outlet))
    return scale(dlf * density * area * velocity**2, turn)


def _along(what: str, direction: Vec) -> Vec:
    found = unit(direction)
    if found == (0.0, 0.0, 0.0):
        raise ValueError(f"{what} has no direction")
    return found
