"""Program-designed hangers: hot load, travel and selection, by hand and on whole decks."""

import json

import pytest

import trunnion
from trunnion.cases.hangers import designed, select
from trunnion.deck.reader import read_text
from trunnion.library.springs import anvil_springs, generic_springs
from trunnion.model import HangerDesign, SpringSize, Support
from trunnion.report.json import json_report
from trunnion.report.text import text_report

TABLE = (
    SpringSize("A1", "A", 1000.0, 2000.0, 60e3),
    SpringSize("A2", "A", 2000.0, 4000.0, 120e3),
    SpringSize("B1", "B", 1000.0, 2000.0, 30e3),
    SpringSize("B2", "B", 2000.0, 4000.0, 60e3),
)


def chosen(hot, travel, **asked):
    return select(Support("45", "hanger", design=HangerDesign(**asked)), hot, travel, TABLE)


def test_hot_load_design_by_hand():
    """1500 N hot, 5 mm up: 60 N/mm gives 300 N more cold, 20 % of the hot load."""
    found = chosen(1500.0, 0.005)
    assert (found.size, found.kind) == ("A1", "spring")
    assert (found.hot, found.cold) == (1500.0, pytest.approx(1800.0))
    assert found.variation == pytest.approx(0.2)


def test_downward_travel_loads_the_spring():
    found = chosen(1500.0, -0.005)
    assert found.cold == pytest.approx(1200.0)


def test_stiff_series_gives_way_where_the_load_changes_too_much():
    """7 mm: 28 % on A1, 14 % on B1; with a limit of 30 % A1 would do."""
    assert chosen(1500.0, 0.007).size == "B1"
    assert chosen(1500.0, 0.007, variation=0.3).size == "A1"
    assert chosen(1500.0, 0.007, series="A").kind == "constant"


def test_both_loads_stay_inside_the_range():
    """1900 N hot and 4 mm up: 2140 N cold is beyond A1 (2000), and 1900 is below A2: B1 1900 and
    2020 N neither, B2 no; so a constant support."""
    assert chosen(1900.0, 0.004).kind == "constant"
    assert chosen(1900.0, -0.004).size == "A1"


def test_cold_load_design_balances_the_weight_cold():
    found = chosen(1500.0, 0.005, method="COLD")
    assert (found.cold, found.hot) == (1500.0, pytest.approx(1200.0))
    assert found.variation == pytest.approx(300.0 / 1200.0)


def test_springs_side_by_side_share_the_load():
    found = chosen(3000.0, 0.005, number=2)
    assert (found.size, found.rate) == ("A1", 120e3)
    assert found.cold == pytest.approx(3600.0)


def test_rod_constant_and_none():
    assert chosen(1500.0, 0.002).kind == "rod"
    assert chosen(1500.0, 0.002, rod=0.001).kind == "spring"
    assert chosen(1500.0, 0.006, most=0.005).kind == "constant"
    assert chosen(9000.0, 0.005).reason == "no size carries the load"
    assert chosen(-10.0, 0.005).kind == "none"


def test_generic_table_is_of_preferred_numbers():
    table = generic_springs()
    assert len({size.name for size in table}) == len(table) == 3 * 28
    first = table[0]
    assert (first.least, first.most) == (200.0, 400.0)
    assert first.rate == pytest.approx(200.0 / 0.032)
    assert table[27].most == 200e3


RISER = """MATERIAL A E=203GPa ALPHA=11.7e-6 DENSITY=7850
SECTION S OD=0.2731 WALL=9.27mm
OPERATE T1=270
ANCHOR 10
PIPE 10 20 DY=6
BEND 20 R=0.4
PIPE 20 30 DX=6
HANGER 30 DESIGN {keys}
PIPE 30 40 DX=6
PIPE 40 50 DX=3
SUPPORT 50 X Y Z
{sizes}CASE SUS = W + H
CASE OPE = W + H + T1
"""


def riser(keys="", sizes=""):
    return read_text(RISER.format(keys=keys, sizes=sizes), "deck.inp")


def test_hot_load_is_the_weight_and_travel_that_of_the_free_pipe():
    """The weight case with a rigid support, and the operating case with its load as a force."""
    model = riser()
    results = trunnion.solve(model)
    (found,) = results.hangers
    rigid = RISER.format(keys="", sizes="").replace("HANGER 30 DESIGN", "SUPPORT 30 Y")
    weight = trunnion.solve(read_text(rigid.replace(" + H", ""), "deck.inp"))["SUS"]
    assert found.hot == pytest.approx(weight.supports["30"]["fy"], rel=1e-9)
    force = RISER.format(keys="", sizes="").replace(
        "HANGER 30 DESIGN", f"FORCE 30 F1 FY={found.hot!r}"
    )
    free = trunnion.solve(read_text(force.replace("+ H", "+ F1"), "deck.inp"))["OPE"]
    travel = free.displacements["30"]["uy"] - weight.displacements["30"]["uy"]
    assert found.travel == pytest.approx(travel, rel=1e-9)


def test_selected_spring_acts_in_all_cases_and_carries_the_weight_hot():
    results = trunnion.solve(riser())
    (found,) = results.hangers
    assert found.kind == "spring"
    for name in ("SUS", "OPE"):
        u = results[name].displacements["30"]["uy"]
        load = results[name].supports["30"]["fy"]
        assert load == pytest.approx(found.cold - found.rate * u, rel=1e-9)
    # in operation the pipe stands where the constant force put it, so the spring holds the hot load
    assert results["OPE"].supports["30"]["fy"] == pytest.approx(found.hot, rel=1e-6)


def test_designed_model_is_the_deck_with_the_spring_written_down():
    model = riser()
    own, (found,) = designed(model)
    card = f"HANGER 30 RATE={found.rate!r} LOAD={found.cold!r}"
    written = read_text(RISER.format(keys="", sizes="").replace("HANGER 30 DESIGN", card), "d.inp")
    assert own.supports == written.supports
    a, b = trunnion.solve(model), trunnion.solve(written)
    assert (a["OPE"].state.u == b["OPE"].state.u).all()


def test_own_table_replaces_the_generic_one():
    sizes = "SPRINGSIZE MINE-1 SERIES=MINE MIN=1 MAX=100000 RATE=20000\n"
    (found,) = trunnion.solve(riser("ROD=0", sizes)).hangers
    assert found.size == "MINE-1"


def test_rod_holds_as_a_rigid_support():
    results = trunnion.solve(riser("ROD=1"))
    assert results.hangers[0].kind == "rod"
    assert abs(results["OPE"].displacements["30"]["uy"]) < 1e-6


def test_selection_is_in_text_and_json_and_goes_round():
    model = riser("NUMBER=2 METHOD=COLD VARIATION=0.2 NAME=H1")
    assert read_text(model.deck()) == model
    results = trunnion.solve(model)
    text = text_report(results, model).decode()
    assert "HANGER SELECTION" in text
    assert "HANGERS TO BE SELECTED" in text
    found = json.loads(json_report(results, model))["hangers"]["30"]
    assert found["hot_load"] == results.hangers[0].hot
    assert found["name"] == "H1"


def test_no_operating_case_is_told():
    deck = RISER.format(keys="", sizes="").replace("CASE OPE = W + H + T1\n", "")
    with pytest.raises(trunnion.ModelError, match="no case has weight and temperature"):
        trunnion.solve(read_text(deck, "deck.inp"))


def test_the_makers_table_gives_the_springs_that_caesar_ii_selected():
    """CAESAR II 14 on a relief line, hot load [N] and travel [mm]: figure and size it printed."""
    table = anvil_springs()
    for hot, travel, size in ((7538.97, -40.667, "98-11"), (7987.29, -22.357, "B-268-11")):
        asked = Support("20", "hanger", design=HangerDesign(rod=0.0))
        assert select(asked, hot, travel / 1e3, table).size == size
    rates = {s.name: s.rate for s in table}
    assert rates["98-11"] == pytest.approx(29770.3979, rel=1e-4)  # printed: 297.703979 N/cm
    assert rates["B-268-11"] == pytest.approx(59540.7959, rel=1e-4)
    assert len(table) == 23 * 5 + 2  # sizes 000 and 00 are of figure B-268 alone


def test_the_table_of_a_hanger_is_named():
    model = riser("TABLE=ANVIL")
    results = trunnion.solve(model)
    assert results.hangers[0].series in ("82", "B-268", "98", "TRIPLE", "QUADRUPLE")
    assert "ANVIL table of the library" in text_report(results, model).decode()
    with pytest.raises(trunnion.DeckError, match="series MEDIUM is not one of"):
        riser("TABLE=ANVIL SERIES=MEDIUM")


def test_an_anchor_that_is_freed_leaves_its_weight_to_the_hanger():
    """A pipe clamped at 10 and 40, hanger at 30: FREE=40 has nothing vertical at 40, only there."""
    text = """
UNITS mm N bar C
MATERIAL S E=200GPa ALPHA=12e-6 DENSITY=7850
SECTION P OD=114.3 WALL=6.02
OPERATE T1=200 TREF=20
ANCHOR 10
PIPE 10 20 DX=6000
PIPE 20 30 DX=2000
HANGER 30 DESIGN ROD=0 {free}
PIPE 30 40 DX=2000
ANCHOR 40
CASE SUS = W + H
CASE OPE = W + H + T1
"""

    def weighed(free):
        (found,) = trunnion.solve(read_text(text.format(free=free), "deck.inp")).hangers
        return found.hot

    model = read_text(text.format(free=""), "deck.inp")
    swapped = text.replace("HANGER 30 DESIGN ROD=0 {free}", "SUPPORT 30 Y")
    held = trunnion.solve(read_text(swapped.replace(" + H", ""), "deck.inp"))["SUS"]
    assert weighed("") == pytest.approx(held.supports["30"]["fy"], rel=1e-9)
    let = swapped.replace("ANCHOR 40", "SUPPORT 40 X Z RX RY RZ").replace(" + H", "")
    free = trunnion.solve(read_text(let, "deck.inp"))["SUS"]
    assert weighed("FREE=40") == pytest.approx(free.supports["30"]["fy"], rel=1e-9)
    assert abs(weighed("FREE=40") - weighed("")) > 300.0  # N
    assert model.supports[1].kind == "hanger"
    with pytest.raises(trunnion.DeckError, match="node 41 is not defined"):
        read_text(text.format(free="FREE=41"), "deck.inp")
