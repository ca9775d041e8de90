"""What the README shows has to work as shown."""

from pathlib import Path
from textwrap import dedent

import trunnion

README = Path(__file__).parents[2] / "README.md"


def test_the_deck_of_the_readme_is_certified(tmp_path):
    block = README.read_text().split("## A deck\n")[1].split("\nUnits follow")[0]
    deck = tmp_path / "header.inp"
    deck.write_text(dedent(block))
    model = trunnion.read(deck)
    assert [case.name for case in model.cases] == ["SUS", "OPE", "EXP"]
    results = trunnion.solve(model)
    assert results["OPE"].certificate.passed
    assert results["EXP"].certificate.passed
