"""What a user describes: frozen records of one piping system, in SI, with labels and no arrays.

Every length is in m, force in N, mass in kg, temperature in degrees Celsius (differences in K),
stress and pressure in Pa.  `Place` says which line of which deck a record came from.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from trunnion.frozen import frozen
from trunnion.origin import InputFile, Origin

Label = str | int
Points = Sequence[Sequence[float]]
Value = float | str | Sequence[float] | None
Word = str | Sequence[float] | tuple[str | Sequence[float], Mapping[str, Value]]

SETS = tuple("123456789")
INFINITE = float("inf")


@frozen
class Place:
    """Where a record was written: deck file and line, or the call of the Python API."""

    file: str = "<python>"
    line: int = 0

    def __str__(self) -> str:
        return f"{self.file}:{self.line}"


@frozen
class Settings:
    """Choices that hold for the whole model (the DEFAULT card)."""

    mu: float = 0.0
    k: float = 1e12  # translational penalty k_p [N/m]
    kr: float = 1e12  # rotational penalty [N m/rad]
    kf: float = 1e8  # elastic stick stiffness k_f [N/m]
    shear: bool = True
    up: str = "Y"
    g: float = 9.80665
    stiffen: str = "OFF"  # pressure of the bend stiffening: OFF, MAX, P1 ... P9
    bourdon: str = "OFF"  # OFF, ELONGATION (closed-end strain), OPENING (and bends open)
    friction: str = "CONTACT"  # or RESULTANT
    iteration: str = "NEWTON"  # or STATUS
    events: bool = False


@frozen
class TablePoint:
    """Properties of a material at one temperature; None where the table is silent."""

    t: float
    e: float | None = None
    alpha: float | None = None  # mean coefficient from TREF of the table to t [1/K]


@frozen
class Material:
    """Elastic constants, density and expansion; `table` is sorted by temperature."""

    name: str
    e: float
    nu: float = 0.3
    alpha: float = 0.0
    density: float = 0.0
    grade: str | None = None  # row of the library of materials it was taken from
    table: tuple[TablePoint, ...] = ()
    table_tref: float = 20.0  # the temperature from which the table's mean alpha counts
    place: Place = field(default=Place(), compare=False)


@frozen
class Section:
    """Pipe cross section with its contents and coverings; thicknesses in m, densities kg/m3."""

    name: str
    od: float
    wall: float
    fluid: float = 0.0
    lining: float = 0.0
    lining_density: float = 0.0
    insulation: float = 0.0
    insulation_density: float = 0.0
    weight: float = 0.0  # extra uniform weight [N/m], part of W and WNC and WW
    corrosion: float = 0.0  # kept for code checks; not used for stiffness
    nps: str | None = None
    dn: str | None = None
    schedule: str | None = None
    place: Place = field(default=Place(), compare=False)


@frozen
class Operation:
    """Temperatures and pressures by set number ("1" ... "9"), carried over until changed."""

    t: Mapping[str, float] = field(default_factory=dict)
    p: Mapping[str, float] = field(default_factory=dict)
    tref: float = 20.0


@frozen
class Node:
    """A node whose coordinates the user gave."""

    label: str
    xyz: tuple[float, float, float]
    place: Place = field(default=Place(), compare=False)


@frozen
class Reducer:
    """What makes a pipe a reducer: the section at its second end.

    `axis` is the direction of the pipes' axis where the run is inclined to it (eccentric); None:
    along the run (concentric).
    """

    section: str
    axis: tuple[float, float, float] | None = None


@frozen
class Joint:
    """What makes a pipe an expansion joint: rates of the whole joint, at the middle of its length.

    A None rate is rigid (DEFAULT K, KR); the lateral or bending rate of a joint with a length
    follows from the other one.  `axis` is needed where the joint has no length.
    """

    axial: float  # [N/m]
    lateral: float | None = None  # ends kept parallel [N/m]
    bending: float | None = None  # moment for a relative rotation of the ends [N m/rad]
    torsion: float | None = None  # [N m/rad]
    area: float = 0.0  # effective area of the pressure thrust [m2]
    axis: tuple[float, float, float] | None = None


@frozen
class Uniform:
    """Uniform load of set Q1 to Q9 on a length of pipe: N/m, or in g on the weight W."""

    set: str
    load: tuple[float, float, float]
    in_g: bool = False


@frozen
class Pipe:
    """A straight run between two labels; `rigid` is a stiff body with its own weight.

    `delta` runs between tangent intersections where a bend stands at an end; None when both
    ends have coordinates already.
    """

    start: str
    end: str
    delta: tuple[float, float, float] | None
    section: str
    material: str
    operation: Operation = Operation()
    rigid: bool = False
    weight: float = 0.0  # of the rigid body or the expansion joint, all of it [N]
    place: Place = field(default=Place(), compare=False)
    body: str = ""  # what a rigid is: VALVE, FLANGE; "" is RIGID
    reducer: Reducer | None = None
    joint: Joint | None = None
    cut: float = 0.0  # cold spring: cut short by this length (long: < 0), in set CS [m]
    uniform: tuple[Uniform, ...] = ()
    offsets: tuple[tuple[float, float, float] | None, ...] = (None, None)  # node to pipe [m]

    @property
    def card(self) -> str:
        """Keyword of its card."""
        if self.rigid:
            return self.body or "RIGID"
        return "REDUCER" if self.reducer else "JOINT" if self.joint else "PIPE"


@frozen
class Bend:
    """A bend at the tangent intersection `node`; radius None: `diameters` nominal diameters."""

    node: str
    radius: float | None = None
    diameters: float = 1.5  # LONG 1.5, SHORT 1.0
    k: float | None = None  # flexibility factor; None: 1.65/h
    flanges: int = 0
    place: Place = field(default=Place(), compare=False)


@frozen
class Spring:
    """A two-node spring: stiffness kx ky kz [N/m], krx kry krz [N m/rad] in its own axes."""

    start: str
    end: str
    k: tuple[float, float, float, float, float, float]
    axis: tuple[float, float, float] | None = None  # direction of the local x; None: global axes
    place: Place = field(default=Place(), compare=False)


@frozen
class Mass:
    """A concentrated mass [kg] at a node."""

    node: str
    mass: float
    place: Place = field(default=Place(), compare=False)


@frozen
class Direction:
    """One direction word of a support with its keys.

    `word` is X Y Z +X -X ... RX +RX ... GUIDE LIMIT, or "(a,b,c)" "+(a,b,c)" with `vector`.
    A None gap is 0; None for k, kf, mu is the model's default (mu 0 on rotations, anchors).
    """

    word: str
    vector: tuple[float, float, float] | None = None
    gap: tuple[float, float] = (0.0, 0.0)  # minus, plus [m or rad]
    k: float | None = None
    kf: float | None = None
    mu: float | None = None
    along: str | None = None  # the pipe "30-40" that GUIDE and LIMIT follow
    friction: str | None = None  # card-wide: CONTACT or RESULTANT


@frozen
class SpringSize:
    """SPRINGSIZE: one size of the table from which hangers are selected."""

    name: str
    series: str
    least: float  # working loads [N]
    most: float
    rate: float  # [N/m]
    place: Place = field(default=Place(), compare=False)


@frozen
class HangerDesign:
    """What is asked of a hanger that the program selects (HANGER ... DESIGN)."""

    variation: float = 0.25  # most change of load, of the hot load
    rod: float = 0.0025  # a rigid rod where the travel is no more [m]
    most: float | None = None  # a constant support where it is more [m]
    number: int = 1  # springs side by side
    method: str = "HOT"  # the weight is balanced hot, or COLD
    series: str | None = None  # of the table; None: all, in their order
    operating: str | None = None  # case of the travel; None: first with weight and heat
    table: str = "GENERIC"  # of the library, where the model has no sizes of its own; or ANVIL
    free: str | None = None  # nodes that are vertically free while the weight is balanced
    free2: str | None = None

    @property
    def freed(self) -> tuple[str, ...]:
        """Labels of the nodes that are free while the weight is balanced."""
        return tuple(node for node in (self.free, self.free2) if node is not None)


@frozen
class Support:
    """One ANCHOR, SUPPORT, HANGER or one-node SPRING card.

    `kind` is "anchor", "support", "hanger", "spring" or "snubber".  An anchor holds its six
    freedoms with `k` and `kr`; a hanger is vertical with rate `k` and cold load `load`; a spring
    has `ks`; a snubber is free in static cases and holds its directions with `k` when locked.
    """

    node: str
    kind: str
    directions: tuple[Direction, ...] = ()
    cnode: str | None = None
    name: str | None = None
    k: float | None = None
    kr: float | None = None
    load: float = 0.0  # cold load of a hanger, upward on the pipe [N]
    ks: tuple[float, float, float, float, float, float] | None = None
    axis: tuple[float, float, float] | None = None  # local x of a spring's ks
    place: Place = field(default=Place(), compare=False)
    design: HangerDesign | None = None  # of a hanger that the program selects


@frozen
class Displacement:
    """Imposed displacement set Dn at a node; None components are not given (free).

    Where a support or anchor stands at the node it moves that support's base; where none
    stands it holds the node itself in the given components.
    """

    node: str
    set: str  # "1" ... "9"
    d: tuple[float | None, ...]  # six components [m, rad]
    place: Place = field(default=Place(), compare=False)


@frozen
class Force:
    """Nodal force and moment of set Fn."""

    node: str
    set: str
    f: tuple[float, float, float, float, float, float]
    place: Place = field(default=Place(), compare=False)


@frozen
class Acceleration:
    """Uniform acceleration of set Un, in g, as a load in the direction given."""

    set: str
    a: tuple[float, float, float]
    place: Place = field(default=Place(), compare=False)


@frozen
class Term:
    """One load set of a case with its factor: W WNC WW H T1 P1 D1 F1 U1, or U with `vector`."""

    factor: float
    name: str
    vector: tuple[float, float, float] | None = None


@frozen
class Case:
    """A load case: a sum of load sets, solved."""

    name: str
    terms: tuple[Term, ...]
    start: str | None = None  # FROM=
    steps: int = 1
    mux: float = 1.0
    hot: bool = False  # E=HOT
    events: bool | None = None
    iteration: str | None = None
    snubbers: str | None = None  # SNUBBERS=FREE or LOCKED
    place: Place = field(default=Place(), compare=False)
    about: str | None = None  # ABOUT=: linear increment on that case's frozen state
    on: str | None = None  # ON=: linear total on that case's frozen state, snubbers free
    nonlinear: bool = False  # with ABOUT: solve both together nonlinearly and subtract
    spectrum: "SpectrumUse | None" = None  # a response spectrum case (SPECTRA= on the card)


# An expression of case names: ("case", name) ("num", x) ("+", a, b) ("-", a, b) ("*", n, a)
# ("neg", a) ("abs", a) and, of any number of operands, ("srss", a, ...) ("max", a, ...)
# ("min", a, ...) ("signmax", a, ...) ("scalar", a, ...)
Expression = tuple[object, ...]


@frozen
class Comb:
    """A combination of the results of cases."""

    name: str
    expression: Expression
    text: str
    place: Place = field(default=Place(), compare=False)


@frozen
class Cycle:
    """CYCLE: follow cases one after another, datums committed, until the loop repeats."""

    name: str
    cases: tuple[str, ...]
    times: int
    start: str | None = None  # FROM=
    place: Place = field(default=Place(), compare=False)


@frozen
class Modes:
    """MODES: natural frequencies about the frozen contact state of a case."""

    n: int
    fmax: float | None = None  # [Hz]
    about: str | None = None  # None: nothing is closed but what rests at zero gap
    mass: str = "LUMPED"  # or CONSISTENT
    mesh: str = "AUTO"  # or NONE
    rotary: bool = True
    friction: float = 0.0  # lateral stiffness of pressing supports: factor times mu N [1/m]
    place: Place = field(default=Place(), compare=False)


@frozen
class Spectrum:
    """SPECTRUM: accelerations [m/s2] against frequency [Hz], ascending."""

    name: str
    frequency: tuple[float, ...]
    acceleration: tuple[float, ...]
    log: bool = True  # interpolation: log-log, else linear in frequency
    by_period: bool = False  # linear interpolation runs in period
    place: Place = field(default=Place(), compare=False)


@frozen
class Shock:
    """One direction of a response spectrum case: spectrum, global direction, factor, group.

    `nodes` is empty for uniform motion, else the labels of the supports of one group.
    """

    spectrum: str
    direction: str  # X Y Z
    factor: float = 1.0
    group: str | None = None


@frozen
class SpectrumUse:
    """How a response spectrum case combines: modes, directions, groups, missing mass."""

    shocks: tuple[Shock, ...]
    modal: str = "SRSS"  # SRSS GROUP CQC ABS DSUM
    spatial: str = "SRSS"  # or ABS
    groups: str = "ABS"  # or SRSS: independent support motion
    first: str = "MODES"  # what combines first; or DIRECTIONS
    damping: float = 0.02
    duration: float = 10.0  # of the strong motion, for the double sum [s]
    missing_mass: bool = False
    zpa: float | None = None  # [m/s2]; None: the spectrum at its highest frequency


@frozen
class Group:
    """GROUP: supports that move together in independent support motion."""

    name: str
    nodes: tuple[str, ...]
    place: Place = field(default=Place(), compare=False)


@frozen
class Wind:
    """WIND set: pressure [Pa] against elevation [m], or ASCE 7-16, with attack direction.

    `direction` is where the wind blows to, of any length.  `table` holds (elevation, pressure)
    from velocities or pressures, elevations above `ground` and ascending; empty for ASCE 7.
    kzt, kd and gust belong to ASCE 7 alone, shape to both.
    """

    set: str
    direction: tuple[float, float, float]
    table: tuple[tuple[float, float], ...] = ()
    speed: float | None = None  # ASCE 7 basic wind speed [m/s]
    exposure: str = "C"
    kzt: float = 1.0
    kd: float = 1.0  # round sections in 7-16; 0.95 before
    gust: float = 0.85
    shape: float = 0.7  # force coefficient of the pipe
    ground: float = 0.0  # coordinate of the ground along the vertical axis [m]
    place: Place = field(default=Place(), compare=False)


@frozen
class Snow:
    """SNOW: vertical load of snow or ice on every length of pipe [N/m], set S; cards add up."""

    weight: float
    place: Place = field(default=Place(), compare=False)


@frozen
class Units:
    """The deck's own units, for echo and the text report; names as on the UNITS card."""

    length: str = "m"
    force: str = "N"
    pressure: str = "Pa"
    temperature: str = "C"


@dataclass(slots=True)
class Model:
    """A piping system: everything a deck can say, in the deck's order."""

    title: str = ""
    units: Units = field(default_factory=Units)
    settings: Settings = field(default_factory=Settings)
    materials: dict[str, Material] = field(default_factory=dict)
    sections: dict[str, Section] = field(default_factory=dict)
    nodes: list[Node] = field(default_factory=list)
    pipes: list[Pipe] = field(default_factory=list)
    bends: list[Bend] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)
    masses: list[Mass] = field(default_factory=list)
    supports: list[Support] = field(default_factory=list)
    displacements: list[Displacement] = field(default_factory=list)
    forces: list[Force] = field(default_factory=list)
    accelerations: list[Acceleration] = field(default_factory=list)
    winds: list[Wind] = field(default_factory=list)
    snows: list[Snow] = field(default_factory=list)
    spring_sizes: list[SpringSize] = field(default_factory=list)
    spectra: dict[str, Spectrum] = field(default_factory=dict)
    groups: list[Group] = field(default_factory=list)
    modal: Modes | None = None  # what the MODES card asks for
    cases: list[Case | Comb] = field(default_factory=list)
    cycles: list[Cycle] = field(default_factory=list)
    # what cards leave behind for the cards that follow (deck.interpreter.Carried)
    carried: Any = field(default=None, compare=False, repr=False)
    # the foreign file that it was made from, and what is missing; None for a deck
    origin: Origin | None = field(default=None, compare=False)
    # the file that it was read from; None for a model made in Python or of a text
    file: InputFile | None = field(default=None, compare=False, repr=False)

    def default(self, **keys: Value) -> None:
        """Choose for the whole model: MU= K= KR= KF= SHEAR= UP= G= STIFFEN= BOURDON= ..."""
        self._add("DEFAULT", (), keys)

    def material(self, name: str, **keys: Value) -> None:
        """Define a material (E= NU= ALPHA= DENSITY= or GRADE=) and make it current."""
        self._add("MATERIAL", (name,), keys)

    def property(self, name: str, **keys: Value) -> None:
        """Add a point T= with E= or ALPHA= to the table of a material."""
        self._add("PROPERTY", (name,), keys)

    def section(self, name: str, **keys: Value) -> None:
        """Define a section (OD= WALL= or NPS= SCH= ...) and make it current."""
        self._add("SECTION", (name,), keys)

    def operate(self, **keys: Value) -> None:
        """Set T1= ... P1= ... TREF= for the pipes that follow."""
        self._add("OPERATE", (), keys)

    def node(self, label: Label, **keys: Value) -> None:
        """Give a node coordinates X= Y= Z=."""
        self._add("NODE", (label,), keys)

    def pipe(self, start: Label, end: Label, **keys: Value) -> None:
        """Add a pipe: DX= DY= DZ=, or LENGTH= and DIR=."""
        self._add("PIPE", (start, end), keys)

    def rigid(self, start: Label, end: Label, **keys: Value) -> None:
        """Add a stiff body with its own WEIGHT=."""
        self._add("RIGID", (start, end), keys)

    def valve(self, start: Label, end: Label, **keys: Value) -> None:
        """Add a valve, a stiff body with its own WEIGHT=."""
        self._add("VALVE", (start, end), keys)

    def flange(self, start: Label, end: Label, **keys: Value) -> None:
        """Add a flange or a pair of them, a stiff body with its own WEIGHT=."""
        self._add("FLANGE", (start, end), keys)

    def reducer(self, start: Label, end: Label, **keys: Value) -> None:
        """Add a reducer to the section TO=; AXIS= or FLAT= makes it eccentric."""
        self._add("REDUCER", (start, end), keys)

    def joint(self, start: Label, end: Label, **keys: Value) -> None:
        """Add an expansion joint: AXIAL= LATERAL= BENDING= TORSION= AREA= WEIGHT=."""
        self._add("JOINT", (start, end), keys)

    def uniform(self, set: str, **keys: Value) -> None:
        """Put a uniform load of set Q1 to Q9 on the pipes that follow: X= Y= Z=, or GX= GY= GZ=."""
        self._add("UNIFORM", (set,), keys)

    def bend(self, node: Label, *size: str, **keys: Value) -> None:
        """Put a bend where two pipes meet: R=, or "LONG" or "SHORT"."""
        self._add("BEND", (node, *size), keys)

    def spring(self, *nodes: Label, **keys: Value) -> None:
        """Add a spring between two nodes, or from one to ground: KX= ... KRZ= AXIS=."""
        self._add("SPRING", nodes, keys)

    def mass(self, node: Label, **keys: Value) -> None:
        """Add a concentrated mass M= (or weight W=)."""
        self._add("MASS", (node,), keys)

    def anchor(self, node: Label, **keys: Value) -> None:
        """Hold all six freedoms of a node."""
        self._add("ANCHOR", (node,), keys)

    def support(self, node: Label, *directions: Word, **keys: Value) -> None:
        """Add a restraint: "+Y", ("GUIDE", {"GAP": 0.003}), (0.6, 0.8, 0.0); keys are common."""
        self._add("SUPPORT", (node, *directions), keys)

    def hanger(self, node: Label, *design: str, **keys: Value) -> None:
        """Add a spring hanger: RATE= LOAD=, or "DESIGN" to have it selected."""
        self._add("HANGER", (node, *design), keys)

    def springsize(self, name: str, **keys: Value) -> None:
        """Add a size to the table of springs: SERIES= MIN= MAX= RATE=."""
        self._add("SPRINGSIZE", (name,), keys)

    def snubber(self, node: Label, direction: str | Sequence[float], **keys: Value) -> None:
        """Hold X, Y, Z or (a,b,c) in occasional cases and modes only: K= CNODE= NAME=."""
        self._add("SNUBBER", (node, direction), keys)

    def force(self, node: Label, set: str, **keys: Value) -> None:
        """Add a nodal force of set F1 to F9: FX= ... MZ=."""
        self._add("FORCE", (node, set), keys)

    def displacement(self, node: Label, set: str, **keys: Value) -> None:
        """Impose a displacement of set D1 to D9: DX= ... RZ=."""
        self._add("DISPLACEMENT", (node, set), keys)

    def acceleration(self, set: str, **keys: Value) -> None:
        """Give the uniform acceleration of set U1 to U9 in g: X= Y= Z=."""
        self._add("ACCELERATION", (set,), keys)

    def wind(self, set: str, **keys: Value | Points) -> None:
        """Give wind WIND1 to WIND9: DIR= with PRESSURE= or VELOCITY= [(z, p), ...], or ASCE7=."""
        self._add("WIND", (set,), keys)

    def snow(self, weight: float | str) -> None:
        """Put snow or ice on all pipes [N/m]: set S."""
        self._add("SNOW", (weight,), {})

    def spectrum(self, name: str, **keys: Value | Points) -> None:
        """Define a response spectrum: TABLE=[(f, a), ...] X= Y= INTERP=."""
        self._add("SPECTRUM", (name,), keys)

    def group(self, name: str, *nodes: Label) -> None:
        """Name supports that move together in independent support motion."""
        self._add("GROUP", (name, *nodes), {})

    def modes(self, n: int, **keys: Value) -> None:
        """Ask for n modes: FMAX= ABOUT= MASS= MESH= ROTARY= FRICTION=."""
        self._add("MODES", (n,), keys)

    def case(self, name: str, loads: str, **keys: Value) -> None:
        """Define a load case "W + P1 + T1": FROM= ABOUT= ON= STEPS= MUX= E= SNUBBERS= ...

        "SPECTRUM(SSE,X)" makes it a response spectrum; NONLINEAR=True goes with ABOUT=.
        """
        self._add("CASE", (name, loads), keys)

    def comb(self, name: str, expression: str) -> None:
        """Define a combination of results: "OPE - SUS"."""
        self._add("COMB", (name, expression), {})

    def cycle(self, name: str, *cases: str, **keys: Value) -> None:
        """Follow cases one after another until the loop repeats: TIMES= FROM=."""
        self._add("CYCLE", (name, *cases), keys)

    def check(self) -> None:
        """Raise ModelError with every fault that shows without geometry."""
        from trunnion.deck.api import check_model

        check_model(self)

    def deck(self) -> str:
        """Write the deck, in `units`, that reads back to an equal model."""
        from trunnion.deck.writer import write

        return write(self)

    def _add(self, keyword: str, args: tuple[Any, ...], keys: Mapping[str, Any]) -> None:
        """Add one record at the place of the call."""
        from trunnion.deck.api import add

        caller = sys._getframe(2)
        place = Place(caller.f_code.co_filename.rpartition("/")[2], caller.f_lineno)
        add(self, keyword, args, keys, place)
