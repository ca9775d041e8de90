"""The status iteration of the trade as an independent check of Newton.

Where it certifies, it must agree with the default method to 1e-8 of the largest number.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.model import Case

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from rack import rack_model, read_rack  # noqa: E402

DECKS = ("b313_s302", "slide_unload", "sliding_line")


def by_status(model):
    cases = [replace(c, iteration=None) if isinstance(c, Case) else c for c in model.cases]
    return replace(model, settings=replace(model.settings, iteration="STATUS"), cases=cases)


def compare(one, two):
    assert one.converged, one.cause
    assert one.certificate.passed
    u, v = one.state.u + one.state.u_low, two.state.u + two.state.u_low
    assert np.abs(u - v).max() <= 1e-8 * np.abs(v).max()
    for name in ("end_force", "reaction", "friction"):
        a, b = getattr(one.state, name), getattr(two.state, name)
        if b.size:
            assert np.abs(a - b).max() <= 1e-8 * max(1.0, np.abs(b).max())
    assert np.array_equal(one.state.side, two.state.side)
    assert np.array_equal(one.state.mode, two.state.mode)


@pytest.mark.parametrize("name", DECKS)
def test_status_agrees_on_decks(deck, run, name):
    results = trunnion.solve(by_status(deck(name)))
    for case in (c.name for c in deck(name).cases if isinstance(c, Case)):
        compare(results[case], run(name).results[case])


@pytest.mark.parametrize("case", ["gap", "fric1"])
def test_status_agrees_on_the_small_rack(case):
    model = rack_model(read_rack(ROOT / "tests/data/rack_50.json.gz"), case)
    compare(trunnion.solve(by_status(model))[case.upper()], trunnion.solve(model)[case.upper()])


def test_aitken_jumps_are_needed(deck):
    jumps = {}
    for name in DECKS:
        results = trunnion.solve(by_status(deck(name)))
        jumps[name] = max(r.work.get("aitken", 0) for r in results.cases.values())
    rack = rack_model(read_rack(ROOT / "tests/data/rack_50.json.gz"), "fric1")
    jumps["rack_50"] = trunnion.solve(by_status(rack))["FRIC1"].work.get("aitken", 0)
    assert sum(n > 0 for n in jumps.values()) >= 2, jumps


def test_ramps_after_a_failed_status_step_are_bounded(deck, monkeypatch):
    """Seven ramps of 200 000 passes a sub-step took hours to say that a case does not settle."""
    from trunnion.solver import steps

    asked, true = [], steps.solve_status

    def hasty(*args, passes=None):
        asked.append(passes)
        return true(*args, passes=1)

    monkeypatch.setattr(steps, "solve_status", hasty)
    case = trunnion.solve(by_status(deck("sliding_line")))["OPE"]
    assert not case.converged
    assert asked[-1] == steps.LAST_PASSES
    assert asked.count(None) == 2  # the first step of each case alone runs its full length
