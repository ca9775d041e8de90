"""A hot line on sliding rests: closed form of the bar with Coulomb slip at each rest.

Forces to 1e-9, end movement to 1e-9 of the closed form with the anchor's penalty spring.
"""

from math import pi

import numpy as np
import pytest

from trunnion.arrays import SLIP

N, MU, BAY, BAYS = 24357.1, 0.3, 10.0, 20
EA = 203.4e9 * pi / 4 * (0.4064**2 - (0.4064 - 2 * 0.00953) ** 2)
FREE = 12e-6 * 200.0
K = 1e12


@pytest.fixture(scope="module")
def ope(run):
    return run("sliding_line")["OPE"]


def test_every_rest_slides(ope):
    assert np.all(ope.state.mode == SLIP)
    assert len(ope.state.mode) == BAYS


def test_anchor_force_is_the_sum_of_frictions(ope):
    assert ope.load("0")[0] == pytest.approx(-146142.6, abs=0.05)
    assert ope.load("0")[0] == pytest.approx(-BAYS * MU * N, rel=1e-9)


@pytest.mark.parametrize("bay", range(BAYS))
def test_axial_force_falls_by_mu_n_at_each_rest(ope, bay):
    force = ope.end(str(10 * bay), str(10 * bay + 10), 0)[0]
    assert force == pytest.approx((BAYS - bay) * MU * N, rel=1e-9)


@pytest.mark.parametrize("rest", range(1, BAYS + 1))
def test_rest_carries_its_load(ope, rest):
    assert ope.support(str(10 * rest))[1] == pytest.approx(N, rel=1e-9)
    assert ope.support(str(10 * rest))[0] == pytest.approx(-MU * N, rel=1e-9)


def test_end_movement(ope):
    shortening = MU * N * BAY / EA * sum(range(1, BAYS + 1))
    closed = FREE * BAY * BAYS - shortening - BAYS * MU * N / K
    assert ope.u("200")[0] == pytest.approx(0.473651, abs=5e-7)
    assert ope.u("200")[0] == pytest.approx(closed, rel=1e-9)


def test_nothing_slides_when_cold(run):
    from trunnion.arrays import STICK

    cold = run("sliding_line")["COLD"]
    assert np.all(cold.state.mode == STICK)
    assert np.abs(cold.state.friction).max() < 1e-6
