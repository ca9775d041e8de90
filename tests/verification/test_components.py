"""models/components.inp: Roark's tapered beam, springs in series; the numbers on its top."""

from pathlib import Path

import pytest
from published import CLOSED, Source, agrees

import trunnion

PARTS = Source(
    CLOSED,
    "A cone, an expansion joint and a pipe cut short",
    "components",
    "Roark's Formulas for Stress and Strain, tapered beams: deflection 64 P L3 / (3 pi E D1^3 D2), "
    "stretch 4 N L / (pi E D1 D2); the rest by springs in series. Anchors of 1e12 N/m included.",
)
DECK = Path(__file__).parents[2] / "models" / "components.inp"


@pytest.fixture(scope="module")
def results():
    found = trunnion.solve(trunnion.read(DECK))
    assert all(case.converged and case.certificate.passed for case in found.cases.values())
    return found


def test_cone_sags_and_stretches(results):
    u = results["CONE"].displacements["2"]
    agrees(PARTS, "CONE, 2 UY", -0.7163, 1e3 * u["uy"], "mm")
    agrees(PARTS, "CONE, 2 UX", 0.011987, 1e3 * u["ux"], "mm")


def test_anchors_hold_the_thrust(results):
    for node, sign in (("11", 1), ("16", -1)):
        force = results["JOINT"].supports[node]["fx"]
        agrees(PARTS, f"JOINT, anchor {node}", 61.964, sign * force / 1e3, "kN")


def test_pipe_cut_short_pulls(results):
    agrees(PARTS, "CUT, pull", 614.29, results["CUT"].supports["22"]["fx"] / 1e3, "kN")


def test_everything_together_is_the_sum_of_its_parts(results):
    parts = sum(results[name].supports["11"]["fx"] for name in ("CONE", "JOINT", "CUT"))
    assert results["ALL"].supports["11"]["fx"] == pytest.approx(parts, rel=1e-9)
