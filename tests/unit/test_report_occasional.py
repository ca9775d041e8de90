"""Reports of snubbers, locked cases, combinations of them and cycles."""

import json
import re
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.report.json import json_report
from trunnion.report.screen import screen
from trunnion.report.text import text_report
from trunnion.results.supports import card_forces, card_loads

DECK = """\
TITLE    A line with snubbers
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL STEEL  E=200GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P10    OD=273 WALL=9.3
OPERATE  T1=220 P1=12 TREF=20
ANCHOR   10
PIPE     10 20  DX=5000
PIPE     20 30  DX=5000
PIPE     30 40  DX=5000
BEND     40
PIPE     40 50  DX=3000 DZ=4000
PIPE     50 60  DX=3000 DZ=4000
SUPPORT  20     +Y GUIDE GAP=5
SUPPORT  30     +Y GUIDE FRICTION=RESULTANT
SUPPORT  50     +Y
SUPPORT  60     -X GAP=200
SNUBBER  30     X
SNUBBER  50     Z
CASE SUS = W + P1
CASE OPE = W + P1 + T1
CASE EQX = U(0.3,0,0) ABOUT=OPE
CASE EQY = U(0,1.3,0) ABOUT=OPE
CASE HSUS = W + P1 ON=OPE
CASE EQN = U(0.3,0,0) ABOUT=OPE NONLINEAR
COMB EXP = OPE - SUS
COMB EQ = SRSS(EQX,EQY)
COMB OCC = ABS(SUS) + EQ
COMB SUM = OPE + EQX
COMB ABSOPE = ABS(OPE)
CYCLE HEAT = OPE, SUS TIMES=2
"""


@pytest.fixture(scope="module")
def model():
    return read_text(DECK, "line.inp")


@pytest.fixture(scope="module")
def results(model):
    return trunnion.solve(model)


@pytest.fixture(scope="module")
def report(results):
    return json.loads(json_report(results))


@pytest.fixture(scope="module")
def text(results, model):
    return text_report(results, model).decode()


def entry(case: dict, name: str) -> dict:
    return next(s for s in case["supports"] if s["name"] == name)


def test_every_case_has_one_entry_a_card_snubbers_included(report):
    names = [[s["name"] for s in case["supports"]] for case in report["cases"].values()]
    assert "30 SNUBBER X" in names[0]
    assert all(own == names[0] for own in names)


def test_snubbers_are_free_in_static_cases_and_carry_when_locked(report):
    cases = report["cases"]
    for name in ("SUS", "OPE", "HSUS"):
        snubber = entry(cases[name], "30 SNUBBER X")
        assert snubber["state"] == "free"
        assert not np.any(snubber["force"] + snubber["moment"])
    locked = entry(cases["EQX"], "30 SNUBBER X")
    assert locked["state"] == "locked"
    assert abs(locked["force"][0]) > 1000.0
    assert locked["contacts"][0]["reaction"] == locked["force"][0]
    assert entry(cases["EQ"], "30 SNUBBER X")["state"] is None


def test_a_support_that_was_open_is_open_in_the_locked_case(report):
    assert entry(report["cases"]["OPE"], "60 -X")["state"] == "open"
    assert entry(report["cases"]["EQX"], "60 -X")["state"] == "open"


def test_what_breaks_the_frozen_state_is_listed_by_name_and_amount(report, results, text):
    found = {(b["name"], b["dir"], b["what"]): b for b in report["cases"]["EQY"]["frozen_check"]}
    broken = found["50 +Y", "+Y", "pulls"]
    total = card_forces(results["SUM"])  # OPE + EQX pushes; EQY at 1.3 g pulls
    rest = [card.name for card in results["OPE"].system.cards].index("50 +Y")
    assert total[rest, 1] > 0.0
    both = card_forces(results["OPE"])[rest, 1] + card_forces(results["EQY"])[rest, 1]
    assert broken["amount"] == pytest.approx(-both, rel=1e-9)
    assert broken["unit"] == "N"
    assert report["cases"]["EQX"]["frozen_check"] == []
    block = text[text.index("EQY: FROZEN CONTACT STATE") :]
    line = next(line for line in block.splitlines() if line.startswith("  50 +Y "))
    assert float(line.split()[-2]) == pytest.approx(1e-3 * broken["amount"], abs=1e-3)
    assert "EQX: FROZEN CONTACT STATE\n-------------------------\n  holds" in text


def test_a_sum_of_an_operating_and_a_locked_case(results):
    a, b, c = (results[name] for name in ("OPE", "EQX", "SUM"))
    assert np.allclose(card_forces(c), card_forces(a) + card_forces(b), rtol=0, atol=1e-9)
    assert np.allclose(c.state.u, a.state.u + b.state.u, rtol=0, atol=1e-15)
    assert c.linear


def test_size_of_a_card_force_is_that_of_normal_and_friction_together(results):
    force = card_forces(results["OPE"])
    assert np.array_equal(card_forces(results["ABSOPE"]), np.abs(force))


def test_local_forces_are_turned_before_their_size_is_taken(results):
    """50-60 stands askew: the size of its axial force is not made of sizes of global forces."""

    def axial(name):
        return np.array(results[name].elements["50-60"]["fx_local_to"])

    root = np.hypot(axial("EQX"), axial("EQY"))
    assert axial("EQ") == pytest.approx(root, rel=1e-12)


def test_sizes_are_positive_on_the_pipe_and_on_the_restraint(results):
    assert (card_loads(results["EQ"]) >= 0.0).all()
    assert (card_forces(results["EQ"]) >= 0.0).all()
    assert np.array_equal(card_loads(results["OPE"]), -card_forces(results["OPE"]))


def test_envelope_names_the_governing_cases(report, results):
    row = next(e for e in report["envelope"] if e["name"] == "30 SNUBBER X")
    every = {name: entry(case, "30 SNUBBER X") for name, case in report["cases"].items()}
    values = {name: s["force"][0] for name, s in every.items()}
    assert row["max"][0] == max(values.values())
    assert values[row["max_case"][0]] == row["max"][0]
    sizes = [-values[name] for name in ("EQ", "OCC", "ABSOPE")]  # act both ways
    assert row["min"][0] == min([*values.values(), *sizes])
    assert row["max_case"][1:] == [None] * 5
    assert results.envelope["30 Snubber X"] == results.envelope["30#2"]
    assert results.envelope["30#2"]["fx_max_case"] == row["max_case"][0]


def test_a_resultant_card_shows_the_normal_force_of_each_word_and_one_friction(results, text):
    block = text[text.index("OPE: SUPPORT STATES") :].split("\n\n")[0]
    rows = [line.split() for line in block.splitlines() if line.startswith("  30 ")]
    words = {row[1]: row for row in rows}
    rest, guide, both = (float(words[w][k]) for w, k in (("+Y", 6), ("GUIDE", 6), ("ALL", 5)))
    assert both == pytest.approx(np.hypot(rest, guide), rel=1e-3)
    assert words["+Y"][7] == "-"
    assert float(words["ALL"][6]) == pytest.approx(0.3 * both, rel=1e-3)
    assert words["X"][2] == "free"


def test_cycles_show_ranges_beside_the_one_shot_ones(report, results, text):
    found = report["cycles"]["HEAT"]
    assert found["steps"] == ["1 OPE", "1 SUS", "2 OPE", "2 SUS"]
    anchor = found["supports"][0]
    path = np.array(anchor["path"])
    assert anchor["range"] == pytest.approx(np.abs(path[2] - path[3]).tolist(), rel=1e-12)
    assert anchor["ratio"][0] == pytest.approx(anchor["range"][0] / anchor["one_shot"][0])
    table = results.cycles["HEAT"].support_ranges["10"]
    assert table["fx_ratio"] == anchor["ratio"][0]
    ends = results.cycles["HEAT"].element_ranges["10-20"]
    assert ends["fx_from_loop"] == pytest.approx(anchor["range"][0], rel=1e-9)
    assert "HEAT = OPE, SUS\n" in text
    assert "2 loops followed, the loop does not repeat" in text
    assert re.search(rf"RATIO +{anchor['ratio'][0]:.4f}", text)


def test_the_screen_warns_of_broken_states_and_open_loops(results, model):
    _, said = screen(results, model)
    assert "EQY: frozen contact state: " in said
    assert "CYCLE HEAT: " in said


def test_the_text_fits_the_page(text):
    assert max(map(len, text.splitlines())) <= 132
    assert not [line for line in text.splitlines() if line != line.rstrip()]
    assert not re.search(r"\bnan\b", text)


def test_every_key_is_documented(report):
    page = (Path(__file__).parents[2] / "docs" / "json_layout.md").read_text()
    known = {word for quoted in re.findall(r"`([^`]+)`", page) for word in quoted.split(".")}
    cycle = report["cycles"]["HEAT"]
    found = {*report, *report["cases"]["EQY"], *report["cases"]["EQY"]["frozen_check"][0]}
    found |= {*report["envelope"][0], *cycle, *cycle["supports"][0], *cycle["elements"][0]}
    assert found - known == set()


def test_hdf5_holds_what_a_case_has_of_its_own(results):
    h5py = pytest.importorskip("h5py")
    from trunnion.report.hdf5 import hdf5_report

    with h5py.File(BytesIO(hdf5_report(results)), "r") as file:
        assert len(file["model/snubbers/k"]) == 2
        assert "contacts" not in file["cases/OPE"]
        own = file["cases/EQX/contacts/k"]
        assert len(own) == len(file["cases/EQX/state/reaction"])
        assert file["cases/EQX/contacts/word"].asstr()[-2:].tolist() == ["X", "Z"]
        names = file["case_names"].asstr()[:]
        snubber = list(file["model/supports/name"].asstr()[:]).index("30 SNUBBER X")
        force = [file[f"cases/{name}/support_force"][snubber, 0] for name in names]
        assert file["envelope/max"][snubber, 0] == max(force)
        assert file["envelope/max_case"][snubber, 0] == int(np.argmax(force))
        assert file["cases/OPE/support_state"][snubber] == 4
        assert file["cases/EQX/support_state"][snubber] == 5
        assert file["cases/EQY/frozen_check/what"].asstr()[:].tolist().count("pulls") >= 1
        assert file["cycles/HEAT/path"].shape == (4, len(file["model/supports/id"]), 6)


def test_restraints_name_the_cases_that_are_increments(text):
    assert "\n  increments about another case, not totals: EQX, EQY, EQN\n" in text


def test_default_cases_show_what_breaks_the_frozen_state():
    deck = DECK[: DECK.index("CASE")] + "ACCELERATION U1 Y=1.3\n"
    model = read_text(deck, "line.inp")
    text = text_report(trunnion.solve(model), model).decode()
    assert "increments about another case, not totals: BY_U1\n" in text
    assert "BY_U1: FROZEN CONTACT STATE" in text
