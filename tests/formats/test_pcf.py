"""Piping component files: every component of the format, field by field.

The expected numbers follow from the coordinates of `pcf_lines.everything` by hand; sizes are
those of ASME B36.10M for NPS 4, 3 and 1 in schedule 40.
"""

import subprocess
import sys

import pytest
from pcf_lines import HEADER, TABLE, block, everything, pipe, support

import trunnion
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError, ModelError
from trunnion.formats import Options, read_any

G = 9.80665


@pytest.fixture
def load(tmp_path):
    """Read the text of a file, with the text of a side table."""

    def read(text, table=TABLE, permissive=False, suffix=".toml", **options):
        path, side = tmp_path / "line.pcf", tmp_path / f"line{suffix}"
        path.write_text(text)
        side.write_text(table)
        return read_any(path, permissive=permissive, options=Options(table=side, **options))

    return read


@pytest.fixture
def whole(load):
    return load(everything())


def named(model, record):
    return next(p for p in model.pipes if (p.start, p.end) == record)


def texts(error):
    return [problem.text for problem in error.value.problems]


def test_the_line_is_walked_from_its_numbered_end(whole):
    ends = [(p.start, p.end) for p in whole.model.pipes]
    assert ends[:5] == [
        *(("100", "110"), ("110", "120"), ("120", "130"), ("130", "140")),
        ("140", "150"),
    ]
    assert whole.model.nodes[0].label == "100"
    assert whole.model.nodes[0].xyz == (0.0, 0.0, 1.0)
    assert len(whole.model.nodes) == 1  # all hangs together


def test_axes_are_east_north_up(whole):
    assert whole.model.settings.up == "Z"
    assert named(whole.model, ("130", "140")).delta == (1.5, 0.0, 0.0)
    assert named(whole.model, ("140", "150")).delta == (0.0, 1.895, 0.0)


def test_an_elbow_gets_its_radius_from_its_points(whole):
    (bend,) = whole.model.bends
    assert (bend.node, bend.radius) == ("140", pytest.approx(0.1524, rel=1e-12))


def test_sections_are_nominal_sizes_of_the_tables(whole):
    sections = whole.model.sections
    sizes = {n: (s.od, s.wall, s.nps, s.schedule, s.fluid) for n, s in sections.items()}
    assert sizes == {
        "4IN-40": (0.1143, 0.00602, "4", "40", 800.0),
        "3IN-40": (0.0889, 0.00549, "3", "40", 800.0),
        "1IN-40": (0.0334, 0.00338, "1", "40", 800.0),
    }


def test_bodies_are_rigid_with_the_weight_of_the_file(whole):
    weights = {(p.start, p.end): p.weight / G for p in whole.model.pipes if p.rigid and p.weight}
    assert weights == pytest.approx(
        {
            ("100", "110"): 7.0,  # FLANGE
            ("230", "240"): 12.0,  # INSTRUMENT
            ("250", "260"): 1.5,  # UNION
            ("260", "270"): 20.0,  # VALVE-ANGLE: half of 40 in each leg
            ("270", "280"): 20.0,
            ("350", "360"): 5.5,  # FLANGE
            ("370", "380"): 32.0,  # VALVE
            ("380", "390"): 4.5,  # FLANGE-BLIND
        },
        rel=1e-9,
    )


def test_a_coupling_and_a_cap_without_weight_are_pipe(whole):
    assert not named(whole.model, ("240", "250")).rigid
    assert not named(whole.model, ("290", "300")).rigid


def test_a_gasket_is_a_weightless_body(whole):
    gasket = named(whole.model, ("360", "370"))
    assert (gasket.rigid, gasket.weight, gasket.delta) == (True, 0.0, (0.003, 0.0, 0.0))


def test_a_tee_is_legs_to_its_centre(whole):
    assert named(whole.model, ("150", "160")).delta == (0.0, 0.105, 0.0)
    assert named(whole.model, ("160", "170")).delta == (0.0, 0.105, 0.0)
    branch = named(whole.model, ("160", "340"))
    assert (branch.delta, branch.section) == ((0.098, 0.0, 0.0), "3IN-40")


def test_an_olet_splits_the_run_and_is_stiff_inside_it(whole):
    assert named(whole.model, ("170", "180")).delta == (0.0, 1.395, 0.0)
    assert named(whole.model, ("180", "190")).delta == (0.0, 1.0, 0.0)
    inside, outside = named(whole.model, ("180", "310")), named(whole.model, ("310", "320"))
    assert (inside.rigid, inside.weight, inside.delta) == (True, 0.0, (0.0, 0.0, 0.05715))
    assert (outside.rigid, outside.delta) == (False, (0.0, 0.0, 0.05285))


def test_a_reducer_tapers_from_section_to_section(whole):
    reducer = named(whole.model, ("200", "210"))
    assert (reducer.section, reducer.reducer.section) == ("4IN-40", "3IN-40")
    assert (reducer.delta, reducer.reducer.axis) == ((0.0, 0.102, 0.0), None)


def test_an_eccentric_reducer_has_the_axis_of_its_pipes(load):
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0), 80.0)
    text += block("REDUCER-ECCENTRIC", ((1000, 0, 0), 80), ((1102, 0, 12.7), 100))
    model = load(text + pipe((1102, 0, 12.7), (3000, 0, 12.7)), anchors=("10", "40")).model
    (reducer,) = (p for p in model.pipes if p.reducer)
    assert (reducer.section, reducer.reducer.section) == ("3IN-40", "4IN-40")
    assert reducer.reducer.axis == (1.0, 0.0, 0.0)
    assert trunnion.solve(model)["OPE"].certificate.passed


def test_a_support_on_a_reducer_moves_to_its_nearer_end(load):
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0), 80.0)
    text += block("REDUCER-CONCENTRIC", ((1000, 0, 0), 80), ((1102, 0, 0), 100))
    text += pipe((1102, 0, 0), (3000, 0, 0)) + support((1080, 0, 0), "SKID", "DOWN")
    model = load(text).model
    assert [s.node for s in model.supports] == ["30"]
    assert len(model.pipes) == 3


def test_a_spring_is_a_hanger_to_be_designed(load):
    text = STRAIGHT + support((1500, 0, 0), "SPRG", "UP")
    imported = load(text, anchors=("10",))
    (hanger,) = (s for s in imported.model.supports if s.kind == "hanger")
    assert (hanger.node, hanger.design.variation) == ("30", 0.25)
    assert any("selected by the program" in str(a) for a in imported.assumed)
    table = TABLE + '"SPRG*" = "SPRING LOAD=5kN RATE=50N/mm"\n'
    (given,) = (s for s in load(text, table).model.supports if s.kind == "hanger")
    assert (given.load, given.k, given.design) == (5000.0, 50e3, None)


def test_a_spring_without_a_temperature_is_named_and_taken_as_a_rest(load):
    table = TABLE.replace('T1 = "150C"\n', "")
    text = STRAIGHT + support((1000, 0, 0), "SPRG", "UP")
    with pytest.raises(DeckError, match="a spring to be selected, and no temperature: give T1"):
        load(text, table)
    (rest,) = load(text, table, permissive=True).model.supports
    assert [d.word for d in rest.directions] == ["+Z"]


def test_flanges_and_valves_keep_their_names(whole):
    bodies = {(p.start, p.end): p.body for p in whole.model.pipes if p.rigid and p.weight}
    assert bodies["100", "110"] == bodies["380", "390"] == "FLANGE"
    assert bodies["370", "380"] == bodies["260", "270"] == "VALVE"
    assert bodies["230", "240"] == ""  # INSTRUMENT


def test_a_branch_on_the_surface_of_a_pipe_is_joined_to_its_axis(whole):
    stub = named(whole.model, ("120", "400"))
    assert (stub.rigid, stub.delta, stub.section) == (True, (0.0, 0.057, 0.0), "1IN-40")
    assert any("ends on the surface of a pipe" in str(a) for a in whole.assumed)


def test_supports_of_one_point_are_one_card(whole):
    found = {
        s.node: [(d.word, d.gap) for d in s.directions]
        for s in whole.model.supports
        if s.kind == "support"
    }
    none = (0.0, 0.0)
    assert found == {
        "130": [("+Z", none)],
        "190": [("+Z", none), ("X", none)],
        "220": [("+Z", none), ("GUIDE", (0.003, 0.003))],
    }
    assert whole.model.settings.mu == 0.3


def test_equipment_is_an_anchor_and_is_reported(whole):
    assert [s.node for s in whole.model.supports if s.kind == "anchor"] == ["100"]
    assert any(
        "END-CONNECTION-EQUIPMENT P-101/N1 taken as an anchor" in str(a) for a in whole.assumed
    )


def test_temperatures_and_pressures_come_from_the_table(whole):
    for p in whole.model.pipes:
        assert (p.operation.t, p.operation.p) == ({"1": 150.0}, {"1": 1e6})


def test_comments_say_what_came_from_where(whole):
    deck = whole.deck()
    assert "! line 18: PIPE P100 Pipe 114.3x6.02mm" in deck
    assert deck.startswith("! Made from line.pcf: PCF")


def test_a_converted_deck_is_the_same_model(whole):
    assert read_text(whole.deck()) == whole.model
    assert read_text(whole.deck()).deck() == whole.model.deck()


def test_the_line_solves_and_is_certified(whole):
    results = trunnion.solve(whole.model)
    assert all(case.certificate.passed for case in results.cases.values())
    sustained = results["SUS"].supports
    assert sustained is not None


STRAIGHT = HEADER + pipe((0, 0, 0), (1000, 0, 0)) + pipe((1000, 0, 0), (3000, 0, 0))


def test_without_a_side_table_the_error_names_what_is_missing(tmp_path):
    path = tmp_path / "line.pcf"
    path.write_text(STRAIGHT)
    with pytest.raises(DeckError) as error:
        read_any(path)
    assert any("PIPE of line 10: wall of bore 100 is not in the file" in t for t in texts(error))
    assert any("material is not in the file" in t for t in texts(error))
    model = read_any(path, permissive=True)
    assert "taken as schedule STD" in str(model.left_out[0])


@pytest.mark.parametrize(("gap", "joined"), [(0.9, True), (1.1, False)])
def test_ends_within_the_tolerance_are_joined(load, gap, joined):
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0)) + pipe((1000 + gap, 0, 0), (3000, 0, 0))
    if joined:
        assert len(load(text).model.nodes) == 1
        return
    with pytest.raises(DeckError) as error:
        load(text)
    (said,) = texts(error)
    assert said.startswith("line: gap of 1.10 mm in the line: PIPE of line 10 ends at E 1000.00")
    assert "PIPE of line 13 at E 1001.10" in said
    assert len(load(text, tolerance=0.002).model.nodes) == 1


def test_a_chain_of_near_ends_is_not_one_joint(load):
    ends = [pipe((i * 0.8, i * 1000.0, 0), (1000, 0, 500 + i * 500)) for i in range(3)]
    model = load(HEADER + "".join(ends), permissive=True).model
    assert len({p.start for p in model.pipes} | {p.end for p in model.pipes}) == 6


def test_pipes_on_each_other_are_refused(load):
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0)) + pipe((900, 0, 0), (3000, 0, 0))
    with pytest.raises(DeckError, match=r"overlaps PIPE of line 1[03]: an end of one"):
        load(text)


def test_a_list_of_fittings_is_no_line(load):
    parts = [block("FLANGE", (0, i * 900.0, 0), (60, i * 900.0, 0), WEIGHT="7") for i in range(6)]
    with pytest.raises(DeckError, match="12 of 12 ends have no mate"):
        load(HEADER + "".join(parts))


def test_open_ends_make_a_mechanism_until_they_are_anchored(load):
    free = load(STRAIGHT).model
    assert sum("is free" in str(a) for a in free.origin.assumed) == 2
    with pytest.raises(ModelError, match="line 10-30"):
        trunnion.solve(free)
    held = load(STRAIGHT, anchors=("open-ends",)).model
    assert [s.node for s in held.supports] == ["10", "30"]
    assert trunnion.solve(held)["SUS"].certificate.passed


def anchors(imported):
    return [s.node for s in imported.model.supports if s.kind == "anchor"]


def assumed(imported):
    return "\n".join(str(a) for a in imported.assumed)


def test_every_end_that_open_ends_anchors_is_listed(load):
    said = assumed(load(STRAIGHT, anchors=("open-ends",)))
    for node, where in (("10", "E 0.00"), ("30", "E 3000.00")):
        assert f"node {node}: open end of PIPE" in said
        assert f"at {where} N 0.00 U 0.00 mm anchored (open-ends)" in said
    assert "is free" not in said


@pytest.mark.parametrize("keyword", ["CAP", "PLUG", "FLANGE-BLIND"])
def test_an_end_closed_by_one_point_is_a_mass_and_never_anchored(load, keyword):
    closed = block(keyword, (3000, 0, 0), WEIGHT="5")
    imported = load(STRAIGHT + closed, anchors=("open-ends",))
    assert anchors(imported) == ["10"]
    (mass,) = imported.model.masses
    assert (mass.node, mass.mass) == ("30", pytest.approx(5.0))
    assert len(imported.model.pipes) == 2


def test_a_cap_without_length_and_weight_is_reported(load):
    imported = load(STRAIGHT + block("CAP", (3000, 0, 0)), anchors=("open-ends",))
    assert anchors(imported) == ["10"]
    assert "CAP of line 16: closes node 30" in assumed(imported)
    with pytest.raises(DeckError, match="FLANGE-BLIND of line 16: its weight is not in the file"):
        load(STRAIGHT + block("FLANGE-BLIND", (3000, 0, 0)))


def test_a_cap_reaches_from_its_one_end_to_its_coordinates(load):
    cap = block("CAP", (3000, 0, 0)) + "    CO-ORDS 3050.0 0.0 0.0\n"
    imported = load(STRAIGHT + cap, anchors=("open-ends",))
    assert anchors(imported) == ["10"]
    assert imported.model.pipes[-1].delta == pytest.approx((0.05, 0.0, 0.0))


def test_a_cap_written_from_its_far_side_closes_the_end_as_well(load):
    cap = block("CAP", (3050, 0, 0), (3000, 0, 0))
    assert anchors(load(STRAIGHT + cap, anchors=("open-ends",))) == ["10"]


def test_a_cap_that_closes_nothing_is_free_and_reported(load):
    cap = block("CAP", (9000, 0, 0), (9050, 0, 0))
    imported = load(STRAIGHT + cap, anchors=("open-ends",))
    assert anchors(imported) == ["10", "30"]
    assert "is free; not for open-ends: it closes nothing" in assumed(imported)
    with pytest.raises(DeckError, match="CAP of line 16: no length, and no component ends there"):
        load(STRAIGHT + block("CAP", (9000, 0, 0)))


@pytest.mark.parametrize("kind", ["CLOSED", "VENT", "DRAIN"])
def test_an_end_in_the_air_is_no_open_end(load, kind):
    text = STRAIGHT + f"END-POSITION-{kind}\n    CO-ORDS 3000.0 0.0 0.0\n"
    imported = load(text, anchors=("open-ends",))
    assert anchors(imported) == ["10"]
    assert f"is free; not for open-ends: END-POSITION-{kind}" in assumed(imported)


def test_a_text_goes_on_in_a_continuation_record(load):
    text = support((1000, 0, 0), "SKID", "DOWN").rstrip() + "\n    DESCRIPTION SHOE OF\n"
    for indent in ("", "    "):
        by_text = TABLE + '"SHOE OF TYPE 7" = "Z"\n'
        imported = load(STRAIGHT + text + f"{indent}CONTINUATION TYPE 7\n", by_text)
        assert imported.model.supports[-1].directions[0].word == "Z"


def test_a_body_without_length_within_a_pipe_splits_it_under_its_mass(load):
    text = STRAIGHT + block("INSTRUMENT", (500, 0, 0), WEIGHT="9").replace(
        "    WEIGHT", "    END-POINT 500.0 0.0 0.0 100\n    WEIGHT"
    )
    model = load(text).model
    (mass,) = model.masses
    assert model.pipes[0].end == mass.node
    assert (model.pipes[0].delta, mass.mass) == ((0.5, 0.0, 0.0), pytest.approx(9.0))


GAP = HEADER + pipe((0, 0, 0), (1000, 0, 0)) + pipe((1003, 0, 0), (3000, 0, 0))
UNKNOWN = STRAIGHT + block("FLUX-CAPACITOR", (3000, 0, 0), (3500, 0, 0))
UNKNOWN += pipe((3500, 0, 0), (6000, 0, 0))


@pytest.mark.parametrize(
    ("text", "held", "why"),
    [
        (GAP, ["10", "40"], "gap of 3.00 mm in the line"),
        (UNKNOWN, ["10", "50"], "FLUX-CAPACITOR of line 16 is left out"),
    ],
)
def test_a_cut_in_the_line_is_not_held_by_anchors_of_open_ends(load, text, held, why):
    imported = load(text, permissive=True, anchors=("open-ends",))
    assert anchors(imported) == held
    said = assumed(imported)
    assert said.count(f"is free; not for open-ends: {why}") == 2
    second = imported.model.nodes[1].label
    assert "2 separate parts, not joined to each other: from node 10 (line 10), from" in said
    assert f"from node {second} (line " in said


def test_the_third_end_at_a_gap_is_no_open_end_either(load):
    text = GAP + pipe((1000, 3, 0), (1000, 3000, 0))
    imported = load(text, permissive=True, anchors=("open-ends",))
    assert len(anchors(imported)) == 3
    assert assumed(imported).count("not for open-ends: gap of") == 3


def test_the_branch_that_a_teed_elbow_loses_is_no_open_end(load):
    bend = block(
        "ELBOW-TEED",
        *((2847.6, 0, 0), (3000, 152.4, 0)),
        centre=(3000, 0, 0),
        branch=(3100, 0, 0),
    )
    text = HEADER + pipe((0, 0, 0), (2847.6, 0, 0)) + bend
    text += pipe((3000, 152.4, 0), (3000, 900, 0)) + pipe((3100, 0, 0), (4000, 0, 0), 80.0)
    imported = load(text, permissive=True, anchors=("open-ends",))
    assert len(anchors(imported)) == 3
    assert "not for open-ends: the branch of ELBOW-TEED of line 13 is left out" in assumed(imported)


@pytest.mark.parametrize("command", ["check", "run"])
def test_a_permissive_model_that_fails_says_what_it_lacks(tmp_path, command):
    (tmp_path / "line.pcf").write_text(GAP)
    words = [sys.executable, "-m", "trunnion", command, "line.pcf", "--permissive"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith("from line.pcf, PCF")
    assert "\nLEFT OUT: line: gap of 3.00 mm in the line: PIPE of line 10 ends at" in done.stderr
    assert "\nassumed: node 20: end of PIPE of line 10" in done.stderr
    assert "structure: " in done.stderr


def test_a_batch_names_what_a_model_that_fails_lacks(tmp_path):
    (tmp_path / "line.pcf").write_text(GAP)
    entry = trunnion.batch([tmp_path / "line.pcf"], tmp_path / "out", permissive=True)["line"]
    assert any(cause.startswith("LEFT OUT: line: gap of 3.00 mm") for cause in entry.causes)


def test_errors_of_every_kind_come_at_once(tmp_path):
    """An unknown component, a gap, walls of two bores, material, two weights, a support."""
    path = tmp_path / "line.pcf"
    text = UNKNOWN + pipe((6003, 0, 0), (7000, 0, 0))
    text += block("VALVE", (7000, 0, 0), (7300, 0, 0))
    text += block("REDUCER-CONCENTRIC", ((7300, 0, 0), 100), ((7400, 0, 0), 80))
    text += block("INSTRUMENT", (7400, 0, 0), (7600, 0, 0), bore=80.0)
    path.write_text(text + support((500, 0, 0), None, None, "CA-77"))
    with pytest.raises(DeckError) as error:
        read_any(path)
    said = "\n".join(texts(error))
    for words in (
        "FLUX-CAPACITOR is no component",
        "gap of 3.00 mm",
        "wall of bore 100",
        "wall of bore 80",
        "material is not in the file",
        "VALVE of line 25: its weight",
        "INSTRUMENT of line 31: its weight",
        "CA-77: nothing says what it holds",
    ):
        assert said.count(words) == 1, words
    assert len(error.value.problems) == 8


def test_what_a_file_lacks_is_told_with_points_that_cannot_be_read(tmp_path):
    path = tmp_path / "line.pcf"
    path.write_text(STRAIGHT.replace("3000.0000", "3OOO") + block("VALVE", (0, 0, 0), (-300, 0, 0)))
    with pytest.raises(DeckError) as error:
        read_any(path)
    said = texts(error)
    assert [text.partition(": ")[2][:24] for text in said] == [
        "wall of bore 100 is not ",
        "material is not in the f",
        "END-POINT: 3OOO is no co",
        "its weight is not in the",
    ]


def test_gaps_and_supports_wait_for_a_side_table_that_can_be_read(load):
    text = UNKNOWN + pipe((6003, 0, 0), (7000, 0, 0)) + support((500, 0, 0), None, None, "CA-77")
    with pytest.raises(DeckError) as error:
        load(text, "mux = 1\n")
    said = "\n".join(texts(error))
    assert "mux is no part" in said
    for later in ("gap of", "CA-77", "wall of bore"):
        assert later not in said


def test_faults_of_the_side_table_come_with_those_of_the_file(load):
    with pytest.raises(DeckError) as error:
        load(UNKNOWN, "mux = 1\n")
    said = "\n".join(texts(error))
    assert "mux is no part" in said
    assert "FLUX-CAPACITOR is no component" in said
    assert "wall" not in said  # the table may have it


def test_an_anchor_by_label_or_coordinates(load):
    model = load(STRAIGHT, anchors=("20", "3000,0,0")).model
    assert [s.node for s in model.supports] == ["20", "30"]
    with pytest.raises(DeckError, match="--anchor 77: there is no such node; open ends are 10, 30"):
        load(STRAIGHT, anchors=("77",))


def test_the_run_of_a_tee_is_what_is_in_line(load):
    tee = block("TEE", (0, 0, 0), ((100, 100, 0), 80), centre=(100, 0, 0), branch=(200, 0, 0))
    runs = (
        pipe((0, 0, 0), (-1000, 0, 0))
        + pipe((200, 0, 0), (1000, 0, 0))
        + pipe((100, 100, 0), (100, 900, 0), 80.0)
    )
    imported = load(HEADER + runs + tee)
    assert not [a for a in imported.assumed if "in line" in str(a)]
    assert len(imported.model.pipes) == 6


def test_a_tee_of_one_point_is_a_joint(load):
    tee = block("TEE", (500, 0, 0), (500, 0, 0), centre=(500, 0, 0), branch=(500, 0, 0))
    runs = (
        pipe((0, 0, 0), (500, 0, 0))
        + pipe((500, 0, 0), (1000, 0, 0))
        + pipe((500, 0, 0), (500, 700, 0), 80.0)
    )
    model = load(HEADER + runs + tee + tee).model
    assert len(model.pipes) == 3
    assert len(model.nodes) == 1


def test_unequal_tangents_are_an_error_with_both_lengths(load):
    bend = block("BEND", (0, 0, 0), (200, 150, 0), centre=(200, 0, 0), BEND_RADIUS="152.4")
    with pytest.raises(DeckError, match=r"tangents are 200\.00 and 150\.00 mm long"):
        load(HEADER + bend)


def test_the_turn_of_a_bend_is_not_its_angle_record(load):
    """13500 for a turn of 45 degrees: 180 less the turn, as one exporter writes."""
    d = 100.0 / 2**0.5
    bend = block("BEND", (0, 0, 0), (100 + d, d, 0), centre=(100, 0, 0), ANGLE="13500")
    text = HEADER + pipe((-1000, 0, 0), (0, 0, 0)) + bend
    (made,) = load(text + pipe((100 + d, d, 0), (100 + 9 * d, 9 * d, 0))).model.bends
    # T = R tan(22.5 deg); the file has four decimals of a millimetre
    assert made.radius == pytest.approx(0.1 / (2**0.5 - 1.0), rel=1e-5)


def test_two_elbows_face_to_face_share_their_tangents(load):
    """Coordinates of four decimals: no pipe of a thousandth of a millimetre is left over."""
    one = block("ELBOW", (0, 0, 0), (152.4001, 152.4, 0), centre=(152.4, 0, 0))
    other = block("ELBOW", (152.4, 152.4, 0), (304.8, 304.8002, 0), centre=(152.4, 304.8001, 0))
    text = pipe((-1000, 0, 0), (0, 0, 0)) + pipe((304.8, 304.8002, 0), (2000, 304.8002, 0))
    model = load(HEADER + text + one + other, anchors=("open-ends",)).model
    assert [(p.start, p.end) for p in model.pipes] == [("10", "20"), ("20", "30"), ("30", "40")]
    results = trunnion.solve(model)
    assert results["OPE"].certificate.passed


def test_a_support_within_a_bend_stands_on_its_middle(load):
    bend = block("ELBOW", (847.6, 0, 0), (1000, 152.4, 0), centre=(1000, 0, 0))
    text = HEADER + pipe((0, 0, 0), (847.6, 0, 0)) + bend + pipe((1000, 152.4, 0), (1000, 900, 0))
    model = load(text + support((955, 45, 0), "SKID", "DOWN")).model
    assert [s.node for s in model.supports] == [f"{model.bends[0].node}M"]


def test_a_support_on_nothing_is_an_error(load):
    with pytest.raises(DeckError, match="stands on no pipe; PIPE of line 10 is 300 mm away"):
        load(STRAIGHT + support((500, 300, 0), "SKID", "DOWN"))


def test_a_name_that_nothing_explains_is_an_error(load):
    with pytest.raises(DeckError, match="CA-77: nothing says what it holds"):
        load(STRAIGHT + support((500, 0, 0), None, None, "CA-77"))


@pytest.mark.parametrize(
    ("skey", "direction", "words"),
    [
        ("SKID", "DOWN", ["+Z"]),
        ("SKID", "UP", ["-Z"]),
        ("SKID", "NORTH", ["-Y"]),
        ("SKID", "EAST", ["-X"]),
        ("GUID", "NORTH", ["Y"]),
        ("SKID", None, ["+Z"]),
        ("GUID", None, ["GUIDE"]),
    ],
)
def test_what_keys_and_directions_of_supports_mean(load, skey, direction, words):
    (made,) = load(STRAIGHT + support((500, 0, 0), skey, direction)).model.supports
    assert [d.word for d in made.directions] == words


def test_both_directions_of_a_line_are_one_two_way_stop(load):
    both = support((500, 0, 0), "SKID", "EAST") + support((500, 0, 0), "SKID", "WEST")
    (made,) = load(STRAIGHT + both).model.supports
    assert [d.word for d in made.directions] == ["X"]


@pytest.mark.parametrize(
    ("unit", "bore"), [("MM", "100"), ("MM", "101.6"), ("MM", "114.3"), ("INCH", "4.0")]
)
def test_every_way_of_writing_a_bore_is_the_same_pipe(load, unit, bore):
    """One size alone is ambiguous (101.6 is also the OD of NPS 3.5): DN, inches, OD in turn."""
    head = HEADER.replace("UNITS-BORE MM", f"UNITS-BORE {unit}")
    (section,) = load(head + pipe((0, 0, 0), (1000, 0, 0), float(bore))).model.sections.values()
    assert (section.nps, section.od) == ("4", 0.1143)


def test_a_bore_of_no_size_is_an_error_that_the_table_can_mend(load):
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0), 123.4)
    with pytest.raises(DeckError, match=r"bore 123\.4 is no nominal size"):
        load(text)
    table = TABLE + '[[rule]]\nbore = 123.4\nOD = "150mm"\nWALL = 8\n'
    (section,) = load(text, table).model.sections.values()
    assert (section.od, section.wall) == (0.15, 0.008)


def test_a_csv_table_gives_walls_by_spec_item_and_bore(load):
    table = "spec, item, bore, wall, material, T1\nCS1,,100,6.5,A106-B,160\n*,P9,,9mm,A106-B,\n"
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0)) + pipe((1000, 0, 0), (2000, 0, 0), ITEM_CODE="P9")
    sections = load(text, table, suffix=".csv").model.sections
    assert sorted(s.wall for s in sections.values()) == [0.0065, 0.009]


def test_components_without_the_temperature_of_others_are_named(load):
    text = STRAIGHT + "PIPELINE-REFERENCE LINE-B\n    PIPING-SPEC CS2\n"
    text += pipe((3000, 0, 0), (4000, 0, 0))
    table = '[defaults]\nMATERIAL = "A106-B"\nSCH = "40"\n[[rule]]\nspec = "CS2"\nT1 = "200C"\n'
    imported = load(text, table)
    assert "T1 of PIPE of line 10 and of 1 more is not given: they stay cold" in assumed(imported)
    assert [p.operation.t["1"] for p in imported.model.pipes] == [20.0, 20.0, 200.0]


def test_attributes_mean_what_the_table_says(load):
    table = '[attributes]\nCOMPONENT-ATTRIBUTE1 = "P1"\nCOMPONENT-ATTRIBUTE4 = "WALL"\n'
    table += 'COMPONENT-ATTRIBUTE2 = "T1"\nR2_MATERIAL = "MATERIAL"\n'
    said = {"COMPONENT_ATTRIBUTE1": "600 KPA", "COMPONENT_ATTRIBUTE4": "5.5 MM"}
    said |= {"COMPONENT_ATTRIBUTE2": "Undefined C"}
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0), **said).replace(
        "\n    COMPONENT-ATTRIBUTE1", "\n    R2_MATERIAL A106-B\n    COMPONENT-ATTRIBUTE1"
    )
    model = load(text, table).model
    (section,), (made,) = model.sections.values(), model.pipes
    assert section.wall == pytest.approx(0.0055, rel=1e-15)
    assert made.operation.p == {"1": 600e3}
    assert made.operation.t == {}  # a placeholder is no value
    assert made.material == "A106-B"


def test_a_weight_that_nothing_gives_is_an_error(load):
    text = STRAIGHT + block("VALVE", (3000, 0, 0), (3300, 0, 0))
    with pytest.raises(DeckError, match="VALVE of line 16: its weight is not in the file"):
        load(text)
    table = TABLE + '[[rule]]\ncomponent = "VALVE*"\nNPS = 4\nWEIGHT = "45kg"\n'
    assert load(text, table).model.pipes[-1].weight == pytest.approx(45 * G)


def test_a_valve_without_length_is_a_mass(load):
    text = STRAIGHT + block("VALVE", (1000, 0, 0), (1000, 0, 0), WEIGHT="32")
    (mass,) = load(text).model.masses
    assert (mass.node, mass.mass) == ("20", pytest.approx(32.0))


def test_unknown_components_and_branch_bends_are_named(load):
    text = STRAIGHT + block("FLUX-CAPACITOR", (3000, 0, 0), (3300, 0, 0))
    with pytest.raises(DeckError, match="FLUX-CAPACITOR is no component"):
        load(text)
    bend = block("ELBOW-TEED", (847.6, 5000, 0), (1000, 5152.4, 0), centre=(1000, 5000, 0))
    with pytest.raises(
        DeckError, match="ELBOW-TEED of line 16: a fitting with a branch of its own"
    ):
        load(STRAIGHT + bend)


def test_a_file_cut_off_in_a_component_is_an_error(load):
    with pytest.raises(DeckError, match="PIPE of line 13: 1 END-POINT; a PIPE has 2"):
        load(STRAIGHT[: STRAIGHT.rindex("    END-POINT")])


def test_a_file_may_begin_with_any_component(load):
    with pytest.raises(DeckError, match="UNITS-BORE is missing"):
        load(block("ELBOW", (0, 0, 0), (150, 150, 0), centre=(150, 0, 0)))


def test_units_that_are_missing_are_an_error(load):
    text = STRAIGHT.replace("UNITS-CO-ORDS MM\n", "")
    with pytest.raises(DeckError, match="UNITS-CO-ORDS is missing"):
        load(text)
    assert load(text, permissive=True).model.pipes[0].delta == (1.0, 0.0, 0.0)


def test_indentation_by_tabs_or_none_and_brackets_around_keywords(load):
    expected = load(STRAIGHT).model
    assert load(STRAIGHT.replace("    ", "\t")).model == expected
    assert load(STRAIGHT.replace("    ", "")).model == expected
    assert (
        load(STRAIGHT.replace("END-POINT", "<END-POINT>").replace("\n", "\r\n")).model == expected
    )


def test_a_plant_datum_a_thousand_kilometres_away_changes_no_length(load):
    far = HEADER + pipe((1e9 - 1000, 0, 0), (1e9, 0, 0))
    near = HEADER + pipe((-1000, 0, 0), (0, 0, 0))
    assert load(far).model.pipes[0].delta == pytest.approx(
        load(near).model.pipes[0].delta, rel=1e-9
    )


def test_every_fault_of_a_side_table_is_told(load):
    table = 'mux = 1\n[defaults]\nWAL = 3\nT1 = "hot"\n[[rule]]\nbore = "x"\n[supports]\nA = "+W"\n'
    with pytest.raises(DeckError) as error:
        load(STRAIGHT, table)
    said = "\n".join(texts(error))
    for words in ("mux is no part", "key WAL is not known", "T1: hot", "BORE: x", "supports: A:"):
        assert words in said


def test_ten_thousand_ends_at_one_place_are_joined_quickly_or_refused(load):
    crowd = [pipe((0, 0, i * 1e-4), (1000, i * 1.0, 0)) for i in range(3000)]
    with pytest.raises(DeckError, match="too many different points within 1 mm"):
        load(HEADER + "".join(crowd))


def test_options_of_a_pcf_mean_nothing_for_other_formats(tmp_path):
    path = tmp_path / "line.xml"
    path.write_text('<CAESARII VERSION="14.00" XML_TYPE="Input"/>')
    with pytest.raises(DeckError, match="--anchor means nothing for a CAESAR II input XML"):
        read_any(path, options=Options(anchors=("10",)))


def test_open_ends_that_do_not_face_each_other_are_two_ends(load):
    """A stub that ends 90 mm beside the end of another pipe is no gap of the line."""
    run = pipe((0, 0, 0), (1000, 0, 0))
    model = load(HEADER + run + pipe((1000, 90, -500), (1000, 90, 0))).model
    assert len(model.nodes) == 2
    with pytest.raises(DeckError, match=r"gap of 90\.00 mm"):
        load(HEADER + run + pipe((1090, 0, 0), (2000, 0, 0)))
    with pytest.raises(DeckError, match=r"gap of 40\.00 mm"):
        load(HEADER + run + pipe((1000, 40, -500), (1000, 40, 0)))


def test_a_set_on_branch_without_ends_stands_on_a_run_that_goes_through(load):
    """TEE-SET-ON of a plant's export: CENTRE-POINT on the run, BRANCH1-POINT, no END-POINT."""
    tee = block("TEE-SET-ON", centre=(500, 0, 0), branch=(500, 90, 0), branch_bore=50.0)
    text = HEADER + pipe((0, 0, 0), (1000, 0, 0)) + tee + pipe((500, 90, 0), (500, 600, 0), 50.0)
    model = load(text).model
    stiff = [p for p in model.pipes if p.rigid]
    assert len(stiff) == 1
    assert stiff[0].delta == pytest.approx((0.0, 0.05715, 0.0))  # half of 114.3 mm


def test_a_name_at_many_supports_is_a_type_and_no_name(load):
    rest = "".join(support((x, 0, 0), name="VAR-SHOE-7") for x in (1000, 2000))
    text = HEADER + pipe((0, 0, 0), (3000, 0, 0)) + rest
    text += support((2500, 0, 0), name="VAR-SHOE-8")
    result = load(text)
    assert [s.name for s in result.model.supports] == [None, None, "VAR-SHOE-8"]
    assert result.deck().count("VAR-SHOE-7") >= 2


def test_headers_messages_and_items_of_a_plant_model(load):
    """UID before the pipeline, MESSAGE blocks, MATERIAL-IDENTIFIER for the item."""
    text = HEADER.replace("PIPELINE-REFERENCE", "UID 6517D368\nPIPELINE-REFERENCE")
    text += pipe((0, 0, 0), (1000, 0, 0), MATERIAL_IDENTIFIER=3)
    text += "MESSAGE\n    CO-ORDS 0.0 0.0 0.0\n    TEXT DL G465B\nMATERIALS\n"
    text += "MATERIAL-IDENTIFIER 3\n    ITEM-CODE PCAD_R1s\n    DESCRIPTION Rohr 60,3x4\n"
    table = TABLE + '\n[[rule]]\nitem = "PCAD*"\nWALL = "4mm"\n'
    result = load(text, table)
    assert next(iter(result.model.sections.values())).wall == 0.004
    assert "Rohr 60,3x4" in result.deck()


def test_decimal_commas_are_read_where_the_whole_file_has_them(load):
    whole = load(everything())
    commas = "\n".join(
        line.replace(".", ",") if "POINT" in line or "CO-ORDS" in line or "WEIGHT" in line else line
        for line in everything().split("\n")
    ).replace("ISOGEN,FLS", "ISOGEN.FLS")
    result = load(commas)
    assert result.model == whole.model
    assert any("decimal commas" in a.text for a in result.assumed)


@pytest.mark.parametrize("meaning", ["", '[attributes]\nPIPELINE-TEMP = "T2"\n'])
def test_a_temperature_of_the_header_is_taken_or_named(load, meaning):
    head = HEADER.rstrip("\n") + "\n    PIPELINE-TEMP 180\n"
    found = load(everything().replace(HEADER, head, 1), TABLE + meaning)
    said = [a.text for a in found.assumed if "PIPELINE-TEMP" in a.text]
    hot = {pipe.operation.t.get("2") for pipe in found.model.pipes}
    if meaning:
        assert said == []
        assert hot == {180.0}
    else:
        text = "PIPELINE-TEMP 180 is not read; give it a meaning under [attributes]"
        assert said == [f"{text} of the side table"]
        assert hot == {None}
