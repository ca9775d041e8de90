"""Sections: closed forms, standard sizes, masses per length."""

from math import pi

import pytest

from trunnion.model import Section
from trunnion.names import UnknownName
from trunnion.sections import (
    SCHEDULES,
    line_masses,
    nominal_inches,
    pipe_size,
    section_properties,
)


def test_properties_are_those_of_a_ring():
    p = section_properties(0.2731, 0.00927)
    # benchmark rack line: A, I of 273.1 x 9.27 mm
    assert p.area == pytest.approx(0.007683406033414441, rel=1e-14)
    assert p.inertia == pytest.approx(6.693418547400709e-05, rel=1e-14)
    assert p.modulus == pytest.approx(2 * p.inertia / 0.2731, rel=1e-15)
    assert p.shear_area == p.area / 2


def test_wall_of_half_the_diameter_is_a_solid_bar():
    p = section_properties(0.2, 0.1)
    assert p.bore == 0.0
    assert p.area == pytest.approx(pi * 0.01, rel=1e-15)
    assert p.inertia == pytest.approx(pi / 64 * 0.2**4, rel=1e-15)


@pytest.mark.parametrize("wall", [0.0, -0.001, 0.101, float("nan")])
def test_impossible_wall_is_refused(wall):
    with pytest.raises(ValueError, match="is not between"):
        section_properties(0.2, wall)


def test_masses_add_up_layer_by_layer():
    section = Section(
        "S", od=0.3, wall=0.01, fluid=900.0, lining=0.02, lining_density=2000.0,
        insulation=0.05, insulation_density=150.0,
    )  # fmt: skip
    m = line_masses(section, 7850.0)
    assert m.metal == pytest.approx(7850 * pi / 4 * (0.30**2 - 0.28**2), rel=1e-14)
    assert m.lining == pytest.approx(2000 * pi / 4 * (0.28**2 - 0.24**2), rel=1e-14)
    assert m.fluid == pytest.approx(900 * pi / 4 * 0.24**2, rel=1e-14)
    assert m.water == pytest.approx(1000 * pi / 4 * 0.24**2, rel=1e-14)
    assert m.insulation == pytest.approx(150 * pi / 4 * (0.40**2 - 0.30**2), rel=1e-14)


def test_lining_thicker_than_the_bore_is_refused():
    with pytest.raises(ValueError, match="half the bore"):
        line_masses(Section("S", od=0.1, wall=0.01, lining=0.041), 7850.0)


@pytest.mark.parametrize(
    ("nps", "schedule", "od", "wall"),
    [
        ("10", "40", 0.273, 0.00927),  # ASME B36.10M table 1
        ("16", "STD", 0.4064, 0.00953),
        ("3/4", "80", 0.0267, 0.00391),
        ("1-1/2", "40", 0.0483, 0.00368),
        (8, "10S", 0.2191, 0.00376),  # ASME B36.19M
        (24.0, "XS", 0.610, 0.0127),
    ],
)
def test_standard_sizes_are_nominal(nps, schedule, od, wall):
    assert pipe_size(nps=nps, schedule=schedule) == (od, wall)


def test_dn_names_the_same_pipe_as_nps():
    assert pipe_size(dn="250", schedule="40") == pipe_size(nps="10", schedule="40")
    assert pipe_size(dn=15, schedule="80") == pipe_size(nps="1/2", schedule="80")


def test_every_size_of_the_package_has_a_dn():
    from fluids.piping import schedule_lookup

    from trunnion.sections import _INCHES

    for schedule in SCHEDULES:
        assert set(schedule_lookup[schedule][0]) <= set(_INCHES.values())


@pytest.mark.parametrize("size", [{"nps": "11"}, {"nps": "ten"}, {"nps": "1/0"}, {"dn": "260"}, {}])
def test_unknown_size_is_named(size):
    with pytest.raises(UnknownName, match="size"):
        pipe_size(**size)


def test_unknown_schedule_names_the_nearest():
    with pytest.raises(UnknownName) as error:
        pipe_size(nps="10", schedule="10T")
    assert "10" in error.value.nearest


def test_nominal_inches_of_both_systems():
    assert nominal_inches(dn=250) == nominal_inches(nps="10") == 10.0
    assert nominal_inches(nps="1-1/2") == nominal_inches(dn="40") == 1.5
