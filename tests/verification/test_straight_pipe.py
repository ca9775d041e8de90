"""A straight cantilever under every load: Code_Aster SSLL106, analytic references.

github ehmoussi/code_aster, commit 34161d7; numbers only.  Half a unit of the last printed digit;
a whole one for LIFT RY and BENDZ DY, printed 0.0210602 where the formula gives 0.02106026.
GRAV DZ is printed -0.04646; Euler-Bernoulli, as all the others, gives w L^4 / (8 E I) = 0.046446
and our shear area A/2 0.046472, so the print's seems to hold for shear area A (0.046459).
The references clamp A rigidly, so movements are compared after the correction to rigid supports
(with the anchor's 1e12 N/m the pull alone would be 5e-10 m too long).
"""

from math import pi

import numpy as np
import pytest

from trunnion.results.stresses import end_stresses

DX, DY, DZ, RX, RY, RZ = range(6)
PRINTED = {
    "PULL": {DX: "5.52621e-6", DY: "4.14466e-6"},
    "SIDE": {DX: "-0.0526507", DY: "0.0702009", RZ: "0.0263253"},
    "LIFT": {DZ: "0.0877511", RX: "0.0157952", RY: "-0.0210602"},
    "TWIST": {RX: "0.01095134", RY: "0.0082135"},
    "BENDY": {DZ: "-0.0263253", RX: "-0.00631808", RY: "0.00842411"},
    "BENDZ": {DX: "-0.0157952", DY: "0.0210602", RZ: "0.0105301"},
    "GRAV": {DX: "5.52621e-6", DY: "4.14466e-6"},
    "HEAT": {DX: "0.008", DY: "0.006"},
}
VALUES = [(case, i, text) for case, row in PRINTED.items() for i, text in row.items()]


def half_unit(text):
    """Half a unit of the last digit of a printed number."""
    digits, _, power = text.partition("e")
    decimals = len(digits.partition(".")[2])
    return 0.5 * 10.0 ** (int(power or 0) - decimals)


@pytest.mark.parametrize(("case", "component", "text"), VALUES)
def test_movements_of_the_free_end(run, case, component, text):
    u = run("straight_pipe")[case].rigid_u("B")
    cut = 2.0 if text.endswith("0.0210602") else 1.001  # 1.001: the print is rounded too
    assert u[component] == pytest.approx(float(text), abs=cut * half_unit(text))


def test_weight_bends_the_free_end(run, deck, solve):
    ei = 2e11 * pi / 64 * (0.08**4 - 0.064**4)
    w = 7800 * 10 * pi / 4 * (0.08**2 - 0.064**2)
    sag = -run("straight_pipe")["GRAV"].rigid_u("B")[DZ]
    assert sag == pytest.approx(w * 5**4 / (8 * ei), rel=1e-8)
    with_shear = -solve(deck("straight_pipe"), shear=True)["GRAV"].rigid_u("B")[DZ]
    assert sag < 0.04646 < with_shear


def test_weight_bends_the_clamped_end(run):
    moment = run("straight_pipe")["GRAV"].support("A")[3:]
    assert np.linalg.norm(moment) == pytest.approx(1764.3, abs=0.05)


@pytest.mark.parametrize(
    ("case", "stress", "printed"),
    [
        ("PULL", "axial", "276311"),
        ("TWIST", "torsion", "8.42e6"),
        ("PRESS", "hoop_inner", "4.55556e7"),
        ("PRESS", "hoop_outer", "3.55556e7"),
    ],
)
def test_stresses(run, case, stress, printed):
    _, first, _ = end_stresses(run("straight_pipe")[case].result)
    # the print of TWIST has -8.42e6, and 6.75e6 inside: 0.8 of it
    assert getattr(first, stress)[0] == pytest.approx(float(printed), abs=half_unit(printed))


@pytest.mark.parametrize("case", ["BENDY", "BENDZ"])
def test_bending_stress_at_the_inner_wall(run, case):
    # printed 1.34824e7: M r / I with the inner radius is 1.34786e7, the print 0.03 % more; not
    # explained (at the outer wall it is 1.68482e7)
    _, first, _ = end_stresses(run("straight_pipe")[case].result)
    assert first.bending[0] * 0.8 == pytest.approx(1.34786e7, abs=50)


def test_heat_makes_no_force(run):
    case = run("straight_pipe")["HEAT"]
    # round-off of E A alpha dT = 7.2e5 N
    assert np.abs(case.end("A", "B")).max() < 1e-6
