"""Element stiffness and flexibility against 50-digit arithmetic (mpmath)."""

import mpmath as mp
import numpy as np
import pytest

from trunnion import kernels
from trunnion.arrays import ARC, STRAIGHT

mp.mp.dps = 50
EA, GJ, EI, GAS = 1.6e9, 1.05e7, 1.37e7, 3.1e8


def form(length, radius=0.0, angle=0.0):
    """One row of `forms`; what a straight or an arc does not use is zero."""
    out = np.zeros((1, 8))
    out[0, :3] = length, radius, angle
    return out


def flexibility(kind, length, radius, angle, rigidity, flex):
    """Tip flexibility in the element's axes by the engine, (6, 6)."""
    which, shape = np.array([kind], np.int32), form(length, radius, angle)
    return kernels.tip_flexibility(which, shape, np.array([rigidity]), np.array([flex]))[0]


def exact_arc(radius, angle, rigidity, flex):
    """Castigliano's integrals along the arc, by mpmath's own quadrature."""
    r, phi = mp.mpf(radius), mp.mpf(angle)
    ea, gj, ei, gas = map(mp.mpf, rigidity)

    def section(t):
        """6 x 6: N V Vz T M My of the section at t for unit tip forces, axes of end 1."""
        x = [r * mp.sin(phi) - r * mp.sin(t), r * (1 - mp.cos(phi)) - r * (1 - mp.cos(t)), 0]
        along, inward = [mp.cos(t), mp.sin(t), 0], [-mp.sin(t), mp.cos(t), 0]
        out = mp.zeros(6)
        for j in range(6):
            f = [mp.mpf(j == i) for i in range(3)]
            m = [mp.mpf(j == 3 + i) for i in range(3)]
            m[0] += x[1] * f[2]
            m[1] -= x[0] * f[2]
            m[2] += x[0] * f[1] - x[1] * f[0]
            for i, e in enumerate((along, inward)):
                out[i, j] = sum(a * b for a, b in zip(e, f, strict=True))
                out[3 + i, j] = sum(a * b for a, b in zip(e, m, strict=True))
            out[2, j], out[5, j] = f[2], m[2]
        return out

    soft = mp.diag(
        [1 / ea, 1 / gas if gas else 0, 1 / gas if gas else 0, 1 / gj, flex / ei, flex / ei]
    )

    def entry(i, j):
        def integrand(t):
            a = section(t)
            return r * sum(a[k, i] * soft[k, k] * a[k, j] for k in range(6))

        return mp.quad(integrand, [0, phi / 2, phi])

    return np.array([[float(entry(i, j)) for j in range(6)] for i in range(6)])


def exact_straight(length, rigidity, flex):
    """Timoshenko cantilever, x along the pipe."""
    long = mp.mpf(length)
    ea, gj, ei, gas = map(mp.mpf, rigidity)
    f = mp.zeros(6)
    f[0, 0], f[3, 3] = long / ea, long / gj
    sway = flex * long**3 / (3 * ei) + (long / gas if gas else 0)
    tilt, turn = flex * long**2 / (2 * ei), flex * long / ei
    f[1, 1], f[2, 2], f[4, 4], f[5, 5] = sway, sway, turn, turn
    f[1, 5], f[2, 4] = tilt, -tilt
    f += f.T - mp.diag([f[i, i] for i in range(6)])
    return np.array([[float(f[i, j]) for j in range(6)] for i in range(6)])


def scaled(f, g):
    """Largest difference, each entry relative to the root of its two diagonals."""
    size = np.sqrt(np.diag(g))
    return np.abs((f - g) / np.outer(size, size)).max()


@pytest.mark.parametrize("length", [1e-3, 0.05, 6.0, 1e3])
@pytest.mark.parametrize("gas", [GAS, 0.0])
def test_the_flexibility_of_a_straight_is_exact(length, gas):
    rigidity = (EA, GJ, EI, gas)
    found = flexibility(STRAIGHT, length, 0.0, 0.0, rigidity, 1.0)
    assert scaled(found, exact_straight(length, rigidity, 1)) <= 1e-15  # a few rounding units


@pytest.mark.parametrize("angle", [1e-4, 0.3, np.pi / 2, 3.0])
def test_the_flexibility_of_a_bend_is_exact(angle):
    rigidity = (EA, GJ, EI, GAS)
    found = flexibility(ARC, 0.4 * angle, 0.4, angle, rigidity, 7.3)
    # 24 terms of a quadrature, each rounded
    assert scaled(found, exact_arc(0.4, angle, rigidity, mp.mpf(7.3))) <= 2e-15


@pytest.mark.parametrize("shape", [(STRAIGHT, 6.0, 0.0, 0.0), (ARC, 0.6283, 0.4, np.pi / 2)])
def test_the_stiffness_inverts_the_flexibility(shape):
    kind, length, radius, angle = shape
    rigidity = (EA, GJ, EI, GAS)
    length = length if kind == STRAIGHT else radius * angle
    exact = (
        exact_straight(length, rigidity, 1)
        if kind == STRAIGHT
        else exact_arc(radius, angle, rigidity, mp.mpf(1))
    )
    found = kernels.element_stiffness(
        np.array([kind], np.int32), form(length, radius, angle), np.array([rigidity]),
        np.ones(1), np.zeros((1, 6)), np.eye(3)[None], np.zeros((1, 3)),
    )[0]  # fmt: skip
    inverse = mp.matrix(exact.tolist()) ** -1
    wanted = np.array([[float(inverse[i, j]) for j in range(6)] for i in range(6)])
    assert scaled(found, wanted) <= 1e-13  # condition of a bend's flexibility, about 100
