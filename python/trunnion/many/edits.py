"""Quantities of a study: where each stands in a model, and the model with another value of it.

Every key means what it means on its card of the deck.
"""

from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from typing import Any, TypeVar

from trunnion.deck.keywords import PRESSURE_SETS
from trunnion.deck.values import WordError, nearest
from trunnion.frozen import frozen
from trunnion.model import Case, Material, Model, Pipe

Edit = Callable[[Model, float], Model]
Record = TypeVar("Record")

FORCES = ("FX", "FY", "FZ", "MX", "MY", "MZ")


@frozen
class Quantity:
    """One key of a study.

    card, key : where the deck has it; its reader reads the values.
    find : makes the edit for a label and a part (direction, component), or raises WordError.
    labels : what the label must be where it cannot be left out, "" where it can.
    meaning : for the reference.
    """

    card: str
    key: str
    find: Callable[[Model, str, str], Edit]
    meaning: str
    rank: str  # cases, loads, supports, members
    labels: str = ""

    def level(self, model: Model) -> str:
        """What a change of it makes necessary: pressure may stiffen bends."""
        stiffens = self.key in PRESSURE_SETS and model.settings.stiffen != "OFF"
        return "members" if stiffens else self.rank


def _chosen(label: str, names: Collection[str], what: str) -> list[str]:
    """Names that a label means: all of them where it is left out."""
    if not label:
        if not names:
            raise WordError(f"the deck has no {what}")
        return list(names)
    if label not in names:
        raise WordError(f"there is no {what} {label}{nearest(label, names)}")
    return [label]


def _with(record: Record, name: str, value: object) -> Record:
    """A record with another value of the field called `name`."""
    changed: Record = replace(record, **{name: value})  # type: ignore[type-var]
    return changed


def _no_part(part: str) -> None:
    if part:
        raise WordError(f"{part} after the comma is not expected")


def _component(part: str, words: tuple[str, ...]) -> int:
    if part not in words:
        raise WordError(
            f"{part or 'nothing'} after the label is not one of {' '.join(words)}"
            f"{nearest(part, words)}"
        )
    return words.index(part)


# ------------------------------------------------------------------ records with a field
def field(home: str, name: str, what: str) -> Callable[[Model, str, str], Edit]:
    """Field of the named records of a dict of the model: sections, materials."""

    def find(model: Model, label: str, part: str) -> Edit:
        _no_part(part)
        chosen = _chosen(label, getattr(model, home), what)

        def edit(model: Model, value: float) -> Model:
            records: dict[str, Any] = dict(getattr(model, home))
            records.update({n: replace(records[n], **{name: value}) for n in chosen})
            return _with(model, home, records)

        return edit

    return find


def setting(name: str) -> Callable[[Model, str, str], Edit]:
    """Field of the DEFAULT card."""

    def find(model: Model, label: str, part: str) -> Edit:
        _no_part(part)

        def edit(model: Model, value: float) -> Model:
            return replace(model, settings=replace(model.settings, **{name: value}))  # type: ignore[arg-type]

        return edit

    return find


def _replaced(home: str, at: Iterable[int], change: Callable[[Any, float], Any]) -> Edit:
    """Change some items of a list of the model."""
    which = tuple(at)

    def edit(model: Model, value: float) -> Model:
        items = list(getattr(model, home))
        for i in which:
            items[i] = change(items[i], value)
        return _with(model, home, items)

    return edit


# ------------------------------------------------------------------ materials
def modulus(model: Model, label: str, part: str) -> Edit:
    """E: the moduli of a table of temperatures change in the same ratio."""
    _no_part(part)
    chosen = _chosen(label, model.materials, "MATERIAL")

    def changed(m: Material, value: float) -> Material:
        points = tuple(replace(p, e=p.e and p.e * (value / m.e)) for p in m.table)
        return replace(m, e=value, table=points)

    def edit(model: Model, value: float) -> Model:
        materials = {n: changed(m, value) if n in chosen else m for n, m in model.materials.items()}
        return replace(model, materials=materials)

    return edit


def expansion(model: Model, label: str, part: str) -> Edit:
    """ALPHA of materials without a table of it."""
    for name in _chosen(label, model.materials, "MATERIAL"):
        if any(point.alpha is not None for point in model.materials[name].table):
            raise WordError(f"MATERIAL {name} has a table of ALPHA; vary a temperature instead")
    return field("materials", "alpha", "MATERIAL")(model, label, part)


# ------------------------------------------------------------------ pipes
def _pipes(model: Model, label: str) -> dict[str, list[int]]:
    """Numbers of the pipes by name a-b."""
    found: dict[str, list[int]] = {}
    for i, pipe in enumerate(model.pipes):
        found.setdefault(f"{pipe.start}-{pipe.end}", []).append(i)
    return found


def operation(name: str) -> Callable[[Model, str, str], Edit]:
    """T1 ... P9: of one pipe, or of all that have the set."""
    home, number = name[0].lower(), name[1:]

    def find(model: Model, label: str, part: str) -> Edit:
        _no_part(part)
        found = _pipes(model, label)
        if label:
            which = found[_chosen(label, found, "pipe")[0]]
        else:
            which = [i for i, p in enumerate(model.pipes) if number in getattr(p.operation, home)]
            if not which:
                raise WordError(f"no pipe of the deck has {name}")

        def change(pipe: Pipe, value: float) -> Pipe:
            table = {**getattr(pipe.operation, home), number: value}
            return replace(pipe, operation=_with(pipe.operation, home, table))

        return _replaced("pipes", which, change)

    return find


def leg(axis: int) -> Callable[[Model, str, str], Edit]:
    """DX DY DZ of one pipe."""

    def find(model: Model, label: str, part: str) -> Edit:
        _no_part(part)
        found = _pipes(model, label)
        which = found[_chosen(label, found, "pipe")[0]]
        if any(model.pipes[i].delta is None for i in which):
            raise WordError(f"pipe {label} runs between given coordinates")

        def change(pipe: Pipe, value: float) -> Pipe:
            x, y, z = (value if i == axis else d for i, d in enumerate(pipe.delta or (0.0,) * 3))
            return replace(pipe, delta=(x, y, z))

        return _replaced("pipes", which, change)

    return find


def radius(model: Model, label: str, part: str) -> Edit:
    """R of bends."""
    _no_part(part)
    names = [bend.node for bend in model.bends]
    chosen = _chosen(label, names, "BEND")
    at = [i for i, name in enumerate(names) if name in chosen]
    return _replaced("bends", at, lambda bend, value: replace(bend, radius=value))


# ------------------------------------------------------------------ loads
def imposed(home: str, number: str, words: tuple[str, ...]) -> Callable[[Model, str, str], Edit]:
    """One component of D1 ... or F1 ... at a node."""
    given = "d" if home == "displacements" else "f"

    def find(model: Model, label: str, part: str) -> Edit:
        records = [r for r in getattr(model, home) if r.set == number]
        what = f"{home[0].upper()}{number} at node"
        _chosen(label, {r.node for r in records}, what)
        component = _component(part, words)
        at = [i for i, r in enumerate(getattr(model, home)) if (r.node, r.set) == (label, number)]
        if any(getattr(getattr(model, home)[i], given)[component] is None for i in at):
            raise WordError(f"{part} is free there; give it on the DISPLACEMENT card")

        def change(record: Any, value: float) -> Any:
            values = list(getattr(record, given))
            values[component] = value
            return replace(record, **{given: tuple(values)})

        if len(at) > 1:
            raise WordError(f"{len(at)} cards give {what} {label}; make them one")
        return _replaced(home, at, change)

    return find


def acceleration(number: str) -> Callable[[Model, str, str], Edit]:
    """One component of U1 ...; the label names it."""

    def find(model: Model, label: str, part: str) -> Edit:
        _no_part(part)
        component = _component(label, ("X", "Y", "Z"))
        at = [i for i, a in enumerate(model.accelerations) if a.set == number]
        if not at:
            raise WordError(f"the deck has no ACCELERATION U{number}")

        def change(record: Any, value: float) -> Any:
            a = list(record.a)
            a[component] = value
            return replace(record, a=tuple(a))

        if len(at) > 1:
            raise WordError(f"{len(at)} cards give U{number}; make them one")
        return _replaced("accelerations", at, change)

    return find


# ------------------------------------------------------------------ cases
def factor(model: Model, label: str, part: str) -> Edit:
    """Factor of a load set in every case that has it; signs and factors of the cases stay."""
    _no_part(part)
    cases = [c for c in model.cases if isinstance(c, Case)]
    _chosen(label, {t.name for c in cases for t in c.terms}, "load set of a case")

    def changed(case: Case, value: float) -> Case:
        terms = (replace(t, factor=t.factor * value) if t.name == label else t for t in case.terms)
        return replace(case, terms=tuple(terms))

    return _on_cases([c.name for c in cases], changed)


def of_case(name: str) -> Callable[[Model, str, str], Edit]:
    """MUX or STEPS of one case, or of all."""

    def find(model: Model, label: str, part: str) -> Edit:
        _no_part(part)
        names = [c.name for c in model.cases if isinstance(c, Case) and not (c.about or c.on)]
        kind = int if name == "steps" else float
        chosen = _chosen(label, names, "CASE")
        return _on_cases(chosen, lambda case, value: _with(case, name, kind(value)))

    return find


def _on_cases(names: Collection[str], change: Callable[[Case, float], Case]) -> Edit:
    """Change cases by name: a study may keep only some of the deck's."""

    def edit(model: Model, value: float) -> Model:
        cases = [
            change(c, value) if isinstance(c, Case) and c.name in names else c for c in model.cases
        ]
        return replace(model, cases=cases)

    return edit
