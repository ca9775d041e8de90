"""The gallery names pictures that exist, and commands that make them."""

import importlib.util
from pathlib import Path

import pytest

from trunnion.cli import main
from trunnion.report.outputs import OUTPUTS

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "gallery.md").read_text(encoding="utf-8")


def tool():
    """docs/gallery.py, which is no part of the package."""
    spec = importlib.util.spec_from_file_location("gallery", DOCS / "gallery.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


COMMANDS, PICTURES = tool().commands(PAGE), tool().pictures(PAGE)


def test_the_gallery_shows_what_is_there_and_nothing_is_there_unseen():
    there = {f"gallery/{path.name}" for path in (DOCS / "gallery").iterdir()}
    assert set(PICTURES) == there
    assert len(PICTURES) == len(there)
    assert sum((DOCS / name).stat().st_size for name in there) < 2e6
    for name in there:
        assert (DOCS / name).read_bytes().startswith(b"\x89PNG")


def test_every_picture_has_its_command_and_a_sentence():
    for part in PAGE.split("\n    trunnion ")[1:]:
        command, _, rest = part.partition("\n")
        stem = Path(command.split()[1]).stem
        assert tool().pictures(rest)
        for name in tool().pictures(rest):
            assert Path(name).name.startswith(f"{stem}.")
            after = rest.partition(f"({name})")[2].strip()
            assert after[0].isupper()
            assert "." in after.partition("\n\n")[0]


@pytest.mark.parametrize("words", COMMANDS, ids=[Path(words[1]).stem for words in COMMANDS])
def test_the_commands_of_the_gallery_make_its_pictures(words, tmp_path, monkeypatch):
    assert OUTPUTS["png"].module == "trunnion.report.plots"
    monkeypatch.setattr("trunnion.report.plots.png", lambda figure: b"drawn")
    monkeypatch.chdir(DOCS.parent)
    there = words.index("-o") + 1
    assert words[there] == "build/gallery"  # where docs/gallery.py looks for them
    with pytest.raises(SystemExit) as stop:
        main([*words[:there], str(tmp_path), *words[there + 1 :]])
    assert stop.value.code == 0
    stem = Path(words[1]).stem
    wanted = {Path(p).name for p in PICTURES if Path(p).name.startswith(f"{stem}.")}
    assert wanted
    assert wanted <= {path.name for path in tmp_path.iterdir()}
