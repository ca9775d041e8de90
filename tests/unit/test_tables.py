"""Results by label."""

import sys

import numpy as np
import pandas
import pytest

from trunnion.library.names import UnknownName


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


def test_without_pandas_the_extra_is_named(results, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"pip install 'trunnion\[pandas\]'"):
        results["OPE"].displacements.to_pandas()
