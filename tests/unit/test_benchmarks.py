"""The benchmark measures what it says, and what it says stands in the README and the docs."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
import page  # noqa: E402
import store  # noqa: E402
import tables  # noqa: E402
import targets  # noqa: E402
import time_spent  # noqa: E402
from children import Child, once, side_by_side  # noqa: E402
from exact import OPEN, SLIP, STICK, Guess, solve_exactly, supports_of  # noqa: E402
from floor import floor  # noqa: E402
from frame import LD, build_frame  # noqa: E402
from inside import accepting, watched  # noqa: E402
from programs.own import arrays, status  # noqa: E402
from rack import read_rack  # noqa: E402
from rack_line import rack_line  # noqa: E402
from racks import verdict  # noqa: E402
from references import guess, laws  # noqa: E402

from trunnion.cases.analysis import solve_system  # noqa: E402
from trunnion.solver.steps import Plan  # noqa: E402

CASES = ("lin", "gap", "fric1", "fric10")


def solved(rack, case):
    system, loads, steps = arrays(rack, case)
    return solve_system(system, {case: loads}, {case: Plan(steps=steps)})[case]


def published(n, case):
    return np.load(ROOT / f"tests/data/rack_{n}.npz")[f"{case}_u"]


# ------------------------------------------------------------------ models and references
@pytest.mark.parametrize("n", [50, 200, 1000])
def test_generated_racks_are_the_published_ones(n):
    stored = read_rack(ROOT / f"tests/data/rack_{n}.json.gz")
    stored.pop("params", None)
    assert rack_line(n) == stored


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("n", [50, 200, 1000])
def test_extended_references_agree_with_the_published_ones(n, case):
    # displacements are up to 0.8 m and published in double: half a unit of their last bit
    rack = rack_line(n)
    result = solved(rack, case)
    found = solve_exactly(build_frame(rack), rack, laws(rack, case, result), guess(rack, result))
    limit = 2e-16 if case != "fric10" else 1e-11  # data of nine steps are Trunnion's, in double
    assert np.abs(found.u - published(n, case))[:, :3].max() < limit
    assert found.residual < 1e-16
    assert found.changed == 0


@pytest.mark.parametrize("case", ["gap", "fric1"])
def test_wrong_states_of_the_guess_are_mended(case):
    rack = rack_line(200)
    result = solved(rack, case)
    supports = laws(rack, case, result)
    supports.side[np.flatnonzero(supports.side == OPEN)[0]] = 1
    if case == "fric1":
        supports.mode[np.flatnonzero(supports.mode == SLIP)[0]] = STICK
    found = solve_exactly(build_frame(rack), rack, supports, guess(rack, result))
    assert np.abs(found.u - published(200, case))[:, :3].max() < 2e-16
    assert found.changed > 0


def test_a_reference_needs_no_answer_to_start_from():
    rack = rack_line(50)
    n = len(rack["supports"])
    nothing = Guess(np.zeros((50, 6), LD), np.zeros(n, LD), np.zeros((n, 3), LD))
    supports = supports_of(rack, "lin", 1e12, 1e8)
    found = solve_exactly(build_frame(rack), rack, supports, nothing)
    assert np.abs(found.u - published(50, "lin"))[:, :3].max() < 2e-16


def test_penalty_error_falls_with_the_stiffness():
    # first order in 1/k_p: ten times as stiff, a tenth of the distance to rigid supports
    rack = rack_line(50)
    result, frame = solved(rack, "gap"), build_frame(rack)

    def exact(k):
        return solve_exactly(frame, rack, laws(rack, "gap", result, k), guess(rack, result)).u

    rigid = exact(np.inf)
    soft, stiff = (float(np.abs(exact(k) - rigid).max()) for k in (1e12, 1e13))
    assert soft / stiff == pytest.approx(10.0, rel=1e-3)


def test_the_floor_is_the_full_matrix():
    outcome = floor(rack_line(50), "lin")()
    lower = outcome.facts["nnz"]
    assert lower > 6 * 50
    assert outcome.seconds == pytest.approx(
        outcome.facts["factor_seconds"] + outcome.facts["solve_seconds"]
    )


# ------------------------------------------------------------------ looking into a run
def test_watching_sees_every_pass_and_changes_nothing():
    system, loads, _ = arrays(rack_line(50), "fric1")
    alone = solve_system(system, {"A": loads})["A"]
    with watched() as seen:
        result = solve_system(system, {"A": loads})["A"]
    assert np.array_equal(result.state.u, alone.state.u)
    assert len(seen.points) == len(result.history)
    assert seen.seconds == sorted(seen.seconds)
    distance = [off(point, seen, system) for point in seen.points]
    assert distance[-1] < 1e-9 < distance[0]
    assert off(seen.accepted, seen, system) < 1e-9


def off(point, seen, system):
    """Distance of a point of the iteration to the published answer [m]."""
    u = published(50, "fric1")[np.argsort([int(label) for label in system.labels])]
    return float(np.abs(point - u[seen.nodes])[:, :3].max())


def test_a_loose_status_iteration_accepts_a_point_that_is_off():
    system, loads, _ = arrays(rack_line(50), "fric1")
    error = {}
    for tolerance in (1e-3, 1e-5):
        with accepting(tolerance), watched() as seen:
            plan = Plan(iteration="STATUS", ramp=False)
            result = solve_system(system, {"A": loads}, {"A": plan})["A"]
        assert len(seen.points) == len(result.history)
        error[tolerance] = off(seen.accepted, seen, system)
    assert error[1e-3] > 10 * error[1e-5] > 1e-6


def test_every_part_of_the_profile_is_found():
    system, loads, _ = arrays(rack_line(50), "fric1")
    with time_spent.clocks() as spent:
        results = solve_system(system, {"A": loads})
    assert set(spent.calls) == set(time_spent.PARTS)
    assert spent.calls["numeric factorisation"] == results.work["factorise"]
    assert spent.calls["convergence story"] == results.work["iterations"]
    assert spent.calls["certificate"] == 1
    assert not spent.inside


# ------------------------------------------------------------------ processes that fail
def test_a_crash_is_a_failed_point():
    assert once({"task": "no such task"}, 30.0)["failure"] == "ends with exit code 1"


def test_a_hang_is_a_failed_point():
    child = Child({"task": "solve", "program": "status", "n": 200, "case": "fric1"}, 30.0)
    child.limit = 0.01  # it needs more than a second
    assert child.ask() == {}
    assert child.failure == "no answer in 0.01 s"
    assert child.process.poll() is not None


def test_what_has_no_friction_says_so():
    pytest.importorskip("Pynite", reason="extra peers")
    reply = once({"task": "solve", "program": "pynite", "n": 50, "case": "fric1"}, 30.0)
    assert verdict("pynite", reply) == ("cannot", "has no friction")


@pytest.mark.parametrize("case", ["lin", "gap"])
def test_opensees_is_right_where_nothing_slides(case, tmp_path):
    pytest.importorskip("openseespy", reason="extra peers")
    made = once({"task": "reference", "n": 50, "case": case, "folder": str(tmp_path)}, 30.0)
    job = {"task": "solve", "program": "opensees", "n": 50, "case": case}
    assert once({**job, "reference": made["path"]}, 30.0)["error"] < 1e-9


def test_jobs_take_turns_and_give_medians():
    job = {"task": "solve", "n": 50, "case": "lin"}
    jobs = [{**job, "program": "floor"}, {**job, "program": "newton"}]
    fast, own = side_by_side(jobs, [30.0, 30.0], 2.0, 3)
    assert fast["runs"] == own["runs"] == 3
    assert fast["fastest"] <= fast["seconds"] <= fast["slowest"]
    assert own["factorise"] == 1


def test_a_status_run_that_fails_says_so_and_gives_no_numbers():
    with accepting(1e-3):
        outcome = status(rack_line(200), "fric1")()
    assert outcome.u is None
    assert outcome.failure == "says so: a contact still opens or closes"


# ------------------------------------------------------------------ words and verdicts
@pytest.mark.parametrize(
    ("reply", "want"),
    [
        ({"failure": "No module named 'x'", "kind": "missing"}, "not installed"),
        ({"failure": "has no friction", "kind": "refused"}, "cannot"),
        ({"failure": "killed by signal 11", "kind": ""}, "fails"),
        ({"error": 1e-12}, "right"),
        ({"error": 2e-2}, "wrong"),
        ({"error": 1e300}, "wrong"),
    ],
)
def test_verdicts(reply, want):
    assert verdict("opensees", reply)[0] == want


def rows(seconds, floors, error=1e-15):
    return [
        {
            "n": n, "case": case, "program": "newton", "seconds": seconds, "floors": floors,
            "error": error, "worst": 1e-14, "peak_mb": 100.0, "verdict": "right",
        }
        for n in (1000, 5000, 100_000)
        for case in ("lin", "gap", "fric1")
    ]  # fmt: skip


def test_targets_are_computed():
    empty = {name: [] for name in tables.FILES}
    good = targets.targets({**empty, "racks": rows(1e-3, 50.0)})
    verdicts = {row["target"]: row["verdict"] for row in good}
    assert verdicts["rack_100000 `fric1`, in floors"] == "reached"
    assert verdicts["every rack: distance to the reference"] == "reached"
    assert verdicts["rack_1000000 `fric1`, certified, memory"] == "not measured"
    bad = targets.targets({**empty, "racks": rows(1.0, 240.0, 1e-3)})
    verdicts = {row["target"]: row["verdict"] for row in bad}
    assert verdicts["rack_5000 `fric1`, in floors"] == "missed, 2.00 times"
    assert verdicts["every rack: distance to the reference"].startswith("missed")
    wrong = rows(1e-3, 50.0)
    wrong[0]["verdict"] = "fails"
    verdicts = {r["target"]: r["verdict"] for r in targets.targets({**empty, "racks": wrong})}
    assert verdicts["every rack: distance to the reference"] == "missed"


def test_the_million_is_judged_by_its_own_memory():
    empty = {name: [] for name in tables.FILES}
    own = {"program": "newton", "verdict": "right", "floors": 50.0}
    million = [{**own, "n": 1000, "peak_mb": 40.0}, {**own, "n": 1_000_000, "peak_mb": 2e4}]
    found = targets.targets({**empty, "million": million})
    verdicts = {row["target"]: row["verdict"] for row in found}
    assert verdicts["rack_1000000 `fric1`, certified, memory"] == "missed, 1.22 times"
    assert verdicts["rack_1000000 `fric1`, floors over those of rack_1000"] == "reached"


def test_tables_survive_the_disk(tmp_path):
    some = [{"a": 1, "b": 0.5}, {"a": 2, "c": "x, | y"}]
    store.save(some, tmp_path / "t.csv")
    assert store.load(tmp_path / "t.csv") == some


# ------------------------------------------------------------------ what stands in the docs
def test_the_page_is_made_from_its_tables():
    assert page.render(page.DOCS, "benchmarks/") == page.PAGE.read_text(), "make bench-docs"


def test_the_numbers_of_the_readme_come_from_the_tables():
    readme = page.README.read_text()
    assert page.with_part(readme, page.readme_part(page.DOCS)) == readme, "make bench-docs"


def test_the_readme_has_a_row_for_every_size():
    part = page.README.read_text().split(page.BEGIN)[1].split(page.END)[0]
    assert [int(n.replace(" ", "")) for n in re.findall(r"^\| ([\d ]+) \|", part, re.M)] == (
        tables.sizes(tables.read(page.DOCS)["racks"])
    )
    assert len(tables.sizes(tables.read(page.DOCS)["racks"])) == 6


def test_every_picture_of_the_page_is_there():
    names = re.findall(r"\]\((benchmarks/[^)]+)\)", page.PAGE.read_text())
    assert len(names) == 11
    assert all((page.PAGE.parent / name).exists() for name in names)


def test_all_answers_of_the_docs_are_right():
    own = [row for row in tables.read(page.DOCS)["racks"] if row["program"] == "newton"]
    assert {row["verdict"] for row in own} == {"right"}
    assert max(row["error"] for row in own) < targets.LIMIT
    assert max(row["worst"] for row in own) < targets.LIMIT
