"""The numbers of a job as a Python dictionary, one row a node, element, support or load."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from trunnion.arrays import ARC, F8, SPRING, STRAIGHT, TAPER, CaseResult
from trunnion.exports.hinges import chain
from trunnion.exports.scene import Scene, Stand, absent, modulus_ratio, stand


def job_lines(scene: Scene, deck: str) -> Iterable[str]:
    """Lines of the dictionary of the job."""
    s, labels = scene.system, scene.system.labels
    yield f'    "deck": {deck!a},'
    yield "    # label: place [m]"
    nodes = ((labels[i], row) for i, row in enumerate(s.xyz.tolist()))
    yield from _dictionary("nodes", (f"{label!a}: {tuple(row)}" for label, row in nodes))
    yield "    # name, from, to, E, G [Pa], area [m2], J, I [m4], shear area (0: rigid), local z"
    yield from _list("straights", (_row(_straight(scene, e)) for e in _of(scene, STRAIGHT)))
    yield "    # bends and reducers: name, from, to, hinges (place, axes, stiffness, free movement,"
    yield "    # length), rigid parts between (integrals of the load's shapes, of their levers)"
    yield from _list("chains", (_chain(scene, e) for e in _of(scene, ARC, TAPER)))
    yield "    # joints, springs, arms of offsets: name, from, to, axes, stiffness half way"
    yield from _list("springs", (_row(_spring(scene, e)) for e in _of(scene, SPRING)))
    yield from _list("elements", (f"{name!a}" for name in scene.elements))
    yield "    # supports: id, name, node, other node"
    yield from _list("cards", (_row(row) for row in card_rows(scene)))
    yield from _supports_and_cases(scene)


def card_rows(scene: Scene) -> list[tuple[str, str, str | None, str | None]]:
    """Give id, name, node and other node of every support card."""
    cards = zip(scene.cards, scene.system.cards, strict=True)
    return [(i, c.name, _node(scene, c.label), _node(scene, c.cnode)) for i, c in cards]


def held(found: Stand) -> dict[str, list[dict[str, Any]]]:
    """What is held in a case: friction and gaps all round."""
    rubs = [rub._asdict() for rub in found.rubs]
    for rub in rubs:
        rub["contacts"] = rub.pop("holds")
        del rub["slider"]
    return {"rubs": rubs, "rings": [ring._asdict() for ring in found.rings]}


def _node(scene: Scene, label: str | None) -> str | None:
    """Label under which a node is listed: 30 is 30F."""
    if label is None:
        return None
    alias = scene.system.alias
    return scene.system.labels[alias[label]] if label in alias else label


def _of(scene: Scene, *kinds: int) -> list[int]:
    found: list[int] = np.flatnonzero(np.isin(scene.system.kind, kinds)).tolist()
    return found


def _ends(scene: Scene, e: int) -> tuple[str, str, str]:
    i, j = scene.system.ends[e].tolist()
    return scene.elements[e], scene.system.labels[i], scene.system.labels[j]


def _straight(scene: Scene, e: int) -> tuple[Any, ...]:
    ea, gj, ei, gas = scene.system.rigidity[e].tolist()
    young, g = (float(modulus[e]) for modulus in scene.moduli)
    z = tuple(scene.system.axes[e, 2].tolist())
    return (*_ends(scene, e), young, g, ea / young, gj / g, ei / young, gas / g, z)


def _chain(scene: Scene, e: int) -> str:
    found = chain(scene.system, e)
    columns = (found.xyz, found.axes, found.k, np.column_stack((found.free, found.length)))
    hinges = zip(*(column.tolist() for column in columns), strict=True)
    parts = ",\n            ".join(_text(row) for row in hinges)
    segments = ",\n            ".join(_text(row) for row in found.segment.tolist())
    names = ", ".join(f"{name!a}" for name in _ends(scene, e))
    return f"({names}, [\n            {parts},\n        ], [\n            {segments},\n        ])"


def _spring(scene: Scene, e: int) -> tuple[Any, ...]:
    s = scene.system
    return (*_ends(scene, e), s.axes[e].tolist(), s.spring[e].tolist())


def _supports_and_cases(scene: Scene) -> Iterable[str]:
    """Lines of the supports, shared by the cases that stand on the same, and of the cases."""
    kinds: dict[tuple[Any, ...], int] = {}
    cases: list[str] = []
    for case in scene.cases:
        found = stand(case)
        rows = tuple(hold[:-1] for hold in found.holds)
        which = kinds.setdefault(rows, len(kinds) + 1)
        cases.append("\n".join(_case(scene, case, found, which)))
    yield "    # support (number of its card), turns, direction, k, gap to the minus and plus side"
    yield '    "supports": {'
    for rows, which in kinds.items():
        yield f"        {which}: ["
        yield from (f"            {_row(row)}," for row in rows)
        yield "        ],"
    yield "    },"
    yield '    "cases": {'
    yield from cases
    yield "    },"


def _case(scene: Scene, case: CaseResult, found: Stand, which: int) -> Iterable[str]:
    """Lines of one case."""
    loads, s, pad = case.loads, scene.system, " " * 12
    assert loads is not None
    names, labels = scene.elements, s.labels
    pipe = (s.kind != SPRING)[:, None]
    ratio, springs = modulus_ratio(scene, case), s.kind == SPRING
    yield f"        {case.name!a}: {{"
    yield f'{pad}"text": {case.text!a}, "supports": {which},'
    if found.rubs:
        yield f'{pad}"steps": {scene.steps[case.name]},'
    rows: dict[str, list[str]] = {
        "modulus": _named(names, np.where(ratio == 1.0, 0.0, ratio)),
        "line": _named(names, loads.dist * pipe),
        "vary": _named(names, loads.vary) if len(loads.vary) else [],
        "strain": _named(names, np.where(springs, 0.0, loads.strain)),
        "growth": _named(names, np.where(springs, loads.strain * s.length, 0.0)),
        "curvature": _named(names, loads.curvature),
        "nodal": _named(labels, loads.nodal),
        "base": _named(range(len(s.cards)), loads.base),
        "preload": _named(range(len(s.cards)), np.outer(loads.preload, s.up)),
    }
    for name, entries in rows.items():
        yield from _dictionary(name, entries, pad) if entries else ()
    lists = {
        "absent": [f"({labels[n]!a}, {i})" for n, i in absent(scene, found.holds)],
        **{name: [_text(row) for row in some] for name, some in held(found).items()},
    }
    for name, entries in lists.items():
        yield from _list(name, entries, pad) if entries else ()
    yield "        },"


def _named(names: Sequence[Any], values: F8) -> list[str]:
    """Entries of those rows that are not zero."""
    some = np.unique(np.nonzero(values)[0])
    rows = values.tolist()
    return [f"{names[i]!a}: {_text(rows[i])}" for i in some.tolist()]


def _row(row: Iterable[Any]) -> str:
    return f"({', '.join(_text(x) for x in row)})"


def _text(x: Any) -> str:
    """Python's own notation in ASCII: no label can end its string."""
    return ascii(x)


def _list(name: str, rows: Iterable[str], pad: str = "    ") -> Iterable[str]:
    return _block(name, rows, "[]", pad)


def _dictionary(name: str, rows: Iterable[str], pad: str = "    ") -> Iterable[str]:
    return _block(name, rows, "{}", pad)


def _block(name: str, rows: Iterable[str], brackets: str, pad: str) -> Iterable[str]:
    lines = [f"{pad}    {row}," for row in rows]
    if not lines:
        yield f'{pad}"{name}": {brackets},'
        return
    yield f'{pad}"{name}": {brackets[0]}'
    yield from lines
    yield f"{pad}{brackets[1]},"
