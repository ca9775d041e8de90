"""Nominal stresses against published values and closed forms."""

import dataclasses

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
from trunnion.results.stresses import end_stresses, mid_stresses, pipe_stresses

# Code_Aster SSLL106 (astest, analytic references): straight pipe
OD, WALL = 0.08, 0.008


def stress(force=(0,) * 6, pressure=0.0, od=OD, wall=WALL):
    found = pipe_stresses(
        np.array([od]), np.array([wall]), np.array([force], float), np.array([float(pressure)])
    )
    return {f.name: getattr(found, f.name)[0] for f in dataclasses.fields(found)} | {
        "longitudinal": found.longitudinal[0]
    }


def test_ssll106_axial_force():
    assert stress((500, 0, 0, 0, 0, 0))["axial"] == pytest.approx(276311, abs=0.5)


def test_ssll106_torque():
    found = stress((0, 0, 0, 500, 0, 0))
    assert found["torsion"] == pytest.approx(8.42e6, abs=0.005e6)
    # Printed at the inner wall: 6.75e6, 0.16 % above T r / 2I with the printed radii; the
    # difference cannot be had from the source.
    assert found["torsion"] * 0.032 / 0.04 == pytest.approx(6.7393e6, abs=50)


def test_ssll106_bending():
    # Printed: 1.34824e7, near M r / I at the inner wall (the section point is not given), which
    # with the printed radii is 1.347857e7. The other 0.028 % cannot be had from the source.
    found = stress((0, 0, 0, 0, 500, 0))
    assert found["bending"] * 0.032 / 0.04 == pytest.approx(1.347857e7, abs=5)
    assert found["bending"] == pytest.approx(1.6848211e7, abs=1)


def test_ssll106_pressure():
    found = stress(pressure=1e7)
    assert found["hoop_inner"] == pytest.approx(4.55556e7, abs=50)
    assert found["hoop_outer"] == pytest.approx(3.55556e7, abs=50)
    assert found["barlow"] == pytest.approx(5e7)


def test_vm12_bending_and_torsion():
    """ANSYS VM12: Timoshenko, Strength of Materials I, 3rd ed., p. 299, prob. 2; in, lbf."""
    od = 4.67017
    found = stress((0, -250, 0, 9000, 75000, 0), od=od, wall=2.33508)
    assert found["principal_max"] == pytest.approx(7527, abs=0.5)
    assert found["max_shear"] == pytest.approx(3777, abs=0.5)


def test_closed_pipe_under_pressure_alone():
    """Thick-walled tube with closed ends: von Mises at the bore is sqrt(3) p D2 / (D2 - d2)."""
    p, d = 1e7, OD - 2 * WALL
    found = stress(pressure=p)
    assert found["pressure"] == pytest.approx(p * d**2 / (OD**2 - d**2))
    assert found["von_mises"] == pytest.approx(np.sqrt(3) * p * OD**2 / (OD**2 - d**2))
    assert found["max_shear"] == pytest.approx(p * OD**2 / (OD**2 - d**2))
    assert found["principal_max"] == pytest.approx(found["hoop_inner"])
    assert found["principal_min"] == pytest.approx(-p)


@pytest.mark.parametrize(("wall", "factor"), [(OD / 2, 4 / 3), (OD * 1e-6, 2.0)])
def test_direct_shear_of_bar_and_of_thin_tube(wall, factor):
    area = np.pi * (OD - wall) * wall
    found = stress((0, 300, 400, 0, 0, 0), wall=wall)
    assert found["shear"] == pytest.approx(factor * 500 / area, rel=1e-5)
    assert found["max_shear"] == pytest.approx(found["shear"])
    assert found["von_mises"] == pytest.approx(np.sqrt(3) * found["shear"])


def test_compression_with_bending():
    found = stress((-5000, 0, 0, 0, 300, 400))
    assert found["longitudinal"] == pytest.approx(found["axial"] - found["bending"])
    assert found["principal_min"] == pytest.approx(found["longitudinal"])
    assert found["principal_max"] == pytest.approx(found["axial"] + found["bending"])
    assert found["von_mises"] == pytest.approx(-found["longitudinal"])


def test_torsion_and_bending_formula():
    found = stress((0, 0, 0, 700, 300, 400))
    want = np.hypot(found["bending"], np.sqrt(3) * found["torsion"])
    assert found["von_mises"] == pytest.approx(want)


def test_turning_the_section_changes_nothing():
    a = stress((100, 300, 400, 50, 60, 80), 1e6)
    b = stress((100, 500, 0, -50, 0, -100), 1e6)
    assert a == pytest.approx(b, rel=1e-12)


def case(linear=True):
    """A quarter bend pulled along its first tangent, a rigid body and a spring."""
    none, empty, r = np.zeros(0, np.int32), np.zeros(0), 0.5
    flags = none.astype(bool)
    contacts = Contacts(
        none, none, none, flags, none, np.zeros((0, 2, 3)), np.zeros((0, 2)), empty, flags, flags,
        (),
    )  # fmt: skip
    sliders = Sliders(
        none, none, none, np.zeros((0, 2, 3)), empty, empty, np.zeros(1, np.int32), none
    )
    kinds = ("bend", "rigid", "spring")
    system = System(
        ("1", "2", "3", "4"), {}, np.zeros((4, 3)), np.array([[0, 1], [1, 2], [2, 3]], np.int32),
        np.array([ARC, STRAIGHT, SPRING], np.int32), np.stack([np.eye(3)] * 3),
        np.array([r * np.pi / 2, 1, 0]), np.array([r, 0, 0]), np.array([np.pi / 2, 0, 0]),
        np.ones((3, 4)), np.ones(3), np.zeros((3, 6)), np.array([OD, OD, 0]),
        np.array([WALL, WALL, 0]), tuple(Part("1", "2", k, "S", "M", 0) for k in kinds), contacts,
        sliders, (), np.array([0.0, 1, 0]), np.zeros(3, np.int32), {"2M": 0},
    )  # fmt: skip
    loads = Loads(
        np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros((4, 6)), np.zeros((0, 6)), empty,
        np.full(3, 2e6),
    )  # fmt: skip
    end = np.zeros((3, 2, 6))
    end[0, 1, 0] = 1000.0
    end[0, 0] = -1000.0, 0, 0, 0, 0, 1000.0 * r
    rows = np.zeros((0, 3))
    state = State(
        np.zeros((4, 6)), np.zeros((4, 6)), end, none, rows, rows, none, empty, rows, rows, rows
    )
    return CaseResult("C", "case", "", system, loads, state, True, linear=linear)


def test_ends_of_a_bend_in_their_own_axes():
    element, first, second = end_stresses(case())
    area = np.pi / 4 * (OD**2 - (OD - 2 * WALL) ** 2)
    assert list(element) == [0]
    assert first.axial[0] == pytest.approx(1000 / area)
    assert first.bending[0] == pytest.approx(stress((0, 0, 0, 0, 0, 500))["bending"])
    assert first.shear[0] == pytest.approx(0, abs=1e-6)
    assert second.axial[0] == pytest.approx(0, abs=1e-6)
    assert second.shear[0] == pytest.approx(stress((0, 1000, 0, 0, 0, 0))["shear"])
    assert second.hoop_inner[0] == pytest.approx(stress(pressure=2e6)["hoop_inner"])


def test_middle_of_a_bend():
    labels, middle = mid_stresses(case())
    half = np.sqrt(0.5)
    want = stress((1000 * half, 1000 * half, 0, 0, 0, 500 * half), 2e6)
    assert labels == ("2M",)
    for name in ("axial", "bending", "shear", "von_mises"):
        assert getattr(middle, name)[0] == pytest.approx(want[name])


def test_absolute_combination_has_no_middle():
    labels, middle = mid_stresses(case(linear=False))
    assert labels == ()
    assert middle.axial.shape == (0,)


def test_no_numbers_no_stresses():
    failed = case()
    failed.state = None
    with pytest.raises(ValueError, match="C has no numbers"):
        end_stresses(failed)
