"""Hostile files are refused by name, soon, and without reading on."""

import os
import random
import time

import pytest

import trunnion
from trunnion.deck import cards
from trunnion.deck.reader import read_text

GOOD = "MATERIAL A E=2e11\nSECTION S OD=0.2 WALL=0.01\nANCHOR 1\nPIPE 1 2 DX=1\nCASE A = W\n"
SEED = 3


def refusal(path):
    with pytest.raises(trunnion.DeckError) as caught:
        trunnion.read(path)
    return caught.value


def test_missing_file_is_named(tmp_path):
    assert "cannot read" in str(refusal(tmp_path / "none.inp"))


def test_path_with_nul_is_refused():
    assert "cannot read" in str(refusal("a\0b.inp"))


def test_folder_is_refused(tmp_path):
    assert "Is a directory" in str(refusal(tmp_path))


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null", "/dev/stdin"])
def test_device_is_refused(device):
    assert "is no ordinary file" in str(refusal(device))


def test_pipe_without_writer_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "fifo.inp")
    assert "is no ordinary file" in str(refusal(tmp_path / "fifo.inp"))


def test_too_large_file_is_not_read(tmp_path):
    path = tmp_path / "large.inp"
    with path.open("wb") as stream:
        stream.truncate(cards.MAX_BYTES + 1)  # sparse
    assert "over 100 MB" in str(refusal(path))


def test_includes_together_have_a_limit(tmp_path, monkeypatch):
    monkeypatch.setattr(cards, "MAX_BYTES", 2000)
    (tmp_path / "part.inp").write_text("! " + "x" * 900 + "\n")
    (tmp_path / "main.inp").write_text("INCLUDE part.inp\n" * 4 + GOOD)
    error = refusal(tmp_path / "main.inp")
    assert [p.place.line for p in error.problems] == [3, 4]
    assert "over 0 MB" in str(error)


def test_includes_that_double_stop(tmp_path):
    for i in range(12):
        body = f"INCLUDE {i + 1}.inp\n" * 4
        (tmp_path / f"{i}.inp").write_text(body)
    (tmp_path / "12.inp").write_text(GOOD)
    start = time.monotonic()
    assert "nested more than 8 deep" in str(refusal(tmp_path / "0.inp"))
    assert time.monotonic() - start < 30


def test_files_that_include_each_other_stop(tmp_path):
    (tmp_path / "a.inp").write_text("INCLUDE b.inp\n")
    (tmp_path / "b.inp").write_text(GOOD + f"INCLUDE ../{tmp_path.name}/a.inp\n")
    error = refusal(tmp_path / "a.inp")
    assert len(error.problems) == 1
    assert error.problems[0].place.line == 6
    assert str(error.problems[0].place.file).endswith("b.inp")
    assert "includes itself" in str(error)


def test_file_included_twice_in_turn_is_no_recursion(tmp_path):
    (tmp_path / "a.inp").write_text("MASS 2 M=1\n")
    (tmp_path / "main.inp").write_text(GOOD + "INCLUDE a.inp\nINCLUDE a.inp\n")
    assert len(trunnion.read(tmp_path / "main.inp").masses) == 2


def test_error_in_an_included_file_names_that_file(tmp_path):
    (tmp_path / "a.inp").write_text("! nothing\nMASS 2 N=1\n")
    (tmp_path / "main.inp").write_text(GOOD + "INCLUDE a.inp\n")
    (problem,) = refusal(tmp_path / "main.inp").problems
    assert str(problem).startswith(f"{tmp_path / 'a.inp'}:2: MASS 2: N is no key")


def test_long_card_is_refused():
    card = "COMB B = A " + "&\n + A " * 40000
    with pytest.raises(trunnion.DeckError, match="are the limit"):
        read_text(GOOD + card)


def test_long_sum_is_refused():
    with pytest.raises(trunnion.DeckError, match="more than 200 names"):
        read_text(GOOD + "COMB B = A" + " + A" * 300)


def test_long_sum_within_the_limit_reads_and_writes():
    model = read_text(GOOD + "COMB B = A" + " + A" * 199)
    assert read_text(model.deck()) == model


def test_many_errors_are_counted_and_the_first_are_shown():
    text = GOOD + "PIPPE 2 3 DX=1\n" * 5000 + "SUPPORT 99 +Y\n" * 2000
    start = time.monotonic()
    with pytest.raises(trunnion.DeckError) as caught:
        read_text(text)
    assert time.monotonic() - start < 30
    assert str(caught.value).endswith("... and 6800 more\n7000 errors, nothing was solved")


def test_a_long_loop_of_cases_is_told():
    text = GOOD + "".join(f"CASE C{i} = W FROM=C{(i + 1) % 3000}\n" for i in range(3000))
    with pytest.raises(trunnion.DeckError, match="needs itself"):
        read_text(text)


def problems_of(text):
    """Problems of a deck; any other exception than a DeckError ends the test."""
    try:
        read_text(text)
    except trunnion.DeckError as error:
        return error.problems
    return ()


def test_random_damage_gives_named_errors_only():
    rng = random.Random(SEED)
    deck = GOOD + "SUPPORT 2 +Y GUIDE GAP=3mm (1,0,0) MU=0.3 ALONG=1-2\nCOMB B = -2*(A + A)\n"
    deck += "UNITS mm kN bar C\nTITLE x\nBEND 1 R=3\nINCLUDE a\nDEFAULT MU=1\n"
    deck += "CASE C = U(1,2,3)+W FROM=A\n"
    signs = "=&!()*+-,./ \n\tAZ09é\u2028\u00a0\u0660½\"'_%#"
    refused = 0
    for _ in range(1000):
        text = list(deck)
        for _ in range(rng.randint(1, 12)):
            i = rng.randrange(len(text))
            match rng.randrange(3):
                case 0:
                    text[i] = rng.choice(signs)
                case 1:
                    del text[i : i + rng.randint(1, 9)]
                case _:
                    text.insert(i, rng.choice(signs) * rng.randint(1, 3))
        problems = problems_of("".join(text))
        refused += bool(problems)
        assert all(p.place.line > 0 and p.text for p in problems), f"seed {SEED}"
    assert refused > 700
