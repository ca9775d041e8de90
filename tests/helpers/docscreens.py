"""Screens in the documentation: made by the program on a terminal, and compared by the tests.

    python tests/helpers/docscreens.py        write every screen again

A screen is a fenced block `console screen`; plain `console` blocks are piped (`consoles`).  Its
commands run one after another in a folder with the models beside it; `<!-- 60x24 -->` above a
block gives another terminal than 80x24.
"""

import re
import shlex
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from consoles import blurred
from terminal import on_terminal

ROOT = Path(__file__).parents[2]
PAGES = ("terminal.md", "verify_diff_show.md", "many.md")
BLOCK = re.compile(r"(?:<!-- (\d+)x(\d+) -->\n)?```console screen\n(.*?)```\n", re.DOTALL)


def blocks(page: str) -> Iterator[re.Match[str]]:
    """Screens of a page."""
    return BLOCK.finditer((ROOT / "docs" / page).read_text())


def home(folder: Path) -> Path:
    """A folder as the documentation has it."""
    shutil.copytree(ROOT / "models", folder / "models")
    return folder


def made(block: re.Match[str], folder: Path) -> str:
    """Run the commands of a block; give the block as the program makes it."""
    size = (int(block[1] or 80), int(block[2] or 24))
    text = ""
    for line in block[3].splitlines():
        if not line.startswith("$ "):
            continue
        text += f"{line}\n"
        for command in line[2:].split(" && "):
            text += _said(shlex.split(command), folder, size)
    return text


def _said(words: list[str], folder: Path, size: tuple[int, int]) -> str:
    """Run one command; give what it shows."""
    name, *words = words
    if name == "cp":
        shutil.copy(folder / words[0], folder / words[1])
        return ""
    if name == "sed":  # -i s/a/b/ FILE
        _, old, new, _ = words[1].split("/")
        file = folder / words[2]
        file.write_text(file.read_text().replace(old, new))
        return ""
    assert name == "trunnion", name
    quiet = ">" in words
    words = words[: words.index(">")] if quiet else words
    found = on_terminal(words, size=size, cwd=folder)
    return "" if quiet else "".join(f"{row}\n" for row in found.screen)


def write() -> None:
    """Write every screen again."""
    for page in PAGES:
        with tempfile.TemporaryDirectory() as place:
            folder = home(Path(place))
            path, at, out = ROOT / "docs" / page, 0, ""
            text = path.read_text()
            for block in BLOCK.finditer(text):
                start, end = block.span(3)
                new = made(block, folder)
                old = text[start:end]
                out += text[at:start] + (old if blurred(new) == blurred(old) else new)
                at = end
            path.write_text(out + text[at:])


if __name__ == "__main__":
    write()
