"""A 10 in pipe full of water over 10 m, one element: 5 w L^4 / (384 E I), Euler-Bernoulli.

Half a unit of the last printed digit; the closed form to 1e-10.
"""

from math import pi

import pytest
from published import CLOSED, Source, agrees

BEAM = Source(
    CLOSED,
    "A pipe of 10 m full of water, one element",
    "pipe_10m",
    "5 w L^4 / (384 E I), Euler-Bernoulli, in the middle of the element, where no node is; the "
    "test holds the closed form to 1e-10.",
)
OD, WALL, E, L = 0.2731, 0.00927, 203e9, 10.0
BORE = OD - 2 * WALL
INERTIA = pi / 64 * (OD**4 - BORE**4)
W = 9.81 * pi / 4 * (7850 * (OD**2 - BORE**2) + 1000 * BORE**2)


@pytest.fixture(scope="module")
def sus(run):
    return run("pipe_10m")["SUS"]


def test_deflection_between_nodes(sus):
    # two supports sink by w L / 2 / 1e12
    deflection = -sus.along("10", "20", 0.5)[0][1]
    agrees(BEAM, "SUS, deflection at mid-span", 10.45, 1e3 * deflection, "mm")
    closed = 5 * W * L**4 / (384 * E * INERTIA) + W * L / 2e12
    assert deflection == pytest.approx(closed, rel=1e-10)


def test_bending_moment_between_nodes(sus):
    force = sus.along("10", "20", 0.5)[1]
    assert abs(force[5]) == pytest.approx(W * L**2 / 8, rel=1e-10)


def test_quarter_point(sus):
    deflection = -sus.along("10", "20", 0.25)[0][1]
    closed = 57 * W * L**4 / (6144 * E * INERTIA) + W * L / 2e12
    assert deflection == pytest.approx(closed, rel=1e-10)


def test_line_weight(sus):
    load = sus.support("10")[1]
    agrees(BEAM, "SUS, weight per length", 1090.96, 2 * load / L, "N/m")
    assert load == pytest.approx(W * L / 2, rel=1e-10)


def test_end_rotation(sus):
    turn = abs(sus.u("10")[5])
    agrees(BEAM, "SUS, rotation of the end", "3.345e-3", turn, "rad")
    assert turn == pytest.approx(W * L**3 / (24 * E * INERTIA), rel=1e-9)


def test_shear_adds_what_it_should(deck, solve):
    # README of the problem: 10.50 mm with shear, w L^2 / (8 G A / 2) more
    sus = solve(deck("pipe_10m"), shear=True)["SUS"]
    deflection = -1e3 * sus.along("10", "20", 0.5)[0][1]
    agrees(BEAM, "SUS with SHEAR=ON, deflection at mid-span", "10.50", deflection, "mm")
