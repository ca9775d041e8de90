"""Pipe rack lines of 50, 200 and 1000 nodes against exact reference answers.

tests/data/rack_N.npz: displacements [m, rad], normal force along the support's direction [N],
friction and status, computed by an independent program to an equilibrium residual of 3e-16 of
the largest force and re-checked in rational arithmetic by a third one.  Displacements within
1e-9 m; a state may differ only within 1e-6 of its threshold, and then it is listed here.
"""

import json
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from published import PROGRAMS, Source, agrees

import trunnion
from trunnion.arrays import OPEN, SLIP, STICK

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from rack import (  # noqa: E402
    node_displacements,
    plan_rotation,
    rack_model,
    read_rack,
    solve_rack,
    support_forces,
    turned,
)

RACKS = {
    n: Source(
        PROGRAMS,
        f"Pipe rack of {n} nodes",
        f"rack_{n}",
        f"Model family piperack-1; reference answers in `tests/data/rack_{n}.npz`, by an "
        "independent program to an equilibrium residual of 3e-16 of the largest force and checked "
        "again in rational arithmetic by a third one. Every displacement agrees to 1e-9 m, every "
        "normal force to 1e-9 and friction to 1e-8 of the largest, every state; the numbers here "
        "stand on top of the deck.",
    )
    for n in (50, 200)
}
LARGEST = {  # movement [m], rests that slip
    50: {"gap": ("0.040774", None), "fric1": ("0.040747", 11), "fric10": ("0.040750", 6)},
    200: {"gap": ("0.110238", None), "fric1": ("0.081137", 42), "fric10": ("0.081136", 37)},
}
SIZES = (50, 200, 1000)
CASES = ("lin", "gap", "fric1", "fric10")
ALL = [(n, case) for n in SIZES for case in CASES]
LISTED: dict[tuple[int, str], list[int]] = {}  # supports whose state differs at its threshold


@cache
def rack(n):
    return read_rack(ROOT / f"tests/data/rack_{n}.json.gz")


@cache
def reference(n):
    return dict(np.load(ROOT / f"tests/data/rack_{n}.npz"))


@cache
def run(n, case, angle=0.0):
    return solve_rack(turned(rack(n), angle) if angle else rack(n), case)


def solved(n, case, angle=0.0):
    return run(n, case, angle)[case.upper()]


@pytest.mark.parametrize(("n", "case"), ALL)
def test_certificate(n, case):
    result = solved(n, case)
    assert result.converged, result.cause
    assert result.certificate.passed
    assert result.certificate.worst < 1e-9


@pytest.mark.parametrize(("n", "case"), ALL)
def test_displacements(n, case):
    u = node_displacements(solved(n, case))
    assert np.abs(u - reference(n)[f"{case}_u"])[:, :3].max() < 1e-9


@pytest.mark.parametrize(("n", "case"), ALL)
def test_support_forces(n, case):
    normal, friction = support_forces(solved(n, case), rack(n))
    want = reference(n)[f"{case}_normal"]
    assert np.abs(normal - want).max() < 1e-9 * np.abs(want).max()
    if f"{case}_friction" in reference(n):
        want = reference(n)[f"{case}_friction"]
        assert np.abs(friction - want).max() < 1e-8 * np.abs(want).max()


def status(result, i):
    """State of support i in the words of the reference."""
    contact = int(np.flatnonzero(result.system.contacts.card == i)[0])
    side = int(result.state.side[contact])
    word = {OPEN: "open", -1: "minus", 1: "plus", 2: "minus"}[side]
    slider = np.flatnonzero(result.system.sliders.card == i)
    if len(slider) == 0 or side == OPEN:
        return word
    return word + {STICK: "+stick", SLIP: "+slip"}[int(result.state.mode[slider[0]])]


@pytest.mark.parametrize(("n", "case"), ALL)
def test_states(n, case):
    result, want = solved(n, case), reference(n)[f"{case}_status"]
    differ = [i for i in range(len(want)) if status(result, i) != want[i]]
    assert differ == LISTED.get((n, case), [])


@pytest.mark.parametrize("n", LARGEST)
@pytest.mark.parametrize("case", ["gap", "fric1", "fric10"])
def test_numbers_on_top_of_the_decks(n, case):
    movement, slipping = LARGEST[n][case]
    result = solved(n, case)
    largest = np.abs(node_displacements(result)[:, :3]).max()
    agrees(RACKS[n], f"{case.upper()}, largest movement", movement, largest, "m")
    if slipping is not None:
        slips = int((result.state.mode == SLIP).sum())
        agrees(RACKS[n], f"{case.upper()}, rests that slip", slipping, slips)


@pytest.mark.parametrize("angle", [30.0, 45.0, 137.0])
@pytest.mark.parametrize(("n", "case"), [(n, case) for n in (50, 200) for case in CASES])
def test_turned_model_gives_the_turned_answer(n, case, angle):
    result = solved(n, case, angle)
    assert result.certificate.worst < 1e-9
    u = node_displacements(result)[:, :3] @ plan_rotation(angle)
    assert np.abs(u - reference(n)[f"{case}_u"][:, :3]).max() < 1e-9


@pytest.mark.parametrize("case", CASES)
def test_turned_large_model(case):
    result = solved(1000, case, 23.0)
    assert result.certificate.worst < 1e-9
    u = node_displacements(result)[:, :3] @ plan_rotation(23.0)
    assert np.abs(u - reference(1000)[f"{case}_u"][:, :3]).max() < 1e-9


@pytest.mark.parametrize("n", [50, 200])
@pytest.mark.parametrize("case", ["gap", "fric1", "fric10"])
def test_deck_says_the_same_as_the_model(deck, n, case):
    # the deck is in mm with rounded prints of exact numbers: same model to the last digits
    result = trunnion.solve(deck(f"rack_{n}"))[case.upper()]
    u = node_displacements(result)
    assert np.abs(u - reference(n)[f"{case}_u"])[:, :3].max() < 1e-9


def test_linear_case_is_one_analysis_one_factorisation_one_solve():
    work = run(1000, "lin").work
    assert (work["analyse"], work["factorise"], work["solve"]) == (1, 1, 1)


def test_friction_case_needs_few_factorisations():
    assert run(1000, "fric1").work["factorise"] <= 60


@pytest.mark.parametrize("n", [50, 200])
def test_deck_is_what_its_script_writes(n, capsys):
    import rack_deck

    rack_deck.main(ROOT / f"tests/data/rack_{n}.json.gz")
    assert capsys.readouterr().out == (ROOT / f"models/rack_{n}.inp").read_text()


def test_benchmark_writes_what_it_promises(tmp_path):
    out = tmp_path / "out.json"
    command = [sys.executable, ROOT / "benchmarks/rack.py", ROOT / "tests/data/rack_50.json.gz"]
    done = subprocess.run([*command, "fric1", "-o", out], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    data = json.loads(out.read_text())
    u = np.array(data["displacements"])
    assert np.abs(u - reference(50)["fric1_u"])[:, :3].max() < 1e-9
    normal = np.array([s["normal"] for s in data["supports"]])
    assert np.abs(normal - reference(50)["fric1_normal"]).max() < 1e-3
    assert [s["id"] for s in data["supports"]] == [s["id"] for s in rack(50)["supports"]]
    assert all(len(s["friction"]) == 3 for s in data["supports"])
    assert data["certificate"]["passed"]
    assert data["work"]["factorise"] > 0
    assert data["seconds"] > 0
    assert data["peak_mb"] > 0


def test_rack_model_counts():
    model = rack_model(rack(50), "fric10")
    assert len(model.supports) == len(rack(50)["supports"]) + 2
    assert model.cases[0].steps == 10
