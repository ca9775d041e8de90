"""The text report says what an engineer looks for, in the deck's units, on the page."""

import re
from dataclasses import replace

import numpy as np
import pytest

from trunnion.model import Units
from trunnion.report.columns import PAGE, numbers, plain, table, words
from trunnion.report.screen import screen
from trunnion.report.text import text_report
from trunnion.report.units import report_units


@pytest.fixture
def report(results, model):
    return text_report(results, model).decode()


def part(report: str, title: str) -> str:
    """One table, from its heading to the next."""
    return re.split(r"\n\n", report[report.index(f"\n{title}") + 1 :])[0]


def row(text: str, start: str) -> list[str]:
    return next(line for line in text.splitlines() if line.strip().startswith(start)).split()


def test_no_line_is_wider_than_the_page(report):
    assert max(map(len, report.splitlines())) <= PAGE
    assert report.isascii()


def test_lines_have_no_blanks_at_their_end(report):
    assert not [line for line in report.splitlines() if line != line.rstrip()]


def test_loads_on_restraints_have_the_trades_sign(report):
    heading = "EVERY RESTRAINT   forces and moments ON THE RESTRAINT"
    assert heading in report
    block = report[report.index("\n  30 +Y GUIDE   line 10") :]
    assert row(block, "OPE")[:5] == ["OPE", "slip", "0.000", "-9.000", "2.700"]
    assert row(block, "MAX")[:4] == ["MAX", "0.000", "-9.000", "5.400"]
    assert block.splitlines()[5].split() == ["-", "OPE", "TWO", "-", "-", "-"]
    assert row(block, "MIN")[:4] == ["MIN", "0.000", "-18.000", "2.700"]
    assert block.splitlines()[7].split() == ["-", "TWO", "OPE", "-", "-", "-"]


def test_displacements_are_in_mm_and_degrees(report):
    found = part(report, "OPE: DISPLACEMENTS")
    assert "[mm]" in found
    assert "[deg]" in found
    assert row(found, "30")[3] == "6.9797"


def test_states_show_how_much_friction_is_used(report):
    found = part(report, "OPE: SUPPORT STATES")
    assert row(found, "30     +Y")[1:9] == [
        "+Y", "slip", "-", "0.0000", "-", "9.0000", "2.7000", "1.0000",
    ]  # fmt: skip


def test_an_open_gap_shows_what_is_left_of_it(report):
    found = row(part(report, "OPE: SUPPORT STATES"), "30     GUIDE")
    assert found[2] == "open"
    assert float(found[3]) + float(found[4]) == pytest.approx(50.0, abs=1e-4)


def test_a_case_without_numbers_says_why(report):
    block = report[report.index("\nOFF = F1 + T1\n") : report.index("\nTWO = 2*OPE\n")]
    assert "NOT CONVERGED, no numbers: friction cycles at 30 +Y" in block
    assert "DISPLACEMENTS" not in block


def test_certificate_is_printed_with_its_places(report):
    found = part(report, "OPE: CERTIFICATE")
    assert "PASSED: worst 2.0e-15, friction at rest 30" in found
    assert row(found, "friction") == ["friction", "2.0e-15", "rest", "30"]


def test_gaps_and_friction_of_the_input_are_echoed(report):
    found = part(report, "SUPPORTS")
    assert row(found, "30     +Y")[5:7] == ["0.000", "free"]
    assert row(found, "30     GUIDE")[5:7] == ["50.000", "50.000"]


def test_same_results_give_the_same_bytes(results, model):
    assert text_report(results, model) == text_report(results, model)


def test_summary_fits_a_screen_whatever_the_number_of_cases(results, model):
    names = [f"C{i}" for i in range(60)]
    results.cases = {name: replace(results["OFF"], name=name) for name in names}
    good, text = screen(results, model)
    assert not good
    assert len(text.splitlines()) <= 24
    listed = sum(line.startswith("  C") and "NOT CONV" in line for line in text.splitlines())
    assert f"and {60 - listed} more cases" in text


def test_imperial_decks_are_answered_in_inches_and_psi():
    units = report_units(Units("ft", "lbf", "psi", "F"))
    assert units.movement.unit == "in"
    assert units.movement.text(0.0254) == "1.0000"
    assert units.stress.text(6894.757293168361) == "1"
    assert units.degrees(100.0) == pytest.approx(212.0, abs=1e-12)
    assert units.force.text(44.482216152605) == "10"


def test_small_answers_keep_their_digits():
    unit = report_units(Units("mm", "kN", "bar", "C")).movement
    assert unit.showing(1.2345678e-6).text(1.2345678e-6) == "0.0012346"


def test_numbers_that_outgrow_their_column_stay_whole_numbers_apart():
    text = table([plain("A", [1e30, -2.5], 3), plain("B", [-12345678.9, 0.0], 3)])
    assert [float(x) for x in text.splitlines()[-2].split()] == [1e30, -12345679]
    assert [float(x) for x in text.splitlines()[-1].split()] == [-2.5, 0.0]


def test_no_negative_zero_is_printed():
    assert "-0.000" not in table([plain("A", [-1e-9, -0.0], 3)])


def test_long_labels_are_cut_with_a_mark_before_a_line_leaves_the_page():
    unit = report_units(Units()).force
    columns = [words("FROM", ["A" * 32]), words("TO", ["B" * 32])]
    columns += [numbers("F", np.ones(1), unit, 14) for _ in range(6)]
    line = table(columns).splitlines()[-1]
    assert len(line) == PAGE
    assert "A~" in line
    assert "B~" in line
