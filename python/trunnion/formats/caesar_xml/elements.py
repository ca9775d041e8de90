"""PIPINGELEMENT tags to elements: blanks take the value of the element before in the file."""

from trunnion.formats.caesar.job import Element, HangerData, Nine, Nozzle, Restraint, Sets
from trunnion.formats.caesar.units import INCH, POUND, FileUnits
from trunnion.formats.caesar_xml.children import Children
from trunnion.formats.caesar_xml.tags import Numbers, Tag

STRAIN = 0.05  # a "temperature" smaller than this is the expansion itself
INSULATION = 0.006655 * POUND / INCH**3  # kg/m3: of the program where none is given
_SETS = "123456789"
CARRIED = (
    *("DIAMETER", "WALL_THICK", "INSUL_THICK", "CORR_ALLOW", "MODULUS", "POISSONS"),
    *("PIPE_DENSITY", "INSUL_DENSITY", "FLUID_DENSITY", "REFRACTORY_DENSITY", "REFRACTORY_THK"),
    *("CLADDING_DEN", "CLADDING_THK", "INSUL_CLAD_UNIT_WEIGHT", "MATERIAL_NUM"),
    *(f"TEMP_EXP_C{n}" for n in _SETS),
    *(f"PRESSURE{n}" for n in _SETS),
)
_OTHER = (
    *("FROM_NODE", "TO_NODE", "DELTA_X", "DELTA_Y", "DELTA_Z", "NAME", "HYDRO_PRESSURE"),
    *("MATERIAL_NAME", "MILL_TOL_PLUS", "MILL_TOL_MINUS", "SEAM_WELD", "LINE_NUMBER", "LINENUMBER"),
    *(f"HOT_MOD{n}" for n in _SETS),
    *("WELD_STRENGTH_REDUCTION", "STRENGTH_REDUCTION"),
)
KNOWN = frozenset((*CARRIED, *_OTHER))
NOZZLES = ("WRC297_NOZZLE", "API650_NOZZLE", "BS5500_NOZZLE", "PD5500_NOZZLE", "USERDEFINED_NOZZLE")
CHECKS = {"SIF": "SIF&TEES", "ALLOWABLESTRESS": "ALLOWBLS", "FLANGES": "FLANGES"}
_CHILDREN = frozenset(
    (
        *("BEND", "RIGID", "RESTRAINT", "DISPLACEMENTS", "FORCESMOMENTS", "HANGER"),
        *("EXPANSIONJOINT", "UNIFORMLOAD", "WIND", "WAVE", "OFFSET", "REDUCER", "EQUIPMENT"),
        *NOZZLES,
        *CHECKS,
    )
)


class Elements:
    """Reads the elements one after another."""

    def __init__(self, numbers: Numbers, units: FileUnits, *, guide: bool = False) -> None:
        self.numbers = numbers
        self.findings = numbers.findings
        self.units = units
        self.children = Children(numbers, units, guide=guide)
        self.before: dict[str, float | None] = dict.fromkeys(CARRIED)
        self.hangers: list[HangerData] = []
        self.nozzles: list[Nozzle] = []

    def element(self, tag: Tag) -> Element:
        """Read one element and all that hangs on it."""
        n, u, c = self.numbers, self.units, self.children
        start, end = n.node(tag, "FROM_NODE"), n.node(tag, "TO_NODE")
        if not (start and end):
            n.fault(tag, "FROM_NODE and TO_NODE must be numbers of nodes")
        name = f"element {start}-{end}"
        self._unknown(tag, name)
        for key in CARRIED:
            value = n.get(tag, key)
            if value is not None:
                self.before[key] = value
        at = self.before
        t, strain = self._temperatures()
        insulation = (at["INSUL_THICK"] or 0.0) * u.wall
        density = at["INSUL_DENSITY"]
        if insulation > 0.0 and density is None:
            text = "insulation without a density has that of the program, 184.2 kg/m3"
            self.findings.assume(text, tag.line)
        dx, dy, dz = (n.of(tag, f"DELTA_{axis}") * u.compound for axis in "XYZ")
        bends, rigids = tag.all("BEND"), tag.all("RIGID")
        self._once(tag, name)
        self._lists(tag)
        return Element(
            tag.line,
            start,
            end,
            (dx, dy, dz),
            (at["DIAMETER"] or 0.0) * u.diameter,
            (at["WALL_THICK"] or 0.0) * u.wall,
            self._material(tag),
            insulation,
            (at["CORR_ALLOW"] or 0.0) * u.wall,
            t,
            strain,
            self._pressures(),
            self._positive(tag, "MODULUS") * u.modulus,
            self._positive(tag, "POISSONS"),
            self._positive(tag, "PIPE_DENSITY") * u.pipe_density,
            INSULATION if density is None else density * u.insulation_density,
            self._positive(tag, "FLUID_DENSITY") * u.fluid_density,
            (at["CLADDING_THK"] or 0.0) * u.wall,
            (at["CLADDING_DEN"] or 0.0) * u.insulation_density,
            (at["INSUL_CLAD_UNIT_WEIGHT"] or 0.0) * u.load,
            (at["REFRACTORY_THK"] or 0.0) * u.wall,
            (at["REFRACTORY_DENSITY"] or 0.0) * u.insulation_density,
            tag.attributes.get("NAME", "").strip(),
            bend=c.bend(bends[0]) if bends else None,
            rigid=c.rigid(rigids[0]) if rigids else None,
            joint=next((c.joint(x) for x in tag.all("EXPANSIONJOINT")), None),
            restraints=self._restraints(tag, name),
            displacements=self._sets(tag, "DISPLACEMENTS"),
            forces=self._sets(tag, "FORCESMOMENTS"),
            uniform=next((c.uniform(x, name) for x in tag.all("UNIFORMLOAD")), None),
            wind=next((c.wind(x) for x in tag.all("WIND", "WAVE")), None),
            offsets=next((c.offsets(x) for x in tag.all("OFFSET")), None),
            reducer=next((c.reducer(x) for x in tag.all("REDUCER")), None),
            checks=tuple(dict.fromkeys(CHECKS[x.name] for x in tag.inside if x.name in CHECKS)),
            sifs=tuple(s for s in map(c.sif, tag.all("SIF")) if all(s)),
            material_name=tag.attributes.get("MATERIAL_NAME", "").strip()[:80],
            code=next((n.whole(x, "PIPING_CODE") for x in tag.all("ALLOWABLESTRESS")), None),
        )

    def _once(self, tag: Tag, name: str) -> None:
        """Say what stands twice where only one can be."""
        for kind in ("BEND", "RIGID", "EXPANSIONJOINT", "OFFSET", "REDUCER"):
            if len(tag.all(kind)) > 1:
                self.numbers.fault(tag, f"{name} has {len(tag.all(kind))} {kind}")

    def _unknown(self, tag: Tag, name: str) -> None:
        """Say what of an element is not known."""
        for key in tag.attributes:
            if key not in KNOWN and not key.startswith(("ORIENT", "COLOR", "VISIB")):
                self.findings.assume(f"attribute {key[:40]} of PIPINGELEMENT is not known; ignored")
        for child in tag.inside:
            if child.name not in _CHILDREN and (child.attributes or child.inside):
                text = f"{child.name[:40]}, which is not known here"
                self.findings.leave_out(child.line, name, text)

    def _positive(self, tag: Tag, key: str) -> float:
        value = self.before[key] or 0.0
        if value < 0.0:
            self.numbers.fault(tag, f"{key} {value:g} is negative")
            return 0.0
        return value

    def _material(self, tag: Tag) -> int:
        value = self.before["MATERIAL_NUM"] or 0.0
        if value != round(value) or not 0.0 <= value < 1e6:
            self.numbers.fault(tag, f"MATERIAL_NUM {value:g} is no number of a material")
            return 0
        return int(value)

    def _temperatures(self) -> tuple[Nine, Nine]:
        """Temperatures [C], and strains where the file has those instead; 0 is no strain."""
        t: list[float | None] = []
        strain: list[float | None] = []
        for n in _SETS:
            value = self.before[f"TEMP_EXP_C{n}"]
            small = value is not None and abs(value) < STRAIN
            t.append(None if value is None or small else self.units.celsius(value))
            strain.append(value if small and value else None)
        return tuple(t), tuple(strain)

    def _pressures(self) -> Nine:
        values = (self.before[f"PRESSURE{n}"] for n in _SETS)
        return tuple(None if x is None else x * self.units.pressure for x in values)

    def _restraints(self, tag: Tag, name: str) -> tuple[Restraint, ...]:
        found = (self.children.restraint(x, name) for x in tag.all("RESTRAINT"))
        return tuple(r for r in found if r is not None)

    def _sets(self, tag: Tag, kind: str) -> tuple[Sets, ...]:
        read = self.children.displacements if kind == "DISPLACEMENTS" else self.children.forces
        return tuple(s for s in map(read, tag.all(kind)) if s is not None)

    def _lists(self, tag: Tag) -> None:
        """Collect hangers and nozzles, which name their node."""
        self.hangers += [h for h in map(self.children.hanger, tag.all("HANGER")) if h is not None]
        self.nozzles += [z for z in map(self.children.nozzle, tag.all(*NOZZLES)) if z is not None]
