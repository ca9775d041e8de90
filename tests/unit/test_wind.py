"""Wind and snow on pipes: closed forms; published numbers are in tests/verification."""

import math
from dataclasses import replace

import numpy as np
import pytest

import trunnion
from trunnion.arrays import ARC, System
from trunnion.errors import ModelError
from trunnion.loads import case_loads, case_warnings, load_sets
from trunnion.loads.asce7 import exposure_coefficient, exposure_integral
from trunnion.loads.wind import WindLoad, pressure_of, wind_load
from trunnion.model import (
    Bend,
    Case,
    Material,
    Model,
    Pipe,
    Section,
    Settings,
    Snow,
    Spring,
    Support,
    Term,
    Units,
    Wind,
)
from trunnion.report.units import report_units
from trunnion.report.winds import wind_echo
from trunnion.system import build_system

STEEL = Material("A", 203e9, 0.3, 12e-6, 7850.0)
COVERED = Section("S", 0.3, 0.01, insulation=0.05)  # 0.4 m wide
EVEN = Wind("1", (0.0, 0.0, 1.0), table=((0.0, 1000.0),), shape=0.5)


def line(*deltas: tuple[float, float, float], **more: object) -> Model:
    """Pipes 10-20-30 ... from the origin, an anchor at 10."""
    made = Model(materials={"A": STEEL}, sections={"S": COVERED})
    labels = [str(10 * (i + 1)) for i in range(len(deltas) + 1)]
    made.pipes = [
        Pipe(a, b, d, "S", "A") for a, b, d in zip(labels, labels[1:], deltas, strict=False)
    ]
    made.supports = [Support("10", "anchor")]
    for key, value in more.items():
        setattr(made, key, value)
    return made


def blown(made: Model, wind: Wind = EVEN) -> WindLoad:
    return wind_load(made, build_system(made), wind)


def simple(wind: Wind, *, rise: float, start: float = 0.0) -> float:
    """Mean pressure on a vertical pipe from `start` up."""
    found = blown(line((0.0, rise, 0.0)), replace(wind, ground=-start))
    return float(found.pressure[0])


def test_wind_across_takes_pipe_and_insulation() -> None:
    found = blown(line((6.0, 0.0, 0.0)))
    assert found.load[0] == pytest.approx([0.0, 0.0, 1000.0 * 0.5 * 0.4], rel=1e-14)


def test_wind_along_the_pipe_does_nothing() -> None:
    assert blown(line((0.0, 0.0, 6.0))).load[0] == pytest.approx([0.0] * 3, abs=1e-12)


@pytest.mark.parametrize("degrees", [10.0, 45.0, 70.0, 135.0])
def test_oblique_wind_acts_normal_to_the_pipe_with_sine_squared(degrees: float) -> None:
    a = math.radians(degrees)
    found = blown(line((6.0 * math.sin(a), 0.0, 6.0 * math.cos(a))))
    along = np.array([math.sin(a), 0.0, math.cos(a)])
    assert found.load[0] @ along == pytest.approx(0.0, abs=1e-10)
    assert np.linalg.norm(found.load[0]) == pytest.approx(200.0 * math.sin(a) ** 2, rel=1e-13)
    assert found.load[0] @ [0.0, 0.0, 1.0] > 0.0


def test_direction_may_have_any_length_and_its_reverse_reverses() -> None:
    made = line((5.0, 2.0, 1.0))
    load = blown(made).load
    assert blown(made, replace(EVEN, direction=(0.0, 0.0, 7.0))).load == pytest.approx(load)
    back = blown(made, replace(EVEN, direction=(0.0, 0.0, -2.0))).load
    assert back == pytest.approx(-load, rel=1e-14)


def test_vertical_axis_z_turns_everything() -> None:
    found = blown(
        line((0.0, 0.0, 10.0), settings=Settings(up="Z")),
        Wind("1", (1.0, 0.0, 0.0), table=((0.0, 0.0), (10.0, 500.0)), shape=1.0),
    )
    assert found.height[0].tolist() == [0.0, 10.0]
    assert found.load[0] == pytest.approx([250.0 * 0.4, 0.0, 0.0], rel=1e-14)


def test_table_is_averaged_over_the_rise_exactly() -> None:
    wind = replace(EVEN, table=((2.0, 100.0), (4.0, 500.0), (8.0, 900.0)))
    # 2 m at 100, then to 500 over 2 m, to 900 over 4 m, 2 m at 900
    assert simple(wind, rise=10.0) == pytest.approx((200 + 600 + 2800 + 1800) / 10, rel=1e-14)
    assert simple(wind, rise=-1.0, start=3.0) == pytest.approx(200.0, rel=1e-13)
    assert simple(wind, rise=3.0, start=20.0) == pytest.approx(900.0, rel=1e-13)


def test_step_of_a_table_is_kept() -> None:
    wind = replace(EVEN, table=((0.0, 400.0), (5.0, 400.0), (5.0, 700.0), (9.0, 700.0)))
    assert simple(wind, rise=8.0) == pytest.approx((5 * 400 + 3 * 700) / 8, rel=1e-14)


def test_ground_shifts_the_elevations() -> None:
    wind = replace(EVEN, table=((0.0, 0.0), (10.0, 1000.0)), ground=-3.0)
    assert blown(line((6.0, 0.0, 0.0)), wind).pressure[0] == pytest.approx(300.0, rel=1e-14)


@pytest.mark.parametrize("exposure", ["B", "C", "D"])
def test_nearly_level_pipe_agrees_with_level_and_sloping_ones(exposure: str) -> None:
    wind = Wind("1", (0.0, 0.0, 1.0), speed=50.0, exposure=exposure, ground=-30.0)
    level, tiny, small = (
        blown(line((6.0, rise, 0.0)), wind).pressure[0] for rise in (0.0, 9e-5, 1.1e-4)
    )
    assert tiny == pytest.approx(level, rel=1e-6)
    assert small == pytest.approx(level, rel=1e-6)


def test_pressure_of_a_speed_is_that_of_the_standard_atmosphere() -> None:
    assert pressure_of(40.0) == pytest.approx(980.0, rel=1e-14)


def test_unit_resultant_of_a_quarter_bend_in_the_wind() -> None:
    # t = (cos, sin): n = (sin^2, -sin cos), |n| = sin; R int |n| n = R (2/3, -1/3)
    made = line((4.0, 0.0, 0.0), (0.0, 0.0, 3.0), bends=[Bend("20", 0.45)])
    system = build_system(made)
    found = wind_load(made, system, replace(EVEN, direction=(1.0, 0.0, 0.0)))
    (arc,) = np.flatnonzero(system.kind == ARC)
    resultant = found.load[arc] * system.length[arc]
    expected = 200.0 * 0.45 * np.array([2 / 3, 0.0, -1 / 3])
    assert resultant == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_wind_across_the_plane_of_a_bend_is_that_on_its_length() -> None:
    made = line((4.0, 0.0, 0.0), (0.0, 3.0, 0.0), bends=[Bend("20", 0.45)])
    found = blown(made)
    assert found.load == pytest.approx(np.tile([0.0, 0.0, 200.0], (3, 1)), rel=1e-12, abs=1e-11)


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_arcs_resultant_is_that_of_many_chords(seed: int) -> None:
    """Rising arcs across the knee of ASCE 7 and of a table (worst of these 3e-5)."""
    random = np.random.default_rng(seed)
    near, far = random.normal(size=(2, 3))
    far -= 1.2 * (near @ far) / (near @ near) * near  # turns by more than a right angle
    near, far = 30.0 * near / np.linalg.norm(near), 30.0 * far / np.linalg.norm(far)
    made = line(tuple(near.tolist()), tuple(far.tolist()), bends=[Bend("20", 2.0)])
    system = build_system(made)
    (arc,) = np.flatnonzero(system.kind == ARC)
    toward = random.normal(size=3)
    toward /= np.linalg.norm(toward)
    middle = float(system.xyz[system.ends[arc], 1].mean())
    kz = Wind("1", tuple(toward), speed=45.0, ground=middle - 4.572)
    table = replace(EVEN, direction=tuple(toward), ground=middle)
    table = replace(table, table=((-5.0, 500.0), (0.0, 600.0), (5.0, 1500.0)))
    for wind in (kz, table):
        found = wind_load(made, system, wind)
        chords = _by_chords(system, int(arc), wind, toward)
        size = float(np.linalg.norm(chords))
        assert np.linalg.norm(found.load[arc] - chords) < 1e-4 * size


def _by_chords(system: System, arc: int, wind: Wind, toward: np.ndarray) -> np.ndarray:
    """Load per length of an arc [N/m] by the middles of 2 000 pieces, written out apart."""
    n = 2000
    turned = (np.arange(n) + 0.5) / n * system.angle[arc]
    ex, ey = system.axes[arc, 0], system.axes[arc, 1]
    first = system.xyz[system.ends[arc, 0]]
    total = np.zeros(3)
    for f in turned:
        x = first + system.radius[arc] * (math.sin(f) * ex + (1 - math.cos(f)) * ey)
        tangent = math.cos(f) * ex + math.sin(f) * ey
        z = x[1] - wind.ground
        if wind.speed is None:
            q = float(np.interp(z, *np.array(wind.table).T)) * wind.shape
        else:
            kz = 2.01 * (max(z, 4.572) / 274.32) ** (2 / 9.5)
            q = 0.613 * kz * wind.speed**2 * wind.gust * wind.shape
        normal = toward - (toward @ tangent) * tangent
        total += q * 0.4 * math.sqrt(normal @ normal) * normal
    return total / n


def test_bend_and_straights_meet_the_whole_projected_force() -> None:
    """In-plane wind on a turned pipe: what the pieces carry is what each sees, nothing lost."""
    made = line((4.0, 0.0, 0.0), (0.0, 0.0, 3.0), bends=[Bend("20", 0.45)])
    system = build_system(made)
    got = case_loads(
        replace_winds(made, replace(EVEN, direction=(1.0, 0.0, 0.0))), system, case("WIND1")
    )
    total = (got.dist * system.length[:, None]).sum(axis=0)
    assert total == pytest.approx([200 * (3 - 0.45 + 0.3), 0.0, -200 * 0.15], rel=1e-12, abs=1e-10)


def replace_winds(made: Model, *winds: Wind) -> Model:
    made.winds = list(winds)
    return made


def case(*terms: str | Term, **more: object) -> Case:
    given = tuple(Term(1.0, t) if isinstance(t, str) else t for t in terms)
    return Case("C", given, **more)  # type: ignore[arg-type]


def test_exposure_holds_below_15_ft_and_above_the_gradient_height() -> None:
    low, knee, top, high = exposure_coefficient(np.array([-3.0, 4.572, 274.32, 900.0]), "C")
    assert low == knee
    assert top == high == 2.01


@pytest.mark.parametrize("exposure", ["B", "C", "D"])
def test_exposure_integral_differentiates_to_the_coefficient(exposure: str) -> None:
    z = np.array([-2.0, 1.0, 6.0, 40.0, 150.0, 500.0])
    slope = exposure_integral(z + 0.01, exposure) - exposure_integral(z - 0.01, exposure)
    assert slope / 0.02 == pytest.approx(exposure_coefficient(z, exposure), rel=1e-7)
    around = exposure_integral(np.array([4.572 - 1e-9, 4.572 + 1e-9]), exposure)
    assert around[1] - around[0] == pytest.approx(0.0, abs=1e-8)


def test_example_by_hand() -> None:
    """Tables 26.6-1, 26.10-1, 26.11-1, Eqs. 26.10-1 and 29.4-1: C, 10 m, 40 m/s, 0.4 m wide.

    Kz = 2.01 (10/274.32)^(2/9.5) = 1.00094; qz = 0.613 x 1.00094 x 40^2 = 981.7 Pa;
    f = 981.7 x 0.85 x 0.7 x 0.4 = 233.6 N/m.
    """
    wind = Wind("1", (0.0, 0.0, 1.0), speed=40.0, ground=-10.0)
    found = blown(line((6.0, 0.0, 0.0)), wind)
    assert found.pressure[0] == pytest.approx(981.7, abs=0.05)
    assert found.load[0, 2] == pytest.approx(233.6, abs=0.05)


def test_kzt_and_kd_multiply_the_pressure() -> None:
    made = line((6.0, 0.0, 0.0))
    wind = Wind("1", (0.0, 0.0, 1.0), speed=40.0)
    ratio = blown(made, replace(wind, kzt=1.2, kd=0.95)).load[0, 2] / blown(made, wind).load[0, 2]
    assert ratio == pytest.approx(1.14, rel=1e-14)


def test_factors_of_asce_7_do_not_touch_a_table() -> None:
    made = line((6.0, 0.0, 0.0))
    other = replace(EVEN, kzt=3.0, kd=0.1, gust=0.2, exposure="D")
    assert blown(made, other).load.tolist() == blown(made).load.tolist()


def test_valve_takes_its_own_section_and_a_construction_aid_nothing() -> None:
    valve = Section("V", 0.6, 0.02)
    made = line((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    made.sections["V"] = valve
    made.pipes[1] = replace(made.pipes[1], rigid=True, weight=5000.0, section="V")
    made.pipes[2] = replace(made.pipes[2], rigid=True)
    assert blown(made).load[:, 2] == pytest.approx([200.0, 300.0, 0.0], rel=1e-14)


def test_springs_catch_no_wind_and_no_snow() -> None:
    made = line((1.0, 0.0, 0.0), springs=[Spring("20", "30", (1e6,) * 6)], snows=[Snow(50.0)])
    made.supports.append(Support("30", "anchor"))
    system = build_system(made)
    assert not wind_load(made, system, EVEN).load[1].any()
    assert case_loads(made, system, case("S")).dist.tolist() == [[0, -50, 0], [0, 0, 0]]


def test_sets_add_with_factors() -> None:
    made = line((6.0, 0.0, 0.0), snows=[Snow(50.0), Snow(25.0)])
    replace_winds(made, EVEN, replace(EVEN, set="2", direction=(0.0, 1.0, 0.0)))
    got = case_loads(made, build_system(made), case("WIND1", Term(-0.5, "WIND2"), Term(2.0, "S")))
    assert got.dist[0] == pytest.approx([0.0, -100.0 - 150.0, 200.0], rel=1e-13)


@pytest.mark.parametrize("name", ["WIND1", "WIND", "S"])
def test_set_that_nothing_gives_is_named(name: str) -> None:
    made = line((6.0, 0.0, 0.0), cases=[case("W", name)])
    with pytest.raises(ModelError, match=f"CASE C: nothing in the model gives {name}"):
        load_sets(made, build_system(made))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"direction": (0.0, 0.0, 0.0)}, "WIND1: the wind has no direction"),
        ({"table": ()}, "WIND1: give either a table or a speed"),
        ({"speed": 40.0}, "WIND1: give either a table or a speed"),
        ({"table": ((5.0, 1.0), (0.0, 2.0))}, "WIND1: the elevations do not ascend"),
        ({"table": ((0.0, -1.0),)}, "WIND1: elevations must be finite and pressures not neg"),
        ({"shape": 0.0}, "WIND1: the shape factor 0 is not positive"),
        ({"table": (), "speed": 40.0, "exposure": "A"}, "exposure A is not one of B C D"),
        ({"table": (), "speed": -1.0}, "WIND1: speed -1 is not positive"),
    ],
)
def test_impossible_wind_is_named(change: dict[str, object], said: str) -> None:
    made = replace_winds(line((6.0, 0.0, 0.0)), replace(EVEN, **change))  # type: ignore[arg-type]
    with pytest.raises(ModelError, match=said):
        load_sets(made, build_system(made))


def test_set_given_twice_is_named() -> None:
    made = replace_winds(line((6.0, 0.0, 0.0)), EVEN, EVEN)
    with pytest.raises(ModelError, match="WIND1: the set is given twice"):
        load_sets(made, build_system(made))


def test_uneven_pressure_along_an_element_is_said_and_a_node_helps() -> None:
    wind = Wind("1", (0.0, 0.0, 1.0), speed=50.0, shape=1.2)
    whole = replace_winds(line((0.0, 30.0, 0.0)), wind)
    (warning,) = case_warnings(load_sets(whole, build_system(whole)), case("WIND1"))
    assert warning.startswith("WIND1: the pressure changes by 39% along 10-20: the mean acts")
    split = replace_winds(line(*[(0.0, 1.2, 0.0)] * 25), wind)
    assert case_warnings(load_sets(split, build_system(split)), case("WIND1")) == ()


def test_splitting_a_riser_keeps_the_force() -> None:
    wind = Wind("1", (0.0, 0.0, 1.0), speed=50.0)
    whole = blown(line((0.0, 30.0, 0.0)), wind)
    split = blown(line((0.0, 3.0, 0.0), (0.0, 27.0, 0.0)), wind)
    assert split.load[:, 2] @ [3.0, 27.0] == pytest.approx(30.0 * whole.load[0, 2], rel=1e-13)


def test_small_pipes_with_a_low_force_coefficient_are_counted() -> None:
    small = {"S": Section("S", 0.06, 0.004)}
    wind = Wind("1", (0.0, 0.0, 1.0), speed=50.0)
    made = replace_winds(line((6.0, 0.0, 0.0), sections=small), wind)
    (warning,) = case_warnings(load_sets(made, build_system(made)), case("WIND1"))
    assert "1 element with D sqrt(q) up to 5.3" in warning
    made.winds = [replace(wind, shape=1.2)]
    assert case_warnings(load_sets(made, build_system(made)), case("WIND1")) == ()


def test_report_states_every_factor_and_load() -> None:
    made = line((0.0, 12.0, 0.0), snows=[Snow(50.0)])
    wind = Wind(
        "1", (1.0, 0.0, 0.0), speed=50.0, exposure="D", kzt=1.2, kd=0.95, gust=0.9, shape=0.8
    )
    replace_winds(made, wind, replace(EVEN, set="2", table=((0.0, 500.0), (10.0, 900.0))))
    text = wind_echo(made, build_system(made), report_units(Units("mm", "N", "bar", "C")))
    for said in (
        "V = 50 m/s, exposure D: alpha = 11.5, zg = 213.36 m; ground at 0.000 mm",
        "Kzt = 1.2, Kd = 0.95, Ke = 1, G = 0.9, Cf = 0.8",
        "q = 0.613 Kz Kzt Kd Ke V2 (SI)",
        "Cf = 0.5, ground at 0.000 mm, q linear between heights",
        "50.000 N/m downwards on every length of pipe",
    ):
        assert said in text
    rows = [row.split() for row in text.splitlines() if row.startswith("  10 ")]
    load, pressure = (blown(made, w).load[0, 0] for w in made.winds), blown(made, wind).pressure[0]
    assert [float(row[-3]) for row in rows] == pytest.approx([*load], abs=0.0006)
    kz, q = float(rows[0][4]), float(rows[0][5])
    assert q == pytest.approx(pressure, abs=0.051)
    assert 0.613 * kz * 1.2 * 0.95 * 50.0**2 == pytest.approx(q, rel=1e-4)


def test_supports_carry_the_wind() -> None:
    made = line((0.0, 12.0, 0.0), (4.0, 0.0, 0.0), bends=[Bend("20", 0.45)])
    made.cases = [case("WIND1", snubbers="FREE")]
    replace_winds(made, Wind("1", (1.0, 0.0, 1.0), speed=50.0))
    result = trunnion.solve(made)["C"]
    assert result.state is not None
    system = result.system
    total = (blown(made, made.winds[0]).load * system.length[:, None]).sum(axis=0)
    assert result.converged
    assert result.state.end_force[0, 0, :3] == pytest.approx(-total, rel=1e-10)
