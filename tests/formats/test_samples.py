"""Our own sample files of models/foreign: what they say is what the model has, and goes round."""

import json
import math

import cii_jobs as cj
import pytest
from samples import FOLDER, files

import trunnion
from trunnion.deck.reader import read_text
from trunnion.formats import Findings, Options, read_any
from trunnion.formats.caesar import read
from trunnion.formats.source import source_of
from trunnion.report.json import json_report

SAMPLES = [name for name in files() if not name.endswith(".toml")]
NEUTRAL = [name for name in SAMPLES if name.endswith(".cii")]
XML = [name for name in SAMPLES if name.endswith(".xml")]
G = 9.80665


def cases_of(model):
    """The cases of the JSON report, from the model's default cases."""
    return json.loads(json_report(trunnion.solve(model), model))["cases"]


def imported(name):
    options = Options()
    if name.endswith(".pcf"):
        options = Options(table=FOLDER / "plant_line.toml", anchors=("open-ends",))
    return read_any(FOLDER / name, options=options)


@pytest.mark.parametrize("name", files())
def test_committed_files_are_those_that_the_description_gives(name):
    assert (FOLDER / name).read_bytes() == files()[name], "run tests/helpers/samples.py"


@pytest.mark.parametrize("name", SAMPLES)
def test_nothing_is_left_out_and_the_deck_is_the_same_model(name):
    result = imported(name)
    assert not result.left_out
    deck = result.deck()
    assert read_text(deck) == result.model
    assert read_text(read_text(deck).deck()) == result.model
    assert read_text(deck).deck() == result.model.deck()


@pytest.mark.parametrize("name", SAMPLES)
def test_every_case_is_certified_and_its_loads_balance(name):
    model = imported(name).model
    up = "YZ".index(model.settings.up) + 1
    for case in cases_of(model).values():
        assert case["converged"]
        if case["kind"] == "case":
            load, held = case["loads"]["force"][up], case["reactions"]["force"][up]
            assert held == pytest.approx(-load, rel=1e-9)


def pipe_weight(length, od, wall):
    """Metal, contents and insulation of `cii_jobs.PIPE` [N]; mm, by hand."""
    bore, cover = od - 2 * wall, od + 2 * 75.0
    metal = 7833.44 * (od**2 - bore**2) + 850.0 * bore**2 + 140.0 * (cover**2 - od**2)
    return math.pi / 4 * metal * 1e-6 * G * length / 1e3


@pytest.mark.parametrize("name", NEUTRAL)
def test_the_hot_line_has_what_its_file_says(name):
    model = imported(name).model
    late = "15" in name
    assert [p.card for p in model.pipes if p.card != "PIPE"] == [
        *("FLANGE" if "7.01" not in name else "RIGID", "VALVE" if "7.01" not in name else "RIGID"),
        *(["JOINT", "RIGID"] if late else ["JOINT"]),  # the tee's branch inside its run
        "REDUCER",
    ]
    assert [b.node for b in model.bends] == ["70", "80", "100", "180"]
    rests = [s for s in model.supports if any(d.word == "+Y" for d in s.directions)]
    assert [s.node for s in rests] == ["50", "60", "110", "120", "140"]
    assert {d.mu for s in rests for d in s.directions if d.word == "+Y"} == {0.3}
    words = {(s.node, d.word): d.gap for s in model.supports for d in s.directions}
    assert words["60", "GUIDE"] == (0.003, 0.003)
    assert words["120", "LIMIT"] == (0.005, 0.005)
    designed, given = (s for s in model.supports if s.kind == "hanger")
    assert (designed.node, designed.design.table) == ("90", "ANVIL")
    assert (given.node, given.k, given.load) == ("160", 20000.0, 3500.0)
    (moved,) = model.displacements
    assert (moved.node, moved.set) == ("10", "1")
    assert moved.d == pytest.approx((0.0005, 0.002, 0.0, 0.0, 0.0, 0.0))
    assert len(model.springs) == late


@pytest.mark.parametrize("name", NEUTRAL)
def test_the_weight_of_the_hot_line_is_that_of_its_elements(name):
    """Rigids weigh what they say, contents and 1.75 times the insulation; bends are shorter."""
    model = imported(name).model
    found = -cases_of(model)["SUS"]["loads"]["force"][1]
    straight = 3000 + 6000 + 3000 + 4000 + 2500 + 3000 + 5000 + 3000 + 2000 + 3000 + 1000 + 1100
    cut = 381.0 * (2.0 - math.pi / 2)  # of each elbow of 90 degrees
    big = pipe_weight(straight + 400 + 400 - 3 * cut, 273.05, 9.271)  # the joint weighs as pipe
    bore, cover = 273.05 - 2 * 9.271, 273.05 + 150.0
    inside = 850.0 * bore**2 + 1.75 * 140.0 * (cover**2 - 273.05**2)
    rigid = 6100.0 + math.pi / 4 * inside * 1e-6 * G * 0.7
    six = pipe_weight(1200 + 150, 168.3, 7.11)
    four = pipe_weight(150 + 3500 - 152.4 * (2.0 - math.pi / 2), 114.3, 6.02)
    assert found == pytest.approx(big + rigid + six + four, rel=4e-3)  # the taper, the tee


@pytest.mark.parametrize("name", XML)
def test_the_skid_line_has_what_its_file_says(name):
    result = imported(name)
    model = result.model
    assert [b.node for b in model.bends] == ["30", "70"]
    words = {(s.node, d.word): (d.gap, d.mu) for s in model.supports for d in s.directions}
    assert words["20", "+Y"] == ((0.0, 0.0), 0.3)
    assert words["55", "GUIDE"][0] == (0.003, 0.003)
    assert words["55", "LIMIT"][0] == (0.005, 0.005)
    assert next(s for s in model.supports if s.kind == "hanger").design.table == "ANVIL"
    assert {op.t["1"] for op in (p.operation for p in model.pipes)} == {180.0}
    assert len(model.springs) == ("14" in name)


def test_the_pump_line_has_what_its_file_says():
    result = imported("pump_line.pcf")
    model = result.model
    assert not any("bores" in str(text) for text in result.model.origin.assumed)  # UNITS-BORE INCH
    assert [b.radius for b in model.bends] == pytest.approx([0.762, 0.762], rel=1e-5)
    (reducer,) = (p for p in model.pipes if p.reducer)
    assert (reducer.section, reducer.reducer.section) == ("6IN-40", "4IN-40")
    assert reducer.reducer.axis == (1.0, 0.0, 0.0)
    assert reducer.delta == pytest.approx((0.14, 0.0, 0.027))
    anchors = [s.node for s in model.supports if s.kind == "anchor"]
    assert len(anchors) == 2  # the open end and the pump
    rests = [s for s in model.supports if any(d.word == "+Z" for d in s.directions)]
    assert [s.name for s in rests][1:] == ["PS-11", "PS-12"]
    assert [d.word for d in rests[2].directions] == ["+Z", "Y"]


def test_default_cases_are_those_that_the_program_proposes():
    """W+P1+H+F1 sustained; each temperature with its pressure and movements; ranges to SUS."""
    cases = cases_of(imported("hot_line_11.cii").model)
    text = {name: case["text"] for name, case in cases.items()}
    assert text["SUS"] == "W + H + P1 + F1"
    assert text["OPE1"] == "W + H + P1 + T1 + D1 + F1"
    assert text["OPE2"] == "W + H + P2 + T2 + F1"
    assert (text["EXP1"], text["EXP2"]) == ("OPE1 - SUS", "OPE2 - SUS")


@pytest.mark.parametrize("version", cj.VERSIONS)
def test_a_resting_line_has_the_reactions_of_statics(version):
    """Pinned at 10, resting with mu 0.3 at 20 six metres on, 2 m of overhang and a valve.

    Moments about 10 give the rest, the sum the pin; heated, the rest drags 0.3 of its load along
    the pipe and the pin takes it: independent of any stiffness.
    """
    c = cj.job(version)
    pin = [cj.slot(10, code) for code in (2, 3, 4, 5)]
    c.add(10, 20, dx=6000.0, RESTRANT=pin)
    rest = [cj.slot(20, cj.RESTING, mu=0.3, cosines=cj.Y), cj.slot(20, 4)]
    c.add(20, 30, dx=2000.0, RESTRANT=rest)
    c.add(30, 40, dx=500.0, RIGID=(5200.0, 1))
    source = source_of(c.text().encode("cp1252"), "line.cii")
    cases = cases_of(read(source, Findings(source)).model)
    pipe = pipe_weight(8000.0, 273.05, 9.271)
    bore, cover = 273.05 - 2 * 9.271, 273.05 + 150.0
    inside = 850.0 * bore**2 + 1.75 * 140.0 * (cover**2 - 273.05**2)
    valve = 5200.0 + math.pi / 4 * inside * 1e-6 * G * 0.5
    at_rest = (4.0 * pipe + 8.25 * valve) / 6.0
    at_pin = pipe + valve - at_rest
    for name, drag in (("SUS", 0.0), ("OPE1", 0.3 * at_rest)):
        held = {s["id"]: s["force"] for s in cases[name]["supports"]}
        assert held["20"][1] == pytest.approx(at_rest, rel=1e-4)  # constants of 4 digits
        assert held["10"][1] == pytest.approx(at_pin, rel=1e-3)
        assert held["10"][0] == pytest.approx(drag, rel=1e-4, abs=1e-6 * pipe)
        assert held["20"][0] == pytest.approx(-drag, rel=1e-4, abs=1e-6 * pipe)
    assert cases["EXP1"]["text"] == "OPE1 - SUS"
