"""Response spectra of structures whose modes and answers are known in closed form."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from trunnion.arrays import ModeSet
from trunnion.cases.analysis import solve
from trunnion.cases.spectrumcase import SpectrumPass
from trunnion.deck.reader import read_text
from trunnion.errors import ModelError
from trunnion.loads.masses import Masses, model_masses
from trunnion.model import Case, Group, Model, Shock, Spectrum, SpectrumUse
from trunnion.report.modes import mode_warnings
from trunnion.results.balance import local_forces
from trunnion.solver.ledger import Ledger
from trunnion.solver.modal import modes_of
from trunnion.solver.pencil import Pencil
from trunnion.solver.spectrum import acceleration
from trunnion.solver.structure import Structure
from trunnion.solver.supportmotion import hold, influence, moving, participation, recover
from trunnion.system import build_system

MASS, L, K = 500.0, 4.0, 1e12

HEAD = """\
TITLE    Weightless pipe with a mass
UNITS    m N Pa C
DEFAULT  SHEAR=OFF
MATERIAL STEEL  E=200e9 NU=0.3
SECTION  P      OD=0.2 WALL=0.01
"""
CANTILEVER = (
    HEAD
    + """\
ANCHOR   10
PIPE     10 20  DX=4
FORCE    20 F1  FY=1
CASE A = F1
"""
)
BEAM = (
    HEAD
    + """\
SUPPORT  10     X Y Z RX K=1e12
PIPE     10 20  DX=4
PIPE     20 30  DX=4
SUPPORT  30     Y Z K=1e12
FORCE    20 F1  FY=1
CASE A = F1
"""
)

FLAT = Spectrum("FLAT", (1.0, 100.0), (3.0, 3.0))
HALF = Spectrum("HALF", (1.0, 100.0), (1.5, 1.5))
SPECTRA = {"FLAT": FLAT, "HALF": HALF}


@dataclass
class Scene:
    """A structure that carries one mass at node 20: a mode a direction."""

    pencil: Pencil
    modes: ModeSet
    flexibility: np.ndarray  # (3,) of the mass in X, Y, Z [m/N]

    @property
    def structure(self):
        return self.pencil.structure

    def node(self, label):
        return self.structure.system.labels.index(label)

    def solve(self, *shocks, groups=(), modes=None, **use):
        """Solve one case."""
        model = Model(spectra=SPECTRA, groups=list(groups))
        modes = modes or self.modes
        cases = SpectrumPass(model, self.structure.system, modes, self.pencil)
        return cases.solve(Case("RS", (), spectrum=SpectrumUse(tuple(shocks), **use)))


def scene(deck):
    """Modes from static flexibilities: with one mass they are exact."""
    structure = Structure(build_system(read_text(deck, "one_mass.inp")), Ledger(), whole=True)
    at = structure.system.labels.index("20")
    hold(structure)
    unit = np.zeros((3, structure.n_node, 6))
    unit[[0, 1, 2], at, [0, 1, 2]] = 1.0
    moved = structure.solve(unit)
    flexibility, way = np.linalg.eigh(moved[:, at, :3])
    flexibility, way = flexibility[::-1], way[:, ::-1]
    shape = np.einsum("an...,ai->in...", moved, way)
    shape = shape / (flexibility * np.sqrt(MASS))[:, None, None]
    frequency = 1.0 / np.sqrt(MASS * flexibility) / (2.0 * np.pi)
    every = np.arange(len(structure.system.kind), dtype=np.int32)
    modes = ModeSet(
        system=structure.system,
        frequency=frequency,
        shape=shape,
        shape_low=np.zeros_like(shape),
        participation=np.sqrt(MASS) * way.T,
        effective_mass=MASS * way.T**2,
        total_mass=np.full(3, MASS),
        residual=np.full(3, 1e-13),
        rigid=0,
        added=0,
        part_of=every,
        last=every,
        proven=True,
        counted=np.inf,
    )
    lump = np.zeros(structure.n_node)
    lump[at] = MASS
    n = len(every)
    pencil = Pencil(structure, Masses(np.zeros(n), np.zeros((n, 2)), lump), lumped=True)
    return Scene(pencil, modes, np.diag(moved[:, at, :3]))


def some(modes, keep):
    """Only some of the modes."""
    names = ("frequency", "shape", "shape_low", "participation", "effective_mass", "residual")
    return replace(modes, **{name: getattr(modes, name)[keep] for name in names})


@pytest.fixture(scope="module")
def cantilever():
    return scene(CANTILEVER)


@pytest.fixture(scope="module")
def beam():
    return scene(BEAM)


# ---------------------------------------------------------------------- spectra
def test_interpolation_in_logarithms():
    """Halfway in the logarithm of the frequency stands the geometric mean."""
    spectrum = Spectrum("S", (1.0, 100.0), (2.0, 8.0))
    assert acceleration(spectrum, np.array([10.0])) == pytest.approx([4.0], rel=1e-14)


def test_interpolation_in_frequency_and_in_period():
    """1 and 4 Hz are 1 and 0.25 s: 2.5 Hz is halfway in frequency, 1.6 Hz halfway in period."""
    spectrum = Spectrum("S", (1.0, 4.0), (2.0, 8.0), log=False)
    assert acceleration(spectrum, np.array([2.5])) == pytest.approx([5.0], rel=1e-14)
    by_period = replace(spectrum, by_period=True)
    assert acceleration(by_period, np.array([1.6])) == pytest.approx([5.0], rel=1e-14)


@pytest.mark.parametrize("way", [{}, {"log": False}, {"log": False, "by_period": True}])
def test_end_values_hold_beyond_the_ends(way):
    spectrum = Spectrum("S", (1.0, 4.0), (2.0, 8.0), **way)
    assert acceleration(spectrum, np.array([0.01, 1e3])) == pytest.approx([2.0, 8.0], rel=1e-14)


# ---------------------------------------------------------------------- one mass
def test_one_mass_in_closed_form(cantilever):
    """u = Sa/w2 at the tip; shear m Sa and moment m Sa L at the anchor, in the local axes too."""
    result = cantilever.solve(Shock("FLAT", "Y"))
    i = 2.0 * np.pi / 64.0 * (0.2**4 - 0.18**4) / 2.0
    c = L**3 / (3.0 * 200e9 * i) + 1.0 / K + L**2 / K
    assert cantilever.flexibility[1] == pytest.approx(c, rel=1e-10)
    tip = result.state.u[cantilever.node("20")]
    assert tip[1] == pytest.approx(3.0 * MASS * c, rel=1e-10)
    force = np.array([0.0, 3.0 * MASS, 0.0, 0.0, 0.0, 3.0 * MASS * L])
    for found in (result.state.end_force[0, 0], result.gathered.local_force[0, 0]):
        assert found == pytest.approx(force, rel=1e-9, abs=1e-9)
    assert result.gathered.card_force[0] == pytest.approx(force, rel=1e-9, abs=1e-9)
    assert result.state.reaction.sum(axis=0)[1] == pytest.approx(3.0 * MASS, rel=1e-9)
    assert not result.linear
    assert result.text == "SPECTRUM(FLAT,Y)"


def test_factor_scales(cantilever):
    one = cantilever.solve(Shock("FLAT", "Y"))
    two = cantilever.solve(Shock("HALF", "Y", 2.0))
    assert two.state.u == pytest.approx(one.state.u, rel=1e-14)
    assert two.text == "SPECTRUM(HALF,Y,2)"


@pytest.mark.parametrize("first", ["MODES", "DIRECTIONS"])
@pytest.mark.parametrize("spatial", ["SRSS", "ABS"])
def test_directions_combine(cantilever, spatial, first):
    """A skew quantity would feel all; here each direction has a mode of its own."""
    shocks = Shock("FLAT", "X"), Shock("HALF", "Y"), Shock("FLAT", "Z")
    result = cantilever.solve(*shocks, modal="SRSS", spatial=spatial, first=first)
    force = result.state.end_force[0, 1, :3]
    assert force == pytest.approx(MASS * np.array([3.0, 1.5, 3.0]), rel=1e-9)


def test_signs_are_lost_where_directions_combine_first(cantilever):
    """Bending in Y and in Z has one frequency; its modes may as well stand at 45 degrees.

    CQC adds such modes with their signs, so shocks in Y and Z give a in Y and in Z whatever the
    modes.  Directions first, each mode gets a, without sign: sqrt(2) a in one and nothing in the
    other.
    """
    modes = cantilever.modes
    shape, gamma = modes.shape.copy(), modes.participation.copy()
    for turned in (shape, gamma):
        one, other = turned[0].copy(), turned[1].copy()
        turned[0], turned[1] = (one + other) / np.sqrt(2.0), (one - other) / np.sqrt(2.0)
    skew = replace(modes, shape=shape, participation=gamma)
    shocks = Shock("FLAT", "Y"), Shock("FLAT", "Z")
    a = 3.0 * MASS * cantilever.flexibility[1]
    for first, factors in (("MODES", (1.0, 1.0)), ("DIRECTIONS", (0.0, np.sqrt(2.0)))):
        found = cantilever.solve(*shocks, modes=skew, modal="CQC", first=first).state
        tip = np.sort(found.u[cantilever.node("20"), 1:3])
        assert tip == pytest.approx(a * np.array(factors), rel=1e-7, abs=1e-7 * a)


def test_one_direction_keeps_its_signs(cantilever):
    shock = Shock("FLAT", "Z")
    for modal in ("CQC", "SRSS"):
        found = [
            cantilever.solve(shock, modal=modal, first=first).state.end_force
            for first in ("MODES", "DIRECTIONS")
        ]
        assert found[0] == pytest.approx(found[1], rel=1e-14)


# ---------------------------------------------------------------------- missing mass
def test_missing_mass_is_static(cantilever):
    """Without its mode a direction answers with the static force at zero period acceleration."""
    modes = cantilever.modes
    bending = some(modes, slice(2))
    for zpa, a in ((None, 3.0), (7.0, 7.0)):
        shocks = Shock("FLAT", "X"), Shock("FLAT", "Y")
        result = cantilever.solve(*shocks, modes=bending, missing_mass=True, zpa=zpa)
        force = result.state.end_force[0, 1, :3]
        assert force[0] == pytest.approx(MASS * a, rel=1e-9)
        assert force[1] == pytest.approx(MASS * 3.0, rel=1e-9)
    without = cantilever.solve(Shock("FLAT", "X"), modes=bending)
    assert without.state.end_force[0, 1, 0] == pytest.approx(0.0, abs=1e-6)


def test_missing_mass_warns_unless_it_is_added(cantilever):
    bending = some(cantilever.modes, slice(2))
    shocks = Shock("FLAT", "X"), Shock("FLAT", "Y")
    (warning,) = cantilever.solve(*shocks, modes=bending).warnings
    assert warning == "the modes carry 0 % in X of the mass; MISSING=ON adds the rest"
    assert not cantilever.solve(*shocks, modes=bending, missing_mass=True).warnings
    assert not cantilever.solve(*shocks).warnings


def test_missing_mass_of_complete_modes_is_nothing(cantilever):
    shocks = Shock("FLAT", "X"), Shock("FLAT", "Y"), Shock("FLAT", "Z")
    with_it = cantilever.solve(*shocks, missing_mass=True, modal="ABS").state
    without = cantilever.solve(*shocks, modal="ABS").state
    assert with_it.end_force == pytest.approx(without.end_force, rel=1e-9, abs=1e-6)


# ---------------------------------------------------------------------- groups of supports
NEAR, FAR = Group("NEAR", ("10",)), Group("FAR", ("30",))


def test_one_end_moves_the_middle_by_half(beam):
    """Influence of one end of a simple beam; its participation is half of the uniform one."""
    system, modes = beam.structure.system, beam.modes
    ends = [moving(system, {beam.node(end)}) for end in ("10", "30")]
    far = influence(beam.structure, ends[1], 1)
    assert far[:, 1] == pytest.approx([0.0, 0.5, 1.0], abs=1e-6)
    none = np.zeros_like(modes.shape)
    reaction = recover(beam.pencil, modes, system, modes.shape, none, none).reaction
    shares = [participation(moves, 1, modes.frequency, reaction) for moves in ends]
    at = beam.node("20")
    by_mass = modes.shape[:, at, 1] * MASS * far[at, 1]
    assert shares[1] == pytest.approx(by_mass, rel=1e-9, abs=1e-9)
    assert sum(shares) == pytest.approx(modes.participation[:, 1], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(("groups", "factor"), [("ABS", 1.0), ("SRSS", np.sqrt(0.5))])
def test_groups_combine(beam, groups, factor):
    """Both ends alike: the absolute sum is the uniform motion, SRSS is less."""
    shocks = [Shock("FLAT", "Y", 1.0, name) for name in ("NEAR", "FAR")]
    model = Model(spectra=SPECTRA, groups=[NEAR, FAR])
    use = SpectrumUse(tuple(shocks), groups=groups)
    cases = SpectrumPass(model, beam.structure.system, beam.modes, beam.pencil)
    found = cases.solve(Case("RS", (), spectrum=use))
    uniform = beam.solve(Shock("FLAT", "Y"))
    assert found.state.u == pytest.approx(factor * uniform.state.u, rel=1e-9, abs=1e-15)
    assert found.text == "SPECTRUM(FLAT,Y,1,NEAR) + SPECTRUM(FLAT,Y,1,FAR)"


def test_missing_mass_of_a_group(beam):
    """The vertical modes left out, half of the mass follows one end: its reactions are halves."""
    modes = beam.modes
    others = some(modes, np.flatnonzero(modes.participation[:, 1] == 0.0))
    shock = Shock("FLAT", "Y", 1.0, "FAR")
    found = beam.solve(shock, groups=(NEAR, FAR), modes=others, missing_mass=True)
    assert found.gathered.card_force[:, 1] == pytest.approx([375.0, 375.0], rel=1e-6)


def test_group_without_support_is_named(beam):
    shock = Shock("FLAT", "Y", 1.0, "MIDDLE")
    with pytest.raises(ModelError, match="GROUP MIDDLE: no support stands at 20"):
        beam.solve(shock, groups=[Group("MIDDLE", ("10", "20"))])
    with pytest.raises(ModelError, match="group MIDDLE is not defined"):
        beam.solve(shock)


def test_free_structure_is_refused(beam):
    frequency = np.array([0.0, *beam.modes.frequency[1:]])
    with pytest.raises(ModelError, match="moves freely"):
        beam.solve(Shock("FLAT", "Y"), modes=replace(beam.modes, frequency=frequency))


def test_poor_modes_give_no_numbers(beam):
    modes = replace(beam.modes, residual=np.array([1e-13, 1e-3, 1e-13]))
    found = beam.solve(Shock("FLAT", "Y"), modes=modes)
    assert not found.converged
    assert found.state is None
    assert found.cause.startswith("mode 2 at ")


def test_doubtful_count_is_a_warning(beam):
    found = beam.solve(Shock("FLAT", "Y"), modes=replace(beam.modes, proven=False))
    assert found.warnings


# ---------------------------------------------------------------------- reports
SKEW = CANTILEVER.replace("DX=4", "DX=2.4 DY=3.2")


def test_largest_values_do_not_turn_with_the_axes():
    """On a skew pipe the largest global forces, turned, are not the largest local ones.

    Shocks in X and Y give axial m Sa and shear m Sa at most; the turned global ones would be
    1.4 and 0.2 times that.
    """
    tilted = scene(SKEW)
    shocks = Shock("FLAT", "X"), Shock("FLAT", "Y")
    result = tilted.solve(*shocks)
    wrong = local_forces(result.system, result.state.end_force)[0, 1, :2]
    assert np.abs(wrong) == pytest.approx(3.0 * MASS * np.array([1.4, 0.2]), rel=1e-6)
    row = result.elements["10-20"]
    found = [row[f"{name}_local_to"] for name in ("fx", "fy")]
    assert found == pytest.approx([3.0 * MASS] * 2, rel=1e-6)
    axial = result.stresses["10-20"]["axial_to"]
    assert axial == pytest.approx(3.0 * MASS / (np.pi / 4.0 * (0.2**2 - 0.18**2)), rel=1e-6)


# ---------------------------------------------------------------------- decks
RULES = "MODAL=GROUP SPATIAL=ABS GROUPS=SRSS FIRST=DIRECTIONS DAMPING=0.05 ZPA=0.2 MISSING=ON"


def test_every_rule_of_a_case_survives_the_writer():
    """The deck written from a model reads back to the same case."""
    text = f"{CANTILEVER}MODES 3\nSPECTRUM S Y=M/S2 TABLE=(1,2),(9,3)\nGROUP END = 10\n"
    text += f"CASE RS = SPECTRUM(S,X,0.667,END) + SPECTRUM(S,Y,1,END) {RULES}\n"
    model = read_text(text, "rules.inp")
    use = model.cases[-1].spectrum
    assert use.shocks == (Shock("S", "X", 0.667, "END"), Shock("S", "Y", 1.0, "END"))
    words = (use.modal, use.spatial, use.groups, use.first, use.damping, use.missing_mass)
    assert words == ("GROUP", "ABS", "SRSS", "DIRECTIONS", 0.05, True)
    assert use.zpa == pytest.approx(0.2 * 9.80665, rel=1e-15)
    assert read_text(model.deck(), "again.inp").cases[-1].spectrum == use


# ---------------------------------------------------------------------- extra nodes
HEAVY = HEAD.replace("NU=0.3", "NU=0.3 DENSITY=7850") + "ANCHOR 10\n"
ENDING = """\
SUPPORT  30     Y Z
MODES    6 FMAX=120 MESH={}
SPECTRUM FLAT Y=M/S2 TABLE=(1,3),(100,3)
GROUP    NEAR = 10
GROUP    FAR = 30
CASE RS = SPECTRUM(FLAT,X,1,NEAR) + SPECTRUM(FLAT,Y,1,FAR) + SPECTRUM(FLAT,Z,2,NEAR)  MISSING=ON
"""


def shaken(text):
    """System, modes and spectrum case of a deck."""
    model = read_text(text, "mesh.inp")
    system = build_system(model)
    modes, pencil = modes_of(system, model_masses(model, system), model.modal, Ledger())
    return system, modes, SpectrumPass(model, system, modes, pencil).solve(model.cases[-1])


def test_extra_nodes_of_the_modes_leave_the_model_as_it_is():
    """A bend and its legs cut by MESH=AUTO answer as the same pipe cut by hand.

    Both legs are cut in equal parts, and the bend in its middle, which a force of nothing makes
    a node.
    """
    auto = HEAVY + "PIPE 10 20 DX=6\nBEND 20 R=0.3\nPIPE 20 30 DZ=6\n" + ENDING.format("AUTO")
    system, modes, found = shaken(auto)
    assert np.bincount(modes.part_of)[1] == 2
    assert modes.added > 2
    n = int((modes.part_of == 0).sum())  # parts of the first leg
    step = 5.7 / n
    points = [f"PIPE {9 + i} {10 + i} DX={step!r}\n" for i in range(1, n)]
    legs = "".join(points) + f"PIPE {9 + n} 200 DX={step + 0.3!r}\nBEND 200 R=0.3\n"
    legs += "FORCE 200M F1 FX=0\n"
    m = int((modes.part_of == list(system.kind).index(0, 1)).sum())
    step = 5.7 / m
    legs += f"PIPE 200 301 DZ={step + 0.3!r}\n"
    legs += "".join(f"PIPE {300 + i} {301 + i} DZ={step!r}\n" for i in range(1, m - 1))
    legs += f"PIPE {299 + m} 30 DZ={step!r}\n"
    whole, plain, by_hand = shaken(HEAVY + legs + ENDING.format("NONE"))
    assert plain.added == 0
    assert modes.frequency == pytest.approx(plain.frequency, rel=1e-9)
    scale = np.abs(by_hand.state.end_force).max()
    first, last = 0, len(system.kind) - 1
    for element, at, label in ((first, 0, "10"), (last, 1, "30")):
        node = whole.labels.index(label)
        hand = next(
            by_hand.gathered.local_force[e, at]
            for e, ends in enumerate(whole.ends.tolist())
            if ends[at] == node
        )
        assert found.gathered.local_force[element, at] == pytest.approx(
            hand, rel=1e-6, abs=1e-7 * scale
        )
    assert found.gathered.card_force == pytest.approx(
        by_hand.gathered.card_force, rel=1e-6, abs=1e-7 * scale
    )
    assert found.state.u.shape == (len(system.labels), 6)


# ---------------------------------------------------------------------- mass inside elements
@pytest.mark.parametrize("mass", ["LUMPED", "CONSISTENT"])
@pytest.mark.parametrize("modes", [2, 6])
def test_anchor_takes_the_end_force_of_its_element(mass, modes):
    """Inertia inside an element is part of its balance: by modes, and by the mass they leave."""
    deck = HEAVY + "PIPE 10 20 DX=3 DY=2\nPIPE 20 30 DZ=4\n"
    deck += f"MODES {modes} MASS={mass} MESH=NONE ROTARY=OFF\n"
    deck += "SPECTRUM FLAT Y=M/S2 TABLE=(1,3),(100,3)\n"
    deck += "CASE RS = SPECTRUM(FLAT,X) + SPECTRUM(FLAT,Y) + SPECTRUM(FLAT,Z)  MISSING=ON\n"
    _, _, found = shaken(deck)
    end, load = found.state.end_force[0, 0], found.gathered.card_force[0]
    if mass == "LUMPED":  # half of the element's mass stands on the anchor and shakes it alone
        end, load = end[3:], load[3:]
    assert end == pytest.approx(load, rel=1e-6, abs=1e-6 * np.abs(load).max())


@pytest.mark.parametrize("missing", ["ON", "OFF"])
def test_no_mode_below_the_cut_off_leaves_the_static_response(missing):
    deck = CANTILEVER.replace("CASE A = F1\n", "")
    deck += "MASS 20 M=500\nMODES 1 FMAX=0.001\nSPECTRUM FLAT Y=M/S2 TABLE=(1,3),(100,3)\n"
    deck += f"CASE RS = SPECTRUM(FLAT,Y) MISSING={missing}\n"
    results = solve(read_text(deck))
    state = results.cases["RS"].state
    assert not len(results.modes.frequency)
    static = 500.0 * 3.0 if missing == "ON" else 0.0
    assert state.end_force[0, 0, 1] == pytest.approx(static, rel=1e-6)
    assert mode_warnings(results) == ["MODES: none, the lowest lies above FMAX"]


@pytest.mark.parametrize(("first", "warned"), [(0.1, False), (90.0, True)])
def test_mode_below_the_first_point_of_a_spectrum_is_warned_of(first, warned):
    deck = CANTILEVER.replace("CASE A = F1\n", "")
    deck += f"MASS 20 M=500\nMODES 1\nSPECTRUM S Y=M/S2 TABLE=({first},3),(100,3)\n"
    deck += "CASE RS = SPECTRUM(S,Y) MISSING=ON\n"
    warnings = solve(read_text(deck)).cases["RS"].warnings
    assert any("lies below spectrum S" in text for text in warnings) == warned


@pytest.mark.parametrize(("direction", "warned"), [("X", True), ("Y", False)])
def test_group_that_holds_nothing_in_its_direction_is_warned_of(beam, direction, warned):
    group = Group("FAR", ("30",))
    result = beam.solve(Shock("FLAT", direction, group="FAR"), groups=[group])
    assert ("no support of group FAR holds the pipe in X" in result.warnings) == warned
