"""Reports of response spectrum cases: sizes, in every table, alone and combined."""

import json
import re
from io import BytesIO

import numpy as np
import pytest

import trunnion
from trunnion.cases.spectrumcase import SpectrumPass
from trunnion.deck.reader import read_text
from trunnion.loads.masses import model_masses
from trunnion.report.hdf5 import hdf5_report
from trunnion.report.json import json_report
from trunnion.report.text import text_report
from trunnion.results.combine import combine
from trunnion.results.supports import card_forces, card_loads
from trunnion.solver.ledger import Ledger
from trunnion.solver.locked import frozen_system
from trunnion.solver.modal import modes_of

DECK = """\
TITLE    A skew line with a snubber
UNITS    mm kN bar C
MATERIAL STEEL  E=200GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P10    OD=273 WALL=9.3
OPERATE  T1=120 P1=12
ANCHOR   10
PIPE     10 20  DX=5000
PIPE     20 30  DX=3000 DZ=4000
SUPPORT  20     +Y
SUPPORT  30     +Y
SNUBBER  30     X
SPECTRUM SSE Y=G TABLE=(0.5,0.1),(2.5,0.6),(9,0.6),(33,0.25)
MODES    6 ABOUT=OPE
CASE SUS = W + P1
CASE OPE = W + P1 + T1
"""
DYNAMIC = """\
CASE RS = SPECTRUM(SSE,X) + SPECTRUM(SSE,Z,0.667)
COMB OCC = ABS(SUS) + RS
COMB UP = OPE + RS
"""


@pytest.fixture(scope="module")
def scene():
    """Model and results of a run with modes and a spectrum."""
    model = read_text(DECK + DYNAMIC, "skew.inp")
    cases, static = model.cases, read_text(DECK, "skew.inp")
    results = trunnion.solve(static)
    frozen, _ = frozen_system(results.system, results["OPE"].state, snubbers=True)
    masses = model_masses(model, results.system)
    results.modes, pencil = modes_of(frozen, masses, model.modal, Ledger())
    solver = SpectrumPass(model, frozen, results.modes, pencil)
    results.cases["RS"] = solver.solve(next(c for c in cases if c.name == "RS"))
    for comb in cases[-2:]:
        results.cases[comb.name] = combine(comb, results.cases)
    return model, results


@pytest.fixture(scope="module")
def report(scene):
    return json.loads(json_report(scene[1]))


def test_numbers_of_a_spectrum_case_are_sizes_without_states(report):
    case = report["cases"]["RS"]
    assert case["kind"] == "spectrum"
    assert case["converged"]
    assert "reactions" not in case
    for support in case["supports"]:
        assert support["state"] is None
        assert support["contacts"] == support["sliders"] == []
        assert min(support["force"] + support["moment"]) >= 0.0
        assert support["normal"] == pytest.approx(np.linalg.norm(support["force"]))
    for element in case["elements"]:
        assert min(element["force_to"] + element["local_to"] + element["local_from"]) >= 0.0
    snubber = next(s for s in case["supports"] if s["kind"] == "snubber")
    assert snubber["force"][0] > 0.0


def test_local_forces_are_no_turned_sizes(report):
    """20-30 stands askew: turned sizes of FX and FZ could cancel in the axial force."""
    element = report["cases"]["RS"]["elements"][1]
    fx, _, fz = element["force_to"][:3]
    axial, _, shear = element["local_to"][:3]
    assert axial != pytest.approx(0.6 * fx + 0.8 * fz, rel=1e-3)
    assert axial**2 + shear**2 == pytest.approx(fx**2 + fz**2, rel=1e-9)  # SRSS


def test_combined_with_a_case_that_has_states(scene):
    results = scene[1]
    sus, rs, occ, up = (results[name] for name in ("SUS", "RS", "OCC", "UP"))
    assert np.allclose(card_forces(occ), np.abs(card_forces(sus)) + card_forces(rs), atol=1e-9)
    assert np.array_equal(card_loads(rs), card_forces(rs))
    weight = card_forces(up)[:3, 1]  # OPE has no force along X: there the sum is a size
    assert np.array_equal(card_loads(up)[:3, 1], -weight)
    assert (weight > card_forces(rs)[:3, 1]).all()
    pressure = occ.stresses["10-20"]["pressure_from"]
    assert pressure == sus.stresses["10-20"]["pressure_from"] > 0.0
    bending = [results[name].stresses["10-20"]["bending_from"] for name in ("SUS", "RS", "OCC")]
    assert max(bending[:2]) < bending[2] <= sum(bending[:2]) * (1.0 + 1e-12)


def test_text_names_the_sizes_and_where_the_certificate_comes_from(scene):
    model, results = scene
    text = text_report(results, model).decode()
    assert max(map(len, text.splitlines())) <= 132
    assert not [line for line in text.splitlines() if line != line.rstrip()]
    assert re.search(r"sizes without sign, .*: RS, OCC", text)
    assert "inherited from the modes" in text
    assert "RS: SUPPORT STATES" not in text
    assert "6 ABOUT=OPE MASS=LUMPED" in text[text.index("\n5  MODES") :]


def test_envelope_takes_a_size_both_ways(scene, report):
    row = next(e for e in report["envelope"] if e["id"] == "30#2")
    assert row["max"][0] == -row["min"][0] > 0.0


def test_hdf5_has_no_states_of_a_spectrum(scene):
    h5py = pytest.importorskip("h5py")
    with h5py.File(BytesIO(hdf5_report(scene[1])), "r") as file:
        case = file["cases/RS"]
        assert case.attrs["kind"] == "spectrum"
        assert "support_state" not in case
        assert case["local_force"][()].min() >= 0.0
