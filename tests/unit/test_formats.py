"""Files of other programs: which format, what is refused, what the reports and the deck show.

A toy format stands for the real ones: a line "LENGTH millimetres", and "ODD thing" that no model
can represent.
"""

import json
import os
import sys
import types
from pathlib import Path

import pytest
from program import leave

import trunnion
from trunnion.commands import shared
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError
from trunnion.formats import FORMATS, Format, read_any
from trunnion.formats.source import source_of
from trunnion.model import Material, Model, Operation, Pipe, Section, Support, Units

SAMPLES = Path(__file__).parents[2] / "models" / "foreign"
GOOD = "TOY 1\nLENGTH 6000\n"
ODD = "TOY 1\nLENGTH 6000\nODD bellows\nODD nozzle\n"


def read_toy(source, findings):
    """Read the toy format."""
    model = Model(title="Toy", units=Units("mm", "kN", "bar", "C"))
    model.materials["S"] = Material("S", 203e9, density=7850.0, place=findings.place(1))
    model.sections["P"] = Section("P", 0.2731, 0.00927, place=findings.place(1))
    model.supports.append(Support("10", "anchor", place=findings.place(1)))
    for number, line in enumerate(source.lines[1:], 2):
        word, value = line.split()
        if word == "LENGTH":
            delta = (float(value) / 1e3, 0.0, 0.0)
            place = findings.place(number)
            pipe = Pipe("10", "20", delta, "P", "S", Operation(), place=place)
            findings.note(pipe, f"line {number} & all \x07of it")
            model.pipes.append(pipe)
        elif word == "LOOSE":
            model.supports.clear()
        else:
            findings.leave_out(number, "element 10-20", f"{value}; taken as pipe")
    findings.assume("no load cases in the file: the default ones")
    return findings.finish(model, "toy, version 1", ("Titles of the toy",))


@pytest.fixture(autouse=True)
def toy(monkeypatch):
    module = types.ModuleType("trunnion_toy")
    module.read = read_toy
    monkeypatch.setitem(sys.modules, "trunnion_toy", module)
    monkeypatch.setitem(FORMATS, ".toy", Format("toy", "trunnion_toy", r"TOY\b"))
    monkeypatch.setattr(shared, "FOREIGN", (*shared.FOREIGN, ".toy"))


@pytest.fixture
def home(tmp_path, monkeypatch):
    (tmp_path / "a.toy").write_text(GOOD)
    (tmp_path / "odd.toy").write_text(ODD)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_every_suffix_of_a_format_is_known_to_the_commands():
    assert sorted(FORMATS) == sorted(shared.FOREIGN)


def test_a_deck_has_comments_and_reads_back_to_the_same_model(home):
    imported = read_any("a.toy")
    text = imported.deck()
    lines = text.splitlines()
    assert lines[0] == "! Made from a.toy: toy, version 1"
    assert "! Titles of the toy" in lines
    comment = lines.index("! line 2 & all  of it")
    assert lines[comment + 1] == "PIPE     10 20 DX=6000"
    again = read_text(text)
    assert again == imported.model
    assert again.deck() == imported.model.deck()


def test_what_cannot_be_represented_is_an_error_that_names_everything(home, capsys):
    assert leave("run", "odd.toy") == 2
    err = capsys.readouterr().err
    assert "odd.toy:3: element 10-20: bellows; taken as pipe; --permissive" in err
    assert "odd.toy:4: element 10-20: nozzle" in err
    assert "2 errors, nothing was solved" in err
    assert not list(home.glob("*.out"))


def test_permissive_lists_what_is_left_out_on_top_of_all_reports(home, capsys):
    assert leave("run", "odd.toy", "--permissive", "-o", "r", "--html", "--xlsx", "--csv") == 0
    screen = capsys.readouterr().out
    assert "LEFT OUT: element 10-20: bellows; taken as pipe (odd.toy:3)" in screen
    page = (home / "r" / "odd.html").read_text()
    assert "<b>LEFT OUT (2)</b>" in page
    assert "<li>element 10-20: bellows; taken as pipe (odd.toy:3)</li>" in page
    assert page.index("nozzle; taken as pipe (odd.toy:4)") < page.index('id="picture"')
    assert "no load cases in the file" in page
    assert "bellows; taken as pipe" in (home / "r" / "odd_csv" / "warnings.csv").read_text()
    text = (home / "r" / "odd.out").read_text()
    assert "LEFT OUT (2)" in text
    assert text.index("nozzle; taken as pipe (odd.toy:4)") < text.index("1  SUMMARY")
    assert "no load cases in the file" in text
    origin = json.loads((home / "r" / "odd.json").read_text())["origin"]
    assert [x["feature"] for x in origin["left_out"]] == [
        "bellows; taken as pipe",
        "nozzle; taken as pipe",
    ]
    assert origin["format"] == "toy, version 1"


def test_a_deck_has_no_origin_and_takes_no_permissive(home, capsys):
    assert leave("convert", "a.toy", "a.inp") == 0
    assert leave("run", "a.inp") == 0
    assert "origin" not in json.loads((home / "a.json").read_text())
    assert leave("run", "a.inp", "--permissive") == 2
    assert "--permissive is for files of other programs" in capsys.readouterr().err


def test_every_command_lists_what_is_left_out(home, monkeypatch, capsys):
    """export, confirm, study and verify go on without it, and say so."""
    line = "LEFT OUT: element 10-20: bellows; taken as pipe (odd.toy:3)"
    monkeypatch.setattr("trunnion.exports.confirm.answer", lambda *_: {"program": "x", "cases": {}})
    monkeypatch.setattr("trunnion.exports.confirm.missing", lambda program: "")
    assert leave("export", "odd.toy", "--permissive") == 0
    assert line in capsys.readouterr().out
    assert line in (home / "odd_opensees.py").read_text()
    assert leave("confirm", "odd.toy", "--permissive") == 1  # the other program finds nothing
    assert line in capsys.readouterr().out
    assert leave("study", "odd.toy", "--permissive", "--vary", "E=200,210GPa", "-j", "1") == 0
    assert line in capsys.readouterr().out
    assert "bellows; taken as pipe (odd.toy:3)" in (home / "odd-study.out").read_text()
    assert "bellows; taken as pipe" in (home / "odd-study.json").read_text()
    assert leave("run", "odd.toy", "--permissive") == 0
    capsys.readouterr()
    assert leave("verify", "odd.json") == 0
    assert line in capsys.readouterr().out
    assert leave("verify", "--certificate", "odd.json") == 0
    assert line in capsys.readouterr().out
    assert leave("show", "odd.json") == 0
    assert line in capsys.readouterr().out


@pytest.mark.parametrize("command", ["export", "confirm", "study", "run", "check"])
def test_errors_of_what_is_left_say_what_is_left_out(home, monkeypatch, command, capsys):
    """A line that is cut at a gap moves freely: the mechanism alone would not say why."""
    monkeypatch.setattr("trunnion.exports.confirm.missing", lambda program: "")
    (home / "odd.toy").write_text(ODD.replace("LENGTH 6000\n", "LENGTH 6000\nLOOSE 1\n"))
    more = ["--vary", "E=200,210GPa", "-j", "1"] if command == "study" else []
    assert leave(command, "odd.toy", "--permissive", *more) == 2
    err = capsys.readouterr().err
    assert "LEFT OUT: element 10-20: bellows; taken as pipe (odd.toy:4)" in err
    assert "no restraint holds it" in err


def test_check_reads_foreign_files(home, capsys):
    assert leave("check", "odd.toy", "--permissive") == 0
    out = capsys.readouterr().out
    assert "LEFT OUT: element 10-20: nozzle" in out
    assert "no errors; 2 nodes" in out


def test_the_source_is_never_overwritten(home, capsys):
    os.link("a.toy", "b.inp")
    assert leave("convert", "a.toy", "b.inp") == 2
    assert "would overwrite its own source" in capsys.readouterr().err
    assert leave("convert", "a.toy", "c.toy") == 2
    assert (home / "a.toy").read_text() == GOOD
    assert not (home / "c.toy").exists()


def test_a_deck_that_is_there_is_written_over_only_with_force(home, capsys):
    (home / "kept.inp").write_text("! by hand\n")
    assert leave("convert", "a.toy", "kept.inp") == 2
    assert "kept.inp exists; --force writes over it" in capsys.readouterr().err
    assert (home / "kept.inp").read_text() == "! by hand\n"
    assert leave("convert", "--force", "a.toy", "kept.inp") == 0
    assert "! by hand" not in (home / "kept.inp").read_text()


def test_a_bad_source_leaves_no_deck(home):
    assert leave("convert", "odd.toy", "odd.inp") == 2
    assert not (home / "odd.inp").exists()


def test_contents_decide_and_a_wrong_suffix_is_named(home):
    (home / "a.txt").write_text(GOOD)
    assert read_any("a.txt").model == read_any("a.toy").model
    (home / "b.toy").write_text("\n\nsomething else\n")
    with pytest.raises(DeckError, match=r"b\.toy:3: this is no toy\n     3 \|  something else"):
        read_any("b.toy")
    (home / "b.txt").write_text("something else\n")
    with pytest.raises(DeckError, match="no file of a known format"):
        read_any("b.txt")


@pytest.mark.parametrize(
    ("sample", "kind"),
    [
        ("hot_line_11.cii", ".cii"),
        ("skid_line_14.00.xml", ".xml"),
        ("plant_line.pcf", ".pcf"),
    ],
)
def test_a_file_of_another_program_read_as_a_deck_is_one_error(sample, kind, home):
    """Not one of every line: seven hundred of a neutral file."""
    data = (SAMPLES / sample).read_bytes()
    for name, how in (("a.inp", rf"call it \*{kind}"), (f"a{kind}", "formats.read_any reads it")):
        (home / name).write_bytes(data)
        with pytest.raises(DeckError, match=how) as caught:
            trunnion.read(name)
        assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"TOY\0", "NUL byte in the text"),
        (b"TOY\nA\x01", r"x:2: control character 0x01"),
        (b"\n" * 5_000_001 + b"a", "more than 5000000 lines"),
    ],
)
def test_what_is_no_text_is_refused(data, message):
    with pytest.raises(DeckError, match=message):
        source_of(data, "x")


def test_text_of_windows_and_of_other_ends_of_lines_is_read():
    assert source_of(b"\xef\xbb\xbfA\r\nB\rC\x1a", "x").lines == ("A", "B", "C")
    assert source_of(b"A\r\r\nB\r\r\n", "x").lines == ("A", "B")  # converted twice on its way
    source = source_of("Wärme".encode("cp1252"), "x")
    assert (source.lines, source.encoding) == (("Wärme",), "cp1252")
    assert source_of("Wärme".encode("utf-16"), "x").lines == ("Wärme",)


@pytest.mark.parametrize("path", ["/dev/zero", "/", "none.toy", "a\0b"])
def test_what_is_no_ordinary_file_is_refused(path, home):
    with pytest.raises(DeckError):
        read_any(path)


def test_a_pipe_without_writer_does_not_hang(home):
    os.mkfifo("f.toy")
    with pytest.raises(DeckError, match="no ordinary file"):
        read_any("f.toy")


def test_a_marker_shows_the_words_of_a_very_long_line():
    source = source_of(b"x" * 1000 + b"BAD" + b"y" * 1000, "x")
    row, carets = source.marker(1, (1000, 1003)).splitlines()
    assert row[carets.index("^") : carets.rindex("^") + 1] == "BAD"
