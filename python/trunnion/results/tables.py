"""Results by label: small tables for the Python API, with no other library behind them.

results["OPE"].displacements["30M"]["uy"]
results["OPE"].supports["20"]["state"]
results["OPE"].elements.column("axial_from")
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import F8, Card, CaseResult, CycleResult, ModeSet, Part, Results, System
from trunnion.frozen import frozen
from trunnion.library.names import UnknownName
from trunnion.results.balance import local_end_forces
from trunnion.results.interior import mid_of_bend
from trunnion.results.stresses import Stresses, end_stresses
from trunnion.results.supports import (
    card_forces,
    card_friction,
    card_ids,
    card_normals,
    card_states,
    is_good,
    range_ratio,
    solved,
)
from trunnion.results.supports import envelope as extremes

if TYPE_CHECKING:
    from pandas import DataFrame

Cell = float | str | None
Words = Mapping[str, Sequence[str | None]]
FORCES = ("fx", "fy", "fz", "mx", "my", "mz")


@frozen(eq=False)
class Table:
    """Rows with labels, numbers in SI and some columns of words.

    Parameters
    ----------
    labels : one a row, each once.
    columns, units : (m,) names and units of the numbers.
    values : (n, m) numbers.
    words : further columns of text, such as a support's state.
    index : row of every label, and of the other names of rows (30 for 30F).
    """

    labels: tuple[str, ...]
    columns: tuple[str, ...]
    units: tuple[str, ...]
    values: F8
    words: Words
    index: Mapping[str, int]

    def __len__(self) -> int:
        return len(self.labels)

    def __iter__(self) -> Iterator[str]:
        return iter(self.labels)

    def __contains__(self, label: object) -> bool:
        return label in self.index

    def __getitem__(self, label: str) -> dict[str, Cell]:
        """Row of a label: its words and numbers by column."""
        i = self.row(label)
        row: dict[str, Cell] = {name: column[i] for name, column in self.words.items()}
        row.update(zip(self.columns, self.values[i].tolist(), strict=True))
        return row

    def row(self, label: str) -> int:
        """Give the number of a label's row; labels are upper case, as in the deck."""
        row = self.index.get(str(label).upper())
        if row is None:
            raise UnknownName("label", str(label), self.index)
        return row

    def column(self, name: str) -> F8:
        """(n,) numbers of a column."""
        return self.values[:, self.columns.index(name)]

    def to_pandas(self) -> "DataFrame":
        """Give a pandas.DataFrame: labels as index, units in `attrs["units"]`, SI.

        Raises
        ------
        ImportError : pandas is not installed (extra pandas).
        """
        pandas = pandas_module()
        columns = {**self.words, **dict(zip(self.columns, self.values.T, strict=True))}
        frame: DataFrame = pandas.DataFrame(columns, index=pandas.Index(self.labels, name="label"))
        frame.attrs["units"] = dict(zip(self.columns, self.units, strict=True))
        return frame

    def __str__(self) -> str:
        """Print the rows in columns, for a look at the prompt."""
        heads = ["", *self.words, *self.columns]
        rows = [heads, ["", *("" for _ in self.words), *(f"[{unit}]" for unit in self.units)]]
        for i, label in enumerate(self.labels):
            words = [str(column[i] or "") for column in self.words.values()]
            rows.append([label, *words, *(f"{x:.6g}" for x in self.values[i])])
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        return "\n".join(
            "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
            for row in rows
        )


def pandas_module() -> Any:
    """Import pandas, or name the extra that brings it."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_pandas needs pandas: pip install 'trunnion[pandas]'") from error
    return pandas


def displacements(case: CaseResult) -> Table:
    """Displacements of every node and of the bends' middles, global."""
    units = ("m",) * 3 + ("rad",) * 3
    columns = ("ux", "uy", "uz", "rx", "ry", "rz")
    system, u, middles = case.system, solved(case).u, mid_of_bend(case)
    labels = (*system.labels, *middles)
    values = np.vstack([u, *middles.values()])
    return Table(labels, columns, units, values, {}, system.alias | _index(labels))


def supports(case: CaseResult) -> Table:
    """Force of every support card on the pipe, global, with its state.

    `normal` is the size of the force without its friction.
    """
    cards, force, friction = case.system.cards, card_forces(case), card_friction(case)
    words: Words = {"name": [card.name for card in cards], "state": card_states(case)}
    columns = (*FORCES, "normal", "friction_x", "friction_y", "friction_z")
    values = np.column_stack([force, card_normals(case), friction])
    units = ("N",) * 3 + ("N m",) * 3 + ("N",) * 4
    ids = card_ids(cards)
    return Table(ids, columns, units, values, words, _card_index(cards))


def elements(case: CaseResult) -> Table:
    """End forces on every element, global and in the axes of its ends (x along the pipe)."""
    system, force = case.system, solved(case).end_force
    both = np.concatenate([force, local_end_forces(case)], axis=1)
    ends = ("from", "to", "local_from", "local_to")
    columns = tuple(f"{name}_{end}" for end in ends for name in FORCES)
    units = (("N",) * 3 + ("N m",) * 3) * 4
    parts = system.parts
    words: Words = {
        "from": [p.start for p in parts],
        "to": [p.end for p in parts],
        "type": [p.type for p in parts],
    }
    ids = element_ids(parts)
    return Table(ids, columns, units, both.reshape(-1, 24), words, _index(ids))


def stresses(case: CaseResult) -> Table:
    """Nominal stresses at both ends of every pipe [Pa]."""
    element, *ends = end_stresses(case)
    names = [*(field.name for field in fields(Stresses)), "longitudinal"]
    found = {
        f"{n}_{e}": getattr(s, n) for e, s in zip(("from", "to"), ends, strict=True) for n in names
    }
    ids = element_ids(case.system.parts)
    labels = tuple(ids[i] for i in element.tolist())
    values = np.column_stack(list(found.values()))
    return Table(labels, tuple(found), ("Pa",) * len(found), values, {}, _index(labels))


def envelope(results: Results) -> Table:
    """Largest and smallest load of every support on the pipe, and the cases they come from."""
    cases = [case for case in results.cases.values() if is_good(case)]
    cards = results.system.cards
    found = extremes(cases)
    names: list[str | None] = [*(case.name for case in cases), None]  # -1: no case
    words: dict[str, Sequence[str | None]] = {"name": [card.name for card in cards]}
    for end, which in (("max", found.highest_case), ("min", found.lowest_case)):
        for i, component in enumerate(FORCES):
            words[f"{component}_{end}_case"] = [names[j] for j in which[:, i].tolist()]
    columns = tuple(f"{component}_{end}" for end in ("max", "min") for component in FORCES)
    units = (("N",) * 3 + ("N m",) * 3) * 2
    values = np.concatenate([found.highest, found.lowest], axis=1)
    return Table(card_ids(cards), columns, units, values, words, _card_index(cards))


def support_ranges(cycle: CycleResult) -> Table:
    """Range of every support load over a cycle, beside that of the cases each on its own.

    `ratio` is that of the two; NaN where one of them is not there or next to nothing.
    """
    cards = _system_of(cycle).cards
    words: Words = {"name": [card.name for card in cards]}
    ids, index = card_ids(cards), _card_index(cards)
    return _ranges(ids, index, words, cycle.supports, cycle.one_shot_supports, ("",))


def element_ranges(cycle: CycleResult) -> Table:
    """Range of the end forces over a cycle, global, beside that of the cases on their own."""
    ids = element_ids(_system_of(cycle).parts)
    return _ranges(ids, _index(ids), {}, cycle.elements, cycle.one_shot_elements, ("_from", "_to"))


def _system_of(cycle: CycleResult) -> System:
    if cycle.supports is None or not cycle.path:
        raise ValueError(f"cycle {cycle.name} has no numbers: {cycle.cause}")
    return cycle.path[0].system


def _ranges(
    ids: Sequence[str],
    index: Mapping[str, int],
    words: Words,
    loop: F8 | None,
    alone: F8 | None,
    ends: Sequence[str],
) -> Table:
    assert loop is not None
    once = np.full(loop.shape, np.nan) if alone is None else alone
    columns = [
        f"{component}{end}_{what}"
        for what in ("loop", "one_shot", "ratio")
        for end in ends
        for component in FORCES
    ]
    n = len(ids)
    parts = [part.reshape(n, -1) for part in (loop, once, range_ratio(loop, once))]
    units = ("N",) * 3 + ("N m",) * 3
    both = units * (2 * len(ends)) + ("",) * (6 * len(ends))
    return Table(tuple(ids), tuple(columns), both, np.concatenate(parts, axis=1), words, index)


def _index(labels: Sequence[str]) -> dict[str, int]:
    return {label: i for i, label in enumerate(labels)}


def modes(found: ModeSet) -> Table:
    """Natural modes by number: frequency, participation, effective mass also in percent."""
    labels = tuple(str(i + 1) for i in range(len(found.frequency)))
    kinds = (("participation", "kg^0.5"), ("mass", "kg"), ("percent", "%"))
    columns = ("frequency", "period", *(f"{kind}_{c}" for kind, _ in kinds for c in "xyz"))
    units = ("Hz", "s", *(unit for _, unit in kinds for _ in "xyz"), "")
    parts = (
        found.frequency,
        period_of(found),
        found.participation,
        found.effective_mass,
        mass_percent(found),
        found.residual,
    )
    values = np.column_stack(parts)
    return Table(labels, (*columns, "residual"), units, values, {}, _index(labels))


def period_of(found: ModeSet) -> F8:
    """(m,) periods [s]; NaN for rigid modes."""
    f = found.frequency
    period: F8 = np.divide(1.0, f, out=np.full(len(f), np.nan), where=f > 0.0)
    return period


def mass_percent(found: ModeSet) -> F8:
    """(m, 3) effective mass in percent of the total mass."""
    total = np.where(found.total_mass > 0.0, found.total_mass, np.inf)
    share: F8 = 100.0 * found.effective_mass / total
    return share


def _card_index(cards: Sequence[Card]) -> dict[str, int]:
    """Rows of support cards by id and by name; the first of a name has it."""
    names = {card.name.upper(): i for i, card in reversed(list(enumerate(cards)))}
    return names | _index(card_ids(cards))


def element_ids(parts: Sequence[Part]) -> tuple[str, ...]:
    """One name an element: 10-20, and from the second between the same nodes on 10-20#2."""
    seen: dict[str, int] = {}
    ids = []
    for part in parts:
        name = f"{part.start}-{part.end}"
        seen[name] = count = seen.get(name, 0) + 1
        ids.append(name if count == 1 else f"{name}#{count}")
    return tuple(ids)
