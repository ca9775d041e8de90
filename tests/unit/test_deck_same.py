"""Changes that keep the meaning of a deck give equal models; written decks read back equal."""

import random
import re
from pathlib import Path

import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.model import Units

ROOT = Path(__file__).parents[2]
MODELS = sorted((ROOT / "models").glob("*.inp"))
SEED = 20

EXAMPLE = """\
TITLE    Hot oil header, one expansion loop
UNITS    mm kN bar C
DEFAULT  MU=0.3 STIFFEN=P1 SHEAR=OFF
MATERIAL A106B  E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
MATERIAL TAB    E=203000 TREF=21.1
PROPERTY TAB    T=200 E=191000 ALPHA=12.2e-6
PROPERTY TAB    T=100 ALPHA=11.9e-6
MATERIAL LIB    GRADE=A106-B DENSITY=7833
SECTION  SMALL  OD=114.3 WALL=6.02 WEIGHT=0.1
SECTION  HDR    NPS=10 SCH=40 FLUID=850 INSULATION=75mm INSULATION_DENSITY=140
OPERATE  T1=170 P1=12 TREF=20
NODE     10     X=100 Y=-2500
ANCHOR   10     KR=2e6
PIPE     10 20  DX=6000
SUPPORT  20     MU=0.2 +Y GUIDE GAP=3 K=2kN/mm RX GAP=0.01 NAME=PS-1
PIPE     20 30  DX=6000 MATERIAL=TAB T2=-29
BEND     30     R=381 K=4.5 FLANGES=1
PIPE     30 40  LENGTH=4000 DIR=(0,0.3,1)
PIPE     40 45  DX=1000
BEND     40     SHORT
SUPPORT  40     +Y LIMIT GAP=1,25 ALONG=40-30 KF=5 FRICTION=RESULTANT
SUPPORT  30M    (0.6,0.8,0) -(0,0,1) GAP=7 CNODE=20
RIGID    45 50  DX=450 WEIGHT=2.1 MATERIAL=LIB SECTION=SMALL
SPRING   50 60  KX=1 KRZ=300 AXIS=(1,1,0)
SPRING   60     KY=0.25
MASS     50     W=1.5
HANGER   50     RATE=50N/mm LOAD=6.2
DISPLACEMENT 10 D1 DX=4 RZ=0.5deg
DISPLACEMENT 10 D1 DY=-2
FORCE    50 F1  FY=-5 MX=1.25
FORCE    50 F1  FY=-1
ACCELERATION U1 X=0.3
ACCELERATION U9 Z=-0.2
SNUBBER  20     X K=5 CNODE=30N NAME=SN-1
SNUBBER  45     (0.6,0,0.8)
WIND     WIND1 DIR=(1,0,0) PRESSURE=(0,450),(10000,612.5) SHAPE=0.9 GROUND=-500
WIND     WIND2 DIR=(0,0,-2) VELOCITY=(0,20), (7500,25.5)
WIND     WIND9 DIR=(1,0,1) ASCE7=45 EXPOSURE=B KZT=1.2 KD=0.95 GUST=0.9
SNOW     0.2
SNOW     0.1
SPECTRUM SSE TABLE=(0.5,0.1),(2.5,0.6),(9,0.6),(33,0.25)
SPECTRUM OBE X=PERIOD Y=IN/S2 INTERP=LINEAR TABLE=(0.03,96.6),(0.11,231.84),(0.7,110)
GROUP    NORTH = 10, 20
GROUP    SOUTH = 40
MODES    12 ABOUT=OPE FMAX=33.5 MASS=CONSISTENT MESH=NONE ROTARY=OFF FRICTION=50
CASE SUS = W + P1 + H
CASE OPE = 1.1*W + P1 - 0.5*T1 + T2 FROM=SUS STEPS=4 MUX=0.5 E=HOT EVENTS=ON ITERATION=STATUS
CASE EQ = W + U1 + U(0,-0.3,0.1) + D1 + F1 SNUBBERS=FREE
COMB EXP = OPE - SUS
CASE DIF = EQ - SUS
CASE HSUS = W + P1 ON=OPE
CASE EQX = U(0.3,0,0) - 0.4*U9 ABOUT=OPE
CASE EQN = U(0.3,0,0) NONLINEAR ABOUT=OPE STEPS=3 SNUBBERS=LOCKED
CASE WIN = WIND1 + 0.5*WIND9 - WIND2 + S ABOUT=OPE
CASE RSX = SPECTRUM(SSE,X) + 0.5*SPECTRUM(OBE,Y,0.67) MODAL=CQC DAMPING=0.05 ZPA=0.213 MISSING=ON
CASE RSG = SPECTRUM(SSE,X,1.5,NORTH) + SPECTRUM(OBE,X,1,SOUTH) GROUPS=SRSS SPATIAL=ABS &
  MODAL=DSUM DURATION=12 FIRST=DIRECTIONS
COMB ENV = SRSS(EQX, WIN, 2*RSX) + MAX(ABS(SUS),MIN(OPE,SUS)) - SIGNMAX(EXP, -HSUS) + SCALAR(SUS)
CYCLE HEAT = OPE, SUS TIMES=4 FROM=SUS
CYCLE COLD = SUS, OPE, SUS TIMES=9
COMB OCC = -(SUS - 2*EXP) + ABS(EQ) - (OPE - (SUS + EQ))
"""


def cards(text):
    return [line.split("!")[0].rstrip() for line in text.splitlines() if line.split("!")[0].strip()]


def decks():
    return [EXAMPLE, *(path.read_text() for path in MODELS)]


def names():
    return ["example", *(path.stem for path in MODELS)]


@pytest.fixture(params=decks(), ids=names())
def deck(request):
    return request.param


def test_written_deck_reads_back_equal(deck):
    model = read_text(deck)
    text = model.deck()
    again = read_text(text)
    assert again == model
    assert again.deck() == text


@pytest.mark.parametrize(
    "names", ["m N Pa C", "in lbf psi F", "ft lbf psi K", "cm kgf kPa C", "mm N MPa F"]
)
def test_any_units_write_an_equal_model(deck, names):
    model = read_text(deck)
    model.units = Units(*names.split())
    assert read_text(model.deck()) == model


def test_places_alone_do_not_make_models_differ(deck):
    assert read_text("\n\n! shifted\n" + deck) == read_text(deck)


def change_case(line, rng):
    keyword = line.split()[0].upper()
    if keyword == "TITLE":
        return "title" + line[5:]
    keep = re.search(r"NAME=\S+", line)
    line = "".join(rng.choice((c.lower(), c.upper())) for c in line)
    return re.sub(r"NAME=\S+", lambda _: keep[0], line, flags=re.I) if keep else line


def change_spacing(line, rng):
    if line.upper().startswith("TITLE"):
        return "  " + line
    line = re.sub(r" +", lambda _: rng.choice((" ", "   ", "\t", " \t ")), line)
    line = re.sub(r"=", lambda _: rng.choice(("=", " = ", "= ", " =")), line)
    return re.sub(r",", lambda _: rng.choice((",", ", ", " ,")), line) + rng.choice(("", "  "))


def change_comments(line, rng):
    return rng.choice(("", "! PIPE 1 2 DX=\n", "\n   \n")) + line + rng.choice(("", " ! & = x"))


def change_continuation(line, rng):
    if line.upper().startswith("TITLE"):
        return line
    words = line.split(" ")
    for i in range(1, len(words)):
        if rng.random() < 0.4:
            words[i] = rng.choice(("&\n", "& ! next\n  ", "&\n! between\n\n")) + words[i]
    return " ".join(words)


@pytest.mark.parametrize(
    "change", [change_case, change_spacing, change_comments, change_continuation]
)
def test_form_does_not_change_the_model(deck, change):
    rng = random.Random(SEED)
    model = read_text(deck)
    for _ in range(5):
        changed = "\n".join(change(line, rng) for line in cards(deck))
        assert read_text(changed) == model, f"seed {SEED}:\n{changed}"


def test_line_ends_and_byte_order_mark_do_not_change_the_model(tmp_path):
    path = tmp_path / "a.inp"
    for data in (
        EXAMPLE.replace("\n", "\r\n").encode(),
        EXAMPLE.replace("\n", "\r").encode(),
        b"\xef\xbb\xbf" + EXAMPLE.rstrip().encode(),
    ):
        path.write_bytes(data)
        assert trunnion.read(path) == read_text(EXAMPLE)


def test_included_cards_stand_in_the_place_of_the_card(tmp_path):
    lines = EXAMPLE.splitlines(keepends=True)
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "b c.inp").write_text("".join(lines[5:14]))
    (tmp_path / "parts" / "a.inp").write_text("".join(lines[3:5]) + 'INCLUDE "b c.inp"\n')
    main = tmp_path / "main.inp"
    main.write_text("".join(lines[:3]) + "include parts/a.inp ! all of it\n" + "".join(lines[14:]))
    assert trunnion.read(main) == read_text(EXAMPLE)


SUFFIXES = {
    "mm": ("DX=6000", ("DX=6000mm", "DX=600cm", "DX=6m", "DX=6000MM", "DX=0.6e1m")),
    "stiffness": ("K=2kN/mm", ("K=2", "K=2000N/mm", "K=2e6N/m", "K=2MN/m", "K=0.002MN/mm")),
    "modulus": ("E=203GPa", ("E=203000", "E=203000MPa", "E=2.03e11Pa", "E=203e9N/m2")),
    "temperature": ("T1=170", ("T1=170C", "T1=338F", "T1=170degC", "T1=443.15K")),
    "pressure": ("P1=12", ("P1=12bar", "P1=1.2MPa", "P1=1200kPa", "P1=1.2e6N/m^2")),
    "force": ("WEIGHT=2.1", ("WEIGHT=2.1kN", "WEIGHT=2100N", "WEIGHT=0.0021MN")),
    "density": ("DENSITY=7850", ("DENSITY=7850kg/m3", "DENSITY=7.85tonne/m3")),
    "expansion": ("ALPHA=11.7e-6", ("ALPHA=11.7e-6/K", "ALPHA=11.7e-6/C", "ALPHA=6.5e-6/F")),
}


@pytest.mark.parametrize("kind", SUFFIXES)
def test_unit_suffixes_do_not_change_the_model(kind):
    plain, others = SUFFIXES[kind]
    assert plain in EXAMPLE
    for other in others:
        assert read_text(EXAMPLE.replace(plain, other)) == read_text(EXAMPLE), other


def test_order_of_cards_that_carry_nothing_does_not_change_what_they_say():
    lines = cards(EXAMPLE)
    restraints = (
        "ANCHOR",
        "SUPPORT",
        "HANGER",
        "SPRING",
        "SNUBBER",
    )  # their order is that of the report
    late = [line for line in lines if line.split()[0] in (*restraints, "BEND", "DEFAULT", "MASS")]
    rest = [line for line in lines if line not in late]
    assert read_text("\n".join([*rest, *late])) == read_text(EXAMPLE)


def test_any_numbers_are_written_back_to_the_last_bit():
    rng = random.Random(SEED)
    keys = r"\b(D[XYZ]|[XY]|GAP|KF?|KR|T[12]|P1|ALPHA|DENSITY|WEIGHT|LOAD|K[XYZ]|KRZ|F[XY]|MX)="

    def other(match):
        value = rng.random() * 10.0 ** rng.randint(-9, 9)
        return f"{match[1]}={value!r}" if match[1][0] != "T" else f"{match[1]}={value % 500!r}"

    for length, force, pressure, temperature in (
        *(("mm", "kN", "bar", "C"), ("in", "lbf", "psi", "F"), ("ft", "kgf", "MPa", "K")),
        *(("m", "N", "Pa", "F"), ("cm", "lbf", "kPa", "K")),
    ):
        for _ in range(10):
            lines = cards(EXAMPLE.replace("GAP=1,25", "GAP=1").replace("R=381 K=4.5", "R=900mm"))
            lines[1] = f"UNITS {length} {force} {pressure} {temperature}"
            lines = [re.sub(keys + r"[-0-9.e]+(?=\s|$)", other, line) for line in lines]
            text = "\n".join(lines).replace("LINING", "! ")
            model = read_text(text.replace("T2=-29", "T2=29"))
            assert read_text(model.deck()) == model, f"seed {SEED}:\n{text}"
