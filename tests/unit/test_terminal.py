"""What a user sees on a terminal, and what a pipe gets."""

import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from falls import FALLS
from terminal import on_terminal

MODELS = Path(__file__).parents[2] / "models"
ANSI = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
HEAD = """\
TITLE    Line with many cases and supports
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P      OD=273.1 WALL=9.27
OPERATE  T1=170 P1=12 TREF=20
ANCHOR   0
"""
# Draws at once, and makes the work wait until a line was drawn twice: no clock is asserted.
SLOW = """\
import threading, time
import trunnion, trunnion.report.progress as progress
from trunnion.cli import main
progress.LASTS, drawn, clock = 0.0, [], progress._clock
def counted(seconds):
    drawn.append(seconds)
    return clock(seconds)
progress._clock = counted
solve = trunnion.solve
def slow(model, **asked):
    watch = asked["watch"]
    watch.turn("solving")
    watch.total = 3
    watch.begin("OPE")
    watch.note(1234.5)
    {wait}
    return solve(model, **asked)
trunnion.solve = slow
main()
"""
DRAWN = "while len(drawn) < 3: time.sleep(0.01)"


def line(tmp_path, cases=3, supports=4):
    text = HEAD
    for i in range(supports):
        text += f"PIPE {10 * i} {10 * i + 10} DX=6000\nSUPPORT {10 * i + 10} +Y GUIDE GAP=3\n"
    for i in range(cases):
        text += f"CASE C{i:02d} = W + P1 + {1.0 + 0.01 * i:g}*T1\n"
    (tmp_path / "line.inp").write_text(text)
    return tmp_path / "line.inp"


def words(session):
    return " ".join(" ".join(session.screen).split())


# ------------------------------------------------------------------ the summary
LIFTS = """\
SUPPORT 10 +Y
SUPPORT 20 -Y GAP=50
SUPPORT 30 +Y LIMIT GUIDE
FORCE 30 F1 FY=200
CASE SUS = W
CASE UP = W + F1
CASE UP2 = W + 1.1*F1
"""


def test_rests_that_lift_are_named_though_their_limit_slides(tmp_path):
    """A stop from above that is not reached is no rest; the other directions of 30 hold."""
    text = HEAD + "".join(f"PIPE {10 * i} {10 * i + 10} DX=6000\n" for i in range(4))
    (tmp_path / "line.inp").write_text(text + "SUPPORT 40 +Y\n" + LIFTS)
    found = on_terminal(["run", "line.inp", "-o", "o"], cwd=tmp_path)
    (row,) = [row for row in found.screen if "lifted off" in row]
    assert row.split("lifted off")[1].strip().startswith("in UP, UP2: ")
    assert "30 +Y" in row
    assert "20 -Y" not in row
    head = next(row for row in found.screen if "CASE" in row)
    assert "OPEN" in head


def test_a_screen_of_80_columns_keeps_open_rather_than_slip(tmp_path):
    found = on_terminal(["run", MODELS / "hot_header.inp", "-o", tmp_path], cwd=tmp_path)
    head = next(row for row in found.screen if "CASE" in row).split()
    assert "OPEN" in head
    assert "SLIP" not in head
    assert "70 +Y" in next(row for row in found.screen if "lifted off" in row)


@pytest.mark.parametrize("size", [(80, 24), (120, 40), (60, 24), (44, 24)])
@pytest.mark.parametrize(("cases", "supports"), [(3, 4), (40, 4), (3, 300)])
def test_the_summary_fits_the_screen(tmp_path, size, cases, supports):
    deck = line(tmp_path, cases, supports)
    found = on_terminal(["run", deck.name, "-o", "o"], size=size, cwd=tmp_path)
    assert found.code == 0
    assert len(found.screen) < size[1]
    assert found.screen[0].startswith("Line with many cases")
    assert "CASE" in found.screen[1]
    said = words(found)
    assert re.search(rf"certificate all {cases} cases are certified, worst", said)
    assert re.search(r"worst support \S+ .* carries [0-9.]+ kN in C", said)


def test_a_small_terminal_holds_the_summary_with_messages_of_one_line(tmp_path):
    shutil.copy(MODELS / "snubber_line.inp", tmp_path)
    found = on_terminal(["run", "snubber_line.inp", "-o", "o"], size=(40, 16), cwd=tmp_path)
    assert len(found.screen) < 16
    assert max(map(len, found.screen)) <= 40
    assert sum(row.lstrip().startswith("warning: ") for row in found.screen) >= 2


def test_a_narrow_terminal_keeps_cases_status_and_load(tmp_path):
    found = on_terminal(["run", line(tmp_path).name, "-o", "o"], size=(60, 24), cwd=tmp_path)
    head = next(row for row in found.screen if "CASE" in row)
    assert {"CASE", "STATUS", "LOAD", "RESTRAINT"} <= set(re.findall(r"[A-Z]{4,}", head))
    assert max(map(len, found.screen)) <= 60


def test_cases_that_do_not_fit_are_counted(tmp_path):
    found = on_terminal(["run", line(tmp_path, 40), "-o", tmp_path])
    (more,) = [re.search(r"and (\d+) more cases", row) for row in found.screen if "more" in row]
    listed = [row for row in found.screen if re.match(r"  C\d\d ", row)]
    assert len(listed) + int(more[1]) == 40


def test_a_pipe_gets_every_case_and_no_colour(tmp_path):
    deck = line(tmp_path, 40)
    command = [sys.executable, "-m", "trunnion", "run", deck, "-o", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "\x1b" not in done.stdout
    assert done.stderr == ""
    assert len(re.findall(r"^  C\d\d ", done.stdout, re.MULTILINE)) == 40


def test_failed_cases_come_first_and_in_red(tmp_path):
    (tmp_path / "falls.inp").write_text(FALLS + "CASE REST = F1\n".replace("F1", "0.0*F1"))
    found = on_terminal(["run", tmp_path / "falls.inp", "-o", tmp_path])
    assert found.code == 1
    assert found.screen[1].split()[:3] == ["PUSH", "NOT", "CONVERGED"]
    assert "1 of 2 cases NOT certified" in words(found)
    assert "red" in found.painted


def test_a_bad_deck_says_what_is_wrong_and_no_more(tmp_path):
    (tmp_path / "bad.inp").write_text("PIPE 10 20 DX=1\nSUPORT 20 +Y\n")
    found = on_terminal(["run", tmp_path / "bad.inp", "-o", tmp_path])
    assert found.code == 2
    assert "bad.inp:2: SUPORT" in words(found)
    assert "nothing was solved" in found.screen[-1]


# ------------------------------------------------------------------ colour
def test_a_terminal_has_colours(tmp_path):
    found = on_terminal(["run", line(tmp_path), "-o", tmp_path])
    assert "green" in found.painted
    assert ANSI.search(found.sent)


@pytest.mark.parametrize("env", [{"NO_COLOR": "1"}, {"TERM": "dumb"}], ids=["NO_COLOR", "dumb"])
@pytest.mark.parametrize("command", ["run", "show"])
def test_colour_can_be_refused(tmp_path, env, command):
    deck = line(tmp_path)
    if command == "show":
        on_terminal(["run", deck, "-o", tmp_path])
        deck = tmp_path / "line.json"
    more = ["-o", tmp_path] if command == "run" else []
    found = on_terminal([command, deck, *more], env=env)
    assert found.code == 0
    assert not ANSI.search(found.sent)


# ------------------------------------------------------------------ progress
def test_progress_shows_case_iteration_and_residual_and_goes(tmp_path):
    deck = line(tmp_path)
    script = SLOW.format(wait=DRAWN)
    found = on_terminal(["run", deck, "-o", tmp_path], script=script)
    assert found.code == 0
    told = ANSI.sub("", found.sent)
    assert "solving OPE (1 of 3): iteration 1, residual 1.2e+00 kN" in told.replace("\r", "")
    assert found.screen[0].startswith("Line with many cases")
    assert "residual 1.2e+00 kN" not in words(found)


def test_progress_is_on_stderr_so_that_a_pipe_gets_the_summary_alone(tmp_path):
    script = SLOW.format(wait=DRAWN)
    found = on_terminal(["run", line(tmp_path), "-o", tmp_path], script=script, stdout=False)
    summary, _, rest = found.sent.partition("wrote ")
    assert "\x1b" not in summary
    assert "residual 1.2e+00 kN" in rest


@pytest.mark.parametrize("env", [{"TERM": "dumb"}], ids=["dumb"])
def test_a_terminal_that_cannot_write_over_a_line_shows_no_progress(tmp_path, env):
    script = SLOW.format(wait="pass").replace('asked["watch"]', "progress.Watch()")
    found = on_terminal(["run", line(tmp_path), "-o", tmp_path], script=script, env=env)
    assert found.code == 0
    assert "residual 1.2e+00 kN" not in found.sent


def test_a_short_run_imports_neither_rich_nor_shows_anything(tmp_path):
    script = (
        "import sys\nfrom trunnion.cli import main\ntry:\n    main()\n"
        "finally:\n    print('rich' in sys.modules)"
    )
    found = on_terminal(["run", line(tmp_path), "-o", tmp_path], script=script)
    assert found.screen[-1] == "False"
    assert "residual 1.2e+00 kN" not in found.sent


# ------------------------------------------------------------------ Ctrl-C
def test_ctrl_c_ends_with_one_line_and_nothing_half_written(tmp_path):
    deck = line(tmp_path)
    out = tmp_path / "out"
    pressed = []

    def press(process, sent):
        if "residual 1.2e+00 kN" in sent and not pressed:
            pressed.append(True)
            process.send_signal(signal.SIGINT)

    script = SLOW.format(wait="time.sleep(60)")
    found = on_terminal(["run", deck, "-o", out], script=script, meanwhile=press)
    assert pressed
    assert found.code == 130
    assert [row for row in found.screen if row] == ["interrupted: nothing is half written"]
    assert not out.exists()
    assert found.sent.rstrip().endswith("half written")
    assert "\x1b[?25h" in found.sent  # the cursor is back


@pytest.mark.parametrize("command", ["verify", "convert", "diff", "check"])
def test_other_commands_show_progress_too(tmp_path, command):
    deck = line(tmp_path)
    assert on_terminal(["run", deck, "-o", tmp_path]).code == 0
    arguments = {
        "verify": [tmp_path / "line.json"],
        "convert": [tmp_path / "a.pcf", tmp_path / "b.inp"],
        "diff": [deck, shutil.copy(deck, tmp_path / "other.inp")],
        "check": [deck],
    }[command]
    script = (  # what reads shows it: it waits until that was drawn
        "import time\nimport trunnion.report.progress as progress\n"
        "from trunnion.cli import main\n"
        "progress.LASTS, drawn, clock = 0.0, [], progress._clock\n"
        "def counted(seconds):\n    drawn.append(seconds)\n    return clock(seconds)\n"
        "progress._clock = counted\n"
        "import trunnion.deck.reader as reader, trunnion.formats as formats\n"
        "def waits(read):\n"
        "    def slow(*a, **k):\n"
        "        while len(drawn) < 3: time.sleep(0.01)\n"
        "        return read(*a, **k)\n"
        "    return slow\n"
        "reader.read = waits(reader.read)\nformats.read_any = waits(formats.read_any)\n"
        "main()"
    )
    (tmp_path / "a.pcf").write_text("ISOGEN-FILES ISOGEN.FLS\n")
    found = on_terminal([command, *arguments], script=script)
    told = {"verify": "reading line.json", "convert": "reading a.pcf",
            "diff": "comparing line.inp and other.inp", "check": "checking line.inp"}  # fmt: skip
    assert told[command] in ANSI.sub("", found.sent)
    assert told[command] not in words(found)


# ------------------------------------------------------------------ many decks, many variants
@pytest.mark.parametrize("columns", [46, 60, 80])
def test_the_table_of_a_batch_fits_its_terminal(tmp_path, columns):
    decks = [line(tmp_path)]
    decks.append(tmp_path / "a_deck_that_nothing_holds_and_with_a_long_name.inp")
    decks[1].write_text(decks[0].read_text().replace("ANCHOR", "SUPPORT").replace("10\n", "10 Y\n"))
    found = on_terminal(
        ["batch", *decks, "-o", tmp_path / "out", "-j", "1"], size=(columns, 40), cwd=tmp_path
    )
    heads = next(row.split() for row in found.screen if row.split()[:1] == ["DECK"])
    assert heads[:2] == ["DECK", "STATUS"]
    assert ("WARNINGS" in heads) == (columns == 80)
    rule = next(row for row in found.screen if "----" in row)
    assert len(rule.rstrip()) <= columns
    assert any(row.split()[:2] == ["line.inp", "certified"] for row in found.screen)


@pytest.mark.parametrize("columns", [46, 60])
def test_the_screen_of_a_study_fits_its_terminal(tmp_path, columns):
    more = ["--vary", "E=200,201,202GPa", "--vary", "T1=100:200:3", "-o", "out", "-j", "1"]
    found = on_terminal(["study", line(tmp_path), *more], size=(columns, 60), cwd=tmp_path)
    assert found.code == 0
    rules = [row.rstrip() for row in found.screen if "----" in row]
    assert rules
    assert max(map(len, rules)) <= columns
    assert any("GOVERNED" in row for row in found.screen)
    for name in ("out", "json", "csv"):
        assert any(f"line-study.{name}" in row for row in found.screen)  # whole, on one line


def test_a_pipe_gets_the_table_of_a_batch_whole(tmp_path):
    found = on_terminal(
        ["batch", line(tmp_path), "-o", tmp_path / "out", "-j", "1"],
        size=(46, 40), cwd=tmp_path, stdout=False,
    )  # fmt: skip
    head = next(row for row in found.sent.splitlines() if row.split()[:1] == ["DECK"])
    assert head.split() == ["DECK", "STATUS", "CASES", "GOOD", "WORST", "WARNINGS"]


def test_stored_tables_go_on_below_on_a_narrow_terminal(tmp_path):
    assert on_terminal(["run", line(tmp_path), "-o", tmp_path]).code == 0
    found = on_terminal(["show", tmp_path / "line.json", "--case", "C00"], size=(60, 60))
    heads = [row for row in found.screen if row.split()[:1] in (["ID"], ["NODE"])]
    assert max(map(len, heads)) <= 60
    assert sum("MZ [N.m]" in row for row in heads) == 1
    assert sum("RZ [deg]" in row for row in heads) == 1
    assert all(row.strip() for row in found.screen[: len(heads)])
