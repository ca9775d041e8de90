"""Colours of a deck: keywords from the keyword table, keys, comments, numbers with their units."""

import re
from typing import Any

from pygments.lexer import RegexLexer, bygroups, words
from pygments.token import Comment, Keyword, Name, Number, Operator, Text

from trunnion.deck.keywords import TABLE


class DeckLexer(RegexLexer):  # type: ignore[misc]
    """Cards of a deck."""

    name = "Trunnion deck"
    aliases = ("deck",)
    flags = re.IGNORECASE | re.MULTILINE
    tokens = {  # noqa: RUF012
        "root": [
            (r"!.*$", Comment),
            (words([k.name for k in TABLE], prefix=r"^\s*", suffix=r"\b"), Keyword),
            (r"([A-Z]\w*)(=)", bygroups(Name.Attribute, Operator)),
            (r"[A-Z_][\w.]*", Name),
            (r"[+-]?\d+(\.\d*)?(e[+-]?\d+)?[A-Z%/.0-9]*", Number),
            (r"\S", Text),
            (r"\s+", Text),
        ]
    }


def setup(app: Any) -> dict[str, bool]:
    """Hand the lexer to Sphinx."""
    app.add_lexer("deck", DeckLexer)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
