"""Workbook and CSV, read back by other programs' libraries and compared with the JSON."""

import csv
import dataclasses
import json
from io import BytesIO, StringIO

import numpy as np
import openpyxl
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.origin import LeftOut, Origin
from trunnion.report import csv as csv_report
from trunnion.report import excel
from trunnion.report.json import json_report

LOADS, MOVES = ("FX", "FY", "FZ", "MX", "MY", "MZ"), ("DX", "DY", "DZ", "RX", "RY", "RZ")
DEGREES = 180.0 / np.pi
LINE = """\
TITLE    =1+1 is a title, not a formula
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
SECTION  P10    OD=273.1 WALL=9.27 FLUID=850
OPERATE  T1=170 P1=12 TREF=20
ANCHOR   10
PIPE     10 20  DX=6000
SUPPORT  20     +Y GUIDE GAP=3 NAME=@rest
PIPE     20 30  DX=6000
BEND     30     R=381
PIPE     30 40  DZ=4000
SUPPORT  40     +Y
PIPE     40 50  DZ=2000
HANGER   50     RATE=0.2 LOAD=3
CASE SUS = W + P1 + H
CASE OPE = W + P1 + T1 + H
COMB EXP = OPE - SUS
COMB BIG = ABS(OPE)
"""


@pytest.fixture(scope="module")
def solved():
    model = read_text(LINE, "line.inp")
    return model, trunnion.solve(model)


@pytest.fixture(scope="module")
def numbers(solved):
    model, results = solved
    return json.loads(json_report(results, model))["cases"]


def book_of(results, model):
    (content,) = excel.files(results, model, "line").values()
    return openpyxl.load_workbook(BytesIO(content))


@pytest.fixture(scope="module")
def book(solved):
    model, results = solved
    return book_of(results, model)


def rows_of(page):
    """Rows of a sheet as dictionaries by head; heads stand in row 4, units in row 5."""
    heads = [cell.value for cell in page[4]]
    found = page.iter_rows(min_row=6, values_only=True)
    return [dict(zip(heads, row, strict=True)) for row in found]


def units_of(page):
    return {head.value: unit.value for head, unit in zip(page[4], page[5], strict=True)}


def read_csv(files, name):
    return list(csv.DictReader(StringIO(files[f"line_csv/{name}.csv"].decode())))


def close(found, expected):
    """A workbook has 16 digits of a number, and the deck's unit costs one rounding."""
    assert abs(found - expected) <= 1e-15 * abs(expected)


def test_sheets_come_in_the_order_of_interest(book):
    assert book.sheetnames == [
        *("Summary", "Restraints", "Envelope", "Hangers", "Displacements", "Forces", "Stresses"),
        *("Certificate", "Warnings"),
    ]


def test_restraint_loads_of_all_cases_are_those_of_the_json_on_the_restraint(book, numbers):
    rows, units = rows_of(book["Restraints"]), units_of(book["Restraints"])
    assert [units[head] for head in LOADS] == ["kN"] * 3 + ["kN.m"] * 3
    assert len(rows) == 4 * 4  # cards and cases
    for row in rows:
        case = numbers[row["CASE"]]
        (card,) = [s for s in case["supports"] if s["node"] == row["NODE"]]
        sign = 1.0 if row["CASE"] == "BIG" else -1.0  # a size stays what it is
        for head, value in zip(LOADS, [*card["force"], *card["moment"]], strict=True):
            close(row[head], sign * value / 1e3)
        close(row["NORMAL"], card["normal"] / 1e3)
        close(row["FRICTION"], np.linalg.norm(card["friction"]) / 1e3)
        assert row["STATE"] == card["state"]
        states = {contact["dir"]: contact["state"] for contact in card["contacts"]}
        apart = row["DIRECTIONS"]
        assert (apart is None) == (len(set(states.values())) < 2)
        for part in apart.split(", ") if apart else []:
            state, *words = part.split(" ")
            assert words
            assert all(states.pop(word) == state for word in words)
        assert not (apart and states)
        for i in range(3):
            close(row[MOVES[i]], 1e3 * case["nodes"][row["NODE"]][i])


def test_displacements_are_those_of_the_json(book, numbers):
    rows, units = rows_of(book["Displacements"]), units_of(book["Displacements"])
    assert [units[head] for head in MOVES] == ["mm"] * 3 + ["deg"] * 3
    for name, case in numbers.items():
        found = {row["NODE"]: row for row in rows if row["CASE"] == name}
        assert {"10", "30N", "30F"} <= found.keys()
        assert ("30M" in found) == (name != "BIG")  # sizes have no middle
        for node, row in found.items():
            for head, value, factor in zip(
                MOVES, case["nodes"][node], [1e3] * 3 + [DEGREES] * 3, strict=True
            ):
                close(row[head], factor * value)


def test_element_forces_are_those_of_the_json(book, numbers):
    rows = rows_of(book["Forces"])
    local = ("AXIAL", "SHEAR y", "SHEAR z", "TORSION", "BENDING y", "BENDING z")
    count = 0
    for name, case in numbers.items():
        for element in case["elements"]:
            ends = [r for r in rows if (r["CASE"], r["ELEMENT"]) == (name, element["id"])]
            assert [r["AT"] for r in ends] == [element["from"], element["to"]]
            for row, end in zip(ends, ("from", "to"), strict=True):
                count += 1
                for heads, kind in ((LOADS, "force"), (local, "local")):
                    for head, value in zip(heads, element[f"{kind}_{end}"], strict=True):
                        close(row[head], value / 1e3)
    assert count == len(rows)


def test_stresses_are_those_of_the_json(book, numbers):
    rows = rows_of(book["Stresses"])
    assert units_of(book["Stresses"])["VON MISES"] == "MPa"
    heads = {
        "AXIAL": "axial",
        "HOOP": "hoop_inner",
        "S3": "principal_min",
        "VON MISES": "von_mises",
    }
    for name, case in numbers.items():
        for pipe in case["stresses"]:
            ends = [r for r in rows if (r["CASE"], r["ELEMENT"]) == (name, pipe["id"])][:2]
            for i, row in enumerate(ends):
                for head, key in heads.items():  # the JSON has 9 digits of stresses
                    assert row[head] == pytest.approx(pipe[key][i] / 1e6, rel=1e-8, abs=1e-12)


def test_extremes_name_their_cases(book):
    loads = [r for r in rows_of(book["Restraints"]) if r["NODE"] == "20"]
    top, low = (r for r in rows_of(book["Envelope"]) if r["NODE"] == "20")
    assert (top["EXTREME"], low["EXTREME"]) == ("MAX", "MIN")
    # BIG has sizes, which count both ways
    signed = [(r["FY"], r["CASE"]) for r in loads if r["CASE"] != "BIG"]
    sizes = [(s * r["FY"], "BIG") for r in loads if r["CASE"] == "BIG" for s in (1, -1)]
    assert top["FY"] == max(signed + sizes)[0]
    assert low["FY"] == min(signed + sizes)[0]
    assert (top["FY"], top["CASE FY"]) in signed + sizes
    assert low["CASE FY"] in {case for value, case in signed + sizes if value == low["FY"]}


def test_hangers_have_load_and_travel(book, numbers):
    rows = rows_of(book["Hangers"])
    assert [row["CASE"] for row in rows] == ["SUS", "OPE"]
    for row in rows:
        card = next(s for s in numbers[row["CASE"]]["supports"] if s["node"] == "50")
        assert row["LOAD"] == pytest.approx(card["force"][1] / 1e3, rel=1e-14)
        # rate 0.2 kN/mm: what the hanger gives up is rate times travel
        assert row["COLD LOAD"] - row["LOAD"] == pytest.approx(0.2 * row["TRAVEL UP"], rel=1e-9)


def test_the_certificate_is_that_of_the_json(book, numbers):
    rows = rows_of(book["Certificate"])
    for name in ("SUS", "OPE"):
        items = numbers[name]["certificate"]["items"]
        found = [(r["ITEM"], r["VALUE"]) for r in rows if r["CASE"] == name]
        assert [name for name, _ in found] == [item["name"] for item in items]
        for (_, value), item in zip(found, items, strict=True):
            close(value, item["value"])


def test_a_case_that_did_not_converge_has_its_cause_and_no_numbers(results, model):
    book = book_of(results, model)
    summary = {row["CASE"]: row for row in rows_of(book["Summary"])}
    assert summary["OFF"]["STATUS"] == "NOT CONVERGED"
    assert summary["OFF"]["CAUSE"] == "friction cycles at 30 +Y"
    assert summary["OFF"]["LARGEST MOVE"] is None
    for name in ("Restraints", "Displacements", "Forces", "Stresses"):
        assert {row["CASE"] for row in rows_of(book[name])} == {"OPE", "TWO"}
    texts = [row["WARNING"] for row in rows_of(book["Warnings"])]
    assert texts[:2] == ["OFF: friction cycles at 30 +Y", "OPE: 30 GUIDE is close"]


def test_heads_and_units_stay_in_view_and_rows_are_filtered(book):
    for page in book:
        assert page.freeze_panes[1:] == "6"
        last = f"{openpyxl.utils.get_column_letter(page.max_column)}{max(page.max_row, 6)}"
        assert page.auto_filter.ref == f"A5:{last}"
        assert page.print_title_rows == "$4:$5"
    assert book["Restraints"].freeze_panes == "D6"


def test_every_cell_fits_its_column(book):
    for page in book:
        for i, column in enumerate(page.iter_cols(min_row=4), 1):
            width = page.column_dimensions[openpyxl.utils.get_column_letter(i)].width
            for cell in column:
                text = cell.value
                if isinstance(text, float):
                    places = len(cell.number_format.partition(".")[2])
                    text = f"{text:.1E}" if "E" in cell.number_format else f"{text:,.{places}f}"
                assert len(str(text or "")) < width or width > excel.WIDEST, (page.title, text)


def test_numbers_have_formats_and_what_rounds_to_nothing_is_a_plain_zero(book):
    page = book["Restraints"]
    column = [cell.value for cell in page[4]].index("FX") + 1
    shown = {cell.value: cell.number_format for (cell,) in page.iter_rows(6, None, column, column)}
    assert set(shown.values()) == {"0", "#,##0.000"}  # at least five digits of 5 kN
    assert all((form == "0") == (abs(value) <= 5e-4) for value, form in shown.items())


def test_text_is_no_formula(book):
    page = book["Restraints"]
    assert page["A1"].value == "=1+1 is a title, not a formula: Restraint loads"
    assert page["A1"].data_type == "s"
    names = {cell.value: cell.data_type for cell in page["A"][5:]}
    assert names["@rest"] == "s"
    assert all(cell.data_type != "f" for sheet in book for row in sheet.rows for cell in row)


def test_the_same_results_give_the_same_workbook_later(solved, monkeypatch):
    model, results = solved
    first = excel.files(results, model, "line")
    monkeypatch.setattr("time.time", lambda: 4e9)
    monkeypatch.setattr("time.localtime", lambda *_: (2040, 1, 2, 3, 4, 5, 6, 7, 0))
    assert excel.files(results, model, "line") == first


def test_what_is_too_long_for_one_sheet_goes_on_in_the_next(solved, book, monkeypatch):
    model, results = solved
    monkeypatch.setattr(excel, "MOST_ROWS", 20)
    monkeypatch.setattr(excel, "BIG", 100)  # and rows leave the memory as they are written
    cut = book_of(results, model)
    parts = [page for page in cut if page.title.startswith("Forces")]
    assert [page.title for page in parts] == [f"Forces {i + 1}" for i in range(len(parts))]
    assert len(parts) > 1
    assert [row for page in parts for row in rows_of(page)] == rows_of(book["Forces"])
    assert all(page.row_dimensions[1].height == 21 for page in cut)


def test_csv_has_the_same_tables_with_all_digits(solved, book):
    model, results = solved
    files = csv_report.files(results, model, "line")
    assert [f"line_csv/{name.lower()}.csv" for name in book.sheetnames] == list(files)
    for page in book:
        units = units_of(page)
        heads = [f"{head} [{unit}]" if unit else head for head, unit in units.items()]
        plain = read_csv(files, page.title.lower())
        assert len(plain) == page.max_row - 5 or page.max_row == 5
        for row, same in zip(plain, rows_of(page), strict=False):
            assert list(row) == heads
            for text, value in zip(row.values(), same.values(), strict=True):
                if isinstance(value, int | float):
                    close(value, float(text))
                else:
                    assert text.removeprefix("'") == ("" if value is None else str(value))


@pytest.mark.parametrize("text", ["=1+1", "+Y", "-W", "@rest", "\t=1"])
def test_text_of_a_deck_is_no_formula_in_csv_and_numbers_stay_numbers(text):
    rows = [[text, f"a{text}", -1.5, -3, None]]
    assert list(csv.reader(StringIO(csv_report.csv_bytes(rows).decode()))) == [
        [f"'{text}", f"a{text}", "-1.5", "-3", ""]
    ]


def test_a_case_that_begins_with_a_minus_is_no_formula_in_csv(solved):
    model, results = solved
    results["OPE"].text, kept = "-W", results["OPE"].text
    try:
        summary = read_csv(csv_report.files(results, model, "line"), "summary")
    finally:
        results["OPE"].text = kept
    assert next(row for row in summary if row["CASE"] == "OPE")["LOADS"] == "'-W"


def test_other_units_stand_above_the_numbers(solved):
    text = LINE.replace("mm kN bar C", "in lbf psi F").replace("DX=6000", "DX=240")
    text = text.replace("DZ=4000", "DZ=160").replace("DZ=2000", "DZ=80").replace("R=381", "R=15")
    text = text.replace("273.1", "10.75").replace("9.27", "0.365").replace("203GPa", "29.4e6psi")
    text = text.replace("GAP=3", "GAP=0.12").replace("DENSITY=7850", "DENSITY=490")
    model = read_text(text.replace("FLUID=850", "FLUID=53").replace("RATE=0.2 LOAD=3", "LOAD=600"))
    book = book_of(trunnion.solve(model), model)
    assert units_of(book["Restraints"])["MX"] == "lbf.in"
    assert units_of(book["Stresses"])["AXIAL"] == "psi"
    assert book["Summary"].page_setup.paperSize in (1, "1")  # letter


def test_what_a_foreign_file_left_out_stands_first_among_the_warnings(results, model):
    left = LeftOut("node 30", "a clamp is left out", "line.cii:12")
    made = dataclasses.replace(model, origin=Origin("line.cii", "CAESAR II neutral file", (left,)))
    texts = [row["WARNING"] for row in rows_of(book_of(results, made)["Warnings"])]
    assert texts[:2] == [
        "from line.cii, CAESAR II neutral file",
        "LEFT OUT: node 30: a clamp is left out (line.cii:12)",
    ]


# ------------------------------------------------------------------ cycles and other answers
LOOP = LINE.replace("COMB BIG = ABS(OPE)\n", "CYCLE HEAT = OPE, SUS TIMES=2\n")


@pytest.fixture(scope="module")
def looped():
    model = read_text(LOOP, "line.inp")
    return model, trunnion.solve(model, spread=2)


def test_cycles_and_other_answers_have_sheets_where_there_are_any(looped, book):
    found = book_of(looped[1], looped[0]).sheetnames
    own = ["Cycles", "Cycle forces", "Spread tries", "Spread", "Spread forces"]
    assert [name for name in found if name in own] == own
    assert not set(own) & set(book.sheetnames)


def test_loads_and_ranges_of_a_cycle_are_those_of_the_json(looped):
    model, results = looped
    rows = rows_of(book_of(results, model)["Cycles"])
    stored = json.loads(json_report(results, model))["cycles"]["HEAT"]
    assert len(rows) == 4 * (4 + 2)  # cards, steps and ranges
    for card in stored["supports"]:
        own = {row["AFTER"]: row for row in rows if row["NODE"] == card["id"]}
        for step, load in zip(stored["steps"], card["path"], strict=True):
            for head, value in zip(LOADS, load, strict=True):
                close(own[step][head], -value / 1e3)
        for name, key in (("RANGE, LOOP", "range"), ("RANGE, ONE SHOT", "one_shot")):
            for head, value in zip(LOADS, card[key], strict=True):
                close(own[name][head], value / 1e3)
        shown = [own["RANGE, LOOP"][f"RATIO {head}"] for head in LOADS]
        for found, expected in zip(shown, card["ratio"], strict=True):
            assert (found is None) == (expected is None)
            close(found or 0.0, expected or 0.0)
    assert any(card["ratio"][0] for card in stored["supports"])


def test_ranges_of_end_forces_over_a_cycle_are_those_of_the_json(looped):
    model, results = looped
    rows = read_csv(csv_report.files(results, model, "line"), "cycle_forces")
    stored = json.loads(json_report(results, model))["cycles"]["HEAT"]["elements"]
    assert len(rows) == 4 * len(stored)
    for element in stored:
        own = [row for row in rows if row["ELEMENT"] == element["id"]]
        keys = ("range_from", "one_shot_from", "range_to", "one_shot_to")
        for row, key in zip(own, keys, strict=True):
            for head, unit, value in zip(
                LOADS, ["kN"] * 3 + ["kN.m"] * 3, element[key], strict=True
            ):
                close(float(row[f"{head} [{unit}]"]), value / 1e3)


def test_spread_of_other_answers_is_that_of_the_json(looped):
    model, results = looped
    files = csv_report.files(results, model, "line")
    stored = json.loads(json_report(results, model))["spread"]["OPE"]
    rows = read_csv(files, "spread")
    for kind in ("starts", "orders"):
        for card in stored[kind]["supports"]:
            (row,) = [
                r for r in rows
                if (r["CASE"], r["OTHER"], r["NODE"]) == ("OPE", kind.upper(), card["id"])
            ]  # fmt: skip
            for head, value in zip(LOADS[:3], card["spread"][:3], strict=True):
                close(float(row[f"{head} [kN]"]), value / 1e3)
    tries = [r for r in read_csv(files, "spread_tries") if r["CASE"] == "OPE"]
    assert len(tries) == len(stored["starts"]["tried"]) + len(stored["orders"]["tried"])
    assert [r["ANSWER"] for r in tries][:2] == ["1", "1"]
