"""Results by label."""

import sys
from pathlib import Path

import numpy as np
import pandas
import pytest

import trunnion
from trunnion.library.names import UnknownName

MODELS = Path(__file__).parents[2] / "models"
KINDS = ("displacements", "supports", "elements", "stresses")


def test_rows_are_found_by_label(results):
    ope = results["OPE"]
    assert ope.displacements["30"]["uz"] == ope.state.u[2, 2]
    assert ope.supports["30"]["state"] == "slip"
    assert ope.supports["30 +Y guide"] == ope.supports["30"]
    assert ope.elements["20-30"]["from"] == "20"
    assert ope.elements["20-30"]["fz_to"] == ope.state.end_force[1, 1, 2]


def test_columns_are_arrays(results):
    table = results["OPE"].displacements
    assert table.column("uz") == pytest.approx(results["OPE"].state.u[:, 2], abs=0)
    assert list(table) == ["10", "20", "30"]
    assert len(table) == 3
    assert "30" in table
    assert "40" not in table


def test_bending_stress_is_moment_over_section_modulus(results):
    ope = results["OPE"]
    bore = 0.273 - 2 * 0.0093
    modulus = 3.141592653589793 / 32 * (0.273**4 - bore**4) / 0.273
    expected = ope.elements["10-20"]["my_from"] / modulus
    assert ope.stresses["10-20"]["bending_from"] == pytest.approx(expected, rel=1e-10)


def test_an_unknown_label_names_the_nearest(results):
    with pytest.raises(UnknownName, match="30"):
        results["OPE"].displacements["300"]


def test_a_case_without_numbers_says_so(results):
    with pytest.raises(ValueError, match="OFF has no numbers: friction cycles"):
        results["OFF"].displacements  # noqa: B018


def test_a_table_prints_in_columns(results):
    lines = str(results["OPE"].supports).splitlines()
    assert len({len(line) for line in lines}) == 1
    assert "slip" in lines[-1]


def test_a_table_becomes_a_data_frame(results):
    for table in (
        results["OPE"].displacements,
        results["OPE"].supports,
        results["OPE"].elements,
        results["OPE"].stresses,
        results.envelope,
    ):
        frame = table.to_pandas()
        assert list(frame.index) == list(table.labels)
        assert list(frame.columns) == [*table.words, *table.columns]
        assert np.array_equal(frame[list(table.columns)].to_numpy(), table.values)
        for name, column in table.words.items():
            found = [None if pandas.isna(cell) else cell for cell in frame[name]]
            assert found == list(column)
        assert frame.attrs["units"] == dict(zip(table.columns, table.units, strict=True))
    assert results["OPE"].supports.to_pandas().loc["30", "state"] == "slip"


def test_a_run_becomes_frames_with_the_cases_below_each_other(results):
    frames = results.to_pandas()
    good = [name for name in results.cases if name != "OFF"]
    for kind in KINDS:
        frame = frames[kind]
        assert frame.index.names == ["case", "label"]
        assert list(dict.fromkeys(frame.index.get_level_values("case"))) == good
        for name in good:
            table = getattr(results[name], kind)
            assert list(frame.loc[name].index) == list(table.labels)
            assert np.array_equal(frame.loc[name][list(table.columns)].to_numpy(), table.values)
        assert frame.attrs["units"] == dict(zip(table.columns, table.units, strict=True))
    assert frames["envelope"].equals(results.envelope.to_pandas())
    cases = frames["cases"]
    assert list(cases.index) == list(results.cases)
    assert list(cases["certified"]) == [name in good for name in results.cases]
    assert cases.loc["OFF", "cause"].startswith("friction cycles")
    assert frames.keys() == {
        "cases",
        "displacements",
        "supports",
        "elements",
        "stresses",
        "envelope",
    }


def test_frames_of_modes_and_cycles_are_there_where_a_deck_asks_for_them():
    cycle = trunnion.solve(trunnion.read(MODELS / "cycle_line.inp"))
    frames = cycle.to_pandas()
    ranges = frames["cycle_supports"].loc[("HEAT", "0")]
    assert ranges["fx_loop"] == cycle.cycles["HEAT"].supports[0, 0] > 0.0
    assert len(frames["cycle_elements"]) == len(cycle.system.parts)
    modal = trunnion.solve(trunnion.read(MODELS / "nr1677_v1_p1.inp"))
    frames = modal.to_pandas()
    assert np.array_equal(frames["modes"]["frequency"], modal.modes.frequency)
    assert set(frames["cases"]["certified"]) == {True}
    assert list(dict.fromkeys(frames["supports"].index.get_level_values(0))) == list(modal.cases)


def test_without_pandas_the_extra_is_named(results, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"pip install 'trunnion\[pandas\]'"):
        results["OPE"].displacements.to_pandas()
    with pytest.raises(ImportError, match=r"pip install 'trunnion\[pandas\]'"):
        results.to_pandas()
