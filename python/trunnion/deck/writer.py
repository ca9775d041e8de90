"""Model to deck text that reads back to an equal model, in the deck's own units.

A number is written as the shortest decimal that converts to the same float.
"""

import heapq
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from trunnion.deck import case_writer as cw
from trunnion.deck import units as un
from trunnion.deck.case_writer import Pair
from trunnion.deck.case_writer import card as _card
from trunnion.deck.keywords import KEYWORDS
from trunnion.deck.properties import graded
from trunnion.deck.reader import read_text
from trunnion.deck.restraints import DESIGN_KEYS
from trunnion.errors import DeckError, ModelError, Problem
from trunnion.library.names import UnknownName
from trunnion.model import (
    INFINITE,
    Bend,
    Direction,
    HangerDesign,
    Material,
    Model,
    Operation,
    Pipe,
    Section,
    Settings,
    SpringSize,
    Support,
    Uniform,
)

_WIDTH = 100
_LONGEST_COMMENT = 1000  # characters


def write(
    model: Model,
    *,
    comments: Mapping[int, Sequence[str]] | None = None,
    header: Sequence[str] = (),
) -> str:
    """Write a model as a deck.

    Parameters
    ----------
    comments : by the identity (`id`) of a record, lines to put above its card as comments.
    header : comment lines for the top of the deck.

    Raises
    ------
    ModelError : the model holds something that no card can say.
    """
    top = [comment(line) for line in header]
    cards = _Writer(model, comments or {}).lines()
    text = "\n".join([*top, *(_fold(line) for line in cards)]) + "\n"
    try:
        same = read_text(text) == model
    except DeckError as error:
        raise ModelError(error.problems) from error
    if not same:
        message = "this model cannot be written: something in it has no words in a deck"
        raise ModelError([Problem("model", message)])
    return text


def shortest(value: float, dimension: str, units: dict[str, str]) -> str:
    """Shortest decimal, in the deck's unit of a dimension, that reads back to `value`."""
    unit = units[dimension]
    scale = un.scale_of(unit, dimension)
    shift = scale(0.0)
    guess = value / scale(1.0) if shift == 0.0 else (value - shift) / (scale(1.0) - shift)
    for digits in (15, 16, 17):
        text = f"{guess:.{digits}g}"
        if scale(float(text)) == value:
            return text.replace("e+", "e").replace("e-0", "e-")
    for near in (math.nextafter(guess, INFINITE), math.nextafter(guess, -INFINITE)):
        if scale(near) == value:
            return repr(near)
    return repr(value) + un.DIMENSIONS[dimension][1]  # this unit skips the number; SI has it


def comment(text: str) -> str:
    """Make one comment line of any text."""
    clean = "".join(c if c.isprintable() else " " for c in text)[:_LONGEST_COMMENT]
    return f"! {clean}".rstrip()


def _fold(line: str) -> str:
    """Continue a long card on further lines."""
    if len(line) <= _WIDTH or line.startswith(("TITLE", "!")):
        return line
    lines, row = [], ""
    for word in line.split():
        if row and len(row) + len(word) > _WIDTH - 3:
            lines.append(row + " &")
            row = " " * 8
        row += (" " if row.strip() else "") + word
    return "\n".join([*lines, row])


class _Writer:
    """Writes the cards of one model."""

    def __init__(self, model: Model, comments: Mapping[int, Sequence[str]]) -> None:
        self.model = model
        self.comments = comments
        self.units = un.derived(model.units)
        self.operation = Operation()
        self.uniform: tuple[Uniform, ...] = ()
        self.section = next(reversed(model.sections), "")
        self.material = next(reversed(model.materials), "")

    def number(self, value: float, dimension: str) -> str:
        """Write a number in the deck's unit."""
        return shortest(value, dimension, self.units)

    def keys(self, keyword: str, values: dict[str, Any], blank: Any = None) -> list[Pair]:
        """Write keys of a keyword by its table; values equal to `blank` are left out."""
        table = {key.name: key for key in KEYWORDS[keyword].keys}
        found = []
        for name, value in values.items():
            if value is None or value == blank:
                continue
            key = table[name]
            if key.kind == "number":
                found.append((name, self.number(value, key.dimension)))
            elif key.kind == "lengths":
                found.append((name, f"({','.join(self.number(x, 'length') for x in value)})"))
            elif key.kind == "vector":
                found.append((name, self.vector(value)))
            elif key.kind == "pairs":
                dims = key.dimension.split(", ")
                rows = (",".join(map(self.number, row, dims)) for row in value)
                found.append((name, ", ".join(f"({row})" for row in rows)))
            else:
                found.append((name, str(value)))
        return found

    def vector(self, value: Iterable[float]) -> str:
        """Write (a,b,c)."""
        return f"({','.join(self.number(x, 'number') for x in value)})"

    def lines(self) -> Iterator[str]:
        """Yield all cards: definitions, what stands on the line, cases."""
        model, units = self.model, self.model.units
        if model.title:
            yield _card("TITLE", [model.title])
        if units != un.SI:
            names = (units.length, units.force, units.pressure, units.temperature)
            yield _card("UNITS", names)
        yield from self.defaults()
        for material in model.materials.values():
            yield from self.above(material)
            yield from self.material_cards(material)
        for section in model.sections.values():
            yield from self.above(section)
            yield self.section_card(section)
        yield from self.body()
        yield from self.dynamics()
        for case in model.cases:
            yield cw.case_card(case, self.keys, model.settings)
        for cycle in model.cycles:
            yield cw.cycle_card(cycle, self.keys)

    def dynamics(self) -> Iterator[str]:
        """Write spectra, groups and modes."""
        for spectrum in self.model.spectra.values():
            yield cw.spectrum_card(spectrum, self.keys)
        for group in self.model.groups:
            yield cw.group_card(group)
        if self.model.modal is not None:
            yield cw.modes_card(self.model.modal, self.keys)

    def defaults(self) -> Iterator[str]:
        """Write the settings that differ from the usual ones."""
        usual = asdict(Settings())
        values = {}
        for name, value in asdict(self.model.settings).items():
            if value != usual[name]:
                on_off = {True: "ON", False: "OFF"}
                values[name.upper()] = on_off[value] if isinstance(value, bool) else value
        if values:
            yield _card("DEFAULT", [], self.keys("DEFAULT", values))

    def body(self) -> Iterator[str]:
        """Write what stands on the line, in the order of its places if they have one."""
        model = self.model
        rows: list[tuple[list[Any], Callable[[Any], Iterable[str]]]] = [
            (model.nodes, self.node_card),
            (model.pipes, self.pipe_cards),
            (model.bends, self.bend_card),
            (model.springs, self.spring_card),
            (model.masses, self.mass_card),
            (model.spring_sizes, self.size_card),
            (model.supports, self.support_card),
            (model.displacements, self.displacement_card),
            (model.forces, self.force_card),
            (model.accelerations, self.acceleration_card),
            (model.winds, lambda item: cw.wind_card(item, self.keys)),
            (model.snows, lambda item: cw.snow_card(item, self.number)),
        ]
        places = [[item.place for item in items] for items, _ in rows]
        one_file = len({place.file for row in places for place in row}) <= 1
        ordered = all(row == sorted(row, key=lambda p: p.line) for row in places)
        if not (one_file and ordered):
            for items, card in rows:
                for item in items:
                    yield from self.above(item)
                    yield from card(item)
            return
        streams = [
            [(item.place.line, i, n, item, card) for n, item in enumerate(items)]
            for i, (items, card) in enumerate(rows)
        ]
        for *_, item, card in heapq.merge(*streams, key=lambda entry: entry[:3]):
            yield from self.above(item)
            yield from card(item)

    def above(self, item: object) -> Iterator[str]:
        """Write the comments of a record."""
        yield from map(comment, self.comments.get(id(item), ()))

    def material_cards(self, material: Material) -> Iterator[str]:
        """Write a material and its table; a grade of the library only with what differs."""
        keys, base = self.material_keys(material)
        yield _card("MATERIAL", [material.name], keys)
        old = {point.t: point for point in base.table}
        for point in material.table:
            before = old.get(point.t)
            if point == before:
                continue
            values = {"T": point.t, "E": point.e, "ALPHA": point.alpha}
            yield _card("PROPERTY", [material.name], self.keys("PROPERTY", values))

    def material_keys(self, material: Material) -> tuple[list[Pair], Material]:
        """Keys of the MATERIAL card and the material that they alone would make."""
        values: dict[str, Any] = {
            "E": material.e,
            "NU": material.nu,
            "ALPHA": material.alpha,
            "DENSITY": material.density,
            "TREF": material.table_tref,
        }
        if material.grade is None:
            usual = {"NU": 0.3, "ALPHA": 0.0, "DENSITY": 0.0, "TREF": 20.0}
            shown = {k: v for k, v in values.items() if v != usual.get(k)}
            base = Material(material.name, material.e)
            return self.keys("MATERIAL", shown), base
        grade = {"GRADE": material.grade}
        try:
            library = graded(material.name, grade)
        except UnknownName as error:
            raise ModelError([Problem(material.place, str(error))]) from error
        own = (library.e, library.nu, library.alpha, library.density, library.table_tref)
        differ = {k: v for (k, v), o in zip(values.items(), own, strict=True) if v != o}
        for forced in ((), ("E",), ("ALPHA",), ("E", "ALPHA")):
            tried = {**grade, **differ, **{k: values[k] for k in forced}}
            base = graded(material.name, tried)
            if {p.t: p for p in base.table}.keys() <= {p.t for p in material.table}:
                break
        return self.keys("MATERIAL", tried), base

    def section_card(self, section: Section) -> str:
        """Write a section by its size of the tables, or by its diameter and wall."""
        size: dict[str, Any] = {"OD": section.od, "WALL": section.wall}
        if section.schedule is not None:
            size = {"NPS": section.nps, "DN": section.dn, "SCH": section.schedule}
        rest = {
            "FLUID": section.fluid,
            "LINING": section.lining,
            "LINING_DENSITY": section.lining_density,
            "INSULATION": section.insulation,
            "INSULATION_DENSITY": section.insulation_density,
            "WEIGHT": section.weight,
            "CORROSION": section.corrosion,
        }
        keys = self.keys("SECTION", size) + self.keys("SECTION", rest, 0.0)
        return _card("SECTION", [section.name], keys)

    def node_card(self, node: Any) -> Iterator[str]:
        """Write the coordinates of a node."""
        keys = dict(zip("XYZ", node.xyz, strict=True))
        yield _card("NODE", [node.label], self.keys("NODE", keys, 0.0))

    def pipe_cards(self, pipe: Any) -> Iterator[str]:
        """Write a pipe or rigid, and what changes before it."""
        new, old = pipe.operation, self.operation
        if new != old:
            values = {"T" + s: v for s, v in new.t.items() if old.t.get(s) != v}
            values |= {"P" + s: v for s, v in new.p.items() if old.p.get(s) != v}
            if new.tref != old.tref:
                values["TREF"] = new.tref
            yield _card("OPERATE", [], self.keys("OPERATE", values))
            self.operation = new
        yield from self.uniform_cards(pipe.uniform)
        keyword = pipe.card
        keys = []
        if pipe.delta is not None:
            keys = self.keys(keyword, dict(zip(("DX", "DY", "DZ"), pipe.delta, strict=True)), 0.0)
        keys += self.component_keys(pipe)
        if pipe.section != self.section:
            keys.append(("SECTION", pipe.section))
        if pipe.material != self.material:
            keys.append(("MATERIAL", pipe.material))
        self.section, self.material = pipe.section, pipe.material
        if pipe.reducer is not None:
            self.section = pipe.reducer.section
        yield _card(keyword, [pipe.start, pipe.end], keys)

    def component_keys(self, pipe: Pipe) -> list[Pair]:
        """Write what makes a pipe a body, a reducer or an expansion joint, and its cold spring."""
        values: dict[str, Any] = {}
        if pipe.rigid or pipe.joint:
            values["WEIGHT"] = pipe.weight or None
        if pipe.reducer is not None:
            values |= {"TO": pipe.reducer.section, "AXIS": pipe.reducer.axis}
        if pipe.joint is not None:
            values |= {name.upper(): value for name, value in asdict(pipe.joint).items()}
            values["AREA"] = pipe.joint.area or None
        for key, arm in zip(("OFFSET1", "OFFSET2"), pipe.offsets, strict=True):
            values[key] = arm
        if pipe.cut:
            values["CUTSHORT" if pipe.cut > 0.0 else "CUTLONG"] = abs(pipe.cut)
        return self.keys(pipe.card, values)

    def uniform_cards(self, new: tuple[Uniform, ...]) -> Iterator[str]:
        """Write the uniform loads that change before a pipe; zero ends one."""
        old = {q.set: q for q in self.uniform}
        now = {q.set: q for q in new}
        for name in sorted(old.keys() | now.keys()):
            q = now.get(name, Uniform(name, (0.0, 0.0, 0.0)))
            if q != old.get(name):
                axes = ("GX", "GY", "GZ") if q.in_g else ("X", "Y", "Z")
                values = dict(zip(axes, q.load, strict=True))
                keys = self.keys("UNIFORM", values, 0.0) or [("X", "0")]
                yield _card("UNIFORM", ["Q" + name], keys)
        self.uniform = new

    def bend_card(self, bend: Bend) -> Iterator[str]:
        """Write a bend."""
        words = [bend.node]
        if bend.radius is None and bend.diameters == 1.0:
            words.append("SHORT")
        values = {"R": bend.radius, "K": bend.k, "FLANGES": bend.flanges or None}
        yield _card("BEND", words, self.keys("BEND", values))

    def spring_card(self, spring: Any) -> Iterator[str]:
        """Write a spring between two nodes."""
        yield _card("SPRING", [spring.start, spring.end], self.spring_keys(spring.k, spring.axis))

    def spring_keys(self, k: Iterable[float], axis: Any) -> list[Pair]:
        """Write the stiffnesses of a spring."""
        names = ("KX", "KY", "KZ", "KRX", "KRY", "KRZ")
        keys = self.keys("SPRING", dict(zip(names, k, strict=True)), 0.0)
        return keys + self.keys("SPRING", {"AXIS": axis})

    def mass_card(self, mass: Any) -> Iterator[str]:
        """Write a mass."""
        yield _card("MASS", [mass.node], self.keys("MASS", {"M": mass.mass}))

    def support_card(self, support: Support) -> Iterator[str]:
        """Write an anchor, support, hanger or spring to ground."""
        common: dict[str, Any] = {"CNODE": support.cnode, "NAME": support.name}
        node = [support.node]
        match support.kind:
            case "anchor":
                values = {"K": support.k, "KR": support.kr, **common}
                yield _card("ANCHOR", node, self.keys("ANCHOR", values))
            case "hanger":
                yield self.hanger_card(support, common)
            case "snubber":
                (direction,) = support.directions
                word = direction.word if direction.vector is None else self.vector(direction.vector)
                keys = self.keys("SNUBBER", {"K": support.k, **common})
                yield _card("SNUBBER", [*node, word], keys)
            case "spring":
                keys = self.spring_keys(support.ks or (0.0,) * 6, support.axis)
                yield _card("SPRING", node, keys)
            case _:
                common["FRICTION"] = next((d.friction for d in support.directions), None)
                words = [*node, *(w for d in support.directions for w in self.direction(d))]
                yield _card("SUPPORT", words, self.keys("SUPPORT", common))

    def hanger_card(self, support: Support, common: dict[str, Any]) -> str:
        """Write a hanger, given or to be selected."""
        wanted, usual = support.design, HangerDesign()
        if wanted is None:
            values = {"RATE": support.k or None, "LOAD": support.load, **common}
            return _card("HANGER", [support.node], self.keys("HANGER", values))
        asked = {
            key: value
            for key, name in DESIGN_KEYS.items()
            if (value := getattr(wanted, name)) != getattr(usual, name)
        }
        keys = self.keys("HANGER", {**asked, **common})
        return _card("HANGER", [support.node, "DESIGN"], keys)

    def size_card(self, size: SpringSize) -> Iterator[str]:
        """Write one size of the table of springs."""
        values = {"SERIES": size.series, "MIN": size.least, "MAX": size.most, "RATE": size.rate}
        yield _card("SPRINGSIZE", [size.name], self.keys("SPRINGSIZE", values))

    def direction(self, direction: Direction) -> Iterator[str]:
        """Write a direction word and its keys."""
        word = direction.word
        if direction.vector is not None:
            sign = word[0] if word[0] in "+-" else ""
            word = sign + self.vector(direction.vector)
        yield word
        turning = direction.word.lstrip("+-").startswith("R")
        minus, plus = direction.gap
        if minus or plus:
            dimension = "angle" if turning else "length"
            both = [self.number(minus, dimension), self.number(plus, dimension)]
            yield f"GAP={both[0] if minus == plus else ','.join(both)}"
        if direction.k is not None:
            stiffness = "rotational stiffness" if turning else "stiffness"
            yield f"K={self.number(direction.k, stiffness)}"
        for key, value, dimension in (
            ("KF", direction.kf, "stiffness"),
            ("MU", direction.mu, "number"),
        ):
            if value is not None:
                yield f"{key}={self.number(value, dimension)}"
        if direction.along is not None:
            yield f"ALONG={direction.along}"

    def displacement_card(self, item: Any) -> Iterator[str]:
        """Write an imposed displacement."""
        values = dict(zip(("DX", "DY", "DZ", "RX", "RY", "RZ"), item.d, strict=True))
        keys = self.keys("DISPLACEMENT", values)
        yield _card("DISPLACEMENT", [item.node, "D" + item.set], keys)

    def force_card(self, item: Any) -> Iterator[str]:
        """Write a nodal force."""
        values = dict(zip(("FX", "FY", "FZ", "MX", "MY", "MZ"), item.f, strict=True))
        keys = self.keys("FORCE", values, 0.0) or [("FX", "0")]
        yield _card("FORCE", [item.node, "F" + item.set], keys)

    def acceleration_card(self, item: Any) -> Iterator[str]:
        """Write a uniform acceleration."""
        values = dict(zip("XYZ", item.a, strict=True))
        keys = self.keys("ACCELERATION", values, 0.0) or [("X", "0")]
        yield _card("ACCELERATION", ["U" + item.set], keys)
