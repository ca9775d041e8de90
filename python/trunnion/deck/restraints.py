"""Cards of anchors, supports, hangers and snubbers to the model."""

from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.deck.values import vector
from trunnion.model import Direction, HangerDesign, SpringSize, Support


def anchor(run: Context, record: Record) -> None:
    """ANCHOR: six freedoms."""
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


def support(run: Context, record: Record) -> None:
    """SUPPORT: one contact a direction word."""
    run.keep(
        run.model.supports,
        Support(
            record.args[0],
            "support",
            record.words,
            record.keys.get("CNODE"),
            record.keys.get("NAME"),
            place=record.place,
        ),
    )


DESIGN_KEYS = {
    "VARIATION": "variation",
    "ROD": "rod",
    "MAXTRAVEL": "most",
    "NUMBER": "number",
    "METHOD": "method",
    "SERIES": "series",
    "OPERATING": "operating",
    "TABLE": "table",
    "FREE": "free",
    "FREE2": "free2",
}


def hanger(run: Context, record: Record) -> None:
    """HANGER: rate and cold load, or what is asked of its selection."""
    keys, node = record.keys, record.args[0]
    asked = {field: keys[key] for key, field in DESIGN_KEYS.items() if key in keys}
    design = HangerDesign(**asked) if len(record.args) > 1 else None
    if design is None and asked:
        key = next(key for key in DESIGN_KEYS if key in keys)
        run.complain(record, f"{key} is for a hanger with the word DESIGN", f"{key}=")
    elif design is None and "LOAD" not in keys:
        run.complain(record, "LOAD= is missing, or the word DESIGN to have it selected")
    elif design is not None and (given := [key for key in ("RATE", "LOAD") if key in keys]):
        run.complain(record, f"{given[0]} with DESIGN: give one or the other", f"{given[0]}=")
    run.keep(
        run.model.supports,
        Support(
            node,
            "hanger",
            cnode=keys.get("CNODE"),
            name=keys.get("NAME"),
            k=keys.get("RATE", 0.0),
            load=keys.get("LOAD", 0.0),
            place=record.place,
            design=design,
        ),
    )


def spring_size(run: Context, record: Record) -> None:
    """SPRINGSIZE: one row of the table of springs."""
    keys, name = record.keys, record.args[0]
    for known in run.model.spring_sizes:
        if known.name == name:
            run.complain(record, f"size {name} is already given at {known.place}", name)
            return
    if not keys["MIN"] < keys["MAX"]:
        run.complain(record, "MIN is not below MAX", "MIN=")
        return
    size = SpringSize(name, keys["SERIES"], keys["MIN"], keys["MAX"], keys["RATE"], record.place)
    run.keep(run.model.spring_sizes, size)


def snubber(run: Context, record: Record) -> None:
    """SNUBBER: one direction, both ways, when locked."""
    node, word = record.args
    found = vector(word) if word.startswith("(") else None
    if found is not None:
        word = f"({','.join(f'{x:g}' for x in found)})"
    run.keep(
        run.model.supports,
        Support(
            node,
            "snubber",
            (Direction(word, found),),
            record.keys.get("CNODE"),
            record.keys.get("NAME"),
            record.keys.get("K"),
            place=record.place,
        ),
    )
