"""A hot line on sliding rests: closed form of the bar with Coulomb slip at each rest.

Forces to 1e-9, end movement to 1e-9 of the closed form with the anchor's penalty spring.
"""

from math import pi

import numpy as np
import pytest
from published import CLOSED, Source, agrees

import trunnion
from trunnion.arrays import SLIP
from trunnion.model import (
    Case,
    Direction,
    Force,
    Material,
    Model,
    Operation,
    Pipe,
    Section,
    Settings,
    Support,
    Term,
)

LINE = Source(
    CLOSED,
    "A hot line on twenty sliding rests",
    "sliding_line",
    "Every rest slides with mu N, so the axial force falls by mu N at each and the free end moves "
    "by alpha dT L less the shortening under these forces; the test holds the closed form with the "
    "anchor's spring to 1e-9.",
)
LONG = Source(
    CLOSED,
    "The same line, 9 km long",
    "",
    "Its far part is locked: E A alpha dT, and a virtual anchor 7.9 km from the free end. Built in "
    "`tests/verification/test_sliding_line.py`.",
)
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
    agrees(LINE, "OPE, load on the anchor FX", -146142.6, ope.load("0")[0], "N")
    assert ope.load("0")[0] == pytest.approx(-BAYS * MU * N, rel=1e-9)


@pytest.mark.parametrize("bay", range(BAYS))
def test_axial_force_falls_by_mu_n_at_each_rest(ope, bay):
    force = ope.end(str(10 * bay), str(10 * bay + 10), 0)[0]
    if bay == BAYS - 1:
        agrees(LINE, "OPE, axial force in the last bay", 7307.13, force, "N")
    assert force == pytest.approx((BAYS - bay) * MU * N, rel=1e-9)


@pytest.mark.parametrize("rest", range(1, BAYS + 1))
def test_rest_carries_its_load(ope, rest):
    assert ope.support(str(10 * rest))[1] == pytest.approx(N, rel=1e-9)
    assert ope.support(str(10 * rest))[0] == pytest.approx(-MU * N, rel=1e-9)


def test_end_movement(ope):
    shortening = MU * N * BAY / EA * sum(range(1, BAYS + 1))
    closed = FREE * BAY * BAYS - shortening - BAYS * MU * N / K
    agrees(LINE, "OPE, movement of the free end", 0.473651, ope.u("200")[0], "m")
    assert ope.u("200")[0] == pytest.approx(closed, rel=1e-9)


def test_nothing_slides_when_cold(run):
    from trunnion.arrays import STICK

    cold = run("sliding_line")["COLD"]
    assert np.all(cold.state.mode == STICK)
    assert np.abs(cold.state.friction).max() < 1e-6


# The same line, 9 km long: its far part is locked, the virtual anchor is 7.9 km from the free end.
# analytic_friction case B: locked force 5 800 337 N, end movement of 10 m bays 9.5135 m.


@pytest.fixture(scope="module")
def long_line(answer):
    bays = 900
    hot = Operation(t={"1": 220.0}, tref=20.0)
    rest = (Direction("+Y"),)
    model = Model(
        settings=Settings(mu=MU),
        materials={"S": Material("S", e=203.4e9, alpha=12e-6)},
        sections={"P": Section("P", od=0.4064, wall=0.00953)},
        pipes=[
            Pipe(str(i), str(i + 1), (BAY, 0.0, 0.0), "P", "S", operation=hot) for i in range(bays)
        ],
        supports=[Support("0", "anchor")]
        + [Support(str(i), "support", rest) for i in range(1, bays + 1)],
        forces=[Force(str(i), "1", (0.0, -N, 0.0, 0.0, 0.0, 0.0)) for i in range(bays + 1)],
        cases=[Case("OPE", (Term(1.0, "F1"), Term(1.0, "T1")))],
    )
    return answer(trunnion.solve(model)["OPE"])


def test_long_line_is_locked_between_the_anchors(long_line):
    # a few bays from the anchor, whose spring of 1e12 N/m gives way by 6e-6 m
    agrees(LONG, "OPE, locked axial force", 5800337, long_line.end("50", "51", 0)[0], "N")


def test_long_line_slides_up_to_the_virtual_anchor(long_line):
    # E A alpha dT / (mu N) = 793.8 rests; the last of them slips in part, in its spring
    assert np.count_nonzero(long_line.state.mode == SLIP) in (792, 793)


def test_end_movement_of_the_long_line(long_line):
    locked = EA * FREE
    sliding = range(1, int(locked / (MU * N)) + 1)
    rigid = sum(FREE * BAY - k * MU * N * BAY / EA for k in sliding)
    moved = long_line.u("900")[0]
    agrees(LONG, "OPE, movement of the free end", 9.5135, moved, "m")
    # rests that stick give way by at most mu N / k_f each
    assert rigid < moved < rigid + MU * N / 1e8
