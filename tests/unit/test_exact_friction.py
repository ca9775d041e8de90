"""A straight line that slides on its rests, against 50-digit arithmetic (mpmath).

Every node rests with the same force, so the line settles evenly and only moves along itself:
n + 1 unknowns with a tridiagonal matrix, whose stick and slip follow by an active set.
"""

import mpmath
import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text

OD, WALL, E, ALPHA, SPAN = 0.1143, 0.00602, 203e9, 12e-6, 1.0
PUSH, MU, KF, HOLD = 1000.0, 0.3, 2e6, 3e7


def deck(n, hot, pull):
    """Line of n spans, held along itself at its first node, pulled at its last."""
    lines = [
        f"DEFAULT SHEAR=OFF KF={KF}",
        f"MATERIAL S E={E:g} NU=0.3 ALPHA={ALPHA:g} DENSITY=7850",
        f"SECTION P OD={OD} WALL={WALL}",
        f"OPERATE T1={hot} TREF=0",
        f"SUPPORT 0 X K={HOLD:g} MU=0",
        "SUPPORT 0 Z MU=0 RX",
        f"SUPPORT {n} Z MU=0",
        f"FORCE {n} F1 FX={pull}",
    ]
    lines += [f"PIPE {i} {i + 1} DX={SPAN}" for i in range(n)]
    lines += [f"SUPPORT {i} +Y MU={MU}" for i in range(n + 1)]
    lines += [f"FORCE {i} F1 FY={-PUSH}" for i in range(n + 1)]
    return "\n".join([*lines, "CASE A = F1 + T1", ""])


def exact(n, hot, pull):
    """Movements (n + 1,) [m] and friction forces [N]."""
    with mpmath.workdps(50):
        od, wall = mpmath.mpf(OD), mpmath.mpf(WALL)
        ea = mpmath.mpf(E) * mpmath.pi * wall * (od - wall)
        k, kf, most = ea / SPAN, mpmath.mpf(KF), mpmath.mpf(MU) * PUSH
        heat = ea * mpmath.mpf(ALPHA) * hot
        load = [mpmath.mpf(0)] * (n + 1)
        load[0] -= heat
        load[n] += heat + mpmath.mpf(pull)
        slip = [0] * (n + 1)
        while True:
            u = _tridiagonal(k, kf, load, slip, most)
            now = [int(mpmath.sign(x)) if abs(kf * x) > most else 0 for x in u]
            if now == slip:
                return u, [-s * most if s else -kf * x for s, x in zip(slip, u, strict=True)]
            slip = now


def _tridiagonal(k, kf, load, slip, most):
    """Thomas' algorithm; sliding supports are forces, the others springs."""
    n = len(load) - 1
    diagonal = [k * (2 - (i in (0, n))) + (0 if slip[i] else kf) for i in range(n + 1)]
    diagonal[0] += mpmath.mpf(HOLD)
    r = [f - s * most for f, s in zip(load, slip, strict=True)]
    for i in range(1, n + 1):
        w = k / diagonal[i - 1]
        diagonal[i] -= w * k
        r[i] += w * r[i - 1]
    u = [r[n] / diagonal[n]]
    for i in range(n - 1, -1, -1):
        u.append((r[i] + k * u[-1]) / diagonal[i])
    return u[::-1]


@pytest.mark.parametrize(
    ("n", "hot", "pull"),
    [(6, 30, 0), (40, 10, 0), (40, 20, -3000), (40, 0, 5000), (10_000, 150, 0)],
)
def test_a_sliding_line_is_the_exact_one(n, hot, pull):
    case = trunnion.solve(read_text(deck(n, hot, pull), "deck.inp"))["A"]
    assert case.certificate.worst < 1e-11
    move, friction = exact(n, hot, pull)
    node = [case.system.labels.index(str(i)) for i in range(n + 1)]
    u, low = case.state.u[node, 0], case.state.u_low[node, 0]
    size = max(abs(x) for x in move)
    assert max(abs(a + b - x) for a, b, x in zip(u, low, move, strict=True)) <= 1e-13 * size
    rubbed = case.state.friction[:, 0]
    assert np.abs(rubbed - np.array(friction, float)).max() <= 1e-12 * MU * PUSH
    sliding = case.state.mode == 3
    assert sliding.any()
    assert not sliding.all()
