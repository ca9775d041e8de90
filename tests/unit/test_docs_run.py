"""What the pages show is what happens: commands print it, Python examples run, decks solve."""

import doctest

import pytest
from consoles import run_page, same
from pages import PAGES, ROOT, blocks

WITH_CONSOLE = [
    p for p in PAGES if any(b.language == "console" and b.name != "screen" for b in blocks(p))
]
WITH_PYTHON = [p for p in PAGES if any(b.language == "python" and not b.name for b in blocks(p))]


@pytest.mark.parametrize("page", WITH_CONSOLE, ids=lambda p: p.stem)
def test_commands_print_what_the_page_shows(page, tmp_path):
    """python tests/helpers/consoles.py docs/PAGE.md puts what they print now into a page."""
    ran = run_page(page, tmp_path)
    assert ran
    for line, command, printed, said in ran:
        assert same(printed, said), f"{page.name}:{line}: {command}\nnow prints\n{said}"


@pytest.mark.parametrize("page", WITH_PYTHON, ids=lambda p: p.stem)
def test_python_examples_run(page, tmp_path, monkeypatch):
    """All examples of a page in one session, in a folder with its decks."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "models").symlink_to(ROOT / "models")
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    names: dict[str, object] = {}
    for block in blocks(page):
        if block.name and block.language == "deck":
            (tmp_path / block.name).write_text(block.text)
        if block.language != "python" or block.name:
            continue
        assert ">>> " in block.text, f"{page.name}:{block.line}: an example that nothing runs"
        examples = doctest.DocTestParser().get_doctest(
            block.text, names, page.name, str(page), block.line
        )
        said: list[str] = []
        failed = runner.run(examples, out=said.append, clear_globs=False).failed
        names = examples.globs
        assert not failed, "".join(said)


def test_pages_that_teach_are_run():
    assert {p.stem for p in WITH_CONSOLE} >= {"tutorial", "certificate"}
    assert {p.stem for p in WITH_PYTHON} >= {"api"}


def test_block_of_the_certificate_page_is_vm29():
    from trunnion import read
    from trunnion.deck.reader import read_text

    page = next(p for p in PAGES if p.stem == "certificate")
    deck = next(b.text for b in blocks(page) if b.name == "block.inp")
    assert read_text(deck, "block.inp") == read(ROOT / "models" / "vm29.inp")


@pytest.mark.parametrize(
    ("printed", "said", "alike"),
    [
        ("OPE: holds: worst 5.1e-15, law at 30\n", "OPE: holds: worst 7.0e-16, law at 40\n", True),
        ("OPE: FAILS: worst 1.0e-06, law at 30\n", "OPE: FAILS: worst 1.1e-06, law at 30\n", False),
        ("OPE: FAILS: worst 1.0e-06, law at 30\n", "OPE: FAILS: worst 1.0e-06, law at 40\n", False),
        ("  friction   1.4e-17  20 +Y\n", "  friction   0\n", True),
        ("  friction   1.4e-17  20 +Y\n", "  friction   2.0e-08  20 +Y\n", False),
        ("one\n...\nfour\n", "one\ntwo\nthree\nfour\n", True),
        ("one\n...\nfour\n", "one\ntwo\nthree\n", False),
        ("FX 6426.9 N\n", "FX 6426.8 N\n", False),
    ],
)
def test_a_page_is_held_to_its_numbers_and_not_to_round_off(printed, said, alike):
    assert same(printed, said) == alike
