"""Markdown pages of docs/ and what stands in them: fenced blocks, code spans, links, anchors."""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.glob("*.md"))
FENCE = re.compile(r"^```(\S*) ?(.*)$")


@dataclass(frozen=True)
class Block:
    """A fenced block: language, the rest of its first line, text, and the line it begins on."""

    language: str
    name: str
    text: str
    line: int


def blocks(page: Path) -> list[Block]:
    """Fenced blocks of a page."""
    found, open_at, lines = [], 0, page.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        if open_at and line == "```":
            fence = FENCE.match(lines[open_at - 1])
            body = "".join(f"{text}\n" for text in lines[open_at : number - 1])
            found.append(Block(fence[1], fence[2], body, open_at))
            open_at = 0
        elif not open_at and line.startswith("```"):
            open_at = number
    assert not open_at, f"{page.name}:{open_at}: a block without an end"
    return found


def prose(page: Path) -> str:
    """A page with its fenced blocks left blank: lines keep their numbers."""
    text = page.read_text(encoding="utf-8")
    return re.sub(r"^```.*?^```$", lambda m: "\n" * m[0].count("\n"), text, flags=re.M | re.S)


def code(page: Path) -> list[str]:
    """Everything that is set as code: spans, fenced blocks and indented ones, line by line."""
    text = prose(page)
    spans = re.findall(r"`([^`]+)`", text.replace("\n", " "))
    indented = re.findall(r"^    (\S.*)$", text, flags=re.M)
    fenced = [line for block in blocks(page) for line in block.text.splitlines()]
    return [*spans, *indented, *fenced]


def links(page: Path) -> list[tuple[int, str]]:
    """Targets of links and pictures, with their lines; code does not count."""
    text = re.sub(r"`[^`]*`", "", prose(page))
    return [
        (number, target)
        for number, line in enumerate(text.splitlines(), 1)
        for target in re.findall(r"\]\(([^)\s]+)\)", line)
    ]


def anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as forges make them."""
    headings = re.findall(r"^#{1,6} (.+)$", prose(page), flags=re.M)
    slugs = [re.sub(r"[^\w\- ]", "", h.lower()).strip().replace(" ", "-") for h in headings]
    return {slug if slugs[:i].count(slug) == 0 else f"{slug}-{slugs[:i].count(slug)}"
            for i, slug in enumerate(slugs)}  # fmt: skip
