"""docs/verification.md is what the tests of this folder found (it runs after all of them)."""

import os
from pathlib import Path

import pytest
from published import ROWS
from recordpage import page, read, stale

RECORD = Path(__file__).parents[2] / "docs" / "verification.md"


def test_record_is_what_the_tests_found(whole_folder):
    if os.environ.get("VERIFICATION_RECORD") == "write":
        assert whole_folder, "the record is made of all tests of the folder"
        RECORD.write_text(page(ROWS), encoding="utf-8")
    said = stale(RECORD.read_text(encoding="utf-8"), whole=whole_folder)
    assert not said, "\n".join(["run: make verification-record", *said])


def test_a_row_that_is_changed_is_named(monkeypatch):
    import recordpage
    from published import CLOSED, Row, Source

    bar = Source(CLOSED, "A bar", "", "Hooke.")
    rows = {bar: {"pull [N]": Row("pull [N]", "5.0", "5.002", "last digit")}}
    monkeypatch.setattr(recordpage, "ROWS", rows)
    text = page(rows)
    assert stale(text, whole=True) == []
    assert stale(text.replace("5.002", "5.001"), whole=True) == []  # the last digit shown
    assert "the test 5.0, 5.002" in stale(text.replace("5.002", "5.012"), whole=True)[0]
    assert "no test compares it" in stale(text + "| push [N] | 1 | 1 | = | 1 % |\n", whole=True)[0]
    assert stale(text + "| push [N] | 1 | 1 | = | 1 % |\n", whole=False) == []
    assert read(text)["A bar"] == {"pull [N]": ("5.0", "5.002", "last digit")}


@pytest.mark.parametrize(
    ("printed", "ours", "text"),
    [("18.3", 18.3142, "18.31"), ("26500", 26474.26, "26474.3"), ("0.0", 1e-17, "0"),
     ("5.52621e-6", 5.526214e-6, "5.526214e-06"), ("0.00784967", 0.00783967, "0.007839670")],
)  # fmt: skip
def test_ours_has_one_digit_more_than_the_print(printed, ours, text):
    from published import shown

    assert shown(ours, printed, 0.1) == text
