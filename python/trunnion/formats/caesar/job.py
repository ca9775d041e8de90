"""A CAESAR II job as its files describe it, in SI: elements with what hangs on them.

The neutral file and the input XML both become this; `build` makes the model.  None is a blank.
"""

from trunnion.frozen import frozen
from trunnion.model import Units

Nine = tuple[float | None, ...]
Six = tuple[float | None, ...]
Vec = tuple[float, float, float]
MIDDLE = -2.0202  # angle of a bend's node that means "M"
BOURDON = ("OFF", "ELONGATION", "OPENING")  # there: none, translation, translation and rotation


@frozen
class BendData:
    """A bend at the TO end; `nodes` are (angle [deg] from the near point, MIDDLE; node)."""

    line: int
    radius: float
    flanges: int = 0
    nodes: tuple[tuple[float, int], ...] = ()
    miters: int = 0
    fitting_wall: float = 0.0
    k: float = 0.0
    whole: float = 0.0  # turn of the bend that this one is a part of [rad]; 0: it is whole


@frozen
class RigidData:
    """A rigid element: weight [N] without contents and insulation; 0: a weightless link."""

    line: int
    weight: float
    type: int = 0


@frozen
class JointData:
    """Rates of a joint: axial, transverse [N/m], bending, torsional [N m/rad], inside diameter."""

    line: int
    axial: float
    transverse: float
    bending: float
    torsional: float
    diameter: float


@frozen
class Restraint:
    """One restraint: code as in the neutral file (1 ANC ... 62), its values [N/m, m, -].

    `stiffness` None: rigid.  A rotational one has N m/rad and rad.
    """

    line: int
    node: int
    code: int
    stiffness: float | None = None
    gap: float = 0.0
    mu: float = 0.0
    cnode: int = 0
    cosines: Vec = (0.0, 0.0, 0.0)
    tag: str = ""


@frozen
class Sets:
    """Nine sets of six values at a node: displacements [m, rad] (None free), or forces [N, N m]."""

    line: int
    node: int
    values: tuple[Six, ...]


@frozen
class Uniform:
    """Nine uniform loads: (vector, True: in g, False: N/m)."""

    line: int
    loads: tuple[tuple[Vec, bool], ...]


@frozen
class WindData:
    """Wind or wave on the element and those that follow: 0 wind, 1 wave, 2 off."""

    line: int
    kind: int
    shape: float


@frozen
class Offsets:
    """Rigid offsets of the FROM and the TO end [m]."""

    line: int
    start: Vec
    end: Vec


@frozen
class ReducerData:
    """Size at the TO end [m], cone angle [deg]."""

    line: int
    od: float
    wall: float
    alpha: float


@frozen
class Element:
    """One element, from `line` on; `t` in C, or `strain` where the file has that instead."""

    line: int
    start: int
    end: int
    delta: Vec
    od: float
    wall: float
    material: int
    insulation: float = 0.0
    corrosion: float = 0.0
    t: Nine = (None,) * 9
    strain: Nine = (None,) * 9
    p: Nine = (None,) * 9
    e: float = 0.0
    nu: float = 0.0
    density: float = 0.0
    insulation_density: float = 0.0
    fluid_density: float = 0.0
    cladding: float = 0.0
    cladding_density: float = 0.0
    cover_weight: float = 0.0  # insulation and cladding together [N/m]
    lining: float = 0.0
    lining_density: float = 0.0
    name: str = ""
    names: tuple[str, str] = ("", "")  # of the FROM and the TO node
    bend: BendData | None = None
    rigid: RigidData | None = None
    joint: JointData | None = None
    restraints: tuple[Restraint, ...] = ()
    displacements: tuple[Sets, ...] = ()
    forces: tuple[Sets, ...] = ()
    uniform: Uniform | None = None
    wind: WindData | None = None
    offsets: Offsets | None = None
    reducer: ReducerData | None = None
    checks: tuple[str, ...] = ()  # what it has for stress checks only: "SIF&TEES"
    sifs: tuple[tuple[int, int], ...] = ()  # node and type of intersections and welds
    material_name: str = ""
    code: int | None = None  # number of the piping code, 0 the default one; None: not said


@frozen
class HangerData:
    """A spring hanger; rate [N/m] and cold load [N] 0: to be designed."""

    line: int
    node: int
    rate: float = 0.0
    cold_load: float = 0.0
    hot_load: float = 0.0
    constant: float = 0.0  # constant effort load [N]
    variation: float = 25.0  # [%]
    rod: float = 0.0  # a rigid rod up to this travel [m]
    most: float | None = None  # a constant support above this travel [m]
    space: float = 0.0  # available above the pipe, below it where negative [m]
    cold_design: bool = False
    number: int = 1
    cnode: int = 0
    table: int = 0
    tag: str = ""
    free: tuple[tuple[int, int], ...] = ()  # anchors and codes of the freedoms that are freed


@frozen
class Nozzle:
    """A flexible nozzle and the vessel's node."""

    line: int
    node: int
    vessel: int


@frozen
class Job:
    """Everything of one file."""

    elements: tuple[Element, ...]
    hangers: tuple[HangerData, ...] = ()
    nozzles: tuple[Nozzle, ...] = ()
    coordinates: tuple[tuple[int, int, Vec], ...] = ()  # line, node, place [m]
    up: str = "Y"
    ambient: float = 21.11  # [C]
    units: Units = Units("mm", "N", "bar", "C")
    titles: tuple[str, ...] = ()
    version: float = 0.0  # of the program
    bourdon: int | None = None  # number of BOURDON; None: the file does not say
