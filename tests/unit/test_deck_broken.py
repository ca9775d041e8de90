"""Every deck in tests/broken is refused with the lines and causes that stand on its top."""

import re
from pathlib import Path

import pytest

import trunnion

BROKEN = Path(__file__).parents[1] / "broken"
DECKS = sorted(BROKEN.glob("*.inp"))


def expected(path: Path) -> list[tuple[int, str]]:
    """Lines "! error LINE: TEXT" on top of a deck."""
    data = path.read_bytes()
    text = data.decode("utf-16" if data[:2] == b"\xff\xfe" else "latin-1")
    return [(int(a), b.strip()) for a, b in re.findall(r"^! error (\d+): (.*)$", text, re.M)]


def test_there_are_many():
    assert len(DECKS) >= 60


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_broken_deck_is_refused_with_line_and_cause(path, monkeypatch):
    monkeypatch.chdir(BROKEN)  # messages name the file as it was given
    wanted = expected(path)
    with pytest.raises(trunnion.DeckError) as caught:
        trunnion.read(path.name)
    found = [(problem.place.line, problem.text) for problem in caught.value.problems]
    assert len(found) == len(wanted), str(caught.value)
    for (line, text), (wanted_line, wanted_text) in zip(found, wanted, strict=True):
        assert (line, wanted_text) == (wanted_line, text[: len(wanted_text)]), str(caught.value)
    count = "1 error" if len(wanted) == 1 else f"{len(wanted)} errors"
    assert str(caught.value).splitlines()[-1] == f"{count}, nothing was solved"


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_command_answers_exit_2_and_writes_nothing(path, monkeypatch, capsys, tmp_path):
    from trunnion import cli

    monkeypatch.chdir(BROKEN)
    monkeypatch.setattr(cli.signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as end:
        cli.main(["run", path.name, "-o", str(tmp_path)])
    assert end.value.code == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "Traceback" not in err
    assert all(f":{line}: " in err for line, _ in expected(path))
    assert list(tmp_path.iterdir()) == []


def test_marker_lines_are_those_of_the_house():
    text = (
        "SECTION S OD=1 WALL=0.1\nMATERIAL A E=1\nPIPE 10 20 &\n   DX=6  DZZ=2 ! four\nCASE A = W\n"
    )
    from trunnion.deck.reader import read_text

    with pytest.raises(trunnion.DeckError) as caught:
        read_text(text, "loop.inp")
    lines = str(caught.value).splitlines()
    assert lines[0].startswith("loop.inp:3: PIPE 10 20: DZZ is no key of PIPE; nearest: DZ")
    assert lines[1] == "     4 |     DX=6  DZZ=2 ! four"
    assert lines[2] == "       |           ^^^^^"
    assert lines[3] == "1 error, nothing was solved"
