"""What hangs on an element: bends, rigids, restraints, displacements, forces, hangers ..."""

from math import radians

from trunnion.formats.caesar.auxiliary import FREE as UNLIMITED
from trunnion.formats.caesar.auxiliary import RIGID, RIGID_TURNING, ROTATIONAL
from trunnion.formats.caesar.job import (
    BendData,
    HangerData,
    JointData,
    Nozzle,
    Offsets,
    ReducerData,
    Restraint,
    RigidData,
    Sets,
    Six,
    Uniform,
    WindData,
)
from trunnion.formats.caesar.units import FileUnits
from trunnion.formats.caesar_xml.restrainttypes import code_of
from trunnion.formats.caesar_xml.tags import Numbers, Tag

_RIGIDS = {"UNSPECIFIED": 0, "VALVE": 1, "FLANGE": 2, "FLANGE PAIR": 3, "FLANGED VALVE": 4}
_MOVES = ("DX", "DY", "DZ", "RX", "RY", "RZ")
_PUSHES = ("FX", "FY", "FZ", "MX", "MY", "MZ")
FREE: Six = (None,) * 6
STILL: Six = (0.0,) * 6


class Children:
    """Reads the children of elements in the units of a file."""

    def __init__(self, numbers: Numbers, units: FileUnits, *, guide: bool = False) -> None:
        self.guide = guide  # restraint types are those of the guide
        self.numbers = numbers
        self.findings = numbers.findings
        self.units = units

    def bend(self, tag: Tag) -> BendData:
        """Read BEND: radius, flanges, up to three nodes on the arc."""
        n = self.numbers
        nodes = []
        for k in "123":
            node, angle = n.node(tag, f"NODE{k}"), n.get(tag, f"ANGLE{k}")
            if node and angle is not None:
                nodes.append((angle, node))
        radius = n.of(tag, "RADIUS")
        if radius <= 0.0:
            n.fault(tag, f"a bend of radius {radius:g} cannot be")
        flanges = n.whole(tag, "TYPE")
        return BendData(
            tag.line,
            max(radius, 1e-9) * self.units.length,
            flanges if flanges in (0, 1, 2) else 0,
            tuple(nodes),
            max(0, n.whole(tag, "NUM_MITER")),
            max(0.0, n.of(tag, "FITTINGTHICKNESS")) * self.units.wall,
            n.of(tag, "KFACTOR"),
        )

    def rigid(self, tag: Tag) -> RigidData:
        """Read RIGID: weight and kind."""
        kind = _RIGIDS.get(tag.attributes.get("TYPE", "").strip().upper(), 0)
        weight = self.numbers.of(tag, "WEIGHT")
        if weight < 0.0:
            self.numbers.fault(tag, f"weight {weight:g} is negative")
        return RigidData(tag.line, max(weight, 0.0) * self.units.force, kind)

    def restraint(self, tag: Tag, name: str) -> Restraint | None:
        """Read one slot; None where it is not used, or what it is cannot be told."""
        n = self.numbers
        node, code = n.node(tag, "NODE"), n.get(tag, "TYPE")
        if not node or code is None:
            return None
        cosines = tuple(n.of(tag, f"{axis}COSINE") for axis in "XYZ")
        known, doubt = code_of(code, cosines, guide=self.guide)
        if doubt:
            self.findings.leave_out(tag.line, f"{name}, node {node}", doubt)
        if known is None:
            return None
        return self._known(tag, node, known, (cosines[0], cosines[1], cosines[2]))

    def _known(
        self, tag: Tag, node: int, code: int, cosines: tuple[float, float, float]
    ) -> Restraint:
        n, units = self.numbers, self.units
        turning = code in ROTATIONAL
        stiffness = n.get(tag, "STIFFNESS")
        gap, mu = n.of(tag, "GAP"), n.of(tag, "FRIC_COEF")
        k = None if stiffness is None else stiffness * (units.kr if turning else units.kt)
        if gap < 0.0 or mu < 0.0 or (k is not None and k < 0.0):
            n.fault(tag, f"node {node}: a restraint has a negative stiffness, gap or friction")
            k, gap, mu = None, abs(gap), abs(mu)
        if k == 0.0:
            self.findings.assume("restraints with a stiffness of 0 are rigid", tag.line)
        return Restraint(
            tag.line,
            node,
            code,
            None if not k or k >= (RIGID_TURNING if turning else RIGID) else k,
            radians(gap) if turning else gap * units.length,
            mu,
            n.node(tag, "CNODE"),
            cosines,
            tag.attributes.get("TAG", "").strip(),
        )

    def displacements(self, tag: Tag) -> Sets | None:
        """Read DISPLACEMENTS; the program leaves out a vector of six zeros, which *holds*."""
        node = self.numbers.node(tag, "NODE_NUM")
        if not node:
            return None
        rows: list[Six] = [FREE] * 9
        found = self._vectors(tag, _MOVES)
        factors = (*(self.units.length,) * 3, *(radians(1.0),) * 3)
        for k, values in found.items():
            rows[k] = tuple(
                None if x is None or abs(x) >= UNLIMITED - 0.01 else x * f
                for x, f in zip(values, factors, strict=True)
            )
        held = [k for k in range(9) if k not in found and (k == 0 or len(found) >= 5)]
        for k in held:
            rows[k] = STILL
        return Sets(tag.line, node, tuple(rows))

    def forces(self, tag: Tag) -> Sets | None:
        """Read FORCESMOMENTS; blanks are 0."""
        node = self.numbers.node(tag, "NODE_NUM")
        if not node:
            return None
        rows: list[Six] = [STILL] * 9
        factors = (*(self.units.force,) * 3, *(self.units.moment,) * 3)
        for k, values in self._vectors(tag, _PUSHES).items():
            rows[k] = tuple((x or 0.0) * f for x, f in zip(values, factors, strict=True))
        return Sets(tag.line, node, tuple(rows))

    def _vectors(self, tag: Tag, names: tuple[str, ...]) -> dict[int, Six]:
        """Read the VECTOR tags by their number, from 0."""
        found: dict[int, Six] = {}
        for vector in tag.all("VECTOR"):
            k = self.numbers.whole(vector, "NUMBER") - 1
            if not 0 <= k < 9:
                self.numbers.fault(vector, f"vector {k + 1} is not one of 1 to 9")
            else:
                found[k] = tuple(self.numbers.get(vector, name) for name in names)
        return found

    def hanger(self, tag: Tag) -> HangerData | None:
        """Read HANGER; the rate of a spring is not in the file."""
        n = self.numbers
        node = n.node(tag, "NODE")
        if not node:
            return None
        cold, constant = n.of(tag, "COLD_LOAD"), n.of(tag, "CONST_EFF_LOAD")
        if cold > 0.0 and constant <= 0.0:
            text = (
                "spring hanger that is given: its rate is not in the XML (the neutral file has it)"
            )
            self.findings.leave_out(tag.line, f"node {node}", f"{text}; taken as one to design")
            cold = 0.0
        return HangerData(
            tag.line,
            node,
            cold_load=cold * self.units.force,
            hot_load=max(0.0, n.of(tag, "HOT_LOAD")) * self.units.force,
            constant=max(0.0, constant) * self.units.force,
            variation=n.get(tag, "LOAD_VAR") or 25.0,
            rod=max(0.0, n.of(tag, "RIGID_SUP")) * self.units.length,
            most=self._most(tag),
            space=self._travel(tag, "AVAIL_SPACE"),
            number=max(1, n.whole(tag, "NUM_HGR", 1)),
            cnode=n.node(tag, "CNODE"),
            table=max(0, n.whole(tag, "HGR_TABLE")),
            tag=tag.attributes.get("TAG", "").strip(),
            free=self._freed(tag),
        )

    def _travel(self, tag: Tag, name: str) -> float:
        """Read a length of a hanger [m]; 9999.99 stands for none."""
        value = self.numbers.of(tag, name)
        return value * self.units.length if abs(value) < UNLIMITED - 0.01 else 0.0

    def _most(self, tag: Tag) -> float | None:
        """Read the travel above which a constant support is taken [m]."""
        travel = self._travel(tag, "MAX_TRAVEL")
        return travel if travel > 0.0 else None

    def _freed(self, tag: Tag) -> tuple[tuple[int, int], ...]:
        """Nodes that a hanger's design frees, and the codes of their freedoms."""
        n = self.numbers
        pairs = ((n.node(tag, f"FREEANCHOR{k}"), n.whole(tag, f"DOFTYPE{k}", 1)) for k in "12")
        return tuple((node, code) for node, code in pairs if node)

    def joint(self, tag: Tag) -> JointData:
        """Read EXPANSIONJOINT."""
        n, u = self.numbers, self.units
        return JointData(
            tag.line,
            n.of(tag, "AXIAL_STIF") * u.kt,
            n.of(tag, "TRANS_STIF") * u.kt,
            n.of(tag, "BEND_STIF") * u.kr,
            n.of(tag, "TORS_STIF") * u.kr,
            n.of(tag, "BEL_DIA") * u.diameter,
        )

    def offsets(self, tag: Tag) -> Offsets:
        """Read OFFSET."""
        v = [self.numbers.of(tag, a + b) * self.units.length for a in ("FROM", "TO") for b in "XYZ"]
        return Offsets(tag.line, (v[0], v[1], v[2]), (v[3], v[4], v[5]))

    def reducer(self, tag: Tag) -> ReducerData | None:
        """Read REDUCER, which the program itself never writes."""
        n = self.numbers
        od = n.get(tag, "DIAMETERS2") or n.get(tag, "DIAMETER2")
        wall = n.get(tag, "THICKNESS2")
        if od is None or wall is None:
            return None
        alpha = n.of(tag, "ALPHA")
        return ReducerData(tag.line, od * self.units.diameter, wall * self.units.wall, alpha)

    def wind(self, tag: Tag) -> WindData | None:
        """Read WIND or WAVE."""
        shape = self.numbers.get(tag, "WSHAP_WDRC")
        if shape is None:
            return None
        return WindData(tag.line, 1 if tag.name == "WAVE" else 0, shape)

    def uniform(self, tag: Tag, name: str) -> Uniform | None:
        """Read UNIFORMLOAD: the file does not say whether it is in g."""
        if any(self.numbers.of(v, a) for v in (tag, *tag.inside) for a in ("UX", "UY", "UZ")):
            text = "uniform load; the XML does not say whether it is in g or a force per length"
            self.findings.leave_out(tag.line, name, f"{text}; left out")
        return None

    def sif(self, tag: Tag) -> tuple[int, int]:
        """Read SIF: node, and type of the intersection or weld; 0 where it has none."""
        return self.numbers.node(tag, "NODE"), self.numbers.whole(tag, "TYPE")

    def nozzle(self, tag: Tag) -> Nozzle | None:
        """Read a flexible nozzle: its node and that of the vessel."""
        n = self.numbers
        node = n.node(tag, "NOZZLE_NODE") or n.node(tag, "NODE")
        vessel = n.node(tag, "VESSEL_NODE") or n.node(tag, "TANK_NODE")
        return Nozzle(tag.line, node, vessel) if node else None
