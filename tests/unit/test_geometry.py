"""Coordinates of labels: along pipes, round loops, at bends."""

import math

import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError, ModelError
from trunnion.model import Bend, Material, Model, Node, Pipe, Place, Section, Spring, Support
from trunnion.system.bends import flexibility, nominal_diameter
from trunnion.system.geometry import Geometry, place

STEEL = Material("A", 203e9, 0.3, 11.7e-6, 7850.0)
HDR = Section("S", 0.2731, 0.00927)


def pipe(a: str, b: str, *d: float, line: int = 0) -> Pipe:
    return Pipe(a, b, d or None, "S", "A", place=Place("t.inp", line))  # type: ignore[arg-type]


def model(*pipes: Pipe, **more: object) -> Model:
    made = Model(materials={"A": STEEL}, sections={"S": HDR}, pipes=list(pipes))
    for key, value in more.items():
        setattr(made, key, value)
    return made


def placed(made: Model) -> Geometry:
    return place(made, [])


def test_first_start_is_the_origin_and_deltas_add_up() -> None:
    points = placed(model(pipe("10", "20", 1, 2, 3), pipe("30", "20", -1, 0, 0))).points
    assert points == {"10": (0, 0, 0), "20": (1, 2, 3), "30": (2, 2, 3)}


def test_node_card_places_the_line_from_any_node() -> None:
    made = model(pipe("10", "20", 1, 0, 0), pipe("20", "30", 0, 2, 0))
    made.nodes = [Node("30", (5.0, 5.0, 5.0))]
    assert placed(made).points["10"] == (4, 3, 5)


def test_pipe_between_placed_nodes_needs_no_delta() -> None:
    made = model(pipe("10", "20"), pipe("20", "30", 1, 0, 0))
    made.nodes = [Node("10", (0.0, 0.0, 0.0)), Node("20", (3.0, 4.0, 0.0))]
    assert placed(made).points["30"] == (4, 4, 0)


def test_line_without_coordinates_is_named() -> None:
    made = model(pipe("10", "20", 1, 0, 0), pipe("50", "60", 1, 0, 0, line=7))
    with pytest.raises(ModelError, match=r"t.inp:7: PIPE 50-60: nothing gives .* 50 and 60"):
        placed(made)


def test_nodes_of_a_spring_coincide_unless_placed() -> None:
    made = model(pipe("10", "20", 1, 0, 0), pipe("50", "60", 1, 0, 0))
    made.springs = [Spring("20", "50", (1.0,) * 6)]
    assert placed(made).points["60"] == (2, 0, 0)


def test_closed_loop_is_accepted_within_its_tolerance() -> None:
    square = [("1", "2", 1, 0), ("2", "3", 0, 1), ("3", "4", -1, 0), ("4", "1", 0, -1 + 0.9e-6)]
    placed(model(*(pipe(a, b, x, y, 0) for a, b, x, y in square)))


SQUARE = {("1", "2"): (1, 0), ("2", "3"): (0, 1), ("3", "4"): (-1, 0), ("4", "1"): (0, -1.001)}


@pytest.mark.parametrize(
    ("order", "said"),
    [
        ((0, 1, 2, 3), "PIPE 4-1: the loop does not close: 1-2-3-4-1 leaves from and comes back"),
        ((0, 1, 3, 2), "PIPE 3-4: the loop does not close: 1-4 and 1-2-3-4 reach 4, 1 mm apart"),
    ],
)
def test_open_loop_names_both_paths(order: tuple[int, ...], said: str) -> None:
    sides = [pipe(*ends, *d, 0) for ends, d in SQUARE.items()]
    with pytest.raises(ModelError, match=said) as caught:
        placed(model(*(sides[i] for i in order)))
    assert len(caught.value.problems) == 1


def test_node_card_that_disagrees_with_the_pipes_is_named() -> None:
    made = model(pipe("10", "20", 1, 0, 0), pipe("20", "30", 1, 0, 0))
    made.nodes = [Node("10", (0.0, 0.0, 0.0)), Node("30", (2.5, 0.0, 0.0))]
    with pytest.raises(ModelError, match="NODE card of 30 and the path 10-20-30 reach 30, 500 mm"):
        placed(made)


def test_bend_points_of_a_quarter_turn() -> None:
    made = model(pipe("10", "30", 5, 0, 0), pipe("30", "40", 0, 0, 4), bends=[Bend("30", 0.5)])
    geometry = placed(made)
    points = geometry.points
    s = 0.5 * math.sqrt(0.5)
    assert points["30N"] == pytest.approx((4.5, 0, 0), abs=1e-15)
    assert points["30M"] == pytest.approx((4.5 + s, 0, 0.5 - s), abs=1e-15)
    assert points["30F"] == pytest.approx((5, 0, 0.5), abs=1e-15)
    assert points["30"] == points["30F"]
    assert points["40"] == (5, 0, 4)
    assert geometry.corners["30"].angle == pytest.approx(math.pi / 2, rel=1e-15)


@pytest.mark.parametrize("degrees", [1e-3, 22.5, 90.0, 135.0, 170.0])
def test_points_of_any_bend_lie_on_its_circle(degrees: float) -> None:
    turn = math.radians(degrees)
    second = pipe("30", "40", 9 * math.cos(turn), 9 * math.sin(turn), 0)
    c = placed(model(pipe("10", "30", 9, 0, 0), second, bends=[Bend("30", 0.4)])).corners["30"]
    centre = tuple(n + 0.4 * x for n, x in zip(c.n, c.c, strict=True))
    for point in (c.n, c.m, c.f):
        assert math.dist(point, centre) == pytest.approx(0.4, rel=1e-12)
    assert c.tangent == pytest.approx(0.4 * math.tan(turn / 2), rel=1e-12)


@pytest.mark.parametrize(
    ("first", "second", "far"),
    [
        (("10", "30", 5, 0, 0), ("30", "40", 0, 4, 0), (5, 0.5, 0)),  # arrives, leaves
        (("30", "40", 0, 4, 0), ("10", "30", 5, 0, 0), (0, 0.5, 0)),  # leaves, arrives
        (("10", "30", 5, 0, 0), ("40", "30", 0, -4, 0), (5, 0.5, 0)),  # both arrive
        (("30", "40", 0, 4, 0), ("30", "10", -5, 0, 0), (-0.5, 0, 0)),  # both leave
    ],
)
def test_far_end_follows_the_deck(
    first: tuple[str, str, float, float, float],
    second: tuple[str, str, float, float, float],
    far: tuple[float, float, float],
) -> None:
    geometry = placed(model(pipe(*first), pipe(*second), bends=[Bend("30", 0.5)]))
    assert geometry.points["30F"] == pytest.approx(far, abs=1e-14)


def test_branches_start_at_bend_points() -> None:
    made = model(
        pipe("30M", "60", 1, 0, 0),
        pipe("10", "30", 5, 0, 0),
        pipe("30", "40", 0, 0, 4),
        pipe("30N", "50", 0, 1, 0),
        bends=[Bend("30", 0.5)],
    )
    made.nodes = [Node("10", (0.0, 0.0, 0.0))]
    points = placed(made).points
    assert points["50"] == pytest.approx((4.5, 1, 0), abs=1e-15)
    assert points["60"][0] == pytest.approx(points["30M"][0] + 1, abs=1e-15)


def test_bend_between_coordinates_waits_for_them() -> None:
    made = model(pipe("10", "30"), pipe("30", "40"), pipe("30N", "50", 0, 1, 0))
    made.bends = [Bend("30", 0.5)]
    made.nodes = [
        Node("10", (0.0, 0.0, 0.0)),
        Node("30", (5.0, 0.0, 0.0)),
        Node("40", (5.0, 0.0, 4.0)),
    ]
    assert placed(made).points["50"] == pytest.approx((4.5, 1, 0), abs=1e-15)


def test_bend_that_eats_its_tangent_is_named() -> None:
    made = model(pipe("10", "30", 0.4, 0, 0), pipe("30", "40", 0, 0, 4), bends=[Bend("30", 0.5)])
    with pytest.raises(ModelError, match=r"BEND 30: it needs 0.5 m of pipe 10-30, .* 0.4 m long"):
        placed(made)


def test_two_bends_that_share_a_short_pipe_are_named_once() -> None:
    made = model(pipe("1", "2", 3, 0, 0), pipe("2", "3", 0, 0, 0.9), pipe("3", "4", 3, 0, 0))
    made.bends = [Bend("2", 0.5), Bend("3", 0.5)]
    with pytest.raises(ModelError, match="the bends at 2 and 3 need 1 m of pipe 2-3") as caught:
        placed(made)
    assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    ("pipes", "said"),
    [
        ([pipe("10", "30", 5, 0, 0)], "joins two pipes"),
        ([pipe("10", "30", 5, 0, 0), pipe("30", "40", 3, 0, 0)], "are in line"),
        (
            [pipe("10", "30", 5, 0, 0), pipe("30", "40", 0, 3, 0), pipe("30", "50", 0, 0, 3)],
            "let branches start at 30N, 30M or 30F",
        ),
    ],
)
def test_impossible_bends_are_named(pipes: list[Pipe], said: str) -> None:
    with pytest.raises(ModelError, match=said):
        placed(model(*pipes, bends=[Bend("30", 0.5)]))


def test_bend_point_without_bend_is_named() -> None:
    with pytest.raises(ModelError, match="30M is a point of a bend at 30, and there is no bend"):
        placed(model(pipe("10", "30", 5, 0, 0), pipe("30M", "40", 0, 1, 0)))


def test_cnode_that_only_a_displacement_names_lies_at_its_support() -> None:
    made = model(pipe("10", "20", 5, 0, 0))
    made.supports = [Support("20", "anchor", cnode="120"), Support("120", "anchor")]
    assert placed(made).points["120"] == (5, 0, 0)


def test_long_radius_counts_nominal_diameters() -> None:
    assert nominal_diameter(0.2731) == pytest.approx(0.254)
    assert nominal_diameter(0.0603) == pytest.approx(0.0508)
    assert nominal_diameter(0.4064) == 0.4064
    assert nominal_diameter(0.25) == 0.25


S301 = Section("S", 0.4064, 0.00953)
GRADE_B = Material("A", 203.4e9)


@pytest.mark.parametrize(("pressure", "k"), [(3.45e6, 9.5061), (3.795e6, 9.36566)])
def test_stiffened_bend_of_b313_appendix_s(pressure: float, k: float) -> None:
    # k of the independent rebuilds of ASME B31.3 Appendix S, examples S301 and S302
    got = flexibility(Bend("30"), 0.6096, S301, GRADE_B, pressure)
    assert got == pytest.approx(k, abs=5e-5)


def test_flanges_reduce_the_flexibility_by_powers_of_h() -> None:
    h = 0.00953 * 0.6096 / 0.198435**2
    for flanges, power in ((0, 0.0), (1, 1 / 6), (2, 1 / 3)):
        got = flexibility(Bend("30", flanges=flanges), 0.6096, S301, GRADE_B, 0.0)
        assert got == pytest.approx(1.65 / h * h**power, rel=1e-12)


def test_thick_bend_is_no_stiffer_than_straight_pipe_and_own_k_stands() -> None:
    thick = Section("S", 0.1, 0.04)
    assert flexibility(Bend("30"), 0.5, thick, GRADE_B, 1e7) == 1.0
    assert flexibility(Bend("30", k=0.7), 0.6096, S301, GRADE_B, 1e7) == 0.7


@pytest.mark.parametrize(
    ("cards", "said"),
    [
        (
            "PIPE 1 2 DX=10\nPIPE 2 3 DZ=90\nBEND 2 R=12",
            "needs 12 in of pipe 1-2, which is 10 in",
        ),
        ("PIPE 1 2 DX=10\nPIPE 2 3 DZ=9\nPIPE 1 3 DX=10 DZ=9.5", "0.5 in apart"),
        ("SECTION B OD=4 WALL=3\nPIPE 1 2 DX=10", "half the outside diameter, 4 in"),
    ],
)
def test_errors_have_the_lengths_of_the_deck(cards, said):
    head = "UNITS in lbf psi F\nMATERIAL M E=29e6 DENSITY=.28\nSECTION S OD=6 WALL=.3\nANCHOR 1\n"
    with pytest.raises((DeckError, ModelError), match=said):
        trunnion.solve(read_text(f"{head}{cards}\nCASE A = W\n"))
