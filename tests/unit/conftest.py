"""A scene whose whole answer is known: a weightless cantilever of two pipes on a rest that slides.

Anchor 10 at the origin, rest +Y (mu 0.3) and the loads FY = -P, FZ = Q at the tip 30, 6 m away.
Every contact is a spring k, so the numbers below are the answer to round-off:
the tip's flexibility is c = L3/3EI + 1/k + L2/k, the rest takes N with (P - N) c = N/k and
slides, friction mu N against Q.
"""

import numpy as np
import pytest

from trunnion.arrays import (
    BOTH,
    MINUS,
    OPEN,
    SLIP,
    CaseResult,
    Certificate,
    Item,
    Loads,
    Results,
    State,
)

P, Q, L, K, KF, MU = 9000.0, 4000.0, 6.0, 1e12, 1e8, 0.3

DECK = """\
TITLE    Cantilever on a rest that slides
UNITS    mm kN bar C
DEFAULT  MU=0.3 SHEAR=OFF
MATERIAL STEEL  E=200GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P10    OD=273 WALL=9.3
OPERATE  T1=170 P1=12 TREF=20
ANCHOR   10
PIPE     10 20  DX=3000
PIPE     20 30  DX=3000
SUPPORT  30     +Y GUIDE GAP=50
FORCE    30 F1  FY=-9 FZ=4
CASE OPE = F1
CASE OFF = F1 + T1
COMB TWO = 2*OPE
"""


@pytest.fixture
def deck() -> str:
    return DECK


@pytest.fixture
def model():
    from trunnion.deck.reader import read_text

    return read_text(DECK, "cantilever.inp")


@pytest.fixture
def scene(model):
    """Model, system, loads, and the State of case OPE."""
    from trunnion.system import build_system

    system = build_system(model)
    ei = float(system.rigidity[0, 2])
    c = L**3 / (3 * ei) + 1 / K + L**2 / K
    n = P * c / (c + 1 / K)
    fy, fz = n - P, Q - MU * n  # on the tip

    x = system.xyz[:, 0]
    u = np.zeros((3, 6))
    u[:, 1] = fy * (x**2 * (3 * L - x) / (6 * ei) + 1 / K + L * x / K)
    u[:, 5] = fy * (x * (2 * L - x) / (2 * ei) + L / K)
    u[:, 2] = fz * (x**2 * (3 * L - x) / (6 * ei) + 1 / K + L * x / K)
    u[:, 4] = -fz * (x * (2 * L - x) / (2 * ei) + L / K)

    moment = np.array([np.zeros(3), fz * (x - L), fy * (L - x)]).T  # of the tip's force at x
    end = np.zeros((2, 2, 6))
    end[:, 1, 1:3], end[:, 0, 1:3] = (fy, fz), (-fy, -fz)
    end[:, 1, 3:], end[:, 0, 3:] = moment[1:], -moment[:-1]

    contacts, sliders = system.contacts, system.sliders
    side = np.full(len(contacts.node), BOTH, np.int32)
    rest, guide = contacts.word.index("+Y"), contacts.word.index("GUIDE")
    side[rest], side[guide] = MINUS, OPEN
    reaction = np.zeros((len(side), 3))
    for i, word in enumerate(contacts.word[:6]):
        axis = "XYZ".index(word[-1])
        reaction[i, axis] = (end[0, 0, 3:] if word[0] == "R" else end[0, 0, :3])[axis]
    reaction[rest, 1] = n
    mode = np.array([SLIP if c == rest else OPEN for c in sliders.contact], np.int32)
    slips = (mode == SLIP)[:, None]
    slide = np.einsum("sij,sik,k->sj", sliders.basis, sliders.basis, u[2, :3])
    friction = np.where(slips, (0.0, 0.0, -MU * n), 0.0)
    normal = np.where(mode == SLIP, n, 0.0)
    datum_end = np.where(slips, slide + friction / KF, slide)
    state = State(
        u, np.zeros_like(u), end, side, reaction, friction, mode, normal, slide,
        np.zeros_like(slide), datum_end,
    )  # fmt: skip
    nodal = np.zeros((3, 6))
    nodal[2, 1:3] = -P, Q
    loads = Loads(
        np.zeros((2, 3)), np.zeros(2), np.zeros(2), nodal, np.zeros((2, 6)), np.zeros(2),
        np.zeros(2),
    )  # fmt: skip
    return model, system, loads, state


@pytest.fixture
def results(scene):
    """One solved case, one that did not converge, one combination."""
    from trunnion.results.combine import combine

    model, system, loads, state = scene
    good = Certificate(True, 2e-15, "friction at rest 30", (Item("friction", 2e-15, "rest 30"),))
    bad = Certificate(False, float("inf"), "finite", (Item("finite", float("inf"), "node 30"),))
    history = [
        {"iteration": 1, "change": 0.5, "changed": ["30 +Y GUIDE"]},
        {"iteration": 2, "change": 1e-12, "changed": []},
    ]
    ope = CaseResult(
        "OPE", "case", "F1", system, loads, state, True, certificate=good,
        penalty_effect={"u": 1e-7, "R": 2e-7}, history=history,
        work={"analyse": 1, "factorise": 3, "solve": 9}, warnings=("30 GUIDE is close",),
    )  # fmt: skip
    off = CaseResult(
        "OFF", "case", "F1 + T1", system, loads, state, False, cause="friction cycles at 30 +Y",
        certificate=bad, history=history, work={"solve": 400},
    )  # fmt: skip
    two = combine(model.cases[2], {"OPE": ope})
    return Results("Cantilever on a rest that slides", {"OPE": ope, "OFF": off, "TWO": two})
