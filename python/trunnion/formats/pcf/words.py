"""Keywords of a PCF: what each component is to a stress model."""

#: component -> shape; the shape says which points it has and what becomes of it
SHAPES: dict[str, str] = {
    **dict.fromkeys(("PIPE", "PIPE-FIXED", "PIPE-BLOCK-FIXED", "PIPE-BLOCK-VARIABLE"), "pipe"),
    **dict.fromkeys(("BEND", "ELBOW"), "bend"),
    **dict.fromkeys(("BEND-TEED", "ELBOW-TEED", "ELBOW-REDUCING"), "teed"),
    **dict.fromkeys(("TEE", "TEE-SET-ON", "TEE-STUB", "TEE-REDUCING"), "tee"),
    **dict.fromkeys(("CROSS", "CROSS-SET-ON", "CROSS-STUB"), "tee"),
    **dict.fromkeys(("Y-PIECE", "Y-PIECE-FITTING", "Y-PIECE-BEND"), "tee"),
    **dict.fromkeys(("OLET", "WELDOLET", "SOCKOLET", "THREDOLET", "NIPOLET", "LATROLET"), "olet"),
    **dict.fromkeys(("SWEEPOLET", "ELBOLET"), "olet"),
    **dict.fromkeys(("REDUCER-CONCENTRIC", "REDUCER-ECCENTRIC", "REDUCER"), "reducer"),
    **dict.fromkeys(("REDUCER-CONCENTRIC-TEED", "REDUCER-ECCENTRIC-TEED"), "teed"),
    **dict.fromkeys(("FLANGE-REDUCING-CONCENTRIC", "FLANGE-REDUCING-ECCENTRIC"), "rigid"),
    **dict.fromkeys(("FLANGE", "VALVE", "INSTRUMENT", "FILTER", "TRAP"), "rigid"),
    **dict.fromkeys(("INSTRUMENT-BALLOON", "INSTRUMENT-DIAL"), "mark"),
    **dict.fromkeys(("VALVE-ANGLE", "INSTRUMENT-ANGLE", "FILTER-ANGLE", "TRAP-ANGLE"), "angle"),
    **dict.fromkeys(("TRAP-RETURN", "FILTER-RETURN", "INSTRUMENT-RETURN"), "angle"),
    **dict.fromkeys(("FILTER-OFFSET", "TRAP-OFFSET", "INSTRUMENT-OFFSET"), "rigid"),
    **dict.fromkeys(("VALVE-3WAY", "INSTRUMENT-3WAY", "VALVE-4WAY", "INSTRUMENT-4WAY"), "ways"),
    "VALVE-MULTIWAY": "ways",
    **dict.fromkeys(("FLANGE-BLIND", "CAP", "PLUG"), "closed"),
    **dict.fromkeys(("GASKET", "SPACER"), "gasket"),
    **dict.fromkeys(("COUPLING", "UNION", "CLAMP", "LAPJOINT-STUBEND"), "fitting"),
    "BUSHING": "fitting",
    **dict.fromkeys(("LAPJOINT-RING", "NIPPLE", "CONNECTOR", "LENGTH"), "fitting"),
    **dict.fromkeys(("MISC-COMPONENT", "MISC-COMPONENT-RETURN", "TUBE"), "rigid"),
    "MISC-COMPONENT-ANGLE": "angle",
    **dict.fromkeys(("WELD", "ADDITIONAL-ITEM"), "weld"),
    **dict.fromkeys(("SUPPORT", "HANGER"), "support"),
    "ANCHOR": "anchor",
    **dict.fromkeys(("BOLT", "FLOOR-SYMBOL", "FLOW-ARROW", "LOCATION-POINT"), "mark"),
    **dict.fromkeys(("INSULATION-SYMBOL", "SPLIT-POINT", "ISO-SPLIT-POINT"), "mark"),
    **dict.fromkeys(("OPERATOR", "WALL-SYMBOL", "DIMENSION", "TEXT", "GRID-REFERENCE"), "mark"),
    **dict.fromkeys(("REINFORCEMENT-PAD", "REFERENCE-ANCHOR", "SKETCH-POINT"), "mark"),
    **dict.fromkeys(("START-POINT", "STOP-POINT", "SCREWED-CONNECTION"), "mark"),
    **dict.fromkeys(("PIPE-SUPPORT-SYMBOL", "REFERENCE-DIMENSION"), "mark"),
}

COMPONENTS = frozenset(SHAPES)

#: any END-POSITION-.. and END-CONNECTION-.. is an end; these are seen
ENDS = (
    "END-POSITION-OPEN",
    "END-POSITION-NULL",
    "END-POSITION-CLOSED",
    "END-POSITION-VENT",
    "END-POSITION-DRAIN",
    "END-CONNECTION-EQUIPMENT",
    "END-CONNECTION-PIPELINE",
)

#: ends that no equipment holds: capped, or a vent or drain that ends in the air
LOOSE_ENDS = ("END-POSITION-CLOSED", "END-POSITION-VENT", "END-POSITION-DRAIN")

UNITS = (
    *("UNITS-BORE", "UNITS-CO-ORDS", "UNITS-WEIGHT", "UNITS-WEIGHT-LENGTH"),
    *("UNITS-BOLT-DIA", "UNITS-BOLT-LENGTH"),
)

HEADERS = (*UNITS, "ISOGEN-FILES", "UID", "PIPELINE-REFERENCE", "MATERIALS")

MESSAGES = ("MESSAGE-SQUARE", "MESSAGE-CIRCLE", "MESSAGE-ROUND", "MESSAGE-DIAMOND", "MESSAGE-OVAL")

OPENERS = COMPONENTS | {*ENDS, *HEADERS, *MESSAGES}

#: names of components that are attributes wherever nothing is indented
ATTRIBUTE_ONLY = frozenset(("LENGTH", "OPERATOR", "TUBE", "CONNECTOR", "TEXT", "DIMENSION"))

#: beginnings of what belongs to the pipeline, also where a writer does not indent it
PIPELINE_WORDS = (
    *("PROJECT-", "DATE-", "AREA", "REVISION", "ATTRIBUTE", "PIPING-SPEC", "PIPELINE-TEMP"),
    *("PIPELINE-TYPE", "NOMINAL-CLASS", "INSULATION-SPEC", "TRACING-SPEC", "PAINTING-SPEC"),
    *("MISC-SPEC", "JACKET-SPEC", "SPOOL-", "BEND-RADIUS", "START-CO-ORDS", "FLUID", "DESIGN-"),
)


def is_message(keyword: str) -> bool:
    """Tell whether a block is a note on the drawing, never a component."""
    return keyword == "MESSAGE" or keyword.startswith("MESSAGE-")
