"""ASME B31.3-2006 Appendix S, example 2: tables S302.5.1 and S302.6.3.

As transcribed in github reallaksh19/Advanced_Analysis, commit 5e2db18f (secondary source).
Loads within 0.5 % (an independent rebuild: 0.2 %).
"""

from dataclasses import replace

import numpy as np
import pytest
from published import PUBLISHED, Source, agrees

from trunnion.model import Direction

S302 = Source(
    PUBLISHED,
    "ASME B31.3 Appendix S, example 2",
    "b313_s302",
    "ASME B31.3-2006, tables S302.5.1 and S302.6.3, as transcribed in github "
    "reallaksh19/Advanced_Analysis, commit 5e2db18f (secondary source). Loads within 0.5 % (an "
    "independent rebuild: 0.2 %). Moments are printed without a sign. The rest at 50 lifts off "
    "when hot; its movement, and what it would have to pull, are numbers of the rebuild.",
)

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
    agrees(S302, "OPE, rise of the pipe over the rest at 50", 18.98, 1e3 * ope.u("50")[1], "mm")


def test_rest_in_the_middle_carries_when_cold(run):
    assert not run("b313_s302")["SUS"].is_open("50", "+Y")


def test_rest_in_the_middle_would_have_to_pull(deck, solve):
    model = deck("b313_s302")
    tied = [
        replace(s, directions=(Direction("Y"),)) if s.node == "50" else s for s in model.supports
    ]
    ope = solve(replace(model, supports=tied))["OPE"]
    pull = ope.support("50")[1] / 1e3
    agrees(S302, "OPE, the rest at 50 if it could pull", -10.76, pull, "kN")


@pytest.mark.parametrize("label", OPE)
def test_operating_loads_on_supports(ope, label):
    fx, fy, mz = OPE[label]
    load = ope.load(label)
    if fx is not None:
        agrees(S302, f"OPE, load on {label} FX", fx, load[0], "N", rel=0.005)
        agrees(S302, f"OPE, load on {label} MZ", mz, abs(load[5]), "N m", rel=0.005)
    agrees(S302, f"OPE, load on {label} FY", fy, load[1], "N", rel=0.005)


def inside(label, axial, bending, ours_axial, ours_bending, within):
    """Axial force and bending moment in kN and kN m, ours in N and N m."""
    agrees(S302, f"HSUS, axial force at {label}", axial, ours_axial / 1e3, "kN", rel=within)
    moment = ours_bending / 1e3
    agrees(S302, f"HSUS, bending moment at {label}", bending, moment, "kN m", rel=within)


@pytest.mark.parametrize("label", HSUS)
def test_hot_sustained_loads(hot, label):
    axial, bending, (start, end, at) = HSUS[label]
    force = hot.end(start, end, at)
    tangent = hot.tangent(start, end, at)
    within = 0.005 if label == "30F" else 0.003
    inside(label, axial, bending, abs(force[:3] @ tangent), abs(force[5]), within)


def test_hot_sustained_loads_in_the_middle_of_the_upper_bend(hot):
    _, force = hot.interior("40M")
    inside("40M", 24.413, 32.770, abs(force[0]), np.hypot(force[4], force[5]), 0.005)


def test_hot_sustained_is_the_line_without_the_lifted_rest(hot, lifted):
    """Linear: nothing else of this line can change its state."""
    size = np.abs(lifted.state.u).max()
    assert hot.state.u == pytest.approx(lifted.state.u, rel=0, abs=1e-9 * size)
    assert np.all(hot.support("50") == 0.0)
    assert hot.result.frozen_check == ()


def test_hot_sustained_costs_one_factorisation(hot):
    assert hot.result.work["analyse"] == 0
    assert hot.result.work["factorise"] == 1
