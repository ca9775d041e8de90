"""ELEMENTS: 53 reals, name and line number from version 8 or later, 15 pointers."""

from collections.abc import Callable
from typing import TypeVar

from trunnion.formats.caesar.auxiliary import Auxiliary
from trunnion.formats.caesar.job import Element
from trunnion.formats.caesar.sections import CHECKS_ONLY, Records
from trunnion.formats.caesar.text import Columns
from trunnion.formats.caesar.units import FileUnits, clean, scaled

T = TypeVar("T")
POINTERS = (
    *("BEND", "RIGID", "EXPJT", "RESTRANT", "DISPLMNT", "FORCMNT", "UNIFORM", "WIND"),
    *("OFFSETS", "ALLOWBLS", "SIF&TEES", "NODENAME", "REDUCERS", "FLANGES", "EQUIPMNT"),
)
BLANK = -1.0101  # of the program's screens and XML; neutral files have 0
STRAIN = 0.05  # a "temperature" smaller than this is the expansion itself
_REALS = 53
# reals (from 1) that the previous element's value stands for where they are blank
_CARRIED = (6, 7, 8, 9, *range(10, 28), 28, 29, 30, 31, 32, 36, 49, 50, 51, 52, 53)


class Elements:
    """Reads the elements one after another; blanks take the value of the element before."""

    def __init__(
        self, columns: Columns, units: FileUnits, auxiliary: Auxiliary, materials: list[int]
    ) -> None:
        self.columns = columns
        self.units = units
        self.auxiliary = auxiliary
        self.materials = materials
        self.before: list[float] = [0.0] * (_REALS + 1)

    def read(self, array: Records) -> tuple[Element, ...]:
        """Read all elements."""
        found = []
        for number, line in enumerate(array.starts):
            material = self.materials[number] if number < len(self.materials) else 0
            found.append(self._element(line, array.width, material))
        return tuple(found)

    def _element(self, line: int, width: int, material: int) -> Element:
        v = self._reals(line)
        pointers = self._pointers(line + width - 3)
        u, aux = self.units, self.auxiliary
        start, end = aux.node(line, v[1], 0), aux.node(line, v[2], 1)
        if not (start and end):
            self.columns.findings.fault(line, "an element needs a FROM and a TO node", (2, 28))
        return Element(
            line=line,
            start=start,
            end=end,
            delta=(scaled(v[3], u.compound), scaled(v[4], u.compound), scaled(v[5], u.compound)),
            od=scaled(v[6], u.diameter),
            wall=scaled(v[7], u.wall),
            material=material,
            insulation=scaled(v[8], u.wall),
            corrosion=scaled(v[9], u.wall),
            t=tuple(None if abs(x) < STRAIN else clean(u.celsius(x)) for x in v[10:19]),
            strain=tuple(x if 0.0 < abs(x) < STRAIN else None for x in v[10:19]),
            p=tuple(scaled(x, u.pressure) or None for x in v[19:28]),
            e=scaled(v[28], u.modulus),
            nu=v[29],
            density=scaled(v[30], u.pipe_density),
            insulation_density=scaled(v[31], u.insulation_density),
            fluid_density=scaled(v[32], u.fluid_density),
            cladding=scaled(v[49], u.wall),
            cladding_density=scaled(v[50], u.insulation_density),
            cover_weight=scaled(v[51], u.load),
            lining=scaled(v[52], u.wall),
            lining_density=scaled(v[53], u.insulation_density),
            name=self.columns.string(line + 9) if width == 15 else "",
            names=self._get("NODENAME", pointers, aux.node_names) or ("", ""),
            bend=self._get("BEND", pointers, aux.bend),
            rigid=self._get("RIGID", pointers, aux.rigid),
            joint=self._get("EXPJT", pointers, aux.joint),
            restraints=self._get("RESTRANT", pointers, aux.restraints) or (),
            displacements=self._get("DISPLMNT", pointers, aux.displacements) or (),
            forces=self._get("FORCMNT", pointers, aux.forces) or (),
            uniform=self._get("UNIFORM", pointers, aux.uniform),
            wind=self._get("WIND", pointers, aux.wind),
            offsets=self._get("OFFSETS", pointers, aux.offsets),
            reducer=self._get("REDUCERS", pointers, aux.reducer),
            checks=tuple(name for name in CHECKS_ONLY if pointers[name]),
            sifs=self._get("SIF&TEES", pointers, aux.sifs) or (),
            code=self._get("ALLOWBLS", pointers, aux.code),
        )

    def _reals(self, line: int) -> list[float]:
        """Read the 53 reals, counted from 1."""
        v = [0.0, *self.columns.many(line, _REALS)]
        for n in range(1, _REALS + 1):
            if abs(v[n] - BLANK) < 1e-4:
                v[n] = self.before[n] if n in _CARRIED else 0.0
        for n in (28, 29, 30):
            if v[n] < 0.0:
                self.columns.findings.fault(line + (n - 1) // 6, f"{v[n]:g} is negative", _field(n))
                v[n] = 0.0
        self.before = v
        return v

    def _pointers(self, line: int) -> dict[str, int]:
        """Read the 15 pointers; each leads to a record that is there."""
        values: list[int] = []
        for k in range(3):
            values += self.columns.integers(line + k, 6 if k < 2 else 3)
        pointers = dict(zip(POINTERS, values, strict=True))
        for k, (name, pointer) in enumerate(pointers.items()):
            n = len(self.auxiliary.arrays[name].starts)
            if not 0 <= pointer <= n and not (n == 0 and name in CHECKS_ONLY):
                text = f"this points to record {pointer} of {name}, which has {n}"
                self.columns.findings.fault(line + k // 6, text, _field(k + 1))
                pointers[name] = 0
        return pointers

    def _get(self, name: str, pointers: dict[str, int], read: Callable[[int], T]) -> T | None:
        return self.auxiliary.get(name, pointers[name], read)


def _field(n: int) -> tuple[int, int]:
    """Columns of real or integer `n`, counted from 1."""
    k = (n - 1) % 6
    return 2 + 13 * k, 15 + 13 * k
