"""Kernels and small pieces of the solver against closed forms and dense arithmetic."""

from dataclasses import replace
from math import cos, pi, sin

import numpy as np
import pytest

import trunnion
from trunnion import kernels
from trunnion.arrays import ARC, BOTH, MINUS, OPEN, PLUS, SLIP, STICK
from trunnion.deck.reader import read_text
from trunnion.solver.convergence import judge, remaining_change
from trunnion.solver.coupled import gmres
from trunnion.solver.ledger import Ledger
from trunnion.solver.quantities import Point, Response, Sliding
from trunnion.solver.structure import Structure
from trunnion.system import build_system

HEAD = """\
DEFAULT  SHEAR=OFF
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
"""


def solve(deck):
    case = trunnion.solve(read_text(HEAD + deck + "CASE A = F1\n", "deck.inp"))["A"]
    assert case.certificate.passed
    return case


def structure(deck):
    return Structure(build_system(read_text(HEAD + deck + "CASE A = F1\n", "deck.inp")), Ledger())


# --- elements


def test_quarter_bend_flexibility():
    """Castigliano on a quarter circle; x along the first tangent, y to the centre."""
    r, ea, gj, ei, gas, k = 1.3, 1.1e9, 2.3e7, 3.1e7, 4.0e8, 7.5
    f = kernels.tip_flexibility(
        np.array([ARC], np.int32), np.array([[r * pi / 2, r, pi / 2, 0.0, 0.0, 0.0, 0.0, 0.0]]),
        np.array([[ea, gj, ei, gas]]), np.array([k]),
    )[0]  # fmt: skip
    b = k * r**3 / ei
    want = {
        (0, 0): pi / 4 * (b + r / ea + r / gas),
        (1, 1): (3 * pi / 4 - 2) * b + pi / 4 * (r / ea + r / gas),
        (0, 1): -b / 2 + r / (2 * ea) - r / (2 * gas),
        (5, 5): k * r / ei * pi / 2,
        (0, 5): -k * r**2 / ei,  # int -R cos t R dt
        (1, 5): k * r**2 / ei * (pi / 2 - 1),
        (2, 2): (3 * pi / 4 - 2) * r**3 / gj + pi / 4 * b + pi / 2 * r / gas,
        (3, 3): pi / 4 * (r / gj + k * r / ei),
        (4, 4): pi / 4 * (r / gj + k * r / ei),
        (3, 4): 0.5 * (r / gj - k * r / ei),
        (2, 3): r**2 * (1 / 2) / gj + k * r**2 / ei * 0.5,
    }
    want[2, 3] = r**2 / gj * 0.5 + k * r**2 / ei * 0.5
    for (i, j), value in want.items():
        assert f[i, j] == pytest.approx(value, rel=1e-12), (i, j)
        assert f[j, i] == pytest.approx(value, rel=1e-12), (j, i)


def test_weight_on_a_bend_is_the_limit_of_many_straights():
    """Inscribed polygons of n straights: their error falls by four when n doubles."""
    bend = "NODE 10 X=0 Y=0 Z=0\nPIPE 10 20 DX=2\nPIPE 20 30 DZ=2\nBEND 20 R=1.5 K=1\nANCHOR 10\n"
    text = HEAD + "{}CASE A = W\n"
    exact = trunnion.solve(read_text(text.format(bend), "bend.inp"))["A"].state
    exact = exact.u[exact.u[:, 1].argmin()]
    errors = []
    for n in (8, 16, 32):
        angle = np.linspace(0.0, pi / 2, n + 1)
        xyz = np.column_stack((1.5 * np.sin(angle), 1.5 * (1 - np.cos(angle))))
        xyz[:, 0] += 0.5
        nodes = [f"NODE N{i}X X={x!r} Y=0 Z={z!r}\n" for i, (x, z) in enumerate(xyz.tolist())]
        pipes = [f"PIPE N{i}X N{i + 1}X\n" for i in range(n)]
        line = "NODE 10 X=0 Y=0 Z=0\n" + "".join(nodes) + "PIPE 10 N0X\n" + "".join(pipes)
        line += f"PIPE N{n}X 30 DZ=0.5\nANCHOR 10\n"
        u = trunnion.solve(read_text(text.format(line), "line.inp"))["A"].state
        errors.append(np.abs(u.u[u.u[:, 1].argmin()] - exact)[[1, 3, 5]])
    first, second = errors[0] / errors[1], errors[1] / errors[2]
    assert np.allclose(first, 4.0, rtol=0.05)
    assert np.allclose(second, 4.0, rtol=0.02)


def test_springs_act_at_mid_distance():
    """F at the far end: F/ky there, and F d/2 turns krz about the middle."""
    d, ky, krz, force = 0.8, 2e5, 3e5, 700.0
    deck = (
        "NODE 10 X=0 Y=0 Z=0\nNODE 20 X=0.8 Y=0 Z=0\nANCHOR 10\n"
        f"SPRING 10 20 KX=1e6 KY={ky} KZ=1e6 KRX=1e6 KRY=1e6 KRZ={krz}\n"
    )
    u = solve(deck + f"FORCE 20 F1 FY={force}\n").state.u[1]
    rigid = force / 1e12 + force * d**2 / 1e12  # anchor
    assert u[1] == pytest.approx(force / ky + force * d**2 / 4 / krz + rigid, rel=1e-9)
    assert u[5] == pytest.approx(force * d / 2 / krz + force * d / 1e12, rel=1e-9)
    turned = solve(deck + f"FORCE 20 F1 MZ={force}\n").state.u[1]
    assert turned[1] == pytest.approx(u[5], rel=1e-9)  # Maxwell


# --- contacts


@pytest.mark.parametrize(("push", "closed"), [(400.0, False), (4000.0, True)])
def test_round_guide_with_a_gap(push, closed):
    """A cantilever upright in a round gap: N = (P c - g)/(c + 1/k), along the push."""
    length, gap, k = 5.0, 0.01, 1e12
    a, b = push * cos(0.7), push * sin(0.7)
    case = solve(
        f"PIPE 10 20 DY={length}\nANCHOR 10\nSUPPORT 20 GUIDE GAP={gap}\n"
        f"FORCE 20 F1 FX={a!r} FZ={b!r}\n"
    )
    c = length**3 / (3 * case.system.rigidity[0, 2]) + 1 / k + length**2 / k
    n = max(0.0, (push * c - gap) / (c + 1 / k))
    i = case.system.contacts.word.index("GUIDE")
    assert case.state.side[i] == (BOTH if closed else OPEN)
    reaction = -n * np.array([cos(0.7), 0.0, sin(0.7)])
    assert case.state.reaction[i] == pytest.approx(reaction, rel=1e-9, abs=1e-9)
    travel = np.hypot(*case.state.u[1, [0, 2]])
    assert travel == pytest.approx(gap + n / k if closed else push * c, rel=1e-9)


RESTS = (
    "PIPE 10 20 DX=3\nPIPE 20 30 DX=3\nPIPE 30 40 DZ=3\nANCHOR 10\n"
    "SUPPORT 20 +Y K=1e6 MU=0.3\nSUPPORT 30 Y Z MU=0.2 K=2e6 FRICTION=RESULTANT\n"
    "SUPPORT 40 -(0.2,-1,0.3) GAP=0.001 K=1e6 MU=0.4 KF=1e7 CNODE=20\n"
    "SUPPORT 20 (1,1,1) GAP=0.002,0.004 K=3e6\nFORCE 20 F1 FX=1\n"
)


def rests(seed):
    """A structure whose contacts press and slide, at a random point; closed as that has it."""
    built = structure(RESTS)
    rng = np.random.default_rng(seed)
    u = rng.normal(size=(built.n_node, 6)) * 0.01
    u[:, 1] -= 0.02
    n = len(built.sliders.mu)
    datum = np.einsum("sai,saj,sj->si", built.sliders.basis, built.sliders.basis,
                      rng.normal(size=(n, 3)) * 1e-3)  # fmt: skip
    law = Sliding(np.zeros(n), built.sliders.kf, built.sliders.mu, datum, coupled=True)
    return built, Point(u, np.zeros_like(u)), law, rng


@pytest.mark.parametrize("slip", [False, True])
@pytest.mark.parametrize("i", [0, 1, 2])
def test_sliders_stick_to_their_capacity_and_return_radially(i, slip):
    """On a plane (0, 2) and on a line (1, the resultant of two directions)."""
    built, point, law, _ = rests(3)
    s = built.sliders
    assert (np.abs(s.basis[i, 1]).max() == 0.0) == (i == 1)
    response = built.respond(point, law, built.still, np.zeros_like(point.u))
    plane = np.einsum("ai,aj->ij", s.basis[i], s.basis[i])
    w = point.u[s.node[i], :3] - (point.u[s.cnode[i], :3] if s.cnode[i] >= 0 else 0.0)
    travel = plane @ w - law.datum[i]
    size = s.kf[i] * np.linalg.norm(travel)
    capacity = np.full(3, size * (0.7 if slip else 1.3))
    fixed = replace(law, capacity=capacity, coupled=False)
    response = built.respond(point, fixed, built.still, np.zeros_like(point.u))
    assert response.slide[i] == pytest.approx(travel, rel=1e-12, abs=1e-15)
    assert response.mode[i] == (SLIP if slip else STICK)
    want = -travel * s.kf[i] * (0.7 if slip else 1.0)
    assert response.friction[i] == pytest.approx(want, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_tangents_and_coupling_are_the_derivative_of_the_forces(seed):
    built, point, law, rng = rests(seed)
    response = built.respond(point, law, built.still, np.zeros_like(point.u))
    assert (response.mode == SLIP).any()
    p = rng.normal(size=point.u.shape)
    h = 1e-8
    forces = []
    for step in (h, -h):
        moved = Point(point.u + step * p, np.zeros_like(point.u))
        r = np.zeros_like(p)
        built.respond(moved, law, built.still, r, changing=True)
        forces.append(r)
    slope = (forces[0] - forces[1]) / (2 * h)
    want = built.coupling(response, law, p)[0]
    built.changing_product(response, p, want)
    assert np.abs(slope - want).max() <= 1e-6 * np.abs(want).max()


@pytest.mark.parametrize("seed", range(6))
def test_line_search_finds_the_least_energy(seed):
    """The slope of the energy, force times direction, vanishes at the step it gives."""
    built, point, law, rng = rests(seed)
    fixed = replace(law, capacity=rng.uniform(0, 3e4, 3), coupled=False)
    load = replace(built.still, nodal=rng.normal(size=point.u.shape) * 1e4)

    def slope(s):
        moved = Point(point.u + s * p, np.zeros_like(p))
        return -float(np.vdot(built.residual(moved, fixed, load)[0], p))

    r, _, response = built.residual(point, fixed, load)
    assert built.factorise(response.tangent, response.slider_tangent)
    p = built.solve(r)
    push = float(np.vdot(r, p))
    step = built.search(point, fixed, load, p, (push, push))
    assert slope(0.0) < 0.0 < step
    assert abs(slope(step)) <= 0.11 * abs(slope(0.0))
    assert slope(8.0 * step) > 0.0


def test_sides_of_contacts_follow_their_gaps():
    built, point, law, _ = rests(0)
    i = list(built.contacts.word).index("(1,1,1)")
    n = built.contacts.normal[i, 0]
    for d, side, push in (
        (-0.003, MINUS, 3e3),
        (-0.001, OPEN, 0),
        (0.003, OPEN, 0),
        (0.005, PLUS, -3e3),
    ):
        u = np.zeros_like(point.u)
        u[built.contacts.node[i], :3] = d * n
        at = Point(u, np.zeros_like(u))
        response = built.respond(at, law, built.still, np.zeros_like(u))
        assert response.side[i] == side
        assert response.reaction[i] @ n == pytest.approx(push, rel=1e-12, abs=1e-9)


# --- arithmetic of the iterations


@pytest.mark.parametrize("n", [1, 7, 40])
def test_gmres_agrees_with_a_dense_solve(n):
    rng = np.random.default_rng(n)
    low_rank = rng.normal(size=(n, 3)) @ rng.normal(size=(3, n))
    a, b = np.eye(n) + 0.4 * low_rank / n, rng.normal(size=n)
    count = []
    x = gmres(lambda v: count.append(1) or a @ v, b, 1e-13, 60)
    assert np.abs(x - np.linalg.solve(a, b)).max() <= 1e-11 * np.abs(x).max()
    assert len(count) <= 5  # one more than the rank finds the answer
    assert np.array_equal(gmres(lambda v: a @ v, np.zeros(n), 1e-13, 60), np.zeros(n))


def calm():
    """Two equal responses of a pipe on two contacts, one sliding."""
    z = np.zeros((2, 3))
    normal = np.array([1000.0, 500.0])
    friction = np.array([[300.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    one = Response(
        0.3 * normal, np.array([MINUS, MINUS]), z, z, np.array([SLIP, STICK]), friction, z, z,
        normal,
    )  # fmt: skip
    return one, replace(one), np.full((3, 6), 1e-6), np.full((3, 6), 2e-6), np.full((3, 6), 1e-2)


def test_equal_responses_hold():
    verdict = judge(*calm())
    assert verdict.holds
    assert verdict.remaining == pytest.approx(1e-4)  # ratio 1/2: as much again


def turned(degrees):
    a = np.radians(degrees)
    return np.array([[300.0 * np.cos(a), 0.0, 300.0 * np.sin(a)], [0.0, 0.0, 0.0]])


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        (
            {"side": np.array([MINUS, OPEN]), "reaction": np.array([[0, 1e3, 0], [0, 5.0, 0]])},
            "a contact still opens or closes",
        ),
        (
            {"mode": np.array([STICK, STICK]), "friction": turned(1.0)},
            "between stick and slip",
        ),
        ({"normal": np.array([1000.0, 506.0])}, "more than 1 %"),
        ({"friction": np.array([[300.0, 0, 0], [0.0, 0, 2.0]])}, "a friction force"),
        ({"friction": turned(16.0), "capacity": np.array([3e4, 150.0])}, "15 degrees"),
    ],
)
def test_each_rule_can_break(change, rule):
    before, after, step, earlier, u = calm()
    verdict = judge(before, replace(after, **change), step, earlier, u)
    assert not verdict.holds
    assert rule in verdict.broken


@pytest.mark.parametrize(
    "change",
    [
        {"side": np.array([MINUS, OPEN])},  # an exact tie: no force changes
        {"mode": np.array([STICK, STICK])},
        {"normal": np.array([1000.0, 504.0])},
        {"friction": np.array([[302.0, 0, 0], [0.0, 0, 1.0]])},
        {"friction": turned(14.0), "capacity": np.array([3e4, 150.0])},
    ],
)
def test_small_changes_hold(change):
    before, after, step, earlier, u = calm()
    assert judge(before, replace(after, **change), step, earlier, u).holds


def test_the_change_that_remains_counts_not_the_last_one():
    u = np.full((2, 6), 1.0)
    last = np.full((2, 6), 5e-4)
    assert remaining_change(last, None, u) == pytest.approx(5e-4)
    assert remaining_change(last, last / 0.5, u) == pytest.approx(5e-4)
    assert remaining_change(last, last / 0.9996, u) == pytest.approx(5e-4 * 2499.0, rel=1e-9)
    assert remaining_change(last, last / 1.1, u) == np.inf
    before, after, *_ = calm()
    u3 = np.full((3, 6), 1.0)
    slow, fast = np.full((3, 6), 5e-4), np.full((3, 6), 2e-3)
    assert "0.1 %" in judge(before, after, fast, None, u3).broken
    assert "0.1 %" in judge(before, after, slow, slow / 0.9996, u3).broken
    assert judge(before, after, slow, slow / 0.5, u3).holds
