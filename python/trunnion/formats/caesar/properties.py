"""Materials, sections, temperatures and pressures of the elements."""

from dataclasses import replace

from trunnion.formats.caesar import materials as mt
from trunnion.formats.caesar.job import Element, Job
from trunnion.formats.caesar.units import clean
from trunnion.formats.findings import Findings
from trunnion.model import SETS, Material, Model, Operation, Section

STRAINED = 100.0  # warming of an element whose largest expansion the file gives [K]
THIN = 1e-3  # of the OD: a wall below is none that anybody makes
HOT = 1.0  # a temperature this near to ambient needs no expansion [K]
USUAL_INSULATION = 0.006655  # lb/in3: of the program where none is given


class Properties:
    """Makes each material and section once, with a name that a reader knows."""

    def __init__(self, job: Job, model: Model, findings: Findings) -> None:
        self.job = job
        self.model = model
        self.findings = findings
        given = [
            {n for n in range(9) if (e.t[n], e.strain[n]) != (None, None)} for e in job.elements
        ]
        self.t_sets = sorted(set().union(*given))
        self.p_sets = [n for n in range(9) if any(e.p[n] is not None for e in job.elements)]
        self._materials: dict[tuple[object, ...], str] = {}
        self._sections: dict[tuple[float, ...], str] = {}
        self._wall = 0.0

    def operation(self, e: Element) -> Operation:
        """Temperatures and pressures; a blank is ambient, and no pressure."""
        ambient, alpha = self.job.ambient, coefficient(e)
        if alpha:
            e = replace(e, t=tuple(None if x is None else ambient + x / alpha for x in e.strain))
            text = (
                "expansions (length by length) instead of temperatures have a coefficient of their "
            )
            self.findings.assume(f"{text}own and are written as temperatures", e.line)
        t = {SETS[n]: ambient if e.t[n] is None else e.t[n] for n in self.t_sets}
        cold = [SETS[n] for n in self.t_sets if e.t[n] is None]
        if cold:
            text = f"T{' T'.join(cold)} of some elements is 0 or a blank: "
            self.findings.assume(f"{text}taken as the ambient temperature, {ambient:g} C", e.line)
        p = {SETS[n]: e.p[n] or 0.0 for n in self.p_sets}
        return Operation({k: float(v) for k, v in t.items() if v is not None}, p, ambient)

    def material(self, e: Element) -> str:
        """Name of the element's material."""
        key = (e.material, e.e, e.nu, e.density, coefficient(e))
        if key not in self._materials:
            self._materials[key] = self._new_material(e)
        name = self._materials[key]
        self._warn_of_expansion(e)
        return name

    def section(self, e: Element) -> str:
        """Name of the element's section."""
        wall = e.wall
        if wall <= 0.0 and e.rigid is not None and self._wall:
            text = "rigid elements without a wall have that of the element before"
            self.findings.assume(text, e.line)
            wall = self._wall
        if not (e.od > 0.0 and 0.0 < wall <= 0.5 * e.od):
            name = f"element {e.start}-{e.end}"
            text = f"{name}: no pipe has an OD of {e.od * 1e3:g} mm and a wall of {wall * 1e3:g} mm"
            self.findings.fault(e.line, text)
            return ""
        self._wall = wall
        if wall < THIN * e.od:
            text = (
                f"a wall of {1e3 * wall:g} mm at an OD of {1e3 * e.od:g} mm looks like a stand-in"
            )
            self.findings.assume(f"{text}: weight and stiffness follow from it", e.line)
        weight = e.cover_weight or self._cladding(e, wall)
        insulation_density = 0.0 if e.cover_weight else e.insulation_density
        lining = min(e.lining, 0.5 * e.od - wall)
        values = (
            *(e.od, wall, e.fluid_density, lining, e.lining_density if lining > 0.0 else 0.0),
            *(e.insulation, insulation_density if e.insulation > 0.0 else 0.0),
            *(weight, e.corrosion),
        )
        if any(x < 0.0 for x in values):
            text = f"element {e.start}-{e.end}: a thickness, density or weight is negative"
            self.findings.fault(e.line, text)
            return ""
        if values not in self._sections:
            self._sections[values] = self._new_section(e, values)
        return self._sections[values]

    def _new_material(self, e: Element) -> str:
        """Make a material; the number may be unknown."""
        family = mt.FAMILIES.get(e.material)
        called = f" ({e.material_name})" if e.material_name else ""
        if family is None and (family := mt.family_by_name(e.material_name)) is not None:
            text = f"material {e.material}{called} expands as {family.name}, by its name"
            self.findings.assume(text, e.line)
        name = _unused(mt.name_of(e.material), self.model.materials)
        if e.nu and not 0.0 < e.nu < 0.5:
            self.findings.fault(e.line, f"element {e.start}-{e.end}: Poisson's ratio {e.nu:g}")
            return name
        if e.material == mt.PLASTIC:
            self._leave_out(e, "material 20: fibre reinforced plastic; taken as isotropic")
        elif family is None and e.material not in (mt.CUT_SHORT, mt.CUT_LONG) and self._lacks(e):
            lacking = "expansion" if e.e and e.nu and e.density else "constants"
            text = f"material {e.material}{called} is not known, and its {lacking} not in the file"
            self._leave_out(e, f"{text}; taken as carbon steel (change MATERIAL in the deck)")
        family = family or mt.FAMILIES[1]
        late = self.job.version >= mt.LATE_VERSION
        made = mt.material_of(name, family, e.e, e.nu, e.density, late=late)
        if late and (made.grade or "").endswith(mt.IID):
            text = "carbon and low alloy steels expand by ASME II-D Table TE-1, as in versions "
            self.findings.assume(f"{text}from {mt.LATE_VERSION:g} on (before: B31.3 Table C-1)")
        alpha = coefficient(e)
        if alpha:
            made = Material(made.name, made.e, made.nu, alpha, made.density)
        made = replace(made, place=self.findings.place(e.line))
        self.model.materials[name] = made
        given = [w for w, x in (("E", e.e), ("NU", e.nu), ("DENSITY", e.density)) if x]
        source = f"{', '.join(given)} as in the file" if given else "constants of its data base"
        source += ", expansion as in the file" if alpha else ""
        self.findings.note(made, f"material {e.material} ({family.name}): {source}")
        return name

    def _lacks(self, e: Element) -> bool:
        """Tell whether a material that is not known is hot anywhere, or has no constants."""
        same = [x for x in self.job.elements if x.material == e.material]
        hot = any(t is not None and abs(t - self.job.ambient) > HOT for x in same for t in x.t)
        return hot or not (e.e and e.nu and e.density)

    def _warn_of_expansion(self, e: Element) -> None:
        """A material without a table of expansion must not be hot."""
        family = mt.FAMILIES.get(e.material)
        if family is None or family.grade is not None or coefficient(e):
            return
        if any(t is not None and abs(t - self.job.ambient) > HOT for t in e.t):
            text = f"material {e.material} ({family.name}): its expansion is known at 21 C only"
            self._leave_out(e, f"{text}; that one is taken at all temperatures", once=text)

    def _new_section(self, e: Element, values: tuple[float, ...]) -> str:
        length = {"mm": 1e-3, "cm": 1e-2, "in": 0.0254, "ft": 0.0254, "m": 1e-3}
        unit = length.get(self.model.units.length, 1e-3)
        base = f"{e.od / unit:.5g}X{values[1] / unit:.4g}"
        name = _unused(base, self.model.sections)
        od, wall, fluid, lining, lining_density, insulation, insulation_density, *rest = values
        made = Section(
            *(name, od, wall, fluid, lining, lining_density, insulation, insulation_density),
            *(rest[0], rest[1]),
            place=self.findings.place(e.line),
        )
        self.model.sections[name] = made
        self.findings.note(made, f"first used by element {e.start}-{e.end} (line {e.line})")
        return name

    def _cladding(self, e: Element, wall: float) -> float:
        """Weight of a cladding around the insulation [N/m]."""
        inside = e.od + 2.0 * e.insulation
        outside = inside + 2.0 * e.cladding
        area = 0.25 * 3.141592653589793 * (outside**2 - inside**2)
        return area * e.cladding_density * self.model.settings.g

    def _leave_out(self, e: Element, text: str, once: str = "") -> None:
        """Say it once for a material."""
        key = ("said", once or text)
        if key not in self._materials:
            self._materials[key] = text
            self.findings.leave_out(e.line, f"element {e.start}-{e.end}", text)


def coefficient(e: Element) -> float | None:
    """Coefficient of an element that has expansions instead of temperatures, else None [1/K]."""
    largest = max((abs(x) for x in e.strain if x is not None), default=0.0)
    if not largest or any(t is not None for t in e.t):
        return None
    return clean(largest / STRAINED)


def _unused(name: str, known: dict[str, Material] | dict[str, Section]) -> str:
    """Append a number to a name that is taken."""
    found, n = name, 1
    while found in known:
        n += 1
        found = f"{name}_{n}"
    return found
