"""The HDF5 report is whole: the certificate can be judged again from it."""

import re
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

import trunnion

h5py = pytest.importorskip("h5py")

from trunnion.origin import Assumption, LeftOut, Origin  # noqa: E402
from trunnion.report.hdf5 import hdf5_report  # noqa: E402

ROOT = Path(__file__).parents[2]


@pytest.fixture
def file(results):
    with h5py.File(BytesIO(hdf5_report(results)), "r") as file:
        yield file


def test_arrays_of_the_state_come_back_exactly(file, scene):
    _, system, loads, state = scene
    for name in state.__slots__:
        assert np.array_equal(file[f"cases/OPE/state/{name}"][()], getattr(state, name))
    assert np.array_equal(file["cases/OPE/loads/nodal"][()], loads.nodal)
    assert np.array_equal(file["model/contacts/gap"][()], system.contacts.gap)


def test_labels_and_names_are_text(file):
    assert list(file["model/nodes/label"].asstr()[:]) == ["10", "20", "30"]
    assert list(file["case_names"].asstr()[:]) == ["OPE", "OFF", "TWO"]
    assert list(file["model/supports/name"].asstr()[:]) == ["10 ANCHOR", "30 +Y GUIDE"]


def test_a_case_that_did_not_converge_has_no_numbers(file):
    case = file["cases/OFF"]
    assert case.attrs["cause"] == "friction cycles at 30 +Y"
    assert "state" not in case
    assert "support_force" not in case


def test_what_a_foreign_file_lost_is_said_in_it(results):
    lost = LeftOut("node 30", "a clamp is left out", "line.cii:12")
    origin = Origin("line.cii", "CAESAR II neutral file", (lost,), (Assumption("cold at 21 C"),))
    with h5py.File(BytesIO(hdf5_report(results, origin)), "r") as file:
        assert list(file["left_out"].asstr()[:]) == ["node 30: a clamp is left out (line.cii:12)"]
        assert list(file["assumed"].asstr()[:]) == ["cold at 21 C"]


@pytest.mark.parametrize("deck", ["wind_crossing", "snubber_line", "cycle_line", "nr1677_v2_p1"])
def test_every_place_of_a_file_is_documented(deck):
    results = trunnion.solve(trunnion.read(ROOT / "models" / f"{deck}.inp"))
    text = (ROOT / "docs" / "hdf5_layout.md").read_text()
    known = set(re.findall(r"`/?([^`]+)`", text))
    known |= {word for place in known for word in place.split("/")}
    places: set[str] = set()
    with h5py.File(BytesIO(hdf5_report(results)), "r") as file:
        file.visititems(lambda name, item: places.update([name], item.attrs))
        own = {name for group in ("cases", "cycles") for name in file[group]}
    # attributes of these two are counts and amounts by name
    places -= {key for case in results.cases.values() for key in (*case.work, *case.penalty_effect)}
    assert {place.split("/")[-1] for place in places} - known - own - {"words"} == set()


def test_same_results_give_the_same_bytes_later(results, monkeypatch):
    first = hdf5_report(results)
    monkeypatch.setattr("time.time", lambda: 4e9)
    assert hdf5_report(results) == first
