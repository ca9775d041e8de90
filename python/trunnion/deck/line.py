"""Cards of nodes, pipes, bends, springs and masses to the model."""

from math import hypot
from typing import Any

from trunnion.deck.components import cold_spring, joint, reducer
from trunnion.deck.context import Context
from trunnion.deck.keywords import PRESSURE_SETS, TEMPERATURE_SETS
from trunnion.deck.properties import changed
from trunnion.deck.record import Record
from trunnion.deck.values import nearest
from trunnion.model import Bend, Mass, Node, Pipe, Spring, Support

_DELTA = frozenset(("DX", "DY", "DZ"))
_BODIES = frozenset(("RIGID", "VALVE", "FLANGE"))
_SPECIAL = frozenset(("CUTSHORT", "CUTLONG", "OFFSET1", "OFFSET2"))
_NOTHING: dict[str, Any] = {}
_OPERATION = frozenset(("TREF", *TEMPERATURE_SETS, *PRESSURE_SETS))


def node(run: Context, record: Record) -> None:
    """NODE: coordinates."""
    keys = record.keys
    xyz = (keys.get("X", 0.0), keys.get("Y", 0.0), keys.get("Z", 0.0))
    run.keep(run.model.nodes, Node(record.args[0], xyz, record.place))


def pipe(run: Context, record: Record) -> None:
    """PIPE, RIGID and their kin: a straight run with what is current."""
    keys, carried, word = record.keys, run.carried, record.keyword
    start, end = record.args
    delta = _delta(run, record) if keys else None
    if not _DELTA.issuperset(keys):  # most cards have nothing else
        _make_current(run, record)
    if carried.section is None or carried.material is None:
        _miss_current(run, record)
    section, more = carried.section or "", _NOTHING
    if word == "REDUCER":
        delta, more = reducer(run, record, delta)
    elif word == "JOINT":
        delta, more = joint(run, record, delta)
    elif word in _BODIES:
        more = {"body": "" if word == "RIGID" else word}
    elif not _SPECIAL.isdisjoint(keys):
        more = {"cut": cold_spring(run, record)}
        more["offsets"] = (keys.get("OFFSET1"), keys.get("OFFSET2"))
    if start == end:
        run.complain(record, f"both ends are node {end}", 2)
    elif delta == (0.0, 0.0, 0.0) and word != "JOINT":
        run.complain(record, f"the {word.lower()} has no length")
    run.keep(
        run.model.pipes,
        Pipe(
            start,
            end,
            delta,
            section,
            carried.material or "",
            carried.operation,
            word in _BODIES,
            keys.get("WEIGHT", 0.0),
            record.place,
            uniform=carried.uniform,
            **more,
        ),
    )


def _miss_current(run: Context, record: Record) -> None:
    """Complain once that no section or no material is current."""
    for what in ("section", "material"):
        if getattr(run.carried, what) is None:
            word = what.upper()
            run.miss(record, f"no {what}: write a {word} card before, or {word}=")
            setattr(run.carried, what, "")


def _make_current(run: Context, record: Record) -> None:
    """Keys SECTION, MATERIAL and those of OPERATE change what is current."""
    carried, keys = run.carried, record.keys
    for key, known in (("SECTION", run.model.sections), ("MATERIAL", run.model.materials)):
        name = keys.get(key)
        if name is None:
            continue
        if name not in known and name not in carried.broken:
            hint = nearest(name, known)
            run.miss(record, f"{key.lower()} {name} is not defined before{hint}", f"{key}=")
        setattr(carried, key.lower(), name)
    if not keys.keys().isdisjoint(_OPERATION):
        carried.operation = changed(carried.operation, keys)


def _delta(run: Context, record: Record) -> tuple[float, float, float] | None:
    """Vector of a pipe from DX DY DZ or LENGTH and DIR; None when the card has none."""
    keys = record.keys
    if "LENGTH" in keys or "DIR" in keys:
        return _along(run, record)
    if _DELTA.isdisjoint(keys):
        return None
    return keys.get("DX", 0.0), keys.get("DY", 0.0), keys.get("DZ", 0.0)


def _along(run: Context, record: Record) -> tuple[float, float, float] | None:
    """Vector of a pipe from LENGTH and DIR."""
    keys = record.keys
    given = [key for key in ("DX", "DY", "DZ") if key in keys]
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


def bend(run: Context, record: Record) -> None:
    """BEND: a radius, or LONG or SHORT."""
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


def spring(run: Context, record: Record) -> None:
    """SPRING: between two nodes, or from one to ground (then a support)."""
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


def mass(run: Context, record: Record) -> None:
    """MASS: by mass or by weight."""
    keys = record.keys
    if ("M" in keys) == ("W" in keys):
        run.complain(record, "give the mass M= or the weight W=" + ", not both" * ("M" in keys))
        return
    mass = keys["M"] if "M" in keys else keys["W"] / run.model.settings.g
    run.keep(run.model.masses, Mass(record.args[0], mass, record.place))
