"""The reference page is what the keyword table says."""

from pathlib import Path

import pytest

from trunnion.deck.cards import cards_of
from trunnion.deck.fields import Fields
from trunnion.deck.interpreter import ACTIONS
from trunnion.deck.keywords import TABLE
from trunnion.deck.reader import read_text
from trunnion.deck.reference import EXAMPLE, page
from trunnion.deck.units import DIMENSIONS
from trunnion.model import Model, Units

ROOT = Path(__file__).parents[2]


def test_committed_page_is_up_to_date():
    committed = (ROOT / "docs" / "deck_reference.md").read_text(encoding="utf-8")
    assert committed == page(), "run: python -m trunnion.deck.reference > docs/deck_reference.md"


@pytest.mark.parametrize("keyword", TABLE, ids=lambda keyword: keyword.name)
def test_table_is_complete(keyword):
    assert keyword.meaning.endswith(".")
    assert keyword.example.split()[0] == keyword.name
    assert keyword.name in ACTIONS or keyword.name in ("UNITS", "INCLUDE")
    assert len(cards_of(keyword.example).cards) == (keyword.name != "INCLUDE")
    assert hasattr(Model, keyword.name.lower()) or keyword.name in ("UNITS", "INCLUDE")
    for key in keyword.keys:
        assert key.meaning
        assert key.kind != "number" or key.dimension in DIMENSIONS or keyword.form == "directions"


def test_examples_of_the_table_make_a_deck():
    own = {k.name: k.example for k in TABLE if k.name not in ("INCLUDE",)}
    own["SECTION"] = "SECTION S6 NPS=6 SCH=40\n" + own["SECTION"]  # that of the reducer
    lines = [own.pop("TITLE"), own.pop("UNITS"), *list(own.values())]
    lines += ["PIPE 20 30 DX=6000", "PIPE 30 40 DZ=4000", "PIPE 50 70 DX=500", "PIPE 70 25 DX=500"]
    lines += ["PIPE 25 45 DY=500", "PIPE 45 60 DY=500", "CASE SUS = W"]
    model = read_text("\n".join(lines))
    assert len(model.supports) == 4
    assert model.bends[0].radius == 0.381
    assert read_text(model.deck()) == model


def test_example_of_the_page_is_a_deck():
    model = read_text(EXAMPLE)
    assert [case.name for case in model.cases] == ["SUS", "OPE", "EXP", "HSUS", "EQX", "OCC"]
    assert model.modal.about == model.cycles[0].cases[0] == "OPE"
    assert read_text(model.deck()) == model


def test_every_key_has_a_reader():
    fields = Fields(Units())
    for keyword in TABLE:
        known = (
            fields.directions[0] if keyword.form == "directions" else fields.readers[keyword.name]
        )
        assert set(known) == {key.name for key in keyword.keys}
