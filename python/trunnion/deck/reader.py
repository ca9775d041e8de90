"""Decks to models: every card to a record, every record to the model, all errors at once."""

import os
import re
from typing import Any

from trunnion.collector import paused
from trunnion.deck import units as un
from trunnion.deck.cards import Card, Deck, cards_of, read_cards
from trunnion.deck.checks import check
from trunnion.deck.context import Carried, Context
from trunnion.deck.directions import read_directions
from trunnion.deck.equations import read_equation
from trunnion.deck.fields import Fields, fields_of, read_fields
from trunnion.deck.interpreter import apply
from trunnion.deck.keywords import KEYWORDS
from trunnion.deck.markers import show, tidy
from trunnion.deck.record import Fault, Mark, Record
from trunnion.deck.values import nearest
from trunnion.errors import DeckError, Problem
from trunnion.model import Model, Place, Units
from trunnion.origin import InputFile

_FIRST = ("TITLE", "UNITS", "DEFAULT")
_FORMS = {name: keyword.form for name, keyword in KEYWORDS.items()}
#: how files of other programs begin, by suffix, where no deck does
_OPENINGS = {
    ".cii": r"#\$",
    ".xml": r"(?i)<(\?xml|CAESARII)",
    ".pcf": r"(?i)<?(ISOGEN-FILES|UNITS-|PIPELINE-REFERENCE)",
}
_LONGEST = 400  # characters of a message; a word of a deck may be very long


def read(path: str | os.PathLike[str]) -> Model:
    """Read a deck.

    Raises
    ------
    DeckError : with every problem of the deck, its file and line.
    """
    with paused():
        return _read(read_cards(path))


def read_sources(path: str | os.PathLike[str]) -> tuple[Model, tuple[str, ...]]:
    """Read a deck; give also the files it is made of.

    Raises
    ------
    DeckError : as `read`.
    """
    deck = read_cards(path)
    return _read(deck), tuple(deck.sources)


def read_text(text: str, file: str = "<text>") -> Model:
    """Read a deck given as text; `file` stands in the errors."""
    with paused():
        return _read(cards_of(text, file))


def _read(deck: Deck) -> Model:
    """Make the model, or raise all problems."""
    reading = _Reading(deck)
    reading.run()
    if reading.faults or deck.refusals:
        raise DeckError(_foreign(deck) or _problems(deck, reading.faults))
    if deck.digests:
        reading.model.file = InputFile(os.path.basename(deck.file), deck.digest)
    return reading.model


class _Reading:
    """One reading of a deck: model so far, and faults."""

    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.model = Model()
        self.faults: list[Fault] = []
        self.heard: list[tuple[str, Mark]] = []  # of the present card
        self.carried = Carried()
        self.context = Context(self.model, self.carried, self.faults, not deck.refusals)

    def run(self) -> None:
        """Read UNITS and DEFAULT, which hold for the whole deck, then all other cards."""
        cards = self.deck.cards
        words = [card.text.split(None, 1)[0].upper() for card in cards]
        self._units(words)
        fields = fields_of(self.model.units)
        if "DEFAULT" in words:
            for card, word in zip(cards, words, strict=True):
                if word == "DEFAULT":
                    self._card(card, word, fields)
        for card, word in zip(cards, words, strict=True):
            if word not in _FIRST:
                self._card(card, word, fields)
        self.model.carried = self.carried
        if not self.deck.refusals:  # else lines are missing, and more errors would mislead
            self.faults += check(self.model, self.carried.broken)

    def _units(self, words: list[str]) -> None:
        """Read the TITLE and UNITS cards; UNITS stands before all others."""
        seen: dict[str, Place] = {}
        for card, word in zip(self.deck.cards, words, strict=True):
            if word not in ("TITLE", "UNITS"):
                continue
            rest = card.text[len(word) :].strip()
            if word in seen:
                self._fault(card, word, f"there is one at {seen[word]} already", 0)
                continue
            seen[word] = card.place
            if word == "TITLE":
                self.model.title = rest
            else:
                self._unit_card(card, rest.split())
        before = words[: words.index("UNITS")] if "UNITS" in words else []
        if any(word not in ("UNITS", "TITLE") for word in before):
            card = self.deck.cards[len(before)]
            self._fault(card, "UNITS", "this card must be the first but TITLE", 0)

    def _unit_card(self, card: Card, names: list[str]) -> None:
        """Read UNITS length force pressure temperature."""
        kinds = ("length", "force", "pressure", "temperature")
        tables = (un.LENGTHS, un.FORCES, un.PRESSURES, un.TEMPERATURES)
        found: dict[str, str] = {}
        for i, (kind, table) in enumerate(zip(kinds, tables, strict=True)):
            spelled = {name.lower(): name for name in table}
            which = f"one of {' '.join(table)}"
            if i >= len(names):
                self._fault(card, "UNITS", f"unit of {kind} missing: {which}", None)
            elif names[i].lower() in spelled:
                found[kind] = spelled[names[i].lower()]
            else:
                self._fault(card, "UNITS", f"{kind} {names[i]} is not {which}", i + 1)
        if len(names) > 4:
            self._fault(card, "UNITS", f"word {names[4]} is not expected; four units are", 5)
        self.model.units = Units(**found)

    def _fault(self, card: Card, head: str, message: str, mark: Mark) -> None:
        """Note a fault of a card that makes no record."""
        self.faults.append(Fault(card.place, head, message, mark))

    def _card(self, card: Card, word: str, fields: Fields) -> None:
        """Read one card and apply it."""
        form = _FORMS.get(word)
        if form is None:
            self._unknown(card, word)
            return
        record = Record(word, Place(card.file, card.line))
        if form in ("equation", "list"):
            rest = card.text[len(word) :].lstrip()
            read_equation(record, rest, len(card.text) - len(rest), fields, self._hear)
        elif form == "directions":
            read_directions(record, _items(card.text), fields, self._hear)
        else:
            read_fields(record, _items(card.text), fields, self._hear)
        if not self.heard:
            apply(self.context, record)
            if len(self.faults) == self.context.before:
                return
        self.faults += [Fault(record.place, record.head, *said) for said in self.heard]
        self.heard.clear()
        self.context.give_up(record)

    def _hear(self, message: str, mark: Mark) -> None:
        """Take note of a fault of the card that is being read."""
        self.heard.append((message, mark))

    def _unknown(self, card: Card, word: str) -> None:
        """Refuse a card that no keyword fits, and its words elsewhere with it."""
        self.carried.broken.update(tidy(card.text).upper().replace("=", " ").split())
        if "=" in word:
            word = word.partition("=")[0]
        hint = nearest(word, KEYWORDS)
        also = hint or f" (keywords: {' '.join(KEYWORDS)})"
        self._fault(card, word, f"unknown keyword{also}", 0)


def _items(text: str) -> list[Any]:
    """Split a card after its keyword into words and pairs (KEY, value)."""
    if " =" in text or "= " in text or ", " in text or " ," in text or "(" in text:
        text = tidy(text)
    items: list[Any] = text.split()
    del items[0]
    for i, item in enumerate(items):
        if "=" in item:
            key, _, value = item.partition("=")
            items[i] = (key.upper(), value)
    return items


def _foreign(deck: Deck) -> list[Problem]:
    """Name a file of another program as such, where every line of it would be an error."""
    card = next(iter(deck.cards), None)
    text = card.text if card else ""
    kind = next((end for end, opening in _OPENINGS.items() if re.match(opening, text)), None)
    if card is None or kind is None:
        return []
    end = os.path.splitext(deck.file)[1].lower()
    how = "trunnion.formats.read_any reads it" if end == kind else f"call it *{kind}"
    text = f"this is no deck but begins as a file of another program ({kind}); {how}"
    return [Problem(card.place, text, show(card, 0))]


def _problems(deck: Deck, faults: list[Fault]) -> list[Problem]:
    """Put faults in the deck's order and draw their markers."""
    order = {(card.file, card.line): i for i, card in enumerate(deck.cards)}
    cards = {(card.file, card.line): card for card in deck.cards}
    found: list[tuple[int, Problem]] = []
    for i, refusal in enumerate(deck.refusals):
        marker = show(refusal.card, None) if refusal.card else ""
        found.append((-len(deck.refusals) + i, Problem(refusal.place, refusal.message, marker)))
    for fault in faults:
        place, key = fault.place, (fault.place.file, fault.place.line)
        if not place.file:  # a fault of the whole deck
            place = Place(deck.file, max(1, deck.last - 1))
        card = cards.get(key)
        marker = show(card, fault.mark) if card and len(found) < 1000 else ""
        text = fault.text if len(fault.text) <= _LONGEST else f"{fault.text[:_LONGEST]} ..."
        found.append((order.get(key, len(order)), Problem(place, text, marker)))
    found.sort(key=lambda pair: pair[0])
    return list(dict.fromkeys(problem for _, problem in found))
