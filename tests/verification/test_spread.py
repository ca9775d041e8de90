"""Other answers of a case: all three of the strut, and none where theory says that there is none.

Closed forms of the strut: tests/verification/test_struts.py; design notes, section 1.4.
"""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.arrays import OPEN, SLIP, STICK
from trunnion.deck.reader import read_text
from trunnion.report.json import json_report
from trunnion.report.text import text_report
from trunnion.results.supports import card_forces

MODELS = Path(__file__).parents[2] / "models"
# normal force of each exact answer [N], printed for a rigid head; its penalty springs of 1e12
# move them by up to 0.2 N
STRUT = {OPEN: 0.0, SLIP: 3625.9, STICK: 18978.9}


def read(name):
    return trunnion.read(MODELS / f"{name}.inp")


def certified(spreading):
    return all(a.converged and a.certificate.passed for a in spreading.answers)


@pytest.mark.parametrize("n", [3, 8, 20])
def test_all_three_answers_of_the_strut_are_found(n):
    spread = trunnion.spread(read("strut_three"), "PUSH", n)
    assert len(spread.starts.tried) == n
    assert certified(spread.starts)
    found = {int(a.state.mode[0]): float(a.state.normal[0]) for a in spread.starts.answers}
    assert len(spread.starts.answers) == 3
    assert found == pytest.approx(STRUT, abs=0.25)


def test_the_spread_is_the_largest_less_the_smallest_load_of_all_answers():
    spread = trunnion.spread(read("strut_three"), "PUSH", 6)
    force = np.array([card_forces(a) for a in spread.starts.answers])
    end = np.array([a.state.end_force for a in spread.starts.answers])
    assert spread.starts.supports == pytest.approx(np.ptp(force, axis=0), abs=1e-6)
    assert spread.starts.elements == pytest.approx(np.ptp(end, axis=0), abs=1e-6)
    # the foot's support carries from nothing to the whole normal force of the one that sticks
    assert spread.starts.supports[0, 1] == pytest.approx(18978.9, abs=0.25)


@pytest.mark.parametrize(("name", "case"), [("strut_cycle", "PUSH"), ("hot_header", "OPE"),
                                            ("rack_50", "FRIC1"), ("rack_200", "FRIC1"),
                                            ("slide_unload", "T155")])  # fmt: skip
def test_no_second_answer_is_invented_where_none_is_known(name, case):
    spread = trunnion.spread(read(name), case, 9)
    assert spread.unique is None
    assert certified(spread.starts)
    assert len(spread.starts.answers) == 1
    size = np.abs(card_forces(spread.starts.answers[0])).max()
    assert spread.starts.supports.max() < 1e-8 * size
    assert sum(t.answer == 0 for t in spread.starts.tried) >= 6


def test_a_continuum_has_one_set_of_loads_and_a_spread_of_movements():
    # six equal rests all slide; the line may lie anywhere within +-10 mm (design notes, 1.4)
    spread = trunnion.spread(read("floating_rests"), "OPE", 16)
    assert len(spread.starts.answers) == 1
    assert spread.starts.supports.max() < 1e-6
    assert 1e-4 < spread.starts.moves[:, 0].max() < 0.0301


@pytest.mark.parametrize(
    ("name", "case", "why"),
    [("rack_50", "GAP", "convex"), ("straight_pipe", "GRAV", "linear"),
     ("wind_crossing", "WND", "frozen")],
)  # fmt: skip
def test_a_case_without_friction_says_why_its_answer_is_unique(name, case, why):
    spread = trunnion.spread(read(name), case, 5)
    assert why in spread.unique
    assert spread.starts.tried == ()
    assert spread.orders is None
    assert not spread.starts.supports.any()
    assert not spread.starts.elements.any()


def test_load_orders_are_told_apart_from_starts():
    spread = trunnion.spread(read("hot_header"), "OPE", 6)
    assert spread.starts.supports.max() < 1e-6
    assert spread.orders.supports.max() > 100.0
    assert certified(spread.orders)
    what = [tried.what for tried in spread.orders.tried]
    assert what[:3] == ["2 steps", "4 steps", "8 steps"]
    assert what[3] == "W, H, P1, T1, D1"
    assert len(what) == 3 + 6


def test_the_end_of_a_load_order_is_that_of_cases_one_from_another():
    deck = (MODELS / "rack_50.inp").read_text()
    head = deck[: deck.index("\nCASE")]
    chain = read_text(f"{head}\nCASE A = T1\nCASE B = T1 + W FROM=A\n", "chain.inp")
    ends = trunnion.solve(chain)
    spread = trunnion.spread(read("rack_50"), "FRIC1", 9)
    tried = next(t for t in spread.orders.tried if t.what == "T1, W")
    if tried.answer is None:
        assert not ends["B"].converged
    else:
        force = card_forces(spread.orders.answers[tried.answer])
        assert force == pytest.approx(card_forces(ends["B"]), rel=1e-6, abs=1e-3)


def test_history_stays_what_it_is():
    model = read("slide_unload")
    own = trunnion.solve(model)["T200"]
    spread = trunnion.spread(model, "T200", 6)
    force = card_forces(spread.starts.answers[0])
    assert force == pytest.approx(card_forces(own), rel=1e-9, abs=1e-6)
    assert all("steps" in t.what for t in spread.orders.tried)  # no orders: FROM has its loads


def test_events_are_not_looked_for_from_a_displaced_pipe():
    deck = (MODELS / "rack_50.inp").read_text().replace("DEFAULT ", "DEFAULT EVENTS=ON ")
    spread = trunnion.spread(read_text(deck, "events.inp"), "FRIC1", 6)
    assert not any("displacements" in t.what for t in spread.starts.tried)


def test_a_case_that_is_not_there_is_named():
    with pytest.raises(trunnion.ModelError, match="CASE PUSCH is not defined; nearest: PUSH"):
        trunnion.spread(read("strut_three"), "PUSCH")


def test_reports_tell_what_was_found(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "trunnion", "run", MODELS / "strut_three.inp", "--spread", "8",
         "-o", tmp_path],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert "SPREAD PUSH: 3 answers, certified from 8 of 8 starts" in done.stdout
    assert "warning: PUSH: 3 certified answers were found" in done.stdout
    text = (tmp_path / "strut_three.out").read_text()
    for words in ("OTHER ANSWERS", "all stuck", "SPREAD OF SUPPORT LOADS", "SPREAD OF END FORCES"):
        assert words in text
    found = json.loads((tmp_path / "strut_three.json").read_text())["spread"]["PUSH"]
    assert [a["states"][0] for a in found["starts"]["answers"]] == ["open", "stick", "slip"]
    assert sum(a["found"] for a in found["starts"]["answers"]) == 8
    assert {t["answer"] for t in found["starts"]["tried"]} == {1, 2, 3}
    assert found["starts"]["supports"][0]["spread"][1] == pytest.approx(18978.9, abs=0.25)


def test_the_same_search_gives_the_same_bytes():
    files = []
    for _ in range(2):
        model = read("rack_50")
        results = trunnion.solve(model, spread=5)
        files.append((json_report(results, model), text_report(results, model)))
    assert files[0] == files[1]


def test_without_a_search_nothing_is_said():
    results = trunnion.solve(read("strut_three"))
    assert results.spreads == {}
    assert b'"spread"' not in json_report(results)
