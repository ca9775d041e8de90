"""Cards of load sets to the model: forces, displacements, accelerations."""

from dataclasses import replace

from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.model import Acceleration, Displacement, Force


def force(run: Context, record: Record) -> None:
    """FORCE: cards of one set add up."""
    node, name = record.args
    if not record.keys:
        run.complain(record, "nothing is given; write FX= ... MZ=")
        return
    fx, fy, fz, mx, my, mz = (record.keys.get(k, 0.0) for k in ("FX", "FY", "FZ", "MX", "MY", "MZ"))
    run.keep(run.model.forces, Force(node, name[1], (fx, fy, fz, mx, my, mz), record.place))


def displacement(run: Context, record: Record) -> None:
    """DISPLACEMENT: cards of one node and set complete each other."""
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


def acceleration(run: Context, record: Record) -> None:
    """ACCELERATION: one card a set."""
    keys, name = record.keys, record.args[0]
    if not keys:
        run.complain(record, "nothing is given; write X= Y= Z=")
        return
    for known in run.model.accelerations:
        if known.set == name[1]:
            run.complain(record, f"set {name} is already given at {known.place}", name)
    a = (keys.get("X", 0.0), keys.get("Y", 0.0), keys.get("Z", 0.0))
    run.keep(run.model.accelerations, Acceleration(name[1], a, record.place))
