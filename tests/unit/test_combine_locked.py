"""Combinations of cases whose supports are not all engaged alike: frozen states, snubbers."""

import numpy as np
import pytest

import trunnion
from trunnion.arrays import OPEN
from trunnion.deck.reader import read_text
from trunnion.results.balance import local_end_forces
from trunnion.results.supports import gathered

DECK = """\
DEFAULT MU=0.3
MATERIAL A E=203e9 ALPHA=11.7e-6 DENSITY=7850
SECTION S OD=0.2731 WALL=0.00927 FLUID=800
OPERATE T1=200 P1=1e6
ANCHOR 10
PIPE 10 20 DX=6 DZ=4
SUPPORT 20 +Y GUIDE GAP=0.01 ALONG=20-30
PIPE 20 30 DX=6
BEND 30
PIPE 30 40 DY=3
PIPE 40 50 DY=3 DX=1
SUPPORT 40 X GAP=0.5
SUPPORT 50 +Y Z
SNUBBER 30M (1,0,1)
SNUBBER 50 X K=1e7
CASE SUS = W + P1
CASE OPE = W + P1 + T1
CASE EQX = U(0.3,0,0) ABOUT=OPE
CASE EQS = U(0,0,0.2) ABOUT=SUS
CASE HSUS = W + P1 ON=OPE
COMB SUM = OPE + 2*EQX
COMB EXP = OPE - SUS
COMB DIF = HSUS - EQS
COMB OCC = SUS + ABS(EQX)
COMB TOP = SRSS(EQX,EQS) + MAX(ABS(OCC), SUS)
COMB BOTH = SRSS(EQX,EQS)
"""


@pytest.fixture(scope="module")
def results():
    found = trunnion.solve(read_text(DECK))
    assert all(case.converged for case in found.cases.values())
    return found


def test_the_states_differ(results):
    words = {results[name].system.contacts.word for name in ("OPE", "EQX", "EQS")}
    assert len(words) == 3
    assert (results["OPE"].state.side == OPEN).any()


@pytest.mark.parametrize(
    "of",
    [lambda c: gathered(c).card_force, local_end_forces, lambda c: c.state.end_force],
    ids=["support", "local", "global"],
)
def test_every_component_is_combined(results, of):
    sus, ope, eqx, eqs, hsus = (of(results[n]) for n in ("SUS", "OPE", "EQX", "EQS", "HSUS"))
    occ = sus + abs(eqx)
    wanted = {
        "SUM": ope + 2 * eqx,
        "EXP": ope - sus,
        "DIF": hsus - eqs,
        "OCC": occ,
        "TOP": np.hypot(eqx, eqs) + np.maximum(abs(occ), abs(sus)),
        "BOTH": np.hypot(eqx, eqs),
    }
    for name, want in wanted.items():
        assert np.allclose(of(results[name]), want, rtol=0, atol=1e-13 * abs(want).max()), name


def test_only_weighted_sums_have_interior_points(results):
    assert results["SUM"].linear
    assert not results["OCC"].linear
    assert not results["BOTH"].linear
