"""Struts and rests where friction has one hidden answer, three, or a continuum of them.

Design notes, section 1.4: exact solution of the foot's two freedoms with friction.  The printed
numbers hold for a rigid head; the head's penalty springs of 1e12 N/m and N m/rad move them by up
to 0.2 N, so the printed ones are met to 1e-5 and the closed form with those springs to 1e-8.
"""

from math import cos, pi, radians, sin

import numpy as np
import pytest
from published import CLOSED, Source, agrees, differs

import trunnion
from trunnion.arrays import OPEN, SLIP, STICK

THEORY = "Trunnion's theory: exact solution of the foot's two freedoms with friction (`answers` in "
STRUT = {
    "three": Source(
        CLOSED,
        "A strut that has three answers",
        "strut_three",
        THEORY + "test_struts.py). Each answer is found from a start of its own, and all three "
        "by `trunnion run --spread 8`; the test holds them to 1e-8 of the closed form on the "
        "springs of 1e12 N/m that the head has.",
    ),
    "cycle": Source(
        CLOSED,
        "A strut whose renewal runs in a circle",
        "strut_cycle",
        THEORY + "test_struts.py), which slips; plain renewal of N cycles around it between 6 091 "
        "and 103 177 N. The test holds it to 1e-8 of the closed form on the head's springs.",
    ),
}
HEAD = (
    "the print is for a rigid head; the springs of 1e12 N/m and N m/rad that hold it here move N "
    "by up to 0.2 N, and the closed form with these springs is met to 1e-8"
)
FLOATING = Source(
    CLOSED,
    "Six rests without an anchor",
    "floating_rests",
    "Statics: every rest slides, three to each side, with mu N. The axial position is undetermined "
    "by about 10 mm either way, and the run names that motion.",
)
WORDS = {OPEN: "open", SLIP: "slip", STICK: "stick"}
LENGTH, MU, K, KF = 10.0, 0.3, 1e12, 1e8
BORE = 0.2731 - 2 * 0.00927
EI = 203e9 * pi / 64 * (0.2731**4 - BORE**4)
EA = 203e9 * pi / 4 * (0.2731**2 - BORE**2)
PRINTED = {"cycle": {SLIP: 42225.8}, "three": {OPEN: 0.0, SLIP: 3625.9, STICK: 18978.9}}
LOAD = {"cycle": (20e3, -1e3), "three": (-4e3, -20e3)}


def answers(load, head=1 / K):
    """All exact answers: mode -> normal force [N], of a head with this flexibility."""
    c, s = cos(radians(80)), sin(radians(80))
    along, across = np.array([c, s]), np.array([-s, c])
    flexibility = (LENGTH / EA + head) * np.outer(along, along)
    flexibility += (LENGTH**3 / (3 * EI) + head * (1 + LENGTH**2)) * np.outer(across, across)
    strut = np.linalg.inv(flexibility)
    found = {}
    if np.linalg.solve(strut, load)[1] >= 0:
        found[OPEN] = 0.0
    u = np.linalg.solve(strut + np.diag([KF, K]), load)
    if u[1] < 0 and KF * abs(u[0]) <= MU * K * -u[1]:
        found[STICK] = -K * u[1]
    for sign in (1.0, -1.0):
        u = np.linalg.solve(strut + np.array([[0.0, -sign * MU * K], [0.0, K]]), load)
        if u[1] < 0 and sign * KF * u[0] > MU * K * -u[1]:
            found[SLIP] = -K * u[1]
    return found


def record(name, mode, normal, exact):
    """Compare with the print, which the springs of the head may be too soft to meet."""
    printed, what = PRINTED[name][mode], f"PUSH, N of the answer that is {WORDS[mode]}"
    if abs(exact - printed) <= 0.05:
        agrees(STRUT[name], what, printed, normal, "N", abs=0.05)
    else:
        differs(STRUT[name], what, printed, normal, "N", found=exact, rel=1e-8, why=HEAD)


@pytest.mark.parametrize("name", LOAD)
def test_closed_form_gives_the_printed_answers(name):
    exact = answers(LOAD[name], head=0.0)
    assert exact.keys() == PRINTED[name].keys()
    for mode, normal in PRINTED[name].items():
        assert exact[mode] == pytest.approx(normal, abs=0.05)


@pytest.mark.parametrize("name", LOAD)
def test_an_exact_answer_is_found(run, name):
    push = run(f"strut_{name}")["PUSH"]
    i = push.slider("10")
    mode, normal = int(push.state.mode[i]), push.state.normal[i]
    assert normal == pytest.approx(PRINTED[name][mode], rel=1e-5, abs=1e-3)
    assert normal == pytest.approx(answers(LOAD[name])[mode], rel=1e-8, abs=1e-3)
    if name == "cycle":
        record("cycle", mode, normal, answers(LOAD[name])[mode])


@pytest.mark.parametrize("mode", PRINTED["three"])
def test_each_of_the_three_answers_is_found_from_its_start(deck, answer, mode):
    start = trunnion.Start(np.array([MU * PRINTED["three"][mode]]))
    push = answer(trunnion.solve(deck("strut_three"), starts={"PUSH": start})["PUSH"])
    i = push.slider("10")
    assert push.state.mode[i] == mode
    exact = answers(LOAD["three"])[mode]
    assert push.state.normal[i] == pytest.approx(exact, rel=1e-8, abs=1e-3)
    record("three", mode, push.state.normal[i], exact)


def test_floating_rests_all_slide(run):
    ope = run("floating_rests")["OPE"]
    assert np.all(ope.state.mode == SLIP)
    assert ope.state.normal == pytest.approx(24357.0, rel=1e-9)
    assert np.abs(ope.state.friction[:, 0]) == pytest.approx(MU * 24357.0, rel=1e-9)
    agrees(FLOATING, "OPE, friction of a rest", 7307.1, abs(ope.state.friction[0, 0]), "N")
    assert np.sign(ope.state.friction[:, 0]).tolist() == [1, 1, 1, -1, -1, -1]


def test_floating_rests_names_the_undetermined_motion(run):
    warnings = run("floating_rests").results["OPE"].warnings
    assert "undetermined: line 10-60 moves along X" in warnings
