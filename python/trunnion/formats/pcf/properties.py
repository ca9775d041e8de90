"""Section, material, temperatures and weight of components: attributes, side table, nominal size.

The order: defaults of the table, then what the file says (attributes that the table gives a
meaning), then rules of the table.  What stays open is an error that names the component.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from trunnion.deck.values import WordError
from trunnion.formats.findings import Findings
from trunnion.formats.pcf.bores import Bores, outside
from trunnion.formats.pcf.parts import Line, Part
from trunnion.formats.pcf.points import LARGEST, plain
from trunnion.formats.sidetable import G, SideTable, value_of
from trunnion.frozen import frozen
from trunnion.library.materials import library_material
from trunnion.library.names import UnknownName
from trunnion.library.sections import pipe_size
from trunnion.model import SETS, Material, Model, Operation, Section

DEFAULT_GRADE = "A106-B"
DEFAULT_SCHEDULE = "STD"
_COVERS = (*("FLUID", "LINING", "LINING_DENSITY", "INSULATION", "INSULATION_DENSITY", "CORROSION"),)
_FALLBACK = 1.0e-3  # wall of what has an error anyway [m]


@frozen
class Properties:
    """What one run of pipe is made of: names in the model, and the rules' values."""

    section: str
    material: str
    operation: Operation


class Resolver:
    """Gives components their properties, and the model its sections and materials."""

    def __init__(
        self, model: Model, line: Line, bores: Bores, table: SideTable, findings: Findings
    ) -> None:
        self.model = model
        self.line = line
        self.bores = bores
        self.table = table
        self.findings = findings
        self._values: dict[tuple[int, float | None], dict[str, Any]] = {}
        self._names: dict[tuple[Any, ...], str] = {}
        self._said: set[tuple[str, Any]] = set()
        self._operations: dict[tuple[Any, ...], Operation] = {}

    def values(self, part: Part, bore: float | None) -> dict[str, Any]:
        """All values of a component at one of its bores."""
        key = (part.line, bore)
        if key not in self._values:
            self._values[key] = self._collect(part, bore)
        return self._values[key]

    def outside(self, part: Part) -> float:
        """Outside diameter [m]; 0 if it is not known."""
        given = self.values(part, part.bore).get("OD")
        inches = self.bores.inches.get(part.bore) if part.bore else None
        return float(given or (outside(inches) if inches else None) or 0.0)

    def properties(self, part: Part, bore: float | None) -> Properties:
        """Section, material and operation of a component at one of its bores."""
        values = self.values(part, bore)
        return Properties(
            self._section(part, bore, values),
            self._material(part, values),
            self._operation(values),
        )

    def weight(self, part: Part) -> float | None:
        """Weight of a component [N]: of the table, of its WEIGHT; None if nothing says it."""
        values = self.values(part, part.bore)
        return float(values["WEIGHT"]) if "WEIGHT" in values else None

    def _collect(self, part: Part, bore: float | None) -> dict[str, Any]:
        named = {"SPEC": part.get("PIPING-SPEC"), "ITEM": part.get("ITEM-CODE")}
        for name, word in self.table.attributes.items():
            if word in named:
                named[word] = part.get(name) or named[word]
        said: dict[str, str | float | None] = {
            **named,
            "PIPELINE": part.pipeline,
            "COMPONENT": part.keyword,
            "SKEY": part.get("SKEY"),
            "BORE": bore,
            "NPS": self.bores.inches.get(bore) if bore else None,
        }
        defaults = (
            self.table.rules[:1] if self.table.rules and not self.table.rules[0].match else ()
        )
        found: dict[str, Any] = dict(defaults[0].values) if defaults else {}
        found |= self._attributes(part)
        rules = SideTable(rules=self.table.rules[len(defaults) :]).values(said)
        for one, other in (("WALL", "SCH"), ("SCH", "WALL")):
            if one in rules:
                found.pop(other, None)
        return found | rules

    def _attributes(self, part: Part) -> dict[str, Any]:
        """Values that the file itself gives."""
        found: dict[str, Any] = {}
        weight = part.get("WEIGHT")
        if weight is not None:
            number = plain(weight.split()[0])
            if number is not None and 0.0 < number <= LARGEST:
                found["WEIGHT"] = number * self.line.weight * G
        for name, key in self.table.attributes.items():
            text = part.get(name)
            if text is None or key in ("SPEC", "ITEM"):
                continue
            words = text.split()
            number = plain(words[0])
            wordy = number is None and not words[0][:1].isdigit()
            if key not in ("MATERIAL", "SCH") and (wordy or abs(number or 0.0) > LARGEST):
                continue  # a placeholder is no value
            try:
                found[key] = value_of(key, "".join(words))
            except WordError as fault:
                line = next((a.line for a in part.attributes if a.name == name), part.line)
                self.findings.fault(line, f"{part.name}: {name} as {key}: {fault}")
        return found

    def _section(self, part: Part, bore: float | None, values: Mapping[str, Any]) -> str:
        inches = self.bores.inches.get(bore) if bore else None
        od, wall, schedule = values.get("OD"), values.get("WALL"), values.get("SCH")
        if od is None:
            od = outside(inches) if inches else None
        if od is None:
            what = f"bore {bore:g} is no nominal size" if bore else "it has no bore"
            self._once(part, "OD", bore, f"{what}; give OD and WALL in the side table (--table)")
            od = 0.1
        schedule = None if schedule is None else str(schedule).upper()
        if wall is None and schedule is None:
            said = f"wall of bore {bore or 0.0:g} is not in the file"
            self._missing(part, "WALL", bore, said, f"schedule {DEFAULT_SCHEDULE}")
            schedule = DEFAULT_SCHEDULE
        if wall is None and schedule is not None:
            wall = self._scheduled(part, inches, schedule)
        elif wall is not None and not 0.0 < wall <= 0.5 * od:
            text = f"wall {1e3 * wall:g} mm does not fit OD {1e3 * od:g} mm"
            self._once(part, "WALL", bore, text)
        standard = wall is not None and schedule is not None and "OD" not in values
        size = (f"{inches:g}", schedule) if standard and inches else (None, None)
        wall = min(_FALLBACK, 0.25 * od) if wall is None else wall
        return self._named((od, wall, *(float(values.get(k, 0.0)) for k in _COVERS)), size, part)

    def _scheduled(self, part: Part, inches: float | None, schedule: str) -> float | None:
        try:
            if inches is not None:
                return pipe_size(nps=inches, schedule=schedule)[1]
        except UnknownName as fault:
            self._once(part, "SCH", (inches, schedule), str(fault))
        return None

    def _named(
        self, values: tuple[float, ...], size: tuple[str | None, str | None], part: Part
    ) -> str:
        """Name of the section of these values, made when it is new."""
        key = (*values, *size)
        if key not in self._names:
            od, wall, fluid, lining, lining_density, insulation, insulation_density, corrosion = (
                values
            )
            nps, schedule = size
            base = f"{nps}IN-{schedule}" if nps else f"P{1e3 * od:.4g}X{1e3 * wall:.4g}"
            name, n = base, 2
            while name in self.model.sections:
                name, n = f"{base}-{n}", n + 1
            self.model.sections[name] = Section(
                name, od, wall, fluid, lining, lining_density, insulation, insulation_density,
                corrosion=corrosion, nps=nps, schedule=schedule,
                place=self.findings.place(part.line),
            )  # fmt: skip
            self._names[key] = name
        return self._names[key]

    def _material(self, part: Part, values: Mapping[str, Any]) -> str:
        said = values.get("MATERIAL")
        if said is None:
            self._missing(part, "MATERIAL", "", "material is not in the file", DEFAULT_GRADE)
            said = DEFAULT_GRADE
        key = str(said).upper()
        if key not in self.model.materials:
            material: Material | None = self.table.materials.get(key)
            if material is None:
                try:
                    material = library_material(str(said))
                except UnknownName as fault:
                    self._once(part, "MATERIAL", key, f"{fault}; define it under [materials]")
                    material = Material(key, 2e11)
            self.model.materials[key] = replace(material, name=key)
        return key

    def _operation(self, values: Mapping[str, Any]) -> Operation:
        key = tuple(
            values.get(k) for k in ("TREF", *(f"T{n}" for n in SETS), *(f"P{n}" for n in SETS))
        )
        if key not in self._operations:
            t = {n: float(values[f"T{n}"]) for n in SETS if f"T{n}" in values}
            p = {n: float(values[f"P{n}"]) for n in SETS if f"P{n}" in values}
            self._operations[key] = Operation(t, p, float(values.get("TREF", 20.0)))
        return self._operations[key]

    def _missing(self, part: Part, key: str, about: Any, text: str, taken: str) -> None:
        """Say once what is missing; a default is taken for it where that is permitted."""
        if (key, about) in self._said:
            return
        self._said.add((key, about))
        if self.findings.permissive:
            self.findings.leave_out(part.line, part.name, f"{text}; taken as {taken}")
            return
        advice = f"give {key} in the side table (--table), or --permissive takes {taken}"
        self.findings.fault(part.line, f"{part.name}: {text}; {advice}")

    def _once(self, part: Part, key: str, about: Any, text: str) -> None:
        if (key, about) not in self._said:
            self._said.add((key, about))
            self.findings.fault(part.line, f"{part.name}: {text}")
