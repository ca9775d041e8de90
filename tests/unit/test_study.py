"""trunnion study: every variant is what its own deck gives, and only what varies is made anew."""

import csv
import io
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.many.axes import read_axes
from trunnion.many.quantities import QUANTITIES
from trunnion.report.study import study_report
from trunnion.report.study_data import envelope_csv, study_json, variants_csv
from trunnion.results.supports import STATES, card_forces, card_states

DECK = """\
TITLE    A line with everything that a study may vary
UNITS    mm kN bar C
DEFAULT  MU=0.3 K=1e5 KR=1e6 KF=100 G=9.81 BOURDON=ELONGATION
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
SECTION  HDR    OD=273.1 WALL=9.27 FLUID=850 LINING=5 LINING_DENSITY=2000 &
                INSULATION=75 INSULATION_DENSITY=140 WEIGHT=0.02
OPERATE  T1=170 P1=12 TREF=20
ANCHOR   10
PIPE     10 20   DX=6000
SUPPORT  20      +Y GUIDE GAP=3
PIPE     20 30   DX=6000
BEND     30      R=381
SUPPORT  25      +Y K=50kN/mm KF=5kN/mm NAME=SOFT
PIPE     30 40   DZ=4000
HANGER   40      RATE=50N/mm LOAD=6.2
PIPE     40 25   DZ=2000
PIPE     25 50   DZ=3000
ANCHOR   50
DISPLACEMENT 50 D1 DX=4 RY=0.001
FORCE    40 F1   FX=2 MY=1
ACCELERATION U1  X=0.1 Y=0.0
CASE SUS = W + P1 + H + F1
CASE OPE = W + P1 + T1 + H + D1 + F1
COMB EXP = OPE - SUS
CASE EQ  = U1 ABOUT=OPE
"""

# quantity, a value, and how the deck says the same
SAID = {
    "MU": ("0.2", "MU=0.3", "MU=0.2"),
    "MU@20,+Y": ("0.1", "20      +Y GUIDE", "20      +Y MU=0.1 GUIDE"),
    "GAP@20": ("7", "GAP=3", "GAP=7"),
    "GAP@20,GUIDE": ("0.2in", "GAP=3", "GAP=5.08"),
    "GAP": ("0", "GAP=3", "GAP=0"),
    "K": ("100", " K=1e5", " K=100"),
    "K@SOFT": ("20kN/mm", "K=50kN/mm", "K=20kN/mm"),
    "K@10": ("1e3kN/mm", "ANCHOR   10", "ANCHOR   10 K=1e3kN/mm"),
    "KR": ("1e4", "KR=1e6", "KR=1e4"),
    "KF": ("0.01", "KF=100", "KF=0.01"),
    "KF@25": ("20", "KF=5kN/mm", "KF=20kN/mm"),
    "RATE": ("80N/mm", "RATE=50N/mm", "RATE=80N/mm"),
    "LOAD@40": ("7", "LOAD=6.2", "LOAD=7"),
    "G": ("9", "G=9.81", "G=9"),
    "T1": ("300", "T1=170", "T1=300"),
    "T1@20-30": ("300F", "30   DX=6000\nBEND", "30 DX=6000 T1=300F\nOPERATE T1=170\nBEND"),
    "P1": ("20", "P1=12", "P1=20"),
    "E": ("180GPa", "E=203GPa", "E=180GPa"),
    "NU@STEEL": ("0.25", "NU=0.3", "NU=0.25"),
    "ALPHA": ("10e-6", "ALPHA=11.7e-6", "ALPHA=10e-6"),
    "DENSITY": ("8000", "DENSITY=7850", "DENSITY=8000"),
    "OD": ("300", "OD=273.1", "OD=300"),
    "WALL@HDR": ("12", "WALL=9.27", "WALL=12"),
    "FLUID": ("0", "FLUID=850", "FLUID=0"),
    "LINING": ("3", "LINING=5", "LINING=3"),
    "LINING_DENSITY": ("1", "LINING_DENSITY=2000", "LINING_DENSITY=1"),
    "INSULATION": ("50", "INSULATION=75", "INSULATION=50"),
    "INSULATION_DENSITY": ("90", "INSULATION_DENSITY=140", "INSULATION_DENSITY=90"),
    "WEIGHT": ("0.5", "WEIGHT=0.02", "WEIGHT=0.5"),
    "DX@20-30": ("7000", "20 30   DX=6000", "20 30   DX=7000"),
    "DZ@40-25": ("2500", "DZ=2000", "DZ=2500"),
    "DY@40-25": ("200", "DZ=2000", "DZ=2000 DY=200"),
    "R@30": ("600", "R=381", "R=600"),
    "D1@50,DX": ("9", "DX=4", "DX=9"),
    "D1@50,RY": ("0.002", "RY=0.001", "RY=0.002"),
    "F1@40,FX": ("5", "FX=2", "FX=5"),
    "F1@40,MY": ("-3", "MY=1", "MY=-3"),
    "U1@X": ("0.4", "X=0.1", "X=0.4"),
    "FACTOR@T1": ("-0.5", "P1 + T1", "P1 - 0.5*T1"),
    "MUX@OPE": ("0.5", "D1 + F1", "D1 + F1 MUX=0.5"),
    "STEPS@OPE": ("3", "D1 + F1", "D1 + F1 STEPS=3"),
}


@pytest.fixture(scope="module")
def model():
    return read_text(DECK, "line.inp")


def test_every_quantity_is_tried_here():
    tried = {name.split("@")[0] for name in SAID}
    families = {"T1": "T", "P1": "P", "D1": "D", "F1": "F", "U1": "U"}
    tried |= {f + n for key, f in families.items() if key in tried for n in "23456789"}
    assert tried == set(QUANTITIES)


def test_the_page_of_the_docs_has_every_quantity():
    page = (Path(__file__).parents[2] / "docs/many.md").read_text()
    listed = {key for key in QUANTITIES if f"`{key}`" in page or f"`{key}@" in page}
    families = {key for key in QUANTITIES if key[0] in "TPDFU" and key[1:].isdigit()}
    assert listed | families == set(QUANTITIES)
    assert {"T1", "P1", "D1", "F1", "U1"} <= listed


@pytest.mark.parametrize("name", SAID)
def test_a_variant_is_what_its_own_deck_gives(model, name):
    value, before, after = SAID[name]
    assert before in DECK
    done = trunnion.study(model, [f"{name}={value}"], jobs=1)
    assert not done.failures
    own = trunnion.solve(read_text(DECK.replace(before, after), "own.inp"))
    plain = trunnion.solve(model)
    for case in done.cases:
        want = card_forces(own[case])
        scale = np.abs(want).max()
        assert np.abs(done.forces(case)[0] - want).max() < 1e-9 * scale
    moved = [np.abs(card_forces(own[c]) - card_forces(plain[c])).max() for c in done.cases]
    assert max(moved) > 1e-3  # the quantity matters, or nothing was tested


@pytest.mark.parametrize("name", ["MU", "GAP", "K", "KF", "T1", "F1@40,FX", "D1@50,DX"])
def test_supports_and_loads_vary_on_one_analysis_and_one_assembly(model, name):
    low = SAID[name][0]
    done = trunnion.study(model, [f"{name}={low},{float(low) * 1.5 + 0.1}"], cases=["OPE"], jobs=1)
    assert done.work["analyse"] == 1
    assert done.work["assemble"] == 1


@pytest.mark.parametrize("name", ["E=190GPa:210GPa:4", "WALL=8:11:4", "DX@20-30=5:7m:4"])
def test_elements_vary_on_one_analysis(model, name):
    vary = [name, "MU=0.1,0.2,0.3"] if "m:" not in name else ["DX@20-30=5m:7m:4", "MU=0.1,0.2,0.3"]
    done = trunnion.study(model, vary, cases=["OPE"], jobs=1)
    assert done.work["analyse"] == 1
    assert done.work["assemble"] == 1 + 4  # the deck's own, and once a value, not once a variant


def test_a_variant_may_end_chains_at_other_nodes():
    """A stub of 50 mm between long pipes ends chains (`solver.chains.APART`), one of 5 m none."""
    deck = """\
MATERIAL A E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION P OD=0.2191 WALL=0.00818
OPERATE T1=120 TREF=20
ANCHOR 10
PIPE 10 20 DX=5
PIPE 20 30 DX=5
PIPE 30 40 DX=5
SUPPORT 40 +Y MU=0.3
CASE A = W + T1
"""
    done = trunnion.study(read_text(deck, "deck.inp"), ["DX@20-30=5,0.05"], jobs=1)
    alone = trunnion.solve(read_text(deck.replace("20 30 DX=5", "20 30 DX=0.05"), "deck.inp"))
    assert done.answers.force[1, 0] == pytest.approx(card_forces(alone["A"]), rel=1e-9)


def test_only_what_changes_is_made_anew(model, monkeypatch):
    from trunnion.cases import analysis
    from trunnion.many import variants

    calls = []
    for home, name in (
        (analysis, "build_system"),
        (analysis, "load_sets"),
        (variants, "load_sets"),
        (variants, "with_supports"),
    ):
        original = getattr(home, name)

        def counted(*arguments, name=name, original=original):
            calls.append(name)
            return original(*arguments)

        monkeypatch.setattr(home, name, counted)
    once = {"build_system": 1, "load_sets": 1}  # the deck as it is
    for vary, more in (
        (["MU=0.1,0.2,0.4"], {"with_supports": 3}),
        (["T1=100,200"], {"load_sets": 2}),
        (["MUX@OPE=0.5,1"], {}),
        (
            ["E=200GPa,210GPa", "T1=100,200", "MU=0.1,0.2"],
            {"build_system": 2, "with_supports": 4, "load_sets": 2 + 4},
        ),
    ):
        calls.clear()
        trunnion.study(model, vary, jobs=1)
        want = {name: once.get(name, 0) + more.get(name, 0) for name in (*once, *more)}
        assert {name: calls.count(name) for name in set(calls)} == want


def test_processes_and_neighbours_do_not_change_a_byte(model):
    vary = ["MU=0.05:0.5:8", "GAP@20=0,3,10", "T1=100,200"]
    for warm in (False, True):
        one, two = (trunnion.study(model, vary, jobs=j, warm=warm) for j in (1, 2))
        assert study_json(one) == study_json(two)
        assert study_report(one, model) == study_report(two, model)
        few = trunnion.study(model, ["T1=200", "GAP@20=10,0", "MU=0.5,0.05"], jobs=1, warm=warm)
        names = [set(name.split()) for name in one.names]
        for i, name in enumerate(few.names):
            same = names.index(set(name.split()))
            assert np.array_equal(few.answers.force[i], one.answers.force[same])


def test_a_warm_start_finds_the_same_answers_in_fewer_passes(model):
    vary = ["MU=0.05:0.5:8", "GAP@20=0,3,10"]
    cold, warm = (trunnion.study(model, vary, cases=["OPE"], jobs=1, warm=w) for w in (False, True))
    assert (
        np.abs(cold.answers.force - warm.answers.force).max()
        < 1e-9 * np.abs(cold.answers.force).max()
    )
    assert warm.work["iterations"] < cold.work["iterations"]


def test_only_some_cases_of_a_deck_are_solved(model):
    part = trunnion.study(model, ["MUX@OPE=0.5,1", "FACTOR@T1=1,2"], cases=["EXP"], jobs=1)
    whole = trunnion.study(model, ["MUX@OPE=0.5,1", "FACTOR@T1=1,2"], jobs=1)
    assert part.cases == ("EXP",)
    assert np.array_equal(part.forces("EXP"), whole.forces("EXP"))
    alone = trunnion.study(model, ["MUX@OPE=0.5,1"], cases=["OPE"], jobs=1)  # without SUS before it
    assert np.array_equal(alone.forces("OPE"), whole.forces("OPE")[::2])
    assert alone.work["solve"] < whole.work["solve"]


def test_a_deck_without_cases_has_its_default_ones():
    model = read_text(DECK[: DECK.index("CASE")], "none.inp")
    done = trunnion.study(model, ["MUX@OPE=0.5,1", "T1=100,200"], jobs=1)
    assert not done.failures
    assert {"SUS", "OPE", "EXP"} <= set(done.cases)


def test_friction_of_nothing_is_a_variant_like_others(model):
    done = trunnion.study(model, ["MU=0,0.3"], jobs=1)
    assert not done.failures
    bare = trunnion.solve(read_text(DECK.replace("MU=0.3", "MU=0"), "bare.inp"))
    assert done.forces("OPE")[0] == pytest.approx(card_forces(bare["OPE"]), rel=1e-9, abs=1e-6)
    assert done.work["analyse"] == 1


def test_the_envelope_names_the_variants_that_govern(model):
    done = trunnion.study(model, ["MU=0.1,0.3,0.5", "T1=100,200"], jobs=1)
    for case in ("OPE", "EXP", "EQ"):
        found, good = done.envelope(case)
        force = done.forces(case)
        assert good.tolist() == list(range(6))
        assert np.array_equal(found.highest[found.highest_case >= 0],
                              force.max(axis=0)[found.highest_case >= 0]) or np.allclose(
            found.highest, force.max(axis=0), rtol=1e-9, atol=1e-6)  # fmt: skip
        for which, extreme in (
            (found.highest_case, force.max(0)),
            (found.lowest_case, force.min(0)),
        ):
            for card, component in np.argwhere(which >= 0):
                own = force[which[card, component], card, component]
                assert own == pytest.approx(extreme[card, component], rel=1e-8, abs=1e-6)


def test_states_of_a_support_are_counted_over_the_variants(model):
    done = trunnion.study(model, ["T1=20,300", "GAP@20=0,30"], jobs=1)
    counts = done.states("OPE")
    assert (counts.sum(axis=1) == 4).all()
    for i in range(4):
        t, gap = done.values[i]
        own = read_text(
            DECK.replace("T1=170", f"T1={t}").replace("GAP=3", f"GAP={1e3 * gap}"), "own.inp"
        )
        words = card_states(trunnion.solve(own)["OPE"])
        shown = [STATES[level] for level in done.answers.level[i, done.cases.index("OPE")]]
        assert shown == words


def test_variants_that_do_not_matter_name_the_first(model):
    done = trunnion.study(model, ["T1=100,150,200"], jobs=1)
    found, _ = done.envelope("SUS")
    assert set(found.highest_case.ravel().tolist()) <= {-1, 0}
    assert set(found.lowest_case.ravel().tolist()) <= {-1, 0}


# ------------------------------------------------------------------ words
@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("GPA@20=0,3", "GPA is no quantity of a study; nearest: GAP"),
        ("MU", "write KEY[@label]=values"),
        ("GAP@SOFD=1", "there is no support SOFD; nearest: SOFT"),
        ("MU@20,+X=0.1", "+X is no direction there; there are +Y GUIDE"),
        ("MU=3", "MU=3 must be 0 to 2"),
        ("MU=-1:1:3", "MU=-1 must be 0 to 2"),
        ("MU=0.1:0.5", "0.1:0.5 is no range; write lo:hi:n"),
        ("MU=0.1:0.5:1", "1 in 0.1:0.5:1 is no number of values"),
        ("MU=0.1:0.5:x", "x in 0.1:0.5:x is no number of values"),
        ("MU=a", "a is not a number"),
        ("MU=0.1,0.1", "a value is given twice"),
        ("GAP@20=3kg", "unit kg does not fit"),
        ("T2=100", "no pipe of the deck has T2"),
        ("T1@10-21=100", "there is no pipe 10-21; nearest: 10-20"),
        ("OD@HDD=1", "there is no SECTION HDD; nearest: HDR"),
        ("E@STELL=1", "there is no MATERIAL STELL; nearest: STEEL"),
        ("DX=1", "DX needs a place: DX@a-b"),
        ("D1=1", "D1 needs a place: D1@node,DX"),
        ("D1@50,DW=1", "DW after the label is not one of DX DY DZ RX RY RZ"),
        ("D1@50,DY=1", "DY is free there"),
        ("FACTOR@T3=1", "there is no load set of a case T3"),
        ("STEPS@OPA=2", "there is no CASE OPA; nearest: OPE"),
        ("STEPS=1.5", "1.5 is not a whole number"),
        ("E@STEEL,X=1", "X after the comma is not expected"),
    ],
)
def test_a_wrong_word_is_told_with_what_would_be_right(model, text, said):
    with pytest.raises(trunnion.BatchError) as error:
        read_axes(model, [text])
    assert said in str(error.value)


def test_a_gap_where_several_directions_have_none_needs_a_word():
    model = read_text(DECK.replace("GAP=3", ""), "none.inp")
    with pytest.raises(trunnion.BatchError, match=r"name one after a comma: \+Y GUIDE"):
        read_axes(model, ["GAP@20=3"])
    assert len(read_axes(model, ["GAP@20,GUIDE=3"])) == 1


def test_all_wrong_words_are_told_at_once(model):
    with pytest.raises(trunnion.BatchError) as error:
        trunnion.study(model, ["GPA=1", "MU=9", "MU=0.1", "MU=0.2"])
    assert str(error.value).count("--vary") == 3  # and MU twice
    with pytest.raises(trunnion.BatchError, match="MU: given twice"):
        trunnion.study(model, ["MU=0.1", "MU=0.2"])
    with pytest.raises(
        trunnion.BatchError, match="--case OPA: there is no such case; nearest: OPE"
    ):
        trunnion.study(model, ["MU=0.1"], cases=["OPA"])


def test_ranges_are_named_in_their_unit(model):
    axis = read_axes(model, ["GAP@20=0.1in:0.5in:3"])[0]
    assert axis.texts == ("0.1in", "0.3in", "0.5in")
    assert axis.values == pytest.approx((0.00254, 0.00762, 0.0127))


# ------------------------------------------------------------------ the command
HELD = """\
UNITS    m N Pa C
MATERIAL STEEL E=203e9 NU=0.3
SECTION  P OD=0.1 WALL=0.01
PIPE     10 20 DX=1
SUPPORT  10 +Y MU=0.3 Z RX
SUPPORT  20 +Y MU=0.3 Z
FORCE    10 F1 FX=200 FY=-1000
CASE PUSH = F1
"""


def command(*arguments):
    done = subprocess.run(
        [sys.executable, "-m", "trunnion", "study", *map(str, arguments)],
        capture_output=True, text=True,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def test_variants_without_answer_are_listed_and_the_exit_code_is_one(tmp_path):
    deck = tmp_path / "held.inp"
    deck.write_text(HELD)
    code, out, err = command(deck, "--vary", "MU=0.1,0.3", "-o", tmp_path)
    assert (code, err) == (1, "")
    assert "variant 1 (MU=0.1), PUSH: " in out
    assert "1 of 2 answers certified" in out
    found = json.loads((tmp_path / "held-study.json").read_text())
    first, second = (variant["cases"]["PUSH"] for variant in found["variants"])
    assert not first["converged"]
    assert "needs a friction force of" in first["cause"]
    assert first["certificate"]["worst"] is None
    assert second["converged"]
    assert sum(second["states"].values()) == 2
    assert found["envelope"]["PUSH"][0]["max_variant"][0] == 2


@pytest.mark.parametrize(
    ("vary", "said"), [("WALL=10,150", "WALL"), ("LINING=5,140", "LINING"), ("R@30=381,9000", "30")]
)
def test_a_variant_that_cannot_be_built_is_one_failure(model, vary, said):
    done = trunnion.study(model, [vary], cases=["OPE"], jobs=1)
    assert [i for i, _, _ in done.failures] == [1]
    assert said in done.failures[0][2].upper()
    assert done.good[0].all()


def test_a_deck_that_moves_freely_is_refused_whatever_varies(tmp_path):
    deck = tmp_path / "free.inp"
    deck.write_text(HELD.replace(" Z RX", "").replace(" Z\n", "\n"))
    code, out, err = command(deck, "--vary", "MU=0.1,0.3", "-o", tmp_path / "out")
    assert (code, out) == (2, "")
    assert "every variant: " in err
    assert not (tmp_path / "out").exists()


def test_files_of_a_study(tmp_path, model):
    deck = tmp_path / "line.inp"
    deck.write_text(DECK)
    code, out, _ = command(
        deck, "--vary", "MU=0.1:0.5:3", "--vary", "GAP@20=0,3", "--case", "OPE", "-o", tmp_path
    )
    assert code == 0
    done = trunnion.study(model, ["MU=0.1:0.5:3", "GAP@20=0,3"], cases=["OPE"])
    assert (tmp_path / "line-study.out").read_bytes() == study_report(done, model)
    assert (tmp_path / "line-study.json").read_bytes() == study_json(done)
    assert (tmp_path / "line-study.csv").read_bytes() == envelope_csv(done)
    assert (tmp_path / "line-variants.csv").read_bytes() == variants_csv(done)
    rows = list(csv.DictReader(io.StringIO(variants_csv(done).decode())))
    assert len(rows) == 6
    assert {row["case"] for row in rows} == {"OPE"}
    envelope = list(csv.DictReader(io.StringIO(envelope_csv(done).decode())))
    assert len(envelope) == 6 * len(done.system.cards)
    assert "LARGEST FORCES ON RESTRAINTS" in out


@pytest.mark.parametrize(
    "arguments", [(), ("--vary", "GPA=1"), ("--vary", "MU=0.1", "--case", "X")]
)
def test_a_study_that_cannot_be_writes_nothing(tmp_path, arguments):
    deck = tmp_path / "held.inp"
    deck.write_text(HELD)
    code, out, err = command(deck, *arguments, "-o", tmp_path / "out")
    assert (code, out) == (2, "")
    assert "nothing was solved" in err
    assert not (tmp_path / "out").exists()


def test_a_file_of_another_program_is_studied_with_its_options(tmp_path):
    import pcf_lines

    (tmp_path / "a.pcf").write_text(pcf_lines.everything())
    (tmp_path / "table.toml").write_text(pcf_lines.TABLE)
    command = [sys.executable, "-m", "trunnion", "study", "a.pcf", "--vary", "T1=100,150"]
    more = ["--table", "table.toml", "--anchor", "open-ends", "--permissive", "-j", "1"]
    done = subprocess.run([*command, *more], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    assert "2 variants of" in done.stdout
    done = subprocess.run([*command, "--permissive"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2  # without its table
