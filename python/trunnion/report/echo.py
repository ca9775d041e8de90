"""The input as it was understood: settings, materials, sections, elements, loads, cases."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby

import numpy as np

from trunnion.arrays import ARC, System
from trunnion.cases.default_cases import may_be_free, with_cases
from trunnion.model import Case, Comb, Model
from trunnion.report.columns import Column, integers, numbers, plain, section, table, words, wrapped
from trunnion.report.components import component_echo
from trunnion.report.dynamics import cycle_text, dynamic_echo, spectrum_options
from trunnion.report.props import support_echo
from trunnion.report.units import ReportUnits
from trunnion.report.winds import wind_echo


def input_echo(model: Model, system: System, texts: Mapping[str, str], units: ReportUnits) -> str:
    """Print everything the answer depends on; `texts` are the sums of the cases by name."""
    return "".join(
        (
            _settings(model, units),
            _materials(model, units),
            _sections(model, units),
            _nodes(system, units),
            _elements(system, units),
            _bends(system, units),
            component_echo(model, system, units),
            support_echo(model, system, units),
            _operations(model, units),
            _loads(model, units),
            wind_echo(model, system, units),
            dynamic_echo(model, units),
            _cases(model, texts),
        )
    )


def _settings(model: Model, units: ReportUnits) -> str:
    s, u = model.settings, model.units
    rows = (
        ("units of the deck", f"{u.length}  {u.force}  {u.pressure}  {u.temperature}"),
        (
            "units of this report",
            f"{units.movement.unit}  deg  {units.force.unit}  {units.moment.unit}"
            f"  {units.stress.unit}  {units.temperature}",
        ),
        ("vertical axis", f"{s.up} up, g = {s.g:g} m/s2"),
        ("friction", f"mu = {s.mu:g} where none is stated, law {s.friction}"),
        ("rigid supports", f"k = {s.k:g} N/m, rotations {s.kr:g} N.m/rad"),
        ("stick stiffness", f"k = {s.kf:g} N/m"),
        ("shear deflection", "on" if s.shear else "off"),
        ("pressure", f"stiffening of bends {s.stiffen}, elongation and opening {s.bourdon}"),
        ("iteration", f"{s.iteration}, events {'on' if s.events else 'off'}"),
    )
    return section("SETTINGS") + "".join(f"  {name:<22}{value}\n" for name, value in rows)


def _materials(model: Model, units: ReportUnits) -> str:
    found = list(model.materials.values())
    expansion = 1e-6 * _per_degree(units)
    columns = [
        words("NAME", [m.name for m in found]),
        words("GRADE", [m.grade for m in found]),
        numbers("E", [m.e for m in found], units.modulus),
        plain("NU", [m.nu for m in found], 3, 8),
        plain(
            "ALPHA",
            [m.alpha / expansion for m in found],
            3,
            11,
            f"[1e-6/{_degree(units)}]",
        ),
        numbers("DENSITY", [m.density for m in found], units.density),
    ]
    text = section("MATERIALS") + table(columns)
    points = [(m, p) for m in found for p in m.table]
    if not points:
        return text
    e = [np.nan if p.e is None else p.e for _, p in points]
    alpha = [np.nan if p.alpha is None else p.alpha / expansion for _, p in points]
    columns = [
        words("NAME", [m.name for m, _ in points]),
        plain("T", [units.degrees(p.t) for _, p in points], 1, 9, f"[{units.temperature}]"),
        numbers("E", e, units.modulus),
        plain("MEAN ALPHA", alpha, 3, 12, f"[1e-6/{_degree(units)}]"),
        plain(
            "FROM",
            [units.degrees(m.table_tref) for m, _ in points],
            1,
            9,
            f"[{units.temperature}]",
        ),
    ]
    return text + section("MATERIAL TABLES") + table(columns)


def _degree(units: ReportUnits) -> str:
    return "F" if units.temperature == "F" else "K"


def _per_degree(units: ReportUnits) -> float:
    """Coefficient of expansion of one per degree of the report, in 1/K."""
    return 1.8 if units.temperature == "F" else 1.0


def _sections(model: Model, units: ReportUnits) -> str:
    found = list(model.sections.values())
    sizes = [_size(s.nps, s.dn, s.schedule) for s in found]
    columns = [
        words("NAME", [s.name for s in found]),
        words("SIZE", sizes),
        numbers("OD", [s.od for s in found], units.wall, 10),
        numbers("WALL", [s.wall for s in found], units.wall, 9),
        numbers("FLUID", [s.fluid for s in found], units.density),
        numbers("LINING", [s.lining for s in found], units.wall, 9),
        numbers("DENSITY", [s.lining_density for s in found], units.density),
        numbers("INSULATION", [s.insulation for s in found], units.wall, 12),
        numbers("DENSITY", [s.insulation_density for s in found], units.density),
        numbers("EXTRA", [s.weight for s in found], units.line_load, 10),
        numbers("CORROSION", [s.corrosion for s in found], units.wall, 11),
    ]
    return section("SECTIONS") + table(columns)


def _size(nps: str | None, dn: str | None, schedule: str | None) -> str:
    name = f"NPS {nps}" if nps else f"DN {dn}" if dn else ""
    return f"{name} SCH {schedule}" if name and schedule else name


def _nodes(system: System, units: ReportUnits) -> str:
    columns = [words("NODE", system.labels)]
    columns += [numbers(axis, system.xyz[:, i], units.length, 14) for i, axis in enumerate("XYZ")]
    return section("NODES") + table(columns)


def _elements(system: System, units: ReportUnits) -> str:
    parts = system.parts
    delta = system.xyz[system.ends[:, 1]] - system.xyz[system.ends[:, 0]]
    columns = [
        words("FROM", [p.start for p in parts]),
        words("TO", [p.end for p in parts]),
        words("TYPE", [p.type for p in parts]),
        words("SECTION", [p.section for p in parts], most=12),
        words("MATERIAL", [p.material for p in parts], least=8, most=12),
        *(numbers(f"D{axis}", delta[:, i], units.length, 12) for i, axis in enumerate("XYZ")),
        numbers("LENGTH", system.length, units.length, 12),
        numbers("OD", system.od, units.wall, 10),
        numbers("WALL", system.wall, units.wall, 9),
        integers("LINE", [p.line for p in parts]),
    ]
    return section("ELEMENTS") + table(columns)


def _bends(system: System, units: ReportUnits) -> str:
    """Flexibility characteristic h = t R / r2 with the mean radius r of the pipe."""
    at = np.flatnonzero(system.kind == ARC)
    if not at.size:
        return ""
    radius, wall = system.radius[at], system.wall[at]
    mean = 0.5 * (system.od[at] - wall)
    parts = [system.parts[i] for i in at.tolist()]
    columns = [
        words("FROM", [p.start for p in parts]),
        words("TO", [p.end for p in parts]),
        numbers("RADIUS", radius, units.wall),
        numbers("ANGLE", system.angle[at], units.rotation),
        plain("h", wall * radius / mean**2, 5),
        plain("k", system.flex[at], 4),
        integers("LINE", [p.line for p in parts]),
    ]
    return section("BENDS", "h = t R / r2, k multiplies the bending flexibility") + table(columns)


def _operations(model: Model, units: ReportUnits) -> str:
    """One row for each stretch of elements with the same temperatures and pressures."""
    stretches = [list(group) for _, group in groupby(model.pipes, lambda p: p.operation)]
    stretches = [group for group in stretches if group[0].operation.t or group[0].operation.p]
    if not stretches:
        return ""
    first = [group[0].operation for group in stretches]
    columns = [
        words("FROM", [group[0].start for group in stretches]),
        words("TO", [group[-1].end for group in stretches]),
        integers("PIPES", [len(group) for group in stretches]),
    ]
    tref = [units.degrees(o.tref) for o in first]
    sets: list[Column] = [plain("TREF", tref, 1, 10, f"[{units.temperature}]")]
    for n in _numbers(o.t for o in first):
        t = [units.degrees(o.t[n]) if n in o.t else np.nan for o in first]
        sets.append(plain(f"T{n}", t, 1, 10, f"[{units.temperature}]"))
    for n in _numbers(o.p for o in first):
        sets.append(numbers(f"P{n}", [o.p.get(n, np.nan) for o in first], units.pressure, 10))
    text = section("TEMPERATURES AND PRESSURES")
    for i in range(0, len(sets), 9):
        text += table([*columns, *sets[i : i + 9]])
    return text


def _numbers(sets: Iterable[Mapping[str, float]]) -> list[str]:
    return sorted({n for one in sets for n in one})


def _loads(model: Model, units: ReportUnits) -> str:
    text = ""
    if model.masses:
        columns = [
            words("NODE", [m.node for m in model.masses]),
            numbers("MASS", [m.mass for m in model.masses], units.mass),
        ]
        text += section("MASSES") + table(columns)
    bodies = [p for p in model.pipes if p.rigid]
    if bodies:
        columns = [
            words("FROM", [p.start for p in bodies]),
            words("TO", [p.end for p in bodies]),
            words("TYPE", [p.card.lower() for p in bodies]),
            numbers("WEIGHT", [p.weight for p in bodies], units.force),
        ]
        text += section("RIGID BODIES") + table(columns)
    if model.forces:
        names = [f"F{f.set}" for f in model.forces]
        values = [f.f for f in model.forces]
        columns = [words("NODE", [f.node for f in model.forces]), words("SET", names)]
        text += section("NODAL FORCES") + table(columns + _six("FM", values, units))
    if model.displacements:
        names = [f"D{d.set}" for d in model.displacements]
        moved = [tuple(np.nan if x is None else x for x in d.d) for d in model.displacements]
        columns = [words("NODE", [d.node for d in model.displacements]), words("SET", names)]
        text += section("IMPOSED DISPLACEMENTS", "- is free")
        text += table(columns + _six("DR", moved, units))
    if model.accelerations:
        a = np.array([a.a for a in model.accelerations])
        columns = [words("SET", [f"U{a.set}" for a in model.accelerations])]
        columns += [plain(axis, a[:, i], 4, 11, "[g]") for i, axis in enumerate("XYZ")]
        text += section("UNIFORM ACCELERATIONS") + table(columns)
    return text


def _six(kind: str, values: Sequence[Sequence[float]], units: ReportUnits) -> list[Column]:
    """Six components: forces and moments (kind "FM") or movements and rotations ("DR")."""
    both = {"F": units.force, "M": units.moment, "D": units.movement, "R": units.rotation}
    return [
        numbers(kind[i // 3] + "XYZ"[i % 3], [v[i] for v in values], both[kind[i // 3]])
        for i in range(6)
    ]


def _cases(model: Model, texts: Mapping[str, str]) -> str:
    """Write every case as its card does; those of a deck that names none are marked."""
    text = section("LOAD CASES", "" if model.cases else "default: the deck names none")
    if not texts and may_be_free(model):
        return text + "  none\n"
    cases = with_cases(model).cases
    width = max(len(case.name) for case in cases) + 2
    for case in cases:
        words = "  ".join([texts.get(case.name, ""), *_options(case, model.settings.g)])
        text += wrapped(f"{case.name:<{width}}{words}")
    if model.cycles:
        text += section("CYCLES")
        text += "".join(wrapped(f"{c.name} = {cycle_text(c)}") for c in model.cycles)
    return text


def _options(case: Case | Comb, g: float) -> list[str]:
    """Keys of a CASE card that say more than nothing."""
    if isinstance(case, Comb):
        return []
    options = (
        f"FROM={case.start}" if case.start else "",
        f"STEPS={case.steps}" if case.steps != 1 else "",
        f"MUX={case.mux:g}" if case.mux != 1.0 else "",
        "E=HOT" if case.hot else "",
        f"ITERATION={case.iteration}" if case.iteration else "",
        "" if case.events is None else f"EVENTS={'ON' if case.events else 'OFF'}",
        f"SNUBBERS={case.snubbers}" if case.snubbers else "",
    )
    more = spectrum_options(case.spectrum, g) if case.spectrum else ()
    return [*filter(None, options), *more]
