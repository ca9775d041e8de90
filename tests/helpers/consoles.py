"""Console blocks of a page, run as a reader would: `$ command`, then what it prints."""

import os
import re
import subprocess
import sys
from pathlib import Path

from pages import blocks


def run_page(page: Path, folder: Path) -> list[tuple[int, str, str, str]]:
    """Write the named decks of a page and run its commands: line, command, print, said now.

    A block named with its language, as in "deck line.inp", is a file of that name.
    """
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    surroundings = os.environ | {"PATH": path, "COLUMNS": "100", "NO_COLOR": "1"}
    ran = []
    for block in blocks(page):
        if block.name and block.language in ("deck", "python"):
            (folder / block.name).write_text(block.text, encoding="utf-8")
        if block.language != "console" or block.name == "screen":  # `docscreens` has a terminal
            continue
        for line, command, printed in commands(block.text, block.line):
            done = subprocess.run(
                ["bash", "-c", command], cwd=folder, env=surroundings, text=True, check=False,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            )  # fmt: skip
            ran.append((line, command, printed, done.stdout))
    return ran


def commands(text: str, at: int) -> list[tuple[int, str, str]]:
    """Split a console block: line, command, and what the page says that it prints."""
    found: list[tuple[int, str, str]] = []
    for number, line in enumerate(text.splitlines(), at + 1):
        if line.startswith("$ "):
            found.append((number, line[2:], ""))
        else:
            first, command, printed = found[-1]
            found[-1] = first, command, f"{printed}{line}\n"
    return found


def tidy(text: str) -> str:
    """Print without blanks at the ends of lines."""
    return "".join(f"{line.rstrip()}\n" for line in text.splitlines())


ITEM = re.compile(r"^ +([a-z_]+) +(0|\d\.\de-[0-3]\d)( .*)?$", re.MULTILINE)
ROUND_OFF = re.compile(r" *\b\d\.\de-(09|[123]\d)\b")
WORST = re.compile(r"(worst ~|fewest at).*$", re.MULTILINE)


def blurred(text: str) -> str:
    """A print without what is round-off: its digits and its place are no machine's promise."""

    def item(found: re.Match[str]) -> str:
        return f"  {found[1]} ~" if float(found[2]) <= 1e-9 else found[0]

    return WORST.sub(r"\1", ROUND_OFF.sub(" ~", ITEM.sub(item, tidy(text))))


def same(printed: str, said: str) -> bool:
    """Whether a command said what the page prints; a line of three points stands for any lines."""
    parts = re.split(r"^\.\.\.\n", blurred(printed), flags=re.MULTILINE)
    return re.fullmatch(r"(?:.*\n)*".join(map(re.escape, parts)), blurred(said)) is not None


def rewrite(page: Path, folder: Path) -> None:
    """Put what the commands say now into a page; prints with points are left alone."""
    lines = page.read_text(encoding="utf-8").splitlines()
    for line, _, printed, said in reversed(run_page(page, folder)):
        if "...\n" not in printed:
            lines[line : line + printed.count("\n")] = tidy(said).splitlines()
    page.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")


if __name__ == "__main__":
    from tempfile import TemporaryDirectory

    for name in sys.argv[1:]:
        with TemporaryDirectory() as place:
            rewrite(Path(name), Path(place))
