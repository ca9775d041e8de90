"""A crossing on simple supports: wind of ASCE 7-16, snow, earthquake and modes by closed forms."""

from math import pi, sqrt

import pytest
from published import CLOSED, Source, agrees

CROSSING = Source(
    CLOSED,
    "A crossing under wind, snow and earthquake",
    "wind_crossing",
    "ASCE 7-16 eq. 26.10-1 and table 26.10-1 for the velocity pressure; simple beam for all else. "
    "Frequencies within 0.1 %: the beam of the formula has neither shear nor rotary inertia.",
)
SPAN, OD, WALL, COVER = 12.0, 0.2731, 0.00927, 0.05
G = 9.80665


@pytest.fixture(scope="module")
def crossing(run):
    return run("wind_crossing").results


def weight():
    """Weight per length of steel, contents and insulation [N/m]."""
    steel = pi / 4 * (OD**2 - (OD - 2 * WALL) ** 2) * 7850
    contents = pi / 4 * (OD - 2 * WALL) ** 2 * 850
    insulation = pi / 4 * ((OD + 2 * COVER) ** 2 - OD**2) * 120
    return (steel + contents + insulation) * G


def load(crossing, case, node, component):
    """Load of the pipe on a restraint [N]."""
    return -crossing[case].supports[node][component]


@pytest.mark.parametrize("node", ["10", "20"])
def test_wind_by_the_velocity_pressure(crossing, node):
    kz = 2.01 * (10.0 / 274.32) ** (2 / 9.5)
    q = 0.613 * kz * 31.62**2
    each = q * 0.85 * 0.7 * (OD + 2 * COVER) * SPAN / 2
    per_length = 2 * load(crossing, "WND", node, "fz") / SPAN
    agrees(CROSSING, "WND, load per length", 136.2, per_length, "N/m")
    agrees(CROSSING, f"WND, {node} FZ", 817.1, load(crossing, "WND", node, "fz"), "N")
    assert load(crossing, "WND", node, "fz") == pytest.approx(each, rel=1e-9)
    assert load(crossing, "WND", node, "fy") == pytest.approx(0.0, abs=1e-9 * each)


@pytest.mark.parametrize("node", ["10", "20"])
def test_snow_by_length(crossing, node):
    agrees(CROSSING, f"SNW, {node} FY", "-2400", load(crossing, "SNW", node, "fy"), "N")
    assert load(crossing, "SNW", node, "fy") == pytest.approx(-400.0 * SPAN / 2, rel=1e-9)


@pytest.mark.parametrize("node", ["10", "20"])
def test_earthquake_is_a_share_of_the_weight(crossing, node):
    assert load(crossing, "SUS", node, "fy") == pytest.approx(-weight() * SPAN / 2, rel=1e-9)
    assert load(crossing, "EQZ", node, "fz") == pytest.approx(0.3 * weight() * SPAN / 2, rel=1e-9)


def test_frequencies_of_a_simple_beam(crossing):
    inertia = pi / 64 * (OD**4 - (OD - 2 * WALL) ** 4)
    first = pi / 2 * sqrt(203e9 * inertia * G / (weight() * SPAN**4))
    assert first == pytest.approx(3.840, abs=0.0005)  # the deck's header
    found = crossing.modes.frequency
    agrees(CROSSING, "first bending frequency", "3.840", found[0], "Hz", rel=1e-3)
    assert found == pytest.approx([first, first, 4 * first, 4 * first], rel=1e-3)
    assert crossing.modes.proven
