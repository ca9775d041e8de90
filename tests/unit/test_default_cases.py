"""Cases of a model that names none."""

import pytest

import trunnion
from trunnion.cases.default_cases import default_cases, with_cases
from trunnion.deck.expressions import format_case, parse
from trunnion.deck.reader import read_text
from trunnion.model import Comb
from trunnion.report import write_reports

TOP = """\
MATERIAL A E=203e9 ALPHA=11.7e-6 DENSITY=7850
SECTION S OD=0.2731 WALL=0.00927
"""
LINE = """\
ANCHOR 10
PIPE 10 20 DX=6
SUPPORT 20 +Y MU=0.3
"""


def said(text):
    """Default cases of a deck, as their cards would say them."""
    found = {}
    for case in default_cases(read_text(TOP + text + LINE)):
        if isinstance(case, Comb):
            assert parse(case.text) == case.expression
            found[case.name] = case.text
        else:
            about = f" ABOUT={case.about}" if case.about else ""
            found[case.name] = format_case(case) + about
    return found


def test_cold_empty_line_has_its_weight_alone():
    assert said("") == {"SUS": "W"}


def test_pressure_alone_needs_no_operating_case():
    assert said("OPERATE P1=1e6\n") == {"SUS": "W + P1"}


def test_one_set_of_temperatures_is_ope():
    assert said("OPERATE T1=100 P1=1e6\n") == {
        "SUS": "W + P1",
        "OPE": "W + P1 + T1",
        "EXP": "OPE - SUS",
    }


def test_every_set_has_its_ope_and_exp():
    assert said("OPERATE T1=100 P1=1e6 T2=60 P3=2e6\nDISPLACEMENT 10 D2 DX=0.01\n") == {
        "SUS": "W + P1",
        "OPE1": "W + P1 + T1",
        "OPE2": "W + P1 + T2 + D2",
        "OPE3": "W + P3",
        "EXP1": "OPE1 - SUS",
        "EXP2": "OPE2 - SUS",
        "EXP3": "OPE3 - SUS",
    }


def test_hangers_and_forces_of_set_1_are_sustained():
    assert said("OPERATE T1=100\nHANGER 20 LOAD=100\nFORCE 20 F1 FY=-5\n") == {
        "SUS": "W + H + F1",
        "OPE": "W + H + T1 + F1",
        "EXP": "OPE - SUS",
    }


def test_occasional_loads_act_one_at_a_time_about_the_first_ope():
    more = "ACCELERATION U2 X=0.3\nWIND WIND1 DIR=(0,0,1) ASCE7=40\nSNOW 100\nFORCE 20 F3 FX=1\n"
    found = said("OPERATE T1=100 T2=50\n" + more)
    assert found["BY_U2"] == "U2 ABOUT=OPE1"
    assert found["BY_WIND1"] == "WIND1 ABOUT=OPE1"
    assert found["BY_S"] == "S ABOUT=OPE1"
    assert found["BY_F3"] == "F3 ABOUT=OPE1"
    assert found["OCC"] == "ABS(SUS) + MAX(BY_U2,BY_WIND1,BY_S,BY_F3)"
    assert said(more)["BY_U2"] == "U2 ABOUT=SUS"


def test_a_model_with_cases_is_left_alone():
    model = read_text(TOP + LINE + "CASE A = W")
    assert with_cases(model) is model


def test_names_of_default_cases_may_be_used():
    deck = TOP + "OPERATE T1=100\n" + LINE
    read_text(deck + "MODES 3 ABOUT=OPE\nCYCLE HEAT = OPE, SUS TIMES=3")
    with pytest.raises(trunnion.DeckError, match="case OPE2 is not defined; nearest: OPE"):
        read_text(deck + "MODES 3 ABOUT=OPE2")


def test_solved_and_marked_in_the_report_but_not_written_in_a_deck(tmp_path):
    model = read_text(TOP + "OPERATE T1=100\nACCELERATION U1 Z=0.3\n" + LINE)
    results = trunnion.solve(model)
    assert list(results.cases) == ["SUS", "OPE", "EXP", "BY_U1", "OCC"]
    assert all(case.converged for case in results.cases.values())
    write_reports(results, model, tmp_path, "a")
    assert "LOAD CASES   default: the deck names none" in (tmp_path / "a.out").read_text()
    assert "CASE" not in model.deck()


FREE = TOP + "PIPE 10 20 DX=6\nMODES 8\n"


def test_a_free_pipe_has_modes_and_no_default_cases(tmp_path):
    model = read_text(FREE)
    results = trunnion.solve(model)
    assert not results.cases
    assert results.modes.rigid == 6
    assert results.modes.frequency[6] > 1.0
    assert "moves freely" in results.warnings[0]
    out, _ = write_reports(results, model, tmp_path, "free")
    assert "no cases" in out.read_text()


@pytest.mark.parametrize("more", ["CASE A = W\n", "MODES"])
def test_a_free_pipe_with_a_case_or_without_modes_is_refused(more):
    deck = FREE.replace("MODES 8\n", "") if more == "MODES" else FREE + more
    with pytest.raises(trunnion.ModelError, match="moves freely"):
        trunnion.solve(read_text(deck))
