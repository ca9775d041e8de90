"""Records to Model: what each keyword does, and what carries over from card to card."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import hypot
from typing import Any

from trunnion.deck import expressions as ex
from trunnion.deck.record import Fault, Mark, Record
from trunnion.deck.values import nearest
from trunnion.model import (
    Acceleration,
    Bend,
    Case,
    Comb,
    Direction,
    Displacement,
    Force,
    Mass,
    Material,
    Model,
    Node,
    Operation,
    Pipe,
    Section,
    Spring,
    Support,
    TablePoint,
    Term,
)
from trunnion.names import UnknownName

SETS = frozenset("123456789")


@dataclass(slots=True)
class Carried:
    """What cards leave behind for the cards that follow."""

    section: str | None = None
    material: str | None = None
    operation: Operation = field(default_factory=Operation)
    defaults: dict[str, Any] = field(default_factory=dict)
    displacements: dict[tuple[str, str], int] = field(default_factory=dict)
    broken: set[str] = field(default_factory=set)  # words of faulty cards: no further errors


class Interpreter:
    """Applies records to one model; faults are collected, never raised."""

    def __init__(self, model: Model, carried: Carried, faults: list[Fault]) -> None:
        self.model = model
        self.carried = carried
        self.faults = faults
        self.before = 0

    def apply(self, record: Record) -> None:
        """Do what one record says, unless it has a fault."""
        self.before = len(self.faults)
        _ACTIONS[record.keyword](self, record)

    def keep(self, items: list[Any], item: Any) -> None:
        """Add an item to a list of the model when its record has no fault."""
        if len(self.faults) == self.before:
            items.append(item)

    def complain(self, record: Record, message: str, mark: Mark = None) -> None:
        """Note a fault of a record."""
        self.faults.append(Fault(record.place, record.head, message, mark))


def _give_up(record: Record, carried: Carried) -> None:
    """Take note of a faulty record so that its names cause no further errors."""
    carried.broken.update(record.args)
    carried.broken.update(record.keys)
    carried.broken.update(v for v in record.keys.values() if isinstance(v, str))
    if record.keyword == "MATERIAL" and record.args:
        carried.material = record.args[0]
    if record.keyword == "SECTION" and record.args:
        carried.section = record.args[0]


give_up = _give_up


def _default(run: Interpreter, record: Record) -> None:
    settings: dict[str, Any] = {}
    for key, value in record.keys.items():
        if run.carried.defaults.setdefault(key, value) != value:
            run.complain(record, f"{key} has another value on an earlier DEFAULT card", f"{key}=")
        settings[key.lower()] = value == "ON" if key in ("SHEAR", "EVENTS") else value
    run.model.settings = replace(run.model.settings, **settings)


def _material(run: Interpreter, record: Record) -> None:
    name, keys = record.args[0], record.keys
    run.carried.material = name
    known = run.model.materials.get(name)
    if known is not None:
        if keys:
            run.complain(record, f"material {name} is already defined at {known.place}", name)
        elif name in run.carried.broken:
            return
        return
    grade = keys.get("GRADE")
    if grade is not None:
        try:
            made = graded(name, keys)
        except UnknownName as error:
            run.complain(record, str(error), "GRADE=")
            return
        run.model.materials[name] = replace(made, place=record.place)
        return
    if "E" not in keys:
        hint = nearest(name, run.model.materials)
        also = f"; no material {name} is defined before{hint}" if not keys else ""
        run.complain(record, f"E= is missing (or GRADE=, a row of the library){also}")
        return
    run.model.materials[name] = Material(
        name,
        keys["E"],
        keys.get("NU", 0.3),
        keys.get("ALPHA", 0.0),
        keys.get("DENSITY", 0.0),
        table_tref=keys.get("TREF", 20.0),
        place=record.place,
    )


def graded(name: str, keys: dict[str, Any]) -> Material:
    """Take a material from the library; keys of the card come before the library's values."""
    from trunnion.materials import library_material

    found = replace(library_material(keys["GRADE"]), name=name)
    if "E" in keys:
        found = replace(found, e=keys["E"], table=_without(found.table, e=None))
    if "ALPHA" in keys:
        found = replace(found, alpha=keys["ALPHA"], table=_without(found.table, alpha=None))
    return replace(
        found,
        nu=keys.get("NU", found.nu),
        density=keys.get("DENSITY", found.density),
        table_tref=keys.get("TREF", found.table_tref),
    )


def _without(table: tuple[TablePoint, ...], **blank: None) -> tuple[TablePoint, ...]:
    """Blank one property of a table; points that have none left are dropped."""
    points = (replace(point, **blank) for point in table)
    return tuple(p for p in points if p.e is not None or p.alpha is not None)


def _property(run: Interpreter, record: Record) -> None:
    name, keys = record.args[0], record.keys
    known = run.model.materials.get(name)
    if known is None:
        if name not in run.carried.broken:
            hint = nearest(name, run.model.materials)
            run.complain(record, f"material {name} is not defined before{hint}", name)
        return
    if "E" not in keys and "ALPHA" not in keys:
        run.complain(record, "E= or ALPHA= is missing")
        return
    old = {point.t: point for point in known.table}
    point = old.get(keys["T"], TablePoint(keys["T"]))
    if known.grade is None:
        for key, value in (("E", point.e), ("ALPHA", point.alpha)):
            if key in keys and value is not None:
                run.complain(record, f"{key} at this temperature is given twice", f"{key}=")
                return
    old[keys["T"]] = TablePoint(point.t, keys.get("E", point.e), keys.get("ALPHA", point.alpha))
    table = tuple(old[t] for t in sorted(old))
    run.model.materials[name] = replace(known, table=table)


def _section(run: Interpreter, record: Record) -> None:
    name, keys = record.args[0], record.keys
    run.carried.section = name
    known = run.model.sections.get(name)
    if known is not None:
        if keys:
            run.complain(record, f"section {name} is already defined at {known.place}", name)
        return
    size = _size(run, record)
    if size is None:
        return
    od, wall = size
    if wall > 0.5 * od * (1.0 + 1e-5):
        run.complain(record, f"WALL is more than half the outside diameter {od:g} m", "WALL=")
        return
    lining, insulation = keys.get("LINING", 0.0), keys.get("INSULATION", 0.0)
    if 2.0 * lining > od - 2.0 * wall:
        run.complain(record, "LINING is more than half the bore", "LINING=")
        return
    for key, thickness in (("LINING", lining), ("INSULATION", insulation)):
        if keys.get(f"{key}_DENSITY") and not thickness:
            run.complain(record, f"{key}_DENSITY without {key}= (its thickness)", f"{key}_DENSITY=")
    run.model.sections[name] = Section(
        name,
        od,
        wall,
        keys.get("FLUID", 0.0),
        lining,
        keys.get("LINING_DENSITY", 0.0),
        insulation,
        keys.get("INSULATION_DENSITY", 0.0),
        keys.get("WEIGHT", 0.0),
        keys.get("CORROSION", 0.0),
        keys.get("NPS"),
        keys.get("DN"),
        keys["SCH"].upper() if "SCH" in keys else None,
        record.place,
    )


def _size(run: Interpreter, record: Record) -> tuple[float, float] | None:
    """Outside diameter and wall from OD and WALL, or from NPS or DN and SCH."""
    keys = record.keys
    named = [key for key in ("NPS", "DN", "SCH") if key in keys]
    plain = [key for key in ("OD", "WALL") if key in keys]
    if named and plain:
        run.complain(
            record, f"{plain[0]} and {named[0]}: give OD and WALL, or NPS and SCH", f"{plain[0]}="
        )
        return None
    if len(plain) == 2:
        return keys["OD"], keys["WALL"]
    if "NPS" in keys and "DN" in keys:
        run.complain(record, "NPS and DN: one of them gives the size", "DN=")
        return None
    if not named and not plain:
        also = ""
        if not keys:
            also = f"; no section {record.args[0]} is defined before"
            also += nearest(record.args[0], run.model.sections)
        run.complain(record, f"OD= and WALL= are missing (or NPS= and SCH=){also}")
        return None
    if plain:
        missing = "WALL=" if "OD" in keys else "OD="
        run.complain(record, f"{missing} is missing")
        return None
    if "SCH" not in keys or len(named) < 2:
        missing = "SCH=" if "SCH" not in keys else "NPS= or DN="
        run.complain(record, f"{missing} is missing")
        return None
    from trunnion.sections import nominal_inches, pipe_size

    key = "NPS" if "NPS" in keys else "DN"
    try:
        nominal_inches(keys.get("NPS"), keys.get("DN"))
    except UnknownName as error:
        run.complain(record, str(error), f"{key}=")
        return None
    try:
        return pipe_size(keys.get("NPS"), keys.get("DN"), keys["SCH"])
    except UnknownName as error:
        run.complain(record, str(error), f"{key}=" if "pipe size" in error.what else "SCH=")
        return None


def _operate(run: Interpreter, record: Record) -> None:
    if not record.keys:
        run.complain(record, "nothing is given; write T1= ... P1= ... or TREF=")
        return
    run.carried.operation = _operation(run.carried.operation, record.keys)


def _operation(old: Operation, keys: dict[str, Any]) -> Operation:
    """Change the operation by the keys T1 P1 TREF among others."""
    t, p, tref = dict(old.t), dict(old.p), old.tref
    for key, value in keys.items():
        if len(key) == 2 and key[1] in SETS and key[0] in "TP":
            (t if key[0] == "T" else p)[key[1]] = value
        elif key == "TREF":
            tref = value
    return Operation(t, p, tref)


def _node(run: Interpreter, record: Record) -> None:
    keys = record.keys
    xyz = (keys.get("X", 0.0), keys.get("Y", 0.0), keys.get("Z", 0.0))
    run.keep(run.model.nodes, Node(record.args[0], xyz, record.place))


def _pipe(run: Interpreter, record: Record) -> None:
    keys, carried = record.keys, run.carried
    start, end = record.args
    section, material = carried.section, carried.material
    delta = None
    plain = len(keys)
    if plain == 1 and ("DX" in keys or "DY" in keys or "DZ" in keys):  # the common card
        delta = (keys.get("DX", 0.0), keys.get("DY", 0.0), keys.get("DZ", 0.0))
    elif plain:
        delta = _delta(run, record)
        section, material = _current(run, record)
        if any(key in keys for key in _OPERATION_KEYS):
            carried.operation = _operation(carried.operation, keys)
    if section is None or material is None:
        if section is None:
            run.complain(record, "no section: write a SECTION card before, or SECTION=")
            carried.section = ""
        if material is None:
            run.complain(record, "no material: write a MATERIAL card before, or MATERIAL=")
            carried.material = ""
    if start == end:
        run.complain(record, f"both ends are node {end}", 2)
    elif delta == (0.0, 0.0, 0.0):
        run.complain(record, "the pipe has no length")
    run.keep(
        run.model.pipes,
        Pipe(
            start,
            end,
            delta,
            section or "",
            material or "",
            carried.operation,
            record.keyword == "RIGID",
            keys.get("WEIGHT", 0.0),
            record.place,
        ),
    )


_OPERATION_KEYS = ("TREF", *(a + s for a in "TP" for s in "123456789"))


def _current(run: Interpreter, record: Record) -> tuple[str | None, str | None]:
    """Section and material of a pipe; keys change the current ones."""
    carried, keys = run.carried, record.keys
    for key, known in (("SECTION", run.model.sections), ("MATERIAL", run.model.materials)):
        name = keys.get(key)
        if name is None:
            continue
        if name not in known and name not in carried.broken:
            hint = nearest(name, known)
            run.complain(record, f"{key.lower()} {name} is not defined before{hint}", f"{key}=")
        if key == "SECTION":
            carried.section = name
        else:
            carried.material = name
    return carried.section, carried.material


def _delta(run: Interpreter, record: Record) -> tuple[float, float, float] | None:
    """Vector of a pipe from DX DY DZ or LENGTH and DIR; None when the card has none."""
    keys = record.keys
    given = [key for key in ("DX", "DY", "DZ") if key in keys]
    if "LENGTH" in keys or "DIR" in keys:
        if given:
            run.complain(
                record, f"{given[0]} with LENGTH and DIR: give one or the other", f"{given[0]}="
            )
        elif "DIR" not in keys:
            run.complain(record, "LENGTH needs DIR=(x,y,z)", "LENGTH=")
        elif "LENGTH" not in keys:
            run.complain(record, "DIR needs LENGTH=", "DIR=")
        else:
            x, y, z = keys["DIR"]
            scale = keys["LENGTH"] / hypot(x, y, z)
            return x * scale, y * scale, z * scale
        return None
    if not given:
        return None
    return keys.get("DX", 0.0), keys.get("DY", 0.0), keys.get("DZ", 0.0)


def _bend(run: Interpreter, record: Record) -> None:
    keys = record.keys
    size = record.args[1] if len(record.args) > 1 else None
    if size and "R" in keys:
        run.complain(record, f"{size} and R=: one of them gives the radius", "R=")
    run.keep(
        run.model.bends,
        Bend(
            record.args[0],
            keys.get("R"),
            1.0 if size == "SHORT" else 1.5,
            keys.get("K"),
            keys.get("FLANGES", 0),
            record.place,
        ),
    )


def _spring(run: Interpreter, record: Record) -> None:
    keys, names = record.keys, ("KX", "KY", "KZ", "KRX", "KRY", "KRZ")
    kx, ky, kz, krx, kry, krz = (keys.get(name, 0.0) for name in names)
    k = (kx, ky, kz, krx, kry, krz)
    if not any(k):
        run.complain(record, f"all stiffnesses are zero; give one of {' '.join(names)}")
        return
    axis = keys.get("AXIS")
    if len(record.args) == 1:
        run.keep(
            run.model.supports,
            Support(record.args[0], "spring", ks=k, axis=axis, place=record.place),
        )
        return
    start, end = record.args
    if start == end:
        run.complain(record, f"both ends are node {end}", 2)
    run.keep(run.model.springs, Spring(start, end, k, axis, record.place))


def _mass(run: Interpreter, record: Record) -> None:
    keys = record.keys
    if ("M" in keys) == ("W" in keys):
        run.complain(record, "give the mass M= or the weight W=" + ", not both" * ("M" in keys))
        return
    mass = keys["M"] if "M" in keys else keys["W"] / run.model.settings.g
    run.keep(run.model.masses, Mass(record.args[0], mass, record.place))


def _anchor(run: Interpreter, record: Record) -> None:
    keys = record.keys
    run.keep(
        run.model.supports,
        Support(
            record.args[0],
            "anchor",
            cnode=keys.get("CNODE"),
            name=keys.get("NAME"),
            k=keys.get("K"),
            kr=keys.get("KR"),
            place=record.place,
        ),
    )


def _support(run: Interpreter, record: Record) -> None:
    friction = record.keys.get("FRICTION")
    directions = []
    for word in record.words:
        get = word.keys.get
        directions.append(
            Direction(
                word.text,
                word.vector,
                get("GAP", (0.0, 0.0)),
                get("K"),
                get("KF"),
                get("MU"),
                get("ALONG"),
                friction,
            )
        )
    run.keep(
        run.model.supports,
        Support(
            record.args[0],
            "support",
            tuple(directions),
            record.keys.get("CNODE"),
            record.keys.get("NAME"),
            place=record.place,
        ),
    )


def _hanger(run: Interpreter, record: Record) -> None:
    keys = record.keys
    run.keep(
        run.model.supports,
        Support(
            record.args[0],
            "hanger",
            cnode=keys.get("CNODE"),
            name=keys.get("NAME"),
            k=keys.get("RATE", 0.0),
            load=keys["LOAD"],
            place=record.place,
        ),
    )


def _force(run: Interpreter, record: Record) -> None:
    node, name = record.args
    if not record.keys:
        run.complain(record, "nothing is given; write FX= ... MZ=")
        return
    fx, fy, fz, mx, my, mz = (record.keys.get(k, 0.0) for k in ("FX", "FY", "FZ", "MX", "MY", "MZ"))
    run.keep(run.model.forces, Force(node, name[1], (fx, fy, fz, mx, my, mz), record.place))


def _displacement(run: Interpreter, record: Record) -> None:
    node, name = record.args
    d = tuple(record.keys.get(k) for k in ("DX", "DY", "DZ", "RX", "RY", "RZ"))
    if not record.keys:
        run.complain(record, "nothing is given; write DX= ... RZ=")
        return
    made = run.model.displacements
    at = run.carried.displacements.setdefault((node, name[1]), len(made))
    if at == len(made):
        made.append(Displacement(node, name[1], d, record.place))
        return
    for key, old in zip(("DX", "DY", "DZ", "RX", "RY", "RZ"), made[at].d, strict=True):
        if old is not None and key in record.keys:
            run.complain(
                record, f"{key} of set {name} is given at {made[at].place} already", f"{key}="
            )
            return
    both = tuple(new if old is None else old for old, new in zip(made[at].d, d, strict=True))
    made[at] = replace(made[at], d=both)


def _acceleration(run: Interpreter, record: Record) -> None:
    keys, name = record.keys, record.args[0]
    if not keys:
        run.complain(record, "nothing is given; write X= Y= Z=")
        return
    for known in run.model.accelerations:
        if known.set == name[1]:
            run.complain(record, f"set {name} is already given at {known.place}", name)
    a = (keys.get("X", 0.0), keys.get("Y", 0.0), keys.get("Z", 0.0))
    run.keep(run.model.accelerations, Acceleration(name[1], a, record.place))


def _case(run: Interpreter, record: Record) -> None:
    names = ex.case_names(record.expression)
    if names and not any(n in ex.RESERVED for n in names):
        known = {case.name for case in run.model.cases} | run.carried.broken
        if all(n in known for n in names) and "vector" not in str(record.expression):
            _comb_of_case(run, record)
            return
    try:
        items = ex.terms(record.expression)
    except ValueError as error:
        run.complain(record, str(error), "ABS")
        return
    faulty = _faulty_terms(run, record, items)
    keys = record.keys
    if faulty:
        return
    run.keep(
        run.model.cases,
        Case(
            record.args[0],
            tuple(items),
            keys.get("FROM"),
            keys.get("STEPS", 1),
            keys.get("MUX", 1.0),
            keys.get("E") == "HOT",
            None if "EVENTS" not in keys else keys["EVENTS"] == "ON",
            keys.get("ITERATION"),
            keys.get("SNUBBERS"),
            record.place,
        ),
    )


def _faulty_terms(run: Interpreter, record: Record, items: list[Term]) -> bool:
    """Complain of terms of a CASE that are no load sets."""
    cases = {case.name for case in run.model.cases}
    faulty = False
    for name in dict.fromkeys(term.name for term in items):
        if name in ex.LOAD_SETS or name == "U" and _has_vector(items):
            continue
        faulty = True
        if name in run.carried.broken and name not in cases:
            continue
        if name in cases:
            message = f"{name} is a case; CASE sums load sets, COMB sums results (and FROM= starts from a case)"
        else:
            message = ex.unknown_set(name, cases)
        run.complain(record, message, name)
    return faulty


def _has_vector(items: list[Term]) -> bool:
    """Tell whether U stands with its vector."""
    return all(term.vector is not None for term in items if term.name == "U")


def _comb_of_case(run: Interpreter, record: Record) -> None:
    """CASE EXP = OPE - SUS is a combination."""
    for key in record.keys:
        run.complain(
            record, f"{key}: this sums results of cases, a COMB, which has no {key}", f"{key}="
        )
    _comb(run, record)


def _comb(run: Interpreter, record: Record) -> None:
    expression = record.expression
    text = str(expression)
    if "'vector'" in text:
        run.complain(record, "U(x,y,z) is a load set; COMB sums results of cases", "U")
        return
    for name in dict.fromkeys(ex.case_names(expression)):
        if name in ex.RESERVED:
            run.complain(record, f"{name} is a load set; COMB sums results of cases", name)
            return
    made = Comb(record.args[0], expression, ex.format_expression(expression), record.place)
    run.keep(run.model.cases, made)


def _title(run: Interpreter, record: Record) -> None:
    run.model.title = record.keys["TEXT"]


_ACTIONS: dict[str, Callable[[Interpreter, Record], None]] = {
    "TITLE": _title,
    "DEFAULT": _default,
    "MATERIAL": _material,
    "PROPERTY": _property,
    "SECTION": _section,
    "OPERATE": _operate,
    "NODE": _node,
    "PIPE": _pipe,
    "RIGID": _pipe,
    "BEND": _bend,
    "SPRING": _spring,
    "MASS": _mass,
    "ANCHOR": _anchor,
    "SUPPORT": _support,
    "HANGER": _hanger,
    "FORCE": _force,
    "DISPLACEMENT": _displacement,
    "ACCELERATION": _acceleration,
    "CASE": _case,
    "COMB": _comb,
}
