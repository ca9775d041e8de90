"""Digits that are lost are told, and a factor that has too few of them is replaced."""

from math import pi
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.solver.coupled import gmres
from trunnion.solver.ledger import Ledger
from trunnion.solver.structure import Structure
from trunnion.system import build_system

OD, WALL, E, STRAIN = 0.2191, 0.00818, 203e9, 0.0012
HEAD = f"""\
DEFAULT  SHEAR=OFF
MATERIAL S E={E:g} NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD={OD} WALL={WALL}
OPERATE  T1=100 TREF=0
ANCHOR   10
"""


def solve(text):
    return trunnion.solve(read_text(HEAD + text, "deck.inp"))["A"]


def pushed_back(part):
    """A hot cantilever whose tip is pushed back by all but a part of its expansion."""
    push = E * pi * WALL * (OD - WALL) * STRAIN * (1.0 - part)
    return f"DEFAULT K=1e22 KR=1e22\nPIPE 10 20 DX=2\nFORCE 20 F1 FX={-push!r}\nCASE A = T1 + F1\n"


@pytest.mark.parametrize(("part", "lost"), [(1e-3, 3), (1e-6, 6), (1e-9, 9)])
def test_what_cancels_is_lost(part, lost):
    left, where = solve(pushed_back(part)).digits
    assert left == pytest.approx(15.9 - lost, abs=0.7)
    assert where == "node 20 X"


def test_fewer_than_six_digits_are_a_warning():
    poor, fair = solve(pushed_back(1e-11)), solve(pushed_back(1e-6))
    assert [w for w in poor.warnings if "digits are left" in w and "node 20 X" in w]
    assert not [w for w in fair.warnings if "digits" in w]


STUBS = "".join(
    f"PIPE {i} {i + 10} DX={dx}\nSUPPORT {i + 10} Y K=1e8 GAP=1\n"
    for i, dx in zip(range(10, 60, 10), (0.001, 1000, 0.001, 1000, 0.001), strict=True)
)


def test_a_factor_that_cannot_solve_is_replaced_by_one_in_double_double():
    """Stubs of 1 mm between kilometres, on supports that keep them out of chains."""
    case = solve(STUBS + "FORCE 60 F1 FY=1e-3 FZ=2e-3\nCASE A = F1 + T1\n")
    assert case.certificate.worst < 1e-9
    assert [w for w in case.warnings if "extended precision" in w]
    ei = E * pi * WALL * (OD - WALL) / 16 * (OD**2 + (OD - 2 * WALL) ** 2)
    length = 2000.003
    assert case.displacements["60"]["uz"] == pytest.approx(2e-3 * length**3 / 3 / ei, rel=1e-6)


@pytest.mark.parametrize("case", ["1.1*F1 + T1", "F1 + 1.000001*T1", "F1 + T1", "-F1 + T1"])
def test_a_start_near_the_answer_is_refined_until_it_balances(case):
    """The last correction counts where it is small against the movement but moves forces."""
    text = STUBS + f"FORCE 60 F1 FY=1e-3 FZ=2e-3\nCASE A = F1 + T1\nCASE B = {case} FROM=A\n"
    found = trunnion.solve(read_text(HEAD + text, "deck.inp"))["B"]
    assert found.certificate.worst < 1e-11


def test_the_factor_in_double_double_is_that_of_the_matrix():
    """Random right-hand sides, against the factor in doubles of a tame structure."""
    deck = (
        "PIPE 10 20 DX=2\nPIPE 20 30 DZ=3\nBEND 20 R=0.3\nPIPE 30 40 DX=1 DY=2\nPIPE 30 50 DY=1\n"
    )
    deck += "SUPPORT 30 +Y MU=0.3\nSUPPORT 40 X CNODE=50\nCASE A = W\n"
    s = Structure(build_system(read_text(HEAD + deck, "deck.inp")), Ledger())
    r = np.random.default_rng(7).normal(size=(3, s.n_node, 6))
    assert s.factorise(s.closed_tangent, s.stuck_tangent, 0.0)
    plain = s.solve(r)
    assert s.extend(True)
    assert s.factorise(s.closed_tangent, s.stuck_tangent, 0.0)
    sharp = s.solve(r)
    assert sharp == pytest.approx(plain, rel=0, abs=1e-8 * np.abs(sharp).max())
    back = np.stack([s.product(s.closed_tangent, s.stuck_tangent, x) for x in sharp])
    assert back == pytest.approx(r, rel=0, abs=1e-3)
    assert s.ledger.count["extended"] == 1
    s.extend(False)


def test_a_tame_case_never_asks_for_more_digits():
    case = solve("PIPE 10 20 DX=2\nSUPPORT 20 +Y MU=0.3\nCASE A = W + T1\n")
    assert "extended" not in case.work


def test_an_undetermined_motion_is_told_where_double_double_takes_too_long(monkeypatch):
    """The factor in doubles is at hand again after the larger one was found too dear."""
    monkeypatch.setattr("trunnion.solver.extended.MOST", 0)
    deck = Path(__file__).parents[2] / "models" / "floating_rests.inp"
    for case in trunnion.solve(trunnion.read(deck)).cases.values():
        assert case.certificate.passed


def test_a_large_right_side_ends_no_iteration_early():
    """What is solved for is in the unit of its forces: from 1 N to 1e14 N, the same solution."""
    rng = np.random.default_rng(4)
    a = np.eye(12) + np.outer(rng.normal(size=12), rng.normal(size=12)) * 0.01
    b = rng.normal(size=(2, 6))

    def product(v):
        return (a @ v.ravel()).reshape(v.shape)

    for size in (1e-9, 1.0, 1e14):
        x = gmres(product, size * b, 1e-12, 60)
        assert np.abs(product(x) - size * b).max() <= 1e-11 * size * np.abs(b).max()
