"""The table of quantities that a study may vary: reader, `docs/many.md` and errors come from it."""

from collections.abc import Mapping

from trunnion.deck.keywords import ACCELERATIONS, DEGREES, PRESSURE_SETS, TEMPERATURE_SETS
from trunnion.many.edits import (
    FORCES,
    Quantity,
    acceleration,
    expansion,
    factor,
    field,
    imposed,
    leg,
    modulus,
    of_case,
    operation,
    radius,
    setting,
)
from trunnion.many.supports import SUPPORTS
from trunnion.model import SETS


def _table() -> Mapping[str, Quantity]:
    q: dict[str, Quantity] = dict(SUPPORTS)
    for key in ("KR", "G"):
        rank = "loads" if key == "G" else "supports"
        q[key] = Quantity("DEFAULT", key, setting(key.lower()), f"{key} of the DEFAULT card", rank)
    for name in TEMPERATURE_SETS + PRESSURE_SETS:
        what = f"{name} of pipe a-b, or of all pipes that have it"
        q[name] = Quantity("OPERATE", name, operation(name), what, "loads")
    q["E"] = Quantity("MATERIAL", "E", modulus, "modulus of a material, or of all", "members")
    q["NU"] = Quantity("MATERIAL", "NU", field("materials", "nu", "MATERIAL"), "", "members")
    q["ALPHA"] = Quantity("MATERIAL", "ALPHA", expansion, "", "loads")
    dense = field("materials", "density", "MATERIAL")
    q["DENSITY"] = Quantity("MATERIAL", "DENSITY", dense, "", "loads")
    for key in ("OD", "WALL"):
        q[key] = Quantity("SECTION", key, field("sections", key.lower(), "SECTION"), "", "members")
    for key in ("FLUID", "LINING", "LINING_DENSITY", "INSULATION", "INSULATION_DENSITY", "WEIGHT"):
        q[key] = Quantity("SECTION", key, field("sections", key.lower(), "SECTION"), "", "loads")
    for i, key in enumerate(("DX", "DY", "DZ")):
        q[key] = Quantity("PIPE", key, leg(i), "leg of pipe a-b", "members", "a-b")
    q["R"] = Quantity("BEND", "R", radius, "radius of a bend, or of all", "members")
    for n in SETS:
        moved = imposed("displacements", n, DEGREES)
        q[f"D{n}"] = Quantity("DISPLACEMENT", "DX", moved, "component", "loads", "node,DX")
        pushed = imposed("forces", n, FORCES)
        q[f"F{n}"] = Quantity("FORCE", "FX", pushed, "component", "loads", "node,FX")
    for name in ACCELERATIONS:
        accelerated = acceleration(name[1:])
        q[name] = Quantity("ACCELERATION", "X", accelerated, "component in g", "loads", "X")
    q["FACTOR"] = Quantity("CASE", "FACTOR", factor, "factor of a load set", "cases", "set")
    q["MUX"] = Quantity("CASE", "MUX", of_case("mux"), "MUX of a case, or of all", "cases")
    q["STEPS"] = Quantity("CASE", "STEPS", of_case("steps"), "STEPS of a case", "cases")
    return q


QUANTITIES: Mapping[str, Quantity] = _table()
