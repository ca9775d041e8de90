"""EVENTS and STEPS follow the history of friction; each answer below is a closed form.

A cantilever along X with a gapped guide at its tip is pushed sideways by P and pulled along by
T.  The guide closes at the share f = gap 3EI / (P L3) of the load (a rigid anchor); from then on
the pull slides the tip along the guide, against mu (1 - f) P.
"""

from math import pi

import pytest

from trunnion import solve
from trunnion.deck.reader import read_text
from trunnion.results.supports import card_forces

P, T, L, GAP, MU, KF = 1000.0, 50e3, 3.0, 3e-3, 0.3, 1e8
BORE = 0.1143 - 2 * 0.00602
EI, EA = 200e9 * pi / 64 * (0.1143**4 - BORE**4), 200e9 * pi / 4 * (0.1143**2 - BORE**2)
K = 1e12  # of anchor and guide [N/m, N m/rad]
C = L**3 / (3 * EI) + (1 + L**2) / K  # sideways flexibility of the tip
CLOSES = GAP / (P * C)

TIP = """
UNITS    mm N MPa C
DEFAULT  SHEAR=OFF MU=0.3
MATERIAL S  E=200000
SECTION  A  OD=114.3 WALL=6.02
ANCHOR   10
PIPE     10 20 DX=3000
SUPPORT  20 GUIDE GAP=3
FORCE    20 F1 FZ=1000 FX=50000
CASE A = F1 EVENTS=ON
CASE B = F1
CASE QUARTERS = F1 EVENTS=ON STEPS=4
"""

LINE = """
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL S  E=200000 ALPHA=12e-6 DENSITY=7850
SECTION  A  OD=114.3 WALL=6.02 FLUID=1000
OPERATE  T1=140 T2=80 TREF=20
ANCHOR 10
PIPE   10 20 DX=6000
SUPPORT 20 +Y
PIPE   20 30 DX=6000
SUPPORT 30 +Y GUIDE GAP=1
PIPE   30 40 DX=6000
SUPPORT 40 +Y
PIPE   40 50 DZ=6000
SUPPORT 50 +Y GUIDE GAP=0.5
PIPE   50 60 DZ=4000
SUPPORT 60 +Y
CASE HALF = 0.5*W + T2 EVENTS=ON
CASE REST = W + T1 EVENTS=ON FROM=HALF
CASE BOTH = W + T1 EVENTS=ON STEPS=2
CASE PLAIN = W + T1 STEPS=2
"""


@pytest.fixture(scope="module")
def tip():
    return solve(read_text(TIP, "tip.inp"))


@pytest.fixture(scope="module")
def line():
    return solve(read_text(LINE, "line.inp"))


def guide(result):
    assert result.converged, result.cause
    i = result.system.contacts.word.index("GUIDE")
    return list(result.system.sliders.contact).index(i)


@pytest.mark.parametrize("case", ["A", "QUARTERS"])
def test_the_fraction_of_the_closing_is_exact(tip, case):
    share = CLOSES * (4 if case == "QUARTERS" else 1)  # 0.2007 of the load, in the first quarter
    assert tip[case].warnings == (f"EVENT: 20 GUIDE closes at {share:.6g} of the step",)


@pytest.mark.parametrize(("case", "since"), [("A", CLOSES), ("B", 0.0), ("QUARTERS", 0.75)])
def test_friction_counts_from_the_datum_of_the_last_commit(tip, case, since):
    """The tip slides in every step; the datum follows it at f and at the end of each quarter."""
    result, flexibility = tip[case], L / EA + 1e-12

    def travel(share):  # of the tip along X under a share of the load, sliding
        rub = MU * max(0.0, share * P * C - GAP) / (C + 1 / K)
        return (share * T - rub) * flexibility, rub

    (end, rub), (begin, rubbed) = travel(1.0), travel(since)
    i = guide(result)
    assert result.state.friction[i, 0] == pytest.approx(-rub, rel=1e-8)
    assert result.state.slide[i, 0] == pytest.approx(end - begin + rubbed / KF, rel=1e-8)


def test_two_steps_are_one_case_from_another(line):
    """STEPS=2 and FROM= the half-way case pass the same commits, events among them."""
    both, rest = line["BOTH"], line["REST"]
    assert line["HALF"].warnings == both.warnings != ()
    assert both.state.u == pytest.approx(rest.state.u, abs=1e-12)
    assert card_forces(both) == pytest.approx(card_forces(rest), abs=1e-6)
    assert abs(card_forces(line["PLAIN"]) - card_forces(both)).max() > 0.1  # the event matters
