"""The input echo shows what occasional loads and dynamics depend on."""

import json
import re
from pathlib import Path

import pytest

from trunnion.deck.reader import read_text
from trunnion.report.echo import input_echo
from trunnion.report.units import report_units
from trunnion.system import build_system

DECK = """\
UNITS    mm kN bar C
MATERIAL STEEL  E=200GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P10    OD=273 WALL=9.3
OPERATE  T1=100 P1=10
ANCHOR   10
PIPE     10 20  DX=5000
PIPE     20 30  DX=5000
SUPPORT  30 Y
SNUBBER  20 Z K=50kN/mm NAME=DAMPER
SNUBBER  30 (0,1,1)
SPECTRUM SSE Y=G TABLE=(0.5,0.1),(2.5,0.6),(9,0.6),(33,0.25)
SPECTRUM OBE X=PERIOD Y=M/S2 INTERP=LINEAR TABLE=(0.1,1),(1,5)
GROUP    NORTH = 10, 20
MODES    12 ABOUT=OPE FMAX=33
CASE OPE = W + P1 + T1
CASE SUS = W
CASE RS = SPECTRUM(SSE,X,1,NORTH) MODAL=CQC MISSING=ON ZPA=0.3
CYCLE HEAT = OPE, SUS TIMES=4
"""


@pytest.fixture(scope="module")
def echo():
    model = read_text(DECK, "x.inp")
    return input_echo(model, build_system(model), {}, report_units(model.units))


def part(echo: str, title: str) -> list[list[str]]:
    block = re.split(r"\n\n", echo[echo.index(f"\n{title}") + 1 :])[0]
    return [line.split() for line in block.splitlines()]


def test_snubbers_with_direction_and_stiffness(echo):
    rows = part(echo, "SNUBBERS")[-2:]
    assert rows[0] == ["20", "Z", "0.0000", "0.0000", "1.0000", "50.000", "9", "DAMPER"]
    assert rows[1] == ["30", "(0,1,1)", "0.0000", "0.7071", "0.7071", "-", "10"]


def test_spectra_by_frequency_and_period_in_two_units(echo):
    rows = part(echo, "RESPONSE SPECTRA")
    assert rows[5] == ["SSE", "log-log", "0.50000", "2.00000", "0.10000", "0.9807"]
    assert rows[-2] == ["OBE", "linear", "in", "period", "1.00000", "1.00000", "0.50986", "5.0000"]
    assert rows[-1][:2] == ["10.00000", "0.10000"]


def test_groups_modes_cycles_and_how_a_spectrum_case_combines(echo):
    assert "\n  NORTH = 10, 20\n" in echo
    assert "\n  12 FMAX=33 ABOUT=OPE MASS=LUMPED MESH=AUTO ROTARY=ON\n" in echo
    assert "\n  HEAT = OPE, SUS TIMES=4\n" in echo
    options = part(echo, "LOAD CASES")[-1]
    assert options[0] == "RS"
    assert {"MODAL=CQC", "DAMPING=0.02", "GROUPS=ABS", "MISSING=ON", "ZPA=0.3"} <= set(options)


def test_json_has_the_winds_with_their_model():
    from trunnion.cases.analysis import solve
    from trunnion.report.json import json_report

    model = read_text(
        "UNITS m N Pa C\nMATERIAL S E=2e11 DENSITY=7850\nSECTION P OD=0.2 WALL=0.01\nANCHOR 10\n"
        "PIPE 10 20 DY=4\nWIND WIND1 DIR=(1,0,0) PRESSURE=(0,500),(10,500) SHAPE=0.7\n"
        "CASE SUS = W\nCASE BLOW = WIND1 ABOUT=SUS\n",
        "wind.inp",
    )
    results = solve(model)
    found = json.loads(json_report(results, model))["winds"]["WIND1"]
    assert found["elements"][0]["load"] == pytest.approx([500 * 0.7 * 0.2, 0, 0])
    assert found["elements"][0]["pressure"] == 500
    assert found["asce7"] is None
    page = (Path(__file__).parents[2] / "docs" / "json_layout.md").read_text()
    assert all(f"`{key}`" in page for key in [*found, *found["elements"][0]])
    assert "winds" not in json.loads(json_report(results))
