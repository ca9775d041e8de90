"""What a deck does not need is not done: exact ledgers of decks that differ by one feature.

`refine` are four solves a case: the last correction, the price of the penalty, the digits left
and how many the factor has.
`elements` counts their evaluations: the pipe of three elements is one chain, seen whole when
stiffness is made and numbers are reported.
"""

import pytest

import trunnion
from trunnion.deck.reader import read_text

LINE = """\
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
OPERATE  T1=120 P1=1e6 TREF=20
PIPE 10 20 DX=5
PIPE 20 30 DX=5
PIPE 30 40 DZ=4
ANCHOR 10
"""
LINEAR = "SUPPORT 40 Y\nCASE A = W\n"
NAMES = ("analyse", "assemble", "factorise", "solve", "refine", "iterations")


def work(text):
    return trunnion.solve(read_text(LINE + text, "deck.inp")).work


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        (LINEAR, (1, 1, 1, 1, 4, 0)),
        (LINEAR + "CASE B = W + T1\nCASE C = 2*W\n", (1, 1, 1, 3, 12, 0)),
        (LINEAR + "CASE B = W + T1\nCOMB D = B - A\n", (1, 1, 1, 2, 8, 0)),
        (LINEAR + "SNUBBER 30 X\n", (1, 1, 1, 1, 4, 0)),
        ("SUPPORT 40 +Y\nCASE A = W\n", (1, 1, 1, 1, 4, 1)),
        ("SUPPORT 40 +Y X GAP=9\nCASE A = W\nCASE B = W + T1\n", (1, 1, 1, 2, 8, 2)),
        ("SUPPORT 40 +Y\nCASE A = W\nCASE E = U(0.1,0,0) ABOUT=A\n", (1, 1, 2, 2, 8, 1)),
    ],
    ids=["one case", "three cases", "combination", "snubber", "rest", "open gap", "locked pass"],
)
def test_the_work_is_exactly(text, counts):
    assert work(text) == dict(zip(NAMES, counts, strict=True)) | {
        "elements": work(text)["elements"]
    }


def test_a_report_of_one_case_sees_every_element_twice():
    """At assembly and for the answer; the chain's own counts are one each."""
    elements, chain, looks = 3, 1, 2
    assert work(LINEAR)["elements"] == looks * elements + 4 * chain


def test_friction_that_nothing_presses_costs_no_factor():
    free = work("SUPPORT 40 Y\nSUPPORT 30 -Y GAP=9 MU=0.3\nCASE A = W\n")
    assert (free["factorise"], free["solve"]) == (1, 1 + (free["iterations"] - 1))


@pytest.mark.parametrize("name", ["mass", "inertia", "extended"])
def test_what_was_never_needed_is_not_even_counted(name):
    assert name not in work(LINEAR)
    assert name not in work("SUPPORT 40 +Y MU=0.3\nCASE A = W + T1\n")


def test_modes_alone_make_masses():
    assert work(LINEAR + "MODES 2\n")["mass"] == 1
