"""CAESAR II neutral files of our own, versions 7.01, 11.0 and 15.01: the model, field by field.

The files are written by `cii.Cii` from the format's description.  Numbers that are expected here
follow from the description of each file by hand; units are exact where the file's constant is one
of a known unit (25.4 is mm, 4.448 is N, 0.06895 is bar, 0.5556 and -17.7778 are C).
"""

import math
from dataclasses import replace

import pytest
from cii import ENGLISH, ENGLISH_LABELS, Cii
from cii_jobs import ANC, GUI, LIM, RESTING, VERSIONS, Y, crowded, everything, job, slot

import trunnion
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError
from trunnion.formats import Findings
from trunnion.formats.caesar import read
from trunnion.formats.source import source_of
from trunnion.model import Direction, HangerDesign, Joint, Operation, Uniform
from trunnion.system.geometry import place


def imported(cii, *, permissive=False, file="line.cii"):
    text = cii if isinstance(cii, str) else cii.text()
    source = source_of(text.encode("cp1252"), file)
    result = read(source, Findings(source, permissive=permissive))
    assert read_text(result.deck()) == result.model  # deck -> model is the identity
    assert read_text(result.deck()).deck() == result.model.deck()
    return result


def model_of(cii, **keys):
    return imported(cii, **keys).model


def problems_of(cii, **keys):
    with pytest.raises(DeckError) as caught:
        imported(cii, **keys)
    return [str(problem) for problem in caught.value.problems]


def job_of_one(**keys):
    c = job(**keys)
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    return c


@pytest.mark.parametrize("version", VERSIONS)
def test_title_units_and_settings(version):
    model = model_of(everything(version))
    assert model.title == "Hot oil header"
    units = model.units
    assert (units.length, units.force, units.pressure, units.temperature) == (
        *("mm", "N", "bar", "C"),
    )
    assert model.settings.up == "Y"
    assert model.settings.stiffen == "MAX"
    assert model.origin.format == f"CAESAR II neutral file, version {version:g}"


@pytest.mark.parametrize("version", VERSIONS)
def test_pipes_bends_and_rigids(version):
    model = model_of(everything(version))
    assert [(p.start, p.end, p.delta, p.rigid) for p in model.pipes] == [
        ("10", "20", (6.0, 0.0, 0.0), False),
        ("20", "30", (6.0, 0.0, 0.0), False),
        ("30", "40", (0.0, 0.0, 4.0), False),
        ("40", "50", (0.0, 0.0, 0.5), True),
        ("50", "60", (0.0, 0.0, 1.5), False),
        ("60", "70", (0.0, -3.0, 0.0), False),
        ("40", "71", (2.5, 0.0, 0.0), False),
    ]
    assert [(b.node, b.radius, b.flanges) for b in model.bends] == [
        ("30", 0.381, 0),
        ("60", 0.381, 1),
    ]
    assert all((b.k is None) == (version < 14) for b in model.bends)  # late ones: ASME B31J
    # the model adds contents and 1.75 times the insulation itself, as the original program does
    assert model.pipes[3].weight == 2100.0
    assert model.pipes[3].card == ("RIGID" if version < 8 else "VALVE")
    assert [(n.label, n.xyz) for n in model.nodes] == [("10", (0.0, 2.5, 0.0))]


@pytest.mark.parametrize("version", VERSIONS)
def test_sections_materials_and_operation(version):
    model = model_of(everything(version))
    header, branch = model.sections.values()
    assert (header.od, header.wall, header.corrosion) == (273.05 / 1e3, 9.271 / 1e3, 0.0015)
    assert (header.fluid, header.insulation, header.insulation_density) == (850.0, 0.075, 140.0)
    assert (branch.od, branch.wall, branch.insulation) == (114.3 / 1e3, 6.02 / 1e3, 0.0)
    carbon, stainless = model.materials.values()
    late = "-IID" if version > 12 else ""  # the data base of late versions has ASME II-D
    assert (carbon.name, carbon.grade) == ("A106-B", f"A106-B{late}")
    assert (carbon.nu, carbon.density) == (0.292, 7833.44)
    assert carbon.e == pytest.approx(203.4e9, rel=1e-3)  # the grade's, which is as near
    assert (stainless.name, stainless.grade) == ("A312-TP316", "A312-TP304")
    operation = Operation({"1": 170.0, "2": 90.0}, {"1": 12e5, "2": 6e5}, 21.1142)
    assert {p.operation for p in map(_hashable, model.pipes)} == {_hashable_op(operation)}


def _hashable(pipe):
    class Row:
        operation = _hashable_op(pipe.operation)

    return Row


def _hashable_op(op):
    return tuple(op.t.items()), tuple(op.p.items()), op.tref


@pytest.mark.parametrize("version", VERSIONS)
def test_supports_displacements_and_forces(version):
    model = model_of(everything(version))
    found = {(s.node, s.kind): s for s in model.supports}
    assert set(found) == {
        *(("10", "anchor"), ("20", "support"), ("40", "support"), ("30M", "support")),
        *(("50", "hanger"), ("71", "anchor")),
    }
    assert found["10", "anchor"].k is None
    assert found["20", "support"].directions == (Direction("+Y", mu=0.3),)
    assert found["20", "support"].name == ("PS-20" if version > 8 else None)
    along = "30-40"  # a branch leaves at 40, so the owner's direction is named
    assert found["40", "support"].directions == (
        Direction("GUIDE", None, (0.003, 0.003), None, None, 0.2, along),
        Direction("LIMIT", None, (0.01, 0.01), 2e6, None, None, along),  # 2e4 N/cm
    )
    assert found["30M", "support"].directions == (Direction("+Y", k=5e4),)
    hanger = found["50", "hanger"]
    assert (hanger.k, hanger.load) == (1e4, 8000.0)  # 100 N/cm
    half = math.radians(0.5)
    assert [(d.node, d.set) for d in model.displacements] == [("70", "1"), ("70", "2")]
    assert model.displacements[0].d == pytest.approx((0.0015, 0.003, None, None, None, half))
    assert model.displacements[1].d == (0.0, 0.001, None, None, None, None)
    (force,) = model.forces
    assert (force.node, force.set, force.f) == ("20", "1", (0.0, -500.0, 0.0, 0.0, 0.0, 30.0))


def test_all_versions_of_one_job_give_one_model():
    # version 7 has no tags and no types of rigids, which are comments and names only
    old, mid, new = (model_of(everything(v)) for v in VERSIONS)
    unlike = {"materials": {}, "bends": []}  # ASME II-D and B31J: test_caesar_late
    assert replace(mid, **unlike) == replace(new, **unlike)
    unnamed = [s.node for s in mid.supports if s.name]
    assert unnamed == ["20", "50"]
    assert [s.directions for s in old.supports] == [s.directions for s in mid.supports]
    assert [replace(p, body="") for p in mid.pipes] == old.pipes


@pytest.mark.parametrize("made", [everything, crowded])
def test_versions_between_give_the_models_of_those_that_were_seen(made):
    def model(version):
        read_ = model_of(made(version), permissive=True)
        return replace(read_, origin=None)

    assert model(7.0) == model(7.01)
    for version in (8.1, 9.0, 9.1, 10.0):
        assert model(version) == model(11.0)
    unlike = {"materials": {}}  # ASME II-D from 12 on
    for version in (12.0, 13.0):
        assert replace(model(version), **unlike) == replace(model(11.0), **unlike)
    for version in (14.0, 15.0):
        assert model(version) == model(15.01)


def test_comments_say_what_came_from_where():
    deck = imported(everything(11.0)).deck().splitlines()
    assert deck[0] == "! Made from line.cii: CAESAR II neutral file, version 11"
    pipe = deck.index("PIPE     10 20 DX=6000 SECTION=273.05X9.271 MATERIAL=A106-B")
    assert deck[pipe - 2] == "! element 1, line 69: LINE-1 (PUMP)"  # OPERATE stands between
    bend = next(i for i, x in enumerate(deck) if x.startswith("BEND     30"))
    assert "node 29 is 30M, node 28 is 30N" in deck[bend - 1]
    assert "SUPPORT  30M +Y K=50" in deck


def test_english_units_are_read_by_their_constants():
    c = Cii(constants=ENGLISH, labels=ENGLISH_LABELS, ambient=70.0)
    c.defaults = {"od": 10.75, "wall": 0.365, "t1": 350.0, "p1": 150.0, "density": 0.283}
    c.defaults |= {"insulation": 3.0, "insulation_density": 0.006655, "fluid": 0.03}
    anchors = [slot(5, ANC)]
    c.add(5, 10, dx=20.0, RESTRANT=anchors, BEND={"radius": 15.0})  # deltas are feet
    c.add(10, 15, dy=10.0, RESTRANT=[slot(15, 3, k=1e3, gap=0.25, cosines=Y)])
    model = model_of(c)
    assert model.units.length == "ft"
    assert model.pipes[0].delta == pytest.approx((6.096, 0.0, 0.0))  # 0.08333 is 1/12 to 0.1 %
    (section,) = model.sections.values()
    assert (section.od, section.wall) == pytest.approx((0.27305, 0.009271))
    assert section.fluid == pytest.approx(0.03 * 0.45359237 / 0.0254**3)
    assert model.pipes[0].operation.t["1"] == pytest.approx((350.0 - 32.0) / 1.8)
    assert model.pipes[0].operation.tref == pytest.approx(21.1111111111)
    assert model.pipes[0].operation.p["1"] == pytest.approx(150 * 6894.757293)
    direction = model.supports[-1].directions[0]
    assert direction.k == pytest.approx(1e3 * 4.4482216152605 / 0.0254)
    assert direction.gap == pytest.approx((0.00635, 0.00635))
    assert model.bends[0].radius == pytest.approx(0.381)


def test_unknown_constants_are_taken_as_they_stand():
    constants = list(job().constants)
    constants[1] = 3.9  # no unit of force known
    c = job(constants=tuple(constants))
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)], FORCMNT=[(20, {1: (39.0, *[0.0] * 5)})])
    assert model_of(c).forces[0].f[0] == pytest.approx(10 * 4.4482216152605)


def test_a_label_that_contradicts_its_constant_is_an_error():
    labels = list(job().labels)
    labels[2] = "in."
    c = job(labels=tuple(labels))
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    (problem,) = problems_of(c)
    assert "the label says in., the constant of lengths says 0.001 m" in problem


def test_vertical_axis_z():
    c = job(z_up=True)
    up = (0.0, 0.0, 1.0)
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), slot(20, 15, cosines=up)])
    model = model_of(c)
    assert model.settings.up == "Z"
    assert model.supports[1].directions == (Direction("+Z"),)


@pytest.mark.parametrize(
    ("code", "word"),
    [
        *((2, "X"), (3, "Y"), (4, "Z"), (5, "RX"), (6, "RY"), (7, "RZ"), (8, "GUIDE")),
        *((9, "LIMIT"), (13, "+X"), (14, "+Y"), (15, "+Z"), (16, "-X"), (17, "-Y"), (18, "-Z")),
        *((19, "+RX"), (20, "+RY"), (21, "+RZ"), (22, "-RX"), (23, "-RY"), (24, "-RZ")),
    ],
)
def test_every_code_of_a_restraint(code, word):
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), slot(20, code)])
    (direction,) = model_of(c).supports[1].directions
    assert direction.word == word


@pytest.mark.parametrize("code", [10, 11, 12])
def test_snubbers(code):
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), slot(20, code, k=1e3)])
    snubber = model_of(c).supports[1]
    assert (snubber.kind, snubber.directions[0].word) == ("snubber", "XYZ"[code - 10])
    assert snubber.k == 1e5


@pytest.mark.parametrize(
    ("code", "word", "kind", "stand_in"),
    [
        *((27, "XROD", "support", "X"), (31, r"\+YROD", "support", "+Y")),
        *((35, "-ZROD", "support", "-Z"), (36, "X2", "support", "X"), (41, "RZ2", "support", "RZ")),
        *((43, r"\+Y2", "support", "+Y"), (53, "-RZ2", "support", "-RZ")),
        *((55, "YSPR", "support", "Y"), (57, r"\+XSNB", "snubber", "X")),
        *((62, "-ZSNB", "snubber", "Z"), (0, "of code 0", None, None), (99, "of code", None, None)),
    ],
)
def test_restraints_without_counterpart_are_named_and_the_nearest_stands_in(
    code, word, kind, stand_in
):
    c = job()
    # the other values of these are a length, a second stiffness, a load at which they yield
    other = slot(20, code, k=1e3, gap=300.0, mu=1500.0)
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), other])
    with pytest.raises(DeckError, match=f"node 20: restraint {word}"):
        imported(c)
    result = imported(c, permissive=True)
    assert [x.element for x in result.left_out] == ["node 20"]
    found = [(s.kind, *(d.word for d in s.directions)) for s in result.model.supports[1:]]
    assert found == ([(kind, stand_in)] if kind else [])
    for support in result.model.supports[1:]:
        assert [(d.gap, d.mu) for d in support.directions] == [((0.0, 0.0), None)]


@pytest.mark.parametrize(("code", "word"), [(25, "+(0,0,1)"), (26, "-(0,0,1)")])
def test_a_line_stop_of_one_side_is_free_along_its_element(code, word):
    c = job()
    c.add(10, 20, dz=1000.0, RESTRANT=[slot(10, ANC), slot(20, code, gap=5.0)])
    (direction,) = model_of(c).supports[1].directions
    assert (direction.word, direction.gap) == (word, (0.005, 0.005))


def test_rotational_stiffness_and_gap_have_their_units():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), slot(20, 7, k=10.0, gap=2.0)])
    (direction,) = model_of(c).supports[1].directions
    assert direction.k == pytest.approx(10.0 * 180 / math.pi)  # N m/deg
    assert direction.gap == pytest.approx((math.radians(2.0),) * 2)


def test_a_rotation_of_the_usual_stiffness_is_rigid():
    c = job()
    usual = 0.113 * 1e12  # in-lb/deg there
    codes = [slot(20, 5, k=usual), slot(20, 6, k=0.09 * usual)]
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), *codes])
    one, other = model_of(c).supports[1].directions
    assert one.k is None
    assert other.k == pytest.approx(0.09 * usual * 180 / math.pi)


def test_skewed_cosines_make_a_vector_and_placeholders_do_not():
    c = job()
    skew = slot(20, 13, cosines=(0.6, 0.0, 0.8), mu=0.3)
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), skew, slot(20, LIM, cosines=(1, 0, 0))])
    one, two = model_of(c).supports[1].directions
    assert (one.word, one.vector, one.mu) == ("+(0.6,0,0.8)", (0.6, 0.0, 0.8), 0.3)
    assert (two.word, two.vector) == ("LIMIT", None)


def test_the_stiffness_of_an_anchor_is_one_number_for_all_freedoms_and_said():
    c = job()
    stiff = slot(10, ANC, k=1e5)  # N/cm: 57 101.5 lb/in, and so many in-lb/deg
    c.add(10, 20, dx=1000.0, RESTRANT=[stiff])
    result = imported(c)
    anchor = result.model.supports[0]
    assert anchor.k == 1e7
    assert anchor.kr == pytest.approx(57101.47 * 0.1129848 * 180 / math.pi, rel=1e-6)
    assert any("all six freedoms" in a.text for a in result.assumed)


def test_a_friction_beyond_all_bounds_is_named():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), slot(20, RESTING, cosines=Y, mu=5.0)])
    assert "node 20: a friction coefficient of 5 is above 2" in " ".join(problems_of(c))


def test_rigid_is_from_a_tenth_of_the_default_and_for_zero():
    c = job()
    codes = [slot(20, 2, k=0.0), slot(20, 3, k=1.7512e12), slot(20, 4, k=1.7e10)]
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), *codes])
    result = imported(c)
    x, y, z = result.model.supports[1].directions
    assert (x.k, y.k, z.k) == (None, None, 1.7e12)
    assert any("stiffness of 0 are rigid" in a.text for a in result.assumed)


@pytest.mark.parametrize(("option", "setting"), [(0, "OFF"), (1, "ELONGATION"), (2, "OPENING")])
@pytest.mark.parametrize("version", VERSIONS)
def test_bourdon_effects_are_those_of_the_options(version, option, setting):
    result = imported(job_of_one(version=version, bourdon=option))
    assert result.model.settings.bourdon == setting
    assert (f"(BOURDON={setting})" in result.deck()) == (option > 0)
    assert not any("Bourdon" in a.text for a in result.assumed)


def test_pipe_under_pressure_is_as_long_as_lame_has_it_where_the_file_asks_for_it():
    c = job(bourdon=1)
    c.add(10, 20, dx=6000.0, t1=0.0, t2=0.0, p1=100.0, p2=0.0, RESTRANT=[slot(10, ANC)])
    model = model_of(c)
    results = trunnion.solve(model)
    bore, e = 273.05 - 2 * 9.271, model.materials["A106-B"].e
    assert e == pytest.approx(203400e6, rel=1e-4)
    strain = 10e6 / e * (1 - 2 * 0.292) * bore**2 / (273.05**2 - bore**2)  # closed ends
    assert results["SUS"].displacements["20"]["ux"] == pytest.approx(6.0 * strain, rel=1e-9)


def test_a_file_that_ends_before_its_options_says_what_bourdon_effects_are_taken_as():
    lines = job_of_one().text().split("\r\n")
    end = lines.index("#$ UNITS   ")
    result = imported("\r\n".join([*lines[: end - 4], *lines[end:]]))
    assert any("does not say whether Bourdon" in a.text for a in result.assumed)


def test_options_that_change_the_answer_are_named():
    found = " ".join(problems_of(job_of_one(bowing=20.0, stiffening=1)))
    assert "job: thermal bowing is on" in found
    assert "job: stress stiffening by pressure is on" in found
    assert "3 is no choice of Bourdon effects" in " ".join(problems_of(job_of_one(bourdon=3)))


def test_a_restraint_given_on_two_elements_is_one_support():
    c = job()
    same = slot(20, RESTING, cosines=Y, mu=0.1)
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC), same])
    c.add(20, 30, dx=1000.0, RESTRANT=[same, slot(20, 2)])
    result = imported(c)
    assert [len(s.directions) for s in result.model.supports] == [0, 1, 1]
    assert any("given twice" in a.text for a in result.assumed)


def test_cnodes_tie_nodes_and_place_parts():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(120, 130, dy=-700.0, RESTRANT=[slot(130, ANC), slot(120, ANC, cnode=20)])
    model = model_of(c)
    tie = model.supports[2]
    assert (tie.node, tie.cnode, tie.kind) == ("120", "20", "anchor")
    assert [(n.label, n.xyz) for n in model.nodes] == [
        ("10", (0.0, 0.0, 0.0)),
        ("120", (1.0, 0.0, 0.0)),
    ]


def test_supports_may_stand_on_a_node_that_is_only_a_cnode():
    # a rest with a gap of 1 mm on a column of 1e6 N/m: both carry the same, the column yields
    c = job()
    column = [slot(120, 3, k=1e4, cosines=Y), slot(120, 2), slot(120, 4)]
    rest = slot(20, RESTING, cosines=Y, cnode=120, gap=1.0)
    c.add(10, 20, dx=6000.0, t1=0.0, t2=0.0, RESTRANT=[slot(10, ANC), rest, *column])
    results = trunnion.solve(model_of(c))
    load = results["SUS"].supports["20"]["fy"]
    assert results["SUS"].supports["120"]["fy"] == pytest.approx(load, rel=1e-9)
    assert results["SUS"].displacements["20"]["uy"] == pytest.approx(-1e-3 - load / 1e6, rel=1e-4)
    c = job()
    c.add(10, 20, dx=6000.0, RESTRANT=[slot(10, ANC), slot(20, RESTING, cnode=7), slot(7, GUI)])
    assert "node 7: GUI where no element has a length" in " ".join(problems_of(c))


def test_a_cnode_that_nothing_holds_is_named_and_taken_to_ground():
    c = job()
    c.add(10, 20, dx=6000.0, RESTRANT=[slot(10, ANC), slot(20, RESTING, cosines=Y, cnode=900)])
    c.hangers = [{"node": 20, "k": 100.0, "cold": 4000.0, "cnode": 901}]
    found = problems_of(c)
    for said in ("restraint +Y with CNODE 900, which no element", "hanger with CNODE 901"):
        assert any(said in text for text in found)
    assert all(s.cnode is None for s in model_of(c, permissive=True).supports)


def test_coordinates_place_disconnected_parts():
    c = job()
    c.coords = [(30, 0.0, 1000.0, 5000.0)]
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(30, 40, dx=1000.0, RESTRANT=[slot(30, ANC)])
    c.add(50, 60, dx=1000.0, RESTRANT=[slot(50, ANC)])
    result = imported(c)
    assert {n.label: n.xyz for n in result.model.nodes} == {
        "10": (0.0, 0.0, 0.0),
        "30": (0.0, 1.0, 5.0),
        "50": (0.0, 0.0, 0.0),
    }
    assert any("part that starts at node 50" in a.text for a in result.assumed)


def test_a_loop_open_by_rounding_is_closed_and_a_wide_one_is_an_error():
    def loop(gap):
        c = job()
        c.add(10, 20, dx=3000.0, RESTRANT=[slot(10, ANC)])
        c.add(20, 30, dz=2000.0)
        c.add(10, 40, dz=2000.0)
        c.add(40, 30, dx=3000.0 + gap)
        return c

    result = imported(loop(1.5))
    assert result.model.pipes[3].delta == pytest.approx((3.0, 0.0, 0.0))
    assert any("open by 1.5 mm" in a.text for a in result.assumed)
    assert "element 4" in result.deck()  # its comment stayed
    (problem,) = problems_of(loop(60.0))
    assert "the loop at element 40-30 is open by 60 mm" in problem


def test_a_bend_may_use_up_its_element():
    c = job()
    c.add(10, 20, dx=381.002, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0})
    c.add(20, 30, dz=1143.0, BEND={"radius": 381.0, "nodes": ((0.0, 28),)})
    c.add(30, 40, dx=381.0)
    model = model_of(c)
    assert model.bends[0].radius == pytest.approx(0.381002)
    assert model.bends[1].radius == 0.381


def test_a_rigid_at_a_bend_gets_a_pipe_for_its_tangent():
    c = job()
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0})
    c.add(20, 30, dz=881.0, RIGID=(1000.0, 2))
    model = model_of(c)
    pipe, rigid = model.pipes[1:]
    assert (pipe.start, pipe.end, pipe.rigid) == ("20", "20T", False)
    assert (rigid.start, rigid.end, rigid.rigid) == ("20T", "30", True)
    assert pipe.delta == pytest.approx((0.0, 0.0, 0.381))
    assert rigid.delta == pytest.approx((0.0, 0.0, 0.5))


@pytest.mark.parametrize("version", [11.0, 15.01])
def test_a_node_at_any_angle_of_a_bend_cuts_its_arc_and_changes_nothing_else(version):
    def line(angle):
        c = job(version)
        nodes = ((0.0, 18), (angle, 19), (-2.0202, 17))
        bend = {"radius": 381.0, "nodes": nodes, "flanges": 1}
        c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC), slot(19, 3, k=1e-3)], BEND=bend)
        c.add(20, 30, dz=2000.0, RESTRANT=[slot(30, ANC)])
        return model_of(c)

    model = line(30.0)
    assert [(p.start, p.end) for p in model.pipes] == [("10", "31"), ("31", "20"), ("20", "30")]
    assert [(b.node, b.radius) for b in model.bends] == [("31", 0.381), ("20", 0.381)]
    assert model.bends[0].k == model.bends[1].k
    assert model.supports[1].node == "31F"
    points = place(model, []).points
    middle = (2.0 - 0.381 + 0.381 * math.sin(math.pi / 6), 0.0, 0.381 * (1 - math.cos(math.pi / 6)))
    assert points["31F"] == pytest.approx(middle, abs=1e-9)
    assert points["31N"] == pytest.approx((1.619, 0.0, 0.0), abs=1e-9)
    assert points["20F"] == pytest.approx((2.0, 0.0, 0.381), abs=1e-9)
    cut, whole = (trunnion.solve(m) for m in (model, line(45.0)))
    for case in ("SUS", "OPE1"):
        loads, others = (r[case].supports.values[[0, -1], :6] for r in (cut, whole))
        assert loads == pytest.approx(others, rel=1e-6, abs=1e-6 * abs(others).max())


def after_a_bend(**body):
    c = job()
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0})
    c.add(20, 30, dz=881.0, **body)
    c.add(30, 40, dy=1000.0, od=219.1, wall=8.18)
    return c


def test_a_reducer_or_joint_that_leaves_a_bend_begins_behind_its_tangent():
    model = model_of(after_a_bend(REDUCERS=(219.1, 8.18)))
    _, tangent, cone, after = model.pipes
    assert (tangent.start, tangent.end, cone.start, cone.end) == ("20", "20T", "20T", "30")
    assert tangent.section == cone.section
    assert cone.reducer.section == after.section
    assert cone.delta == pytest.approx((0.0, 0.0, 0.5))
    _, tangent, joint, _ = model_of(after_a_bend(EXPJT=(1e3, 1e3, 0.0, 0.0, 0.0))).pipes
    assert (tangent.joint, joint.joint.axial) == (None, 1e5)
    assert joint.delta == pytest.approx((0.0, 0.0, 0.5))
    metal, cover = (273.05**2 - 254.508**2) * 7833.44, (423.05**2 - 273.05**2) * 140.0
    weight = 0.5 * math.pi / 4 * (metal + cover) * 1e-6 * 9.80665
    assert joint.weight == pytest.approx(weight, rel=1e-6)


def test_a_body_that_ends_in_a_bend_or_is_nothing_but_its_tangent_is_named():
    c = job()
    bend = {"BEND": {"radius": 381.0}}
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)], REDUCERS=(219.1, 8.18), **bend)
    c.add(20, 30, dz=381.0, RIGID=(900.0, 1))
    c.add(30, 40, dz=1000.0)
    found = " ".join(problems_of(c))
    assert "element 10-20: reducer that ends in a bend" in found
    assert "element 20-30: rigid that is no longer than the tangent of a bend" in found
    assert not any(p.rigid or p.reducer for p in model_of(c, permissive=True).pipes)


def test_a_guide_follows_a_body_behind_its_bend_and_an_owner_behind_its_link():
    c = after_a_bend(RIGID=(1000.0, 2), RESTRANT=[slot(30, GUI), slot(30, LIM)])
    guide, stop = model_of(c).supports[1].directions
    assert (guide.along, stop.along) == ("20T-30", "20T-30")
    c = job()
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)])
    owned = {"OFFSETS": (0.0, 0.0, 0.0, 0.0, 200.0, 0.0), "RIGID": (900.0, 1)}
    c.add(20, 30, dz=1000.0, RESTRANT=[slot(30, GUI), slot(30, LIM)], **owned)
    c.add(30, 40, dx=1000.0)
    assert [d.word for d in model_of(c).supports[1].directions] == ["X", "(0,0.196116,0.980581)"]


def test_the_tangent_before_a_rigid_carries_the_uniform_load_of_its_element():
    c = job()
    load = [0.0, -3.0, *[0.0] * 34]
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0}, UNIFORM=load)
    c.add(20, 30, dz=881.0, RIGID=(1000.0, 2))
    assert [[q.load for q in pipe.uniform] for pipe in model_of(c).pipes] == [[(0, -300, 0)]] * 3


def test_branches_at_a_bend_leave_from_its_points():
    c = job()
    c.add(
        10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0, "nodes": ((45.0, 19),)}
    )
    c.add(20, 30, dz=2000.0)
    c.add(19, 119, dy=-500.0, RESTRANT=[slot(119, RESTING, cosines=Y)])  # dummy leg
    c.add(20, 120, dy=-500.0)
    model = model_of(c)
    assert [(p.start, p.end) for p in model.pipes[2:]] == [("20M", "119"), ("20F", "120")]


def test_an_element_without_length_joins_its_ends():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 21)
    c.add(21, 30, dx=1000.0)
    result = imported(c)
    assert [(s.node, s.kind, s.cnode) for s in result.model.supports][1] == ("21", "anchor", "20")
    assert any("no length" in a.text for a in result.assumed)


def test_a_held_node_without_anchor_is_an_anchor():
    c = job()
    c.add(10, 20, dx=1000.0, DISPLMNT=[(10, {1: (0.0,) * 6})])
    model = model_of(c)
    assert [(s.node, s.kind) for s in model.supports] == [("10", "anchor")]
    assert not model.displacements


def test_uniform_loads_in_g_of_all_elements_are_accelerations():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)], UNIFORM=[0.3, 0, 0, 1.0, *[0.0] * 32])
    c.add(20, 30, dx=1000.0)
    (a,) = model_of(c).accelerations
    assert (a.set, a.a) == ("1", (0.3, 0.0, 0.0))


def test_blank_temperatures_are_ambient_and_said():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=1000.0, t1=0.0, t2=0.0, p1=0.0, p2=0.0)
    result = imported(c)
    assert result.model.pipes[1].operation.t == {"1": 21.1142, "2": 21.1142}
    assert result.model.pipes[1].operation.p == {"1": 0.0, "2": 0.0}
    assert any("taken as the ambient temperature" in a.text for a in result.assumed)


def test_the_marker_of_blanks_carries_the_value_before():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    blank = dict.fromkeys(("od", "wall", "t1", "p1", "e", "dy"), -1.0101)
    c.add(20, 30, dx=1000.0, **blank)
    model = model_of(c)
    assert len(model.sections) == len(model.materials) == 1
    assert model.pipes[0].operation == model.pipes[1].operation
    assert model.pipes[1].delta == (1.0, 0.0, 0.0)


def test_material_constants_of_the_data_base_stand_in_for_zeros():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)], e=0.0, nu=0.0, density=0.0, material=186)
    (material,) = model_of(c).materials.values()
    assert (material.name, material.grade) == ("A335-P5", "A335-P5")
    assert (material.nu, material.density) == (0.292, 7695.04)


def test_an_unknown_material_is_named_once():
    c = job()
    for n in range(3):
        c.add(10 + n, 11 + n, dx=1000.0, material=777, RESTRANT=[slot(10, ANC)] if not n else [])
    (problem,) = problems_of(c)
    said = "element 10-11: material 777 is not known, and its expansion not in the file; taken as"
    assert said in problem
    assert len(imported(c, permissive=True).left_out) == 1


@pytest.mark.parametrize(("e", "said"), [(203400.0, False), (0.0, True)])
def test_an_unknown_material_that_stays_cold_needs_its_constants_alone(e, said):
    c = job()
    cold = {"t1": 0.0, "t2": 21.5}
    c.add(10, 20, dx=1000.0, material=777, e=e, **cold, RESTRANT=[slot(10, ANC)])
    assert bool(imported(c, permissive=True).left_out) == said


def test_lining_and_cladding_are_weights():
    c = job()
    lined = {"lining": 50.0, "lining_density": 0.0024}
    c.add(
        10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)], **lined, cladding=1.0, cladding_density=0.0027
    )
    c.add(20, 30, dx=1000.0, cover=1.2)
    lined, covered = model_of(c).sections.values()
    assert (lined.lining, lined.lining_density) == (0.05, 2400.0)
    inside = 0.27305 + 0.15
    area = math.pi / 4 * ((inside + 0.002) ** 2 - inside**2)
    assert lined.weight == pytest.approx(area * 2700.0 * 9.80665)
    assert (covered.weight, covered.insulation_density) == (120.0, 0.0)  # 1.2 N/cm instead


def test_windows_text_is_read():
    c = job(titles=("Dampfleitung Süd",))
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    result = imported(c)
    assert result.model.title == "Dampfleitung Süd"
    assert "text read as cp1252" in result.header


def test_labels_of_an_empty_title_page_are_no_title():
    page = ("  PROJECT:", "", "  CLIENT :", "  NOTES  : rev 2", "  Data generated by X")
    c = job(titles=page)
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    assert model_of(c).title == "NOTES : rev 2"


def test_titles_that_a_card_cannot_hold_are_tamed():
    c = job(titles=("A & B! done &",))
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    assert model_of(c).title == "A B done"


def test_a_reducer_has_the_section_of_its_other_end():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=178.0, REDUCERS=(168.275, 7.112))
    c.add(30, 40, dx=1000.0, od=168.275, wall=7.112)
    c.add(40, 50, dx=100.0, od=168.275, wall=7.112, REDUCERS=(0.0, 0.0))  # blank: as what follows
    c.add(50, 60, dx=500.0, od=114.3, wall=6.02)
    model = model_of(c)
    names = list(model.sections)
    assert [p.reducer.section if p.reducer else "" for p in model.pipes] == (
        ["", names[1], "", names[2], ""]
    )
    assert [p.section for p in model.pipes] == [names[0], names[0], names[1], names[1], names[2]]
    assert [model.sections[n].od for n in names] == [0.27305, 0.168275, 0.1143]


def test_expansion_joints_have_rates_thrust_area_and_axis():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=300.0, EXPJT=(800.0, 500.0, 0.0, 90.0, 290.0))
    c.add(30, 40, dx=1000.0)
    c.add(40, 41, EXPJT=(800.0, 500.0, 12.0, 0.0, 0.0))
    c.add(41, 50, dx=1000.0, RESTRANT=[slot(50, ANC)])
    result = imported(c)
    degree = 180 / math.pi
    area = math.pi / 4 * 0.29**2
    one, two = (p.joint for p in result.model.pipes if p.joint)
    assert one == Joint(8e4, 5e4, None, pytest.approx(90 * degree), pytest.approx(area))
    assert two == Joint(8e4, 5e4, pytest.approx(12 * degree), None, 0.0, (1.0, 0.0, 0.0))
    assert any("blank rates" in a.text for a in result.assumed)
    c.arrays["EXPJT"][0] = (0.0, 500.0, 0.0, 90.0, 290.0)  # a hinge: its axial rate is left blank
    assert next(p.joint for p in model_of(c).pipes if p.joint).axial == 1e12
    assert result.model.pipes[3].weight == 0.0
    assert result.model.pipes[1].weight > 0.0


@pytest.mark.parametrize(("material", "sign"), [(18, 1.0), (19, -1.0)])
def test_cold_spring_is_a_cut_of_the_length_of_its_element(material, sign):
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=25.0, material=material)
    c.add(30, 40, dx=1000.0)
    assert [p.cut for p in model_of(c).pipes] == [0.0, sign * 0.025, 0.0]


def test_uniform_loads_by_length_hold_until_the_next():
    c = job()
    first = [0, -2.0, 0, 0.0, 0.5, 0, 0, 1.0, *[0.0] * 28]
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)], UNIFORM=first)
    c.add(20, 30, dx=1000.0)
    c.add(30, 40, dx=1000.0, UNIFORM=[0.0] * 36)
    model = model_of(c)
    loads = (Uniform("1", (0.0, -200.0, 0.0)), Uniform("2", (0.5, 0.0, 0.0), True))  # N/cm
    assert [p.uniform for p in model.pipes] == [loads, loads, ()]
    assert not model.accelerations


@pytest.mark.parametrize("version", VERSIONS)
def test_hangers_to_be_designed_and_several_at_one_place(version):
    c = job(version)
    c.add(10, 20, dx=6000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=6000.0, RESTRANT=[slot(30, ANC)])
    c.hangers = [
        {"node": 20, "free": (10, 1, 30, 5)},
        {"node": 30, "k": 100.0, "cold": 4000.0, "number": 2, "table": 7},
    ]
    hangers = [s for s in model_of(c).supports if s.kind == "hanger"]
    wanted = HangerDesign(0.25, 0.0, None, 1, "HOT", table="ANVIL", free="10", free2="30")
    assert hangers[0].design == wanted
    assert (hangers[1].k, hangers[1].load, hangers[1].design) == (2e4, 8000.0, None)


def test_a_hanger_that_nothing_moves_is_named_and_a_load_without_rate_is_constant():
    c = job()
    c.add(10, 20, dx=6000.0, t1=0.0, t2=0.0, RESTRANT=[slot(10, ANC)])
    c.hangers = [{"node": 20}]
    assert "node 20: hanger to be designed in a job without" in " ".join(problems_of(c))
    (rest,) = (s for s in model_of(c, permissive=True).supports if s.node == "20")
    assert [d.word for d in rest.directions] == ["+Y"]
    c.hangers = [{"node": 20, "cold": 5000.0}]
    result = imported(c)
    assert any("it is a constant support" in a.text for a in result.assumed)
    assert [s.k for s in result.model.supports if s.kind == "hanger"] == [0.0]


def test_hangers_without_tags_are_read_below_elements_with_names():
    """Widths may mix between version 7 and 11: the lines that are there decide."""
    c = job(11.0)
    c.add(10, 20, dx=6000.0, RESTRANT=[slot(10, ANC)])
    c.hangers = [{"node": n, "k": 100.0, "cold": 4000.0 + n} for n in (10, 20)]
    lines = c.text().split("\r\n")
    start = next(i for i, x in enumerate(lines) if x.startswith("#$ MISCEL_1"))
    tags = [i for i in range(start, len(lines)) if lines[i] == c.string("")]
    assert len(tags) == 4
    short = [x for i, x in enumerate(lines) if i not in tags]
    hangers = [s for s in model_of("\r\n".join(short)).supports if s.kind == "hanger"]
    assert [(s.node, s.k, s.load) for s in hangers] == [("10", 1e4, 4010.0), ("20", 1e4, 4020.0)]


def test_the_load_and_the_space_that_a_user_gives_a_hanger_are_named():
    c = job_of_one()
    c.hangers = [{"node": 20, "user": 5000.0, "space": 1200.0}]
    assert any("an operating load of 5000 N" in text for text in problems_of(c))
    result = imported(c, permissive=True)
    assert any("space available" in a.text for a in result.assumed)


def test_expansions_instead_of_temperatures_move_the_pipe_by_just_that_much():
    # 10-20 has expansions in T1 and T2, 20-30 temperatures: A106 B expands by 1.76e-3 to 170 C
    c = job()
    c.add(10, 20, dx=6000.0, t1=0.002, t2=-0.0005, p1=0.0, p2=0.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=6000.0, p1=0.0, p2=0.0)
    results = trunnion.solve(model_of(c))
    hot, cold = (results[case].displacements for case in ("OPE1", "OPE2"))
    assert hot["20"]["ux"] == pytest.approx(6.0 * 0.002, rel=1e-9)
    assert cold["20"]["ux"] == pytest.approx(-6.0 * 0.0005, rel=1e-9)
    assert hot["30"]["ux"] - hot["20"]["ux"] == pytest.approx(6.0 * 1.76e-3, rel=0.02)


def test_a_wall_that_nobody_makes_is_reported():
    c = job()
    c.add(10, 20, dx=6000.0, wall=0.01, RESTRANT=[slot(10, ANC)])
    said = " ".join(a.text for a in imported(c).assumed)
    assert "a wall of 0.01 mm at an OD of 273.05 mm looks like a stand-in" in said


def test_strains_beside_temperatures_and_offsets_of_a_bend_itself_are_named():
    c = job()
    off = {"OFFSETS": (0.0, 0.0, 0.0, 0.0, 100.0, 0.0)}
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dx=1000.0, BEND={"radius": 381.0}, **off)
    c.add(30, 40, dz=2000.0, t1=0.002)
    found = " ".join(problems_of(c))
    for text in ("element 20-30: offset at the bend at 30", "T1 is an expansion"):
        assert text in found
    assert len(imported(c, permissive=True).left_out) == 2


def test_an_offset_at_the_other_end_of_a_bend_is_a_stiff_link_without_weight():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dz=2000.0, BEND={"radius": 381.0}, OFFSETS=(0.0, 0.0, 136.5, 0.0, 0.0, 0.0))
    c.add(30, 40, dx=2000.0)
    _, link, pipe, _ = model_of(c).pipes
    assert (link.start, link.end, link.delta) == ("20", "41", (0.0, 0.0, 0.1365))
    assert (link.rigid, link.weight) == (True, 0.0)
    assert (pipe.start, pipe.end, pipe.delta) == ("41", "30", (0.0, 0.0, 1.8635))


@pytest.mark.parametrize(
    "body",
    [{"RIGID": (2100.0, 1)}, {"REDUCERS": (219.1, 8.18)}, {"EXPJT": (1e3, 1e3, 0.0, 0.0, 0.0)}],
)
def test_the_offset_of_a_body_is_a_stiff_link_without_weight(body):
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    arms = (0.0, 0.0, 136.5, 0.0, 200.0, 0.0)
    c.add(20, 30, dz=2000.0, OFFSETS=arms, **body)
    c.add(30, 40, dz=500.0, od=219.1, wall=8.18)
    _, first, made, last, _ = model_of(c).pipes
    assert (first.start, first.end, first.delta) == ("20", "41", (0.0, 0.0, 0.1365))
    assert (made.start, made.end, made.delta) == ("41", "42", (0.0, 0.2, 1.8635))
    assert (last.start, last.end, last.delta) == ("42", "30", (0.0, -0.2, 0.0))
    assert [link.weight for link in (first, last)] == [0.0, 0.0]
    assert made.rigid or made.reducer or made.joint


def bent(**bend):
    """A right-angled bend of 381 mm of 273.05 x 9.271 pipe under 12 bar; r2 = 131.8895 mm."""
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0, **bend})
    c.add(20, 30, dz=2000.0)
    return c


@pytest.mark.parametrize(
    ("cuts", "spaced", "h"),
    [
        # s = 2 R tan(90/6) = 204 > r2 (1 + tan 15) = 167: wide; (1 + cot 15)/2 T/r2
        (3, "widely", 0.5 * (1.0 + 1.0 / math.tan(math.radians(15))) * 9.271 / 131.8895),
        # s = 2 R tan(90/16) = 75 < 145: close; T R / r2^2
        (8, "closely", 9.271 * 381.0 / 131.8895**2),
        (1, "widely", 9.271 / 131.8895),  # theta = 45 degrees
    ],
)
def test_a_mitre_bend_has_the_flexibility_of_b313_table_d300(cuts, spaced, h):
    result = imported(bent(miters=cuts))
    assert result.model.bends[0].k == pytest.approx(1.52 * h ** (-5 / 6), rel=1e-6)
    assert any(f"{spaced} spaced mitre bend of {cuts} cut" in a.text for a in result.assumed)


def test_a_bend_with_a_wall_of_its_own_has_its_flexibility():
    result = imported(bent(fitting=12.0))
    r2, t, r = 131.8895, 12.0, 381.0
    k = 1.65 * r2**2 / (t * r) / (1 + 6 * 1.2 / 203400 * (r2 / t) ** (7 / 3) * (r / r2) ** (1 / 3))
    assert result.model.bends[0].k == pytest.approx(k, rel=1e-3)
    assert any("bend with a wall of 12 mm" in a.text for a in result.assumed)
    assert imported(bent(fitting=9.271)).model.bends[0].k is None  # the writer fills it in


@pytest.mark.parametrize(("short", "fits"), [(0.3, True), (3.7, True), (3.9, False)])
def test_a_bend_that_lacks_up_to_one_percent_of_its_pipe_is_fitted_and_reported(short, fits):
    c = job()
    c.add(10, 20, dx=381.0 - short, RESTRANT=[slot(10, ANC)], BEND={"radius": 381.0})
    c.add(20, 30, dz=2000.0)
    if not fits:
        with pytest.raises(DeckError, match=r"element 10-20 is 377\.1 mm long; its bends need 381"):
            imported(c)
        return
    result = imported(c)
    assert result.model.bends[0].radius == pytest.approx(0.381 - short / 1e3, rel=1e-9)
    assert any(
        "the bend at 20 does not fit into its pipes by a hair" in a.text for a in result.assumed
    )


def test_flexible_nozzles_are_named_and_held():
    c = job()
    c.add(10, 20, dx=1000.0)
    c.nozzles = [(10, 0)]
    (problem,) = problems_of(c)
    assert "node 10: flexible nozzle; taken as rigid" in problem
    assert model_of(c, permissive=True).supports[0].kind == "anchor"


def test_a_guide_at_the_end_of_a_bend_follows_the_element_that_owns_it():
    """Version 14 printed +637 N in X and none in Z for a guide on an element along Z whose bend
    turns up there: not the two directions of a riser."""
    c = job()
    both = [slot(20, GUI, gap=3.0, mu=0.3), slot(20, LIM)]
    c.add(10, 20, dz=2000.0, RESTRANT=[slot(10, ANC), *both], BEND={"radius": 381.0})
    c.add(20, 30, dy=2000.0, RESTRANT=[slot(30, GUI)])
    across, along = model_of(c).supports[1].directions
    assert (across.word, across.gap, across.mu) == ("X", (0.003, 0.003), 0.3)
    assert along.word == "Z"
    assert model_of(c).supports[2].directions[0].word == "GUIDE"  # on the riser itself


def test_a_guide_on_a_riser_at_the_end_of_its_bend_holds_both_horizontals():
    c = job()
    guide = [slot(10, ANC), slot(20, GUI)]
    c.add(10, 20, dy=2000.0, RESTRANT=guide, BEND={"radius": 381.0})
    c.add(20, 30, dz=2000.0)
    assert [d.word for d in model_of(c).supports[1].directions] == ["X", "Z"]


def test_a_guide_where_every_pipe_stands_off_its_node_takes_its_direction_from_its_owner():
    c = job()
    here = [slot(10, ANC), slot(20, GUI, gap=2.0), slot(20, LIM)]
    c.add(10, 20, dx=2000.0, RESTRANT=here, OFFSETS=(0, 0, 0, 0, 100.0, 0))
    c.add(20, 30, dx=2000.0, RESTRANT=[slot(30, ANC)], OFFSETS=(0, 100.0, 0, 0, 0, 0))
    model = model_of(c)
    assert [d.word for d in model.supports[1].directions] == ["Z", "X"]
    assert trunnion.solve(model)["SUS"].converged


def test_a_guide_where_no_element_has_a_length_is_named():
    c = job()
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, RESTRANT=[slot(30, GUI)])
    with pytest.raises(DeckError, match="node 30: GUI where no element has a length"):
        imported(c)


def test_a_guide_where_pipes_part_names_its_pipe():
    c = job()
    c.add(10, 20, dx=2000.0, RESTRANT=[slot(10, ANC), slot(20, GUI)])
    c.add(20, 30, dx=2000.0)
    assert model_of(c).supports[1].directions[0].along is None
    c.add(20, 120, dy=-500.0)  # a dummy leg
    assert model_of(c).supports[1].directions[0].along == "10-20"


def test_numbers_off_their_columns_are_read_by_words():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    text = c.text()
    at = text.index("#$ MISCEL_1") + len("#$ MISCEL_1\r\n")
    end = text.index("\r\n", at)
    loose = text[:at] + "   106.0" + text[end:]
    source = source_of(loose.encode(), "line.cii")
    result = read(source, Findings(source))
    assert list(result.model.materials) == ["A106-B"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("#$ UNITS", "#$ UNITZ", "section UNITS is missing"),
        ("#$ BEND    ", "#$ RIGID   ", "there is a section RIGID in line"),
        ("11.000000", " 4.500000", "the layout of version 4.5"),
        ("203400.", "2034x0.", "'2034x0.' is not a number"),
    ],
)
def test_what_is_wrong_is_named(old, new, said):
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    source = source_of(c.text().replace(old, new, 1).encode(), "line.cii")
    with pytest.raises(DeckError, match=said):
        read(source, Findings(source))


def test_a_pointer_beyond_its_array_and_cut_off_lines_are_named():
    lines = job_of_one().text().split("\r\n")
    at = next(i for i, x in enumerate(lines) if x.startswith("#$ RESTRANT"))
    source = source_of("\n".join(lines[: at + 5] + lines[at + 6 :]).encode(), "line.cii")
    with pytest.raises(DeckError, match="RESTRANT has 23 lines"):
        read(source, Findings(source))
    pointers = next(i for i, x in enumerate(lines) if x.startswith("#$ AUX_DATA")) - 3
    lines[pointers] = lines[pointers].replace("1", "7")
    source = source_of("\n".join(lines).encode(), "line.cii")
    with pytest.raises(DeckError, match="points to record 7 of RESTRANT, which has 1"):
        read(source, Findings(source))


def test_offsets_lead_from_the_node_to_the_pipe():
    c = job()
    c.add(10, 20, dx=1000.0, RESTRANT=[slot(10, ANC)])
    c.add(20, 30, dz=1000.0, OFFSETS=(0.0, 0.0, 136.5, 0.0, 0.0, 0.0))
    assert [p.offsets for p in model_of(c).pipes] == [(None, None), ((0.0, 0.0, 0.1365), None)]


@pytest.mark.parametrize("text", ["", "\r\n\r\n", "#$"])
def test_a_file_of_nothing_is_named(text):
    source = source_of(text.encode(), "line.cii")
    with pytest.raises(DeckError):
        read(source, Findings(source))
