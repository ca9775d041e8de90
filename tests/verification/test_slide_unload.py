"""Stop with friction, loaded and unloaded: Code_Aster SSND116a, analytic values.

github ehmoussi/code_aster, commit 34161d7; numbers only.  Within 1e-6 (the print has up to
seven digits, the last of 1.7416666 cut, not rounded).
"""

import pytest
from published import PUBLISHED, Source, agrees

SSND116A = Source(
    PUBLISHED,
    "A stop with friction, Code_Aster SSND116a",
    "slide_unload",
    "Analytic values of the Code_Aster test base, github ehmoussi/code_aster commit 34161d7: load, "
    "slip, unload and slip back. Within 1e-6, for the last digit of 1.7416666 is cut, not rounded.",
)
UX, UY = 0, 1
PRINTED = [
    ("T050", UX, -0.50),
    ("T100", UX, -0.75),
    ("T105", UY, 0.1333333),
    ("T150", UY, 1.875),
    ("T155", UY, 1.7416666),
    ("T200", UX, -0.75),
    ("T200", UY, 0.125),
]


@pytest.mark.parametrize(("case", "component", "printed"), PRINTED)
def test_movement(run, case, component, printed):
    ours = run("slide_unload")[case].u("1")[component]
    agrees(SSND116A, f"{case}, {['UX', 'UY'][component]}", printed, ours, "m", abs=1e-6)


def test_modes_are_stick_slip_stick_slip(run):
    from trunnion.arrays import SLIP, STICK

    modes = {}
    for case in ("T105", "T150", "T155", "T200"):
        solved = run("slide_unload")[case]
        modes[case] = int(solved.state.mode[solved.slider("1")])
    assert modes == {"T105": STICK, "T150": SLIP, "T155": STICK, "T200": SLIP}


def test_friction_turns_round(run):
    # capacity mu N = 0.5 * 0.25
    up = run("slide_unload")["T150"]
    back = run("slide_unload")["T200"]
    assert up.state.friction[up.slider("1")][1] == pytest.approx(-0.125, abs=1e-12)
    assert back.state.friction[back.slider("1")][1] == pytest.approx(0.125, abs=1e-12)
