"""The side table: what a PCF does not say, by pipeline, spec, item code, component and bore.

A table is TOML (rules, names of supports, meaning of attributes, materials) or CSV (rules only:
columns are the keys).  Keys and units are the deck's; plain numbers are mm, N, bar, C.
"""

import csv
import io
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import field
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from trunnion.deck import units as un
from trunnion.deck import values as va
from trunnion.deck.values import WordError, nearest
from trunnion.errors import DeckError, Problem
from trunnion.formats.source import Source, read_source
from trunnion.frozen import frozen
from trunnion.model import SETS, Material, Model, Place, Units

UNITS = Units("mm", "N", "bar", "C")
G = 9.80665
MAX_RULES = 10_000

#: what a rule sets, and its dimension
KEYS: dict[str, str] = {
    **{"OD": "length", "WALL": "length", "SCH": "text", "MATERIAL": "text"},
    **{"FLUID": "density", "INSULATION": "length", "INSULATION_DENSITY": "density"},
    **{"LINING": "length", "LINING_DENSITY": "density", "CORROSION": "length"},
    **{"WEIGHT": "weight", "TREF": "temperature"},
    **{f"T{n}": "temperature" for n in SETS},
    **{f"P{n}": "pressure" for n in SETS},
}
#: what a rule asks for: all that it names must fit
MATCHES = ("PIPELINE", "SPEC", "ITEM", "COMPONENT", "SKEY", "BORE", "NPS")
_PARTS = ("tolerance", "mu", "anchors", "defaults", "rule", "attributes", "supports", "materials")

Said = Mapping[str, Any]


@frozen
class Rule:
    """Values for the components that fit every pattern of `match`."""

    match: Mapping[str, str]
    values: Mapping[str, Any]

    def fits(self, said: Mapping[str, str | float | None]) -> bool:
        """Tell whether a component fits; texts by * and ?, BORE and NPS as numbers."""
        for name, wanted in self.match.items():
            value = said.get(name)
            if value is None:
                return False
            if isinstance(value, float):
                if abs(value - float(wanted)) > 0.05:
                    return False
            elif not fnmatchcase(value.upper(), wanted.upper()):
                return False
        return True


@frozen
class SideTable:
    """A side table; `supports` are deck words by name pattern, `attributes` keys by name."""

    rules: tuple[Rule, ...] = ()
    supports: Mapping[str, str] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)
    materials: Mapping[str, Material] = field(default_factory=dict)
    tolerance: float | None = None
    mu: float = 0.0  # friction of supports
    anchors: tuple[str, ...] = ()
    whole: bool = True  # False: it has faults, and none of it is used

    def values(self, said: Mapping[str, str | float | None]) -> dict[str, Any]:
        """Values of all rules that fit; a later rule wins."""
        found: dict[str, Any] = {}
        for rule in self.rules:
            if rule.fits(said):
                found.update(rule.values)
                if "WALL" in rule.values:
                    found.pop("SCH", None)
                elif "SCH" in rule.values:
                    found.pop("WALL", None)
        return found


def read_table(path: str | os.PathLike[str]) -> SideTable:
    """Read a side table.

    Raises
    ------
    DeckError : with every problem of the table.
    """
    source = read_source(path)
    return _Reader(source).table(Path(source.file).suffix.lower() == ".csv")


def value_of(key: str, value: Any, *, where: str = "") -> Any:
    """Value in SI of one key of a rule, or of an attribute of the file.

    Raises
    ------
    WordError : it cannot be read.
    """
    dimension = KEYS[key]
    if dimension == "text":
        return va.text(value) if not isinstance(value, (int, float)) else f"{value:g}"
    if dimension == "weight":
        return _weight(value)
    found = va.number(value, un.scales(UNITS)[dimension], dimension)
    if dimension == "temperature":
        if found < -273.15:
            raise WordError(f"{value} is below absolute zero")
    elif not (dimension == "pressure" or found >= 0.0) or abs(found) > 1e12:
        raise WordError(f"{key} = {value} is out of range")
    return found


def _weight(value: Any) -> float:
    """Weight [N] of a number with a unit of force or of mass."""
    try:
        found = va.number(value, un.scale_of("N", "force"), "force")
    except WordError as fault:
        try:
            found = G * va.number(value, un.scale_of("kg", "mass"), "mass")
        except WordError:
            raise fault from None
    if not 0.0 <= found < 1e12:
        raise WordError(f"WEIGHT = {value} is out of range")
    return found


class _Reader:
    """Reads one side table and collects its problems."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.problems: list[Problem] = []

    def table(self, is_csv: bool) -> SideTable:
        """Read the whole."""
        made = SideTable()
        if is_csv:
            made = SideTable(rules=tuple(self._csv()))
        else:
            try:
                data = tomllib.loads("\n".join(self.source.lines))
            except (tomllib.TOMLDecodeError, RecursionError) as error:
                self._fault(0, f"this is no TOML: {error}")
            else:
                made = self._toml(data)
        if self.problems:
            raise DeckError(self.problems)
        return made

    def _fault(self, line: int, text: str) -> None:
        self.problems.append(
            Problem(Place(self.source.file, line or 1), text, self.source.marker(line))
        )

    def _line(self, word: str) -> int:
        """First line that has a word: TOML keeps no lines."""
        lines = enumerate(self.source.lines, 1)
        return next((number for number, text in lines if word in text), 0)

    def _csv(self) -> Iterator[Rule]:
        rows = csv.reader(io.StringIO("\n".join(self.source.lines)), skipinitialspace=True)
        heads: list[str] = []
        for row in rows:
            cells = [cell.strip() for cell in row]
            if not any(cells) or cells[0].startswith("#"):
                continue
            if not heads:
                heads = [cell.upper().replace(" ", "_") for cell in cells]
                self._unknown(heads, rows.line_num, "column")
            elif len(cells) > len(heads):
                self._fault(rows.line_num, f"{len(cells)} cells under {len(heads)} headings")
            else:
                pairs = zip(heads, cells, strict=False)
                yield self._rule({k: v for k, v in pairs if v}, rows.line_num)

    def _unknown(self, names: list[str], line: int, what: str) -> None:
        known = (*MATCHES, *KEYS)
        for name in names:
            if name not in known:
                text = f"{what} {name} is not known{nearest(name, known)}"
                self._fault(line or self._line(name.lower()), text)

    def _rule(self, said: Said, line: int) -> Rule:
        """Read one rule."""
        match: dict[str, str] = {}
        values: dict[str, Any] = {}
        for name, value in said.items():
            word = name.upper()
            try:
                if word in MATCHES:
                    if word in ("BORE", "NPS"):
                        va.number(value, float, "number")
                    match[word] = str(value).strip()
                elif word in KEYS:
                    values[word] = value_of(word, value)
            except WordError as fault:
                self._fault(line or self._line(name), f"{word}: {fault}")
        return Rule(match, values)

    def _toml(self, data: Said) -> SideTable:
        for name in data:
            if name not in _PARTS:
                text = f"{name} is no part of a side table{nearest(name, _PARTS)}"
                self._fault(self._line(name), text)
        rules = self._all(data, "rule", list)
        defaults = self._all(data, "defaults", dict)
        for said in (defaults, *rules[:MAX_RULES]):
            if isinstance(said, dict):
                self._unknown([k.upper() for k in said], 0, "key")
            else:
                self._fault(self._line("rule"), "a rule is a table: [[rule]] on a line of its own")
        if len(rules) > MAX_RULES:
            self._fault(0, f"more than {MAX_RULES} rules")
        made = [self._rule(said, 0) for said in (defaults, *rules) if isinstance(said, dict)]
        return SideTable(
            tuple(made),
            self._texts(data, "supports", self._support),
            self._texts(data, "attributes", self._attribute),
            self._materials(self._all(data, "materials", dict)),
            self._tolerance(data.get("tolerance")),
            self._mu(data.get("mu", 0.0)),
            tuple(str(x) for x in self._all(data, "anchors", list)),
        )

    def _all(self, data: Said, name: str, kind: type) -> Any:
        value = data.get(name, kind())
        if not isinstance(value, kind):
            self._fault(self._line(name), f"{name} must be a {'list' if kind is list else 'table'}")
            return kind()
        return value

    def _texts(
        self, data: Said, name: str, read: Callable[[str, str], str | None]
    ) -> dict[str, str]:
        found = {}
        for key, value in self._all(data, name, dict).items():
            text = read(key, str(value))
            if text is not None:
                found[key.upper()] = text
        return found

    def _support(self, key: str, value: str) -> str | None:
        """Check the words of a support on a model of its own."""
        from trunnion.formats.pcf.supportwords import add_words

        try:
            add_words(Model(), "1", value, Place(self.source.file, self._line(key)), None)
        except DeckError as error:
            for problem in error.problems:
                self._fault(self._line(key), f"supports: {key}: {problem.text}")
            return None
        return value

    def _attribute(self, key: str, value: str) -> str | None:
        word = value.upper()
        if word in KEYS or word in ("SPEC", "ITEM"):
            return word
        text = f"attributes: {key} = {value}: not one of the keys{nearest(word, KEYS)}"
        self._fault(self._line(key), text)
        return None

    def _materials(self, data: Said) -> dict[str, Material]:
        """Read materials by the words of the MATERIAL card."""
        found = {}
        for name, keys in data.items():
            model = Model()
            try:
                if not isinstance(keys, dict):
                    raise WordError("a material is a table: E, NU, ALPHA, DENSITY or GRADE")
                model.material(name, **keys)
            except (DeckError, WordError, TypeError) as error:
                problems = getattr(error, "problems", None)
                texts = [p.text for p in problems] if problems else [str(error)]
                for text in texts:
                    self._fault(self._line(name), f"materials: {name}: {text}")
            else:
                found.update(model.materials)
        return found

    def _mu(self, value: Any) -> float:
        if (
            isinstance(value, bool)
            or not isinstance(value, (int, float))
            or not 0.0 <= value <= 2.0
        ):
            self._fault(self._line("mu"), f"mu = {value}: a number from 0 to 2")
            return 0.0
        return float(value)

    def _tolerance(self, value: Any) -> float | None:
        if value is None:
            return None
        try:
            found = va.number(value, un.scale_of("mm", "length"), "length")
        except WordError as fault:
            self._fault(self._line("tolerance"), f"tolerance: {fault}")
            return None
        if not 0.0 < found <= 0.1:
            self._fault(self._line("tolerance"), "tolerance must be above 0 and at most 100 mm")
        return found
