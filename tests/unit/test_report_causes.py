"""Causes of what has no answer are told in the units of the deck; the JSON has newtons."""

import json

import pytest
from program import leave

from trunnion.model import Units
from trunnion.report.causes import in_units
from trunnion.report.units import report_units

SLIDES = """\
TITLE    Block that friction does not hold
UNITS    in lbf psi F
NODE     1  X=0 Y=0 Z=0
SUPPORT  1  +Y MU=0.1
SUPPORT  1  Z RX RY RZ
FORCE    1 F1 FX=11 FY=-100
CASE SLIDE = F1
"""

# 11 lbf against 0.1 * 100 lbf
NEEDS = "needs a friction force of 11 lbf to hold, its capacity mu N is 10 lbf"


def lbf():
    return report_units(Units("in", "lbf", "psi", "F"))


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("needs 4448.222 N, has 444.8222 N", "needs 1000 lbf, has 100 lbf"),
        ("stopped with 4.45e+03 N out of balance", "stopped with 1000.4 lbf out of balance"),
        ("bend 100N moves 5 N m at support 20 N/m", "bend 100N moves 5 N m at support 20 N/m"),
        ("128.0315 N against 128.0311 N", "28.78263 lbf against 28.78254 lbf"),
    ],
)
def test_forces_in_newtons_and_nothing_else_are_turned(said, shown):
    assert in_units(said, lbf()) == shown


def test_a_deck_in_newtons_has_the_text_of_the_solver():
    units = report_units(Units("mm", "N", "MPa", "C"))
    assert in_units("needs 128.0315 N", units) == "needs 128.0315 N"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("slides")
    (place / "a.inp").write_text(SLIDES)
    assert leave("run", place / "a.inp", "-o", place, "--csv", "--html", "--png") == 1
    return place


@pytest.mark.parametrize("file", ["a.out", "a.html", "a_csv/summary.csv", "a_csv/warnings.csv"])
def test_reports_tell_the_cause_in_the_units_of_the_deck(folder, file):
    text = " ".join((folder / file).read_text().split())
    assert NEEDS in text
    assert " 48.9" not in text  # 11 lbf are 48.93 N


def test_the_json_tells_the_cause_in_newtons(folder):
    cause = json.loads((folder / "a.json").read_text())["cases"]["SLIDE"]["cause"]
    assert "needs a friction force of 48.93044 N to hold" in cause


def test_screens_of_run_batch_and_study_tell_it_in_the_units_of_the_deck(folder, capsys):
    for words in (["run"], ["batch"], ["study", "--vary", "MU=0.1,0.05"]):
        assert leave(words[0], folder / "a.inp", "-o", folder, *words[1:]) == 1
        assert NEEDS in capsys.readouterr().out
