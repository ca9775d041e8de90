"""From files to logical cards: comments, continuation, INCLUDE, and refusal of hostile input."""

import hashlib
import os
import re
import stat
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from trunnion.model import Place

MAX_BYTES = 100_000_000  # of a deck with all its includes
MAX_LINE = 4096  # characters of a physical line
MAX_CARD = 65536  # characters of a logical card
MAX_DEPTH = 8  # of INCLUDE
MAX_FILES = 1000

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")


@dataclass(slots=True)
class Card:
    """A logical card: `text` without comments and "&"; its lines for markers."""

    file: str
    line: int
    text: str
    lines: tuple[str, ...]  # as written
    numbers: tuple[int, ...]  # of these lines

    @property
    def place(self) -> Place:
        """File and line where the card starts."""
        return Place(self.file, self.line)


@dataclass(slots=True)
class Refusal:
    """A file or line that is not read; `card` shows where."""

    place: Place
    message: str
    card: Card | None = None


@dataclass(slots=True)
class Deck:
    """All cards of a deck and of its included files, in order, and what was refused."""

    file: str
    cards: list[Card] = field(default_factory=list)
    refusals: list[Refusal] = field(default_factory=list)
    last: int = 0  # line of the end of the main file
    bytes: int = 0
    files: int = 0
    sources: list[str] = field(default_factory=list)  # the deck and its includes
    digests: list[str] = field(default_factory=list)  # SHA-256 of each, in the order read

    @property
    def digest(self) -> str:
        """SHA-256 of the deck; with includes that of their digests in the order read."""
        if len(self.digests) == 1:
            return self.digests[0]
        return hashlib.sha256("".join(self.digests).encode()).hexdigest()


def read_cards(path: str | os.PathLike[str]) -> Deck:
    """Read the cards of a deck; what cannot be read is in `refusals`."""
    deck = Deck(str(path))
    text = _text_of(Path(path), deck, Place(str(path), 1), None)
    if text is not None:
        deck.last = text.count("\n") + 1
        _gather(text, str(path), (_identity(Path(path)),), deck)
    return deck


def cards_of(text: str, file: str = "<text>") -> Deck:
    """Read the cards of a deck given as text."""
    deck = Deck(file, last=text.count("\n") + 1)
    clean = _clean(text, deck, file)
    if clean is not None:
        _gather(clean, file, (), deck)
    return deck


def _identity(path: Path) -> str:
    """Name of a file that is the same by whatever path it is reached."""
    return os.path.realpath(path)


def _text_of(path: Path, deck: Deck, place: Place, card: Card | None) -> str | None:
    """Read one file; a refusal tells why not."""

    def refuse(message: str) -> None:
        deck.refusals.append(Refusal(place, message, card))

    try:
        number = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(number, "rb") as stream:
            facts = os.fstat(stream.fileno())
            if not stat.S_ISREG(facts.st_mode):
                refuse(f"{path} is no ordinary file")
                return None
            left = MAX_BYTES - deck.bytes
            data = stream.read(left + 1) if facts.st_size <= left else b" " * (left + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not a path"
        refuse(f"cannot read {path}: {reason}")
        return None
    deck.files += 1
    deck.sources.append(str(path))
    deck.digests.append(hashlib.sha256(data).hexdigest())
    deck.bytes += len(data)
    if deck.bytes > MAX_BYTES:
        refuse(f"{path}: the deck with its includes is over {MAX_BYTES // 10**6} MB")
        return None
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        refuse(f"{path} is UTF-16 text; save it as UTF-8")
        return None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        byte = f"byte 0x{data[error.start]:02X}"
        message = f"{byte} is not UTF-8 text; save the file as UTF-8 or ASCII"
        deck.refusals.append(Refusal(Place(str(path), line), message))
        return None
    return _clean(text, deck, str(path))


def _clean(text: str, deck: Deck, file: str) -> str | None:
    """Unify line ends and tabs; refuse control characters."""
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    if "\t" in text:
        text = text.replace("\t", " ")
    bad = _CONTROL.search(text)
    if bad is None:
        return text
    line = text.count("\n", 0, bad.start()) + 1
    what = "NUL byte" if bad[0] == "\0" else f"control character 0x{ord(bad[0]):02X}"
    deck.refusals.append(Refusal(Place(file, line), f"{what} in the text; is this a deck?"))
    return None


def _gather(text: str, file: str, chain: tuple[str, ...], deck: Deck) -> None:
    """Append the cards of one file; INCLUDE cards are replaced by theirs."""
    append = deck.cards.append
    for card in _logical(text, file, deck):
        word = card.text[:7]
        if word[0] in "Ii" and word.upper() == "INCLUDE" and card.text[7:8] in (" ", ""):
            _include(card, chain, deck)
        else:
            append(card)


def _logical(text: str, file: str, deck: Deck) -> Iterator[Card]:
    """Join continued lines and leave comments out."""
    pieces: list[str] = []
    lines: list[str] = []
    numbers: list[int] = []
    for number, line in enumerate(text.split("\n"), 1):
        if len(line) > MAX_LINE:
            message = f"line of {len(line)} characters; {MAX_LINE} are the limit"
            deck.refusals.append(Refusal(Place(file, number), message))
            continue
        content = (line if "!" not in line else line[: line.index("!")]).strip()
        if not content:
            continue
        if content[-1] != "&" and not pieces:
            yield Card(file, number, content, (line,), (number,))
            continue
        lines.append(line)
        numbers.append(number)
        if content[-1] == "&":
            pieces.append(content[:-1].strip())
            continue
        pieces.append(content)
        whole = " ".join(piece for piece in pieces if piece)
        card = Card(file, numbers[0], whole, tuple(lines), tuple(numbers))
        pieces, lines, numbers = [], [], []
        if len(whole) > MAX_CARD:
            message = f"card of {len(whole)} characters; {MAX_CARD} are the limit"
            deck.refusals.append(Refusal(card.place, message))
            continue
        yield card
    if pieces:
        message = "& continues this card, but no line follows"
        card = Card(file, numbers[-1], pieces[-1], (lines[-1],), (numbers[-1],))
        deck.refusals.append(Refusal(card.place, message, card))


def _include(card: Card, chain: tuple[str, ...], deck: Deck) -> None:
    """Read the file that an INCLUDE card names."""

    def refuse(message: str) -> None:
        deck.refusals.append(Refusal(card.place, f"INCLUDE: {message}", card))

    name = card.text[7:].strip()
    if len(name) > 1 and name[0] == name[-1] and name[0] in "\"'":
        name = name[1:-1]
    if not name:
        refuse("the name of a file is missing")
        return
    path = Path(card.file).parent / name
    identity = _identity(path)
    if identity in chain:
        refuse(f"{name} includes itself")
        return
    if len(chain) > MAX_DEPTH:
        refuse(f"files are nested more than {MAX_DEPTH} deep")
        return
    if deck.files >= MAX_FILES:
        refuse(f"more than {MAX_FILES} files")
        return
    text = _text_of(path, deck, card.place, card)
    if text is not None:
        _gather(text, str(path), (*chain, identity), deck)
