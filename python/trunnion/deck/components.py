"""Cards of reducers, expansion joints and uniform loads to the model."""

from typing import Any

from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.deck.values import nearest
from trunnion.model import Joint, Reducer, Uniform

Vec = tuple[float, float, float]
_PLAIN, _IN_G = ("X", "Y", "Z"), ("GX", "GY", "GZ")
RATES = ("AXIAL", "LATERAL", "BENDING", "TORSION", "AREA")


def reducer(run: Context, record: Record, delta: Vec | None) -> tuple[Vec | None, dict[str, Any]]:
    """REDUCER: section at the second end, current from then on; eccentric by AXIS= or FLAT=.

    Returns the vector from centre to centre, and what the pipe gets.
    """
    keys, carried = record.keys, run.carried
    first, last = carried.section or "", keys["TO"]
    axis = keys.get("AXIS")
    known = run.model.sections
    if last not in known and last not in carried.broken:
        run.miss(record, f"section {last} is not defined before{nearest(last, known)}", "TO=")
    elif "FLAT" in keys and axis is not None:
        run.complain(record, "AXIS and FLAT: one of them makes the reducer eccentric", "FLAT=")
    elif "FLAT" in keys and first in known and last in known:
        delta, axis = _flat(run, record, delta, 0.5 * (known[first].od - known[last].od))
    carried.section = last
    return delta, {"reducer": Reducer(last, axis)}


def _flat(
    run: Context, record: Record, delta: Vec | None, drop: float
) -> tuple[Vec | None, Vec | None]:
    """Lower (FLAT=DOWN) or lift the centre of the second end so that one side runs level."""
    up = 1 if run.model.settings.up == "Y" else 2
    if delta is None:
        run.complain(record, "FLAT needs DX DY DZ, or LENGTH and DIR, along the axis", "FLAT=")
    elif delta[up] != 0.0:
        axis = run.model.settings.up
        message = f"FLAT is for a horizontal reducer, D{axis} is not 0; give AXIS="
        run.complain(record, message, "FLAT=")
    else:
        moved = list(delta)
        moved[up] = -drop if record.keys["FLAT"] == "DOWN" else drop
        return (moved[0], moved[1], moved[2]), delta
    return delta, None


def joint(run: Context, record: Record, delta: Vec | None) -> tuple[Vec | None, dict[str, Any]]:
    """JOINT: an expansion joint; without DX DY DZ it has no length, and needs AXIS=."""
    keys = record.keys
    delta = delta or (0.0, 0.0, 0.0)
    axis = keys.get("AXIS")
    if delta == (0.0, 0.0, 0.0) and axis is None:
        run.complain(record, "an expansion joint without length needs AXIS=(x,y,z)")
    rates = {key.lower(): keys[key] for key in RATES if key in keys}
    return delta, {"joint": Joint(axis=axis, **rates)}


def cold_spring(run: Context, record: Record) -> float:
    """CUTSHORT and CUTLONG of a pipe [m]."""
    keys = record.keys
    if "CUTSHORT" in keys and "CUTLONG" in keys:
        run.complain(record, "CUTSHORT and CUTLONG: give one of them", "CUTLONG=")
    cut: float = keys.get("CUTSHORT", 0.0) - keys.get("CUTLONG", 0.0)
    return cut


def uniform(run: Context, record: Record) -> None:
    """UNIFORM: load of a set on the pipes that follow, until changed; zero ends it."""
    keys, name = record.keys, record.args[0]
    plain = [key for key in _PLAIN if key in keys]
    in_g = [key for key in _IN_G if key in keys]
    if plain and in_g:
        message = f"{plain[0]} and {in_g[0]}: a set is in force per length or in g"
        run.complain(record, message, f"{in_g[0]}=")
        return
    if not (plain or in_g):
        run.complain(record, "nothing is given; write X= Y= Z=, or GX= GY= GZ= in g")
        return
    x, y, z = (keys.get(key, 0.0) for key in (_IN_G if in_g else _PLAIN))
    others = tuple(q for q in run.carried.uniform if q.set != name[1])
    if x or y or z:
        others = (*others, Uniform(name[1], (x, y, z), bool(in_g)))
    run.carried.uniform = tuple(sorted(others, key=lambda q: q.set))
