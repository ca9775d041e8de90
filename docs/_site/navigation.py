"""The navigation is the list of links on the front page, part by part.

Sphinx wants its own directive for it, which a forge would show as text; so index.md has plain
lists, and this extension writes the directives behind them while the page is read.
"""

import re
from typing import Any

PART = re.compile(r"^## (.+)$")
ENTRY = re.compile(r"^- \[(.+?)\]\(([\w/]+)\.md\)")


def parts(front: str) -> dict[str, list[tuple[str, str]]]:
    """Give titles and names of the pages that the front page lists, by its headings."""
    found: dict[str, list[tuple[str, str]]] = {}
    part = ""
    for line in front.splitlines():
        if heading := PART.match(line):
            part = heading[1]
        elif entry := ENTRY.match(line):
            found.setdefault(part, []).append((entry[1], entry[2]))
    return found


def _add(app: Any, name: str, source: list[str]) -> None:
    """Write the directives behind the front page."""
    if name != app.config.root_doc:
        return
    for part, pages in parts(source[0]).items():
        lines = [f"{title} <{page}>" for title, page in pages]
        source[0] += "\n".join(
            ["", "```{toctree}", ":hidden:", f":caption: {part}", "", *lines, "```", ""]
        )


def setup(app: Any) -> dict[str, bool]:
    """Hand the extension to Sphinx."""
    app.connect("source-read", _add)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
