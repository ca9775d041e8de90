"""CASE, COMB, CYCLE and GROUP cards: name = expression or list KEY=VALUE ..."""

import re

from trunnion.deck import expressions as ex
from trunnion.deck import values as va
from trunnion.deck.fields import Complain, Fields, read_key
from trunnion.deck.keywords import KEYWORDS
from trunnion.deck.record import Mark, Record

_KEYS = re.compile(r"(?:^|\s)([A-Z_0-9]+)=", re.I)
_NAME = re.compile(r"[A-Z_][A-Z0-9_.]{0,31}")


def read_equation(record: Record, text: str, at: int, fields: Fields, complain: Complain) -> None:
    """Fill a record from "name = right side KEY=VALUE ...", which starts at `at`."""
    name, equals, rest = text.partition("=")
    form = f"write {record.keyword} name = ..."
    name = name.strip()
    if name.split() and (not equals or len(name.split()) > 1):
        record.args.append(name.split()[0].upper())
        complain(f"= missing after the name; {form}", (at, at + len(name)))
        return
    if not name:
        complain(f"name missing; {form}", None)
        return
    record.args.append(name.upper())
    if record.keyword != "GROUP":
        check_case_name(record, (at, at + len(name)), complain)
    start = at + text.index("=") + 1
    keys_from = len(rest)
    rest = _take_flags(record, rest)
    spaced = re.sub(r"(\s*)=(\s*)", lambda m: "=" + " " * (len(m[0]) - 1), rest)
    found = list(_KEYS.finditer(spaced))
    if found:
        keys_from = found[0].start()
        readers = fields.readers[record.keyword]
        for i, match in enumerate(found):
            stop = found[i + 1].start() if i + 1 < len(found) else len(spaced)
            key = match[1].upper()
            value = spaced[match.end() : stop].strip()
            span = (start + match.start(1), start + stop)
            read_key(record.keys, span, (key, value), record.keyword, readers, complain)
    right = rest[:keys_from]
    if KEYWORDS[record.keyword].form == "list":
        read_list(record, right, (start, start + len(right)), complain)
        require_keys(record, complain)
    else:
        read_expression(record, right, start, complain)


def _take_flags(record: Record, rest: str) -> str:
    """Take words that are keys without value out of the text, leaving their room blank."""
    for flag, _ in KEYWORDS[record.keyword].flags:
        found = re.search(rf"(?<=[\s)]){flag}(?=\s|$)", rest, re.I)
        if found:
            record.keys[flag] = True
            rest = rest[: found.start()] + " " * len(flag) + rest[found.end() :]
    return rest


def require_keys(record: Record, complain: Complain) -> None:
    """Complain of keys that must be there."""
    for key in KEYWORDS[record.keyword].keys:
        if key.required and key.name not in record.keys:
            complain(f"{key.name}= is missing", None)


def read_list(record: Record, text: str, span: tuple[int, int], complain: Complain) -> None:
    """Read names or labels with commas between them into the record."""
    keyword = KEYWORDS[record.keyword]
    if not text.strip():
        complain(f"nothing stands after =; write for instance {keyword.example}", None)
        return
    for part in text.split(","):
        word = part.strip()
        if len(word.split()) > 1 or not word:
            what = f"a comma is missing in {word}" if word else "a name is missing at a comma"
            complain(f"{what}; write for instance {keyword.example}", span)
            return
        try:
            record.items.append(va.label(word) if record.keyword == "GROUP" else va.name(word))
        except va.WordError as fault:
            complain(str(fault), word)


def check_case_name(record: Record, mark: Mark, complain: Complain) -> None:
    """Complain of a name that no case may have."""
    name = record.args[0]
    if not _NAME.fullmatch(name):
        complain(f"{name} is no name of a case (a letter, then letters, digits, _ or .)", mark)
    elif name in ex.RESERVED:
        complain(f"{name} is the name of a load set or function, not of a case", mark)


def read_expression(record: Record, text: str, at: int, complain: Complain) -> None:
    """Parse the expression of a CASE or COMB into the record."""
    if not text.strip():
        complain(
            f"nothing stands after =; write for instance {KEYWORDS[record.keyword].example}", None
        )
        return
    try:
        record.expression = ex.parse(text)
    except ex.ExpressionError as fault:
        complain(str(fault), (at + fault.start, at + fault.stop))
