"""Ten rests that slide both ways: the anchor's load ranges over 2 F, one shot shows F."""

from dataclasses import replace

import numpy as np
import pytest
from published import CLOSED, Source, agrees

import trunnion
from trunnion.deck.reader import read_text
from trunnion.results.supports import card_forces

LINE = Source(
    CLOSED,
    "A line that is heated and cooled on ten rests",
    "cycle_line",
    "Heating, every rest slides outward with mu N and the anchor is pushed by F = 10 mu N; "
    "cooling, every rest slides back and the anchor is pulled by F: the range is 2 F, where one "
    "shot shows F.",
)
F = 10 * 0.3 * 24357.1


@pytest.fixture(scope="module")
def heat(run):
    return run("cycle_line").results.cycles["HEAT"]


def follow(model, **keys):
    """The cycle of a model, with other keys."""
    cycle = replace(model.cycles[0], **keys)
    return trunnion.solve(replace(model, cycles=[cycle])).cycles[cycle.name]


def anchor(step):
    """Force of the pipe on the anchor along the line."""
    return -card_forces(step)[0, 0]


def test_anchor_is_pushed_hot_and_pulled_cold(heat):
    loads = [anchor(step) for step in heat.path]
    for name, printed, load in zip(("hot", "cold"), (-73071.3, 73071.3), loads[-2:], strict=True):
        agrees(LINE, f"HEAT, load on the anchor FX, {name}", printed, load, "N")
    assert loads == pytest.approx([-F, F] * heat.loops, rel=1e-3)
    assert loads == pytest.approx([-F, F] * heat.loops, rel=1e-9)  # closed form holds exactly


def test_range_is_twice_the_one_shot_range(heat):
    agrees(LINE, "HEAT, range of the anchor", 146142.6, heat.supports[0, 0], "N")
    one_shot = heat.one_shot_supports[0, 0]
    agrees(LINE, "OPE and COLD each on its own, range of the anchor", 73071.3, one_shot, "N")
    assert heat.supports[0, 0] == pytest.approx(2 * F, rel=1e-9)
    assert heat.one_shot_supports[0, 0] == pytest.approx(F, rel=1e-9)


@pytest.mark.parametrize("rest", range(1, 11))
def test_every_rest_turns_its_friction_round(heat, rest):
    assert heat.supports[rest, 0] == pytest.approx(2 * F / 10, rel=1e-9)
    assert heat.supports[rest, 1] == pytest.approx(0.0, abs=1e-6)


def test_axial_force_of_each_bay_ranges_over_the_friction_beyond_it(heat):
    beyond = 2 * F / 10 * np.arange(10, 0, -1)
    assert heat.elements[:, 0, 0] == pytest.approx(beyond, rel=1e-9)
    assert heat.elements[:, 1, 0] == pytest.approx(beyond, rel=1e-9)


def test_second_loop_repeats_the_first(heat):
    assert heat.repeats
    assert heat.loops == 2
    assert heat.change <= 1e-6
    assert all(step.certificate.passed for step in heat.path)


def test_one_loop_alone_does_not_say_that_it_repeats(deck):
    once = follow(deck("cycle_line"), times=1)
    assert once.loops == 1
    assert not once.repeats
    assert once.cause is None
    assert once.supports[0, 0] == pytest.approx(2 * F, rel=1e-9)


def test_cycle_may_start_from_a_case(deck):
    model = deck("cycle_line")
    begun = follow(model, cases=("COLD", "OPE"), start="OPE")
    assert [anchor(step) for step in begun.path] == pytest.approx([F, -F] * begun.loops, rel=1e-9)
    fresh = follow(model, cases=("COLD", "OPE"))
    assert anchor(fresh.path[0]) == pytest.approx(0.0, abs=1e-6)
    assert [anchor(s) for s in fresh.path[1:]] == pytest.approx(
        ([-F, F] * fresh.loops)[: len(fresh.path) - 1], rel=1e-9
    )


def test_order_of_the_loop_does_not_change_the_range(deck):
    turned = follow(deck("cycle_line"), cases=("COLD", "OPE"))
    assert turned.repeats
    assert turned.loops == 3  # the first COLD was unloaded, the second not
    assert turned.supports[0, 0] == pytest.approx(2 * F, rel=1e-9)


def test_cycle_leaves_the_cases_alone(run, deck):
    model = replace(deck("cycle_line"), cycles=[])
    without = trunnion.solve(model)
    for name, case in without.cases.items():
        assert np.array_equal(case.state.u, run("cycle_line").results[name].state.u)


WALKING = """\
UNITS    m N Pa C
DEFAULT  MU=0.3
MATERIAL STEEL   E=203.4e9 NU=0.3 ALPHA=12e-6
SECTION  NPS16   OD=0.4064 WALL=0.00953
OPERATE  T1=220 TREF=20
PIPE     1 2  DX=10
PIPE     2 3  DX=10
PIPE     3 4  DX=10
PIPE     4 5  DX=10
SUPPORT  1 +Y
SUPPORT  1 RX
SUPPORT  1 Z MU=0
SUPPORT  2 +Y
SUPPORT  3 +Y
SUPPORT  4 +Y
SUPPORT  5 +Y
SUPPORT  5 Z MU=0
FORCE    1 F1  FY=-10000 FX=900
FORCE    2 F1  FY=-10000 FX=900
FORCE    3 F1  FY=-10000 FX=900
FORCE    4 F1  FY=-10000 FX=900
FORCE    5 F1  FY=-10000 FX=900
CASE COLD = F1
CASE OPE  = F1 + T1
CYCLE WALK = OPE, COLD TIMES=5
"""


def test_line_that_walks_down_its_slope_does_not_repeat():
    """A line without anchor under a part of its friction: every loop carries it further.

    Its support loads are the same in every loop, but heating it stands on rest 2, cooling on
    rest 4: it walks by the expansion between them, less their elastic parts.
    """
    walk = trunnion.solve(read_text(WALKING, "walking.inp")).cycles["WALK"]
    assert walk.cause is None
    assert not walk.repeats
    assert walk.loops == 5
    cold = [step.state.u[2, 0] for step in walk.path[1::2]]
    assert np.diff(cold) == pytest.approx(12e-6 * 200 * 20, rel=0.01)
    assert np.ptp(np.diff(cold)) < 1e-9


LIFTED = """\
UNITS    m N Pa C
MATERIAL STEEL   E=203.4e9 NU=0.3 ALPHA=12e-6
SECTION  NPS16   OD=0.4064 WALL=0.00953
OPERATE  T1=220 TREF=20
PIPE     1 2  DX=10
SUPPORT  1 +Y X Z RX
SUPPORT  2 +Y Z
FORCE    1 F1  FY=-10000
FORCE    2 F1  FY=-10000
FORCE    1 F2  FY=20000
FORCE    2 F2  FY=20000
CASE COLD = F1
CASE UP   = F1 + F2
CYCLE FLY = COLD, UP TIMES=3
"""


def test_cycle_without_answer_says_at_which_step():
    fly = trunnion.solve(read_text(LIFTED, "lifted.inp")).cycles["FLY"]
    assert not fly.repeats
    assert fly.cause.startswith("loop 1, UP: ")
    assert fly.supports is None
