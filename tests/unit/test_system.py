"""A model as arrays: numbers, elements, contacts, sliders, and what is refused."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from trunnion.arrays import ARC, SPRING, STRAIGHT, System
from trunnion.errors import ModelError
from trunnion.model import (
    Bend,
    Direction,
    Displacement,
    Force,
    Mass,
    Material,
    Model,
    Operation,
    Pipe,
    Place,
    Section,
    Settings,
    Spring,
    Support,
    TablePoint,
)
from trunnion.system import build_system, hot_system
from trunnion.system.lines import branch_name, branches, line_of, moving_part
from trunnion.system.vectors import upright

STEEL = Material("A", 203e9, 0.3, 11.7e-6, 7850.0)
HDR = Section("S", 0.2731, 0.00927)
INF = math.inf


def pipe(a: str, b: str, *d: float, rigid: bool = False, t1: float = 170.0) -> Pipe:
    operation = Operation({"1": t1}, {"1": 2e6, "2": 3e6})
    return Pipe(a, b, d, "S", "A", operation, rigid)  # type: ignore[arg-type]


def model(*pipes: Pipe, bends: tuple[Bend, ...] = (), **settings: Any) -> Model:
    made = Model(materials={"A": STEEL}, sections={"S": HDR}, pipes=list(pipes), bends=[*bends])
    made.settings = Settings(**settings)
    return made


def support(node: str, *words: str | Direction, **more: object) -> Support:
    directions = tuple(Direction(w) if isinstance(w, str) else w for w in words)
    return Support(node, "support", directions, **more)  # type: ignore[arg-type]


def line(
    *words: str | Direction, along: tuple[float, float, float] = (6, 0, 0), **settings: Any
) -> System:
    """Two pipes in line, a support with `words` between them."""
    made = model(pipe("10", "20", *along), pipe("20", "30", *along), **settings)
    made.supports = [support("20", *words)]
    return build_system(made)


ELBOW = (pipe("10", "30", 5, 0, 0), pipe("30", "40", 0, 0, 4))


# numbers and elements


def test_elements_follow_the_deck_with_the_bend_after_its_first_pipe() -> None:
    system = build_system(model(*ELBOW, bends=(Bend("30", 0.5),)))
    assert system.labels == ("10", "30N", "30F", "40")
    assert system.ends.tolist() == [[0, 1], [1, 2], [2, 3]]
    assert system.kind.tolist() == [STRAIGHT, ARC, STRAIGHT]
    assert system.alias == {"30": 2}
    assert system.mid == {"30M": 1}
    assert [p.type for p in system.parts] == ["pipe", "bend", "pipe"]
    assert system.length == pytest.approx([4.5, 0.25 * math.pi, 3.5], rel=1e-15)
    assert system.source.tolist() == [0, 0, 1]


@pytest.mark.parametrize("what", ["support", "mass", "force", "displacement", "pipe", "spring"])
def test_middle_of_a_bend_is_a_node_when_anything_stands_there(what: str) -> None:
    made = model(*ELBOW, bends=(Bend("30", 0.5),))
    if what == "support":
        made.supports = [support("30M", "+Y")]
    elif what == "mass":
        made.masses = [Mass("30M", 10.0)]
    elif what == "force":
        made.forces = [Force("30M", "1", (1.0,) * 6)]
    elif what == "displacement":
        made.displacements = [Displacement("30M", "1", (0.0, *(None,) * 5))]
    elif what == "pipe":
        made.pipes.append(pipe("30M", "50", 0, 1, 0))
    else:
        made.springs = [Spring("30M", "50", (1.0,) * 6)]
    system = build_system(made)
    arcs = np.flatnonzero(system.kind == ARC)
    assert [(system.parts[e].start, system.parts[e].end) for e in arcs] == [
        ("30N", "30M"),
        ("30M", "30F"),
    ]
    assert system.mid == {}
    assert system.angle[arcs] == pytest.approx([math.pi / 4] * 2)
    ends = system.xyz[system.ends[arcs]]
    assert np.linalg.norm(ends[0, 1] - ends[0, 0]) == pytest.approx(
        np.linalg.norm(ends[1, 1] - ends[1, 0]), rel=1e-12
    )


def test_arc_axes_lead_from_its_first_to_its_second_end() -> None:
    made = model(pipe("1", "2", 3, 1, 0), pipe("2", "3", 1, 2, 2), bends=(Bend("2", 0.4),))
    made.supports = [support("2M", "+Y")]
    system = build_system(made)
    for e in np.flatnonzero(system.kind == ARC):
        (ex, ey, ez), r, turn = system.axes[e], system.radius[e], system.angle[e]
        start, end = system.xyz[system.ends[e]]
        reached = start + r * math.sin(turn) * ex + r * (1 - math.cos(turn)) * ey
        assert reached == pytest.approx(end, abs=1e-14)
        assert np.cross(ex, ey) == pytest.approx(ez, abs=1e-15)


def test_back_to_back_bends_share_a_node_under_both_labels() -> None:
    made = model(pipe("1", "2", 3, 0, 0), pipe("2", "3", 0, 0, 1), pipe("3", "4", 3, 0, 0))
    made.bends = [Bend("2", 0.5), Bend("3", 0.5)]
    system = build_system(made)
    assert system.kind.tolist() == [STRAIGHT, ARC, ARC, STRAIGHT]
    node = dict(zip(system.labels, range(9), strict=False)) | system.alias
    assert node["2F"] == node["3N"] == node["2"]
    assert len(system.labels) == 5


def test_tangent_used_up_leaves_the_plain_label_at_the_bend() -> None:
    made = model(pipe("1", "2", 0.5, 0, 0), pipe("2", "3", 0, 0, 4), bends=(Bend("2", 0.5),))
    made.supports = [Support("1", "anchor")]
    system = build_system(made)
    assert system.labels == ("1", "2F", "3")
    assert system.alias["2N"] == 0
    assert system.contacts.node.tolist() == [0] * 6


def test_rigidity_is_of_the_tube_and_shear_may_be_off() -> None:
    a = math.pi / 4 * (0.2731**2 - (0.2731 - 2 * 0.00927) ** 2)
    i = math.pi / 64 * (0.2731**4 - (0.2731 - 2 * 0.00927) ** 4)
    g = 203e9 / 2.6
    got = build_system(model(pipe("1", "2", 1, 0, 0))).rigidity[0]
    assert got == pytest.approx([203e9 * a, 2 * g * i, 203e9 * i, g * a / 2], rel=1e-14)
    assert build_system(model(pipe("1", "2", 1, 0, 0), shear=False)).rigidity[0, 3] == 0.0


def test_rigid_has_ten_walls_on_the_same_bore() -> None:
    system = build_system(model(pipe("1", "2", 1, 0, 0, rigid=True)))
    assert system.wall[0] == pytest.approx(0.0927)
    assert system.od[0] - 2 * system.wall[0] == pytest.approx(0.2731 - 2 * 0.00927)
    assert system.parts[0].type == "rigid"


@pytest.mark.parametrize(("stiffen", "pressure"), [("OFF", 0.0), ("P1", 2e6), ("MAX", 3e6)])
def test_bends_stiffen_by_the_pressure_chosen(stiffen: str, pressure: float) -> None:
    system = build_system(model(*ELBOW, bends=(Bend("30", 0.5),), stiffen=stiffen))
    r, t = 0.5 * (0.2731 - 0.00927), 0.00927
    k = 1.65 * r**2 / (t * 0.5)
    k /= 1 + 6 * pressure / 203e9 * (r / t) ** (7 / 3) * (0.5 / r) ** (1 / 3)
    assert system.flex.tolist() == pytest.approx([1.0, k, 1.0], rel=1e-13)


def test_springs_keep_their_own_axes_and_stiffnesses() -> None:
    made = model(pipe("10", "20", 6, 0, 0))
    k = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    made.springs = [Spring("20", "30", k), Spring("30", "40", k, axis=(0.0, 0.0, 2.0))]
    system = build_system(made)
    assert system.kind.tolist() == [STRAIGHT, SPRING, SPRING]
    assert system.axes[1].tolist() == np.eye(3).tolist()
    assert system.axes[2] == pytest.approx(np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]))
    assert system.spring[2].tolist() == list(k)
    assert system.length[1:].tolist() == [0.0, 0.0]
    assert system.rigidity[1:].tolist() == [[0.0] * 4] * 2


def test_model_of_springs_alone_stands_at_the_origin() -> None:
    made = Model(supports=[Support("1", "spring", ks=(1.0, 1.0, 0, 0, 0, 0)), support("1", "X")])
    system = build_system(made)
    assert system.labels == ("1",)
    assert system.ends.shape == (0, 2)
    assert system.contacts.word == ("KX", "KY", "X")


def test_straight_axes_agree_with_the_rule_for_one_vector() -> None:
    rng = np.random.default_rng(20)
    made = model(*(pipe(str(i), str(i + 1), *rng.normal(size=3)) for i in range(20)))
    made.pipes += [pipe("20", "21", 0, 2, 0), pipe("21", "22", 0, -2, 0)]
    system = build_system(made)
    for p, axes in zip(made.pipes, system.axes, strict=True):
        assert p.delta is not None
        ex = tuple(np.array(p.delta) / np.linalg.norm(p.delta))
        assert axes == pytest.approx(np.array(upright(ex, (0, 1, 0))), abs=1e-14)
        assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-14)
        assert axes[1, 1] >= -1e-15


def test_length_of_a_short_pipe_far_away_keeps_its_digits() -> None:
    made = model(pipe("1", "2", 1e4 / 3, 1e4 / 7, 0), pipe("2", "3", 0.005, 0, 0))
    system = build_system(made)
    assert system.length[1] == 0.005
    assert system.axes[1, 0].tolist() == [1.0, 0.0, 0.0]


def test_hot_modulus_is_interpolated_from_the_table() -> None:
    made = model(pipe("1", "2", 1, 0, 0), pipe("2", "3", 1, 0, 0, t1=20.0))
    table = (TablePoint(100.0, e=198e9), TablePoint(200.0, e=192e9))
    made.materials["A"] = replace(STEEL, table=table)
    cold = build_system(made)
    hot = hot_system(made, cold, "1")
    assert hot.rigidity[0] == pytest.approx(cold.rigidity[0] * 193.8 / 203, rel=1e-14)
    assert hot.rigidity[1] == pytest.approx(cold.rigidity[1], rel=1e-15)
    made.pipes[0] = pipe("1", "2", 1, 0, 0, t1=201.0)
    with pytest.raises(ModelError, match="MATERIAL A: E=HOT with T1: 201 C is outside the table"):
        hot_system(made, cold, "1")


# contacts


@pytest.mark.parametrize(
    ("word", "normal", "gap"),
    [
        ("Y", (0, 1, 0), (0.001, 0.002)),
        ("+Y", (0, 1, 0), (0.001, INF)),
        ("-Y", (0, 1, 0), (INF, 0.002)),
        ("+Z", (0, 0, 1), (0.001, INF)),
        ("RX", (1, 0, 0), (0.001, 0.002)),
    ],
)
def test_words_give_normals_and_sides(
    word: str, normal: tuple[float, ...], gap: tuple[float, float]
) -> None:
    c = line(Direction(word, gap=(0.001, 0.002))).contacts
    assert c.normal[0, 0].tolist() == list(normal)
    assert tuple(c.gap[0]) == gap
    assert not c.two_way[0]
    assert c.rotational[0] == word.startswith("R")


def test_skew_direction_is_normalised_and_one_way_by_its_sign() -> None:
    c = line(
        Direction("+(0,3,4)", vector=(0, 3, 4)), Direction("(1,1,0)", vector=(1, 1, 0))
    ).contacts
    assert c.normal[0, 0] == pytest.approx([0, 0.6, 0.8], rel=1e-15)
    assert c.gap.tolist() == [[0, INF], [0, 0]]
    assert c.two_way.tolist() == [False, True]


def test_penalty_marks_the_default_stiffness_only() -> None:
    c = line("Y", Direction("X", k=2e6), "RX", k=3e11, kr=4e11).contacts
    assert c.k.tolist() == [3e11, 2e6, 4e11]
    assert c.penalty.tolist() == [True, False, True]


@pytest.mark.parametrize(
    ("along", "guide", "limit"),
    [
        ((6, 0, 0), (0, 0, 1), (1, 0, 0)),
        ((-6, 0, 0), (0, 0, 1), (1, 0, 0)),
        ((0, 0, 6), (1, 0, 0), (0, 0, 1)),
        ((3, 0, -4), (0.8, 0, 0.6), (-0.6, 0, 0.8)),
        ((4, 0, -4), (0.5**0.5, 0, 0.5**0.5), (0.5**0.5, 0, -(0.5**0.5))),
        ((3, 4, 0), (0, 0, 1), (0.6, 0.8, 0)),
    ],
)
def test_guide_and_limit_follow_the_pipe_not_its_direction(
    along: tuple[float, float, float], guide: tuple[float, ...], limit: tuple[float, ...]
) -> None:
    for sense in (1, -1):
        turned = (sense * along[0], sense * along[1], sense * along[2])
        c = line("GUIDE", "LIMIT", along=turned).contacts
        assert c.normal[:, 0] == pytest.approx(np.array([guide, limit]), abs=1e-15)
        assert c.dim.tolist() == [1, 1]


@pytest.mark.parametrize(("lean", "dim"), [(0.0, 2), (4.99, 2), (5.01, 1)])
def test_guide_holds_a_vertical_pipe_all_round(lean: float, dim: int) -> None:
    tilt = math.radians(lean)
    system = line(
        Direction("GUIDE", gap=(0.002, 0.002), mu=0.3),
        along=(6 * math.sin(tilt), 6 * math.cos(tilt), 0),
    )
    assert system.contacts.dim[0] == dim
    if dim == 2:
        assert system.contacts.normal[0].tolist() == [[1, 0, 0], [0, 0, 1]]
        assert abs(system.sliders.basis[0]).tolist() == [[0, 1, 0], [0, 0, 0]]


def test_guide_with_z_up_holds_the_other_horizontals() -> None:
    assert line("GUIDE", up="Z").contacts.normal[0, 0].tolist() == [0, 1, 0]
    system = line("GUIDE", along=(0, 0, 3), up="Z")
    assert system.contacts.normal[0].tolist() == [[1, 0, 0], [0, 1, 0]]


def corner_guide(along: str | None) -> System:
    made = model(pipe("10", "20", 6, 0, 0), pipe("20", "30", 0, 0, 6))
    made.supports = [support("20", Direction("GUIDE", along=along))]
    return build_system(made)


def test_guide_at_a_corner_asks_which_pipe() -> None:
    with pytest.raises(ModelError, match=r"SUPPORT 20: GUIDE: .* turn there; .* 10-20, 20-30"):
        corner_guide(None)
    assert corner_guide("10-20").contacts.normal[0, 0].tolist() == [0, 0, 1]
    assert corner_guide("30-20").contacts.normal[0, 0].tolist() == [1, 0, 0]
    with pytest.raises(ModelError, match="ALONG=20-40 is not a pipe at node 20; there are 10-20"):
        corner_guide("20-40")


@pytest.mark.parametrize(
    ("node", "axis"), [("30N", (1, 0, 0)), ("30M", (0.5**0.5, 0, 0.5**0.5)), ("30", (0, 0, 1))]
)
def test_limit_on_a_bend_follows_the_arc(node: str, axis: tuple[float, ...]) -> None:
    made = model(*ELBOW, bends=(Bend("30", 0.5),))
    made.supports = [support(node, "LIMIT")]
    assert build_system(made).contacts.normal[0, 0] == pytest.approx(axis, abs=1e-15)


def test_anchor_holds_six_freedoms_two_ways() -> None:
    made = model(pipe("10", "20", 6, 0, 0), mu=0.3)
    made.supports = [Support("10", "anchor", kr=5e6)]
    system = build_system(made)
    c = system.contacts
    assert c.two_way.all()
    assert c.k.tolist() == [1e12] * 3 + [5e6] * 3
    assert c.penalty.tolist() == [True] * 3 + [False] * 3
    assert c.rotational.tolist() == [False] * 3 + [True] * 3
    assert len(system.sliders.mu) == 0


def test_hanger_and_ground_spring_are_no_penalties() -> None:
    made = model(pipe("10", "20", 6, 0, 0), mu=0.3)
    made.supports = [
        Support("10", "hanger", k=1e5, load=9e3),
        Support("20", "spring", ks=(1.0, 0, 0, 0, 0, 6.0), axis=(0, 0, 1)),
    ]
    system = build_system(made)
    c = system.contacts
    assert c.word == ("Y", "KX", "KRZ")
    assert c.k.tolist() == [1e5, 1, 6]
    assert c.normal[:, 0] == pytest.approx(np.array([[0, 1, 0], [0, 0, 1], [-1, 0, 0]]))
    assert not c.penalty.any()
    assert len(system.sliders.mu) == 0


def test_cnode_is_numbered() -> None:
    made = model(pipe("10", "20", 6, 0, 0), pipe("20", "30", 6, 0, 0))
    made.supports = [support("10", "+Y", cnode="30")]
    system = build_system(made)
    assert (system.contacts.node[0], system.contacts.cnode[0]) == (0, 2)


def test_imposed_displacement_holds_a_free_node_and_moves_a_support() -> None:
    made = model(pipe("10", "20", 6, 0, 0), pipe("20", "30", 6, 0, 0))
    made.supports = [Support("10", "anchor")]
    made.displacements = [
        Displacement("10", "1", (0.01, *(None,) * 5)),
        Displacement("30", "1", (None, 0.01, *(None,) * 4)),
        Displacement("30", "2", (None, 0.0, None, None, None, 0.1)),
    ]
    system = build_system(made)
    assert [card.kind for card in system.cards] == ["anchor", "displacement"]
    assert system.contacts.word[6:] == ("Y", "RZ")
    assert system.contacts.penalty[6:].all()


# sliders


def test_each_rough_contact_slides_in_its_own_plane() -> None:
    made = line("+Y", Direction("GUIDE", mu=0.1), "RX", Direction("X", mu=0.0), mu=0.3)
    s = made.sliders
    assert s.mu.tolist() == [0.3, 0.1]
    assert s.contact.tolist() == [0, 1]
    assert s.first.tolist() == [0, 1, 2]
    for basis, contact in zip(s.basis, s.contact, strict=True):
        assert basis @ basis.T == pytest.approx(np.eye(2), abs=1e-15)
        assert basis @ made.contacts.normal[contact, 0] == pytest.approx([0, 0], abs=1e-15)


@pytest.mark.parametrize(
    ("words", "basis"),
    [
        (("+Y", "GUIDE"), [[1, 0, 0], [0, 0, 0]]),
        (("+Y", Direction("GUIDE", gap=(0.003, 0.003))), [[1, 0, 0], [0, 0, 1]]),
        (("+Y", Direction("Z", gap=(0.0, 0.003))), [[1, 0, 0], [0, 0, 0]]),
        ((Direction("Z", gap=(0.003, 0.003)),), [[1, 0, 0], [0, 1, 0]]),
    ],
)
def test_resultant_slides_where_nothing_touches(
    words: tuple[str | Direction, ...], basis: list[list[float]]
) -> None:
    s = line(*words, mu=0.3, friction="RESULTANT").sliders
    assert len(s.mu) == 1
    assert abs(s.basis[0]) == pytest.approx(np.array(basis), abs=1e-15)
    assert s.contact.tolist() == list(range(len(words)))


def test_resultant_takes_the_largest_mu_and_may_have_no_plane() -> None:
    rough = line("+Y", Direction("Z", mu=0.5), "RX", mu=0.3, friction="RESULTANT").sliders
    assert rough.mu.tolist() == [0.5]
    assert rough.contact.tolist() == [0, 1]
    assert len(line("X", "Y", "Z", mu=0.3, friction="RESULTANT").sliders.mu) == 0


def test_card_chooses_its_friction_law() -> None:
    words = (Direction("+Y", friction="RESULTANT"), Direction("GUIDE", friction="RESULTANT"))
    assert len(line(*words, mu=0.3).sliders.mu) == 1
    words = (Direction("+Y", friction="CONTACT"), Direction("GUIDE", friction="CONTACT"))
    assert len(line(*words, mu=0.3, friction="RESULTANT").sliders.mu) == 2


# refusals


def test_all_problems_are_told_at_once_with_their_places() -> None:
    made = model(pipe("10", "20", 6, 0, 0))
    made.supports = [
        replace(support("30", "+Y"), place=Place("a.inp", 5)),
        replace(support("20", Direction("Y", gap=(-1.0, 0.0))), place=Place("a.inp", 6)),
    ]
    made.forces = [Force("99", "1", (0.0,) * 6, Place("a.inp", 7))]
    with pytest.raises(ModelError) as caught:
        build_system(made)
    assert str(caught.value).splitlines() == [
        "a.inp:5: SUPPORT 30: node 30 is not defined",
        "a.inp:6: SUPPORT 20: Y: a gap is negative",
        "a.inp:7: FORCE 99: node 99 is not defined",
        "3 errors, nothing was solved",
    ]


def test_unknown_cnode_is_an_error_not_a_new_node() -> None:
    made = model(pipe("10", "20", 6, 0, 0))
    made.supports = [support("20", "+Y", cnode="21")]
    with pytest.raises(ModelError, match="SUPPORT 20: CNODE: node 21 is not defined"):
        build_system(made)


@pytest.mark.parametrize("stiffen", ["P3", "MAX"])
def test_stiffening_by_a_pressure_that_is_not_there_is_named(stiffen: str) -> None:
    made = model(*(replace(p, operation=Operation()) for p in ELBOW), bends=(Bend("30", 0.5),))
    made.settings = Settings(stiffen=stiffen)
    with pytest.raises(ModelError, match=f"STIFFEN={stiffen}: nothing in the model gives"):
        build_system(made)


def test_radial_guide_has_one_gap() -> None:
    with pytest.raises(ModelError, match="round a vertical pipe there is one radial gap"):
        line(Direction("GUIDE", gap=(0.001, 0.002)), along=(0, 6, 0))


# names of parts


def test_lines_branches_and_moving_parts_are_named() -> None:
    run = [pipe(str(a), str(b), 1, 0, 0) for a, b in pairwise(range(10, 60, 10))]
    made = model(*run, pipe("30", "70", 0, 1, 0), pipe("70", "80", 0, 1, 0))
    made.supports = [support("20", "+Y", cnode="200"), Support("200", "anchor")]
    system = build_system(made)
    node = dict(zip(system.labels, range(20), strict=False))
    assert line_of(system, node["70"]) == "line 10-80"
    assert line_of(system, node["200"]) == "node 200"
    names = {branch_name(system, chain) for chain in branches(system)}
    assert names == {"branch 10-30", "branch 30-50", "branch 30-80"}
    moves = np.isin(np.arange(len(system.labels)), [node["70"], node["80"]])
    assert moving_part(system, moves) == "branch 30-80"
    assert moving_part(system, np.ones(len(moves), bool)) == "line 10-80, node 200"


def test_closed_ring_is_one_branch() -> None:
    ring = [("1", "2", 1, 0), ("2", "3", 0, 1), ("3", "4", -1, 0), ("4", "1", 0, -1)]
    system = build_system(model(*(pipe(a, b, x, 0, z) for a, b, x, z in ring)))
    assert branches(system) == [[0, 1, 2, 3, 0]]
