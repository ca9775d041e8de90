"""The hot header of `make demo`: what an engineer checks by hand before believing a report."""

from math import pi

import numpy as np
import pytest
from published import CLOSED, Source, agrees

from trunnion.arrays import SLIP, STICK

HEADER = Source(
    CLOSED,
    "The hot header of `make demo`",
    "hot_header",
    "Original; no published numbers. Those on top of the deck are Trunnion's own, beside what an "
    "engineer checks by hand: weight, balance of every direction, growth, rate of the hanger.",
)
G = 9.80665
OD, WALL, INSULATION = 0.2191, 0.00818, 0.080  # NPS 8 SCH 40
BORE = OD - 2 * WALL


def line_weight():
    """Weight of metal, contents and insulation [N/m], and of insulation and contents."""
    metal = 7850 * pi / 4 * (OD**2 - BORE**2)
    contents = 740 * pi / 4 * BORE**2
    cover = 130 * pi * INSULATION * (OD + INSULATION)
    return G * (metal + contents + cover), G * contents, G * cover


def weight():
    """Of the whole line [N]: legs less what six elbows cut off, valve and flanges."""
    pipe, contents, cover = line_weight()
    legs = 0.8 + 0.7 + 8.0 + 1.2 + 4.0 + 5.5 + 5.5 + 2.0 + 5.0 + 3.0 + 5.0
    legs += 2.0 + 5.5 + 5.5 + 5.5 + 2.0 + 6.0
    elbows = 7 * 1.5 * 8 * 0.0254 * (pi / 2 - 2)
    body = 0.111 + 0.419 + 0.111
    # a rigid carries its own weight, its contents and 1.75 times the insulation of the pipe
    return pipe * (legs + elbows) + 3520.0 + body * (contents + 1.75 * cover)


@pytest.fixture(scope="module")
def header(run):
    return run("hot_header")


@pytest.mark.parametrize("case", ["SUS", "OPE", "OPE2", "COLD"])
def test_supports_carry_the_weight(header, case):
    answer = header[case]
    up = sum(answer.support(label)[1] for label in {card.label for card in answer.system.cards})
    assert up == pytest.approx(weight(), rel=1e-9)


@pytest.mark.parametrize("case", ["SUS", "OPE", "OPE2", "COLD"])
def test_horizontal_forces_balance(header, case):
    answer = header[case]
    labels = {card.label for card in answer.system.cards}
    total = sum(answer.support(label)[[0, 2]] for label in labels)
    assert np.abs(total).max() < 1e-4


def test_first_rest_of_the_rack_lifts_off_when_hot(header):
    # riser of 8 m and vessel grow by about 26 mm at the hanger; the rest is 4 m from it
    assert not header["SUS"].is_open("70", "+Y")
    assert header["OPE"].is_open("70", "+Y")
    agrees(HEADER, "OPE, rise over the rest at 70", 7.1, 1e3 * header["OPE"].u("70")[1], "mm")


def test_hanger_gives_way_to_the_riser(header):
    # cold load 9.8 kN less rate 0.03 kN/mm times the movement
    movement = header["OPE"].u("60")[1]
    hanger = header["OPE"].support("60")[1] / 1e3
    agrees(HEADER, "OPE, load of the hanger, 9.8 kN cold", 9.1, hanger, "kN")
    assert movement > 0.020
    assert header["OPE"].support("60")[1] == pytest.approx(9800 - 30e3 * movement, rel=1e-12)


def test_rests_stick_cold_and_slide_hot(header):
    rests = ["80", "90", "115", "140", "150", "160", "170", "185"]
    for label in rests:
        cold, hot = header["SUS"], header["OPE"]
        assert cold.state.mode[cold.slider(label, "+Y")] == STICK
        assert hot.state.mode[hot.slider(label, "+Y")] == SLIP


def test_axial_stops_are_reached(header):
    hot = header["OPE"]
    for label, push in (("70", 5.1), ("170", 4.9)):
        reaction = hot.state.reaction[hot.contact(label, "LIMIT")]
        agrees(HEADER, f"OPE, axial stop at {label}", push, abs(reaction[0]) / 1e3, "kN")


def test_friction_keeps_the_cooled_line_from_coming_back(header):
    cold, never_hot = header["COLD"], header["SUS"]
    assert np.abs(cold.u("90") - never_hot.u("90"))[:3].max() > 1e-4
    away = np.abs(cold.state.u - never_hot.state.u)[:, :3].max()
    agrees(HEADER, "COLD, farthest from SUS", 16, 1e3 * away, "mm")


def test_loop_gives_way(header):
    moved = np.linalg.norm(header["OPE"].u("130")[:3])
    agrees(HEADER, "OPE, movement of the loop's corner at 130", 45, 1e3 * moved, "mm")


def test_weight_on_the_nozzle(header):
    agrees(HEADER, "SUS, load on the nozzle FY", -4.7, header["SUS"].load("10")[1] / 1e3, "kN")


def test_loads_on_the_nozzle(header):
    load = header["OPE"].load("10")
    for name, printed, ours in zip("XYZ", (-1.42, -7.87, 0.01), load[:3] / 1e3, strict=True):
        agrees(HEADER, f"OPE, load on the nozzle F{name}", printed, ours, "kN")
    agrees(HEADER, "OPE, load on the nozzle MZ", -6.5, load[5] / 1e3, "kN m")


def test_loads_on_the_heater(header):
    load = header["OPE"].load("190")
    for name, printed, ours in zip("XYZ", (2.28, -0.67, 4.19), load[:3] / 1e3, strict=True):
        agrees(HEADER, f"OPE, load on the heater F{name}", printed, ours, "kN")
    agrees(HEADER, "OPE, load on the heater MY", -8.3, load[4] / 1e3, "kN m")
