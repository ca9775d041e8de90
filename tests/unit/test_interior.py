"""Interior points of elements against closed forms and against finer models."""

import numpy as np
import pytest

from trunnion.arrays import (
    ARC,
    SPRING,
    STRAIGHT,
    CaseResult,
    Contacts,
    Loads,
    Part,
    Sliders,
    State,
    System,
)
from trunnion.certificate import deformation
from trunnion.results.interior import extreme_deflections, mid_of_bend, points, stations

I4 = np.int32
EA, GJ, EI, GAS = 1.6e9, 1.05e7, 1.37e7, 3.1e8
SKEW = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
SKEW[2] = np.cross(SKEW[0], SKEW[1])


def nothing():
    none = np.zeros(0, I4)
    empty = np.zeros(0)
    contacts = Contacts(
        none, none, none, none.astype(bool), none, np.zeros((0, 2, 3)), np.zeros((0, 2)), empty,
        none.astype(bool), none.astype(bool), (),
    )  # fmt: skip
    return contacts, Sliders(
        none, none, none, np.zeros((0, 2, 3)), empty, empty, np.zeros(1, I4), none
    )


def element(kind, length, *, radius=0.0, gas=GAS, flex=1.0, dist=(0, 0, 0), strain=0.0, curve=0.0,
            tip=(0,) * 6, start=(0,) * 6, axes=SKEW):  # fmt: skip
    """One element with chosen tip force (global) and movement of its first end."""
    contacts, sliders = nothing()
    angle = length / radius if radius else 0.0
    system = System(
        ("1", "2"), {}, np.zeros((2, 3)), np.array([[0, 1]], I4), np.array([kind], I4), axes[None],
        np.array([length]), np.array([radius]), np.array([angle]), np.array([[EA, GJ, EI, gas]]),
        np.array([flex]), np.zeros((1, 6)), np.array([0.27]), np.array([0.01]),
        (Part("1", "2", "pipe", "S", "M", 0),), contacts, sliders, (), np.array([0.0, 1, 0]),
        np.zeros(1, I4), {"2M": 0} if radius else {},
    )  # fmt: skip
    loads = Loads(
        np.array([dist], float), np.array([strain]), np.array([curve]), np.zeros((2, 6)),
        np.zeros((0, 6)), np.zeros(0), np.zeros(1),
    )  # fmt: skip
    tip = np.array(tip, float)
    d = deformation.tip_vector(system)[:, 0]
    about = deformation.load_moment(system, loads.dist.T)[:, 0]
    first = np.concatenate(
        [-tip[:3] - loads.dist[0] * length, -tip[3:] - np.cross(d, tip[:3]) - about]
    )
    v = deformation.expected(system, loads, tip[:, None])[:, 0]
    u = np.zeros((2, 6))
    u[0] = start
    u[1, 3:] = u[0, 3:] + v[3:]
    u[1, :3] = u[0, :3] + np.cross(u[0, 3:], d) + v[:3]
    system.xyz[1] = d
    none = np.zeros((0, 3))
    state = State(
        u, np.zeros((2, 6)), np.array([[first, tip]]), np.zeros(0, I4), none, none,
        np.zeros(0, I4), np.zeros(0), none, none, none,
    )  # fmt: skip
    return CaseResult("C", "case", "", system, loads, state, True)


GENERAL = {
    "dist": (300.0, -900, 50), "strain": 1e-3, "tip": (8e3, -3e3, 5e3, 2e3, -4e3, 6e3),
    "start": (1e-3, 2e-3, -1e-3, 1e-3, -2e-3, 3e-3),
}  # fmt: skip
SHAPES = [
    {"kind": STRAIGHT, "length": 6.0},
    {"kind": STRAIGHT, "length": 6.0, "gas": 0.0},
    {"kind": ARC, "length": 1.2, "radius": 0.5, "flex": 6.0, "curve": 2e-4},
    {"kind": ARC, "length": 0.02, "radius": 20.0},
    {"kind": ARC, "length": 3.0, "radius": 1.0, "flex": 2.0},
]


@pytest.mark.parametrize("shape", SHAPES)
def test_ends_are_the_nodes(shape):
    case = element(**shape, **GENERAL)
    at = points(case, np.zeros(2, int), np.array([0.0, 1.0]))
    assert np.allclose(at.displacement, case.state.u, rtol=0, atol=1e-12 * abs(case.state.u).max())
    assert np.allclose(at.force[0], -case.state.end_force[0, 0], rtol=1e-12)
    assert np.allclose(at.force[1], case.state.end_force[0, 1], rtol=1e-10)
    assert np.allclose(at.xyz, case.system.xyz, rtol=0, atol=1e-15 * shape["length"])


@pytest.mark.parametrize("shape", SHAPES)
def test_a_part_is_an_element(shape):
    """The second half, taken for itself from the point's answers, ends at the second node."""
    case = element(**shape, **GENERAL)
    at = points(case, np.zeros(1, int), np.array([0.4]))
    rest = {**shape, "length": 0.6 * shape["length"]}
    rest |= GENERAL | {"start": at.displacement[0], "tip": case.state.end_force[0, 1]}
    other = element(**rest, axes=at.axes[0])
    scale = abs(case.state.u).max()
    assert np.allclose(other.state.u[1], case.state.u[1], rtol=0, atol=1e-12 * scale)
    assert np.allclose(-other.state.end_force[0, 0], at.force[0], rtol=1e-10)
    assert np.allclose(at.xyz[0] + other.system.xyz[1], case.system.xyz[1], atol=1e-14)


def test_section_force_of_a_bend_under_a_radial_pull():
    """At 90 degrees of a quarter bend pulled along its first tangent: all is shear."""
    r, pull = 0.5, 1000.0
    case = element(ARC, r * np.pi / 2, radius=r, tip=(pull, 0, 0, 0, 0, 0), axes=np.eye(3))
    at = points(case, np.zeros(3, int), np.array([0.0, 0.5, 1.0]))
    n, v, m = at.section_force[:, 0], at.section_force[:, 1], at.section_force[:, 5]
    half = np.sqrt(0.5)
    assert np.allclose(n, [pull, pull * half, 0], atol=1e-10)
    assert np.allclose(v, [0, -pull * half, -pull], atol=1e-10)
    assert np.allclose(m, [-pull * r, -pull * r * half, 0], atol=1e-10)
    assert np.allclose(at.axes[2], [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], atol=1e-15)


def test_mid_of_bend_by_label():
    case = element(ARC, 0.75, radius=0.5, **GENERAL)
    assert list(mid_of_bend(case)) == ["2M"]
    middle = points(case, np.zeros(1, int), np.array([0.5]))
    assert np.array_equal(mid_of_bend(case)["2M"], middle.displacement[0])


def test_absolute_combination_has_no_interior():
    case = element(ARC, 0.75, radius=0.5, **GENERAL)
    case.linear = False
    assert mid_of_bend(case) == {}
    with pytest.raises(ValueError, match="C has no interior points"):
        stations(case, 2)


def test_spring_has_no_interior():
    case = element(STRAIGHT, 1.0)
    case.system.kind[0] = SPRING
    assert len(stations(case, 4).element) == 0
    with pytest.raises(ValueError, match="spring"):
        points(case, np.zeros(1, int), np.array([0.5]))


def test_stations_divide_each_span():
    at = stations(element(STRAIGHT, 6.0, **GENERAL), 4)
    assert np.allclose(at.fraction, [0, 0.25, 0.5, 0.75, 1])
    assert np.allclose(at.xyz, np.linspace(0, 6, 5)[:, None] * SKEW[0])


def test_simple_span_sags_in_the_middle():
    """5 w L^4 / 384 EI + w L^2 / 8 GAs, and w L^2 / 8 there."""
    w, length = 1090.5, 10.0
    slope = -w * length**3 / (24 * EI)
    case = element(STRAIGHT, length, dist=(0, -w, 0), tip=(0, w * length / 2, 0, 0, 0, 0),
                   start=(0, 0, 0, 0, 0, slope), axes=np.eye(3))  # fmt: skip
    found = extreme_deflections(case)
    sag = 5 * w * length**4 / (384 * EI) + w * length**2 / (8 * GAS)
    assert found.fraction[0] == pytest.approx(0.5, abs=1e-9)
    assert found.sag[0] == pytest.approx(sag, rel=1e-10)
    assert found.deflection[0, 1] < 0
    middle = points(case, np.zeros(1, int), np.array([0.5]))
    assert middle.section_force[0, 5] == pytest.approx(w * length**2 / 8, rel=1e-12)


def test_propped_cantilever_sags_off_the_middle():
    """w L^4 / 185 EI near 0.4215 L from the prop (Roark, table 8.1)."""
    w, length = 1000.0, 8.0
    case = element(STRAIGHT, length, gas=0.0, dist=(0, 0, -w),
                   tip=(0, 0, 3 * w * length / 8, 0, 0, 0), axes=np.eye(3))  # fmt: skip
    found = extreme_deflections(case)
    x = (15 - np.sqrt(33)) / 16  # from the clamp
    assert found.fraction[0] == pytest.approx(x, abs=1e-9)
    want = w * length**4 / (48 * EI) * x**2 * (1 - x) * (3 - 2 * x)
    assert found.sag[0] == pytest.approx(want, rel=1e-10)


def test_deflection_is_largest_of_all_points():
    case = element(STRAIGHT, 6.0, **GENERAL)
    found = extreme_deflections(case)
    fine = points(case, np.zeros(2001, int), np.linspace(0, 1, 2001))
    chord = case.state.u[0, :3] + fine.fraction[:, None] * (case.state.u[1] - case.state.u[0])[:3]
    off = fine.displacement[:, :3] - chord
    off -= np.outer(off @ SKEW[0], SKEW[0])
    sizes = np.linalg.norm(off, axis=1)
    assert found.sag[0] == pytest.approx(sizes.max(), rel=1e-6)
    assert found.sag[0] >= sizes.max() * (1 - 1e-12)
    assert abs(found.fraction[0] - fine.fraction[sizes.argmax()]) < 1e-3
