"""Forces of relief valves and slugs: formulas in other units, published numbers, limits."""

import math

import numpy as np
import pytest

from trunnion.loads.transient_forces import (
    dynamic_load_factor,
    gas_exit,
    installation_period,
    open_discharge,
    slug,
    steam_exit,
)

LB, IN, FT, PSI, LBF = 0.45359237, 0.0254, 0.3048, 6894.757, 4.4482216
BTU_LB = 2326.0


@pytest.mark.parametrize(
    ("condition", "a", "b"),
    [("WET", 291.0, 11.0), ("SATURATED", 823.0, 4.33), ("SUPERHEATED", 831.0, 4.33)],
)
def test_steam_exit_is_the_formula_in_us_units(condition: str, a: float, b: float) -> None:
    """SST Systems, news of January 1999, on ANSI B31.1: V [ft/s], P [psia], M/A [lb/s in2].

    V = sqrt(50113 (h0 - a)/(2 b - 1)); P = (M/A) (b - 1)/b sqrt(48.33 (h0 - a)/(2 b - 1)).
    gc = 32.2 there: 0.05 %.
    """
    h0, flow, area = 1507.0, 116.38, 50.03
    velocity, pressure = steam_exit(flow * LB, area * IN**2, h0 * BTU_LB, condition)
    part = (h0 - a) / (2 * b - 1)
    assert velocity / FT == pytest.approx(math.sqrt(50113 * part), rel=5e-4)
    psia = flow / area * (b - 1) / b * math.sqrt(48.33 * part)
    assert pressure / PSI == pytest.approx(psia, rel=5e-4)


def test_open_discharge_is_momentum_and_pressure_against_the_jet() -> None:
    force = open_discharge(
        flow=50.0, velocity=600.0, pressure=801325.0, area=0.03, jet=(0.0, 3.0, 4.0), dlf=1.5
    )
    size = 1.5 * (50.0 * 600.0 + 7e5 * 0.03)
    assert force == pytest.approx((0.0, -0.6 * size, -0.8 * size), rel=1e-14)


def test_gas_momentum_is_that_of_api_520() -> None:
    """F = W/366 sqrt(k T/((k + 1) M)) lbf: 7750 for 418 950 lb/h, 1.3, 1460 R, 18.

    Scribd 356478068 (G. Woods); 366 for 367.3 is 0.35 % high.
    """
    flow = 418950.0 * LB / 3600.0
    velocity, _ = gas_exit(flow, 1.0, 1460.0 / 1.8, 18.0, 1.3)
    assert flow * velocity / LBF == pytest.approx(7750.0 * 366.0 / 367.3, rel=5e-4)
    # 129 W sqrt(k T/((k + 1) M)) N, in SI
    assert velocity == pytest.approx(129 * math.sqrt(1.3 * 811.1 / (2.3 * 18.0)), rel=5e-4)


def test_gas_leaves_at_the_speed_of_sound_of_its_own_state() -> None:
    flow, area, t0, m, k = 20.0, 0.02, 400.0, 28.97, 1.4
    velocity, pressure = gas_exit(flow, area, t0, m, k)
    density = flow / area / velocity
    assert velocity**2 == pytest.approx(k * pressure / density, rel=1e-13)
    t = t0 * 2.0 / (k + 1.0)
    assert pressure == pytest.approx(density * 8314.46 / m * t, rel=1e-13)


def test_dynamic_load_factor_is_the_worst_of_a_mass_under_a_ramp() -> None:
    period = 0.2
    omega = 2 * math.pi / period
    for r in (0.1, 0.3, 0.5, 1.5, 2.5):
        rise = r * period
        t = np.linspace(0.0, rise + 2 * period, 40_001)
        ramp = (t - np.sin(omega * t) / omega) / rise
        after = 1 + (np.sin(omega * (t - rise)) - np.sin(omega * t)) / (omega * rise)
        largest = np.where(t <= rise, ramp, after).max()
        assert dynamic_load_factor(rise, period) == pytest.approx(largest, rel=1e-6)


def test_dynamic_load_factor_falls_from_2_to_its_least() -> None:
    factors = [dynamic_load_factor(t, 1.0) for t in np.linspace(0.0, 20.0, 400)]
    assert factors[0] == 2.0
    assert factors[-1] == 1.1
    assert all(np.diff(factors) <= 0.0)


def test_installation_period_is_the_formula_in_us_units() -> None:
    weight, height, ei = 800.0, 24.0, 30e6 * 72.5  # lb, in, lb in2
    us = 0.1846 * math.sqrt(weight * height**3 / ei)
    si = installation_period(weight * LB, height * IN, ei * LBF * IN**2)
    assert si == pytest.approx(us, rel=3e-4)  # 0.1846 has four digits


def test_published_slugs_on_a_right_angle() -> None:
    # 3D-Labs, Scribd 409303824: 950 kg/m3, 10.53 m/s, 20169.6 mm2: 2124.7 N each way
    x, y, z = slug(
        density=950.0, area=0.0201696, velocity=10.53, inlet=(1, 0, 0), outlet=(0, 1, 0), dlf=1.0
    )
    assert (x, y, z) == pytest.approx((2124.7, -2124.7, 0.0), abs=0.1)
    # Start-Prof, "How to model slug flow loads": 1000 kg/m3, 12.65 m/s, 0.027465 m2, DLF 2: 8790 N
    x, y, z = slug(
        density=1000.0, area=0.027465, velocity=12.65, inlet=(0, -1, 0), outlet=(0, 0, 1)
    )
    assert (x, y, z) == pytest.approx((0.0, -8790.0, -8790.0), abs=1.0)


@pytest.mark.parametrize("degrees", [30.0, 45.0, 90.0, 180.0])
def test_slug_pair_at_any_angle(degrees: float) -> None:
    a = math.radians(degrees)
    out = (math.cos(a), math.sin(a), 0.0)
    x, y, _ = slug(density=1.0, area=1.0, velocity=1.0, inlet=(2, 0, 0), outlet=out, dlf=1.0)
    assert (x, y) == pytest.approx((1 - math.cos(a), -math.sin(a)), abs=1e-14)
    assert math.hypot(x, y) == pytest.approx(math.sqrt(2 * (1 - math.cos(a))), rel=1e-13)


def test_what_cannot_be_is_named() -> None:
    with pytest.raises(ValueError, match="condition DRY is not one of WET SATURATED SUPERHEATED"):
        steam_exit(1.0, 1.0, 3e6, "DRY")
    with pytest.raises(ValueError, match="below"):
        steam_exit(1.0, 1.0, 1e6, "SATURATED")
    with pytest.raises(ValueError, match="jet has no direction"):
        open_discharge(flow=1.0, velocity=1.0, pressure=1e5, area=1.0, jet=(0.0, 0.0, 0.0))
