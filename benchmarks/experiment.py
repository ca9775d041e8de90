"""How much is measured: sizes, programs and limits of the quick and the full run."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

Row = dict[str, Any]
CASES = ("lin", "gap", "fric1", "fric10")
OURS = ("newton", "status")
PEERS = ("opensees", "opensees_norm", "pynite", "calculix")


@dataclass(frozen=True, slots=True)
class Scope:
    """One run of everything.

    references : folder for answers to compare with.
    sizes : nodes of the racks.  limit : seconds that one run of another program may take.
    budget, most : seconds and rounds spent on repeating a point.
    patience : seconds that a run of Trunnion may take.
    """

    name: str
    references: Path
    sizes: tuple[int, ...]
    limit: float
    budget: float
    most: int
    patience: float
    small: int  # nodes of the sweeps
    spent: tuple[int, ...]  # nodes of the profiles
    cards: int  # nodes of the long deck


def quick(references: Path) -> Scope:
    """A minute or two: whether everything works, and rough numbers."""
    return Scope("quick", references, (50, 200, 1000), 5.0, 0.5, 5, 60.0, 50, (1000,), 1000)


def full(references: Path) -> Scope:
    """What stands in the docs."""
    sizes = (50, 200, 1000, 5000, 20_000, 100_000)
    return Scope("full", references, sizes, 40.0, 3.0, 9, 600.0, 200, (1000, 5000, 100_000), 20_000)
