"""Cards of materials, sections, operation and defaults to the model."""

from dataclasses import replace
from typing import Any

from trunnion.deck.context import Context
from trunnion.deck.keywords import PRESSURE_SETS, TEMPERATURE_SETS
from trunnion.deck.record import Record
from trunnion.deck.units import in_unit
from trunnion.deck.values import nearest
from trunnion.library.names import UnknownName
from trunnion.model import Material, Operation, Section, TablePoint


def title(run: Context, record: Record) -> None:
    """TITLE: the rest of the card."""
    run.model.title = record.keys["TEXT"]


def default(run: Context, record: Record) -> None:
    """DEFAULT: settings of the whole model, each given once."""
    settings: dict[str, Any] = {}
    for key, value in record.keys.items():
        if run.carried.defaults.setdefault(key, value) != value:
            run.complain(record, f"{key} has another value on an earlier DEFAULT card", f"{key}=")
            return
        settings[key.lower()] = value == "ON" if key in ("SHEAR", "EVENTS") else value
    run.model.settings = replace(run.model.settings, **settings)


def material(run: Context, record: Record) -> None:
    """MATERIAL: define it, or with no key choose an earlier one, and make it current."""
    name, keys = record.args[0], record.keys
    known = run.model.materials
    run.carried.material = name
    if name in known:
        if keys:
            run.complain(record, f"material {name} is already defined at {known[name].place}", name)
    elif "GRADE" in keys:
        try:
            known[name] = replace(graded(name, keys), place=record.place)
        except UnknownName as error:
            run.complain(record, str(error), "GRADE=")
    elif "E" in keys:
        known[name] = Material(
            name,
            keys["E"],
            keys.get("NU", 0.3),
            keys.get("ALPHA", 0.0),
            keys.get("DENSITY", 0.0),
            table_tref=keys.get("TREF", 20.0),
            place=record.place,
        )
    else:
        also = f"; no material {name} is defined before{nearest(name, known)}" if not keys else ""
        missing = run.miss if not keys else run.complain
        missing(record, f"E= is missing (or GRADE=, a row of the library){also}")


def graded(name: str, keys: dict[str, Any]) -> Material:
    """Take a material from the library; keys of the card come before the library's values."""
    from trunnion.library.materials import library_material

    found = library_material(keys["GRADE"])
    return replace(
        found,
        name=name,
        e=keys.get("E", found.e),
        nu=keys.get("NU", found.nu),
        alpha=keys.get("ALPHA", found.alpha),
        density=keys.get("DENSITY", found.density),
        table=_without(found.table, "E" in keys, "ALPHA" in keys),
        table_tref=keys.get("TREF", found.table_tref),
    )


def _without(table: tuple[TablePoint, ...], e: bool, alpha: bool) -> tuple[TablePoint, ...]:
    """Blank properties of a table; points that have none left are dropped."""
    points = (TablePoint(p.t, None if e else p.e, None if alpha else p.alpha) for p in table)
    return tuple(p for p in points if p.e is not None or p.alpha is not None)


def property_point(run: Context, record: Record) -> None:
    """PROPERTY: one point of the table of a material; points of the library may be replaced."""
    name, keys = record.args[0], record.keys
    known = run.model.materials.get(name)
    if known is None:
        if name not in run.carried.broken:
            hint = nearest(name, run.model.materials)
            run.miss(record, f"material {name} is not defined before{hint}", name)
        return
    if "E" not in keys and "ALPHA" not in keys:
        run.complain(record, "E= or ALPHA= is missing")
        return
    points = {point.t: point for point in known.table}
    old = points.get(keys["T"], TablePoint(keys["T"]))
    if known.grade is None:
        for key, value in (("E", old.e), ("ALPHA", old.alpha)):
            if key in keys and value is not None:
                run.complain(record, f"{key} at this temperature is given twice", f"{key}=")
                return
    points[old.t] = TablePoint(old.t, keys.get("E", old.e), keys.get("ALPHA", old.alpha))
    table = tuple(points[t] for t in sorted(points))
    run.model.materials[name] = replace(known, table=table)


def section(run: Context, record: Record) -> None:
    """SECTION: define it, or with no key choose an earlier one, and make it current."""
    name, keys = record.args[0], record.keys
    known = run.model.sections
    run.carried.section = name
    if name in known:
        if keys:
            run.complain(record, f"section {name} is already defined at {known[name].place}", name)
        return
    size = _size(run, record)
    if size is None or not _fits(run, record, *size):
        return
    known[name] = Section(
        name,
        *size,
        fluid=keys.get("FLUID", 0.0),
        lining=keys.get("LINING", 0.0),
        lining_density=keys.get("LINING_DENSITY", 0.0),
        insulation=keys.get("INSULATION", 0.0),
        insulation_density=keys.get("INSULATION_DENSITY", 0.0),
        weight=keys.get("WEIGHT", 0.0),
        corrosion=keys.get("CORROSION", 0.0),
        nps=keys.get("NPS"),
        dn=keys.get("DN"),
        schedule=keys["SCH"].upper() if "SCH" in keys else None,
        place=record.place,
    )


def _fits(run: Context, record: Record, od: float, wall: float) -> bool:
    """Check that wall and lining fit into the pipe, and that layers have a thickness."""
    keys = record.keys
    if wall > 0.5 * od * (1.0 + 1e-5):  # a printed half diameter is a solid bar
        outside = in_unit(run.model.units.length, od)
        run.complain(record, f"WALL is more than half the outside diameter, {outside}", "WALL=")
        return False
    if keys.get("LINING", 0.0) > 0.5 * od - wall:
        run.complain(record, "LINING is more than half the bore", "LINING=")
        return False
    for key in ("LINING", "INSULATION"):
        if keys.get(f"{key}_DENSITY") and not keys.get(key):
            run.complain(record, f"{key}_DENSITY without {key}= (its thickness)", f"{key}_DENSITY=")
            return False
    return True


def _size(run: Context, record: Record) -> tuple[float, float] | None:
    """Outside diameter and wall from OD and WALL, or from NPS or DN and SCH."""
    keys = record.keys
    named = [key for key in ("NPS", "DN", "SCH") if key in keys]
    plain = [key for key in ("OD", "WALL") if key in keys]
    if named and plain:
        message = f"{plain[0]} and {named[0]}: give OD and WALL, or NPS and SCH"
        run.complain(record, message, f"{plain[0]}=")
    elif len(plain) == 2:
        return keys["OD"], keys["WALL"]
    elif plain:
        run.complain(record, f"{'WALL=' if 'OD' in keys else 'OD='} is missing")
    elif "NPS" in keys and "DN" in keys:
        run.complain(record, "NPS and DN: one of them gives the size", "DN=")
    elif len(named) == 2:
        return _standard_size(run, record)
    elif named:
        run.complain(record, f"{'NPS= or DN=' if 'SCH' in keys else 'SCH='} is missing")
    else:
        known, name = run.model.sections, record.args[0]
        also = f"; no section {name} is defined before{nearest(name, known)}" if not keys else ""
        missing = run.miss if not keys else run.complain
        missing(record, f"OD= and WALL= are missing (or NPS= and SCH=){also}")
    return None


def _standard_size(run: Context, record: Record) -> tuple[float, float] | None:
    """Outside diameter and wall from the tables of pipe sizes."""
    from trunnion.library.sections import nominal_inches, pipe_size

    nps, dn = record.keys.get("NPS"), record.keys.get("DN")
    size = "NPS=" if nps else "DN="
    try:
        nominal_inches(nps, dn)
    except UnknownName as error:
        run.complain(record, str(error), size)
        return None
    try:
        return pipe_size(nps, dn, record.keys["SCH"])
    except UnknownName as error:
        run.complain(record, str(error), size if "pipe size" in error.what else "SCH=")
        return None


def operate(run: Context, record: Record) -> None:
    """OPERATE: temperatures and pressures from here on."""
    if not record.keys:
        run.complain(record, "nothing is given; write T1= ... P1= ... or TREF=")
        return
    run.carried.operation = changed(run.carried.operation, record.keys)


def changed(old: Operation, keys: dict[str, Any]) -> Operation:
    """Change an operation by the keys T1 P1 TREF among others."""
    t, p = dict(old.t), dict(old.p)
    for key, value in keys.items():
        if key in TEMPERATURE_SETS:
            t[key[1]] = value
        elif key in PRESSURE_SETS:
            p[key[1]] = value
    return Operation(t, p, keys.get("TREF", old.tref))
