"""CASE and COMB cards: name = expression KEY=VALUE ..."""

import re

from trunnion.deck import expressions as ex
from trunnion.deck.fields import Complain, Fields, read_key
from trunnion.deck.keywords import KEYWORDS
from trunnion.deck.record import Mark, Record

_KEYS = re.compile(r"(?:^|\s)([A-Z_0-9]+)=", re.I)
_NAME = re.compile(r"[A-Z_][A-Z0-9_.]{0,31}")


def read_equation(record: Record, text: str, at: int, fields: Fields, complain: Complain) -> None:
    """Fill a CASE or COMB from "name = expression KEY=VALUE ...", which starts at `at`."""
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
    check_case_name(record, (at, at + len(name)), complain)
    start = at + text.index("=") + 1
    keys_from = len(rest)
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
    read_expression(record, rest[:keys_from], start, complain)


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
