"""trunnion verify, diff and show on results that were written and then changed."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from program import leave, stored

from trunnion.compare import numbers

MODELS = Path(__file__).parents[2] / "models"
DECK = """\
TITLE    Line on rests
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
SUPPORT  40      +Y MU=0.3
SNUBBER  40      X
CASE SUS = W + P1
CASE OPE = W + P1 + T1
COMB EXP = OPE - SUS
CASE HSUS = W + P1 ON=OPE
CASE EQX = U(0.3,0,0) ABOUT=OPE
COMB OCC = SUS + ABS(EQX)
"""


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Bytes of the JSON of DECK."""
    return stored(tmp_path_factory.mktemp("line"), DECK)


@pytest.fixture
def home(tmp_path, written, monkeypatch):
    (tmp_path / "a.inp").write_text(DECK)
    (tmp_path / "a.json").write_bytes(written)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def change(home):
    """Change the stored result and write it as b.json."""

    def make(edit) -> None:
        report = json.loads((home / "a.json").read_bytes())
        edit(report)
        (home / "b.json").write_text(json.dumps(report))

    return make


def scaled(row: list[float], by: float) -> None:
    """Scale the largest number of a row."""
    i = max(range(len(row)), key=lambda i: abs(row[i]))
    row[i] *= by


# ---------------------------------------------------------------------- manifest
def test_the_manifest_names_the_deck_its_hash_the_version_and_settings(home):
    import hashlib
    from importlib.metadata import version

    manifest = json.loads((home / "a.json").read_bytes())["manifest"]
    assert manifest == {
        "deck": "a.inp",
        "sha256": hashlib.sha256(DECK.encode()).hexdigest(),
        "version": version("trunnion"),
        "settings": {"iteration": "NEWTON", "events": False, "permissive": False},
    }


def test_the_same_deck_in_another_folder_gives_the_same_bytes(home, written):
    (home / "there").mkdir()
    (home / "there" / "a.inp").write_text(DECK)
    assert leave("run", home / "there" / "a.inp", "-o", "out") == 0
    assert (home / "out" / "a.json").read_bytes() == written


def test_a_change_of_an_included_file_changes_the_hash(tmp_path):
    from trunnion import read

    (tmp_path / "a.inp").write_text("INCLUDE rest.inp\n")
    found = []
    for text in (DECK, DECK + "! a comment\n"):
        (tmp_path / "rest.inp").write_text(text)
        found.append(read(tmp_path / "a.inp").file)
    assert found[0].name == "a.inp"
    assert found[0].sha256 != found[1].sha256


# ---------------------------------------------------------------------- verify
def test_a_result_agrees_with_a_new_run(home, capsys):
    assert leave("verify", "a.json") == 0
    assert "6 cases agree" in capsys.readouterr().out


def test_a_number_that_a_new_run_does_not_give_is_named(change, capsys):
    change(lambda r: scaled(r["cases"]["OPE"]["supports"][0]["force"], 1 + 1e-6))
    assert leave("verify", "b.json") == 1
    assert capsys.readouterr().out.startswith("OPE support ")


def test_an_envelope_that_a_new_run_does_not_give_is_named(change, capsys):
    change(lambda r: scaled(r["envelope"][0]["max"], 1 + 1e-6))
    assert leave("verify", "b.json") == 1
    assert capsys.readouterr().out.startswith("envelope support 10 max: F")


def test_another_case_named_for_an_extreme_is_told(change, capsys):
    def edit(report):
        named = report["envelope"][0]["max_case"]
        named[named.index("OPE")] = "SUS"

    change(edit)
    assert leave("verify", "b.json") == 1
    out = capsys.readouterr().out
    assert out.startswith("envelope support 10 max: case of F")
    assert out.rstrip().endswith("SUS -> OPE")


def test_what_is_no_envelope_is_refused(change, capsys):
    change(lambda r: r["envelope"][0].pop("max"))
    assert leave("verify", "b.json") == 2
    assert "envelope: no table of trunnion run" in capsys.readouterr().err


@pytest.fixture(scope="module")
def cycled(tmp_path_factory):
    return stored(tmp_path_factory.mktemp("loop"), (MODELS / "cycle_line.inp").read_text())


@pytest.mark.parametrize(
    ("place", "said"),
    [
        (("supports", 0, "range"), "CYCLE HEAT support 0 range: FX"),
        (("supports", 0, "one_shot"), "CYCLE HEAT support 0 one shot: FX"),
        (("supports", 0, "path", 1), "CYCLE HEAT support 0 step 2: FX"),
        (("elements", 0, "range_from"), "CYCLE HEAT element 0-10 range from: FX"),
        (("states", 1, "elements", 0, "force_from"), "CYCLE HEAT step 1 COLD element 0-10 from"),
        (("loops",), "CYCLE HEAT: loops 3 -> 2"),
        (("repeats",), "CYCLE HEAT: repeats False -> True"),
        ((), "cycle HEAT: cycle absent -> present"),
    ],
)
def test_a_cycle_that_a_new_run_does_not_give_is_named(
    tmp_path, monkeypatch, cycled, place, said, capsys
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.inp").write_bytes((MODELS / "cycle_line.inp").read_bytes())
    report = json.loads(cycled)
    if not place:
        del report["cycles"]
    else:
        at = report["cycles"]["HEAT"]
        for key in place[:-1]:
            at = at[key]
        last = place[-1]
        if last == "loops":
            at[last] = 3
        elif last == "repeats":
            at[last] = False
        else:
            scaled(at[last], 1 + 1e-6)
    (tmp_path / "a.json").write_bytes(cycled)
    (tmp_path / "b.json").write_text(json.dumps(report))
    assert leave("verify", "a.json") == 0
    assert leave("verify", "b.json") == 1
    assert said in capsys.readouterr().out


def test_stored_numbers_are_judged_without_solving(home, monkeypatch, capsys):
    import trunnion

    monkeypatch.setattr(trunnion, "solve", None)
    assert leave("verify", "--certificate", "a.json") == 0
    out = capsys.readouterr().out
    assert [line.split(":")[:2] for line in out.splitlines()] == [
        [name, " holds"] for name in ("SUS", "OPE", "EXP", "HSUS", "EQX", "OCC", "envelope")
    ]


@pytest.mark.parametrize("case", ["SUS", "OPE", "EXP", "HSUS", "EQX", "OCC"])
@pytest.mark.parametrize(
    ("table", "row"),
    [
        ("elements", "force_from"),
        ("elements", "force_to"),
        ("elements", "local_to"),
        ("supports", "force"),
        ("supports", "moment"),
        ("nodes", "40"),
    ],
)
def test_a_force_changed_by_1e_6_fails_and_so_does_a_movement(change, case, table, row, capsys):
    def edit(report):
        entries = report["cases"][case][table]
        rows = [entries[row]] if table == "nodes" else [entry[row] for entry in entries]
        scaled(max(rows, key=lambda values: max(map(abs, values))), 1 + 1e-6)

    change(edit)
    assert leave("verify", "--certificate", "b.json") == 1
    assert f"{case}: FAILS" in capsys.readouterr().out


def test_a_contact_force_changed_by_1e_6_fails(change):
    def edit(report):
        rest = next(s for s in report["cases"]["OPE"]["supports"] if s["id"] == "40")
        scaled(rest["contacts"][0]["vector"], 1 + 1e-6)

    change(edit)
    assert leave("verify", "--certificate", "b.json") == 1


def test_tables_that_do_not_fit_the_deck_fail(change, capsys):
    change(lambda r: r["cases"]["OPE"]["elements"].pop())
    assert leave("verify", "--certificate", "b.json") == 1
    assert "OPE: FAILS: its tables do not fit the deck" in capsys.readouterr().out


@pytest.mark.parametrize("options", [(), ("--certificate",)])
def test_a_changed_deck_is_named_and_nothing_is_compared(home, options, capsys):
    (home / "a.inp").write_text(DECK.replace("R=381", "R=400"))
    assert leave("verify", *options, "a.json") == 2
    said = capsys.readouterr()
    assert said.err.startswith("a.inp: not the deck of a.json, or changed since")
    assert said.out == ""


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", '{"schema":1}', '{"schema":1,"cases":{"A":3}}', "[" * 100000,
     '{"schema":1,"cases":{"A":{"converged":true}}}', '{"schema":NaN}'],
)  # fmt: skip
@pytest.mark.parametrize("command", [("verify",), ("show",), ("diff", "a.json")])
def test_what_is_no_result_is_refused(home, text, command, capsys):
    (home / "bad.json").write_text(text)
    assert leave(*command, "bad.json") == 2
    assert "bad.json: " in capsys.readouterr().err


def test_a_result_without_manifest_and_one_without_deck_are_refused(change, capsys):
    change(lambda r: r.pop("manifest"))
    assert leave("verify", "b.json") == 2
    assert "no manifest" in capsys.readouterr().err
    Path("a.inp").unlink()
    assert leave("verify", "a.json") == 2
    assert "--deck PATH" in capsys.readouterr().err


@pytest.mark.parametrize("options", [(), ("--certificate",)])
def test_after_make_demo_a_result_finds_its_deck_in_models(tmp_path, monkeypatch, options, capsys):
    """As `make demo` has it: decks in models, results in demo, and the command of the README."""
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "hot_header.inp").write_bytes((MODELS / "hot_header.inp").read_bytes())
    monkeypatch.chdir(tmp_path)
    assert leave("run", "models/hot_header.inp", "-o", "demo") == 0
    readme = (MODELS.parent / "README.md").read_text()
    assert "    trunnion verify demo/hot_header.json\n" in readme
    capsys.readouterr()
    assert leave("verify", *options, "demo/hot_header.json") == 0
    out = capsys.readouterr().out
    assert options or out == "5 cases agree with a new run of models/hot_header.inp\n"
    monkeypatch.chdir("demo")
    assert leave("verify", "--certificate", "hot_header.json") == 0


@pytest.mark.parametrize("place", [".", "models", "out", "out/models", "here", "here/models"])
def test_a_deck_is_found_by_its_hash_where_decks_are_kept(home, place, monkeypatch, capsys):
    """Another deck of the same name, even one that cannot be read, does not hide it."""
    (home / "out").mkdir()
    (home / "here").mkdir()
    (home / "a.json").rename(home / "out" / "a.json")
    (home / "a.inp").write_text("PIPE\n")
    (home / place).mkdir(exist_ok=True)
    (home / place / "a.inp").write_text(DECK)
    monkeypatch.chdir(home / "here")
    assert leave("verify", "--certificate", "../out/a.json") == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("options", [(), ("--certificate",)])
def test_a_deck_that_is_not_found_is_asked_for_with_the_whole_command(home, options, capsys):
    (home / "a.inp").rename(home / "kept.inp")
    assert leave("verify", *options, "a.json") == 2
    command = capsys.readouterr().err.splitlines()[-1].split()
    assert command == ["trunnion", "verify", *options, "a.json", "--deck", "PATH/a.inp"]
    assert leave(*command[1:-1], "kept.inp") == 0


def test_verify_prints_the_largest_differences_and_counts_the_rest(change, capsys):
    def edit(report):
        for row in report["cases"]["OPE"]["nodes"].values():
            row[0] += 0.001

    change(edit)
    assert leave("verify", "b.json") == 1
    shown = capsys.readouterr().out.splitlines()
    nodes = len(json.loads(Path("b.json").read_text())["cases"]["OPE"]["nodes"])
    assert len(shown) == min(nodes, 21)
    assert leave("verify", "--most", "2", "b.json") == 1
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert lines[-1] == f"... and {nodes - 2} more differences"


@pytest.fixture
def plant(tmp_path, monkeypatch):
    """A result of a PCF with a side table and anchors, in a folder of its own."""
    for name in ("plant_line.pcf", "plant_line.toml"):
        (tmp_path / name).write_bytes((MODELS / "foreign" / name).read_bytes())
    monkeypatch.chdir(tmp_path)
    options = ("--table", "plant_line.toml", "--anchor", "open-ends", "--tolerance", "2mm")
    assert leave("run", "plant_line.pcf", "-o", "out", *options) == 0
    return tmp_path


def test_what_was_said_beside_a_pcf_is_in_the_manifest_and_found_again(plant, capsys):
    import hashlib

    manifest = json.loads((plant / "out" / "plant_line.json").read_bytes())["manifest"]
    table = (plant / "plant_line.toml").read_bytes()
    assert manifest["options"] == {
        "table": "plant_line.toml",
        "table_sha256": hashlib.sha256(table).hexdigest(),
        "tolerance": 0.002,
        "anchors": ["open-ends"],
    }
    for options in ((), ("--certificate",)):
        assert leave("verify", *options, "out/plant_line.json") == 0
    capsys.readouterr()
    (plant / "plant_line.toml").write_bytes(table + b"# a comment\n")
    assert leave("verify", "out/plant_line.json") == 2
    assert capsys.readouterr().err.startswith(
        "plant_line.toml: the table changed since plant_line.json was written"
    )
    (plant / "plant_line.toml").rename(plant / "kept.toml")
    assert leave("verify", "out/plant_line.json") == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert "its side table plant_line.toml is not beside the deck" in said
    assert said.endswith("trunnion verify out/plant_line.json --table PATH/plant_line.toml")
    (plant / "kept.toml").write_bytes(table)
    assert leave("verify", "out/plant_line.json", "--table", "kept.toml") == 0


@pytest.mark.parametrize(
    ("place", "number"),
    [
        *((place, "1" + "0" * 400) for place in ("nodes", "elements", "modes")),
        ("nodes", "-1" + "0" * 400),
        ("nodes", "1" * 5000),
        ("nodes", "1e999"),
        ("elements", "-1e999"),
    ],
)
@pytest.mark.parametrize(
    "command", [("verify",), ("verify", "--certificate"), ("show",), ("diff", "a.json")]
)
def test_a_number_beyond_floating_point_is_refused(change, number, place, command, capsys):
    def edit(report):
        case = report["cases"]["OPE"]
        rows = {"nodes": case["nodes"]["40"], "elements": case["elements"][1]["force_to"]}
        rows.get(place, report["modes"]["frequency_hz"])[:1] = ["HUGE"]

    change(edit)
    text = Path("b.json").read_text()
    assert text.count('"HUGE"') == 1
    Path("b.json").write_text(text.replace('"HUGE"', number))
    assert leave(*command, "b.json") == 2
    assert capsys.readouterr().err.startswith("b.json: ")


# ---------------------------------------------------------------------- diff
def test_decks_that_say_the_same_are_the_same(home, capsys):
    (home / "b.inp").write_text(DECK.replace("R=381", "R=0.381m ! in metres").lower())
    Path("b.inp").write_text(Path("b.inp").read_text().replace("line on rests", "Line on rests"))
    assert leave("diff", "a.inp", "a.inp") == 0
    assert capsys.readouterr().out == ""


def test_a_changed_friction_is_named_with_its_support(home, capsys):
    (home / "b.inp").write_text(DECK.replace("+Y MU=0.3", "+Y MU=0.1"))
    assert leave("diff", "a.inp", "b.inp") == 1
    assert capsys.readouterr().out == "support 40: +Y MU 0.3 -> 0.1\n"


def test_changes_of_decks_are_sorted_by_importance(home, capsys):
    new = DECK.replace("Line on", "Pipe on").replace("MU=0.3\nSN", "MU=0.1\nSN")
    (home / "b.inp").write_text(new.replace("R=381", "R=400").replace("SNUBBER  40      X\n", ""))
    assert leave("diff", "a.inp", "b.inp") == 1
    heads = [line.split(":")[0] for line in capsys.readouterr().out.splitlines()]
    assert heads == ["snubber 40", "bend 30", "support 40", "title"]


def test_a_changed_load_of_a_result_is_named_in_per_cent(change, capsys):
    def edit(report):
        anchor = report["cases"]["OPE"]["supports"][0]
        anchor["force"] = [1000.0, *anchor["force"][1:]]

    change(edit)
    Path("b.json").rename("c.json")
    change(lambda r: (edit(r), r["cases"]["OPE"]["supports"][0]["force"].__setitem__(0, 1120.0)))
    assert leave("diff", "c.json", "b.json") == 1
    out = capsys.readouterr().out
    assert out.startswith("OPE support ")
    assert "FX 1000 N -> 1120 N (+12 %)" in out
    assert len(out.splitlines()) == 1


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        (1000.0, 1120.0, "+12 %"),
        (-1000.0, -1120.0, "+12 %"),
        (-4996.1, -2763.3, "-44.7 %"),
        (1000.0, -500.0, "-150 %"),
        (0.0, 1.0, ""),
    ],
)
def test_per_cent_tell_growth_in_either_direction(before, after, said):
    assert numbers.share(before, after) == said


def test_a_tolerance_lets_small_changes_pass(change):
    change(lambda r: scaled(r["cases"]["OPE"]["nodes"]["40"], 1 + 1e-6))
    assert leave("diff", "a.json", "b.json") == 1
    assert leave("diff", "--tolerance", "1e-5", "a.json", "b.json") == 0


def test_a_case_that_failed_or_went_comes_before_every_number(change, capsys):
    def edit(report):
        scaled(report["cases"]["OPE"]["nodes"]["40"], 2.0)
        report["cases"]["SUS"] = {"converged": False, "cause": "friction cycles"}
        del report["cases"]["EXP"]

    change(edit)
    assert leave("diff", "a.json", "b.json") == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "SUS: case solved -> not converged (friction cycles)"
    assert lines[1] == "case EXP: case present -> absent"


def test_a_deck_and_a_result_cannot_be_compared(home, capsys):
    assert leave("diff", "a.inp", "a.json") == 2
    assert "two of a kind" in capsys.readouterr().err


@pytest.fixture
def git(home):
    """Git in a repository with a.inp, deaf to the user's settings; in `lines` (deck)."""
    own = {**os.environ, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}

    def call(*arguments: str) -> str:
        who = ("-c", "user.name=a", "-c", "user.email=a@example.org")
        return subprocess.run(
            ["git", *who, *arguments], capture_output=True, text=True, check=True, env=own
        ).stdout

    (home / ".gitattributes").write_text("*.inp diff=trunnion\n*.json diff=trunnion\n")
    call("init", "-q")
    call("add", ".")
    call("commit", "-q", "-m", "first")
    return call


DRIVER = f"diff.trunnion.command={sys.executable} -m trunnion diff --git"
TEXTCONV = f"diff.trunnion.textconv={sys.executable} -m trunnion diff --canonical"


def test_it_is_a_diff_driver_of_git(home, git):
    (home / "a.inp").write_text(DECK.replace("+Y MU=0.3", "+Y MU=0.1"))
    assert git("-c", DRIVER, "diff") == "trunnion diff a.inp\n  support 40: +Y MU 0.3 -> 0.1\n"


def test_git_shows_renamed_new_and_deleted_decks(home, git):
    git("mv", "a.inp", "b.inp")
    (home / "b.inp").write_text(DECK.replace("+Y MU=0.3", "+Y MU=0.1"))
    (home / "c.inp").write_text(DECK.replace("TITLE", "TITLE Another"))
    git("add", ".")
    shown = git("-c", DRIVER, "diff", "-M", "HEAD")
    assert "trunnion diff a.inp -> b.inp\n  support 40: +Y MU 0.3 -> 0.1\n" in shown
    assert "trunnion diff c.inp\n  new file\n" in shown
    git("commit", "-q", "-m", "second")
    git("rm", "-q", "c.inp")
    assert git("-c", DRIVER, "diff", "HEAD") == "trunnion diff c.inp\n  deleted file\n"
    shown = git("-c", TEXTCONV, "diff", "HEAD~", "HEAD", "--", "c.inp")
    assert "+SUPPORT 40 +Y" in shown
    assert "+++ b/c.inp" in shown


def test_git_compares_results_and_says_what_is_not_merged(home, git, change):
    change(lambda r: scaled(r["cases"]["OPE"]["supports"][0]["force"], 1.12))
    (home / "b.json").replace("a.json")
    assert "trunnion diff a.json\n  OPE support 10: F" in git("-c", DRIVER, "diff")
    from trunnion.compare.gitdriver import driver

    assert driver([Path("a.inp")], None) == ["trunnion diff a.inp", "  not merged"]


def test_git_finds_includes_in_the_work_tree(home, git):
    (home / "lines").mkdir()
    (home / "common.inp").write_text("".join(DECK.splitlines(keepends=True)[2:5]))
    rest = DECK.splitlines(keepends=True)
    (home / "lines" / "x.inp").write_text(
        "".join([*rest[:2], "INCLUDE ../common.inp\n", *rest[5:]])
    )
    git("add", ".")
    git("commit", "-q", "-m", "second")
    text = (home / "lines" / "x.inp").read_text()
    (home / "lines" / "x.inp").write_text(text.replace("+Y MU=0.3", "+Y MU=0.1"))
    said = "trunnion diff lines/x.inp\n  support 40: +Y MU 0.3 -> 0.1\n"
    assert git("-c", DRIVER, "diff") == said


@pytest.mark.parametrize("how", [DRIVER, TEXTCONV])
def test_a_file_that_is_no_whole_deck_does_not_end_git_diff(home, git, how):
    (home / "a.inp").write_text(DECK.replace("ANCHOR   10", "ANCOR    10"))
    shown = git("-c", how, "diff")
    assert "a.inp:7: ANCOR: unknown keyword" in shown
    assert "git-blob" not in shown
    assert "-ANCHOR" in shown
    assert "+ANCOR    10" in shown


# ---------------------------------------------------------------------- show
def test_the_summary_has_every_case_and_no_colour_when_piped(home, capsys):
    assert leave("show", "a.json") == 0
    out = capsys.readouterr().out
    assert "\x1b" not in out
    rows = [line.split() for line in out.splitlines()[2:]]
    assert [row[0] for row in rows][:6] == ["SUS", "OPE", "EXP", "HSUS", "EQX", "OCC"]


def test_a_node_shows_the_numbers_of_the_file(home, capsys):
    assert leave("show", "a.json", "--case", "ope", "--node", "40") == 0
    out = capsys.readouterr().out
    case = json.loads((home / "a.json").read_bytes())["cases"]["OPE"]
    rest = next(s for s in case["supports"] if s["id"] == "40")
    for value in rest["force"]:
        assert f"{value + 0.0:.1f}".replace("-0.0", "0.0") in out
    assert f"{1e3 * case['nodes']['40'][0]:.4f}" in out
    assert any(line.split()[1:2] == ["to"] for line in out.splitlines())


def test_directions_that_differ_have_their_own_states(home, capsys):
    assert leave("show", "a.json", "--case", "OPE", "--node", "20") == 0
    case = json.loads((home / "a.json").read_bytes())["cases"]["OPE"]
    rest, guide = next(s for s in case["supports"] if s["id"] == "20")["contacts"]
    assert (rest["dir"], rest["state"], guide["dir"], guide["state"]) == (
        "+Y", "slip", "GUIDE", "open"
    )  # fmt: skip
    assert "20 +Y GUIDE  slip +Y, open GUIDE " in capsys.readouterr().out


def test_a_bend_shows_the_ends_at_its_far_point(home, capsys):
    assert leave("show", "a.json", "--case", "OPE", "--node", "30") == 0
    assert capsys.readouterr().out.count("30F-40 from") == 1


def test_stored_numbers_are_shown_in_other_units(home, capsys):
    assert leave("show", "a.json", "--case", "OPE", "--node", "40", "--units", "in LBF") == 0
    out = capsys.readouterr().out
    case = json.loads((home / "a.json").read_bytes())["cases"]["OPE"]
    rest = next(s for s in case["supports"] if s["id"] == "40")
    assert "DX [in]" in out
    assert "MX [lbf.in]" in out
    assert f" {rest['force'][1] / 4.4482216152605:.1f} " in out
    assert f" {case['nodes']['40'][0] / 0.0254:.5f} " in out
    assert leave("show", "a.json", "--units", "ft kN") == 0
    assert " kN at " in capsys.readouterr().out


@pytest.mark.parametrize("units", ["in", "lbf in", "in lbf psi", "", "furlong N"])
def test_units_that_are_none_are_refused(home, units, capsys):
    assert leave("show", "a.json", "--units", units) == 2
    assert "write a length and a force" in capsys.readouterr().err


@pytest.mark.parametrize("wrong", [("--case", "XXX"), ("--node", "XXX")])
def test_an_unknown_case_or_node_is_refused(home, wrong, capsys):
    assert leave("show", "a.json", *wrong) == 2
    assert "XXX" in capsys.readouterr().err


def test_colour_is_for_terminals_and_the_file_cannot_steer_one():
    from trunnion.report.stored import Look, summary_text

    text = summary_text({"title": "a\x1b[2Jb", "cases": {}}, Look())
    assert "\x1b[2J" not in text
