"""The tutorial runs as it is printed: every line of it is a doctest."""

import doctest
from pathlib import Path

TUTORIAL = Path(__file__).parents[2] / "docs" / "tutorial.md"


def test_the_tutorial_runs_as_printed(tmp_path, monkeypatch):
    text = TUTORIAL.read_text()
    deck = text.split("```deck\n")[1].split("```")[0]
    (tmp_path / "line.inp").write_text(deck)
    monkeypatch.chdir(tmp_path)
    examples = doctest.DocTestParser().get_doctest(text, {}, "tutorial.md", str(TUTORIAL), 0)
    said: list[str] = []
    result = doctest.DocTestRunner().run(examples, out=said.append)
    assert result.attempted > 40
    assert result.failed == 0, "".join(said)
