"""trunnion batch: nothing half written, nothing done twice, nothing lost, whoever is killed."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from falls import FALLS

import trunnion
from trunnion.many.records import FOLDER

MODELS = Path(__file__).parents[2] / "models"
BAD = "PIPE 10 20 DX=1\nSUPORT 20 +Y\n"


def command(*arguments, **options):
    return subprocess.Popen(
        [sys.executable, "-m", "trunnion", "batch", *map(str, arguments)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options,
    )  # fmt: skip


def run(*arguments):
    process = command(*arguments)
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


@pytest.fixture
def decks(tmp_path):
    """Three decks that solve in no time."""
    names = ("strut_three", "hot_header", "pipe_10m")
    return [Path(shutil.copy(MODELS / f"{name}.inp", tmp_path)) for name in names]


@pytest.fixture
def many(tmp_path):
    """Decks that keep two processes busy for some seconds."""
    folder = tmp_path / "many"
    folder.mkdir()
    return [Path(shutil.copy(MODELS / "rack_50.inp", folder / f"r{i:02d}.inp")) for i in range(14)]


def summary(folder):
    return json.loads((folder / "batch-summary.json").read_text())


def reports(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.suffix in (".out", ".json")}


def hidden(folder):
    return [*folder.glob(".*.tmp"), *(folder / FOLDER).glob(".*.tmp")]


def children(pid):
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True)
    return [int(word) for word in found.stdout.split()]


def gone(pids):
    """Wait until processes have ended; a zombie has."""
    until = time.monotonic() + 10
    while time.monotonic() < until:
        states = [
            Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
            for pid in pids
            if Path(f"/proc/{pid}").exists()
        ]
        if set(states) <= {"Z"}:
            return True
        time.sleep(0.02)
    return False


def wait_for_records(process, folder, n):
    while len(list((folder / FOLDER).glob("*.json"))) < n:
        assert process.poll() is None, process.communicate()
        time.sleep(0.005)


# ------------------------------------------------------------------ what a batch gives
def test_reports_are_those_of_single_runs(decks, tmp_path):
    done = trunnion.batch(decks, tmp_path / "out", jobs=2)
    assert done.code == 0
    for deck in decks:
        subprocess.run(
            [sys.executable, "-m", "trunnion", "run", deck, "-o", tmp_path / "one"],
            check=True, capture_output=True,
        )  # fmt: skip
    batch = reports(tmp_path / "out")
    del batch["batch-summary.json"]
    assert batch == reports(tmp_path / "one")


def test_summary_has_every_deck_and_case(decks, tmp_path):
    trunnion.batch(decks, tmp_path / "out")
    found = summary(tmp_path / "out")
    assert [e["deck"] for e in found["entries"]] == [deck.name for deck in decks]
    assert [case["name"] for case in found["entries"][0]["cases"]] == ["PUSH"]
    assert found["status"] == {"certified": 3}
    rows = (tmp_path / "out/batch-summary.csv").read_text().splitlines()
    assert len(rows) == 1 + sum(len(e["cases"]) for e in found["entries"])


@pytest.mark.parametrize(("texts", "code"), [([], 0), ([FALLS], 1), ([BAD], 2), ([FALLS, BAD], 2)])
def test_the_exit_code_is_that_of_the_worst_deck(decks, tmp_path, texts, code):
    for i, text in enumerate(texts):
        decks.append(tmp_path / f"extra{i}.inp")
        decks[-1].write_text(text)
    found, out, _ = run(*decks, "-o", tmp_path / "out")
    assert found == code
    assert ("FAILURES" in out) == bool(texts)
    assert out.count(" certified ") == 3


def test_failures_are_listed_with_their_causes(decks, tmp_path):
    bad, falls = tmp_path / "bad.inp", tmp_path / "falls.inp"
    bad.write_text(BAD)
    falls.write_text(FALLS)
    code, out, err = run(bad, falls, tmp_path / "missing.inp", "-o", tmp_path / "out")
    assert (code, err) == (2, "")
    assert "bad.inp:2: SUPORT" in out
    assert "PUSH: " in out
    assert "cannot read" in out
    assert not (tmp_path / "out/bad.out").exists()
    assert (tmp_path / "out/falls.out").exists()


def test_decks_of_one_stem_are_refused_before_any_work(decks, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    shutil.copy(decks[0], other)
    code, out, err = run(*decks, other / decks[0].name, "-o", tmp_path / "out")
    assert (code, out) == (2, "")
    assert f"{decks[0]} and {other / decks[0].name} would both write strut_three.out" in err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["batch-summary.inp", "deck.json"])
def test_a_deck_that_a_report_would_overwrite_is_refused(tmp_path, name):
    (tmp_path / name).write_text(FALLS)
    with pytest.raises(trunnion.BatchError, match=name):
        trunnion.batch([tmp_path / name], tmp_path)


def test_files_of_other_programs_come_in_by_their_door(decks, tmp_path, monkeypatch):
    from types import SimpleNamespace

    import trunnion.formats

    def read_any(path, *, permissive, options):
        (tmp_path / f"asked{permissive}").touch()
        return SimpleNamespace(model=trunnion.read(decks[0]))

    monkeypatch.setattr(trunnion.formats, "is_foreign", lambda path: str(path).endswith(".xyz"))
    monkeypatch.setattr(trunnion.formats, "read_any", read_any)
    foreign = tmp_path / "line.xyz"
    foreign.write_text("of another program")
    for permissive in (False, True):
        done = trunnion.batch([foreign], tmp_path / "out", permissive=permissive)
        assert [(e.status, e.skipped) for e in done.entries] == [("certified", False)]
        assert (tmp_path / f"asked{permissive}").exists()
    assert trunnion.batch([foreign], tmp_path / "out", permissive=True)["line"].skipped


FORMATS = ("--csv", "--xlsx", "--vtu", "--h5", "--html", "--png")


def test_every_further_report_is_that_of_a_single_run(decks, tmp_path):
    code, _, err = run(*decks[:2], "-o", tmp_path / "out", *FORMATS)
    assert code == 0, err
    for deck in decks[:2]:
        subprocess.run(
            [sys.executable, "-m", "trunnion", "run", deck, "-o", tmp_path / "one", *FORMATS],
            check=True, capture_output=True,
        )  # fmt: skip
    batch, one = (
        {
            path.relative_to(folder): path.read_bytes()
            for path in folder.rglob("*")
            if path.is_file() and FOLDER not in path.parts and "summary." not in path.name
        }
        for folder in (tmp_path / "out", tmp_path / "one")
    )
    batch |= {name: one[name] for name in one if name.name == "summary.csv"}
    assert batch == one
    assert {path.suffix for path in one} >= {
        ".csv",
        ".xlsx",
        ".vtu",
        ".pvd",
        ".h5",
        ".html",
        ".png",
    }


def test_a_further_report_that_was_changed_is_made_again(decks, tmp_path):
    trunnion.batch(decks[:1], tmp_path / "out", also=["csv"])
    assert trunnion.batch(decks[:1], tmp_path / "out", also=["csv"]).entries[0].skipped
    (tmp_path / "out/strut_three_csv/summary.csv").write_text("")
    assert not trunnion.batch(decks[:1], tmp_path / "out", also=["csv"]).entries[0].skipped


def test_options_go_to_the_files_that_have_a_use_for_them(decks, tmp_path):
    import cii_jobs
    import pcf_lines

    (tmp_path / "a.pcf").write_text(pcf_lines.everything())
    (tmp_path / "table.toml").write_text(pcf_lines.TABLE)
    (tmp_path / "b.cii").write_text(cii_jobs.everything(11.0).text(), encoding="cp1252")
    files = [tmp_path / "a.pcf", tmp_path / "b.cii", decks[0]]
    more = ("--table", tmp_path / "table.toml", "--anchor", "open-ends", "--permissive")
    _, out, _ = run(*files, "-o", tmp_path / "out", *more)
    found = {e["stem"]: e["status"] for e in summary(tmp_path / "out")["entries"]}
    assert found["a"] in ("certified", "failed"), out
    assert found["strut_three"] == "certified"
    assert found["b"] != "bad deck", out
    _, out, _ = run(*files, "-o", tmp_path / "out", *more)
    assert "3 of them finished before" in out
    (tmp_path / "table.toml").write_text(pcf_lines.TABLE.replace("150C", "140C"))
    _, out, _ = run(*files, "-o", tmp_path / "out", *more)
    assert "2 of them finished before" in out


def test_the_summary_names_files_that_lack_something_also_when_they_are_skipped(decks, tmp_path):
    import pcf_lines

    (tmp_path / "a.pcf").write_text(pcf_lines.everything())
    more = ("-o", tmp_path / "out", "--anchor", "open-ends", "--permissive")
    for skipped in (False, True):
        code, out, _ = run(tmp_path / "a.pcf", decks[0], *more)
        assert code == 0
        assert ("1 of them" in out or "2 of them" in out) is skipped
        told = out.split("\nLEFT OUT, ")[1].splitlines()[1:]
        assert told[0].startswith("  a.pcf: FLANGE of line 13: wall of bore 100 is not in the file")
        assert " more" in told[0]
        assert told[1] == ""  # a deck lacks nothing
    lacks = {e["stem"]: len(e["left_out"]) for e in summary(tmp_path / "out")["entries"]}
    assert lacks["a"] >= 3
    assert lacks["strut_three"] == 0


def test_options_for_other_programs_mean_nothing_for_decks_alone(decks, tmp_path):
    code, out, err = run(*decks, "-o", tmp_path / "out", "--anchor", "open-ends")
    assert (code, out) == (2, "")
    assert "--anchor" in err
    assert "for files of other programs (.cii .pcf .xml)" in err
    assert not (tmp_path / "out").exists()


def test_a_package_that_is_missing_is_named_before_any_work(decks, tmp_path, monkeypatch, capsys):
    from trunnion.cli import main

    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(SystemExit) as stop:
        main(["batch", *map(str, decks), "-o", str(tmp_path / "out"), "--html"])
    assert stop.value.code == 2
    assert "pip install 'trunnion[html]'" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


# ------------------------------------------------------------------ what is not done twice
def test_finished_decks_are_skipped_and_the_summary_is_the_same(decks, tmp_path):
    trunnion.batch(decks, tmp_path / "out")
    before = reports(tmp_path / "out")
    again = trunnion.batch(decks, tmp_path / "out", jobs=1)
    assert [entry.skipped for entry in again.entries] == [True] * 3
    assert reports(tmp_path / "out") == before


def test_only_what_changed_is_solved_again(decks, tmp_path):
    include = tmp_path / "more.inp"
    include.write_text("FORCE 10 F1 FX=0 FY=0\n")
    decks[0].write_text(decks[0].read_text() + "INCLUDE more.inp\n")
    trunnion.batch(decks, tmp_path / "out")
    changes = (
        lambda: include.write_text("FORCE 10 F1 FX=1 FY=0\n"),
        lambda: decks[1].write_text(decks[1].read_text() + "! changed\n"),
        lambda: (tmp_path / "out/pipe_10m.out").unlink(),
        lambda: (tmp_path / "out/pipe_10m.json").write_text("{}"),
    )
    for change, redone in zip(changes, (0, 1, 2, 2), strict=True):
        change()
        again = trunnion.batch(decks, tmp_path / "out")
        assert [not entry.skipped for entry in again.entries] == [i == redone for i in range(3)]


@pytest.mark.parametrize("options", [{"also": ["csv"]}, {"redo": True}])
def test_other_settings_solve_again(decks, tmp_path, options):
    trunnion.batch(decks, tmp_path / "out")
    again = trunnion.batch(decks, tmp_path / "out", **options)
    assert not any(entry.skipped for entry in again.entries)


def test_another_version_solves_again(decks, tmp_path, monkeypatch):
    trunnion.batch(decks, tmp_path / "out")
    monkeypatch.setattr("trunnion.many.records.version", lambda _: "0.0.0")
    assert not any(e.skipped for e in trunnion.batch(decks, tmp_path / "out").entries)


def test_a_failed_case_is_finished_but_a_bad_deck_is_read_again(tmp_path):
    bad, falls = tmp_path / "bad.inp", tmp_path / "falls.inp"
    bad.write_text(BAD)
    falls.write_text(FALLS)
    for skipped in (False, True):
        done = trunnion.batch([bad, falls], tmp_path / "out")
        assert done.code == 2
        assert [entry.skipped for entry in done.entries] == [False, skipped]


def test_a_damaged_record_is_no_record(decks, tmp_path):
    trunnion.batch(decks, tmp_path / "out")
    for text, name in zip(("", "{}", '{"settings":'), decks, strict=True):
        (tmp_path / "out" / FOLDER / f"{name.stem}.json").write_text(text)
    assert not any(e.skipped for e in trunnion.batch(decks, tmp_path / "out").entries)


# ------------------------------------------------------------------ who is killed
def test_a_killed_run_resumes(many, tmp_path):
    process = command(*many, "-o", tmp_path / "out", "-j", 2)
    wait_for_records(process, tmp_path / "out", 3)
    workers = children(process.pid)
    process.kill()
    process.communicate()
    assert gone(workers)
    assert not (tmp_path / "out/batch-summary.json").exists()
    code, out, _ = run(*many, "-o", tmp_path / "out", "-j", 2)
    assert code == 0
    assert 3 <= out.count("finished before") - 1 < 14  # the last line counts them
    assert not hidden(tmp_path / "out")
    trunnion.batch(many, tmp_path / "whole")
    assert reports(tmp_path / "out") == reports(tmp_path / "whole")


def test_a_killed_worker_is_named_and_its_deck_solved_again(many, tmp_path):
    process = command(*many, "-o", tmp_path / "out", "-j", 2)
    wait_for_records(process, tmp_path / "out", 1)
    killed = []
    while not killed:  # one may end before it is hit
        for pid in children(process.pid):
            try:
                os.kill(pid, signal.SIGKILL)
                killed.append(pid)
            except ProcessLookupError:
                continue
    out, _ = process.communicate(timeout=120)
    assert process.returncode == 0
    named = [pid for pid in killed if f"worker process {pid} was killed by SIGKILL" in out]
    assert len(named) == out.count("solved at the second try")
    assert not hidden(tmp_path / "out")
    assert summary(tmp_path / "out")["status"] == {"certified": 14}


def test_a_deck_that_kills_its_workers_is_reported(decks, tmp_path, monkeypatch):
    from trunnion.many import batch as home

    def fatal(deck, folder, settings):
        if deck.stem == "hot_header":
            os.kill(os.getpid(), signal.SIGKILL)
        return original(deck, folder, settings)

    original = home.solve_deck
    monkeypatch.setattr(home, "solve_deck", fatal)
    done = trunnion.batch(decks, tmp_path / "out", jobs=2)
    assert done.code == 3
    assert [entry.status for entry in done.entries] == ["certified", "internal error", "certified"]
    assert all("killed by SIGKILL" in cause for cause in done["hot_header"].causes)
    assert len(done["hot_header"].causes) == 2


def test_a_fault_of_the_program_costs_one_deck(decks, tmp_path, monkeypatch):
    from trunnion.many import onedeck

    def faulty(model, deck, settings):
        if deck.stem == "hot_header":
            raise KeyError("no such thing")
        return original(model, deck, settings)

    original = onedeck.solve_model
    monkeypatch.setattr(onedeck, "solve_model", faulty)
    done = trunnion.batch(decks, tmp_path / "out")
    assert done.code == 3
    assert "KeyError" in done["hot_header"].causes[0]
    assert "faulty" in (tmp_path / "out/hot_header-error.log").read_text()


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_interruption_leaves_nothing_half_written_and_no_process(many, tmp_path, number, code):
    process = command(*many, "-o", tmp_path / "out", "-j", 2, start_new_session=True)
    wait_for_records(process, tmp_path / "out", 2)
    workers = children(process.pid)
    os.killpg(process.pid, number)  # as a terminal does
    _, err = process.communicate(timeout=10)
    assert process.returncode == code
    assert ("finished decks stay" in err) == (number == signal.SIGINT)
    assert gone(workers)
    assert not hidden(tmp_path / "out")
    for record in (tmp_path / "out" / FOLDER).glob("*.json"):
        assert (tmp_path / "out" / f"{record.stem}.out").read_bytes().endswith(b"REPORT\n")
    assert run(*many, "-o", tmp_path / "out")[0] == 0


def test_two_batches_do_not_share_a_folder(decks, tmp_path, monkeypatch):
    import fcntl

    (tmp_path / "out" / FOLDER).mkdir(parents=True)
    monkeypatch.setattr("trunnion.many.batch.PATIENCE", 0.1)
    with (tmp_path / "out" / FOLDER / "lock").open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        with pytest.raises(trunnion.BatchError, match="another batch is at work"):
            trunnion.batch(decks, tmp_path / "out")


# ------------------------------------------------------------------ what it imports and shows
def test_neither_dask_nor_rich_is_imported_unless_asked(decks, tmp_path):
    script = (
        "import sys, trunnion\n"
        f"trunnion.batch({[str(d) for d in decks]!r}, {str(tmp_path / 'out')!r})\n"
        "print(sorted({'distributed', 'dask', 'rich'} & set(sys.modules)))\n"
    )
    found = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert found.stdout == "[]\n"


def test_progress_is_silent_for_two_seconds_then_plain_lines(capsys):
    from trunnion.report.progress import progress

    with progress("decks", 3) as counter:
        counter.step("a.inp certified")
        counter.begun -= 10.0
        counter.step("b.inp certified")
        counter.tick()
    assert capsys.readouterr().err == "2/3 b.inp certified\n"


def test_a_terminal_gets_a_bar(monkeypatch, capsys):
    from trunnion.report.progress import progress

    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm")
    with progress("decks", 3) as counter:
        counter.begun -= 10.0
        counter.step("a.inp certified")
        counter.tick()
        assert counter.bar is not None
    assert "a.inp" not in capsys.readouterr().err
