"""Struts and rests where friction has no or many answers: design notes, section 1.4.

Exact solution of one freedom with friction: foot on a rest, flexibility of the clamped strut.
Half a unit of the last printed digit.
"""

from math import cos, pi, radians, sin

import numpy as np
import pytest

from trunnion.arrays import OPEN, SLIP, STICK

EI = 203e9 * pi / 64 * (0.2731**4 - (0.2731 - 2 * 0.00927) ** 4)
EA = 203e9 * pi / 4 * (0.2731**2 - (0.2731 - 2 * 0.00927) ** 2)


def balance(answer, fx, fy):
    """Residual force at the foot: load + support - strut, all from the displacements."""
    # strut as a cantilever with a free rotation at the foot; the head is clamped by 1e12 springs
    t = np.array([cos(radians(80)), sin(radians(80))])
    s = np.array([-t[1], t[0]])
    foot, head = answer.u("10"), answer.u("20")
    d = foot[:2] - head[:2] - head[5] * np.array([t[1], -t[0]]) * 10.0
    strut = -(EA / 10.0) * (d @ t) * t - 3 * EI / 1000.0 * (d @ s) * s
    return np.array([fx, fy]) + answer.support("10")[:2] + strut


def test_cycle_finds_the_only_answer(run):
    push = run("strut_cycle")["PUSH"]
    i = push.slider("10")
    assert push.state.mode[i] == SLIP
    assert push.state.normal[i] == pytest.approx(42225.8, abs=0.05)
    assert np.abs(balance(push, 20e3, -1e3)).max() < 1e-4


def test_three_finds_one_of_three(run):
    push = run("strut_three")["PUSH"]
    i = push.slider("10")
    expected = {OPEN: 0.0, SLIP: 3625.9, STICK: 18978.9}
    assert push.state.normal[i] == pytest.approx(expected[int(push.state.mode[i])], abs=0.05)
    assert np.abs(balance(push, -4e3, -20e3)).max() < 1e-4


def test_floating_rests_all_slide(run):
    ope = run("floating_rests")["OPE"]
    assert np.all(ope.state.mode == SLIP)
    assert ope.state.normal == pytest.approx(24357.0, rel=1e-6)
    assert np.abs(ope.state.friction[:, 0]) == pytest.approx(0.3 * 24357, rel=1e-6)
    assert np.sign(ope.state.friction[:, 0]).tolist() == [1, 1, 1, -1, -1, -1]


def test_floating_rests_names_the_undetermined_motion(run):
    warnings = " ".join(run("floating_rests").results["OPE"].warnings)
    assert "undetermined" in warnings
    assert "X" in warnings
