"""Remake the pictures of docs/gallery.md by the commands that stand in it (make gallery)."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).parent
ROOT = DOCS.parent
COMMAND = re.compile(r"^    (trunnion .*)$", re.MULTILINE)
PICTURE = re.compile(r"!\[[^\]]*\]\((gallery/[^)]+)\)")


def commands(text: str) -> list[list[str]]:
    """Commands of the page, each once, as words without the program's name."""
    return [shlex.split(line)[1:] for line in dict.fromkeys(COMMAND.findall(text))]


def pictures(text: str) -> list[str]:
    """Pictures of the page, as it names them."""
    return PICTURE.findall(text)


def main() -> None:
    """Run the commands and keep the pictures that the page shows."""
    text = (DOCS / "gallery.md").read_text(encoding="utf-8")
    made = ROOT / "build" / "gallery"
    shutil.rmtree(made, ignore_errors=True)
    for words in commands(text):
        print("trunnion", *words, flush=True)
        subprocess.run([sys.executable, "-m", "trunnion", *words], cwd=ROOT, check=True)
    wanted = [Path(name).name for name in pictures(text)]
    kept = DOCS / "gallery"
    kept.mkdir(exist_ok=True)
    for old in kept.glob("*.png"):
        old.unlink()
    for name in wanted:
        shutil.copy(made / name, kept / name)
    size = sum((kept / name).stat().st_size for name in set(wanted))
    print(f"{len(set(wanted))} pictures in docs/gallery, {size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
