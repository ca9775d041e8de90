"""Exit codes, messages and files of the command line."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from program import leave

import trunnion

BAD = "PIPE 10 20 DX=1\nPIPPE 20 30\n"


@pytest.fixture
def home(tmp_path, deck, monkeypatch):
    (tmp_path / "a.inp").write_text(deck)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def solves(monkeypatch, results):
    """Give the known answer for any model."""
    monkeypatch.setattr(trunnion, "solve", lambda model: results, raising=False)
    return results


def files(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir())


def test_certified_run_exits_0_and_writes_two_files(home, solves, capsys):
    del solves.cases["OFF"]
    assert leave("run", "a.inp") == 0
    assert files(home) == ["a.inp", "a.json", "a.out"]
    out = capsys.readouterr().out
    assert len(out.splitlines()) <= 24
    assert "certified" in out
    assert "read" not in out


def test_a_case_that_fails_exits_1_and_the_good_ones_are_written(home, solves, capsys):
    assert leave("run", "a.inp", "-o", "there", "--h5", "--timings") == 1
    assert files(home / "there") == ["a.h5", "a.json", "a.out"]
    cases = json.loads((home / "there" / "a.json").read_text())["cases"]
    assert [case["converged"] for case in cases.values()] == [True, False, True]
    assert " s, solve " in capsys.readouterr().out


def test_every_format_that_is_asked_for_is_written_with_the_others(home, solves, capsys):
    assert leave("run", "a.inp", "-o", "all", "--xlsx", "--csv", "--vtu", "--h5") == 1
    assert files(home / "all") == [
        *("a.h5", "a.json", "a.out", "a.pvd", "a.xlsx", "a_csv", "a_vtu"),
    ]
    assert "envelope.csv" in files(home / "all" / "a_csv")
    assert files(home / "all" / "a_vtu") == [
        f"{case}_{part}.vtu" for case in ("OPE", "TWO") for part in ("pipes", "restraints")
    ]
    wrote = capsys.readouterr().out.splitlines()[-1]
    assert f"{Path('all', 'a_csv')}/ (8 files)" in wrote
    assert wrote.count(".vtu") == 0


def test_a_failure_while_writing_leaves_none_of_the_formats(home, solves, monkeypatch):
    from trunnion.report import atomic

    real = atomic._write

    def full(path: Path, content: bytes) -> None:
        if "restraints" in path.name:
            raise OSError(28, "No space left on device", str(path))
        real(path, content)

    monkeypatch.setattr(atomic, "_write", full)
    assert leave("run", "a.inp", "-o", "all", "--xlsx", "--csv", "--vtu") == 3
    assert [path for path in (home / "all").rglob("*") if path.is_file()] == []


def test_all_packages_that_are_missing_are_named_before_any_work(home, monkeypatch, capsys):
    import importlib.util

    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    assert leave("run", "a.inp", "--xlsx", "--vtu", "--csv") == 2
    assert capsys.readouterr().err.splitlines() == [
        "--xlsx needs the package xlsxwriter: pip install 'trunnion[excel]'",
        "--vtu needs the package pyevtk: pip install 'trunnion[vtk]'",
    ]
    assert files(home) == ["a.inp"]


def test_nothing_of_the_machine_is_in_the_files(home, solves):
    leave("run", "a.inp", "-o", "one")
    leave("run", home / "a.inp", "-o", home / "two", "--timings")
    for name in ("a.out", "a.json"):
        text = (home / "one" / name).read_bytes()
        assert text == (home / "two" / name).read_bytes()
        assert str(home).encode() not in text


def test_wrong_deck_exits_2_with_its_line_and_writes_nothing(home, solves, capsys):
    (home / "b.inp").write_text(BAD)
    assert leave("run", "b.inp", "-o", "there") == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "b.inp:2: " in captured.err
    assert "nothing was solved" in captured.err
    assert "Traceback" not in captured.err
    assert files(home) == ["a.inp", "b.inp"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run"], "Missing argument"),
        (["run", "none.inp"], "none.inp"),
        (["run", "."], ""),
        (["run", "a.inp", "--fast"], "--fast"),
        (["walk", "a.inp"], "walk"),
        (["run", "a.json"], "must not be called"),
        (["run", "a.inp", "-o", "a.inp"], "not a folder"),
    ],
)
def test_wrong_command_exits_2(home, solves, capsys, arguments, said):
    assert leave(*arguments) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert "Traceback" not in captured.err
    assert files(home) == ["a.inp"]


def test_check_reads_and_numbers_without_solving(home, capsys):
    assert leave("check", "a.inp") == 0
    assert "3 nodes, 2 elements, 2 supports, 3 cases" in capsys.readouterr().out
    assert files(home) == ["a.inp"]


def test_check_refuses_what_run_refuses(home, capsys):
    (home / "b.inp").write_text(BAD)
    assert leave("check", "b.inp") == 2
    assert "b.inp:2: " in capsys.readouterr().err


def test_check_names_what_moves(home, capsys):
    loose = (home / "a.inp").read_text().replace("ANCHOR   10", "SUPPORT 10 X Y Z RX")
    loose = loose.replace("+Y GUIDE GAP=50", "Y").replace("MU=0.3", "MU=0")
    (home / "b.inp").write_text(loose)
    assert leave("check", "b.inp") == 2
    assert "b.inp: structure: line 10-30 turns about Y" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["check", "run", "confirm", "export"])
def test_motions_of_one_name_are_said_once(home, capsys, command):
    loose = (home / "a.inp").read_text().replace("ANCHOR   10", "SUPPORT 10 Y")
    (home / "b.inp").write_text(loose.replace("+Y GUIDE GAP=50", "Y").replace("MU=0.3", "MU=0"))
    assert leave(command, "b.inp") == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == len(set(lines))
    assert sum("line 10-30 turns about Y (2 ways, about different points)" in x for x in lines) == 1


def test_internal_error_exits_3_with_a_log_and_no_traceback(home, monkeypatch, capsys):
    def breaks(model):
        raise ZeroDivisionError("a number was zero")

    monkeypatch.setattr(trunnion, "solve", breaks, raising=False)
    assert leave("run", "a.inp") == 3
    captured = capsys.readouterr()
    assert "ZeroDivisionError: a number was zero" in captured.err
    assert "Traceback" not in captured.err
    (log,) = (p for p in home.iterdir() if p.suffix == ".log")
    assert "breaks" in log.read_text()
    assert not [p for p in home.iterdir() if p.suffix in (".out", ".json")]


def test_nan_in_an_answer_is_an_internal_error(home, solves):
    solves["OPE"].state.u[0, 0] = float("nan")
    assert leave("run", "a.inp") == 3
    assert not (home / "a.out").exists()


@pytest.mark.parametrize(("signal_", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_interruption_leaves_nothing_half_written(home, signal_, code):
    script = (
        "import sys, time, trunnion\n"
        "def slow(model):\n"
        "    print('solving', flush=True)\n"
        "    time.sleep(60)\n"
        "trunnion.solve = slow\n"
        "from trunnion.cli import main\n"
        "main(['run', 'a.inp'])\n"
    )
    pipes = dict.fromkeys(("stdout", "stderr"), subprocess.PIPE)
    with subprocess.Popen([sys.executable, "-c", script], text=True, **pipes) as process:
        assert process.stdout.readline() == "solving\n"
        process.send_signal(signal_)
        _, said = process.communicate(timeout=30)
    assert process.returncode == code
    assert "Traceback" not in said
    assert files(home) == ["a.inp"]


def test_a_closed_pipe_changes_neither_messages_nor_code(home):
    script = "import sys, trunnion.cli as cli; sys.stdin.read(); cli.main(['check', 'a.inp'])"
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with subprocess.Popen([sys.executable, "-c", script], **pipes) as process:
        process.stdout.close()
        process.stdin.close()
        said = process.stderr.read()
    assert (process.returncode, said) == (0, b"")


def test_interruption_while_writing_keeps_the_old_report(home, solves, monkeypatch):
    assert leave("run", "a.inp") == 1
    old = (home / "a.out").read_bytes()

    def fsync(number: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", fsync)
    solves.title = "another"
    assert leave("run", "a.inp") == 130
    assert (home / "a.out").read_bytes() == old
    assert files(home) == ["a.inp", "a.json", "a.out"]


def test_start_up_loads_nothing_heavy(home):
    script = (
        "import sys, trunnion.cli, trunnion.report.text, trunnion.report.json\n"
        "heavy = {'pint', 'fluids', 'h5py', 'scipy', 'matplotlib', 'rich', 'pandas',"
        " 'xlsxwriter', 'pyevtk'}\n"
        "print(sorted(heavy & set(sys.modules)))\n"
    )
    found = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert found.stdout == "[]\n"
