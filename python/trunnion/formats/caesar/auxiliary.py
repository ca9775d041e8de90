"""The arrays that elements point into: bends, rigids, restraints, displacements, forces ..."""

from collections.abc import Callable
from math import pi, radians
from typing import TypeVar

from trunnion.formats.caesar.job import (
    BendData,
    JointData,
    Offsets,
    ReducerData,
    Restraint,
    RigidData,
    Sets,
    Uniform,
    Vec,
    WindData,
)
from trunnion.formats.caesar.sections import Records
from trunnion.formats.caesar.text import Columns
from trunnion.formats.caesar.units import INCH, LBF, FileUnits, scaled
from trunnion.formats.findings import Findings

T = TypeVar("T")
FREE = 9999.99  # "not given" of displacements
# from here a support is rigid [N/m], [N m/rad]: the program writes 1e12 lb/in and 1e12 in-lb/deg
RIGID, RIGID_TURNING = 1e11 * LBF / INCH, 1e11 * LBF * INCH * 180.0 / pi
ROTATIONAL = frozenset((5, 6, 7, *range(19, 25), *range(39, 42), *range(48, 54)))


class Auxiliary:
    """Reads single records by the number that an element points with."""

    def __init__(self, columns: Columns, units: FileUnits, arrays: dict[str, Records]) -> None:
        self.columns = columns
        self.units = units
        self.arrays = arrays
        self.findings: Findings = columns.findings
        self._known: dict[tuple[str, int], object] = {}

    def get(self, name: str, pointer: int, read: Callable[[int], T]) -> T | None:
        """Read record `pointer` (from 1) of an array; one record is read once."""
        starts = self.arrays[name].starts
        if not 0 < pointer <= len(starts):
            return None
        key = name, pointer
        if key not in self._known:
            self._known[key] = read(starts[pointer - 1])
        return self._known[key]  # type: ignore[return-value]

    def node(self, line: int, value: float, k: int = 0) -> int:
        """Check a node number that is written as a real."""
        if value != round(value) or not 0 <= value < 1e9:
            text = f"{value:g} is no node number"
            self.findings.fault(line, text, (2 + 13 * k, 15 + 13 * k))
            return 0
        return int(value)

    def bend(self, line: int) -> BendData:
        """Read a bend: radius, flanges, three (angle, node), miters, wall, seam, k ..."""
        last = 2 if self.columns.text(line + 2)[15:].strip() else 1  # the 14th came with version 8
        v = self.columns.many(line, 12 + last)
        pairs = tuple(
            (v[2 + 2 * k], self.node(line + (3 + 2 * k) // 6, v[3 + 2 * k], (3 + 2 * k) % 6))
            for k in range(3)
        )
        if v[0] <= 0.0:
            self.findings.fault(line, f"a bend of radius {v[0]:g} cannot be", (2, 15))
        return BendData(
            line,
            scaled(v[0], self.units.length),
            int(v[1]) if v[1] in (0.0, 1.0, 2.0) else 0,
            tuple((angle, node) for angle, node in pairs if node),
            int(min(max(v[8], 0.0), 1e6)),
            scaled(v[9], self.units.wall),
            v[11],
        )

    def rigid(self, line: int) -> RigidData:
        """Read a rigid: weight, type."""
        weight, kind = self.columns.reals(line, 2)
        return RigidData(
            line, scaled(weight, self.units.force), int(kind) if 0 <= kind < 100 else 0
        )

    def joint(self, line: int) -> JointData:
        """Read an expansion joint."""
        axial, transverse, bending, torsional, diameter = self.columns.reals(line, 5)
        u = self.units
        return JointData(
            line,
            scaled(axial, u.kt),
            scaled(transverse, u.kt),
            scaled(bending, u.kr),
            scaled(torsional, u.kr),
            scaled(diameter, u.diameter),
        )

    def restraints(self, line: int) -> tuple[Restraint, ...]:
        """Read the slots of one record: 4 or 6 of 2 lines, with tag and GUID of 4."""
        each = 4 if self.arrays["RESTRANT"].width == 24 else 2
        found = []
        for first in range(line, line + self.arrays["RESTRANT"].width, each):
            values = self.columns.reals(first, 6)
            if values[0] == 0.0 and values[1] == 0.0:
                continue
            cosines = self.columns.reals(first + 1, 3)
            tag = self.columns.string(first + 2) if each == 4 else ""
            found.append(self._restraint(first, values, cosines, tag))
        return tuple(found)

    def _restraint(
        self, line: int, values: list[float], cosines: list[float], tag: str
    ) -> Restraint:
        node, code, stiffness, gap, mu, cnode = values
        if code != round(code) or not 0.0 <= code < 1000.0:
            self.findings.fault(line, f"{code:g} is no code of a restraint", (15, 28))
            code = 0.0
        turning = int(code) in ROTATIONAL
        k = scaled(stiffness, self.units.kr if turning else self.units.kt)
        if stiffness == 0.0:
            text = (
                "restraints with a stiffness of 0 are rigid: the program itself writes 1e12 lb/in"
            )
            self.findings.assume(text, line)
        if k < 0.0 or gap < 0.0 or mu < 0.0:
            k, mu = abs(k), abs(mu)
            text = f"node {node:g}: a restraint has a negative stiffness, gap or friction"
            self.findings.fault(line, text, (28, 67))
        return Restraint(
            line,
            self.node(line, node),
            int(code),
            None if k == 0.0 or k >= (RIGID_TURNING if turning else RIGID) else k,
            radians(gap) if turning else scaled(gap, self.units.length),
            mu,
            self.node(line, cnode, 5),
            (cosines[0], cosines[1], cosines[2]),
            tag,
        )

    def displacements(self, line: int) -> tuple[Sets, ...]:
        """Read two nodes, each with nine vectors DX DY DZ RX RY RZ."""
        return self._sets(line, self.units.length, radians(1.0), free=True)

    def forces(self, line: int) -> tuple[Sets, ...]:
        """Read two nodes, each with nine vectors FX FY FZ MX MY MZ."""
        return self._sets(line, self.units.force, self.units.moment, free=False)

    def _sets(self, line: int, first: float, second: float, *, free: bool) -> tuple[Sets, ...]:
        found = []
        for at in (line, line + 10):
            node = self.node(at, self.columns.reals(at, 1)[0])
            rows = [self.columns.reals(at + n, 6) for n in range(1, 10)]
            if node == 0:
                continue
            values = tuple(
                tuple(
                    None
                    if free and abs(x) >= FREE - 0.01
                    else scaled(x, first if i < 3 else second)
                    for i, x in enumerate(row)
                )
                for row in rows
            )
            found.append(Sets(at, node, values))
        return tuple(found)

    def uniform(self, line: int) -> Uniform:
        """Read nine times UX UY UZ and the flag of g."""
        v = self.columns.many(line, 36)
        loads = []
        for k in range(0, 36, 4):
            in_g = v[k + 3] == 1.0
            factor = 1.0 if in_g else self.units.load
            vector: Vec = (scaled(v[k], factor), scaled(v[k + 1], factor), scaled(v[k + 2], factor))
            loads.append((vector, in_g))
        return Uniform(line, tuple(loads))

    def wind(self, line: int) -> WindData:
        """Read wind or wave: kind, shape factor."""
        v = self.columns.reals(line, 6)
        return WindData(line, int(v[0]) if v[0] in (0.0, 1.0, 2.0) else 0, v[1])

    def offsets(self, line: int) -> Offsets:
        """Read the offsets of both ends."""
        v = [scaled(x, self.units.length) for x in self.columns.reals(line, 6)]
        return Offsets(line, (v[0], v[1], v[2]), (v[3], v[4], v[5]))

    def reducer(self, line: int) -> ReducerData:
        """Read the TO end of a reducer: OD, wall, alpha."""
        od, wall, alpha, *_ = self.columns.reals(line, 5)
        return ReducerData(
            line, scaled(od, self.units.diameter), scaled(wall, self.units.wall), alpha
        )

    def sifs(self, line: int) -> tuple[tuple[int, int], ...]:
        """Read two slots of a node and the type of its intersection or weld; the rest is checks."""
        each = self.arrays["SIF&TEES"].width // 2
        slots = (self.columns.reals(at, 6)[:2] for at in (line, line + each))
        return tuple((int(n), int(kind)) for n, kind in slots if 0 < n < 1e9 and 0 < kind < 100)

    def code(self, line: int) -> int:
        """Read the number of the piping code, the 12th value of the allowables."""
        value = self.columns.reals(line + 1, 6)[5]
        return int(value) if 0.0 <= value < 1000.0 else 0

    def node_names(self, line: int) -> tuple[str, str]:
        """Read the names of FROM and TO: columns 3-27 and 29-53."""
        text = self.columns.text(line)
        return text[2:27].strip(), text[28:53].strip()
