"""OpenSees and CalculiX solve exported jobs: movements, support loads and end forces agree.

OpenSees (extra opensees) finds contact states itself and forms the stiffness of every element;
what it cannot find, friction and gaps all round a riser, is held as Trunnion found it, and
Coulomb's law is judged in its own numbers.  CalculiX holds every state and prints seven digits.
"""

import copy
import json
import re
import shutil
from functools import cache
from pathlib import Path

import pytest

import trunnion
from trunnion.exports import build_job, files
from trunnion.exports.agreement import TOLERANCE, agrees, differences, laws, tried, unanswered
from trunnion.exports.confirm import TOLERANCES, answer
from trunnion.report.json import json_report

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"\| (\S+\.inp) \| (\d+) \| (\S+) \| (\S+) \|")
# deck -> cases, largest differences of OpenSees and of CalculiX, as docs/export.md states them
STATED = {
    deck: (int(cases), float(opensees), float(calculix))
    for deck, cases, opensees, calculix in ROW.findall((ROOT / "docs/export.md").read_text())
}
SEVEN_DIGITS = 2e-6  # half a unit of the last digit of the largest is 5e-7; loads are sums of some


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("jobs")


@cache
def solved(deck: str):
    """Model, answers and job of a deck; what no program can be given is left out."""
    model = trunnion.read(ROOT / deck)
    results = trunnion.solve(model)
    job = build_job(model, results, permissive=True)
    return job, json.loads(json_report(results, model))


def confirmed(deck: str, program: str, folder: Path):
    """Run a job in another program: its answer, and Trunnion's."""
    job, own = solved(deck)
    stem = Path(deck).stem
    for name, content in files(job, program, stem).items():
        (folder / name).write_bytes(content)
    return answer(job, program, folder, stem), own


def test_every_kind_of_deck_is_stated():
    assert {"models/hovgaard.inp", "models/rack_50.inp", "models/snubber_line.inp"} <= set(STATED)
    for cases, opensees, calculix in STATED.values():
        assert cases
        assert opensees <= TOLERANCE == 1e-6
        assert calculix <= TOLERANCES["calculix"] == SEVEN_DIGITS


@pytest.mark.parametrize("deck", STATED)
def test_opensees_agrees(deck, folder):
    pytest.importorskip("openseespy", reason="extra opensees")
    found, own = confirmed(deck, "opensees", folder)
    assert not unanswered(own, found)
    rows = differences(own, found)
    cases, stated, _ = STATED[deck]
    assert len(rows) == 3 * cases  # movements, supports, ends
    for row in rows:
        assert row.share <= stated, row
    for value, where in laws(found).values():
        assert value <= TOLERANCE, where


@pytest.mark.parametrize("deck", ["sliding_line", "cycle_line", "rack_50", "snubber_line"])
def test_friction_elements_of_opensees_find_the_answer_from_rest(deck, folder):
    pytest.importorskip("openseespy", reason="extra opensees")
    found, _ = confirmed(f"models/{deck}.inp", "opensees", folder)
    case = {"rack_50": "FRIC1"}.get(deck, "OPE")
    assert found["cases"][case]["friction"]["rest"] <= TOLERANCE
    assert "find the same answer" in tried(found, TOLERANCE)[case]


@pytest.mark.parametrize(("deck", "case"), [("hot_header", "OPE"), ("rack_200", "FRIC1")])
def test_friction_elements_of_opensees_keep_the_answer(deck, case, folder):
    pytest.importorskip("openseespy", reason="extra opensees")
    found, _ = confirmed(f"models/{deck}.inp", "opensees", folder)
    assert found["cases"][case]["friction"]["kept"] <= TOLERANCE


@pytest.mark.skipif(shutil.which("ccx") is None, reason="ccx is not installed")
@pytest.mark.parametrize("deck", STATED)
def test_calculix_agrees(deck, folder):
    found, own = confirmed(deck, "calculix", folder)
    assert not unanswered(own, found)
    rows = differences(own, found)
    cases, _, stated = STATED[deck]
    assert len(rows) == 2 * cases  # no end forces
    for row in rows:
        assert row.share <= stated, row
    for value, where in laws(found).values():
        assert value <= SEVEN_DIGITS, where


@pytest.mark.parametrize("program", ["opensees", "calculix"])
def test_the_held_states_are_judged(program, folder):
    """Friction that is given too large is no friction: Coulomb's law fails in their numbers."""
    if program == "calculix" and shutil.which("ccx") is None:
        pytest.skip("ccx is not installed")
    if program == "opensees":
        pytest.importorskip("openseespy", reason="extra opensees")
    model = trunnion.read(ROOT / "models/rack_50.inp")
    results = trunnion.solve(model)
    case = results["FRIC1"]
    case.state.friction *= 1.001
    job = build_job(model, results, ["FRIC1"], program=program)
    for name, content in files(job, program, "pushed").items():
        (folder / name).write_bytes(content)
    found = answer(job, program, folder, "pushed")
    value, where = laws(found)["FRIC1"]
    assert value > 1e-4
    assert where.startswith("friction of ")
    if program == "opensees":  # whose own elements leave that answer
        assert found["cases"]["FRIC1"]["friction"]["kept"] > 1e-6


@pytest.mark.parametrize("member", ["nodes", "supports", "elements"])
def test_a_number_that_is_off_by_a_millionth_and_a_half_is_found(member, folder):
    pytest.importorskip("openseespy", reason="extra opensees")
    deck = "models/b313_s302.inp"
    found, own = confirmed(deck, "opensees", folder)
    wrong = copy.deepcopy(own)
    entries = wrong["cases"]["OPE"][member]
    rows = (
        [entries[label] for label in found["cases"]["OPE"]["nodes"]]
        if member == "nodes"
        else [entry["force" if member == "supports" else "force_from"] for entry in entries]
    )
    row = max(rows, key=lambda row: max(map(abs, row[:3])))
    i = max(range(3), key=lambda i: abs(row[i]))
    row[i] *= 1.0 + 1.5e-6
    assert agrees(differences(own, found), laws(found), TOLERANCE)
    assert not agrees(differences(wrong, found), laws(found), TOLERANCE)
