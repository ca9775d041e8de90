"""Exact counts of work, and the same bytes from every process."""

import gc
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

import trunnion
from trunnion.deck.reader import read_text

ROOT = Path(__file__).parents[2]
HEAD = """\
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
OPERATE  T1=120 P1=1e6 TREF=20
"""
LINE = "PIPE 10 20 DX=5\nPIPE 20 30 DX=5\nPIPE 30 40 DZ=4\nANCHOR 10\n"


def solve(text):
    return trunnion.solve(read_text(HEAD + LINE + text, "deck.inp"))


def calls(results, case=None):
    work = results.work if case is None else results[case].work
    return tuple(work[name] for name in ("analyse", "factorise", "solve"))


def test_a_linear_case_is_one_analysis_one_factorisation_one_solve():
    assert calls(solve("SUPPORT 40 Y\nCASE A = W\n")) == (1, 1, 1)


@pytest.mark.parametrize("text", ["SUPPORT 40 Y\n", "SUPPORT 40 +Y GAP=1mm MU=0.3\n"])
def test_a_solve_leaves_nothing_for_the_collector(text):
    """A cycle of references would keep its arrays until then, and the next from using them."""
    model = read_text(HEAD + LINE + text + "CASE A = W\nCASE B = W + T1\n", "deck.inp")
    trunnion.solve(model)
    gc.collect()
    gc.disable()
    try:
        gc.set_debug(gc.DEBUG_SAVEALL)
        trunnion.solve(model)
        gc.collect()
        left = {type(x).__name__ for x in gc.garbage}
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
        gc.enable()
    assert not left & {"Structure", "Members", "SpdFactor", "CaseResult", "System", "ndarray"}


def test_linear_cases_share_one_factor_and_one_call():
    results = solve("SUPPORT 40 Y\nCASE A = W\nCASE B = W + T1\nCASE C = T1\nCOMB D = B - A\n")
    assert calls(results) == (1, 1, 3)
    assert calls(results, "A") == (1, 1, 3)  # what cases share stands on the first
    assert calls(results, "B") == (0, 0, 0)
    assert results.work["assemble"] == 1


def test_a_hot_modulus_costs_one_more_factor_and_no_analysis_more_than_its_own():
    table = "MATERIAL H E=203e9 NU=0.3 DENSITY=7850\nPROPERTY H T=20 E=203e9 ALPHA=12e-6\n"
    table += "PROPERTY H T=220 E=183e9 ALPHA=12e-6\n"
    deck = (
        HEAD + table + LINE + "SUPPORT 40 Y\nCASE A = W\nCASE B = W + T1\nCASE C = W + T1 E=HOT\n"
    )
    results = trunnion.solve(read_text(deck, "deck.inp"))
    assert calls(results)[1:] == (2, 3)


def test_gaps_that_stay_as_they_are_cost_one_solve_a_case():
    """A rest that stays closed and a stop that stays open: the first factor serves all."""
    results = solve("SUPPORT 30 +Y X GAP=1\nSUPPORT 40 +Y\nCASE A = W\nCASE B = 2*W\nCASE C = W\n")
    assert all(case.certificate.passed for case in results.cases.values())
    assert calls(results)[0] == 1
    assert calls(results, "B")[1] == 0
    assert calls(results, "C")[1] == 0
    first, again = calls(results, "A"), calls(results, "C")
    assert again[2] <= first[2]
    assert {h["what"] for h in results["A"].history} == {"no friction"}


def test_each_change_of_a_contact_is_one_factorisation():
    """The gap at 30 closes when hot: one more factor, and none to go on with it."""
    results = solve(
        "SUPPORT 30 X GAP=0.001\nSUPPORT 40 Y\nCASE A = W\nCASE B = W + T1\nCASE C = T1 + W\n"
    )
    assert calls(results, "A")[:2] == (1, 1)
    assert calls(results, "B")[:2] == (0, 1)
    assert calls(results, "C")[1] <= 2  # open at the start of every case, then closed
    assert results["B"].state.side.tolist() == results["C"].state.side.tolist()


def test_without_friction_there_is_no_friction_stage():
    smooth = solve("SUPPORT 30 +Y Z GAP=0.001\nSUPPORT 40 +Y\nCASE A = W + T1\n")
    rough = solve("SUPPORT 30 +Y Z GAP=0.001 MU=0.3\nSUPPORT 40 +Y MU=0.3\nCASE A = W + T1\n")
    assert {h["what"] for h in smooth["A"].history} == {"no friction"}
    assert "capacities" in {h["what"] for h in rough["A"].history}
    assert smooth.work["factorise"] < rough.work["factorise"]


def test_the_history_counts_what_changed_since_the_iteration_before():
    """Also where the law of friction becomes another one between two iterations."""
    case = trunnion.solve(trunnion.read(ROOT / "models" / "hot_header.inp"))["OPE"]
    contacts, sliders = case.system.contacts, case.system.sliders
    found = [
        len({*contacts.card[a.side != b.side].tolist(), *sliders.card[a.mode != b.mode].tolist()})
        for a, b in pairwise(case.passes)
    ]
    assert [h["n_changed"] for h in case.history] == found
    rubbing = [h["n_changed"] for h in case.history if h["what"] != "no friction"]
    assert rubbing[0] >= 9  # every support that slides in the end began to rub there


def test_iterations_are_those_of_the_history():
    results = solve("SUPPORT 30 +Y MU=0.3\nSUPPORT 40 +Y MU=0.3\nCASE A = W + T1\n")
    case = results["A"]
    assert case.work["iterations"] == len(case.history)
    assert [h["iteration"] for h in case.history] == list(range(1, len(case.history) + 1))
    assert sum(c.work["factorise"] for c in results.cases.values()) == results.work["factorise"]


@pytest.mark.parametrize("deck", ["models/hot_header.inp", "tests/decks/ramping.inp"])
def test_fresh_processes_and_threads_give_the_same_bytes(deck, tmp_path):
    written = []
    for i, threads in enumerate(("1", "1", "2")):
        folder = tmp_path / f"{i}"
        env = os.environ | {"OPENBLAS_NUM_THREADS": threads, "OMP_NUM_THREADS": threads}
        env["PYTHONHASHSEED"] = str(i)
        command = [sys.executable, "-m", "trunnion", "run", str(ROOT / deck), "-o", str(folder)]
        done = subprocess.run(command, capture_output=True, text=True, env=env, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        files = sorted(folder.iterdir())
        assert [f.suffix for f in files] == [".json", ".out"]
        written.append([f.read_bytes() for f in files])
    assert written[0] == written[1]
    assert written[0] == written[2]
