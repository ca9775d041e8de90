"""Cards of modes, spectra, groups of supports and cycles to the model."""

from itertools import pairwise

from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.model import Cycle, Group, Modes, Spectrum

INCH = 0.0254  # [m]


def modes(run: Context, record: Record) -> None:
    """MODES: one card a deck."""
    keys, known = record.keys, run.model.modal
    if known is not None:
        run.complain(record, f"there is one at {known.place} already", 0)
        return
    made = Modes(
        keys["N"],
        keys.get("FMAX"),
        keys.get("ABOUT"),
        keys.get("MASS", "LUMPED"),
        keys.get("MESH", "AUTO"),
        keys.get("ROTARY", "ON") == "ON",
        keys.get("FRICTION", 0.0),
        record.place,
    )
    if made.friction and made.about is None:
        message = "FRICTION needs ABOUT=: the normal forces are those of a case"
        run.complain(record, message, "FRICTION=")
        return
    run.model.modal = made


def spectrum(run: Context, record: Record) -> None:
    """SPECTRUM: points by rising frequency or period, kept by rising frequency in m/s2."""
    name, keys, known = record.args[0], record.keys, run.model.spectra
    if name in known:
        run.complain(record, f"spectrum {name} is already defined at {known[name].place}", name)
        return
    points, period = keys["TABLE"], keys.get("X") == "PERIOD"
    log = keys.get("INTERP", "LOG") == "LOG"
    fault = _fault(points, "periods" if period else "frequencies", log=log)
    if fault:
        run.complain(record, fault, "TABLE=")
        return
    scale = {"G": run.model.settings.g, "M/S2": 1.0, "IN/S2": INCH}[keys.get("Y", "G")]
    if period:
        points = [(1.0 / x, y) for x, y in reversed(points)]
    known[name] = Spectrum(
        name,
        tuple(x for x, _ in points),
        tuple(scale * y for _, y in points),
        log,
        period and not log,
        record.place,
    )


def _fault(points: tuple[tuple[float, float], ...], what: str, *, log: bool) -> str:
    """Say what keeps points from being a spectrum."""
    if len(points) < 2:
        return "a spectrum needs two points at least"
    if points[0][0] <= 0.0:
        return f"{what} must be positive"
    for i, (low, high) in enumerate(pairwise(points), 2):
        if not high[0] > low[0]:
            return f"{what} must rise; {high[0]:g} of point {i} comes after {low[0]:g}"
    lowest = min(y for _, y in points)
    if lowest < 0.0 or (log and lowest == 0.0):
        also = " with INTERP=LOG" if lowest == 0.0 else ""
        return f"accelerations must be positive{also}; {lowest:g} is not"
    return ""


def group(run: Context, record: Record) -> None:
    """GROUP: nodes of supports that move together."""
    name = record.args[0]
    for known in run.model.groups:
        if known.name == name:
            run.complain(record, f"group {name} is already defined at {known.place}", name)
    for i, node in enumerate(record.items):
        if node in record.items[:i]:
            run.complain(record, f"node {node} is given twice", node)
    run.keep(run.model.groups, Group(name, tuple(record.items), record.place))


def cycle(run: Context, record: Record) -> None:
    """CYCLE: names of cases in their order."""
    if len(record.items) < 2:
        run.complain(record, "a cycle has two cases at least; write CYCLE HEAT = OPE, SUS TIMES=4")
    made = Cycle(
        record.args[0],
        tuple(record.items),
        record.keys["TIMES"],
        record.keys.get("FROM"),
        record.place,
    )
    run.keep(run.model.cycles, made)
