"""Every deck says where it comes from and what it should give, and is easy to read."""

from pathlib import Path

import pytest

MODELS = sorted((Path(__file__).parents[2] / "models").glob("*.inp"))


@pytest.mark.parametrize("path", MODELS, ids=lambda p: p.stem)
def test_deck_names_its_source_and_expected_numbers(path):
    comments = [line for line in path.read_text().splitlines() if line.startswith("!")]
    assert any(line.startswith("! Source    ") for line in comments)
    assert any(line.startswith("! Expected  ") for line in comments)


@pytest.mark.parametrize("path", MODELS, ids=lambda p: p.stem)
def test_deck_is_plain_and_narrow(path):
    text = path.read_text()
    assert text.isascii()
    assert "\t" not in text
    assert max(len(line) for line in text.splitlines()) <= 100


def test_decks_are_all_there():
    names = {path.stem for path in MODELS}
    assert names >= {
        *("b313_s301", "b313_s302", "hovgaard", "pipe_10m", "straight_pipe", "rack_50"),
        *("rack_200", "slide_unload", "sliding_line", "strut_cycle", "strut_three"),
        *("floating_rests", "hot_header", "vm12", "vm27", "vm29"),
    }
