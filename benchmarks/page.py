"""Pages made from the tables of a run: the report, docs/benchmarks.md, and a part of the README."""

import re
from pathlib import Path

from machine import load as load_note
from store import duration, length, markdown, nodes, times
from tables import TABLES, machine_table, read, sizes
from targets import Tables, find

ROOT = Path(__file__).parents[1]
TEMPLATE = Path(__file__).with_name("page.md")
DOCS = ROOT / "docs" / "benchmarks"
PAGE, README = ROOT / "docs" / "benchmarks.md", ROOT / "README.md"
BEGIN = "<!-- made by `make bench-docs` from docs/benchmarks/*.csv: do not edit -->"
END = "<!-- end -->"
FIELD = re.compile(r"^\{\{(table|picture) (\w+)(?: ([^}]*))?\}\}$", re.MULTILINE)
NOT_MEASURED = "*Not measured in this run.*\n"


def render(folder: Path, link: str) -> str:
    """The whole page from the tables in a folder, which stands at `link` as the page sees it."""
    tables, note = read(folder), load_note(folder)

    def field(match: re.Match[str]) -> str:
        kind, name, text = match.groups()
        if kind == "picture":
            there = (folder / f"{name}.png").exists()
            return f"![{text}]({link}{name}.png)" if there else NOT_MEASURED.strip()
        if name == "machine":
            return machine_table(note).rstrip("\n")
        made = TABLES[name](tables)
        return (made if made.count("\n") > 2 else NOT_MEASURED).rstrip("\n")

    return FIELD.sub(field, TEMPLATE.read_text())


def what_it_takes(tables: Tables) -> str:
    """The README's table: work, time, error and certificate by size."""
    rows = [row for row in tables["racks"] if row["program"] == "newton"]
    body = []
    for n in sizes(rows):
        lin, gap, fric = (find(rows, n=n, case=case) for case in ("lin", "gap", "fric1"))
        four = [row for row in rows if row["n"] == n]
        errors = [row["error"] for row in four if "error" in row]
        body.append(
            [
                nodes(n),
                *(duration(row.get("seconds")) for row in (lin, gap, fric)),
                *(row.get("factorise", "") for row in (gap, fric)),
                times(fric.get("floors")),
                length(max(errors, default=None)),
                f"{max(row.get('worst', 0.0) for row in four):.0e}",
            ]
        )
    head = (
        "nodes", "two-way", "gaps", "friction", "factorisations, gaps", "with friction",
        "friction, in floors", "largest error", "worst certificate item",
    )  # fmt: skip
    return markdown(head, body)


def readme_part(folder: Path) -> str:
    """What stands between the marks of the README."""
    note = load_note(folder)
    where = f"On {note.get('processor', 'an unknown machine')}, one thread"
    return f"{BEGIN}\n{what_it_takes(read(folder))}\n{where}, commit {note.get('commit')}.\n{END}"


def with_part(readme: str, part: str) -> str:
    """The README with its made part replaced."""
    before, rest = readme.split(BEGIN)
    _, after = rest.split(END)
    return before + part + after


def refresh_docs() -> None:
    """Write docs/benchmarks.md and the README's table from docs/benchmarks/."""
    PAGE.write_text(render(DOCS, "benchmarks/"))
    README.write_text(with_part(README.read_text(), readme_part(DOCS)))
