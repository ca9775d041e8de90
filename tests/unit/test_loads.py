"""Load sets and their sums, against closed forms."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from trunnion.arrays import ARC, Loads, System
from trunnion.deck.reader import read_text
from trunnion.errors import ModelError
from trunnion.loads import case_loads, case_warnings, load_sets
from trunnion.loads.expansion import free_strain
from trunnion.model import (
    Acceleration,
    Bend,
    Case,
    Direction,
    Displacement,
    Force,
    Mass,
    Material,
    Model,
    Operation,
    Pipe,
    Section,
    Settings,
    Support,
    TablePoint,
    Term,
)
from trunnion.system import build_system

G = 9.80665
STEEL = Material("A", 203e9, 0.3, 12e-6, 7850.0)
FULL = Section("S", 0.3, 0.01, 850.0, 0.02, 2000.0, 0.05, 140.0, weight=33.0)
OPERATION = Operation({"1": 170.0}, {"1": 2e6}, 20.0)

STEEL_AREA = math.pi / 4 * (0.30**2 - 0.28**2)
LINING_AREA = math.pi / 4 * (0.28**2 - 0.24**2)
BORE = math.pi / 4 * 0.24**2
COVER = math.pi / 4 * (0.40**2 - 0.30**2)
EMPTY = G * (7850 * STEEL_AREA + 2000 * LINING_AREA + 140 * COVER) + 33.0


def model(**more: object) -> Model:
    """An elbow: 4 m along X, 3 m along Z."""
    made = Model(materials={"A": STEEL}, sections={"S": FULL})
    made.pipes = [
        Pipe("10", "20", (4.0, 0.0, 0.0), "S", "A", OPERATION),
        Pipe("20", "30", (0.0, 0.0, 3.0), "S", "A", OPERATION),
    ]
    made.bends = [Bend("20", 0.45)]
    made.supports = [Support("10", "anchor")]
    for key, value in more.items():
        setattr(made, key, value)
    return made


def case(*terms: str | Term, **more: object) -> Case:
    given = tuple(Term(1.0, t) if isinstance(t, str) else t for t in terms)
    return Case("C", given, **more)  # type: ignore[arg-type]


def loads(made: Model, *terms: str | Term) -> tuple[System, Loads]:
    system = build_system(made)
    return system, case_loads(made, system, case(*terms))


@pytest.mark.parametrize(("name", "contents"), [("W", 850.0), ("WNC", 0.0), ("WW", 1000.0)])
def test_weight_per_length_counts_every_layer(name: str, contents: float) -> None:
    system, got = loads(model(), name)
    expected = -(EMPTY + G * contents * BORE)
    assert got.dist[:, 1] == pytest.approx(expected, rel=1e-14)
    assert not got.dist[:, [0, 2]].any()
    assert system.length.sum() == pytest.approx(7.0 - 0.9 + 0.225 * math.pi, rel=1e-14)


def test_weight_acts_against_up_with_the_models_gravity() -> None:
    _, got = loads(model(settings=Settings(up="Z", g=9.81), masses=[Mass("30", 100.0)]), "W")
    w = (EMPTY - 33.0) / G * 9.81 + 33.0 + 9.81 * 850 * BORE
    assert got.dist[:, 2] == pytest.approx(-w, rel=1e-14)
    assert got.nodal[3].tolist() == [0, 0, -981.0, 0, 0, 0]


def test_rigid_spreads_its_weight_with_contents_and_thick_insulation() -> None:
    made = model(bends=[])
    made.pipes[1] = replace(made.pipes[1], rigid=True, weight=5000.0)
    insulation = 1.75 * 140 * COVER * G
    for name, contents in (("W", 850.0), ("WNC", 0.0), ("WW", 1000.0)):
        _, got = loads(made, name)
        expected = 5000 / 3 + insulation + 33.0 + G * contents * BORE
        assert got.dist[1, 1] == pytest.approx(-expected, rel=1e-14)


def test_rigid_without_weight_is_weightless() -> None:
    made = model(bends=[])
    made.pipes[1] = replace(made.pipes[1], rigid=True)
    _, got = loads(made, "W")
    assert got.dist[1].tolist() == [0, 0, 0]


def test_thermal_strain_is_alpha_times_the_rise() -> None:
    made = model()
    made.pipes[1] = replace(made.pipes[1], operation=Operation())
    _, got = loads(made, Term(0.5, "T1"))
    assert got.strain == pytest.approx([9e-4, 9e-4, 0.0], rel=1e-14)


def test_mean_expansion_counts_from_the_tables_reference() -> None:
    # a(T)(T - T0) - a(TREF)(TREF - T0), T0 = 20: 12.5e-6 * 80 - 11.2e-6 * 20
    points = {40.0: 11.2e-6, 80.0: 12.2e-6, 120.0: 12.8e-6}
    table = tuple(TablePoint(t, alpha=a) for t, a in points.items())
    steel = Material("A", 203e9, table=table)
    assert free_strain(steel, 100.0, 40.0) == pytest.approx(12.5e-6 * 80 - 11.2e-6 * 20, rel=1e-14)
    assert free_strain(steel, 100.0, 20.0) == pytest.approx(12.5e-6 * 80, rel=1e-14)
    assert free_strain(steel, 40.0, 100.0) == -free_strain(steel, 100.0, 40.0)


def test_temperature_outside_the_table_is_named() -> None:
    table = (TablePoint(20.0, alpha=11e-6), TablePoint(100.0, alpha=12e-6))
    made = model(materials={"A": replace(STEEL, table=table)})
    with pytest.raises(ModelError, match="MATERIAL A: T1 of 10-20: 170 C is outside the table"):
        loads(made, "W")


def closed_end_strain(e: float = 203e9) -> float:
    return 2e6 * 0.28**2 * (1 - 2 * 0.3) / (e * (0.3**2 - 0.28**2))


def test_pressure_elongates_only_by_choice() -> None:
    _, off = loads(model(), "P1")
    assert not off.strain.any()
    assert off.pressure.tolist() == [2e6] * 3
    _, on = loads(model(settings=Settings(bourdon="ELONGATION")), Term(2.0, "P1"), "T1")
    assert on.strain == pytest.approx(2 * closed_end_strain() + 1.8e-3, rel=1e-13)
    assert not on.curvature.any()


def test_pressure_strain_follows_the_hot_modulus() -> None:
    made = model(settings=Settings(bourdon="ELONGATION"))
    system = build_system(made)
    hot = replace(system, rigidity=0.9 * system.rigidity)
    got = case_loads(made, hot, case("P1"), load_sets(made, system))
    assert got.strain == pytest.approx(closed_end_strain(0.9 * 203e9), rel=1e-13)


def test_opening_is_the_axial_stress_over_e_and_r() -> None:
    system, got = loads(model(settings=Settings(bourdon="OPENING")), "P1")
    axial = 2e6 * 0.28**2 / (0.3**2 - 0.28**2)
    expected = np.where(system.kind == ARC, -axial / 203e9 / 0.45, 0.0)
    assert got.curvature == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(("bend", "nu"), [(3.0, 0.3), (1.5, 0.3), (5.0, 0.0), (20.0, 0.45)])
def test_opening_closes_the_torus_of_membrane_theory(bend: float, nu: float) -> None:
    """Where the hoop strain is known all round, the section must have no kink at the crown.

    Numbers in units P = r = E t = 1; membrane forces of the torus as in Timoshenko.
    """

    def outward(f: float, w: float) -> float:
        rho = bend + math.sin(f)
        hoop = 0.5 * (2 * bend + math.sin(f)) / rho
        return rho * (0.5 - nu * hoop - w)

    def kink(w: float) -> float:
        step = 1e-5
        slope = (outward(step, w) - outward(-step, w)) / (2 * step)
        return slope - (1.0 - nu * 0.5)

    assert kink(-0.5) == pytest.approx(0.0, abs=1e-9)
    assert abs(kink(0.5)) > 0.5


def test_forces_add_with_factors() -> None:
    made = model(
        forces=[Force("30", "1", (1, 2, 3, 4, 5, 6)), Force("30", "1", (1, 0, 0, 0, 0, 0))]
    )
    made.forces.append(Force("20", "2", (0, 0, 0, 0, 0, 9)))
    system, got = loads(made, Term(-2.0, "F1"), "F2")
    assert got.nodal[system.labels.index("30")].tolist() == [-4, -4, -6, -8, -10, -12]
    assert got.nodal[system.alias["20"]].tolist() == [0, 0, 0, 0, 0, 9]


def test_displacements_move_all_supports_on_the_ground_of_a_node() -> None:
    made = model()
    made.supports.append(Support("10", "support", (Direction("+Y"),)))
    made.supports.append(Support("10", "support", (Direction("X"),), cnode="30"))
    made.displacements = [
        Displacement("10", "1", (0.01, None, 0.03, None, None, 0.1)),
        Displacement("30", "2", (None, 0.02, None, None, None, None)),
    ]
    _, got = loads(made, Term(2.0, "D1"))
    moved = [0.02, 0, 0.06, 0, 0, 0.2]
    assert got.base.tolist() == [moved, moved, [0.0] * 6, [0.0] * 6]
    _, other = loads(made, "D2")
    assert other.base.tolist() == [*[[0.0] * 6] * 3, [0, 0.02, 0, 0, 0, 0]]


def test_movement_that_no_support_follows_is_named() -> None:
    made = model()
    made.supports.append(Support("30", "support", (Direction("+Y"),)))
    made.displacements = [
        Displacement("30", "1", (0.01, 0.02, None, 0.0, None, None)),
        Displacement("10", "1", (0.01, 0.02, None, 0.0, None, 0.1)),
    ]
    sets = load_sets(made, build_system(made))
    assert case_warnings(sets, case("D1")) == (
        "D1 DX at 30 moves nothing: no support there holds it",
    )


def test_hanger_load_is_its_own_set() -> None:
    made = model()
    made.supports.append(Support("30", "hanger", k=1e5, load=7e3))
    system = build_system(made)
    sets = load_sets(made, system)
    assert case_loads(made, system, case("W", Term(0.5, "H")), sets).preload.tolist() == [0, 3500]
    assert case_loads(made, system, case("W"), sets).preload.tolist() == [0, 0]
    assert case_warnings(sets, case("W", "H")) == ()
    (warning,) = case_warnings(sets, case("W"))
    assert "W without H" in warning


def test_acceleration_pushes_the_operating_mass_in_its_direction() -> None:
    made = model(accelerations=[Acceleration("1", (0.3, 0.0, -0.1))], masses=[Mass("30", 100.0)])
    _, got = loads(made, "U1")
    w = EMPTY + G * 850 * BORE
    assert got.dist == pytest.approx(np.tile([0.3 * w, 0, -0.1 * w], (3, 1)), rel=1e-13)
    assert got.nodal[3, :3] == pytest.approx([0.3 * 980.665, 0, -98.0665], rel=1e-14)
    _, direct = loads(made, Term(2.0, "U", (0.15, 0.0, -0.05)))
    assert direct.dist == pytest.approx(got.dist, rel=1e-14)


@pytest.mark.parametrize("name", ["T2", "P2", "D1", "F1", "U1"])
def test_set_that_nothing_gives_is_named(name: str) -> None:
    made = model(cases=[case("W", name)])
    with pytest.raises(ModelError, match=f"CASE C: nothing in the model gives {name}"):
        load_sets(made, build_system(made))


def test_word_that_is_no_set_is_named() -> None:
    with pytest.raises(ModelError, match="CASE C: K1 is not a load set"):
        loads(model(), "K1")


def test_pipes_without_a_temperature_are_counted() -> None:
    made = model()
    made.pipes[1] = replace(made.pipes[1], operation=Operation())
    sets = load_sets(made, build_system(made))
    assert case_warnings(sets, case("T1")) == ("T1 is not given on 1 pipe",)


def test_friction_factor_goes_through() -> None:
    made = model()
    assert case_loads(made, build_system(made), case("W", mux=0.5)).mux == 0.5


def test_a_thin_wall_weighs_what_its_thickness_says():
    """To the last digit: the difference of two circles would lose two."""
    od, wall = 1.653211903262781, 0.0008825454642217002
    deck = "MATERIAL S E=2e11 NU=0.3 ALPHA=12e-6 DENSITY=7850\n"
    deck += f"SECTION P OD={od} WALL={wall}\nPIPE 10 20 DX=10\nANCHOR 10\nCASE A = W\n"
    model = read_text(deck, "deck.inp")
    system = build_system(model)
    weight = -case_loads(model, system, model.cases[0]).dist[0, 1]
    ring = Fraction(wall) * (Fraction(od) - Fraction(wall))
    due = 7850 * Fraction(model.settings.g) * ring * Fraction(math.pi)
    assert abs(Fraction(float(weight)) / due - 1) <= 1e-15
