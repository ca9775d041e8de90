"""A model becomes numbers: nodes in order of appearance, elements, contacts and sliders."""

from dataclasses import fields, replace

import numpy as np

from trunnion.arrays import Contacts, Sliders, System
from trunnion.collector import paused
from trunnion.errors import Problem
from trunnion.loads.expansion import OutsideTableError, modulus_at
from trunnion.model import Model
from trunnion.system.checks import check_model, refuse
from trunnion.system.contacts import build_contacts
from trunnion.system.elements import Elements, build_elements
from trunnion.system.geometry import place
from trunnion.system.numbering import number
from trunnion.system.vectors import Vec

UP: dict[str, Vec] = {"Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def build_system(model: Model) -> System:
    """Give a model its numbers and arrays; raise the problems of each phase at once."""
    with paused():
        return _build(model)


def _build(model: Model) -> System:
    problems = check_model(model)
    geometry = place(model, problems)
    numbering = number(model, geometry)
    points = [geometry.points[label] for label in numbering.labels]
    xyz = np.array(points, dtype=np.float64).reshape(-1, 3)
    up = UP[model.settings.up]
    elements = build_elements(model, geometry, numbering, xyz, up)
    parts = tuple(numbering.rows.names)
    supports = build_contacts(model, elements, parts, numbering.index, up)
    return System(
        labels=tuple(numbering.labels),
        alias=numbering.alias,
        xyz=xyz,
        ends=elements.ends,
        kind=elements.kind,
        axes=elements.axes,
        length=elements.length,
        radius=elements.radius,
        angle=elements.angle,
        rigidity=elements.rigidity,
        flex=elements.flex,
        spring=elements.spring,
        od=elements.od,
        wall=elements.wall,
        taper=elements.taper,
        parts=parts,
        contacts=supports.contacts,
        sliders=supports.sliders,
        snubbers=supports.snubbers,
        cards=supports.cards,
        up=np.array(up),
        source=elements.source,
        mid=numbering.mid,
    )


def with_supports(model: Model, system: System) -> System:
    """Give the system on the supports of a model that is the same pipe."""
    elements = Elements(**{f.name: getattr(system, f.name) for f in fields(Elements)})
    index = {label: i for i, label in enumerate(system.labels)} | system.alias
    up = UP[model.settings.up]
    supports = build_contacts(model, elements, system.parts, index, up)
    return replace(
        system,
        contacts=supports.contacts,
        sliders=supports.sliders,
        snubbers=supports.snubbers,
        cards=supports.cards,
    )


def shares_pattern(a: System, b: System) -> bool:
    """Tell whether two systems join the same nodes; sliders on ground add nothing to a pattern."""
    same = a.labels == b.labels and np.array_equal(a.ends, b.ends)
    same = same and _joins(a.contacts) == _joins(b.contacts)
    same = same and _joins(a.snubbers) == _joins(b.snubbers)
    grounded = not (a.sliders.cnode >= 0).any() and not (b.sliders.cnode >= 0).any()
    return same and (grounded or _joins(a.sliders) == _joins(b.sliders))


def _joins(items: Contacts | Sliders) -> tuple[bytes, bytes]:
    return items.node.tobytes(), items.cnode.tobytes()


def hot_system(model: Model, system: System, which: str) -> System:
    """Give the system with the moduli at temperature set `which` ("1" ... "9").

    Elements without that set keep the cold modulus; so do the factors k of bends.
    """
    problems: list[Problem] = []
    known: dict[tuple[str, float], float] = {}
    ratio = np.ones(len(model.pipes) + 1)
    for i, pipe in enumerate(model.pipes):
        t = pipe.operation.t.get(which)
        if t is None:
            continue
        key = (pipe.material, t)
        if key not in known:
            material = model.materials[pipe.material]
            known[key] = 1.0
            try:
                known[key] = modulus_at(material, t) / material.e
            except OutsideTableError as error:
                text = f"MATERIAL {material.name}: E=HOT with T{which}: {error}"
                problems.append(Problem(material.place, text))
        ratio[i] = known[key]
    refuse(problems)
    return replace(system, rigidity=system.rigidity * ratio[system.source, None])
