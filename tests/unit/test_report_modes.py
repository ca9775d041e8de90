"""Natural modes in every report: a pinned pipe whose modes are known, and a free one."""

import json
import re
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.arrays import no_contacts
from trunnion.deck.reader import read_text
from trunnion.loads.masses import model_masses
from trunnion.model import Modes
from trunnion.report.json import json_report
from trunnion.report.screen import screen
from trunnion.report.text import text_report
from trunnion.solver.ledger import Ledger
from trunnion.solver.modal import modes_of

DECK = """\
TITLE    A pinned pipe
UNITS    m N Pa C
DEFAULT  SHEAR=OFF
MATERIAL S E=200GPa NU=0.3 DENSITY=7800
SECTION  P OD=0.08 WALL=0.008
SUPPORT  10 X Y Z RX
PIPE     10 20 DX=2.5
PIPE     20 30 DX=2.5
SUPPORT  30 Y Z
CASE SUS = W
"""


@pytest.fixture(scope="module")
def model():
    return read_text(DECK, "pipe.inp")


@pytest.fixture(scope="module")
def results(model):
    found = trunnion.solve(model)
    system = found.system
    card = Modes(6, fmax=60.0)
    found.modes, _ = modes_of(system, model_masses(model, system), card, Ledger())
    return found


@pytest.fixture(scope="module")
def free(model, results):
    system = replace(results.system, contacts=no_contacts())
    found = replace(results)
    found.modes, _ = modes_of(system, model_masses(model, system), Modes(8, mesh="NONE"), Ledger())
    return found


def test_json_has_what_a_mode_table_has(results):
    found = json.loads(json_report(results))["modes"]
    f = np.array(found["frequency_hz"])
    assert f[0] == pytest.approx(f[1], rel=1e-9)  # both planes
    ei, masses = results.system.rigidity[0, 2], results.modes.total_mass[0] / 5.0
    assert f[0] == pytest.approx(np.pi / 50.0 * np.sqrt(ei / masses), rel=1e-3)
    assert np.multiply(found["period_s"], f) == pytest.approx(1.0, rel=1e-12)
    assert np.square(found["participation"]) == pytest.approx(
        np.array(found["effective_mass"]), rel=1e-12, abs=1e-12
    )
    total = np.array(found["total_mass"])
    share = 100.0 * np.array(found["effective_mass"]) / total
    assert np.array(found["effective_mass_percent"]) == pytest.approx(share, rel=1e-12)
    assert found["effective_mass_sum_percent"] == pytest.approx(share.sum(axis=0).tolist())
    assert found["proven"]
    assert found["counted_hz"] > f[-1]
    assert found["added_nodes"] > 0
    assert set(found["shapes"][0]) == {"10", "20", "30"}  # the model's own nodes


def test_text_shows_the_table_its_proof_and_shapes(results, model):
    text = text_report(results, model).decode()
    assert max(map(len, text.splitlines())) <= 132
    assert not [line for line in text.splitlines() if line != line.rstrip()]
    block = text[text.index("\n5  MODES") :]
    rows = [line.split() for line in block.splitlines()]
    first = next(row for row in rows if row[:1] == ["1"])
    f = results.modes.frequency
    assert float(first[1]) == pytest.approx(f[0], abs=5e-6)
    assert float(first[2]) == pytest.approx(1.0 / f[0], abs=5e-7)
    last = next(row for row in rows if row[:1] == [str(len(f))])
    share = 100.0 * results.modes.effective_mass.sum(axis=0) / results.modes.total_mass
    assert [float(x) for x in last[9:12]] == pytest.approx(share.tolist(), abs=1e-3)
    assert "a Sturm count" in block
    assert f"nodes added where spans are long for the cut-off: {results.modes.added}" in block
    shape = block[block.index("MODE 1: SHAPE") :].split("\n\n")[0]
    middle = next(line.split() for line in shape.splitlines() if line.startswith("  20"))
    assert np.hypot(float(middle[2]), float(middle[3])) == pytest.approx(1.0, abs=1e-4)


def test_rigid_modes_have_no_period_and_are_warned_of(free, model):
    found = json.loads(json_report(free))["modes"]
    assert found["rigid"] == 6
    assert found["period_s"][:6] == [None] * 6
    text = text_report(free, model).decode()
    assert "modes without stiffness (rigid bodies): 6" in text
    assert "MODES: 6 of 0 Hz" in text
    assert "nan" not in text
    assert "MODES: 6 of 0 Hz" in screen(free, model)[1]


def test_a_missing_proof_is_said_everywhere(results, model):
    doubtful = replace(results)
    doubtful.modes = replace(results.modes, proven=False, counted=0.0)
    text = text_report(doubtful, model).decode()
    assert "NOT PROVEN" in text
    assert "not proven" in screen(doubtful, model)[1]
    assert json.loads(json_report(doubtful))["modes"]["proven"] is False


def test_the_screen_has_one_line_of_them(results, model):
    line = next(line for line in screen(results, model)[1].splitlines() if "modes: " in line)
    assert f"{results.modes.frequency[0]:.4g}" in line


def test_table_by_number(results):
    row = results.modes.table["1"]
    assert row["frequency"] == results.modes.frequency[0]
    assert row["percent_y"] + row["percent_z"] == pytest.approx(
        100.0 * results.modes.effective_mass[0, 1:].sum() / results.modes.total_mass[1]
    )


def test_hdf5_holds_the_shapes_of_all_nodes(results):
    h5py = pytest.importorskip("h5py")
    from trunnion.report.hdf5 import hdf5_report

    with h5py.File(BytesIO(hdf5_report(results)), "r") as file:
        modes = file["modes"]
        assert modes["shape"].shape == (len(results.modes.frequency), len(modes["node"]), 6)
        assert np.array_equal(modes["frequency"][:], results.modes.frequency)
        assert bool(modes.attrs["proven"])


def test_every_key_is_documented(results):
    page = (Path(__file__).parents[2] / "docs" / "json_layout.md").read_text()
    known = {word for quoted in re.findall(r"`([^`]+)`", page) for word in quoted.split(".")}
    assert set(json.loads(json_report(results))["modes"]) - known == set()


def test_shapes_turn_in_the_deck_s_unit_of_length(results, model):
    def first_turn(length):
        units = replace(model.units, length=length)
        text = text_report(results, replace(model, units=units)).decode()
        shape = text[text.index("MODE 1: SHAPE") :].split("\n\n")[0]
        assert f"[rad/{length}]" in shape
        row = next(line.split() for line in shape.splitlines() if line.startswith("  10 "))
        return float(np.hypot(float(row[5]), float(row[6])))

    assert first_turn("in") == pytest.approx(0.0254 * first_turn("m"), abs=2e-6)


def test_a_deck_without_modes_has_no_frequencies(results):
    static = replace(results, modes=None)
    assert json.loads(json_report(static))["modes"] == {"frequency_hz": []}
