"""Wind of ASCE 7-16 on pipes: velocity pressure against height, chapters 26 and 29.

F = qz G Cf Af (Eq. 29.4-1) with qz = 0.613 Kz Kzt Kd Ke V^2 (Eq. 26.10-1, SI).  Of these the user
gives V, Kzt, Kd, G and Cf; Ke is 1, which Table 26.9-1 permits everywhere and which is safe.

- Kd is 1 for round chimneys, tanks and similar structures (Table 26.6-1); editions before 2016
  have 0.95.  It belongs to the load combinations of chapter 2.
- G is 0.85 for rigid structures, 1 Hz and above (26.11.4); a flexible one needs 26.11.5.
- Kzt is 1 on flat ground (26.8.2).  It is taken as given, at every height.
- Cf of a long round pipe (Figure 29.4-1, h/D = 25): 0.7 when moderately smooth, 0.9 rough, 1.2
  very rough; 1.2 whatever the surface where D sqrt(qz) is 5.3 or less.
"""

import numpy as np

from trunnion.arrays import B1, F8

FACTOR = 0.613  # half the density of air, Eq. 26.10-1 [N s2/m4]
LOWEST = 4.572  # below 15 ft the coefficient of 15 ft holds (Table 26.10-1) [m]
TOP_COEFFICIENT = 2.01  # at the gradient height and, here, above it
GRADIENT = {  # Table 26.11-1: power alpha, gradient height zg [m] (1200, 900, 700 ft)
    "B": (7.0, 365.76),
    "C": (9.5, 274.32),
    "D": (11.5, 213.36),
}
SMALL = 5.3  # D sqrt(qz) up to which Figure 29.4-1 has one coefficient for all surfaces [N^0.5]
SMALL_SHAPE = 1.2  # that coefficient, h/D = 25


def exposure_coefficient(height: F8, exposure: str) -> F8:
    """Kz at heights above ground [m]: 2.01 (z/zg)^(2/alpha), Table 26.10-1 note 1."""
    alpha, top = GRADIENT[exposure]
    z: F8 = np.clip(height, LOWEST, top)
    kz: F8 = TOP_COEFFICIENT * (z / top) ** (2.0 / alpha)
    return kz


def exposure_integral(height: F8, exposure: str) -> F8:
    """Integral of Kz over the height, from the ground up to each `height` [m]."""
    alpha, top = GRADIENT[exposure]
    power = 1.0 + 2.0 / alpha
    z: F8 = np.clip(height, LOWEST, top)
    below = exposure_coefficient(np.array(0.0), exposure) * np.minimum(height, LOWEST)
    along = TOP_COEFFICIENT * top / power * ((z / top) ** power - (LOWEST / top) ** power)
    above = TOP_COEFFICIENT * np.maximum(height - top, 0.0)
    total: F8 = below + along + above
    return total


def basic_pressure(speed: float, kzt: float, kd: float) -> float:
    """Velocity pressure where Kz is 1 [Pa]: 0.613 Kzt Kd V^2, V in m/s."""
    return FACTOR * kzt * kd * speed**2


def is_small(width: F8, pressure: F8) -> B1:
    """Tell where Figure 29.4-1 asks for the coefficient of small pipes: D sqrt(qz) <= 5.3."""
    small: B1 = width * np.sqrt(pressure) <= SMALL
    return small
