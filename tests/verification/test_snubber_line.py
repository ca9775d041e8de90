"""Riser with snubbers: free growth, the locked pass, what its frozen assumption breaks.

The locked cases are solved again here: a dense Euler-Bernoulli frame of its own, on springs
listed by hand from the contacts closed in OPE, refined in extended precision.  Agreement 1e-9 of
the largest displacement or force.
"""

from itertools import pairwise
from math import pi

import numpy as np
import pytest
from published import PROGRAMS, Source, agrees

from trunnion.arrays import SLIP

LINE = Source(
    PROGRAMS,
    "A riser with snubbers",
    "snubber_line",
    "The locked cases are solved again by a dense Euler-Bernoulli frame of its own (`dense` in "
    "test_snubber_line.py), on springs listed by hand from the contacts closed in OPE, refined in "
    "extended precision; all movements and support loads agree to 1e-9 of the largest. The numbers "
    "here stand on top of the deck.",
)
E, NU, ALPHA, RHO, G, DT = 200e9, 0.3, 12e-6, 7850.0, 9.80665, 200.0
OD, WALL = 0.3239, 0.0127
BORE = OD - 2 * WALL
AREA = pi / 4 * (OD**2 - BORE**2)
EI = E * pi / 64 * (OD**4 - BORE**4)
EA, GJ, WEIGHT = E * AREA, EI / (1 + NU), RHO * G * AREA
NODES = {
    "10": (0, 0, 0),
    "20": (0, 5, 0),
    "30": (0, 10, 0),
    "40": (0, 12, 0),
    "50": (6, 12, 0),
    "60": (12, 12, 0),
    "70": (18, 12, 0),
}
LABELS = list(NODES)
K = 1e12
X, Y, Z, SKEW = (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5**0.5, 0, 0.5**0.5)
REST = [("20", X), ("60", Y), ("70", Y)]  # closed in OPE: the guide at 20 pushes along X
SNUBBERS = [("30", SKEW), ("60", X), ("70", Z)]


def stiffness(start, end):
    """12 x 12 of a straight pipe between two points, global axes."""
    d = np.subtract(end, start).astype(float)
    length = np.linalg.norm(d)
    x = d / length
    y = np.array([0.0, 1.0, 0.0]) if abs(x[1]) < 0.5 else np.array([1.0, 0.0, 0.0])
    turn = np.array([x, y, np.cross(x, y)])
    k = np.zeros((12, 12))
    a, t = EA / length, GJ / length
    for i, stiff in ((0, a), (3, t)):
        k[np.ix_([i, i + 6], [i, i + 6])] += stiff * np.array([[1, -1], [-1, 1]])
    for v, r, sign in ((1, 5, 1), (2, 4, -1)):
        c = np.array([12, 6 * sign * length, -12, 6 * sign * length])
        row = [v, r, v + 6, r + 6]
        q = np.array(
            [
                c,
                [c[1], 4 * length**2, -c[1], 2 * length**2],
                -c,
                [c[1], 2 * length**2, -c[1], 4 * length**2],
            ]
        )
        k[np.ix_(row, row)] += EI / length**3 * q
    whole = np.kron(np.eye(4), turn)
    return whole.T @ k @ whole


def dense(springs, load):
    """Displacements (7, 6) of the frame on springs under a force (3,) per length."""
    n = 6 * len(LABELS)
    k, f = np.zeros((n, n), np.longdouble), np.zeros(n, np.longdouble)
    for a, b in pairwise(LABELS):
        i, j = 6 * LABELS.index(a), 6 * LABELS.index(b)
        at = np.r_[i : i + 6, j : j + 6]
        k[np.ix_(at, at)] += stiffness(NODES[a], NODES[b])
        d = np.subtract(NODES[b], NODES[a]).astype(float)
        length = np.linalg.norm(d)
        moment = np.cross(d, load) * length / 12
        f[at] += np.concatenate((load, [0] * 3, load, [0] * 3)) * length / 2
        f[at[3:6]] += moment
        f[at[9:12]] -= moment
    k[range(6), range(6)] += K
    for label, way in springs:
        at = 6 * LABELS.index(label) + np.arange(3)
        k[np.ix_(at, at)] += K * np.outer(way, way)
    solve = np.linalg.inv(k.astype(float))
    u = np.zeros(n, np.longdouble)
    for _ in range(12):
        u += solve @ (f - k @ u).astype(float)
    return u.astype(float).reshape(-1, 6)


LOCKED = {
    "EQX": (REST + SNUBBERS, (0.3, 0, 0)),
    "EQY": (REST + SNUBBERS, (0, 0.6, 0)),
    "EQZ": (REST + SNUBBERS, (0, 0, 0.3)),
    "HSUS": (REST, (0, -1, 0)),
}


@pytest.fixture(scope="module")
def line(run):
    return run("snubber_line")


def breaks(case):
    """What the frozen check lists: (card, word, what) -> amount."""
    cards = case.system.cards
    return {(cards[b.card].name, b.word, b.what): b.amount for b in case.result.frozen_check}


def snubbers(case):
    """Force of every snubber on the pipe."""
    from trunnion.results.supports import card_forces

    forces = card_forces(case.result)[:, :3]
    cards = enumerate(case.system.cards)
    return {c.label: forces[i] for i, c in cards if c.kind == "snubber"}


def test_contacts_closed_when_hot(line):
    ope = line["OPE"]
    closed = {
        (label, word): not ope.is_open(label, word)
        for label, word in (("20", "GUIDE"), ("50", "+Y"), ("60", "+Y"), ("60", "GUIDE"))
    }
    assert closed == {
        ("20", "GUIDE"): True,
        ("50", "+Y"): False,
        ("60", "+Y"): True,
        ("60", "GUIDE"): False,
    }


def test_riser_grows_freely_past_its_snubbers(line):
    moved = line["OPE"].u("40") - line["SUS"].u("40")
    shortened = (line["OPE"].support("10")[1] - line["SUS"].support("10")[1]) * 12 / EA
    assert moved[1] == pytest.approx(ALPHA * DT * 12 - shortened, rel=2e-4)
    agrees(LINE, "OPE, rise of 40", "28.73", 1e3 * line["OPE"].u("40")[1], "mm")
    assert line["OPE"].u("70")[0] > 0.044


@pytest.mark.parametrize(("label", "printed"), [("60", 5248), ("70", 3912)])
def test_rests_slide_when_hot(line, label, printed):
    ope = line["OPE"]
    i = ope.slider(label, "+Y")
    assert ope.state.mode[i] == SLIP
    agrees(LINE, f"OPE, N on the rest at {label}, which slides", printed, ope.state.normal[i], "N")


@pytest.mark.parametrize("case", ["SUS", "OPE", "HSUS"])
def test_free_snubbers_carry_nothing(line, case):
    assert len(snubbers(line[case])) == 3
    assert all(np.all(force == 0.0) for force in snubbers(line[case]).values())


@pytest.mark.parametrize("case", LOCKED)
def test_locked_pass_is_the_dense_solution_of_the_frozen_line(line, case):
    springs, factor = LOCKED[case]
    ours = np.array([line[case].u(label) for label in LABELS])
    expected = dense(springs, np.array(factor) * WEIGHT)
    assert ours == pytest.approx(expected, rel=0, abs=1e-9 * np.abs(expected).max())


PRINTED = {  # on top of the deck: node, axis, force on the pipe [N]
    "EQX": (("20", 0, -2009.13), ("60", 1, -76.41), ("60", 0, -6049.82)),
    "EQY": (("20", 0, -1376.93), ("60", 1, -6288.92), ("60", 0, 942.37)),
    "EQZ": (("20", 0, 2299.77), ("60", 1, 355.45), ("60", 0, 3716.42)),
    "HSUS": (("20", 0, -1109.46), ("60", 1, 11217.56), ("70", 1, 918.70)),
}
SKEWED = {"EQX": -15.41, "EQY": -47.27, "EQZ": -7456.11}


@pytest.mark.parametrize("case", PRINTED)
def test_numbers_on_top_of_the_deck(line, case):
    for label, axis, force in PRINTED[case]:
        ours = line[case].support(label)[axis]
        agrees(LINE, f"{case}, {label} F{'XYZ'[axis]} on the pipe", f"{force:.2f}", ours, "N")
    if case in SKEWED:
        ours = snubbers(line[case])["30"] @ SKEW
        agrees(LINE, f"{case}, snubber at 30", SKEWED[case], ours, "N")


@pytest.mark.parametrize("case", LOCKED)
def test_support_loads_of_the_dense_solution(line, case):
    springs, factor = LOCKED[case]
    u = dense(springs, np.array(factor) * WEIGHT)
    expected = {label: np.zeros(3) for label in LABELS}
    expected["10"] = -K * u[0, :3]
    for label, way in springs:
        expected[label] += -K * np.array(way) * (np.array(way) @ u[LABELS.index(label), :3])
    size = max(np.abs(force).max() for force in expected.values())
    for label in ("10", "20", "30", "50", "60", "70"):
        ours = line[case].support(label)[:3]
        assert ours == pytest.approx(expected[label], rel=0, abs=1e-9 * size), label


def test_snubbers_take_the_full_share_along_their_axis(line):
    force = snubbers(line["EQX"])
    total = 0.3 * WEIGHT * 30
    carried = sum(f[0] for f in force.values())
    held = line["EQX"].support("10")[0] + line["EQX"].support("20")[0]
    assert carried + held == pytest.approx(-total, rel=1e-9)
    assert force["60"][0] == pytest.approx(-6049.82, abs=0.005)
    assert force["30"][0] == force["30"][2]


def test_upward_shock_would_have_to_pull_the_rest(line):
    pulls = breaks(line["EQY"])
    hot = line["OPE"].support("60")[1]
    up = line["EQY"].support("60")[1]
    assert set(pulls) == {("60 +Y GUIDE", "+Y", "pulls"), ("20 GUIDE", "GUIDE", "pulls")}
    for case, printed in (("EQY", 741.9), ("EQX", 1374.1)):
        ours = breaks(line[case])["20 GUIDE", "GUIDE", "pulls"]
        agrees(LINE, f"{case}, the guide at 20 would pull", printed, ours, "N")
    assert pulls["60 +Y GUIDE", "+Y", "pulls"] == pytest.approx(-(hot + up), rel=1e-12)
    agrees(LINE, "EQY, the rest at 60 would pull", 1041.3, pulls["60 +Y GUIDE", "+Y", "pulls"], "N")


def test_lateral_shock_would_close_the_guide(line):
    closes = breaks(line["EQZ"])
    moved = line["OPE"].u("60")[2] + line["EQZ"].u("60")[2]
    assert set(closes) == {("60 +Y GUIDE", "GUIDE", "closes")}
    assert closes["60 +Y GUIDE", "GUIDE", "closes"] == pytest.approx(abs(moved) - 0.005, rel=1e-9)
    beyond = 1e3 * closes["60 +Y GUIDE", "GUIDE", "closes"]
    agrees(LINE, "EQZ, the guide at 60 would close beyond its gap", 5.155, beyond, "mm")


def test_nonlinear_pass_lifts_the_rest(line):
    """What the frozen pass lists as pulling, the nonlinear one lets go."""
    hot, shock = (line[case].support("60")[1] for case in ("OPE", "EQYN"))
    assert hot + shock == pytest.approx(0.0, abs=1e-5)
    assert line["EQYN"].support("60")[1] != pytest.approx(line["EQY"].support("60")[1], rel=0.1)


def test_locked_cases_share_one_factorisation(line):
    work = {name: line.results[name].work for name in ("EQX", "EQY", "EQZ", "HSUS")}
    assert [work[name]["analyse"] for name in work] == [0, 0, 0, 0]
    assert sum(work[name]["factorise"] for name in ("EQX", "EQY", "EQZ")) == 1
    assert work["HSUS"]["factorise"] == 1
    assert [work[name]["iterations"] for name in work] == [0, 0, 0, 0]
