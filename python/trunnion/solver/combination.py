"""Combination of the responses of modes, directions and groups of supports that peak apart."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8

CLOSE = 0.1  # modes are closely spaced within this part of the lowest of their group


def srss(r: F8) -> F8:
    """Square root of the sum of squares over the first axis."""
    found: F8 = np.sqrt((r * r).sum(axis=0))
    return found


def absolute(r: F8) -> F8:
    """Sum of absolute values over the first axis."""
    found: F8 = np.abs(r).sum(axis=0)
    return found


def combine_modes(
    r: F8, frequency: F8, method: str, *, damping: float = 0.02, duration: float = 10.0
) -> F8:
    """Probable largest response from the largest responses of the modes.

    Parameters
    ----------
    r : (m, ...) signed response of each mode.
    frequency : (m,) ascending [Hz].
    method : SRSS; ABS; GROUP and DSUM of US NRC Regulatory Guide 1.92 revision 1 (1976),
        equations 4 and 5, which take absolute values of the products; CQC of Der Kiureghian
        (1981), which keeps the signs.
    damping : fraction of critical, the same for all modes (CQC and DSUM).
    duration : of the strong motion [s] (DSUM).

    Returns
    -------
    (...) positive.
    """
    if method == "SRSS":
        return srss(r)
    if method == "ABS":
        return absolute(r)
    if method == "GROUP":
        first = np.array([group[0] for group in close_groups(frequency)], np.intp)
        return srss(np.add.reduceat(np.abs(r), first, axis=0) if len(r) else r)
    if method == "CQC":
        return _double_sum(r, cqc_factors(frequency, damping))
    if method == "DSUM":
        return _double_sum(np.abs(r), dsum_factors(frequency, damping, duration))
    raise ValueError(f"modal combination {method} is not one of {' '.join(METHODS)}")


METHODS = ("SRSS", "GROUP", "CQC", "ABS", "DSUM")
OVER: dict[str, Callable[[F8], F8]] = {"SRSS": srss, "ABS": absolute}


def close_groups(frequency: F8) -> list[NDArray[np.intp]]:
    """Groups of closely spaced modes (Regulatory Guide 1.92 revision 1, 1.2.1).

    A group starts at the lowest mode that is in none yet and takes in all modes up to 10 % above
    it; no mode is in two groups.
    """
    groups: list[list[int]] = []
    for i, f in enumerate(frequency.tolist()):
        if groups and f <= (1.0 + CLOSE) * frequency[groups[-1][0]]:
            groups[-1].append(i)
        else:
            groups.append([i])
    return [np.array(group, np.intp) for group in groups]


def cqc_factors(frequency: F8, damping: float) -> F8:
    """(m, m) correlation of modes of one damping under white noise (Der Kiureghian 1981)."""
    low = np.minimum(frequency[:, None], frequency)
    ratio = low / np.maximum(frequency[:, None], frequency)
    above = 8.0 * damping**2 * (1.0 + ratio) * ratio**1.5
    below = (1.0 - ratio**2) ** 2 + 4.0 * damping**2 * ratio * (1.0 + ratio) ** 2
    factors: F8 = above / below
    return factors


def dsum_factors(frequency: F8, damping: float, duration: float) -> F8:
    """(m, m) factors of the double sum (Regulatory Guide 1.92 revision 1, equations 6 to 9)."""
    omega = 2.0 * np.pi * frequency
    damped = omega * np.sqrt(1.0 - damping**2)
    wide = damping * omega + 2.0 / duration
    factors: F8 = 1.0 / (1.0 + ((damped[:, None] - damped) / (wide[:, None] + wide)) ** 2)
    return factors


def _double_sum(r: F8, factors: F8) -> F8:
    """Root of the quadratic form of the factors, for each response."""
    flat = r.reshape(len(r), -1)
    square = (flat * (factors @ flat)).sum(axis=0)
    found: F8 = np.sqrt(np.maximum(square, 0.0)).reshape(r.shape[1:])
    return found
