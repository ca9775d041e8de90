"""Blocks of a PCF to components with points in metres, under the pipeline that they belong to."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.blocks import Attribute, Block
from trunnion.formats.pcf.points import Point, point_of, points_of
from trunnion.formats.pcf.words import ENDS, HEADERS, SHAPES, is_message
from trunnion.frozen import frozen

_LENGTHS = {
    "MM": 1e-3,
    "INCH": 0.0254,
    "IN": 0.0254,
    "INCH-SIXTEENTH": 0.0254 / 16.0,
    "MM-HUNDREDTH": 1e-5,
    "FEET": 0.3048,
    "M": 1.0,
}
_BORES = {"MM": "MM", "INCH": "INCH", "IN": "INCH", "INCH-SIXTEENTH": "SIXTEENTH"}
_WEIGHTS = {"KGS": 1.0, "KG": 1.0, "LBS": 0.45359237, "LB": 0.45359237}


@frozen
class Part:
    """One component: its keyword and shape, points, attributes, pipeline and its attributes."""

    keyword: str
    shape: str
    line: int
    ends: tuple[Point, ...] = ()
    centre: Point | None = None
    branches: tuple[Point, ...] = ()
    at: Point | None = None
    attributes: tuple[Attribute, ...] = ()
    pipeline: str = ""
    shared: tuple[Attribute, ...] = ()  # attributes of the pipeline
    description: str = ""  # of its item code

    @property
    def name(self) -> str:
        """How messages call it: "ELBOW of line 12"."""
        return f"{self.keyword} of line {self.line}"

    def get(self, name: str) -> str | None:
        """Value of an attribute of the component, else of its pipeline."""
        for attribute in (*self.attributes, *self.shared):
            if attribute.name == name and attribute.value:
                return attribute.value
        return None

    @property
    def ports(self) -> tuple[Point, ...]:
        """Points at which it can be joined."""
        return (*self.ends, *self.branches)

    @property
    def bore(self) -> float | None:
        """Bore as written, of the first point that has one."""
        points = (*self.ends, *self.branches, *(p for p in (self.centre, self.at) if p))
        return next((p.bore for p in points if p.bore), None)


@frozen
class Line:
    """What a PCF says: components, ends, node numbers in circles, units of bore and weight."""

    parts: tuple[Part, ...]
    ends: tuple[tuple[str, Point, str], ...]  # keyword, where, reference
    circles: tuple[tuple[str, Point], ...]
    bore_unit: str
    length: float  # metres of one unit of coordinates
    weight: float  # kg of one unit of weight
    pipelines: tuple[str, ...]
    skipped: dict[str, int]  # symbols that are no structure, and how many
    gone: tuple[tuple[str, Point], ...] = ()  # ends of components that are left out, by name


class _Units:
    """Units of the header."""

    def __init__(self, found: list[Block], findings: Findings) -> None:
        said = {block.keyword: block for block in reversed(found)}
        for block in found:  # units that a writer put under another header
            for a in block.attributes if block.keyword in HEADERS else ():
                if a.name.startswith("UNITS-") and block.keyword != "PIPELINE-REFERENCE":
                    said.setdefault(a.name, Block(a.name, a.value, a.line))
        self.bore = _unit(said, "UNITS-BORE", _BORES, findings)
        self.length = _unit(said, "UNITS-CO-ORDS", _LENGTHS, findings)
        self.weight = 1.0
        if "UNITS-WEIGHT" in said:
            self.weight = _unit(said, "UNITS-WEIGHT", _WEIGHTS, findings)


T = TypeVar("T")


def _unit(said: Mapping[str, Block], name: str, words: Mapping[str, T], findings: Findings) -> T:
    """Value of a unit word of the header."""
    first = next(iter(words.values()))  # MM
    block = said.get(name)
    if block is None:
        findings.leave_out(1, "header", f"{name} is missing; taken as MM", vital=True)
        return first
    word = block.value.upper().split(" ")[0]
    if word not in words:
        findings.fault(block.line, f"{name} {block.value}: not one of {' '.join(words)}")
    return words.get(word, first)


def read_line(found: list[Block], findings: Findings) -> Line:
    """Read the components of a file."""
    units = _Units(found, findings)
    materials = _materials(found)
    identified = {
        block.value: block.get("ITEM-CODE") or ""
        for block in found
        if block.keyword == "MATERIAL-IDENTIFIER"
    }
    pipeline = ""
    shared: tuple[Attribute, ...] = ()
    parts: list[Part] = []
    ends: list[tuple[str, Point, str]] = []
    circles: list[tuple[str, Point]] = []
    pipelines: list[str] = []
    skipped: dict[str, int] = {}
    gone: list[tuple[str, Point]] = []
    in_materials = False
    for block in found:
        word = block.keyword
        if word == "MATERIALS":
            in_materials = True
        elif word == "PIPELINE-REFERENCE":
            pipeline, shared, in_materials = block.value, block.attributes, False
            pipelines.append(block.value)
        elif word in HEADERS or word.startswith(("UNITS-", "ITEM-")) or in_materials:
            continue
        elif word in ENDS or word.startswith(("END-POSITION-", "END-CONNECTION-")):
            at = points_of(block, ("CO-ORDS", "END-POINT"), units.length, findings)
            reference = block.get("CONNECTION-REFERENCE") or block.value
            ends += [(word, point, reference) for point in at[:1]]
        elif is_message(word):
            circles += _circle(block, units.length)
        elif SHAPES.get(word) == "mark":
            skipped[word] = skipped.get(word, 0) + 1
        elif word in SHAPES:
            part = _identified(_part(block, units.length, findings), identified)
            item = part.get("ITEM-CODE") or ""
            text = materials.get(item, "")
            parts.append(replace(part, pipeline=pipeline, shared=shared, description=text))
        else:
            text = f"{word} is no component of a PCF that is known here"
            findings.leave_out(block.line, f"line {block.line}", text)
            gone += _ends_of(block, units.length)
    return Line(
        tuple(parts),
        tuple(ends),
        tuple(circles),
        units.bore,
        units.length,
        units.weight,
        tuple(pipelines),
        skipped,
        tuple(gone),
    )


def _ends_of(block: Block, unit: float) -> list[tuple[str, Point]]:
    """Points at which a component that is left out was joined, with its name."""
    points = [point_of(a, unit) for a in block.attributes if a.name in ("END-POINT", *_BRANCHES)]
    name = f"{block.keyword} of line {block.line}"
    return [(name, point) for point in points if isinstance(point, Point)]


def _part(block: Block, unit: float, findings: Findings) -> Part:
    ends = points_of(block, ("END-POINT",), unit, findings)
    centres = points_of(block, ("CENTRE-POINT",), unit, findings)
    branches = points_of(block, _BRANCHES, unit, findings)
    at = points_of(block, ("CO-ORDS",), unit, findings)
    centre = centres[0] if centres else None
    rest = tuple(a for a in block.attributes if a.name not in _RECORDS)
    return Part(
        block.keyword,
        SHAPES[block.keyword],
        block.line,
        tuple(ends),
        centre,
        tuple(branches),
        at[0] if at else None,
        rest,
    )


def _identified(part: Part, items: Mapping[str, str]) -> Part:
    """Give a component the item code of its MATERIAL-IDENTIFIER, as some writers have it."""
    item = items.get(part.get("MATERIAL-IDENTIFIER") or "")
    if not item or part.get("ITEM-CODE"):
        return part
    return replace(part, attributes=(*part.attributes, Attribute("ITEM-CODE", item, part.line)))


_BRANCHES = ("BRANCH1-POINT", "BRANCH2-POINT")
_RECORDS = frozenset(("END-POINT", "CENTRE-POINT", "CO-ORDS", *_BRANCHES))


def _circle(block: Block, unit: float) -> list[tuple[str, Point]]:
    """Give the node number of a MESSAGE-CIRCLE."""
    if block.keyword not in ("MESSAGE-CIRCLE", "MESSAGE-ROUND"):
        return []
    text = (block.get("TEXT") or "").strip()
    where = next((point_of(a, unit) for a in block.attributes if a.name == "CO-ORDS"), "")
    return [(text, where)] if text.isdigit() and len(text) < 10 and isinstance(where, Point) else []


def _materials(found: list[Block]) -> dict[str, str]:
    """Descriptions by item code."""
    texts = {}
    for block in found:
        if block.keyword == "ITEM-CODE":
            texts[block.value] = block.get("DESCRIPTION") or ""
        elif block.keyword == "MATERIAL-IDENTIFIER":
            texts[block.get("ITEM-CODE") or ""] = block.get("DESCRIPTION") or ""
        code = None  # a file that indents what stands under MATERIALS
        for a in block.attributes if block.keyword == "MATERIALS" else ():
            if a.name == "ITEM-CODE":
                code = a.value
            elif a.name == "DESCRIPTION" and code is not None:
                texts.setdefault(code, a.value)
    return texts
