"""The verification record as a page, and the rows of that page read back."""

import re

from published import KINDS, ROWS, Row, Source, half_unit

TOP = """\
# Verification record

Every published number that the tests in `tests/verification` compare, beside the one that this
program finds. These tests make the page: each comparison below is an assertion there, a changed
number fails it, and a row that no test compares any more fails, too. `make verification-record`
writes the page anew; `trunnion run models/NAME.inp` repeats a deck by hand.

- *difference*: `=` where our number rounds to the printed digits; else relative to the print.
- *allowed*: what the test allows. *last digit* is half a unit of the last printed one; any wider
  limit has its reason in the text above its table. *not met* numbers are listed first, with what
  is known of them: the test asserts the number that is found, and nothing is tuned to meet a print.

Not on this page: the printed tables behind the libraries of materials and pipe sizes
(`tests/unit/test_materials.py`, `tests/unit/test_sections.py`); closed forms of single elements and
supports (`tests/unit`), the exact judges of 20 000 random scenes ([stability](stability.md)), other
programs on the same models ([benchmarks](benchmarks.md), [confirmed](export.md)), and jobs with
[printed results of CAESAR II](caesar.md#compared-with-printed-results), which are not in this
repository.
"""
HEAD = "| number | published | ours | difference | allowed |\n|---|---:|---:|---:|---|"


def page(rows: dict[Source, dict[str, Row]]) -> str:
    """Write the page."""
    by_kind = {kind: sorted((s for s in rows if s.kind == kind), key=_order) for kind in KINDS}
    parts = [TOP, _summary(by_kind, rows), _open(by_kind, rows)]
    for kind, sources in by_kind.items():
        parts.append(f"## {kind}\n")
        parts += [_section(source, rows[source]) for source in sources]
    return "\n".join(parts)


def _order(source: Source) -> str:
    return source.title


def _anchor(title: str) -> str:
    """Make the anchor of a heading, as forges and the site do."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def _summary(by_kind: dict[str, list[Source]], rows: dict[Source, dict[str, Row]]) -> str:
    lines = [
        "| problem | numbers | to all printed digits | largest difference of those met | not met |",
        "|---|---:|---:|---:|---:|",
    ]
    for sources in by_kind.values():
        for source in sources:
            own = list(rows[source].values())
            met = [row for row in own if not row.remark]
            far = max((_percent(row) for row in met), default=0.0)
            exact = sum(difference(row) == "=" for row in met)
            shown = f"{far:.2g} %" if far else "="
            lines.append(
                f"| [{source.title}](#{_anchor(source.title)}) | {len(own)} | {exact} | {shown} "
                f"| {len(own) - len(met) or ''} |"
            )
    every = [row for own in rows.values() for row in own.values()]
    left = sum(bool(row.remark) for row in every)
    exact = sum(difference(row) == "=" for row in every)
    lines.append(f"| all | {len(every)} | {exact} | | {left} |")
    told = (
        f"{len(every)} numbers of {len(rows)} problems: {exact} are met to all printed digits, "
        f"{len(every) - exact - left} within the limit that is stated, {left} are not met.\n"
    )
    return "\n".join([told, *lines, ""])


def _open(by_kind: dict[str, list[Source]], rows: dict[Source, dict[str, Row]]) -> str:
    lines = [
        "## What does not come out\n",
        "| problem | number | published | ours | difference | what is known |",
        "|---|---|---:|---:|---:|---|",
    ]
    for sources in by_kind.values():
        for source in sources:
            title, said = f"[{source.title}](#{_anchor(source.title)})", ""
            for row in rows[source].values():
                if row.remark:
                    why = "as above" if row.remark == said else row.remark
                    lines.append(
                        f"| {title} | {row.what} | {row.printed} | {row.ours} | {difference(row)} "
                        f"| {why} |"
                    )
                    title, said = "", row.remark
    return "\n".join([*lines, ""])


def _section(source: Source, rows: dict[str, Row]) -> str:
    deck = f" Deck: [`{source.deck}.inp`](../models/{source.deck}.inp)." if source.deck else ""
    lines = [f"### {source.title}\n", f"{source.text}{deck}\n", HEAD]
    lines += [
        f"| {row.what} | {row.printed} | {row.ours} | {difference(row)} | {row.allowed} |"
        for row in rows.values()
    ]
    return "\n".join([*lines, ""])


def difference(row: Row) -> str:
    """Say how far our number is from the print, from the digits that the page shows."""
    try:
        printed, ours = float(row.printed), float(row.ours)
    except ValueError:
        return ""
    if abs(ours - printed) <= 1.001 * half_unit(row.printed) and not row.remark:
        return "="
    return f"{100 * (ours / printed - 1):+.2g} %" if printed else f"{ours:+.2g}"


def _percent(row: Row) -> float:
    text = difference(row)
    return abs(float(text[:-2])) if text.endswith("%") else 0.0


def read(text: str) -> dict[str, dict[str, tuple[str, str, str]]]:
    """Read the rows of a page: title -> number -> published, ours, allowed."""
    found: dict[str, dict[str, tuple[str, str, str]]] = {}
    own: dict[str, tuple[str, str, str]] = {}
    for line in text.splitlines():
        if line.startswith("### "):
            own = found.setdefault(line[4:], {})
        elif line.startswith("| ") and found:
            what, printed, ours, _, allowed = (cell.strip() for cell in line.strip("|").split("|"))
            if what != "number":
                own[what] = printed, ours, allowed
    return found


def stale(text: str, *, whole: bool) -> list[str]:
    """Say where a page is not what the tests of this session found; all of it after a `whole` run.

    Numbers of ours are compared to the last digit shown, not to the last bit.
    """
    committed, said = read(text), []
    for source, rows in ROWS.items():
        known = committed.get(source.title, {})
        for what, row in rows.items():
            printed, ours, allowed = known.get(what, ("nothing", "nothing", "nothing"))
            if (printed, allowed) != (row.printed, row.allowed) or not _same(ours, row.ours):
                said.append(
                    f"{source.title}: {what}: the page has {printed}, {ours} ({allowed}), the test "
                    f"{row.printed}, {row.ours} ({row.allowed})"
                )
    if whole:
        titles = {source.title: rows for source, rows in ROWS.items()}
        said += [
            f"{title}: {what}: no test compares it"
            for title, rows in committed.items()
            for what in rows
            if what not in titles.get(title, {})
        ]
        if not said and _words(text) != _words(page(ROWS)):
            said.append("the text around the numbers is another")
    return said


def _same(a: str, b: str) -> bool:
    """Whether two shown numbers are the same to one unit of their last digit."""
    try:
        return abs(float(a) - float(b)) <= 2.002 * max(half_unit(a), half_unit(b))
    except ValueError:
        return a == b


def _words(text: str) -> list[str]:
    """The page without its tables, whose numbers are compared by themselves."""
    return [line for line in text.splitlines() if not line.startswith("|")]
