"""The JSON keeps its schema, its signs and its digits."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from trunnion.arrays import Results
from trunnion.report.json import json_report
from trunnion.results.balance import end_axes, local_forces

P, Q, MU = 9000.0, 4000.0, 0.3


@pytest.fixture
def report(results):
    return json.loads(json_report(results))


def test_the_scene_of_these_tests_is_a_certified_answer(scene):
    from trunnion.certificate import certify

    _, system, loads, state = scene
    assert certify(system, loads, state, correction_u=0.0, correction_r=0.0).passed


def test_top_level_follows_the_schema(report):
    assert report["schema"] == 1
    assert list(report["cases"]) == ["OPE", "OFF", "TWO"]
    assert report["warnings"] == []


def test_a_case_that_did_not_converge_has_a_cause_and_no_numbers(report):
    case = report["cases"]["OFF"]
    assert case["converged"] is False
    assert case["cause"] == "friction cycles at 30 +Y"
    assert not {"nodes", "supports", "elements", "stresses", "penalty_effect"} & set(case)
    assert case["certificate"]["worst"] is None  # infinite


@pytest.mark.parametrize("passed", [False, None])
def test_a_case_without_passed_certificate_shows_no_numbers(results, passed):
    case = results["OPE"]
    case.certificate = None if passed is None else replace(case.certificate, passed=False)
    found = json.loads(json_report(results))["cases"]["OPE"]
    assert found["converged"] is False
    assert found["cause"]
    assert "nodes" not in found


def test_rest_pushes_the_pipe_up_and_friction_holds_it_back(report):
    anchor, rest = report["cases"]["OPE"]["supports"]
    assert rest["id"] == rest["node"] == "30"
    assert rest["name"] == "30 +Y GUIDE"
    assert (rest["line"], rest["cnode"], rest["state"]) == (10, None, "slip")
    assert rest["force"] == pytest.approx([0, P, -MU * P], rel=1e-6)
    assert rest["normal"] == pytest.approx(P, rel=1e-6)
    assert rest["friction"] == pytest.approx([0, 0, -MU * P], rel=1e-6)
    resting, guide = rest["contacts"]
    assert (resting["dir"], resting["side"], resting["state"]) == ("+Y", -1, "slip")
    assert resting["reaction"] == pytest.approx(P, rel=1e-6)
    assert resting["mu"] == MU
    assert resting["slide"][2] == pytest.approx(0.00697969, rel=1e-6)
    assert (guide["dir"], guide["side"], guide["state"]) == ("GUIDE", 0, "open")
    assert guide["normal"] == 0.0
    assert (anchor["state"], len(anchor["contacts"])) == ("engaged", 6)
    assert anchor["force"] == pytest.approx([0, 0, -(Q - MU * P)], rel=1e-6, abs=0.01)
    assert anchor["moment"] == pytest.approx([0, 6 * (Q - MU * P), 0], rel=1e-6, abs=0.02)


def test_a_combination_has_forces_but_no_state(report):
    rest = report["cases"]["TWO"]["supports"][1]
    assert rest["state"] is None
    assert rest["contacts"] == []
    assert rest["force"] == pytest.approx([0, 2 * P, -2 * MU * P], rel=1e-6)
    assert report["cases"]["TWO"]["certificate"]["inherited"] is True


def test_reactions_balance_loads(report):
    case = report["cases"]["OPE"]
    for half in ("force", "moment"):
        assert np.add(case["loads"][half], case["reactions"][half]) == pytest.approx(0, abs=1e-8)


def test_numbers_keep_all_their_digits(report, scene):
    state = scene[3]
    nodes = np.array([report["cases"]["OPE"]["nodes"][label] for label in ("10", "20", "30")])
    assert np.array_equal(nodes, state.u)
    element = report["cases"]["OPE"]["elements"][1]
    assert np.array_equal(element["force_to"], state.end_force[1, 1])


def test_low_parts_stand_beside_the_nodes_where_there_are_any(results):
    assert b"nodes_low" not in json_report(results)
    results["OPE"].state.u_low[1, 2] = 1e-20
    found = json.loads(json_report(results))["cases"]["OPE"]
    assert found["nodes_low"]["20"] == [0, 0, 1e-20, 0, 0, 0]


def test_nan_is_refused_not_written(results):
    results["OPE"].state.u[0, 0] = np.nan
    with pytest.raises(ValueError, match="JSON"):
        json_report(results)


def test_same_results_give_the_same_bytes(results):
    assert json_report(results) == json_report(results)


def test_support_ids_stay_apart_on_one_node(results, scene):
    system = scene[1]
    again = replace(system, cards=tuple(replace(card, label="30") for card in system.cards))
    case = replace(results["OPE"], system=again)
    found = json.loads(json_report(Results("", {"OPE": case})))
    assert [s["id"] for s in found["cases"]["OPE"]["supports"]] == ["30", "30#2"]


BENT = """\
UNITS m N Pa C
MATERIAL S E=2e11
SECTION P OD=0.2 WALL=0.01
ANCHOR 10
PIPE 10 20 DX=2
BEND 20 R=0.3
PIPE 20 30 DZ=2
CASE A = W
"""


def test_local_axes_turn_with_the_bend():
    from trunnion.deck.reader import read_text
    from trunnion.system import build_system

    system = build_system(read_text(BENT, "bent.inp"))
    bend = next(i for i, part in enumerate(system.parts) if part.type == "bend")
    axes = end_axes(system)[bend]
    assert axes[0, 0] == pytest.approx([1, 0, 0], abs=1e-12)
    assert axes[1, 0] == pytest.approx([0, 0, 1], abs=1e-12)
    force = np.zeros((3, 2, 6))
    force[bend, :] = 0, 0, 5, 1, 0, 0
    local = local_forces(system, force)[bend]
    assert local[1] == pytest.approx([5, 0, 0, 0, -1, 0], abs=1e-12)
    assert local[0] == pytest.approx([0, 5, 0, 1, 0, 0], abs=1e-12)


def test_every_key_of_the_file_is_documented(report):
    text = (Path(__file__).parents[2] / "docs" / "json_layout.md").read_text()
    known = {word for quoted in re.findall(r"`([^`]+)`", text) for word in quoted.split(".")}
    case = report["cases"]["OPE"]
    support = case["supports"][1]
    found = {*report, *case, *support, *support["contacts"][0], *support["sliders"][0]}
    found |= set(case["elements"][0])
    assert found - known == set()
