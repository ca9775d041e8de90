"""Cards of anchors, supports, hangers and snubbers to the model."""

from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.deck.values import vector
from trunnion.model import Direction, Support


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


def hanger(run: Context, record: Record) -> None:
    """HANGER: rate and cold load."""
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
