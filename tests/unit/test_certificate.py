"""The certificate passes what is right to round-off and nothing that is wrong by 1e-6.

The scene is determinate: tip forces and tip deformations are chosen, displacements follow from
the anchor outwards, contacts are laid under them by their bases, and the nodal loads are what
balance needs.  All of it in extended precision by textbook formulas, none of them the module's.
"""

import copy
import dataclasses
import subprocess
import sys

import numpy as np
import pytest

from trunnion.arrays import (
    ARC,
    BOTH,
    ENGAGED,
    MINUS,
    OPEN,
    PLUS,
    SLIP,
    SPRING,
    STICK,
    STRAIGHT,
    Card,
    Contacts,
    Loads,
    Part,
    Sliders,
    State,
    System,
)
from trunnion.certificate import certify

LD = np.longdouble
PI = LD(np.arctan(LD(1.0)) * 4)
EA, GJ, EI, GAS = RIGIDITY = 1.6e9, 1.05e7, 1.37e7, 3.1e8
FLEX, RADIUS = 6.3, 0.381
INF = np.inf


def turn(a: float, b: float) -> np.ndarray:
    """Orthonormal rows: some skew frame."""
    ca, sa, cb, sb = np.cos(a), np.sin(a), np.cos(b), np.sin(b)
    return np.array([[ca * cb, sa * cb, sb], [-sa, ca, 0.0], [-ca * sb, -sa * sb, cb]])


def straight_tip(length, force, q, strain):
    """Tip of a cantilever by the usual formulas in local axes."""
    n, vy, vz, t, my, mz = force
    bend, shear = length / LD(EI), length / LD(GAS)
    sway = bend * length**2 / 3 + shear
    sag = bend * length**3 / 8 + shear * length / 2
    return np.array(
        [
            n * length / LD(EA) + q[0] * length**2 / (2 * LD(EA)) + strain * length,
            vy * sway + mz * bend * length / 2 + q[1] * sag,
            vz * sway - my * bend * length / 2 + q[2] * sag,
            t * length / LD(GJ),
            my * bend - vz * bend * length / 2 - q[2] * bend * length**2 / 6,
            mz * bend + vy * bend * length / 2 + q[1] * bend * length**2 / 6,
        ],
        LD,
    )


def quarter_bend_tip(force, strain, curvature):
    """Tip of a quarter circle; the integrals over sines and cosines are done by hand."""
    r, f, g, ea, gas = LD(RADIUS), LD(FLEX) / LD(EI), 1 / LD(GJ), 1 / LD(EA), 1 / LD(GAS)
    c = np.zeros((6, 6), LD)
    c[0, 0] = f * r**3 * PI / 4 + r * (ea + gas) * PI / 4
    c[1, 1] = f * r**3 * (3 * PI / 4 - 2) + r * (ea + gas) * PI / 4
    c[0, 1] = -f * r**3 / 2 + r * (ea - gas) / 2
    c[0, 5], c[1, 5], c[5, 5] = -f * r**2, f * r**2 * (PI / 2 - 1), f * r * PI / 2
    c[2, 2] = r**3 * ((3 * PI / 4 - 2) * g + f * PI / 4) + r * gas * PI / 2
    c[2, 3] = r**2 * (g + f) / 2
    c[2, 4] = r**2 * ((1 - PI / 4) * g - f * PI / 4)
    c[3, 3] = c[4, 4] = r * (g + f) * PI / 4
    c[3, 4] = r * (g - f) / 2
    c = c + np.triu(c, 1).T
    chord = np.array([r, r, 0])
    opening = np.array([-(r**2), r**2 * (PI / 2 - 1), 0, 0, 0, r * PI / 2]) * curvature
    return c @ force + np.concatenate([chord * strain, np.zeros(3)]) + opening


def split(x):
    high = x.astype(float)
    return high, (x - high).astype(float)


def scene():
    """Anchor, 5 mm stub, quarter bend, 6 m pipe, spring; every kind of contact and slider."""
    axes = np.stack([turn(0.3, 0.5), turn(0.3, 0.5), turn(1.1, -0.4), turn(-0.7, 0.2)])
    kind = np.array([STRAIGHT, ARC, STRAIGHT, SPRING], np.int32)
    length = np.array([0.005, RADIUS * np.pi / 2, 6.0, 0.0])
    spring = np.zeros((4, 6))
    spring[3] = 2e6, 3e6, 0.0, 4e5, 5e5, 6e5
    dist = np.array([[0, -900.0, 30], [0, 0, 0], [10.0, -900, -40], [0, 0, 0]])
    strain, curvature = np.array([2e-3, 2e-3, 1e-3, 0]), np.array([0, 4e-4, 0, 0])
    offset = np.array([0.4, -0.2, 0.3])
    tips = np.array(
        [
            [8e3, -3e3, 5e3, 2e3, -4e3, 6e3],
            [-7e3, 2e3, 4e3, 1e3, 3e3, -5e3],
            [5e3, 1e3, -2e3, 3e3, 2e3, 1e3],
            [3e3, -2e3, 0.0, 1e3, -2e3, 1e3],
        ],
        LD,
    )  # in element axes; the spring's stand at mid-distance

    n_node, k = 5, 1e12
    xyz, u = np.zeros((n_node, 3), LD), np.zeros((n_node, 6), LD)
    end = np.zeros((4, 2, 6), LD)
    for e in range(4):
        a = axes[e].astype(LD)
        q = a @ dist[e]
        f = a.T @ tips[e, :3]
        if kind[e] == STRAIGHT:
            d = LD(length[e]) * a[0]
            v = straight_tip(LD(length[e]), tips[e], q, LD(strain[e]))
            about = np.cross(d / 2, dist[e] * LD(length[e]))
        elif kind[e] == ARC:
            d = LD(RADIUS) * (a[0] + a[1])
            v = quarter_bend_tip(tips[e], LD(strain[e]), LD(curvature[e]))
            about = np.zeros(3, LD)
        else:
            d = offset.astype(LD)
            stiff = np.where(spring[e] > 0, spring[e], 1.0).astype(LD)
            v = np.where(spring[e] > 0, tips[e] / stiff, LD(0.01))
        m = a.T @ tips[e, 3:]
        if kind[e] == SPRING:
            m, about = m - np.cross(d / 2, f), np.zeros(3, LD)
        end[e, 1] = np.concatenate([f, m])
        end[e, 0, :3] = -f - dist[e] * LD(length[e])
        end[e, 0, 3:] = -m - np.cross(d, f) - about
        if e == 0:
            u[0] = -end[0, 0] / k
        move, rotation = a.T @ v[:3], a.T @ v[3:]
        lever = u[e, 3:] + (rotation / 2 if kind[e] == SPRING else 0)
        u[e + 1, 3:] = u[e, 3:] + rotation
        u[e + 1, :3] = u[e, :3] + np.cross(lever, d) + move
        xyz[e + 1] = xyz[e] + d

    high, low = split(u)
    u = high.astype(LD) + low
    up = np.array([0.0, 1.0, 0.0])
    skew = turn(0.4, 0.7)
    cards = [
        Card("10", None, "10 ANCHOR", "anchor", 1),
        Card("30", None, "30 +Y", "support", 2),
        Card("40", None, "40 (1,1,1)", "support", 3),
        Card("20", None, "20 GUIDE", "support", 4),
        Card("50", None, "50 HANGER", "hanger", 5),
        Card("50", "30", "50 LIMIT", "support", 6),
        Card("40", None, "40 +Z", "support", 7),
        Card("20", None, "20 GUIDE K", "support", 8),
        Card("40", None, "40 RX", "support", 9),
    ]
    rows = []  # card, node, cnode, rotational, normals, gap, k, two_way, side, aim, word

    def add(card, node, normals, gap, k, side, aim, word, *, cnode=-1, turns=False, two=False):
        normals = np.atleast_2d(normals)
        both = np.zeros((2, 3))
        both[: len(normals)] = normals
        rows.append((card, node, cnode, turns, len(normals), both, gap, k, two, side, aim, word))

    for i in range(3):
        add(0, 0, np.eye(3)[i], (0, 0), k, BOTH, None, "XYZ"[i], two=True)
    for i in range(3):
        add(0, 0, np.eye(3)[i], (0, 0), k, BOTH, None, "R" + "XYZ"[i], turns=True, two=True)
    add(1, 2, up, (0.0, INF), k, MINUS, -2.4e-8, "+Y")
    add(2, 3, skew[0], (0.01, 0.003), k, PLUS, 0.003 + 7e-9, "(1,1,1)")
    add(3, 1, skew[1:], (0.002, 0.002), k, BOTH, 0.002 + 3e-9, "GUIDE")
    add(4, 4, up, (0, 0), 3e4, BOTH, 0.004, "HANGER", two=True)
    add(5, 4, skew[2], (0.0, 0.005), 2e9, MINUS, -4e-6, "LIMIT", cnode=2)
    add(6, 3, skew[1], (0.02, INF), k, OPEN, 0.001, "+Z")
    add(7, 1, skew[1:], (0, 0), 4e8, BOTH, 1e-5, "GUIDE", two=True)
    add(8, 3, np.eye(3)[0], (0.01, 0.01), 5e8, PLUS, 0.01 + 3e-6, "RX", turns=True)

    base = np.zeros((len(cards), 6))
    preload = np.zeros(len(cards))
    preload[4] = 1500.0
    reaction = []
    for card, node, cnode, turns, dim, n, gap, kk, two, side, aim, _ in rows:
        part = slice(3, 6) if turns else slice(0, 3)
        partner = u[cnode, part] if cnode >= 0 else LD(0)
        if aim is not None:
            way = n[0] if dim == 1 else 0.6 * n[0] + 0.8 * n[1]
            travel = u[node, part] - partner
            across = n[0] * (n[0] @ travel) + n[1] * (n[1] @ travel)
            base[card, part] = (across - LD(aim) * way).astype(float)
        d = n.astype(LD) @ (u[node, part] - partner - base[card, part])
        if dim == 2:
            reach = np.sqrt(d[0] ** 2 + d[1] ** 2)
            r = -LD(kk) * (reach - LD(0 if two else gap[0])) * d / reach
        else:
            shift = {BOTH: d[0], PLUS: d[0] - LD(gap[1]), MINUS: d[0] + LD(gap[0]), OPEN: LD(0)}
            r = np.array([-LD(kk) * shift[side], 0])
        force = n.T @ r
        reaction.append(force + (up * preload[card] if card == 4 else 0))
    reaction = np.array(reaction)
    col = list(zip(*rows, strict=True))
    contacts = Contacts(
        node=np.array(col[1], np.int32), cnode=np.array(col[2], np.int32),
        card=np.array(col[0], np.int32), rotational=np.array(col[3]),
        dim=np.array(col[4], np.int32), normal=np.array(col[5]),
        gap=np.array(col[6], float), k=np.array(col[7], float),
        penalty=np.array(col[7]) == k, two_way=np.array(col[8]), word=tuple(col[11]),
    )  # fmt: skip
    side = np.array(col[9], np.int32)

    # sliders: slip on the rest, stick on the skew stop, open on +Z, slip along both guides
    # (RESULTANT: one slider of two contacts), slip against a moving partner
    def plane(n):
        a = np.cross(n, [0.3, 0.2, 0.9])
        a = a / np.linalg.norm(a)
        return np.stack([a, np.cross(n, a)])

    line = np.stack([skew[0], np.zeros(3)])
    basis = np.stack([plane(up), plane(skew[0]), plane(skew[1]), line, plane(skew[2])])
    members = [[6], [7], [11], [8, 12], [10]]
    first = np.cumsum([0, *map(len, members)]).astype(np.int32)
    mode = np.array([SLIP, STICK, OPEN, SLIP, SLIP], np.int32)
    aim = np.array([[3e-3, -4e-3], [4e-6, 3e-6], [0.01, 0.002], [-6e-3, 0], [1e-3, 2e-3]])
    mu, kf, mux = np.array([0.3, 0.2, 0.4, 0.25, 0.15]), np.full(5, 1e8), 0.9
    flat = [i for m in members for i in m]
    sliders = Sliders(
        node=contacts.node[[m[0] for m in members]], cnode=contacts.cnode[[m[0] for m in members]],
        card=contacts.card[[m[0] for m in members]], basis=basis, mu=mu, kf=kf, first=first,
        contact=np.array(flat, np.int32),
    )  # fmt: skip
    normal, friction, slide = np.zeros(5, LD), np.zeros((5, 3), LD), np.zeros((5, 3), LD)
    datum, datum_end = np.zeros((5, 3)), np.zeros((5, 3), LD)
    for i, m in enumerate(members):
        total = reaction[m].sum(axis=0)
        normal[i] = np.sqrt(total @ total)
        p = basis[i].T.astype(LD) @ basis[i]
        partner = u[sliders.cnode[i], :3] if sliders.cnode[i] >= 0 else LD(0)
        now = p @ (u[sliders.node[i], :3] - partner - base[sliders.card[i], :3])
        datum[i] = (now - basis[i].T @ aim[i]).astype(float)
        slide[i] = now - datum[i]
        if mode[i] == STICK:
            friction[i] = -LD(kf[i]) * slide[i]
        elif mode[i] == SLIP:
            size = np.sqrt(slide[i] @ slide[i])
            friction[i] = -LD(mu[i] * mux) * normal[i] * slide[i] / size
        datum_end[i] = datum[i] if mode[i] == STICK else now + friction[i] / kf[i]

    nodal = np.zeros((n_node, 6), LD)
    for e in range(4):
        nodal[e] += end[e, 0]
        nodal[e + 1] += end[e, 1]
    for i, r in enumerate(reaction):
        part = slice(3, 6) if contacts.rotational[i] else slice(0, 3)
        nodal[contacts.node[i], part] -= r
        if contacts.cnode[i] >= 0:
            nodal[contacts.cnode[i], part] += r
    for i in range(5):
        nodal[sliders.node[i], :3] -= friction[i]
        if sliders.cnode[i] >= 0:
            nodal[sliders.cnode[i], :3] += friction[i]

    labels = ("10", "20", "30", "40", "50")
    system = System(
        labels=labels, alias={}, xyz=xyz.astype(float),
        ends=np.array([[0, 1], [1, 2], [2, 3], [3, 4]], np.int32), kind=kind, axes=axes,
        length=length, radius=np.array([0, RADIUS, 0, 0]), angle=np.array([0, np.pi / 2, 0, 0]),
        rigidity=np.array([RIGIDITY, RIGIDITY, RIGIDITY, (0, 0, 0, 0)]),
        flex=np.array([1, FLEX, 1, 1]), spring=spring, od=np.full(4, 0.27), wall=np.full(4, 0.01),
        parts=tuple(Part(labels[i], labels[i + 1], "pipe", "S", "M", i) for i in range(4)),
        contacts=contacts, sliders=sliders, cards=tuple(cards), up=up,
        source=np.arange(4, dtype=np.int32), mid={},
    )  # fmt: skip
    loads = Loads(dist, strain, curvature, nodal.astype(float), base, preload, np.zeros(4), mux)
    state = State(
        high, low, end.astype(float), side, reaction.astype(float), friction.astype(float), mode,
        normal.astype(float), slide.astype(float), datum, datum_end.astype(float),
    )  # fmt: skip
    return system, loads, state


def check(system, loads, state):
    return certify(system, loads, state, correction_u=1e-15, correction_r=1e-15)


def perturbed(state, name, index, amount):
    other = copy.deepcopy(state)
    getattr(other, name)[index] += amount
    return other


SCENE = scene()
NUMBERS = [
    (name, index)
    for name in (
        "u", "u_low", "end_force", "reaction", "friction", "normal", "slide", "datum", "datum_end"
    )
    for index in np.ndindex(getattr(SCENE[2], name).shape)
]  # fmt: skip


def test_a_right_answer_passes_to_round_off():
    certificate = check(*SCENE)
    assert certificate.passed
    assert certificate.worst < 1e-12, certificate
    assert not certificate.inherited


@pytest.mark.parametrize(("name", "index"), NUMBERS)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_no_number_can_be_wrong_by_one_in_a_million(name, index, sign):
    system, loads, state = SCENE
    kind = np.array(getattr(state, {"u_low": "u"}.get(name, name)))
    if kind.shape[-1] == 6:  # translations and rotations, forces and moments are two kinds
        kind = kind[..., :3] if index[-1] < 3 else kind[..., 3:]
    elif name == "reaction":
        turning = system.contacts.rotational
        kind = kind[turning == turning[index[0]]]
    amount = sign * 1e-6 * np.abs(kind).max()
    assert not check(system, loads, perturbed(state, name, index, amount)).passed


@pytest.mark.parametrize(("name", "index"), NUMBERS)
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_number_that_is_none_fails_and_is_named(name, index, value):
    system, loads, state = SCENE
    certificate = check(system, loads, perturbed(state, name, index, value))
    assert not certificate.passed
    assert certificate.worst == np.inf
    assert certificate.where.endswith(f"({name})")


@pytest.mark.parametrize("i", range(len(SCENE[2].side)))
def test_no_side_can_be_wrong(i):
    system, loads, state = SCENE
    for side in {OPEN, MINUS, PLUS, BOTH, 3} - {int(state.side[i])}:
        other = copy.deepcopy(state)
        other.side[i] = side
        assert not check(system, loads, other).passed, side


@pytest.mark.parametrize("i", range(len(SCENE[2].mode)))
def test_no_mode_can_be_wrong(i):
    system, loads, state = SCENE
    for mode in {OPEN, ENGAGED, STICK, SLIP, 4} - {int(state.mode[i])}:
        other = copy.deepcopy(state)
        other.mode[i] = mode
        assert not check(system, loads, other).passed, mode


@pytest.mark.parametrize("name", ["correction_u", "correction_r"])
@pytest.mark.parametrize("value", [2e-9, -2e-9, np.nan, np.inf])
def test_a_large_next_correction_fails(name, value):
    certificate = certify(*SCENE, **{"correction_u": 0.0, "correction_r": 0.0, name: value})
    assert not certificate.passed
    assert certificate.where == name


def test_the_place_is_named():
    system, loads, state = SCENE
    cases = [
        ("end_force", (2, 1, 4), 40.0, "40"),
        ("u", (3, 1), 1e-3, "40"),
        ("u", (0, 4), 1e-3, "10"),
        ("friction", (4, 0), 1e3, "50"),
    ]
    for name, index, amount, words in cases:
        where = check(system, loads, perturbed(state, name, index, amount)).where
        assert words in where, where


def test_friction_scaled_with_its_loads_is_caught():
    """Balanced by the loads, along the slide, but larger than mu N: only Coulomb can object."""
    system, loads, state = SCENE
    state, nodal = copy.deepcopy(state), loads.nodal.copy()
    extra = 1e-6 * state.friction[0]
    state.friction[0] += extra
    state.datum_end[0] += extra / system.sliders.kf[0]
    nodal[2, :3] -= extra
    certificate = check(system, dataclasses.replace(loads, nodal=nodal), state)
    assert not certificate.passed
    assert certificate.where == "friction at support 30 +Y"


def test_friction_turned_with_its_loads_is_caught():
    system, loads, state = SCENE
    state, nodal = copy.deepcopy(state), loads.nodal.copy()
    extra = 1e-6 * np.cross(system.up, state.friction[0])
    state.friction[0] += extra
    state.datum_end[0] += extra / system.sliders.kf[0]
    nodal[2, :3] -= extra
    certificate = check(system, dataclasses.replace(loads, nodal=nodal), state)
    assert not certificate.passed
    assert certificate.where == "direction at support 30 +Y"


def test_a_reaction_across_its_normal_is_caught():
    system, loads, state = SCENE
    state, nodal = copy.deepcopy(state), loads.nodal.copy()
    state.reaction[13, 1] += 1.0
    nodal[3, 4] -= 1.0
    certificate = check(system, dataclasses.replace(loads, nodal=nodal), state)
    assert certificate.where == "contact_state at support 40 RX"


def test_reaction_of_an_open_contact_is_caught():
    system, loads, state = SCENE
    state, nodal = copy.deepcopy(state), loads.nodal.copy()
    push = system.contacts.normal[11, 0] * 1.0
    state.reaction[11] += push
    state.normal[2] = 1.0
    nodal[3, :3] -= push
    certificate = check(system, dataclasses.replace(loads, nodal=nodal), state)
    assert certificate.where == "contact_state at support 40 +Z"


def test_without_friction_a_closed_slider_is_engaged():
    system, loads, state = SCENE
    state, nodal = copy.deepcopy(state), loads.nodal.copy()
    s = system.sliders
    np.add.at(nodal[:, :3], s.node, state.friction)
    on = s.cnode >= 0
    np.subtract.at(nodal[:, :3], s.cnode[on], state.friction[on])
    state.friction[:] = 0.0
    state.datum_end = state.datum + state.slide
    state.mode[:] = np.where(state.mode == OPEN, OPEN, ENGAGED)
    certificate = check(system, dataclasses.replace(loads, nodal=nodal, mux=0.0), state)
    assert certificate.worst < 1e-12, certificate
    for i, wrong in ((0, STICK), (0, SLIP), (0, OPEN), (2, ENGAGED)):
        other = copy.deepcopy(state)
        other.mode[i] = wrong
        free = dataclasses.replace(loads, nodal=nodal, mux=0.0)
        assert not check(system, free, other).passed


def test_no_kernel_and_no_solver_is_imported():
    code = (
        "import sys, trunnion.certificate\n"
        "loaded = [m for m in sys.modules if m.startswith('trunnion')]\n"
        "print(*loaded)\n"
        "bad = {'trunnion.kernels', 'trunnion._kernels', 'trunnion.system.geometry'}\n"
        "bad.add('trunnion.loads')\n"
        "assert not bad & set(loaded)\n"
        "assert not [m for m in loaded if m.startswith('trunnion.solve')]\n"
        "assert 'scipy' not in sys.modules\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
