"""models/components.inp: Roark's tapered beam, springs in series; the numbers on its top."""

from pathlib import Path

import pytest

import trunnion

DECK = Path(__file__).parents[2] / "models" / "components.inp"


@pytest.fixture(scope="module")
def results():
    found = trunnion.solve(trunnion.read(DECK))
    assert all(case.converged and case.certificate.passed for case in found.cases.values())
    return found


def test_cone_sags_and_stretches(results):
    u = results["CONE"].displacements["2"]
    assert 1e3 * u["uy"] == pytest.approx(-0.7163, abs=0.00005)
    assert 1e3 * u["ux"] == pytest.approx(0.011987, abs=0.0000005)


def test_anchors_hold_the_thrust(results):
    for node, sign in (("11", 1), ("16", -1)):
        force = results["JOINT"].supports[node]["fx"]
        assert sign * force / 1e3 == pytest.approx(61.964, abs=0.0005)


def test_pipe_cut_short_pulls(results):
    assert results["CUT"].supports["22"]["fx"] / 1e3 == pytest.approx(614.29, abs=0.005)


def test_everything_together_is_the_sum_of_its_parts(results):
    parts = sum(results[name].supports["11"]["fx"] for name in ("CONE", "JOINT", "CUT"))
    assert results["ALL"].supports["11"]["fx"] == pytest.approx(parts, rel=1e-9)
