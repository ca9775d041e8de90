"""A 10 in pipe full of water over 10 m, one element: 5 w L^4 / (384 E I), Euler-Bernoulli.

Half a unit of the last printed digit; the closed form to 1e-10.
"""

from math import pi

import pytest

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
    assert 1e3 * deflection == pytest.approx(10.45, abs=0.005)
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
    assert pytest.approx(1090.96, abs=0.005) == W
    assert sus.support("10")[1] == pytest.approx(W * L / 2, rel=1e-10)


def test_shear_adds_what_it_should(deck, solve):
    # README of the problem: 10.50 mm with shear, w L^2 / (8 G A / 2) more
    sus = solve(deck("pipe_10m"), shear=True)["SUS"]
    assert -1e3 * sus.along("10", "20", 0.5)[0][1] == pytest.approx(10.50, abs=0.005)
