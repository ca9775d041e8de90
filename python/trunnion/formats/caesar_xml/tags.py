"""XML text to tags, with guards: no DTD, no entities, bounded depth, tags and attributes.

Numbers are attributes with six decimals; -1.0101 is a blank, and so are the nan and inf that the
program writes.
"""

from dataclasses import dataclass, field
from xml.parsers import expat

import numpy as np

from trunnion.formats.findings import Findings

MAX_DEPTH = 6
MAX_TAGS = 2_000_000
MAX_ATTRIBUTES = 200  # of one tag
BLANK = -1.0101
NEAR = 1e-4
LARGEST = 1e24  # CAD tools write 5e19 lb/in for a rigid restraint
_NO_NUMBERS = ("", "nan", "-nan", "inf", "-inf", "1.#ind", "-1.#ind", "1.#qnan", "nan(ind)")


@dataclass(slots=True)
class Tag:
    """One tag: local name, attributes in capitals, where it stands, what is inside."""

    name: str
    attributes: dict[str, str]
    line: int
    column: int
    inside: list["Tag"] = field(default_factory=list)

    def all(self, *names: str) -> list["Tag"]:
        """Children of some names."""
        return [tag for tag in self.inside if tag.name in names]


class RefusedError(ValueError):
    """XML that is not read, with the reason."""


def read_tags(findings: Findings) -> Tag | None:
    """Read the tree; None and a fault if there is none that is read."""
    parser = expat.ParserCreate("utf-8", namespace_separator=" ")
    parser.buffer_text = False
    root = Tag("", {}, 0, 0)
    open_tags = [root]
    count = 0

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if count > MAX_TAGS:
            raise RefusedError(f"more than {MAX_TAGS} tags")
        if len(open_tags) > MAX_DEPTH:
            raise RefusedError(f"tags are nested deeper than {MAX_DEPTH}")
        if len(attributes) > MAX_ATTRIBUTES:
            raise RefusedError(f"a tag has {len(attributes)} attributes; {MAX_ATTRIBUTES} at most")
        values = {_local(key): value for key, value in attributes.items()}
        tag = Tag(_local(name), values, parser.CurrentLineNumber, parser.CurrentColumnNumber)
        open_tags[-1].inside.append(tag)
        open_tags.append(tag)

    def end(_: str) -> None:
        open_tags.pop()

    def refuse(*_: object) -> None:
        raise RefusedError("a document type or entities: files of the program have none")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    parser.ExternalEntityRefHandler = refuse  # type: ignore[assignment]
    try:
        parser.Parse("\n".join(findings.source.lines).encode("utf-8", "replace"), True)
    except RefusedError as error:
        _fault(findings, parser.CurrentLineNumber, parser.CurrentColumnNumber, str(error))
        return None
    except expat.ExpatError as error:
        text = f"this is no well-formed XML: {expat.errors.messages[error.code]}"
        if error.code == expat.errors.codes[expat.errors.XML_ERROR_NO_ELEMENTS]:
            text = "this file is empty, or cut off"
        _fault(findings, error.lineno, error.offset, text)
        return None
    return root.inside[0]


def _local(name: str) -> str:
    """Name without namespace, in capitals."""
    return name.rpartition(" ")[2].upper()


def _fault(findings: Findings, line: int, column: int, text: str) -> None:
    findings.fault(min(max(line, 1), len(findings.source.lines) or 1), text, (column, column + 1))


def _single(value: float, text: str) -> float:
    """Undo the program's single precision: 88.900002 is 88.9, if it is just that in 32 bits."""
    single = np.float32(value)
    return float(str(single)) if f"{single:.6f}" == text else value


class Numbers:
    """Reads numbers of tags; None is a blank; what is no number is a fault with its place."""

    def __init__(self, findings: Findings) -> None:
        self.findings = findings

    def get(self, tag: Tag, name: str) -> float | None:
        """Value of an attribute, None if it is blank or not there."""
        text = tag.attributes.get(name, "").strip()
        if text.lower() in _NO_NUMBERS:
            return None
        try:
            value = float(text) if "_" not in text else None
        except ValueError:
            value = None
        if value is None:
            self.fault(tag, f'{name}="{text[:40]}" is no number')
            return None
        if value - value != 0.0 or abs(value - BLANK) < NEAR:
            return None
        if abs(value) > LARGEST:
            self.fault(tag, f'{name}="{text[:40]}" is too large')
            return None
        return _single(value, text)

    def of(self, tag: Tag, name: str, usual: float = 0.0) -> float:
        """Value of an attribute, or what a blank means."""
        value = self.get(tag, name)
        return usual if value is None else value

    def node(self, tag: Tag, name: str) -> int:
        """Node number; 0 if it is blank."""
        value = self.get(tag, name)
        if value is None:
            return 0
        if value != round(value) or not 0.0 <= value < 1e9:
            self.fault(tag, f"{name}: {value:g} is no node number")
            return 0
        return int(value)

    def whole(self, tag: Tag, name: str, usual: int = 0) -> int:
        """Whole number; -1 stands for "not set" in fields of this kind."""
        value = self.get(tag, name)
        if value is None or value == -1.0:
            return usual
        if value != round(value) or abs(value) > 1e9:
            self.fault(tag, f"{name}: {value:g} is no whole number")
            return usual
        return int(value)

    def fault(self, tag: Tag, text: str) -> None:
        """Note a fault at a tag."""
        columns = (tag.column, tag.column + len(tag.name) + 1)
        self.findings.fault(tag.line, f"{tag.name}: {text}", columns)
