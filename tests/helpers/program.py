"""The program as a command, in this process."""

from pathlib import Path

import pytest

from trunnion.cli import main


def leave(*arguments: object) -> int:
    """Exit status of `trunnion` with these words."""
    with pytest.raises(SystemExit) as stop:
        main([str(a) for a in arguments])
    return stop.value.code


def stored(folder: Path, deck: str) -> bytes:
    """JSON of a deck that is run as a.inp in a folder."""
    (folder / "a.inp").write_text(deck)
    assert leave("run", folder / "a.inp", "-o", folder) == 0
    return (folder / "a.json").read_bytes()
