"""The arrays between model and results: plain data, no kernels, no files.

A `System` is one model with numbered freedoms, a `Loads` the loads of one case on it, a
`CaseResult` the answer.  Freedom order at a node: ux uy uz rx ry rz, global.  An element is
described at its second end ("tip"), fixed at the first: six deformations and six forces.
Records of arrays have no == (arrays have no one truth value) and no repr of theirs.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trunnion.frozen import frozen

if TYPE_CHECKING:
    from pandas import DataFrame

    from trunnion.results.tables import Table

F8 = NDArray[np.float64]
I4 = NDArray[np.int32]
B1 = NDArray[np.bool_]

STRAIGHT, ARC, SPRING, TAPER = 0, 1, 2, 3  # System.kind


@frozen(eq=False)
class Contacts:
    """One item a direction word: a normal (or a plane of two normals) with two sides.

    node, cnode : (n,) node numbers; cnode is -1 where the support stands on ground.
    card : (n,) index of the support card.
    rotational : (n,) the contact holds a rotation, its reaction is a moment.
    dim : (n,) 1, or 2 for a guide on a vertical pipe (radial contact in a plane).
    normal : (n, 2, 3) unit normals; the second is zero when dim is 1.
    gap : (n, 2) clearance to the minus and the plus side [m, rad]; inf where that side is
        free; both equal (radial) when dim is 2.
    k : (n,) stiffness [N/m, N m/rad].
    penalty : (n,) k stands for a rigid support (not the user's own K=).
    two_way : (n,) always closed: both gaps zero.
    word : direction words, for reports.
    """

    node: I4
    cnode: I4
    card: I4
    rotational: B1
    dim: I4
    normal: F8
    gap: F8
    k: F8
    penalty: B1
    two_way: B1
    word: tuple[str, ...]


def no_contacts() -> Contacts:
    """An empty set of contacts."""
    none = np.zeros(0, np.int32)
    return Contacts(
        node=none,
        cnode=none,
        card=none,
        rotational=np.zeros(0, np.bool_),
        dim=none,
        normal=np.zeros((0, 2, 3)),
        gap=np.zeros((0, 2)),
        k=np.zeros(0),
        penalty=np.zeros(0, np.bool_),
        two_way=np.zeros(0, np.bool_),
        word=(),
    )


@frozen(eq=False)
class Sliders:
    """One item a friction element: Coulomb sliding in a fixed line or plane.

    basis : (n, 2, 3) orthonormal directions of sliding; the second is zero on a line.
    mu, kf : (n,) coefficient, elastic stick stiffness [N/m].
    first, contact : the contacts of slider i are contact[first[i]:first[i+1]]; its normal
        force is |sum of their reactions as vectors|.
    """

    node: I4
    cnode: I4
    card: I4
    basis: F8
    mu: F8
    kf: F8
    first: I4
    contact: I4


def no_sliders() -> Sliders:
    """No friction."""
    none = np.zeros(0, np.int32)
    return Sliders(
        node=none,
        cnode=none,
        card=none,
        basis=np.zeros((0, 2, 3)),
        mu=np.zeros(0),
        kf=np.zeros(0),
        first=np.zeros(1, np.int32),
        contact=none,
    )


@frozen
class Card:
    """One support of the JSON and of the restraint table: a card of the deck."""

    label: str  # node
    cnode: str | None
    name: str  # e.g. "20 +Y GUIDE"
    kind: str  # anchor, support, hanger, spring, displacement
    line: int


@frozen
class Part:
    """Names of one element: labels of its ends, type and the section and material used."""

    start: str
    end: str
    type: str  # pipe, bend, rigid, spring
    section: str | None
    material: str | None
    line: int


@frozen(eq=False)
class System:
    """A numbered model.

    labels : node labels; `alias` maps further labels (30 -> 30F) to node numbers.
    xyz : (n_node, 3) [m].
    ends : (n_elem, 2) node numbers.
    kind : (n_elem,) STRAIGHT, ARC, SPRING (also expansion joints) or TAPER (reducers).
    axes : (n_elem, 3, 3) rows ex ey ez; ex along the pipe at the first end; on an arc ey
        points to its centre, on an eccentric reducer to the offset.  Springs: the axes of their
        six stiffnesses.
    length : (n_elem,) along the axis [m]; 0 for springs, that of expansion joints.
    radius, angle : (n_elem,) of an arc [m, rad]; 0 elsewhere.
    rigidity : (n_elem, 4) EA [N], GJ, EI [N m2], GAs [N]; GAs = 0 is rigid in shear.
    flex : (n_elem,) factor on the bending flexibility (k of a bend), 1 on straights.
    spring : (n_elem, 6) stiffnesses of springs, at mid-distance in `axes`; 0 elsewhere.
    od, wall : (n_elem,) pipe for stresses [m], at the first end; 0 for springs.
    taper : (n_elem, 3) of reducers: outside diameter and wall at the second end, and the offset of
        the second end along ey [m]; 0 elsewhere.  Of no rows where there are no reducers.
    up : unit vector against gravity.
    snubbers : contacts that hold only where snubbers are locked; statics never see them.
    source : (n_elem,) index of Model.pipes whose properties hold; -1 for springs.
    mid : label of a bend's middle that is no node (30M) -> element whose middle it is.
    """

    labels: tuple[str, ...]
    alias: dict[str, int]
    xyz: F8
    ends: I4
    kind: I4
    axes: F8
    length: F8
    radius: F8
    angle: F8
    rigidity: F8
    flex: F8
    spring: F8
    od: F8
    wall: F8
    parts: tuple[Part, ...]
    contacts: Contacts
    sliders: Sliders
    cards: tuple[Card, ...]
    up: F8
    source: I4
    mid: dict[str, int]
    snubbers: Contacts = field(default_factory=no_contacts)
    taper: F8 = field(default_factory=lambda: np.zeros((0, 3)))


@frozen(eq=False)
class Loads:
    """Loads of one case (or of a fraction of it).

    dist : (n_elem, 3) load per length of axis, global, its mean where it varies [N/m].
    vary : (n_elem, 2, 3) on reducers the factors of 2 s - 1 and 6 s2 - 6 s + 1 in the load per
        length, s from 0 to 1 along the axis [N/m].  Of no rows where the system has no reducers.
    strain : (n_elem,) free axial strain (thermal and pressure).
    curvature : (n_elem,) free change of angle per length of an arc (opening < 0) [rad/m].
    nodal : (n_node, 6) [N, N m].
    base : (n_card, 6) imposed displacement of the supports' bases [m, rad].
    preload : (n_card,) cold load of hangers when H acts, along `up` on the pipe [N].
    pressure : (n_elem,) for stresses [Pa].
    mux : factor on every mu.
    """

    dist: F8
    strain: F8
    curvature: F8
    nodal: F8
    base: F8
    preload: F8
    pressure: F8
    mux: float = 1.0
    vary: F8 = field(default_factory=lambda: np.zeros((0, 2, 3)))


def no_loads(system: System) -> Loads:
    """Nothing: what a response spectrum has for loads."""
    n_elem, n_node, n_card = len(system.kind), len(system.labels), len(system.cards)
    return Loads(
        dist=np.zeros((n_elem, 3)),
        strain=np.zeros(n_elem),
        curvature=np.zeros(n_elem),
        nodal=np.zeros((n_node, 6)),
        base=np.zeros((n_card, 6)),
        preload=np.zeros(n_card),
        pressure=np.zeros(n_elem),
        vary=np.zeros((n_elem if len(system.taper) else 0, 2, 3)),
    )


OPEN, MINUS, PLUS, BOTH = 0, -1, 1, 2  # contact side; BOTH: two-way or radial
ENGAGED, STICK, SLIP = 1, 2, 3  # slider state; OPEN = 0; ENGAGED: no friction


@dataclass(slots=True, eq=False, repr=False)
class State:
    """The numbers of one solved case.  Displacements are u + u_low (unevaluated sum).

    u, u_low : (n_node, 6) [m, rad].
    end_force : (n_elem, 2, 6) force and moment *on the element* at its ends, global.
    side : (n_contact,) OPEN, MINUS, PLUS or BOTH.
    reaction : (n_contact, 3) force (moment) on the pipe [N, N m], global.
    friction : (n_slider, 3) friction force on the pipe [N].
    mode : (n_slider,) OPEN, STICK or SLIP.
    normal : (n_slider,) N >= 0 [N].
    slide : (n_slider, 3) elastic and plastic travel u_t - d_t since the step's committed
        datum [m] (what decides stick or slip).
    datum : (n_slider, 3) committed at the start of the last step [m].
    datum_end : (n_slider, 3) committed at the end of the case, for FROM [m].
    """

    u: F8
    u_low: F8
    end_force: F8
    side: I4
    reaction: F8
    friction: F8
    mode: I4
    normal: F8
    slide: F8
    datum: F8
    datum_end: F8


@frozen(eq=False)
class Pass:
    """What the supports answered in one iteration; rounded, for the story that reports tell.

    side, reaction : of contacts; mode, friction, normal : of sliders; as in `State`.
    """

    side: NDArray[np.int8]
    reaction: NDArray[np.float32]
    mode: NDArray[np.int8]
    friction: NDArray[np.float32]
    normal: NDArray[np.float32]


@frozen
class Item:
    """One line of a certificate: the value, its limit and where it is worst."""

    name: str
    value: float
    where: str


@frozen
class Certificate:
    """What can be checked from the printed numbers; `worst` is the largest item."""

    passed: bool
    worst: float
    where: str
    items: tuple[Item, ...]
    inherited: bool = False


@frozen
class FrozenBreak:
    """A support for which the frozen contact state of a locked case does not hold.

    `what` is "pulls" (amount: force [N, N m] that would have to pull) or "closes" (amount:
    movement beyond the gap [m, rad]).
    """

    card: int
    word: str
    what: str
    amount: float


@frozen(eq=False)
class Gathered:
    """Numbers of a result without contact states: a combination or a response spectrum.

    Sums over the contacts of a card and turns into local axes come before ABS, SRSS or MAX: the
    size of a sum is not the sum of sizes.

    card_force : (n_card, 6) on the pipe; card_normal, card_friction : (n_card, 3) its parts.
    card_load : (n_card, 6) on the restraint: the opposite, but a size stays what it is; None:
        there are no sizes.
    local_force : (n_elem, 2, 6) end forces in the axes of the ends; None: those of `end_force`.
    section_force : (n_elem, 2, 6) the same with the signs of a section, tension positive; None:
        from `local_force` or `end_force` by turning the signs of the first end.
    """

    card_force: F8
    card_normal: F8
    card_friction: F8
    card_load: F8 | None = None
    local_force: F8 | None = None
    section_force: F8 | None = None


def sizes(card_force: F8, local_force: F8) -> Gathered:
    """Largest values without signs (a response spectrum): the same for whoever looks at them."""
    normal = card_force[:, :3]
    return Gathered(card_force, normal, np.zeros_like(normal), card_force, local_force, local_force)


@dataclass(slots=True, eq=False, repr=False)
class CycleResult:
    """A loop of cases followed with committed datums.

    `loops` were followed; `repeats` tells whether the last equals the one before.  The ranges
    are (n_card, 6) support loads and (n_elem, 2, 6) end forces over the last loop; `one_shot`
    those between the same cases solved each on its own.  `path` holds every step.
    """

    name: str
    cases: tuple[str, ...]
    loops: int
    repeats: bool
    change: float  # of support loads and displacements between the last two loops, relative
    supports: F8 | None = None
    elements: F8 | None = None
    one_shot_supports: F8 | None = None
    one_shot_elements: F8 | None = None
    path: list["CaseResult"] = field(default_factory=list)
    cause: str | None = None

    @property
    def support_ranges(self) -> "Table":
        """Ranges of support loads over the loop and in one shot, with their ratio."""
        from trunnion.results.tables import support_ranges

        return support_ranges(self)

    @property
    def element_ranges(self) -> "Table":
        """Ranges of end forces over the loop and in one shot, with their ratio."""
        from trunnion.results.tables import element_ranges

        return element_ranges(self)


@dataclass(slots=True, eq=False, repr=False)
class CaseResult:
    """One case or combination.

    `state` is None when the case did not converge; `cause` then says why.  `history` has one
    record an iteration; `work` counts analyse, factorise, solve, refine, elements, iterations.
    `penalty_u` (n_node, 6) and `penalty_r` (n_contact, 3) are the first-order corrections to
    rigid supports, the former made by `rigid` when asked for; `penalty_effect` is their largest
    relative size.  `digits` are those of the
    displacements that do not hang on the last bit of the input, and where they are fewest.
    """

    name: str
    kind: str  # case, comb or spectrum
    text: str  # "W + P1 + T1"
    system: System
    loads: Loads | None
    state: State | None
    converged: bool
    cause: str | None = None
    certificate: Certificate | None = None
    penalty_effect: dict[str, float] = field(default_factory=dict)
    rigid: Callable[[], F8 | None] | None = None
    penalty_r: F8 | None = None
    digits: tuple[float, str] | None = None
    frozen: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    history: list[dict[str, object]] = field(default_factory=list)
    passes: list[Pass] = field(default_factory=list)  # first iterations, not all of large models
    work: dict[str, int] = field(default_factory=dict)
    linear: bool = True  # False: a combination with ABS or of two moduli: no interior points
    frozen_check: tuple[FrozenBreak, ...] = ()  # of a locked case: what its assumption breaks
    gathered: Gathered | None = None  # None where contacts have states
    total: "CaseResult | None" = None  # of a NONLINEAR increment: both loads together

    @property
    def penalty_u(self) -> F8 | None:
        """What rigid supports would add to the displacements (n_node, 6) [m, rad]."""
        return None if self.rigid is None else self.rigid()

    @property
    def displacements(self) -> "Table":
        """Displacements by node label."""
        from trunnion.results.tables import displacements

        return displacements(self)

    @property
    def supports(self) -> "Table":
        """Support forces on the pipe and states, by node label."""
        from trunnion.results.tables import supports

        return supports(self)

    @property
    def elements(self) -> "Table":
        """End forces on the elements, by name (10-20)."""
        from trunnion.results.tables import elements

        return elements(self)

    @property
    def stresses(self) -> "Table":
        """Nominal stresses at the ends of pipes, by name (10-20)."""
        from trunnion.results.tables import stresses

        return stresses(self)


@frozen(eq=False)
class ModeSet:
    """Natural modes about a frozen contact state, in rising frequency, rigid ones first.

    system : the system they belong to; extra nodes follow those of the model.
    frequency : (m,) [Hz]; 0 for rigid modes.
    shape, shape_low : (m, n_node, 6) mass-normalised; displacements are the unevaluated sum.
    participation : (m, 3) factors for X Y Z [kg^0.5].
    effective_mass : (m, 3) their squares [kg].
    total_mass : (3,) of the system, held masses included [kg].
    residual : (m,) |K x - w2 M x| / |w2 M x|, of rigid modes to the lowest w2 above zero.
    rigid : number of rigid modes.
    added : number of extra nodes.
    part_of, last : elements of the model, see `solver.mesh.Mesh`.
    proven : a Sturm count shows that no mode below `counted` [Hz] is missing.
    cut : cut-off for which nodes were added [Hz].
    """

    system: System
    frequency: F8
    shape: F8
    shape_low: F8
    participation: F8
    effective_mass: F8
    total_mass: F8
    residual: F8
    rigid: int
    added: int
    part_of: I4
    last: I4
    proven: bool
    counted: float
    cut: float = 0.0

    @property
    def table(self) -> "Table":
        """Frequencies, participation and effective mass by number of the mode."""
        from trunnion.results.tables import modes

        return modes(self)


@frozen
class Tried:
    """One try for another answer: its number among the answers, or why there is none."""

    what: str
    answer: int | None
    cause: str | None


@frozen(eq=False)
class Spreading:
    """Certified answers of some tries and how far they lie apart (largest less smallest).

    answers : those that differ in loads; the first is the case's own where it has one.
    supports : (n_card, 6) [N, N m].  elements : (n_elem, 2, 6) end forces [N, N m].
    moves : (n_node, 6) [m, rad].  All None where nothing is certified.
    """

    tried: tuple[Tried, ...]
    answers: tuple[CaseResult, ...]
    supports: F8 | None
    elements: F8 | None
    moves: F8 | None


@frozen(eq=False)
class Spread:
    """What was found of a case beside its answer.

    unique : why there can be no other answer; then nothing was tried.
    starts : answers to the same question from other starts of the iterations.
    orders : ends of other load orders and numbers of steps, which are other questions: friction
        remembers its path; None where the answer is unique.
    cause : why nothing could be tried.
    """

    case: str
    unique: str | None
    starts: Spreading
    orders: Spreading | None
    cause: str | None = None


@frozen
class HangerChoice:
    """One hanger that the program selected; loads and rate of its springs together.

    kind : spring, rod, constant or none.
    hot, cold : loads in operation and cold [N]; rate [N/m]; travel upwards [m].
    variation : rate x travel / hot load.
    reason : why it is no spring.
    """

    node: str
    name: str | None
    kind: str
    series: str
    size: str
    number: int
    hot: float
    cold: float
    rate: float
    travel: float
    variation: float
    reason: str


@dataclass(slots=True)
class Results:
    """All cases of one run, in the deck's order."""

    title: str
    cases: dict[str, CaseResult]
    warnings: tuple[str, ...] = ()
    work: dict[str, int] = field(default_factory=dict)
    cycles: dict[str, CycleResult] = field(default_factory=dict)
    base: System | None = None  # the system whose contacts have gaps; cases may have others
    modes: ModeSet | None = None  # where the deck asks for them
    spreads: dict[str, Spread] = field(default_factory=dict)  # where other starts were asked for
    hangers: tuple[HangerChoice, ...] = ()  # that the program selected

    def __getitem__(self, name: str) -> CaseResult:
        """Return the case called `name`."""
        return self.cases[name]

    @property
    def system(self) -> System:
        """The system that labels, elements and support cards of all cases are those of."""
        return self.base or next(iter(self.cases.values())).system

    @property
    def envelope(self) -> "Table":
        """Largest and smallest load of every support over all cases, and the cases' names."""
        from trunnion.results.tables import envelope

        return envelope(self)

    def to_pandas(self) -> "dict[str, DataFrame]":
        """Every table as a pandas.DataFrame by its name, the cases below each other.

        See `results.frames.frames`, which says what there is.

        Raises
        ------
        ImportError : pandas is not installed (extra pandas).
        """
        from trunnion.results.frames import frames

        return frames(self)
