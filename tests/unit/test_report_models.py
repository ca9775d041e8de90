"""Reports of a real line: bends, hanger, gaps, friction, combinations."""

import json
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.arrays import BOTH, ENGAGED, OPEN, SLIP, STICK, State
from trunnion.certificate import certify
from trunnion.loads import case_loads
from trunnion.report.json import json_report
from trunnion.report.text import text_report
from trunnion.system import build_system

DECK = Path(__file__).parents[2] / "models" / "hot_header.inp"


@pytest.fixture(scope="module")
def line():
    """Model, system and the JSON of the run."""
    model = trunnion.read(DECK)
    results = trunnion.solve(model)
    return model, build_system(model), results, json.loads(json_report(results))


def state_of(case: dict, system) -> State:
    """Read the numbers of a case back from its JSON."""
    mode = {"open": OPEN, "engaged": ENGAGED, "stick": STICK, "slip": SLIP}
    zero = [0.0] * 6
    low = case.get("nodes_low", {})
    contacts = [c for s in case["supports"] for c in s["contacts"]]
    sliders = [(s["contacts"][x["contacts"][0]], x) for s in case["supports"] for x in s["sliders"]]
    side = [BOTH if c["side"] == 0 and c["state"] != "open" else c["side"] for c in contacts]
    elements = case["elements"]
    return State(
        u=np.array([case["nodes"][label] for label in system.labels]),
        u_low=np.array([low.get(label, zero) for label in system.labels]),
        end_force=np.array([[e["force_from"], e["force_to"]] for e in elements]),
        side=np.array(side, np.int32),
        reaction=np.array([c["vector"] for c in contacts]),
        friction=np.array([c["friction"] for c, _ in sliders]).reshape(-1, 3),
        mode=np.array([mode[x["state"]] for _, x in sliders], np.int32),
        normal=np.array([c["normal"] for c, _ in sliders]),
        slide=np.array([c["slide"] for c, _ in sliders]).reshape(-1, 3),
        datum=np.array([x["datum"] for _, x in sliders]).reshape(-1, 3),
        datum_end=np.array([x["datum_end"] for _, x in sliders]).reshape(-1, 3),
    )


def test_the_certificate_can_be_judged_again_from_the_file(line):
    model, system, _, report = line
    for case in model.cases:
        found = report["cases"][case.name]
        if found["kind"] == "comb":
            continue
        loads, state = case_loads(model, system, case), state_of(found, system)
        again = certify(system, loads, state, correction_u=0.0, correction_r=0.0)
        assert again.passed, (case.name, again.where)
        items = {item.name: item.value for item in again.items}
        assert items["equilibrium"] == found["certificate"]["equilibrium"]
        state.end_force[3, 1, 1] *= 1.0 + 1e-6
        wrong = certify(system, loads, state, correction_u=0.0, correction_r=0.0)
        assert not wrong.passed


def test_every_label_a_user_may_write_has_its_displacement(line):
    nodes = line[3]["cases"]["OPE"]["nodes"]
    for bend in ("40", "50", "180"):
        assert {bend, f"{bend}N", f"{bend}M", f"{bend}F"} <= set(nodes)
        assert nodes[bend] == nodes[f"{bend}F"]


def test_support_forces_are_the_balance_of_the_elements(line):
    for case in line[3]["cases"].values():
        for support in case["supports"]:
            at = {support["node"]}
            joined = [
                e[f"force_{side}"]
                for e in case["elements"]
                for side in ("from", "to")
                if e[side] in at
            ]
            both = support["force"] + support["moment"]
            if joined and sum(s["node"] == support["node"] for s in case["supports"]) == 1:
                assert np.sum(joined, axis=0) == pytest.approx(both, abs=1e-6)


def test_local_forces_have_the_size_of_the_global_ones(line):
    for element in line[3]["cases"]["OPE"]["elements"]:
        for side in ("from", "to"):
            a, b = element[f"force_{side}"], element[f"local_{side}"]
            assert np.linalg.norm(a[:3]) == pytest.approx(np.linalg.norm(b[:3]), rel=1e-12)
            assert np.linalg.norm(a[3:]) == pytest.approx(np.linalg.norm(b[3:]), rel=1e-12)


def test_card_force_is_normal_and_friction(line):
    for support in line[3]["cases"]["OPE"]["supports"]:
        push = np.subtract(support["force"], support["friction"])
        assert np.linalg.norm(push) == pytest.approx(support["normal"], rel=1e-12, abs=1e-9)
        if support["state"] == "slip":
            limit = sum(c["mu"] * c["normal"] for c in support["contacts"] if c["state"] == "slip")
            assert np.linalg.norm(support["friction"]) <= limit * (1 + 1e-12)


def test_the_text_fits_the_page(line):
    model, _, results, _ = line
    lines = text_report(results, model).decode().splitlines()
    assert max(map(len, lines)) <= 132
    assert not [text for text in lines if "nan" in text.split() or "inf" in text.split()]
