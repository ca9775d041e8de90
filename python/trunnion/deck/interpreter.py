"""Records to Model: one action for each keyword of the table."""

from collections.abc import Callable

from trunnion.deck import (
    cases,
    components,
    dynamics,
    line,
    occasional,
    properties,
    restraints,
    sets,
)
from trunnion.deck.context import Context
from trunnion.deck.record import Record

ACTIONS: dict[str, Callable[[Context, Record], None]] = {
    "TITLE": properties.title,
    "DEFAULT": properties.default,
    "MATERIAL": properties.material,
    "PROPERTY": properties.property_point,
    "SECTION": properties.section,
    "OPERATE": properties.operate,
    "NODE": line.node,
    "PIPE": line.pipe,
    "RIGID": line.pipe,
    "VALVE": line.pipe,
    "FLANGE": line.pipe,
    "REDUCER": line.pipe,
    "JOINT": line.pipe,
    "UNIFORM": components.uniform,
    "BEND": line.bend,
    "SPRING": line.spring,
    "MASS": line.mass,
    "ANCHOR": restraints.anchor,
    "SUPPORT": restraints.support,
    "HANGER": restraints.hanger,
    "SPRINGSIZE": restraints.spring_size,
    "SNUBBER": restraints.snubber,
    "FORCE": sets.force,
    "DISPLACEMENT": sets.displacement,
    "ACCELERATION": sets.acceleration,
    "WIND": occasional.wind,
    "SNOW": occasional.snow,
    "SPECTRUM": dynamics.spectrum,
    "GROUP": dynamics.group,
    "MODES": dynamics.modes,
    "CASE": cases.case,
    "COMB": cases.comb,
    "CYCLE": dynamics.cycle,
}


def apply(context: Context, record: Record) -> None:
    """Do what one record says, unless it has a fault."""
    context.before = len(context.faults)
    ACTIONS[record.keyword](context, record)
