"""Occasional loads, modes, spectra, cases and cycles as cards."""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from trunnion.deck.expressions import format_case, format_expression
from trunnion.model import Case, Comb, Cycle, Group, Modes, Settings, Snow, Spectrum, Wind

Pair = tuple[str, str]
Keys = Callable[..., list[Pair]]  # of a keyword and the values of its keys


def card(keyword: str, args: Iterable[str], keys: Iterable[Pair] = ()) -> str:
    """Write one card."""
    words = [*args, *(f"{key}={value}" for key, value in keys)]
    return f"{keyword:<8} {' '.join(words)}".rstrip()


def wind_card(wind: Wind, keys: Keys) -> Iterator[str]:
    """Write a wind set; a table is one of pressures."""
    usual = Wind("", (1.0, 0.0, 0.0))
    values: dict[str, Any] = {"DIR": wind.direction, "PRESSURE": wind.table or None}
    values["ASCE7"] = wind.speed
    for name in ("exposure", "kzt", "kd", "gust", "shape", "ground"):
        value = getattr(wind, name)
        if value != getattr(usual, name):
            values[name.upper()] = value
    yield card("WIND", ["WIND" + wind.set], keys("WIND", values))


def snow_card(snow: Snow, number: Callable[[float, str], str]) -> Iterator[str]:
    """Write snow."""
    yield card("SNOW", [number(snow.weight, "line load")])


def spectrum_card(spectrum: Spectrum, keys: Keys) -> str:
    """Write a spectrum in m/s2 against frequency, or against period where that matters."""
    points = list(zip(spectrum.frequency, spectrum.acceleration, strict=True))
    if spectrum.by_period:
        points = [(_period(f), a) for f, a in reversed(points)]
    values = {
        "X": "PERIOD" if spectrum.by_period else None,
        "Y": "M/S2",
        "INTERP": None if spectrum.log else "LINEAR",
        "TABLE": points,
    }
    return card("SPECTRUM", [spectrum.name], keys("SPECTRUM", values))


def _period(frequency: float) -> float:
    """Find the period whose frequency this is, to the last bit if there is one."""
    guess = 1.0 / frequency
    near = [guess, *(math.nextafter(guess, end) for end in (0.0, math.inf))]
    return next((x for x in near if 1.0 / x == frequency), guess)


def group_card(group: Group) -> str:
    """Write a group of supports."""
    return card("GROUP", [group.name, "=", ", ".join(group.nodes)])


def modes_card(modes: Modes, keys: Keys) -> str:
    """Write what modes are asked for."""
    usual = Modes(modes.n)
    values: dict[str, Any] = {
        name.upper(): getattr(modes, name)
        for name in ("fmax", "about", "mass", "mesh", "friction")
        if getattr(modes, name) != getattr(usual, name)
    }
    if not modes.rotary:
        values["ROTARY"] = "OFF"
    return card("MODES", [str(modes.n)], keys("MODES", values))


def case_card(case: Case | Comb, keys: Keys, settings: Settings) -> str:
    """Write a case or combination."""
    if isinstance(case, Comb):
        return card("COMB", [case.name, "=", format_expression(case.expression)])
    words = [case.name, "=", format_case(case)]
    written = keys("CASE", _case_keys(case))
    if case.spectrum is not None:
        written += keys("CASE", _spectrum_keys(case, settings))
    text = card("CASE", words, written)
    return f"{text} NONLINEAR" if case.nonlinear else text


def _case_keys(case: Case) -> dict[str, Any]:
    return {
        "FROM": case.start,
        "ABOUT": case.about,
        "ON": case.on,
        "STEPS": case.steps if case.steps != 1 else None,
        "MUX": case.mux if case.mux != 1.0 else None,
        "E": "HOT" if case.hot else None,
        "EVENTS": None if case.events is None else ("OFF", "ON")[case.events],
        "ITERATION": case.iteration,
        "SNUBBERS": case.snubbers,
    }


def _spectrum_keys(case: Case, settings: Settings) -> dict[str, Any]:
    use = case.spectrum
    assert use is not None
    return {
        "MODAL": use.modal if use.modal != "SRSS" else None,
        "SPATIAL": use.spatial if use.spatial != "SRSS" else None,
        "GROUPS": use.groups if use.groups != "ABS" else None,
        "FIRST": use.first if use.first != "MODES" else None,
        "DAMPING": use.damping if use.damping != 0.02 else None,
        "DURATION": use.duration if use.duration != 10.0 else None,
        "ZPA": None if use.zpa is None else _in_g(use.zpa, settings.g),
        "MISSING": "ON" if use.missing_mass else None,
    }


def _in_g(acceleration: float, g: float) -> float:
    """Find the number that times g is this acceleration, the one with fewest digits."""
    guess = acceleration / g
    for digits in (15, 16, 17):
        short = float(f"{guess:.{digits}g}")
        if short * g == acceleration:
            return short
    near = (math.nextafter(guess, end) for end in (0.0, math.inf))
    return next((x for x in near if x * g == acceleration), guess)


def cycle_card(cycle: Cycle, keys: Keys) -> str:
    """Write a cycle."""
    words = [cycle.name, "=", ", ".join(cycle.cases)]
    return card("CYCLE", words, keys("CYCLE", {"TIMES": cycle.times, "FROM": cycle.start}))
