"""Hovgaard's pipe in space: Code_Aster SSLL101, tables STAT1, STAT2, STAT3.

github ehmoussi/code_aster, commit 34161d7; numbers only.  Within 0.3 % (an independent rebuild
with 40 chords per 45 degrees: 0.1 %); a component printed 0 within 0.3 % of the largest.

Two small numbers of STAT1 are outside: the thrust 10.095 N (ours 10.061) and the torque 15.6 N m
at T15 (ours 15.653), 0.33 % each, beside forces of 2276 N.  STAT2, the same weight as nodal
forces, agrees with the print to the last digit, so stiffness is not the cause; lumping the
bends' weight at their ends would give 9.69 N and 11.39 N m.  Not explained.
"""

import numpy as np
import pytest
from published import PUBLISHED, Source, agrees, differs

HOVGAARD = Source(
    PUBLISHED,
    "Hovgaard's pipe, Code_Aster SSLL101",
    "hovgaard",
    "Tables STAT1 (GRAV, weight), STAT2 (LUMP, the weight as nodal forces) and STAT3 (HEAT) of the "
    "Code_Aster test base, github ehmoussi/code_aster commit 34161d7. Within 0.3 % (an independent "
    "rebuild with 40 chords in 45 degrees: 0.1 %), a component that is printed 0 within 0.3 % of "
    "the largest. Nodes by their names in the source.",
)
WHY = (
    "0.33 %, beside forces of 2276 N. LUMP, the same weight as nodal forces, agrees to the last "
    "digit, so stiffness is not the cause; lumping the bends' weight at their ends would give "
    "9.69 N and 11.39 N m. Not explained"
)
NODE = {"T3": "4N", "T5": "4F", "T7": "7", "T9": "10N", "T11": "10F"}
MOVES = {
    "GRAV": {
        "T3": (-0.0001658, -2.04e-05, -8.01e-06),
        "T5": (-0.0002397, 0.0001777, -0.0002681),
        "T7": (-0.0001855, 0.0001775, -0.000394),
        "T9": (-0.0001278, 0.0001774, -0.0004977),
        "T11": (0.0, 5.682e-05, -0.0002207),
    },
    "LUMP": {
        "T3": (-0.0001651, -2.08e-05, -9.516e-06),
        "T5": (-0.0002386, 0.0001773, -0.0002697),
        "T7": (-0.0001848, 0.0001771, -0.0003948),
        "T9": (-0.0001274, 0.000177, -0.0004964),
        "T11": (0.0, 5.674e-05, -0.0002186),
    },
    "HEAT": {
        "T3": (-0.0061418, -0.01309, 0.016799),
        "T5": (-0.010302, -0.008132, 0.019723),
        "T7": (-0.01137, -0.005383, 0.016135),
        "T9": (-0.012238, -0.002633, 0.012262),
        "T11": (-0.006308, 0.001542, 0.001931),
    },
}
# N VY VZ MT MFY MFZ of the print, by size; T1 lies along z with its local z along -x
FORCES = {
    "GRAV": {
        "1": (10.095, 161.1, 2276, 158.5, 89.66, 53.4),
        "15": (10.095, 161.1, 1165, 15.6, 1260.5, 290.1),
    },
    "LUMP": {
        "1": (9.81, 161.1, 2273, 158.63, 89.53, 53.02),
        "15": (9.81, 161.1, 1168, 11.9, 1261, 289.7),
    },
    "HEAT": {
        "1": (2791, 7613, 7431, 14712, 6193, 1615),
        "15": (2791, 7613, 7433, 7052, 10460, 8862),
    },
}
PARTS = ("N", "VY", "VZ", "MT", "MFY", "MFZ")
OURS = {("GRAV", "1", 0): 10.061, ("GRAV", "15", 0): 10.061, ("GRAV", "15", 3): 15.653}


@pytest.mark.parametrize("case", MOVES)
@pytest.mark.parametrize("node", NODE)
def test_movements(run, case, node):
    printed = np.array(MOVES[case][node])
    u = run("hovgaard")[case].u(NODE[node])[:3]
    for name, number, ours in zip("XYZ", printed.tolist(), u, strict=True):
        zero = 0.003 * np.abs(printed).max()
        within = {"rel": 0.003} if number else {"abs": zero}
        agrees(HOVGAARD, f"{case}, {node} U{name}", number, ours, "m", **within)


@pytest.mark.parametrize("component", range(6))
@pytest.mark.parametrize("node", ["1", "15"])
@pytest.mark.parametrize("case", FORCES)
def test_end_forces(run, case, node, component):
    force = abs(run("hovgaard")[case].support(node)[component])
    what = f"{case}, T{node} {PARTS[component]}"
    printed, unit = FORCES[case][node][component], "N" if component < 3 else "N m"
    if (case, node, component) in OURS:
        found = OURS[case, node, component]
        differs(HOVGAARD, what, printed, force, unit, found=found, abs=5e-4, why=WHY)
    else:
        agrees(HOVGAARD, what, printed, force, unit, rel=0.003)


def test_default_flexibility_is_the_prints_reduced_inertia(run):
    case = run("hovgaard")["GRAV"]
    bend = int(np.flatnonzero(case.system.radius)[0])
    assert case.system.flex[bend] == pytest.approx(1.377e-5 / 5.887e-6, rel=1e-4)
