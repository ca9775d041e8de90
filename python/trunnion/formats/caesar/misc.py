"""MISCEL_1 (materials, nozzles, hangers, options) and COORDS."""

from trunnion.formats.caesar.auxiliary import FREE
from trunnion.formats.caesar.job import HangerData, Nozzle, Vec
from trunnion.formats.caesar.sections import Section, Skeleton
from trunnion.formats.caesar.text import Columns
from trunnion.formats.caesar.units import FileUnits, clean, scaled
from trunnion.frozen import frozen

USUAL_AMBIENT = 21.11  # C, 70 F: of the program


@frozen
class Options:
    """Execution options: ambient temperature [C], Bourdon effects (`job.BOURDON`); None: not said.

    Their order is that of the user's guide: print forces, print alphas, Bourdon effects, branch
    errors, thermal bowing, liberal allowables; uniform loads in g, stress stiffening, ambient ...
    The input echo that version 11 printed for a public job has the same values in these places.
    """

    ambient: float | None = None
    bourdon: int | None = None


@frozen
class Misc:
    """What MISCEL_1 says."""

    materials: list[int]
    nozzles: tuple[Nozzle, ...] = ()
    hangers: tuple[HangerData, ...] = ()
    options: Options = Options()


def read_misc(columns: Columns, frame: Skeleton, units: FileUnits) -> Misc:
    """Read the section from its first line on; its parts have no headers of their own."""
    section = frame.sections["MISCEL_1"]
    n_elem, n_hanger = frame.counts["ELEMENTS"], frame.counts["hangers"]
    at = section.header + 1
    n_line = -(-n_elem // 6)
    if section.n_line < n_line:
        text = f"MISCEL_1 has {section.n_line} lines; {n_line} of material numbers are needed"
        columns.findings.fault(section.header, text)
        return Misc([0] * n_elem)
    materials = [_whole(x) for x in columns.many(at, n_elem)]
    at += n_line
    nozzles: list[Nozzle] = []
    for _ in range(frame.counts["nozzles"]):
        if at + 3 > section.last:
            columns.findings.fault(section.header, "MISCEL_1 ends within the nozzles")
            return Misc(materials, tuple(nozzles))
        node, vessel = (_whole(x) for x in columns.reals(at, 6)[:2])
        nozzles.append(Nozzle(at, node, vessel))
        at += 4
    hangers: tuple[HangerData, ...] = ()
    if n_hanger:
        lists, here = 2 + -(-n_hanger // 6) * 5, section.last - at + 1
        strings = _has_tags(here - lists, n_hanger, late=_is_late(frame))
        needed = lists + n_hanger * (5 if strings else 3)
        if here < needed:
            text = f"MISCEL_1 ends within the data of {n_hanger} hangers"
            columns.findings.fault(section.header, text)
            return Misc(materials, tuple(nozzles))
        hangers = _hangers(columns, at, n_hanger, units, strings=strings)
        at += needed
    return Misc(materials, tuple(nozzles), hangers, _options(columns, section, at, units))


def _is_late(frame: Skeleton) -> bool:
    """Tell whether elements have names, as from version 8 on."""
    return frame.sections["ELEMENTS"].n_line >= 15 * frame.counts["ELEMENTS"]


def _has_tags(n_line: int, n_hanger: int, *, late: bool) -> bool:
    """Tell whether hangers have a tag and a GUID, two lines: what is left are 3 or 4 of options."""
    fits = [n_line - n_hanger * each in (3, 4) for each in (3, 5)]
    return late if fits[0] == fits[1] else fits[1]


def _whole(value: float) -> int:
    return round(min(max(value, -1e9), 1e9))


def _hangers(
    columns: Columns, at: int, n: int, units: FileUnits, *, strings: bool
) -> tuple[HangerData, ...]:
    """Read the defaults, the nodes, the values of each hanger, and four lists of integers."""
    rows = -(-n // 6)
    usual = columns.reals(at, 6)  # table, variation, travel of a rigid rod, largest travel ...
    cold = columns.integers(at + 1, 5)[1] == 1
    nodes = _list(columns, at + 2, n)
    first = at + 2 + rows
    each = 4 if strings else 2
    # the anchors of a hanger (integers only) stand below it, or all together below all hangers
    step = each + 1 if "." not in columns.text(first + each) else each
    after = first + n * (each + 1)
    number, table, _, cnode = (_list(columns, after + k * rows, n) for k in range(4))
    found = []
    for i in range(n):
        line = first + i * step
        v = columns.many(line, 11)  # the last one came with the tags
        found.append(
            HangerData(
                line,
                nodes[i],
                rate=scaled(v[0], units.kt),
                cold_load=scaled(v[4], units.force),
                hot_load=scaled(v[5] or v[6], units.force),  # the second is the user's
                constant=scaled(v[10], units.force),
                variation=v[1] or usual[1] or 25.0,
                rod=max(0.0, scaled(v[2] or usual[2], units.length)),
                space=scaled(v[3], units.length) if abs(v[3]) < FREE - 0.01 else 0.0,
                most=next((scaled(x, units.length) for x in (v[7], usual[3]) if _limit(x)), None),
                cold_design=cold,
                number=number[i],
                cnode=cnode[i],
                table=table[i] or int(min(max(usual[0], 0.0), 1e6)),
                tag=columns.string(line + 2) if strings else "",
                free=_freed(columns, line + each if step > each else first + n * each + i),
            )
        )
    return tuple(found)


def _limit(travel: float) -> bool:
    """Tell whether a largest travel is one: 9999.99 stands for none."""
    return 0.0 < travel < FREE - 0.01


def _freed(columns: Columns, line: int) -> tuple[tuple[int, int], ...]:
    """Nodes of anchors that the design of a hanger frees, with the codes of their freedoms."""
    one, other, *codes = columns.integers(line, 4)
    pairs = zip((one, other), codes, strict=True)
    return tuple((node, max(1, code)) for node, code in pairs if node > 0)


def _list(columns: Columns, line: int, n: int) -> list[int]:
    """Read `n` integers, six a line."""
    found: list[int] = []
    for k in range(0, n, 6):
        found += columns.integers(line + k // 6, min(6, n - k))
    return found


def _options(columns: Columns, section: Section, at: int, units: FileUnits) -> Options:
    """Read the first two lines of execution options; files made by hand may end before them."""
    if at + 1 > section.last:
        return Options()
    *_, bourdon, _, bowing, _ = columns.reals(at, 6)
    _, stiffened, ambient, *_ = columns.reals(at + 1, 6)
    if bourdon not in (0.0, 1.0, 2.0):
        text = f"{bourdon:g} is no choice of Bourdon effects: 0 none, 1 translation, 2 rotation too"
        columns.findings.fault(at, text, (28, 41))
        bourdon = 0.0
    for value, name in ((bowing, "thermal bowing"), (stiffened, "stress stiffening by pressure")):
        if value:
            line = at if name == "thermal bowing" else at + 1
            columns.findings.leave_out(line, "job", f"{name} is on; taken as off")
    celsius = clean(units.celsius(ambient)) if ambient else None
    return Options(celsius, int(bourdon))


def read_coordinates(
    columns: Columns, section: Section | None, units: FileUnits
) -> tuple[tuple[int, int, Vec], ...]:
    """Read the places of the first nodes of disconnected parts."""
    if section is None or not section.n_line or not columns.text(section.header + 1).strip():
        return ()
    count = columns.integers(section.header + 1, 1)[0]
    if not 0 <= count <= section.n_line - 1:
        text = f"COORDS counts {count} nodes and has {section.n_line - 1} lines of them"
        columns.findings.fault(section.header + 1, text)
        return ()
    found = []
    for line in range(section.header + 2, section.header + 2 + count):
        node, x, y, z = columns.reals(line, 4)
        f = units.length
        found.append((line, _whole(node), (scaled(x, f), scaled(y, f), scaled(z, f))))
    return tuple(found)
