"""A model built in code by the deck's words is the deck's model, and errs in the same words."""

import copy
import pickle

import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.model import Units

DECK = """\
TITLE Line
UNITS mm kN bar C
DEFAULT MU=0.3 EVENTS=ON
MATERIAL A106B E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
PROPERTY A106B T=200 E=191GPa
SECTION HDR OD=273.1 WALL=9.27 FLUID=850
OPERATE T1=170 P1=12 TREF=20
NODE 10 Y=2500
PIPE 10 20 DX=6000
BEND 20 R=381
PIPE 20 30 LENGTH=4000 DIR=(0,0,2)
RIGID 30 40 DZ=450 WEIGHT=2.1
SPRING 40 50 KX=5 AXIS=(1,1,0)
MASS 30 M=120
ANCHOR 10
SUPPORT 20M MU=0.3 +Y GUIDE GAP=3 (0.6,0.8,0) GAP=1,2 CNODE=40 NAME=PS-1
HANGER 30 RATE=50N/mm LOAD=6.2
FORCE 40 F1 FY=-5
DISPLACEMENT 10 D1 DX=4 RY=1deg
ACCELERATION U1 X=0.3
SNUBBER 30 (0.6,0,0.8) K=5
SNUBBER 40 X NAME=SN-2
WIND WIND1 DIR=(1,0,0) PRESSURE=(0,450),(10000,612.5) SHAPE=0.9
SNOW 0.2
SPECTRUM SSE Y=M/S2 TABLE=(0.5,1),(2.5,6),(33,2.5)
GROUP NORTH = 10, 40
MODES 12 ABOUT=OPE ROTARY=OFF
CASE SUS = W + P1 + H
CASE OPE = W + P1 + T1 + D1 + F1 FROM=SUS STEPS=2
COMB EXP = OPE - SUS
CASE EQN = U1 + WIND1 ABOUT=OPE NONLINEAR
CASE RSX = SPECTRUM(SSE,X) MISSING=ON ZPA=0.2
COMB ENV = SRSS(EQN,RSX) + MAX(SUS,EXP)
CYCLE HEAT = OPE, SUS TIMES=4 FROM=SUS
"""


def built():
    m = trunnion.Model("Line")
    m.units = Units("mm", "kN", "bar", "C")
    m.default(MU=0.3, EVENTS=True)
    m.material("A106B", E=203e9, NU=0.3, ALPHA=11.7e-6, DENSITY=7850)
    m.property("A106B", T=200, E="191GPa")
    m.section("hdr", OD="273.1mm", WALL="9.27mm", FLUID=850)
    m.operate(T1=170, P1="12bar", TREF=20)
    m.node(10, Y=2.5)
    m.pipe("10", "20", DX=6.0)
    m.bend(20, R=0.381)
    m.pipe(20, 30, LENGTH="4m", DIR=np.array([0, 0, 2]))
    m.rigid(30, 40, DZ=0.45, WEIGHT="2.1kN")
    m.spring(40, 50, KX=5e6, AXIS=[1, 1, 0])
    m.mass(30, M=120)
    m.anchor(10)
    skew = ((0.6, 0.8, 0), {"GAP": ("1mm", 0.002)})
    m.support("20M", "+Y", ("GUIDE", {"GAP": 0.003}), skew, MU=0.3, CNODE=40, NAME="PS-1")
    m.hanger(30, RATE=50e3, LOAD=6200)
    m.force(40, "F1", FY=-5e3)
    m.displacement(10, "D1", DX=0.004, RY="1deg")
    m.acceleration("U1", X=0.3)
    m.case("SUS", "W + P1 + H")
    m.case("OPE", "W + P1 + T1 + D1 + F1", FROM="SUS", STEPS=2)
    m.comb("EXP", "OPE - SUS")
    m.snubber(30, np.array([0.6, 0, 0.8]), K=5e6)
    m.snubber(40, "x", NAME="SN-2")
    m.wind("WIND1", DIR=(1, 0, 0), PRESSURE=[(0, 450), ("10m", 612.5)], SHAPE=0.9)
    m.snow(200)
    m.spectrum("SSE", Y="M/S2", TABLE=np.array([[0.5, 1], [2.5, 6], [33, 2.5]]))
    m.group("north", 10, "40")
    m.modes(12, ABOUT="OPE", ROTARY=False)
    m.case("EQN", "U1 + WIND1", ABOUT="OPE", NONLINEAR=True)
    m.case("RSX", "SPECTRUM(SSE,X)", MISSING=True, ZPA=0.2)
    m.comb("ENV", "SRSS(EQN,RSX) + MAX(SUS,EXP)")
    m.cycle("HEAT", "OPE", "SUS", TIMES=4, FROM="SUS")
    return m


def test_model_built_in_code_is_that_of_the_deck():
    model = built()
    model.check()
    assert model == read_text(DECK)
    assert read_text(model.deck()) == model


def test_a_model_can_be_copied_pickled_and_continued():
    for model in (copy.deepcopy(built()), pickle.loads(pickle.dumps(read_text(DECK)))):
        assert model == built()
        model.pipe(40, 60, DX=1.0)
        assert model.pipes[-1].section == "HDR"
        assert model.pipes[-1].operation == model.pipes[0].operation


def test_numpy_numbers_are_numbers():
    model = built()
    model.pipe(40, 60, DX=np.float64(1.5), DY=np.int32(2))
    assert model.pipes[-1].delta == (1.5, 2.0, 0.0)


CALLS = [
    (lambda m: m.pipe(10, 20, DXX=1), "PIPE 10 20: DXX is no key of PIPE; nearest: DX"),
    (lambda m: m.pipe(10, 10, DX=1), "PIPE 10 10: both ends are node 10"),
    (lambda m: m.pipe(10, 20, DX="6kN"), "PIPE 10 20: DX: unit kN does not fit"),
    (lambda m: m.pipe(10, 20, DX=float("nan")), "PIPE 10 20: DX: nan is not a finite number"),
    (lambda m: m.pipe(10, 20, DX=True), "PIPE 10 20: DX: True is not a number"),
    (lambda m: m.pipe(10, 20, DX=[1]), "PIPE 10 20: DX: (1,) is not a number"),
    (lambda m: m.pipe("a b", 20, DX=1), "PIPE A B 20: a b is no node label"),
    (lambda m: m.pipe(10, 20, DX=1, SECTION="H"), "PIPE 10 20: section H is not defined before"),
    (lambda m: m.support(10, "+W"), "SUPPORT 10: direction +W is not one of"),
    (lambda m: m.support(10), "SUPPORT 10: no direction"),
    (lambda m: m.support(10, "X", GAP=-1), "SUPPORT 10: GAP: gap -1 is negative"),
    (lambda m: m.support(10, ("X", {"MU": 3})), "SUPPORT 10: MU=3 must be 0 to 2"),
    (lambda m: m.section("B", OD=1), "SECTION B: WALL= is missing"),
    (lambda m: m.material("B", GRADE="X"), "MATERIAL B: material grade X is not known"),
    (lambda m: m.hanger(10, RATE=1), "HANGER 10: LOAD= is missing"),
    (lambda m: m.displacement(10, "D1", DX=1), "DISPLACEMENT 10 D1: DX of set D1 is given"),
    (lambda m: m.case("W", "W"), "CASE W: W is the name of a load set"),
    (lambda m: m.case("X", "W +"), "CASE X: a name is missing at the end"),
    (lambda m: m.case("X", "OPE - W"), "CASE X: OPE is a case; CASE sums load sets"),
    (lambda m: m.case("X", "W", STEPS=0), "CASE X: STEPS=0 must be 1 to"),
    (lambda m: m.comb("X", "OPE/2"), "COMB X: / where + or - should stand"),
    (lambda m: m.snubber(10, "XY"), "SNUBBER 10 XY: direction XY is not one of X Y Z or (a,b,c)"),
    (lambda m: m.snow("2bar"), "SNOW: unit bar does not fit"),
    (lambda m: m.spectrum("B", TABLE=[(1, 2)]), "SPECTRUM B: a spectrum needs two points"),
    (lambda m: m.spectrum("B", TABLE=[(1, 2, 3)]), "SPECTRUM B: TABLE: point 1 of the table has 3"),
    (lambda m: m.spectrum("B", TABLE=[1, 2]), "SPECTRUM B: TABLE: (1, 2) is no table of points"),
    (lambda m: m.wind("WIND2", DIR=(1, 0, 0)), "WIND WIND2: give one of PRESSURE="),
    (lambda m: m.modes(3), "MODES: there is one at test_deck_api.py"),
    (lambda m: m.cycle("HOT", "OPE", "SUS"), "CYCLE HOT: TIMES= is missing"),
    (lambda m: m.cycle("H", "OPE", "SUS", TIMES=2), "CYCLE H: H is the name of a load set"),
    (lambda m: m.case("X", "W", NONLINEAR=True), "CASE X: NONLINEAR goes with ABOUT="),
    (lambda m: m.comb("X", "ABS(OPE,SUS)"), "COMB X: ABS takes one expression"),
    (lambda m: m.default(MU=0.4), "DEFAULT: MU has another value"),
]


@pytest.mark.parametrize(("call", "text"), CALLS, ids=[text for _, text in CALLS])
def test_bad_call_says_what_the_deck_would_and_changes_nothing(call, text):
    model = built()
    line = call.__code__.co_firstlineno
    with pytest.raises(trunnion.DeckError) as caught:
        call(model)
    assert str(caught.value).startswith(f"test_deck_api.py:{line}: {text}")
    assert model == built()
    model.pipe(40, 70, DX=1)  # and what is current stays
    assert (model.pipes[-1].section, model.pipes[-1].material) == ("HDR", "A106B")


def test_check_finds_what_single_calls_cannot():
    model = built()
    model.support(77, "+Y")
    model.case("X", "W + T2", FROM="Y")
    with pytest.raises(trunnion.ModelError) as caught:
        model.check()
    texts = [problem.text for problem in caught.value.problems]
    assert texts[0].startswith("SUPPORT 77: node 77 is not defined")
    assert texts[1:] == [
        "CASE X: no OPERATE card before a pipe gives T2",
        "CASE X: case Y is not defined",
    ]


def test_what_no_card_can_say_is_not_written():
    from dataclasses import replace

    model = built()
    model.pipes[0] = replace(model.pipes[0], start="1 0")
    with pytest.raises(trunnion.ModelError):
        model.deck()
    model = built()
    model.title = "a ! b"
    with pytest.raises(trunnion.ModelError, match="cannot be written"):
        model.deck()
