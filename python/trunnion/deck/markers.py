"""Where an error stands on its card: the lines to show and the words to underline."""

import re

from trunnion.deck.cards import Card
from trunnion.deck.record import Mark

_WIDTH = 150  # characters of a line that are shown
_TIDY = re.compile(r"\s*([=,])\s*|(?<=[(])\s+|\s+(?=[)])")


def tidy(text: str) -> str:
    """Close the spaces around "=" and "," and inside parentheses: one word is one word."""
    return _TIDY.sub(lambda m: m[1] or "", text)


def show(card: Card, mark: Mark) -> str:
    """Draw the marker lines of style: the physical line and carets under the words at fault."""
    span = _span(card, mark)
    if span is None:
        return _lines(card.numbers[0], card.lines[0], [])
    # Count characters that are not spaces: joining and tidying lines keeps their order.
    seen = 0
    for number, line in zip(card.numbers, card.lines, strict=True):
        content = line.split("!", 1)[0].rstrip()
        content = content.removesuffix("&")
        columns = [i for i, c in enumerate(content) if not c.isspace()]
        hits = [columns[i - seen] for i in range(*span) if 0 <= i - seen < len(columns)]
        if hits:
            return _lines(number, line, list(range(hits[0], hits[-1] + 1)))
        seen += len(columns)
    return _lines(card.numbers[0], card.lines[0], [])


def _lines(number: int, line: str, hits: list[int]) -> str:
    """Draw one line with carets, cut to a readable width around them."""
    start = max(0, hits[0] - _WIDTH // 2) if hits and hits[-1] > _WIDTH else 0
    shown = "".join(c if c.isprintable() else "?" for c in line[start : start + _WIDTH])
    text = f"{number:>6} |  {shown.rstrip()}"
    if hits:
        length = min(len(hits), _WIDTH - (hits[0] - start))
        text += "\n" + " " * 7 + "|  " + " " * (hits[0] - start) + "^" * length
    return text


def _span(card: Card, mark: Mark) -> tuple[int, int] | None:
    """Find first and last+1 of the characters at fault, counted without spaces."""
    text = card.text
    if mark is None:
        return None
    if isinstance(mark, tuple):
        start = _solid(text[: mark[0]])
        return start, start + max(1, _solid(text[mark[0] : mark[1]]))
    words = tidy(text).split()
    if isinstance(mark, str):
        key = mark.upper()
        if key.endswith("="):
            at = next((i for i, w in enumerate(words) if w.upper().startswith(key)), None)
            if at is not None:
                mark = at
        if isinstance(mark, str):
            word = re.escape(key.removesuffix("="))
            keyword = len(words[0]) if words else 0
            found = re.compile(rf"(?<![\w.]){word}(?![\w.])", re.I).search(text, keyword)
            if found is None:
                return None
            start = _solid(text[: found.start()])
            return start, start + _solid(found[0])
    if not 0 <= mark < len(words):
        return None
    start = sum(len(w) for w in words[:mark])
    return start, start + len(words[mark])


def _solid(text: str) -> int:
    """Count the characters that are not spaces."""
    return len("".join(text.split()))
