"""Snubbers and locked cases: statics never see them, increments on a frozen contact state."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

import trunnion
from trunnion.arrays import SLIP
from trunnion.certificate import certify
from trunnion.deck.reader import read_text
from trunnion.results.supports import card_forces

E, OD, WALL, K = 200e9, 0.2731, 0.0093, 1e12
BORE = OD - 2 * WALL
EI = E * pi / 64 * (OD**4 - BORE**4)
EA = E * pi / 4 * (OD**2 - BORE**2)
WEIGHT = 7850 * 9.80665 * EA / E
HEAD = """\
UNITS    m N Pa C
DEFAULT  SHEAR=OFF
MATERIAL STEEL   E=200e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P10     OD=0.2731 WALL=0.0093
OPERATE  T1=170 P1=1e6 TREF=20
"""
LINE = (
    HEAD
    + """\
ANCHOR   10
PIPE     10 20  DX=6
SUPPORT  20     +Y MU=0.3
SUPPORT  20     GUIDE GAP=0.003
PIPE     20 30  DX=6
SUPPORT  30     +Y MU=0.3
PIPE     30 40  DZ=5
SUPPORT  40     +Y MU=0.3
CASE SUS = W
CASE OPE = W + P1 + T1
"""
)
SHOCKS = """\
CASE EQX = U(0.3,0,0) ABOUT=OPE
CASE EQY = U(0,0.2,0) ABOUT=OPE
CASE EQZ = U(0,0,0.1) ABOUT=OPE
"""


def solve(text):
    """Solve a deck in text; every case must have a certified answer."""
    results = trunnion.solve(read_text(text, "locked.inp"))
    for case in results.cases.values():
        assert case.converged, (case.name, case.cause)
        assert case.certificate.passed
        assert case.certificate.worst < 1e-9
    return results


def force(case, name):
    """Force and moment of the card of this name on the pipe."""
    cards = [card.name for card in case.system.cards]
    return card_forces(case)[cards.index(name)]


def u(case, label):
    """Displacement of a node."""
    n = case.system.labels.index(label)
    return case.state.u[n] + case.state.u_low[n]


def broken(case):
    """What the frozen check lists."""
    cards = case.system.cards
    return {(cards[b.card].name, b.word, b.what): b.amount for b in case.frozen_check}


# ---------------------------------------------------------------------- statics never see them
SNUBBED = {
    "added": "SNUBBER 30 Z\nSNUBBER 40 X\n",
    "soft": "SNUBBER 30 Z K=1e5\nSNUBBER 40 X K=3\n",
    "skewed": "SNUBBER 40 (1,1,1)\n",
}


@pytest.fixture(scope="module")
def bare():
    return solve(LINE)


@pytest.mark.parametrize("snubbers", SNUBBED)
@pytest.mark.parametrize("case", ["SUS", "OPE"])
def test_snubbers_change_no_bit_of_a_static_answer(bare, snubbers, case):
    other = solve(LINE + SNUBBED[snubbers])
    for name in ("u", "u_low", "end_force", "reaction", "friction", "side", "mode", "datum_end"):
        ours, theirs = (getattr(r[case].state, name) for r in (bare, other))
        assert np.array_equal(ours, theirs), name
    assert bare[case].work == other[case].work


@pytest.mark.parametrize("snubbers", SNUBBED)
def test_deck_without_occasional_case_builds_no_locked_factor(bare, snubbers):
    assert solve(LINE + SNUBBED[snubbers]).work == bare.work


def test_occasional_cases_about_one_case_cost_one_factorisation(bare):
    shaken = solve(LINE + SNUBBED["added"] + SHOCKS)
    assert shaken.work["analyse"] == bare.work["analyse"] == 1
    assert shaken.work["factorise"] == bare.work["factorise"] + 1
    assert shaken.work["iterations"] == bare.work["iterations"]
    assert [shaken[name].work["factorise"] for name in ("EQX", "EQY", "EQZ")] == [1, 0, 0]


def test_total_and_increment_about_one_case_cost_one_factorisation_each(bare):
    text = LINE + SNUBBED["added"] + "CASE HSUS = W + P1 ON=OPE\n" + SHOCKS
    shaken = solve(text)
    assert shaken.work["analyse"] == 1
    assert shaken.work["factorise"] == bare.work["factorise"] + 2


def test_locked_cases_may_stand_before_the_case_they_need(bare):
    ahead = LINE.replace("CASE SUS", SHOCKS + "CASE SUS") + SNUBBED["added"]
    behind = solve(LINE + SNUBBED["added"] + SHOCKS)
    for name in ("OPE", "EQX", "EQY", "EQZ"):
        assert np.array_equal(solve(ahead)[name].state.u, behind[name].state.u)


# ---------------------------------------------------------------------- what a snubber carries
def arm(extra, length=4.0):
    """A pipe from its anchor along X."""
    return HEAD + f"ANCHOR 10\nPIPE 10 20 DX={length}\n" + extra


def tip(length):
    """Bending flexibility of its end, with the anchor's springs."""
    return length**3 / (3 * EI) + 1 / K + length**2 / K


def test_stiff_snubber_takes_the_force_at_its_node():
    case = solve(
        arm(
            "SNUBBER 20 Z\nFORCE 20 F1 FZ=1000\nCASE OPE = T1\n"
            "CASE SLUG = F1 ABOUT=OPE\nCASE HSUS = F1 ON=OPE\n"
        )
    )
    share = tip(4.0) / (tip(4.0) + 1 / K)
    assert force(case["SLUG"], "20 SNUBBER Z")[2] == pytest.approx(-1000 * share, rel=1e-9)
    assert np.all(force(case["OPE"], "20 SNUBBER Z") == 0.0)
    assert np.all(force(case["HSUS"], "20 SNUBBER Z") == 0.0)
    assert u(case["HSUS"], "20")[2] == pytest.approx(1000 * tip(4.0), rel=1e-9)


def test_soft_snubber_shares_by_its_stiffness():
    case = solve(
        arm("SNUBBER 20 Z K=2e5\nFORCE 20 F1 FZ=1000\nCASE OPE = T1\nCASE SLUG = F1 ABOUT=OPE\n")
    )
    share = tip(4.0) / (tip(4.0) + 1 / 2e5)
    assert force(case["SLUG"], "20 SNUBBER Z")[2] == pytest.approx(-1000 * share, rel=1e-9)


def test_skewed_snubber_acts_along_its_axis_only():
    case = solve(
        arm("SNUBBER 20 (0,3,4)\nFORCE 20 F1 FZ=1000\nCASE OPE = T1\nCASE SLUG = F1 ABOUT=OPE\n")
    )
    held = force(case["SLUG"], "20 SNUBBER (0,3,4)")[:3]
    share = tip(4.0) / (tip(4.0) + 1 / K)
    assert held == pytest.approx(-800 * share * np.array([0.0, 0.6, 0.8]), rel=1e-9)


def test_snubber_between_two_pipes_pulls_both():
    text = (
        arm("", 4.0)
        + "NODE 50 X=0 Z=1\nANCHOR 50\nPIPE 50 60 DX=3\n"
        + "SNUBBER 20 Y CNODE=60\nFORCE 20 F1 FY=1000\n"
        + "CASE OPE = T1\nCASE SLUG = F1 ABOUT=OPE\n"
    )
    case = solve(text)
    share = tip(4.0) / (tip(4.0) + tip(3.0) + 1 / K)
    assert force(case["SLUG"], "20 SNUBBER Y")[1] == pytest.approx(-1000 * share, rel=1e-9)
    assert force(case["SLUG"], "50 ANCHOR")[1] == pytest.approx(-1000 * share, rel=1e-9)
    assert np.all(force(case["OPE"], "20 SNUBBER Y") == 0.0)


# ---------------------------------------------------------------------- hot sustained
def test_stop_closed_when_hot_has_no_force_of_its_own_in_the_hot_sustained_case():
    """50 m of pipe grow 90 mm, the stop takes 65 mm of it; weight and pressure do not push it."""
    spans = "".join(f"PIPE {i} {i + 1} DX=10\nSUPPORT {i + 1} +Y GUIDE\n" for i in range(1, 6))
    case = solve(
        HEAD
        + "ANCHOR 1\n"
        + spans
        + "SUPPORT 6 LIMIT GAP=0.025\nCASE OPE = W + P1 + T1\nCASE HSUS = W + P1 ON=OPE\n"
    )
    hot = force(case["OPE"], "6 LIMIT")[0]
    assert hot == pytest.approx(-EA * (12e-6 * 150 - 0.025 / 50), rel=1e-3)
    assert abs(force(case["HSUS"], "6 LIMIT")[0]) < 1e-6
    assert abs(force(case["HSUS"], "1 ANCHOR")[0]) < 1e-6
    assert force(case["HSUS"], "1 ANCHOR")[1] > 1000
    assert broken(case["HSUS"]) == {}


def test_hanger_carries_its_cold_load_in_the_hot_sustained_case():
    text = arm("HANGER 20 RATE=5e4 LOAD=800\nCASE OPE = W + H + T1\nCASE HSUS = W + H ON=OPE\n")
    case = solve(text)
    sag = WEIGHT * 4**4 / (8 * EI) + WEIGHT * 4 / K + WEIGHT * 8 * 4 / K
    lift = (sag * 5e4 + 800) / (1 + 5e4 * tip(4.0))
    assert force(case["HSUS"], "20 HANGER")[1] == pytest.approx(lift, rel=1e-9)


# ---------------------------------------------------------------------- the frozen check
def test_frozen_rest_that_would_pull_is_named_with_its_force():
    case = solve(LINE + "CASE HEAVY = W SNUBBERS=FREE\nCASE UP = U(0,1.5,0) ABOUT=SUS\n")
    assert set(broken(case["UP"])) == {(f"{n} +Y", "+Y", "pulls") for n in (20, 30, 40)}
    for name in ("20 +Y", "30 +Y", "40 +Y"):
        cold = force(case["SUS"], name)[1]
        assert broken(case["UP"])[name, "+Y", "pulls"] == pytest.approx(0.5 * cold, rel=1e-9)


def test_load_below_the_weight_breaks_nothing():
    assert broken(solve(LINE + "CASE UP = U(0,0.9,0) ABOUT=SUS\n")["UP"]) == {}


@pytest.mark.parametrize("way", [1, -1])
def test_open_gap_that_would_close_is_named_with_its_distance(way):
    text = arm(
        f"SUPPORT 20 Z GAP=0.002,0.003\nFORCE 20 F1 FZ={way * 9000}\n"
        "CASE OPE = T1\nCASE SLUG = F1 ABOUT=OPE\nCASE HALF = 0.1*F1 ABOUT=OPE\n"
    )
    case = solve(text)
    gap = 0.003 if way > 0 else 0.002
    beyond = 9000 * tip(4.0) - gap
    assert broken(case["SLUG"]) == {("20 Z", "Z", "closes"): pytest.approx(beyond, rel=1e-9)}
    assert broken(case["HALF"]) == {}


def test_gap_already_used_up_by_the_operating_case_counts():
    text = arm(
        "SUPPORT 20 Z GAP=0.003\nFORCE 20 F1 FZ=1000\nFORCE 20 F2 FZ=1000\n"
        "CASE OPE = F1\nCASE SLUG = F2 ABOUT=OPE\n"
    )
    beyond = 2000 * tip(4.0) - 0.003
    case = solve(text)
    assert beyond > 0
    assert broken(case["SLUG"]) == {("20 Z", "Z", "closes"): pytest.approx(beyond, rel=1e-9)}


def test_ground_that_moves_toward_the_pipe_closes_the_gap():
    """Movement of a support in the locked case counts in the check of its gap."""
    text = arm(
        "SUPPORT 20 Z GAP=0.003\nFORCE 20 F1 FZ=500\nDISPLACEMENT 20 D1 DZ=-0.0025\n"
        "CASE OPE = T1\nCASE SAM = F1 + D1 ABOUT=OPE\nCASE SLUG = F1 ABOUT=OPE\n"
    )
    case = solve(text)
    beyond = 500 * tip(4.0) + 0.0025 - 0.003
    assert beyond > 0
    assert broken(case["SAM"]) == {("20 Z", "Z", "closes"): pytest.approx(beyond, rel=1e-9)}
    assert broken(case["SLUG"]) == {}


def test_ground_movement_acts_through_a_closed_support():
    text = arm("SUPPORT 20 +Y\nDISPLACEMENT 20 D1 DY=0.01\nCASE OPE = W\nCASE SAM = D1 ABOUT=OPE\n")
    case = solve(text)
    assert force(case["SAM"], "20 +Y")[1] == pytest.approx(0.01 / (tip(4.0) + 1 / K), rel=1e-9)


def test_total_on_a_frozen_state_asks_only_what_would_pull():
    """ON= stands alone: the distance to an open gap is not known in it."""
    text = arm(
        "SUPPORT 20 Z GAP=0.003\nFORCE 20 F1 FZ=9000\nCASE OPE = T1\nCASE HSUS = F1 ON=OPE\n"
    )
    assert broken(solve(text)["HSUS"]) == {}


def test_total_that_would_pull_a_closed_support_is_named_with_the_whole_force():
    text = arm("SUPPORT 20 +Y\nFORCE 20 F1 FY=700\nCASE OPE = W\nCASE HSUS = F1 ON=OPE\n")
    pulls = 700 * tip(4.0) / (tip(4.0) + 1 / K)
    found = broken(solve(text)["HSUS"])
    assert found == {("20 +Y", "+Y", "pulls"): pytest.approx(pulls, rel=1e-9)}


def test_frozen_state_that_moves_freely_is_refused_by_name():
    """Friction alone holds this line along X; it is left out of the locked pass."""
    text = HEAD + (
        "PIPE 1 2 DX=6\nPIPE 2 3 DX=6\n"
        "SUPPORT 1 +Y MU=0.3\nSUPPORT 1 Z RX\nSUPPORT 3 +Y MU=0.3\nSUPPORT 3 Z\n"
        "CASE SUS = W\nCASE EQX = U(0.1,0,0) ABOUT=SUS\n"
        "CASE EQZ = U(0,0,0.1) ABOUT=SUS\nCASE OPE = W + T1\n"
    )
    results = trunnion.solve(read_text(text, "loose.inp"))
    assert results["SUS"].converged
    assert results["OPE"].converged
    for name in ("EQX", "EQZ"):
        assert results[name].state is None
        assert "frozen state: line 1-3 moves along X" in results[name].cause


# ---------------------------------------------------------------------- NONLINEAR
SMOOTH = LINE.replace(" MU=0.3", "") + SNUBBED["added"]


def test_nonlinear_pass_is_the_locked_pass_where_the_frozen_state_holds():
    case = solve(
        SMOOTH + SHOCKS + SHOCKS.replace("CASE EQ", "CASE NL").replace("OPE", "OPE NONLINEAR")
    )
    for way in "XYZ":
        linear, whole = case[f"EQ{way}"], case[f"NL{way}"]
        assert broken(linear) == {}
        size = np.abs(linear.state.u).max()
        assert whole.state.u == pytest.approx(linear.state.u, rel=0, abs=1e-9 * size)
        forces = card_forces(linear)
        assert card_forces(whole) == pytest.approx(forces, rel=0, abs=1e-8 * np.abs(forces).max())


def test_nonlinear_pass_lets_go_what_the_frozen_state_would_pull():
    """The tip lifts off its rest: weight and shock act on the free arm, less the resting one."""
    text = arm(
        "SUPPORT 20 +Y\nCASE OPE = W\nCASE UP = U(0,2,0) ABOUT=OPE\n"
        "CASE UPN = U(0,2,0) ABOUT=OPE NONLINEAR\n"
    )
    case = solve(text)
    rest = force(case["OPE"], "20 +Y")[1]
    assert broken(case["UP"]) == {("20 +Y", "+Y", "pulls"): pytest.approx(rest, rel=1e-9)}
    assert force(case["UPN"], "20 +Y")[1] == pytest.approx(-rest, rel=1e-9)
    assert force(case["UP"], "20 +Y")[1] == pytest.approx(-2 * rest, rel=1e-9)
    free = WEIGHT * 4**4 / (8 * EI) + WEIGHT * 4 / K + WEIGHT * 8 * 4 / K  # one g upward
    assert u(case["UPN"], "20")[1] == pytest.approx(free - u(case["OPE"], "20")[1], rel=1e-9)


def test_nonlinear_snubber_is_locked_where_the_operating_case_left_the_pipe():
    case = solve(
        SMOOTH + "CASE NLX = U(0.3,0,0) ABOUT=OPE NONLINEAR\nCASE NO = 0*W ABOUT=OPE NONLINEAR\n"
    )
    assert abs(u(case["OPE"], "40")[0]) > 0.01
    assert abs(force(case["NLX"], "40 SNUBBER X")[0]) < 1e5  # not K times where it was
    assert np.abs(card_forces(case["NO"])).max() < 1e-3


# ---------------------------------------------------------------------- SNUBBERS=LOCKED
def test_locked_snubber_is_a_support_in_a_case_from_rest():
    load = "FORCE 40 F1 FX=5000\nCASE DYN = W + F1 SNUBBERS=LOCKED\nCASE ST = W + F1\n"
    locked = solve(LINE + "SNUBBER 40 X\n" + load)
    fixed = solve(LINE + "SUPPORT 40 X\n" + load)
    assert locked["DYN"].state.u == pytest.approx(fixed["DYN"].state.u, rel=0, abs=1e-14)
    assert force(locked["DYN"], "40 SNUBBER X")[0] == pytest.approx(
        force(fixed["DYN"], "40 X")[0], rel=1e-9
    )
    assert force(locked["ST"], "40 SNUBBER X")[0] == 0.0


def test_snubbers_lock_where_the_case_before_left_the_pipe():
    """FROM=OPE with locked snubbers is OPE and the nonlinear increment about it."""
    text = SMOOTH + (
        "FORCE 40 F1 FX=5000\n"
        "CASE DYN = W + P1 + T1 + F1 FROM=OPE SNUBBERS=LOCKED\n"
        "CASE MORE = W + P1 + T1 + 2*F1 FROM=DYN SNUBBERS=LOCKED STEPS=2\n"
        "CASE BACK = W + P1 + T1 FROM=MORE SNUBBERS=FREE\n"
        "CASE SLUG = F1 ABOUT=OPE NONLINEAR\n"
    )
    case = solve(text)
    before, slug = case["OPE"].state.u, case["SLUG"].state.u
    assert case["DYN"].state.u == pytest.approx(before + slug, rel=0, abs=1e-12)
    assert case["MORE"].state.u == pytest.approx(before + 2 * slug, rel=0, abs=1e-12)
    assert case["BACK"].state.u == pytest.approx(before, rel=0, abs=1e-12)
    held = force(case["DYN"], "40 SNUBBER X")[0]
    assert held == pytest.approx(force(case["SLUG"], "40 SNUBBER X")[0], rel=1e-6)
    assert -5000 < held < -2500


def test_cycle_locks_and_frees_snubbers():
    text = SMOOTH + (
        "FORCE 40 F1 FX=5000\nCASE DYN = W + P1 + T1 + F1 SNUBBERS=LOCKED\n"
        "CYCLE SHAKE = OPE, DYN TIMES=3\n"
    )
    shake = solve(text).cycles["SHAKE"]
    assert shake.cause is None
    assert shake.repeats
    snubber = [card.kind for card in shake.path[0].system.cards].index("snubber")
    loads = [card_forces(step)[snubber] for step in shake.path]
    assert np.all(loads[0] == 0.0)


def test_about_a_case_with_locked_snubbers():
    """ABOUT keeps them; ON, which is for free snubbers, lets them go."""
    text = arm(
        "SNUBBER 20 Z\nFORCE 20 F1 FZ=1000\nCASE DYN = W + F1 SNUBBERS=LOCKED\n"
        "CASE SLUG = F1 ABOUT=DYN\nCASE HSUS = F1 ON=DYN\n"
        "CASE SLUGN = F1 ABOUT=DYN NONLINEAR\n"
    )
    case = solve(text)
    share = -1000 * tip(4.0) / (tip(4.0) + 1 / K)
    for name in ("SLUG", "SLUGN"):
        assert force(case[name], "20 SNUBBER Z")[2] == pytest.approx(share, rel=1e-9), name
    assert force(case["HSUS"], "20 SNUBBER Z")[2] == 0.0
    assert u(case["HSUS"], "20")[2] == pytest.approx(1000 * tip(4.0), rel=1e-9)


def test_line_that_only_snubbers_hold():
    text = HEAD + (
        "PIPE 1 2 DX=5\nPIPE 2 3 DZ=5\nSNUBBER 1 X\nSNUBBER 1 Y\nSNUBBER 1 Z\n"
        "SNUBBER 2 Y\nSNUBBER 2 Z\nSNUBBER 3 Y\nSNUBBER 1 Z CNODE=3\n"
        "CASE DYN = U(0,-1,-1) SNUBBERS=LOCKED\nCASE UP = U(0,0.5,0.5) ABOUT=DYN\n"
    )
    case = solve(text)
    assert card_forces(case["DYN"])[:, 1].sum() == pytest.approx(10 * WEIGHT, rel=1e-9)
    assert card_forces(case["UP"]) == pytest.approx(-0.5 * card_forces(case["DYN"]), rel=1e-6)


@pytest.mark.parametrize("word", ["SNUBBERS=LOCKED", "SNUBBERS=FREE"])
def test_the_same_loads_again_in_steps_move_nothing(word):
    """Where a case starts its loads are those the case before ended with, snubbers and all."""
    loads = "CASE DYN = W + P1 + T1 + F1 FROM=OPE SNUBBERS=LOCKED\n"
    again = "CASE AGAIN = W + P1 + T1 + F1 FROM=DYN STEPS=4 SNUBBERS=LOCKED\n"
    text = LINE + SNUBBED["added"] + "FORCE 40 F1 FX=5000\n" + loads + again
    case = solve(text.replace("SNUBBERS=LOCKED", word))
    assert np.any(case["DYN"].state.mode == SLIP)
    assert case["AGAIN"].state.u == pytest.approx(case["DYN"].state.u, rel=0, abs=1e-12)


def test_snubber_between_two_pipes_locks_where_both_are():
    text = (
        arm("", 4.0)
        + "NODE 50 X=0 Z=1\nANCHOR 50\nPIPE 50 60 DX=4 T1=400\n"
        + "SNUBBER 20 X CNODE=60\nFORCE 20 F1 FX=1000\n"
        + "CASE OPE = T1\nCASE SLUG = F1 ABOUT=OPE\nCASE SLUGN = F1 ABOUT=OPE NONLINEAR\n"
    )
    case = solve(text)
    assert u(case["OPE"], "60")[0] - u(case["OPE"], "20")[0] > 0.01
    held = force(case["SLUG"], "20 SNUBBER X")[0]
    assert held == pytest.approx(-500, rel=1e-2)
    assert force(case["SLUGN"], "20 SNUBBER X")[0] == pytest.approx(held, rel=1e-6)


# ---------------------------------------------------------------------- modulus
def test_locked_case_has_the_modulus_of_the_case_it_stands_on():
    text = arm(
        "PROPERTY STEEL T=20 E=200e9\nPROPERTY STEEL T=170 E=160e9\nFORCE 20 F1 FZ=1000\n"
        "CASE OPE = T1\nCASE HOT = T1 E=HOT\n"
        "CASE A = F1 ABOUT=OPE\nCASE B = F1 ABOUT=HOT\nCASE C = F1 ABOUT=OPE E=HOT\n"
        "CASE D = F1 ON=HOT\nCASE E = F1 ON=OPE E=HOT\nCASE F = F1 ABOUT=HOT NONLINEAR\n"
        "CASE G = F1 ABOUT=HOT E=HOT NONLINEAR\n"
    )
    case = solve(text)
    cold = tip(4.0)
    hot = 4.0**3 / (3 * EI * 0.8) + 1 / K + 16 / K
    assert u(case["A"], "20")[2] == pytest.approx(1000 * cold, rel=1e-9)
    for name in "BCDEFG":
        assert u(case[name], "20")[2] == pytest.approx(1000 * hot, rel=1e-9), name
    same = solve(text.replace("CASE D = F1 ON=HOT", "CASE D = F1 ABOUT=HOT E=HOT"))
    assert same["B"].work["factorise"] + same["D"].work["factorise"] == 1


def test_hot_increment_of_a_cold_case_is_refused_where_it_would_be_subtracted():
    text = arm(
        "PROPERTY STEEL T=20 E=200e9\nPROPERTY STEEL T=170 E=160e9\nFORCE 20 F1 FZ=1000\n"
        "CASE OPE = T1\nCASE C = F1 ABOUT=OPE E=HOT NONLINEAR\n"
    )
    case = trunnion.solve(read_text(text, "hot.inp"))["C"]
    assert case.state is None
    assert case.cause == "E=HOT with NONLINEAR, but OPE is not hot"


# ---------------------------------------------------------------------- certificate
@pytest.fixture(scope="module")
def shaken():
    return solve(LINE + SNUBBED["added"] + SHOCKS)["EQZ"]


def judged(case, state, system=None, loads=None):
    """Certificate of other numbers than those reported."""
    return certify(
        system or case.system, loads or case.loads, state, correction_u=0.0, correction_r=0.0
    )


@pytest.mark.parametrize("name", ["u", "end_force", "reaction"])
def test_locked_certificate_sees_a_changed_number(shaken, name):
    assert judged(shaken, shaken.state).passed
    array = getattr(shaken.state, name)
    for index in np.argwhere(np.abs(array) > 1e-3 * np.abs(array).max()):
        wrong = array.copy()
        wrong[tuple(index)] *= 1 + 1e-4
        assert not judged(shaken, replace(shaken.state, **{name: wrong})).passed, index


def test_locked_certificate_sees_a_contact_called_open(shaken):
    for i in range(len(shaken.state.side)):
        side = shaken.state.side.copy()
        side[i] = 0
        assert not judged(shaken, replace(shaken.state, side=side)).passed


def test_locked_certificate_sees_another_stiffness_and_another_load(shaken):
    contacts = shaken.system.contacts
    i = int(np.abs(shaken.state.reaction).max(axis=1).argmax())
    k = contacts.k.copy()
    k[i] *= 0.5
    other = replace(shaken.system, contacts=replace(contacts, k=k))
    assert not judged(shaken, shaken.state, system=other).passed
    more = replace(shaken.loads, dist=1.001 * shaken.loads.dist)
    assert not judged(shaken, shaken.state, loads=more).passed


def test_locked_certificate_refuses_the_gap_put_back(shaken):
    """A gap in a frozen contact would be a contact closed without its gap used up."""
    contacts = shaken.system.contacts
    one_way = replace(contacts, gap=contacts.gap + 1e-3, two_way=np.zeros(len(contacts.k), bool))
    system = replace(shaken.system, contacts=one_way)
    assert not judged(shaken, shaken.state, system=system).passed
