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
