"""Every deck of models/ against a text table of its displacements and restraint loads.

A table changes only on purpose, and the change is named in the CHANGELOG:

    python tests/regression/test_models.py            # all decks
    python tests/regression/test_models.py hovgaard   # one of them

writes tests/regression/tables/*.txt and prints the largest relative change of each.
Numbers agree to 1e-9 of themselves or of the largest of their column; a column that is only the
round-off of its kin (x y z of one kind) is measured against 1e-3 of the largest of these.
"""

import sys
from pathlib import Path

import numpy as np
import pytest

import trunnion

MODELS = Path(__file__).parents[2] / "models"
TABLES = Path(__file__).parent / "tables"
DECKS = sorted(MODELS.glob("*.inp"))
RTOL, ATOL, KIN = 1e-9, 1e-9, 1e-3
NOTHING = {"displacements": 1e-18, "supports": 1e-9}  # m, rad; N, N m: round-off where all is zero

Blocks = dict[str, dict[str, list[float]]]  # "OPE displacements" -> label -> six numbers


def answers(deck: Path) -> Blocks:
    """Solve a deck; a case that is not certified is a block without rows."""
    results = trunnion.solve(trunnion.read(deck))
    blocks: Blocks = {}
    for name, case in results.cases.items():
        if not case.converged:
            blocks[f"{name} not converged"] = {}
            continue
        for what in ("displacements", "supports"):
            table = getattr(case, what)
            rows = zip(table.labels, table.values[:, :6].tolist(), strict=True)
            blocks[f"{name} {what}"] = dict(rows)
    return blocks


def write(path: Path, blocks: Blocks) -> None:
    """Write a table: SI, support forces on the pipe."""
    lines = ["# ux uy uz rx ry rz [m, rad], fx fy fz mx my mz on the pipe [N, N m], global"]
    for title, rows in blocks.items():
        lines += ["", f"[{title}]"]
        lines += [f"{label:<12}" + "".join(f"{x:22.13e}" for x in rows[label]) for label in rows]
    path.parent.mkdir(exist_ok=True)
    path.write_text("\n".join(lines) + "\n")


def read(path: Path) -> Blocks:
    """Read a table."""
    blocks: Blocks = {}
    for line in path.read_text().splitlines():
        if line.startswith("["):
            rows = blocks[line.strip("[]")] = {}
        elif line and not line.startswith("#"):
            label, *numbers = line.split()
            rows[label] = [float(x) for x in numbers]
    return blocks


def change(
    old: dict[str, list[float]], new: dict[str, list[float]], nothing: float = 1e-18
) -> np.ndarray:
    """(n, 6) differences relative to what the tolerance is of."""
    before, after = np.array(list(old.values())), np.array(list(new.values()))
    column = np.abs(before).max(axis=0)
    kin = np.repeat(column.reshape(2, 3).max(axis=1), 3)
    allowed = RTOL * np.abs(before) + ATOL * np.maximum(column, KIN * kin) + nothing
    return RTOL * np.abs(after - before) / allowed


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_answers_are_those_of_the_table(deck):
    path = TABLES / f"{deck.stem}.txt"
    if not TABLES.is_dir():
        pytest.skip("no tables were made yet")
    assert path.is_file(), f"no table: python {Path(__file__).name} {deck.stem}"
    old, new = read(path), answers(deck)
    assert list(new) == list(old)
    for title, rows in new.items():
        assert list(rows) == list(old[title]), title
        if not rows:
            continue
        wrong = change(old[title], rows, NOTHING[title.rsplit(maxsplit=1)[-1]])
        i, j = np.unravel_index(int(wrong.argmax()), wrong.shape)
        label = list(rows)[i]
        assert wrong[i, j] <= RTOL, (
            f"{title} {label} component {j + 1}: {old[title][label][j]} is now {rows[label][j]}"
        )


def test_no_table_is_left_without_deck():
    left = {path.stem for path in TABLES.glob("*.txt")} - {deck.stem for deck in DECKS}
    assert left == set()


def test_a_change_of_1e_8_is_seen():
    old = {"1": [1.0, 0.0, 0.0, 1e-3, 0.0, 0.0], "2": [5.0, 1e-17, 0.0, 0.0, 0.0, 0.0]}
    same = {"1": [1.0 + 5e-10, 0.0, 0.0, 1e-3, 0.0, 0.0], "2": [5.0, 3e-17, 0.0, 0.0, 0.0, 0.0]}
    other = {"1": [1.0 + 5e-8, 0.0, 0.0, 1e-3, 0.0, 0.0], "2": [5.0, 1e-17, 0.0, 0.0, 0.0, 0.0]}
    assert change(old, same).max() <= RTOL < change(old, other).max()


def regenerate(stems: list[str]) -> None:
    """Write the tables of some decks, or of all."""
    for deck in DECKS:
        if stems and deck.stem not in stems:
            continue
        path, new = TABLES / f"{deck.stem}.txt", answers(deck)
        old = read(path) if path.is_file() else None
        write(path, new)
        if old is None:
            print(f"{deck.stem}: new")
        elif list(old) != list(new) or any(list(old[t]) != list(new[t]) for t in new):
            print(f"{deck.stem}: other cases or labels")
        else:
            worst = max((change(old[t], new[t]).max() for t in new if new[t]), default=0.0)
            print(f"{deck.stem}: largest change {worst:.1e}")


if __name__ == "__main__":
    regenerate(sys.argv[1:])
