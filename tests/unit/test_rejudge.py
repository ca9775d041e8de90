"""trunnion verify --certificate: one number of each kind, changed by 1e-6 of itself, fails.

The deck has what a state, a combination, an increment, a spectrum and a loop are judged by.
"""

import json
from pathlib import Path

import pytest
from falls import FALLS
from program import leave, stored

MODELS = Path(__file__).parents[2] / "models"
DECK = """\
TITLE    Everything that a stored result can hold
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL A106B  E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
SECTION  HDR    NPS=10 SCH=40 FLUID=850
OPERATE  T1=170 P1=12 TREF=20
ANCHOR   10
PIPE     10 20   DX=6000
SUPPORT  20      +Y GUIDE GAP=3
PIPE     20 30   DX=6000
BEND     30      R=381
PIPE     30 40   DZ=4000
SUPPORT  40      +Y
SNUBBER  40      X
PIPE     40 50   DZ=4000
SUPPORT  50      +Y LIMIT GAP=10
HANGER   20      RATE=0.1 LOAD=2
SPECTRUM SSE     TABLE=(0.5,0.1),(2.5,0.6),(9,0.6),(33,0.25)
FORCE    40 F1   FX=2 FZ=1
CASE SUS = W + P1 + H + F1
CASE OPE = W + P1 + T1 + H + F1
CASE LOCK = W + P1 + H FROM=OPE SNUBBERS=LOCKED
CASE EQX = U(0.3,2,0) ABOUT=OPE
CASE EQN = U(0.6,0.2,0) ABOUT=OPE NONLINEAR
CASE RSP = SPECTRUM(SSE,X) + SPECTRUM(SSE,Y,0.667) MISSING=ON
COMB EXP = OPE - SUS
COMB OCC = SUS + ABS(RSP)
CYCLE HEAT = OPE, SUS TIMES=3
MODES 6 ABOUT=OPE
"""


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Bytes of the JSON of DECK."""
    return stored(tmp_path_factory.mktemp("rejudge"), DECK)


@pytest.fixture
def home(tmp_path, written, monkeypatch):
    (tmp_path / "a.inp").write_text(DECK)
    (tmp_path / "a.json").write_bytes(written)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_everything_is_judged_and_holds(home, capsys):
    assert leave("verify", "--certificate", "a.json") == 0
    found = [line.split(":")[:2] for line in capsys.readouterr().out.splitlines()]
    names = ("SUS", "OPE", "LOCK", "EQX", "EQN", "RSP", "EXP", "OCC", "CYCLE HEAT", "modes",
             "envelope")  # fmt: skip
    assert found == [[name, " holds"] for name in names]


def table(*path):
    """Largest number of a table: path to the table, then the key of its entries, if any."""

    def of(report):
        place = report
        for key in path:
            if isinstance(place, list) and isinstance(key, str):
                places = [entry[key] for entry in place]
                break
            place = place[key]
        else:
            places = list(place.values()) if isinstance(place, dict) else [place]
        rows = [(r, i) for r in _rows(places) for i, x in enumerate(r) if isinstance(x, float)]
        return max(rows, key=lambda pair: abs(pair[0][pair[1]]))

    return of


def _rows(value):
    """Lists of numbers inside lists."""
    if isinstance(value, list) and any(isinstance(x, list | dict) for x in value):
        return [row for x in value for row in _rows(x)]
    if isinstance(value, dict):
        return [row for x in value.values() for row in _rows(x)]
    return [value] if isinstance(value, list) else []


def contact(*path, key):
    """A vector of the contacts or sliders of a table of supports."""

    def of(report):
        place = report
        for step in path:
            place = place[step]
        what, name = key
        rows = [entry[name] for support in place for entry in support[what]]
        rows = [(row, i) for row in rows for i in range(len(row))]
        return max(rows, key=lambda pair: abs(pair[0][pair[1]]))

    return of


def scalar(*path, key):
    """A number of an entry of contacts or supports."""

    def of(report):
        place = report
        for step in path:
            place = place[step]
        entries = place if key[0] is None else [e for s in place for e in s[key[0]]]
        return max(entries, key=lambda entry: abs(entry[key[1]])), key[1]

    return of


STATES = {
    "SUS": ("cases", "SUS"),
    "OPE": ("cases", "OPE"),
    "LOCK": ("cases", "LOCK"),
    "EQX": ("cases", "EQX"),
    "EQN": ("cases", "EQN", "total"),
    "CYCLE HEAT": ("cycles", "HEAT", "states", 3),
}
KINDS = {}
for name, path in STATES.items():
    KINDS |= {
        f"{name} displacement": (name, table(*path, "nodes")),
        f"{name} end force": (name, table(*path, "elements", "force_to")),
        f"{name} local force": (name, table(*path, "elements", "local_from")),
        f"{name} support load": (name, table(*path, "supports", "force")),
        f"{name} contact": (name, contact(*path, "supports", key=("contacts", "vector"))),
        f"{name} reaction": (name, scalar(*path, "supports", key=("contacts", "reaction"))),
        f"{name} normal": (name, scalar(*path, "supports", key=("contacts", "normal"))),
        f"{name} normal of card": (name, scalar(*path, "supports", key=(None, "normal"))),
    }
    if name != "EQX":
        KINDS |= {
            f"{name} friction": (name, contact(*path, "supports", key=("contacts", "friction"))),
            f"{name} friction of card": (name, table(*path, "supports", "friction")),
            f"{name} slide": (name, contact(*path, "supports", key=("contacts", "slide"))),
            f"{name} datum": (name, contact(*path, "supports", key=("sliders", "datum_end"))),
        }
for name in ("EQN", "RSP", "EXP", "OCC"):
    KINDS |= {
        f"{name} displacement of result": (name, table("cases", name, "nodes")),
        f"{name} end force of result": (name, table("cases", name, "elements", "force_from")),
        f"{name} local force of result": (name, table("cases", name, "elements", "local_to")),
        f"{name} support load of result": (name, table("cases", name, "supports", "force")),
        f"{name} moment of result": (name, table("cases", name, "supports", "moment")),
        f"{name} normal of result": (name, scalar("cases", name, "supports", key=(None, "normal"))),
        f"{name} stress of result": (name, table("cases", name, "stresses", "von_mises")),
    }
KINDS |= {
    "balance": ("SUS", table("cases", "SUS", "reactions", "force")),
    "frozen check": ("EQX", scalar("cases", "EQX", "frozen_check", key=(None, "amount"))),
    "cycle range": ("CYCLE HEAT", table("cycles", "HEAT", "supports", "range")),
    "cycle one shot": ("CYCLE HEAT", table("cycles", "HEAT", "supports", "one_shot")),
    "cycle path": ("CYCLE HEAT", table("cycles", "HEAT", "supports", "path")),
    "cycle end force": ("CYCLE HEAT", table("cycles", "HEAT", "elements", "range_to")),
    "frequency": ("modes", table("modes", "frequency_hz")),
    "shape": ("modes", table("modes", "shapes")),
    "added shape": ("modes", table("modes", "shapes_added")),
    "participation": ("modes", table("modes", "participation")),
    "mass": ("modes", table("modes", "effective_mass")),
    "envelope": ("envelope", table("envelope", "max")),
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_changed_by_1e_6_fails(home, written, kind, capsys):
    report = json.loads(written)
    where, find = KINDS[kind]
    row, at = find(report)
    assert row[at] != 0.0, "a zero cannot be changed by a part of itself"
    row[at] *= 1.0 + 1e-6
    (home / "b.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "b.json") == 1
    assert f"{where}: FAILS" in capsys.readouterr().out


def test_a_state_that_begins_elsewhere_fails(home, written, capsys):
    """Datum and travel moved together satisfy every law, but not the history of the case."""
    report = json.loads(written)
    for support in report["cases"]["OPE"]["supports"]:
        for slider in support["sliders"]:
            first = support["contacts"][slider["contacts"][0]]
            if slider["state"] == "slip":
                slider["datum"][2] += 1e-9
                first["slide"][2] -= 1e-9
    (home / "b.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "b.json") == 1
    assert "OPE: FAILS" in capsys.readouterr().out


def test_what_the_file_does_not_have_is_not_judged(home, written, capsys):
    report = json.loads(written)
    del report["modes"]["mesh_hz"], report["cycles"]["HEAT"]["states"]
    del report["cases"]["EQN"]["total"]
    (home / "b.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "b.json") == 0
    said = capsys.readouterr().out.splitlines()
    silent = [line.split(":")[0] for line in said if ": not judged: " in line]
    assert silent == ["EQN", "RSP", "OCC", "CYCLE HEAT", "modes", "envelope"]


MORE = """\
FORCE 10 F2 FY=-100
CASE REST = F2
CASE MORE = F2 FROM=PUSH
CASE ABOVE = F2 ABOUT=PUSH
COMB BOTH = REST + PUSH
MODES 2 ABOUT=PUSH
"""


def test_what_stands_on_a_case_without_numbers_is_not_judged(home, capsys):
    (home / "falls.inp").write_text(FALLS + MORE)
    assert leave("run", "falls.inp") == 1
    capsys.readouterr()
    assert leave("verify", "--certificate", "falls.json") == 0
    said = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0] for line in said if ": holds: " in line] == ["REST", "envelope"]
    # even where the file claims that it has numbers
    report = json.loads((home / "falls.json").read_text())
    for name in ("MORE", "ABOVE", "BOTH"):
        report["cases"][name] = report["cases"]["REST"]
    (home / "falls.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "falls.json") in (0, 1)
    said = capsys.readouterr()
    for name in ("MORE", "ABOVE", "BOTH"):
        assert f"{name}: not judged: it stands on PUSH, not judged" in said.out
    assert said.err == ""


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("modes",), 5),
        (("modes", "mesh_hz"), -1.0),
        (("modes", "shapes"), []),
        (("modes", "shapes_low"), "none"),
        (("modes", "participation"), [[1.0]]),
        (("cycles",), []),
        (("cycles", "HEAT", "states"), [1, 2]),
        (("cases", "EQN", "total"), {}),
        (("envelope",), {}),
    ],
)
def test_tables_of_another_shape_fail_by_name(home, written, place, value, capsys):
    report = json.loads(written)
    inside = report
    for key in place[:-1]:
        inside = inside[key]
    inside[place[-1]] = value
    (home / "b.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "b.json") == 1
    said = capsys.readouterr()
    assert ": FAILS: " in said.out
    assert said.err == ""


@pytest.mark.parametrize(
    ("name", "place", "value"),
    [
        *((c, ("cases", c, "certificate", "passed"), False) for c in ("OPE", "EQN", "EXP", "RSP")),
        *((c, ("cases", c, "certificate", "worst"), 1e-3) for c in ("OPE", "EQN", "EXP", "RSP")),
        ("OPE", ("cases", "OPE", "certificate", "equilibrium"), 1e-3),
        ("OPE", ("cases", "OPE", "certificate", "items", 1, "value"), 1e-3),
        ("EXP", ("cases", "EXP", "certificate", "items", 1, "value"), 1e-11),
        ("CYCLE HEAT", ("cycles", "HEAT", "states", 1, "certificate", "worst"), 1e-3),
        *((c, ("cases", c, "text"), "W") for c in ("OPE", "EQX", "EQN", "EXP", "RSP")),
        ("OPE", ("cases", "OPE", "converged"), False),
        ("title", ("title",), "another"),
        ("manifest", ("manifest", "settings", "iteration"), "PICARD"),
        ("winds", ("winds",), [1]),
        ("hangers", ("hangers",), [1]),
    ],
)
def test_a_file_that_contradicts_itself_or_its_deck_fails(
    home, written, name, place, value, capsys
):
    report = json.loads(written)
    inside = report
    for key in place[:-1]:
        inside = inside[key]
    assert inside.get(place[-1]) != value if isinstance(inside, dict) else True
    inside[place[-1]] = value
    (home / "b.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "b.json") == 1
    assert f"{name}: FAILS: " in capsys.readouterr().out


SUMS = """\
UNITS    mm kN bar C
MATERIAL S  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P  OD=273.1 WALL=9.27
OPERATE  T1=170 P1=12 TREF=20
ANCHOR   0
PIPE     0 10  DX=6000
PIPE     10 20 DZ=6000
SUPPORT  20    Y
"""


def test_certificates_of_sums_are_upper_bounds_and_no_more(home, capsys):
    """Eight cases of two loads: sums, whose first item is `sum`."""
    cases = [f"CASE C{i} = W + {i}*T1" for i in range(2, 10)]
    (home / "s.inp").write_text(SUMS + "\n".join([*cases, "COMB D = C4 - C3"]) + "\n")
    assert leave("run", "s.inp") == 0
    report = json.loads((home / "s.json").read_text())
    items = report["cases"]["C4"]["certificate"]["items"]
    assert items[0]["name"] == "sum"
    capsys.readouterr()
    assert leave("verify", "--certificate", "s.json") == 0
    report["cases"]["C4"]["certificate"]["passed"] = False
    (home / "s.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "s.json") == 1
    assert "C4: FAILS: certificate: passed" in capsys.readouterr().out


def test_another_version_is_said(home, written, capsys):
    report = json.loads(written)
    report["manifest"]["version"] = "9.9"
    (home / "b.json").write_text(json.dumps(report))
    assert leave("verify", "--certificate", "b.json") == 0
    assert capsys.readouterr().out.startswith("made by version 9.9, judged by ")


def test_modes_that_the_deck_does_not_ask_for_fail(home, capsys):
    without = [x for x in DECK.splitlines() if "SPECTRUM" not in x and "RSP" not in x]
    (home / "c.inp").write_text("\n".join(x for x in without if x[:5] != "MODES") + "\n")
    assert leave("run", "c.inp") == 0
    assert leave("verify", "--certificate", "c.json") == 0
    report = json.loads((home / "c.json").read_text())
    report["modes"]["frequency_hz"].append(3.0)
    (home / "c.json").write_text(json.dumps(report))
    capsys.readouterr()
    assert leave("verify", "--certificate", "c.json") == 1
    assert "modes: FAILS: the deck asks for none" in capsys.readouterr().out


def test_other_answers_are_not_judged(home, capsys):
    assert leave("run", MODELS / "strut_three.inp", "-o", home, "--spread", 3) == 0
    capsys.readouterr()
    stored = home / "strut_three.json"
    assert leave("verify", "--certificate", "--deck", MODELS / "strut_three.inp", stored) == 0
    said = capsys.readouterr().out
    assert "PUSH: holds: " in said
    assert "spread: not judged: " in said


@pytest.mark.parametrize("deck", sorted(path.stem for path in MODELS.glob("*.inp")))
def test_every_model_is_judged_and_holds(tmp_path, deck, capsys):
    source = MODELS / f"{deck}.inp"
    leave("run", source, "-o", tmp_path)
    capsys.readouterr()
    code = leave("verify", "--certificate", "--deck", source, tmp_path / f"{deck}.json")
    out = capsys.readouterr().out
    assert code == 0, out
    loose = [x for x in out.splitlines() if ": not judged: " in x and ": no numbers: " not in x]
    assert not loose
