"""THE keyword table: what cards there are, with positionals, keys, dimensions and meanings.

The reader, the Python API, the writer's order of keys and the reference page come from it.
"""

from typing import NamedTuple

from trunnion.frozen import frozen
from trunnion.model import SETS


class Bounds(NamedTuple):
    """Numbers that make sense: from `low` (itself not when `open_low`) to `high`."""

    low: float = float("-inf")
    high: float = float("inf")
    open_low: bool = False

    def __str__(self) -> str:
        if self.high == float("inf"):
            return f"> {self.low:g}" if self.open_low else f">= {self.low:g}"
        above = "above " if self.open_low else ""
        return f"{above}{self.low:g} to {self.high:g}"


ANY = Bounds()
POSITIVE = Bounds(0.0, open_low=True)
NOT_NEGATIVE = Bounds(0.0)
FRICTION = Bounds(0.0, 2.0)


@frozen
class Key:
    """One KEY=VALUE.

    kind : number, integer, choice, node, name, text, vector, gap, along or pairs.
    dimension : of a number (see units), "" for one that the direction word decides; of pairs
        two of them, "length, speed".
    default : what holds without the key, in words for the reference page.
    """

    name: str
    meaning: str
    dimension: str = "number"
    kind: str = "number"
    default: str = ""
    bounds: Bounds = ANY
    choices: tuple[str, ...] = ()
    required: bool = False
    card_wide: bool = False


@frozen
class Positional:
    """One word without "=": kind node, name, set, choice, direction, words, number or integer.

    A number or integer is kept among the keys of its record, as the key NAME would be.
    """

    name: str
    kind: str
    meaning: str
    choices: tuple[str, ...] = ()
    optional: bool = False
    dimension: str = "number"
    bounds: Bounds = ANY


@frozen
class Keyword:
    """One kind of card."""

    name: str
    meaning: str
    positionals: tuple[Positional, ...] = ()
    keys: tuple[Key, ...] = ()
    form: str = "fields"  # or: text, units, directions, equation, list
    flags: tuple[tuple[str, str], ...] = ()  # words without value among the keys, and meanings
    notes: tuple[str, ...] = ()
    example: str = ""


def _number(
    name: str,
    meaning: str,
    dimension: str = "number",
    default: str = "",
    bounds: Bounds = ANY,
    required: bool = False,
) -> Key:
    return Key(name, meaning, dimension, default=default, bounds=bounds, required=required)


def _choice(name: str, meaning: str, choices: tuple[str, ...], default: str = "") -> Key:
    return Key(name, meaning, kind="choice", choices=choices, default=default)


def _node(name: str, meaning: str = "node label") -> Positional:
    return Positional(name, "node", meaning)


ON_OFF = ("ON", "OFF")
FRICTIONS = ("CONTACT", "RESULTANT")
ITERATIONS = ("NEWTON", "STATUS")
PRESSURE_SETS = tuple(f"P{s}" for s in SETS)
TEMPERATURE_SETS = tuple(f"T{s}" for s in SETS)
DIRECTIONS = tuple(s + r + a for r in ("", "R") for s in ("", "+", "-") for a in "XYZ")
PIPE_DIRECTIONS = ("GUIDE", "LIMIT")
DEGREES = ("DX", "DY", "DZ", "RX", "RY", "RZ")
ACCELERATIONS = tuple(f"U{s}" for s in SETS)
UNIFORMS = tuple(f"Q{s}" for s in SETS)
WINDS = tuple(f"WIND{s}" for s in SETS)

_OPERATION = (
    *(_number(t, f"temperature of set {t}", "temperature", "TREF") for t in TEMPERATURE_SETS),
    *(_number(p, f"pressure of set {p}", "pressure", "0") for p in PRESSURE_SETS),
    _number("TREF", "temperature of installation", "temperature", "20 C"),
)
_RUN = (
    *(_number(d, f"{d[1]} from first to second node", "length", "0") for d in ("DX", "DY", "DZ")),
    _number("LENGTH", "length along DIR", "length", "", POSITIVE),
    Key("DIR", "direction of the run, any length", kind="vector"),
    Key("SECTION", "section from here on", kind="name", default="the current one"),
    Key("MATERIAL", "material from here on", kind="name", default="the current one"),
)
_CUT = (
    _number("CUTSHORT", "cold spring: made too short by this, set CS", "length", "0", POSITIVE),
    _number("CUTLONG", "cold spring: made too long by this, set CS", "length", "0", POSITIVE),
)
_OFFSETS = (
    Key("OFFSET1", "rigid arm from the first node to the pipe's end", "", "lengths", "none"),
    Key("OFFSET2", "rigid arm from the second node to the pipe's end", "", "lengths", "none"),
)
_TWO = (_node("a", "first node"), _node("b", "second node"))
_BODY = (
    *_RUN,
    _number("WEIGHT", "total weight of the body", "force", "0", NOT_NEGATIVE),
    *_OPERATION,
)
_BODY_NOTE = (
    "Ten times the wall of the current SECTION at the same inside diameter. It weighs WEIGHT, its "
    "contents, and 1.75 times the insulation of the pipe; without WEIGHT it weighs nothing."
)
_CNODE = Key(
    "CNODE", "node that carries the support", kind="node", default="ground", card_wide=True
)
_NAME = Key("NAME", "name of the support in reports", kind="text", card_wide=True)
_K = "stiffness of translations"
_AXIS = Key("AXIS", "direction of the spring's own x", kind="vector", default="global axes")
_SPRINGS = (
    *(_number(f"K{a}", f"stiffness along {a}", "stiffness", "0", NOT_NEGATIVE) for a in "XYZ"),
    *(
        _number(f"KR{a}", f"stiffness about {a}", "rotational stiffness", "0", NOT_NEGATIVE)
        for a in "XYZ"
    ),
)

TABLE: tuple[Keyword, ...] = (
    Keyword(
        "TITLE",
        "Title of the model: the rest of the card.",
        form="text",
        example="TITLE Hot oil header",
    ),
    Keyword(
        "UNITS",
        "Units of all plain numbers of the deck; the first card but TITLE.",
        form="units",
        notes=("Without this card: m N Pa C.",),
        example="UNITS mm kN bar C",
    ),
    Keyword(
        "INCLUDE",
        "Reads the cards of another file in this place.",
        form="text",
        notes=("The path counts from the file that names it. A file may not include itself.",),
        example="INCLUDE materials.inp",
    ),
    Keyword(
        "DEFAULT",
        "Choices for the whole model, wherever the card stands.",
        keys=(
            _number(
                "MU",
                "friction of every resting and directional support that states none",
                "number",
                "0",
                FRICTION,
            ),
            _number("K", "stiffness k_p of rigid supports", "stiffness", "1e12 N/m", POSITIVE),
            _number(
                "KR",
                "stiffness of rigid rotational supports",
                "rotational stiffness",
                "1e12 N.m/rad",
                POSITIVE,
            ),
            _number("KF", "elastic stick stiffness k_f", "stiffness", "1e8 N/m", POSITIVE),
            _choice("SHEAR", "shear flexibility (Timoshenko, shear area A/2)", ON_OFF, "ON"),
            _choice("UP", "axis against gravity", ("Y", "Z"), "Y"),
            _number("G", "acceleration of gravity", "gravity", "9.80665 m/s2", POSITIVE),
            _choice(
                "STIFFEN", "pressure that stiffens bends", ("OFF", "MAX", *PRESSURE_SETS), "OFF"
            ),
            _choice(
                "BOURDON",
                "pressure elongates pipe; and opens bends",
                ("OFF", "ELONGATION", "OPENING"),
                "OFF",
            ),
            _choice("FRICTION", "one slider a contact, or one a card", FRICTIONS, "CONTACT"),
            _choice("ITERATION", "iteration of nonlinear cases", ITERATIONS, "NEWTON"),
            _choice(
                "EVENTS", "split a step where a gapped contact with friction closes", ON_OFF, "OFF"
            ),
        ),
        example="DEFAULT MU=0.3",
    ),
    Keyword(
        "MATERIAL",
        "A material, current for the pipes that follow.",
        (Positional("name", "name", "name of the material"),),
        (
            Key("GRADE", "row of the library of materials", kind="text"),
            _number("E", "modulus of elasticity", "modulus", "of the GRADE", POSITIVE),
            _number("NU", "Poisson's ratio", "number", "0.3", bounds=Bounds(0.0, 0.5)),
            _number("ALPHA", "coefficient of thermal expansion", "expansion", "0, or of the GRADE"),
            _number("DENSITY", "density", "density", "0, or of the GRADE", NOT_NEGATIVE),
            _number(
                "TREF",
                "temperature from which mean ALPHA of PROPERTY cards count",
                "temperature",
                "20 C",
            ),
        ),
        notes=(
            "MATERIAL with the name of an earlier card and no key makes that one current again.",
        ),
        example="MATERIAL A106B E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850",
    ),
    Keyword(
        "PROPERTY",
        "Properties of a material at one temperature; the points make a table.",
        (Positional("name", "name", "name of an earlier MATERIAL"),),
        (
            _number("T", "temperature of the point", "temperature", required=True),
            _number("E", "modulus of elasticity at T", "modulus", "", POSITIVE),
            _number("ALPHA", "mean coefficient of expansion from TREF to T", "expansion"),
        ),
        example="PROPERTY A106B T=200 E=191GPa ALPHA=12.2e-6",
    ),
    Keyword(
        "SECTION",
        "A pipe cross section, current for the pipes that follow.",
        (Positional("name", "name", "name of the section"),),
        (
            _number("OD", "outside diameter", "length", "", POSITIVE),
            _number("WALL", "wall thickness", "length", "", POSITIVE),
            Key("NPS", "nominal size in inches, with SCH", kind="text"),
            Key("DN", "nominal diameter in mm, with SCH", kind="text"),
            Key("SCH", "schedule of the wall: 40, STD, XS, 10S", kind="text"),
            _number("FLUID", "density of the contents", "density", "0", NOT_NEGATIVE),
            _number("LINING", "thickness of the lining inside", "length", "0", NOT_NEGATIVE),
            _number("LINING_DENSITY", "density of the lining", "density", "0", NOT_NEGATIVE),
            _number("INSULATION", "thickness of the insulation", "length", "0", NOT_NEGATIVE),
            _number(
                "INSULATION_DENSITY", "density of the insulation", "density", "0", NOT_NEGATIVE
            ),
            _number("WEIGHT", "further weight per length", "line load", "0", NOT_NEGATIVE),
            _number(
                "CORROSION",
                "corrosion allowance, for code checks only",
                "length",
                "0",
                NOT_NEGATIVE,
            ),
        ),
        notes=(
            "Either OD and WALL, or NPS (or DN) and SCH.",
            "SECTION with the name of an earlier card and no key makes that section current again.",
        ),
        example="SECTION HDR NPS=10 SCH=40 FLUID=850",
    ),
    Keyword(
        "OPERATE",
        "Temperatures and pressures of the pipes that follow, until changed.",
        keys=_OPERATION,
        example="OPERATE T1=170 P1=12 TREF=20",
    ),
    Keyword(
        "NODE",
        "Coordinates of a node. Without any, the first pipe starts at the origin.",
        (_node("node"),),
        tuple(_number(a, f"coordinate {a}", "length", "0") for a in "XYZ"),
        example="NODE 10 X=0 Y=2500 Z=0",
    ),
    Keyword(
        "PIPE",
        "A straight pipe; at a bend it runs to the intersection of the tangents.",
        (_node("a", "first node"), _node("b", "second node")),
        (*_RUN, *_CUT, *_OFFSETS, *_OPERATION),
        notes=(
            "DX DY DZ, or LENGTH and DIR; with none of them both ends must have coordinates.",
            "SECTION, MATERIAL and the keys of OPERATE hold for the pipes that follow, too.",
            "With OFFSET1 or OFFSET2 the pipe starts or ends off its node, as a branch does at the "
            "wall of its header; DX DY DZ lead from node to node. The arm has 1e12 N/m (DEFAULT K, "
            "KR) at its middle and no weight.",
            "CUTSHORT and CUTLONG are cold spring: the pipe is made that much shorter or longer "
            "than the drawing says and pulled into place. Set CS of a CASE makes it act.",
        ),
        example="PIPE 10 20 DX=6000",
    ),
    Keyword(
        "RIGID",
        "A stiff body between two nodes with its own weight.",
        _TWO,
        _BODY,
        notes=(_BODY_NOTE,),
        example="RIGID 40 50 DX=450 WEIGHT=2.1",
    ),
    Keyword(
        "VALVE",
        "A valve: a stiff body between two nodes with its own weight.",
        _TWO,
        _BODY,
        notes=("The same as RIGID, but for its name in reports.",),
        example="VALVE 40 50 DX=450 WEIGHT=2.1",
    ),
    Keyword(
        "FLANGE",
        "A flange or a pair of them: a stiff body between two nodes with its own weight.",
        _TWO,
        _BODY,
        notes=("The same as RIGID, but for its name in reports.",),
        example="FLANGE 50 55 DX=105 WEIGHT=0.4",
    ),
    Keyword(
        "REDUCER",
        "A reducer from the current SECTION to another, which is current from then on.",
        _TWO,
        (
            Key(
                "TO",
                "section at the second node, of an earlier SECTION",
                kind="name",
                required=True,
            ),
            *_RUN,
            Key(
                "AXIS",
                "direction of the pipes' axis, of an eccentric one",
                kind="vector",
                default="along the run: concentric",
            ),
            _choice("FLAT", "eccentric, level above or below", ("UP", "DOWN")),
            *_OPERATION,
        ),
        notes=(
            "DX DY DZ lead from centre to centre. With FLAT they lead along the axis, which is "
            "horizontal, and the centre of the second node comes to lie half the difference of "
            "the outside diameters lower (FLAT=DOWN, level below, from the larger to the smaller) "
            "or higher (FLAT=UP).",
            "All diameters change linearly from end to end. The stiffness is the exact integral "
            "of that, weights too; wind takes the mean width.",
        ),
        example="REDUCER 55 56 DX=178 TO=S6 FLAT=DOWN",
    ),
    Keyword(
        "JOINT",
        "An expansion joint: rates at the middle of its length, and pressure thrust.",
        _TWO,
        (
            *_RUN,
            _number("AXIAL", "axial rate", "stiffness", "", NOT_NEGATIVE, required=True),
            _number(
                "LATERAL",
                "lateral rate, ends kept parallel",
                "stiffness",
                "12 BENDING/L2; without length DEFAULT K",
                NOT_NEGATIVE,
            ),
            _number(
                "BENDING",
                "moment for a relative rotation of the ends",
                "rotational stiffness",
                "LATERAL L2/12; without length DEFAULT KR",
                NOT_NEGATIVE,
            ),
            _number(
                "TORSION", "torsional rate", "rotational stiffness", "DEFAULT KR", NOT_NEGATIVE
            ),
            _number("AREA", "effective area of the pressure thrust", "area", "0", NOT_NEGATIVE),
            Key("AXIS", "direction of the joint", kind="vector", default="along the run"),
            _number("WEIGHT", "total weight without contents", "force", "0", NOT_NEGATIVE),
            *_OPERATION,
        ),
        notes=(
            "Without DX DY DZ it has no length, and AXIS says its direction. A joint with a length "
            "grows with the temperature as its MATERIAL does.",
            "Pressure Pn of a case pushes both ends apart with Pn times AREA; tie rods and hinges "
            "that carry it are RIGID and SPRING cards beside the joint.",
            "Half of the weight and of the contents stands at each end.",
        ),
        example="JOINT 56 57 DX=300 AXIAL=180N/mm LATERAL=95N/mm AREA=62000mm2",
    ),
    Keyword(
        "UNIFORM",
        "Uniform load of set Qn on the pipes that follow, until changed; 0 ends it.",
        (Positional("set", "set", "Q1 to Q9", UNIFORMS),),
        (
            *(_number(a, f"load per length along {a}", "line load", "0") for a in "XYZ"),
            *(
                _number(f"G{a}", f"part of the weight W along {a}, in g", "in g", "0")
                for a in "XYZ"
            ),
        ),
        notes=("Per length of the pipe's axis. X Y Z, or GX GY GZ; not both in one set.",),
        example="UNIFORM Q1 Y=-0.5",
    ),
    Keyword(
        "BEND",
        "A bend where two pipes meet; gives the points 30N 30M 30F, and 30 is 30F.",
        (
            _node("node", "node at the intersection of the tangents"),
            Positional("size", "choice", "1.5 or 1.0 nominal diameters", ("LONG", "SHORT"), True),
        ),
        (
            _number("R", "radius of the centre line", "length", "LONG", POSITIVE),
            _number("K", "flexibility factor", "number", "1.65/h", bounds=Bounds(1.0)),
            Key("FLANGES", "ends with a flange", kind="integer", default="0", bounds=Bounds(0, 2)),
        ),
        example="BEND 30 R=381",
    ),
    Keyword(
        "SPRING",
        "Six stiffnesses between two nodes, or from one node to ground.",
        (_node("a"), Positional("b", "node", "second node", optional=True)),
        (*_SPRINGS, _AXIS),
        notes=("A node that only springs reach stands where their other node stands.",),
        example="SPRING 70 71 KX=5 KY=5 KZ=5",
    ),
    Keyword(
        "MASS",
        "A concentrated mass.",
        (_node("node"),),
        (
            _number("M", "mass", "mass", "", POSITIVE),
            _number("W", "weight, instead of M", "force", "", POSITIVE),
        ),
        example="MASS 25 M=120",
    ),
    Keyword(
        "ANCHOR",
        "Holds all six freedoms of a node.",
        (_node("node"),),
        (
            _number("K", _K, "stiffness", "DEFAULT K", POSITIVE),
            _number("KR", "stiffness of rotations", "rotational stiffness", "DEFAULT KR", POSITIVE),
            _CNODE,
            _NAME,
        ),
        example="ANCHOR 10",
    ),
    Keyword(
        "SUPPORT",
        "A restraint with one contact for each direction word.",
        (_node("node"), Positional("directions", "words", "direction words, each with its keys")),
        (
            Key("GAP", "clearance to both sides, or minus,plus", "", kind="gap", default="0"),
            _number("K", "stiffness", "", "DEFAULT K or KR", POSITIVE),
            _number("KF", "elastic stick stiffness", "stiffness", "DEFAULT KF", POSITIVE),
            _number("MU", "coefficient of friction", "number", "DEFAULT MU", FRICTION),
            Key("ALONG", "pipe whose axis GUIDE and LIMIT follow: 30-40", kind="along"),
            Key(
                "FRICTION",
                "one slider a contact, or one a card",
                kind="choice",
                choices=FRICTIONS,
                default="DEFAULT FRICTION",
                card_wide=True,
            ),
            _CNODE,
            _NAME,
        ),
        form="directions",
        notes=(
            "Direction words: X Y Z hold both ways; +Y lets the pipe move up and stops it going "
            "down, -Y the other way; RX RY RZ +RX ... hold rotations; GUIDE holds the pipe "
            "sideways, LIMIT along its axis; (a,b,c) +(a,b,c) -(a,b,c) are skewed.",
            "A key binds to the direction word on its left; before the first word it is common "
            "to all of them. CNODE, FRICTION and NAME hold for the card wherever they stand.",
        ),
        example="SUPPORT 20 +Y GUIDE GAP=3",
    ),
    Keyword(
        "HANGER",
        "A spring hanger: vertical rate and cold load, or one that the program selects.",
        (
            _node("node"),
            Positional("design", "choice", "DESIGN: select it", ("DESIGN",), optional=True),
        ),
        (
            _number("RATE", "spring rate, 0 for constant effort", "stiffness", "0", NOT_NEGATIVE),
            _number("LOAD", "cold load, upward on the pipe", "force", "an error", NOT_NEGATIVE),
            _number(
                "VARIATION", "most change of load, of the hot load", "number", "0.25", POSITIVE
            ),
            _number("ROD", "rigid rod up to this travel", "length", "2.5 mm", NOT_NEGATIVE),
            _number("MAXTRAVEL", "constant support above this travel", "length", "none", POSITIVE),
            Key("NUMBER", "springs", kind="integer", default="1", bounds=Bounds(1, 100)),
            _choice("METHOD", "when the weight is balanced", ("HOT", "COLD"), "HOT"),
            Key("SERIES", "series of the table", kind="name", default="all, in their order"),
            Key(
                "OPERATING",
                "case that gives the travel",
                kind="name",
                default="the first CASE with weight, and temperature or movement",
            ),
            _choice("TABLE", "springs where no SPRINGSIZE is", ("GENERIC", "ANVIL"), "GENERIC"),
            Key(
                "FREE",
                "node whose anchor is free vertically while the weight is balanced",
                kind="node",
                default="none",
            ),
            Key("FREE2", "another such node", kind="node", default="none"),
            _CNODE,
            _NAME,
        ),
        notes=(
            "RATE and LOAD, or DESIGN with VARIATION to OPERATING.",
            "DESIGN: W on rigid hangers gives the hot load; the operating case with the hot loads "
            "as constant forces gives the travel. The first size, by series and load, that "
            "carries hot and cold load and whose load changes by at most VARIATION is taken; a "
            "rigid rod up to ROD, a constant support where no spring fits. It then acts in all "
            "cases: write H in those with weight.",
        ),
        example="HANGER 45 RATE=50N/mm LOAD=6.2",
    ),
    Keyword(
        "SPRINGSIZE",
        "One size of the table of springs for HANGER DESIGN; any such card replaces the "
        "generic table.",
        (Positional("name", "name", "name of the size"),),
        (
            Key("SERIES", "series, in the order in which they come", kind="name", required=True),
            _number("MIN", "least working load", "force", "", NOT_NEGATIVE, required=True),
            _number("MAX", "largest working load", "force", "", POSITIVE, required=True),
            _number("RATE", "spring rate", "stiffness", "", POSITIVE, required=True),
        ),
        notes=(
            "Without these cards TABLE= of the HANGER says where springs come from. GENERIC is "
            "of no maker: series SHORT, MEDIUM and LONG with 32, 63 and 125 mm working travel, "
            "largest loads from 0.4 to 200 kN in preferred numbers (ISO 3, R10), least load half "
            "of the largest. ANVIL has the series 82, B-268, 98, TRIPLE and QUADRUPLE of that "
            "maker.",
        ),
        example="SPRINGSIZE VS-12 SERIES=VS MIN=4.2 MAX=7.5 RATE=55N/mm",
    ),
    Keyword(
        "SNUBBER",
        "Free to move slowly, holds one direction in occasional cases and in modal analysis.",
        (_node("node"), Positional("direction", "direction", "X, Y, Z or (a,b,c)")),
        (_number("K", "stiffness when locked", "stiffness", "DEFAULT K", POSITIVE), _CNODE, _NAME),
        notes=(
            "Cases with ABOUT and the modes hold it both ways, without gap; all other cases do "
            "not see it. SNUBBERS=LOCKED on a CASE card holds it there, too.",
        ),
        example="SNUBBER 40 X",
    ),
    Keyword(
        "FORCE",
        "Force and moment at a node in set Fn; further cards of one set add up.",
        (_node("node"), Positional("set", "set", "F1 to F9", tuple(f"F{s}" for s in SETS))),
        (
            *(_number(f"F{a}", f"force along {a}", "force", "0") for a in "XYZ"),
            *(_number(f"M{a}", f"moment about {a}", "moment", "0") for a in "XYZ"),
        ),
        example="FORCE 60 F1 FY=-5",
    ),
    Keyword(
        "DISPLACEMENT",
        "Imposed displacement at a node in set Dn.",
        (_node("node"), Positional("set", "set", "D1 to D9", tuple(f"D{s}" for s in SETS))),
        (
            *(_number(d, f"displacement along {d[1]}", "length", "free") for d in DEGREES[:3]),
            *(_number(d, f"rotation about {d[1]}", "angle", "free") for d in DEGREES[3:]),
        ),
        notes=(
            "It moves the base of the support at the node; without one it holds the node itself.",
            "A component blank in all sets is free; given in one set, it is held at 0 in cases "
            "that omit the set.",
        ),
        example="DISPLACEMENT 10 D1 DX=4 DY=2",
    ),
    Keyword(
        "ACCELERATION",
        "Uniform acceleration of set Un as a load in g, in the direction given.",
        (Positional("set", "set", "U1 to U9", ACCELERATIONS),),
        tuple(_number(a, f"part along {a}", "in g", "0") for a in "XYZ"),
        example="ACCELERATION U1 X=0.3",
    ),
    Keyword(
        "WIND",
        "Static wind of set WINDn on the projected area of pipe and insulation.",
        (Positional("set", "set", "WIND1 to WIND9", WINDS),),
        (
            Key("DIR", "direction in which the wind blows", kind="vector", required=True),
            Key(
                "PRESSURE",
                "table of (elevation,pressure)",
                "length, wind pressure",
                "pairs",
            ),
            Key("VELOCITY", "table of (elevation,velocity)", "length, speed", "pairs"),
            _number("ASCE7", "basic wind speed of ASCE 7", "speed", "", POSITIVE),
            _choice("EXPOSURE", "exposure of ASCE 7", ("B", "C", "D"), "C"),
            _number("KZT", "topographic factor of ASCE 7", "number", "1", POSITIVE),
            _number("KD", "directionality factor of ASCE 7", "number", "1", POSITIVE),
            _number("GUST", "gust factor of ASCE 7", "number", "0.85", POSITIVE),
            _number(
                "SHAPE", "shape factor (force coefficient) of the pipe", "number", "0.7", POSITIVE
            ),
            _number("GROUND", "vertical coordinate where elevations start", "length", "0"),
        ),
        notes=(
            "One of PRESSURE, VELOCITY and ASCE7. Elevations of a table count from GROUND and "
            "rise; between its points a table is linear in the pressure, beyond its ends constant. "
            "A velocity v gives the pressure v2 1.225 kg/m3 / 2.",
            "Wind acts normal to the pipe: the component of its velocity normal to the pipe makes "
            "the force, which falls with the square of the cosine of the angle between the wind "
            "and that normal.",
            "EXPOSURE, KZT, KD and GUST go with ASCE7.",
        ),
        example="WIND WIND1 DIR=(1,0,0) PRESSURE=(0,450Pa),(10000,600Pa) SHAPE=0.7",
    ),
    Keyword(
        "SNOW",
        "Snow or ice as a vertical load on every length of pipe, set S; further cards add up.",
        (
            Positional(
                "weight",
                "number",
                "weight per length of pipe",
                dimension="line load",
                bounds=POSITIVE,
            ),
        ),
        example="SNOW 0.2",
    ),
    Keyword(
        "SPECTRUM",
        "A response spectrum: accelerations against frequency or period.",
        (Positional("name", "name", "name of the spectrum"),),
        (
            _choice(
                "X", "what the first number of a pair is", ("FREQUENCY", "PERIOD"), "FREQUENCY"
            ),
            _choice("Y", "unit of the second", ("G", "M/S2", "IN/S2"), "G"),
            _choice("INTERP", "between the points", ("LOG", "LINEAR"), "LOG"),
            Key(
                "TABLE", "points (x,y),(x,y) in rising x", "number, number", "pairs", required=True
            ),
        ),
        notes=(
            "Frequencies are in Hz, periods in s. LOG is linear in the logarithms of both; LINEAR "
            "in x as given and y. A long table continues on further lines by &.",
            "G counts in the acceleration of gravity of DEFAULT G.",
        ),
        example="SPECTRUM SSE Y=G TABLE=(0.5,0.1),(2.5,0.6),(9,0.6),(33,0.25)",
    ),
    Keyword(
        "GROUP",
        "Supports that move together in independent support motion.",
        (Positional("name = node, node ...", "list", "labels of the supports' nodes"),),
        form="list",
        example="GROUP NORTH = 10, 20",
    ),
    Keyword(
        "MODES",
        "Natural frequencies and modes about the frozen contact state of a case.",
        (Positional("n", "integer", "number of modes", bounds=Bounds(1, 10000)),),
        (
            _number("FMAX", "highest frequency of interest [Hz]", "number", "none", POSITIVE),
            Key(
                "ABOUT",
                "case whose contact state is frozen",
                kind="name",
                default="supports without gap are closed",
            ),
            _choice("MASS", "mass matrix", ("LUMPED", "CONSISTENT"), "LUMPED"),
            _choice("MESH", "nodes are added where spans are too long", ("AUTO", "NONE"), "AUTO"),
            _choice("ROTARY", "rotary inertia of pipes", ON_OFF, "ON"),
            _number(
                "FRICTION",
                "lateral stiffness of closed supports: factor times mu N, in 1/m",
                "number",
                "0",
                NOT_NEGATIVE,
            ),
        ),
        notes=(
            "Snubbers are locked.",
            "Where the structure moves freely, a deck without cases and cycles has modes alone.",
        ),
        example="MODES 12 ABOUT=OPE FMAX=33",
    ),
    Keyword(
        "CASE",
        "A load case: a sum of load sets, solved; or a response spectrum.",
        (Positional("name = [n*]SET {+|- [n*]SET}", "equation", "sum of load sets"),),
        (
            Key("FROM", "case whose end is the start (history of friction)", kind="name"),
            Key("ABOUT", "case on whose frozen state this is an increment", kind="name"),
            Key("ON", "case on whose frozen state this is a total", kind="name"),
            Key("STEPS", "equal load steps", kind="integer", default="1", bounds=Bounds(1, 100000)),
            _number("MUX", "factor on every coefficient of friction", "number", "1", NOT_NEGATIVE),
            _choice("E", "modulus of the cold or of the hot pipe", ("COLD", "HOT"), "COLD"),
            _choice("EVENTS", "split steps where gapped contacts close", ON_OFF, "DEFAULT EVENTS"),
            _choice("ITERATION", "iteration of this case", ITERATIONS, "DEFAULT ITERATION"),
            _choice(
                "SNUBBERS", "state of snubbers", ("FREE", "LOCKED"), "LOCKED with ABOUT, else FREE"
            ),
            _choice(
                "MODAL", "combination of modes", ("SRSS", "GROUP", "CQC", "ABS", "DSUM"), "SRSS"
            ),
            _choice("SPATIAL", "combination of directions", ("SRSS", "ABS"), "SRSS"),
            _choice("GROUPS", "combination of groups of supports", ("ABS", "SRSS"), "ABS"),
            _choice("FIRST", "what is combined first", ("MODES", "DIRECTIONS"), "MODES"),
            _number(
                "DAMPING", "fraction of critical damping", "number", "0.02", Bounds(0.0, 1.0, True)
            ),
            _number("DURATION", "of the strong motion, for DSUM [s]", "number", "10", POSITIVE),
            _number(
                "ZPA",
                "zero period acceleration, in g",
                "number",
                "the spectrum at its highest frequency",
                POSITIVE,
            ),
            _choice("MISSING", "correction for the missing mass", ON_OFF, "OFF"),
        ),
        form="equation",
        flags=(("NONLINEAR", "with ABOUT: both together are solved nonlinearly, and subtracted"),),
        notes=(
            "Load sets: W weight, WNC weight without contents, WW weight with water, H cold load "
            "of hangers, T1-T9, P1-P9, D1-D9, F1-F9, U1-U9, U(x,y,z) in g, WIND1-WIND9, S snow, "
            "Q1-Q9 uniform loads, CS cold spring. "
            "They are never case names.",
            "CASE with names of cases only is read as COMB.",
            "FROM starts where that case ended. ABOUT is one linear solve on the frozen contact "
            "state of a case, snubbers locked, friction left out: an increment about it. ON is "
            "the same for a total, snubbers free (hot sustained). One of the three, and of a CASE "
            "that has a contact state of its own: no COMB, and no case with ABOUT or ON.",
            "A case with ABOUT or ON has the modulus of that case; E=HOT takes the hot one. "
            "SNUBBERS=LOCKED after FROM locks snubbers where that case left the pipe.",
            "U and WIND are for cases with ABOUT; without it SNUBBERS=FREE or LOCKED must say "
            "what snubbers do.",
            "A response spectrum case is a sum of SPECTRUM(name,X[,factor[,group]]) for the "
            "directions X, Y, Z; it needs a MODES card. MODAL to MISSING belong to it. A group "
            "(GROUP card) makes it independent support motion.",
            "Groups that move in one direction combine first, mode by mode. Then the modes of each "
            "direction combine (GROUP, DSUM: US NRC Regulatory Guide 1.92 revision 1; CQC: Der "
            "Kiureghian), and then the directions; FIRST=DIRECTIONS combines the directions of "
            "each mode and then the modes, whose signs are lost (it matters for GROUP, CQC, DSUM). "
            "MISSING=ON adds the static response of the mass that the modes leave out, as one more "
            "mode apart from all others, at ZPA times the factor.",
            "A deck without CASE and COMB cards takes default cases. SUS = W + P + F1 with the "
            "first set of pressures, and H where hangers are; OPE = W + P1 + T1 + D1 + F1 for each "
            "set of temperatures, pressures and displacements, OPE1, OPE2 ... when there are "
            "several; EXP = OPE - SUS. U1-U9, WIND1-WIND9, S and F2-F9 are occasional loads: each "
            "is a linear case ABOUT the first OPE, BY_U1, BY_WIND1 ..., and "
            "OCC = ABS(SUS) + MAX(BY_U1, BY_WIND1 ...) takes them one at a time.",
        ),
        example="CASE OPE = W + P1 + T1",
    ),
    Keyword(
        "COMB",
        "A combination of the results of cases.",
        (Positional("name = expression", "equation", "expression of names of cases"),),
        form="equation",
        notes=(
            "An expression has + - n* ( ) and functions, nested at will. Every displacement, "
            "support load and end force is combined on its own, component by component:",
            "- `ABS(a)`: size without sign.\n"
            "- `SRSS(a,b,...)`: root of the sum of squares.\n"
            "- `MAX(a,b,...)`, `MIN(a,b,...)`: largest, smallest size, without sign.\n"
            "- `SIGNMAX(a,b,...)`: the one of largest size with its sign; + when two are equal.\n"
            "- `SCALAR(a,b,...)`: the sum with signs, as a + b. In the trade it differs from the "
            "algebraic sum in stresses only.",
            "A response spectrum case has no signs; every number of it is a size.",
        ),
        example="COMB EXP = OPE - SUS",
    ),
    Keyword(
        "CYCLE",
        "Follows cases one after another, friction and all, until the loop repeats.",
        (Positional("name = case, case ...", "list", "cases in the order in which they come"),),
        (
            Key(
                "TIMES",
                "most loops to follow",
                kind="integer",
                bounds=Bounds(1, 1000),
                required=True,
            ),
            Key(
                "FROM", "case whose end is the start", kind="name", default="at rest, without load"
            ),
        ),
        form="list",
        example="CYCLE HEAT = OPE, SUS TIMES=4",
    ),
)

KEYWORDS: dict[str, Keyword] = {keyword.name: keyword for keyword in TABLE}
