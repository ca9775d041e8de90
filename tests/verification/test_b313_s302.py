"""ASME B31.3-2006 Appendix S, example 2: tables S302.5.1 and S302.6.3.

As transcribed in github reallaksh19/Advanced_Analysis, commit 5e2db18f (secondary source).
Loads within 0.5 % (an independent rebuild: 0.2 %).
"""

from dataclasses import replace

import numpy as np
import pytest

from trunnion.model import Direction

OPE = {  # of the pipe on its supports: Fx, Fy [N], Mz [N.m] without sign
    "10": (-26600, -14050, 27000),
    "110": (26600, -14050, 27000),
    "20": (None, -58900, None),
    "120": (None, -58900, None),
}
HSUS = {  # rest at 50 away, as it is when hot: axial force, bending moment [kN, kN.m]
    "10": (12.575, 3.995, ("10", "15", 0)),
    "20": (12.575, 82.845, ("15", "20", 1)),
    "30F": (34.985, 29.985, ("30N", "30F", 1)),
    "50": (12.575, 62.885, ("45", "50", 1)),
}


@pytest.fixture(scope="module")
def ope(run):
    return run("b313_s302")["OPE"]


@pytest.fixture(scope="module")
def hot(run):
    return run("b313_s302")["HSUS"]


@pytest.fixture(scope="module")
def lifted(deck, solve):
    """Weight and pressure on the line without its middle rest."""
    model = deck("b313_s302")
    left = [s for s in model.supports if s.node != "50"]
    return solve(replace(model, supports=left))["SUS"]


def test_rest_in_the_middle_lifts_off(ope):
    assert ope.is_open("50", "+Y")
    assert np.all(ope.load("50") == 0.0)
    assert ope.u("50")[1] == pytest.approx(0.01898, abs=5e-6)  # independent rebuild: 18.98 mm


def test_rest_in_the_middle_carries_when_cold(run):
    assert not run("b313_s302")["SUS"].is_open("50", "+Y")


def test_rest_in_the_middle_would_have_to_pull(deck, solve):
    model = deck("b313_s302")
    tied = [
        replace(s, directions=(Direction("Y"),)) if s.node == "50" else s for s in model.supports
    ]
    ope = solve(replace(model, supports=tied))["OPE"]
    assert ope.support("50")[1] == pytest.approx(-10760, abs=5)  # independent rebuild: -10.76 kN


@pytest.mark.parametrize("label", OPE)
def test_operating_loads_on_supports(ope, label):
    fx, fy, mz = OPE[label]
    load = ope.load(label)
    if fx is not None:
        assert load[0] == pytest.approx(fx, rel=0.005)
        assert abs(load[5]) == pytest.approx(mz, rel=0.005)
    assert load[1] == pytest.approx(fy, rel=0.005)


@pytest.mark.parametrize("label", HSUS)
def test_hot_sustained_loads(hot, label):
    axial, bending, (start, end, at) = HSUS[label]
    force = hot.end(start, end, at)
    tangent = hot.tangent(start, end, at)
    within = 0.005 if label == "30F" else 0.003
    assert abs(force[:3] @ tangent) == pytest.approx(1e3 * axial, rel=within)
    assert abs(force[5]) == pytest.approx(1e3 * bending, rel=within)


def test_hot_sustained_loads_in_the_middle_of_the_upper_bend(hot):
    _, force = hot.interior("40M")
    assert abs(force[0]) == pytest.approx(24413, rel=0.005)
    assert np.hypot(force[4], force[5]) == pytest.approx(32770, rel=0.005)


def test_hot_sustained_is_the_line_without_the_lifted_rest(hot, lifted):
    """Linear: nothing else of this line can change its state."""
    size = np.abs(lifted.state.u).max()
    assert hot.state.u == pytest.approx(lifted.state.u, rel=0, abs=1e-9 * size)
    assert np.all(hot.support("50") == 0.0)
    assert hot.result.frozen_check == ()


def test_hot_sustained_costs_one_factorisation(hot):
    assert hot.result.work["analyse"] == 0
    assert hot.result.work["factorise"] == 1
