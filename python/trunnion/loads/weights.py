"""Weight per length of pipes: metal, lining, insulation, contents; and of rigid bodies."""

from dataclasses import fields, replace
from itertools import starmap
from math import pi
from typing import Any

import numpy as np

from trunnion.arrays import F8, SPRING, System
from trunnion.model import Material, Model, Pipe, Section

WATER = 1000.0  # contents of the hydrotest [kg/m3]
RIGID_INSULATION = 1.75  # insulation of a flange or valve, in that of the pipe of its length


def ring(outside: float, thickness: float) -> float:
    """Return the area of a ring, from its thickness: the difference of two circles is rounded."""
    return pi * thickness * (outside - thickness)


def line_masses(section: Section, material: Material) -> tuple[float, float, float, float]:
    """Mass per length [kg/m] of metal and lining, of insulation, of contents and of water."""
    bore = section.od - 2.0 * section.wall
    metal = material.density * ring(section.od, section.wall)
    metal += section.lining_density * ring(bore, section.lining)
    cover = section.od + 2.0 * section.insulation
    insulation = section.insulation_density * ring(cover, section.insulation)
    hollow = 0.25 * pi * (bore - 2.0 * section.lining) ** 2
    return metal, insulation, section.fluid * hollow, WATER * hollow


def line_weights(model: Model, system: System) -> dict[str, F8]:
    """Weight per length of axis (n_elem,) in W, WNC and WW [N/m].

    A rigid spreads its own weight evenly, and carries its contents and 1.75 times the insulation
    of the pipe, as the trade does; a rigid without weight is a construction aid: it has none.
    The extra weight of a section belongs to all three and to rigids with weight.
    """
    g = model.settings.g
    known: dict[tuple[str, str], tuple[float, float, float, float]] = {}
    rows: list[tuple[float, float, float, float]] = []  # own, metal + rest, contents, water
    for pipe in model.pipes:
        key = (pipe.section, pipe.material)
        section = model.sections[pipe.section]
        if key not in known:
            known[key] = line_masses(section, model.materials[pipe.material])
        metal, insulation, fluid, water = known[key]
        if pipe.joint is not None:
            rows.append((0.0,) * 4)  # see `loads.components`
        elif pipe.reducer is not None:
            ends = reducer_weights(model, pipe)
            empty, fluid, water = (mean for mean, *_ in starmap(_legendre, zip(*ends, strict=True)))
            rows.append((0.0, empty, fluid, water))
        elif not pipe.rigid:
            empty = g * (metal + insulation) + section.weight
            rows.append((0.0, empty, g * fluid, g * water))
        elif pipe.weight > 0.0:
            empty = g * RIGID_INSULATION * insulation + section.weight
            rows.append((pipe.weight, empty, g * fluid, g * water))
        else:
            rows.append((0.0,) * 4)
    rows.append((0.0,) * 4)
    own = np.where(system.kind == SPRING, -1, system.source)  # springs, arms of offsets: nothing
    body, empty_row, fluid_row, water_row = np.array(rows)[own].T
    length = np.where(system.length > 0.0, system.length, 1.0)
    empty_row = empty_row + body / length
    return {"WNC": empty_row, "W": empty_row + fluid_row, "WW": empty_row + water_row}


def skews(model: Model, system: System) -> dict[str, F8]:
    """Factors (n_elem, 2) of 2 s - 1 and 6 s2 - 6 s + 1 in the weights of reducers [N/m].

    Every diameter changes linearly along a reducer, so its weight per length is a square function.
    """
    n = len(system.kind) if len(system.taper) else 0
    skew = {name: np.zeros((n, 2)) for name in ("WNC", "W", "WW")}
    for e, i in enumerate(system.source.tolist() if n else ()):
        pipe = model.pipes[i] if i >= 0 else None
        if pipe is None or pipe.reducer is None:
            continue
        empty, fluid, water = zip(*reducer_weights(model, pipe), strict=True)
        rest = [np.array(_legendre(*row)[1:]) for row in (empty, fluid, water)]
        skew["WNC"][e] = rest[0]
        skew["W"][e], skew["WW"][e] = rest[0] + rest[1], rest[0] + rest[2]
    return skew


def reducer_weights(model: Model, pipe: Pipe) -> list[tuple[float, float, float]]:
    """Weight per length, empty, of contents and of water, at both ends and (second) between."""
    assert pipe.reducer is not None
    g, material = model.settings.g, model.materials[pipe.material]
    first, last = model.sections[pipe.section], model.sections[pipe.reducer.section]
    rows = []
    for section in (first, between(first, last), last):
        metal, insulation, fluid, water = line_masses(section, material)
        rows.append((g * (metal + insulation) + section.weight, g * fluid, g * water))
    return rows


def between(first: Section, last: Section) -> Section:
    """Section half way along a reducer: means of all sizes and densities."""
    mean: dict[str, Any] = {
        f.name: 0.5 * (a + b)
        for f in fields(Section)
        if isinstance(a := getattr(first, f.name), float)
        and isinstance(b := getattr(last, f.name), float)
    }
    return replace(first, **mean)


def _legendre(first: float, middle: float, last: float) -> tuple[float, float, float]:
    """Mean, and factors of 2 s - 1 and 6 s2 - 6 s + 1, of a square function of s."""
    mean = (first + 4.0 * middle + last) / 6.0
    return mean, 0.5 * (last - first), 0.5 * (first + last) - mean
