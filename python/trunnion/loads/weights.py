"""Weight per length of pipes: metal, lining, insulation, contents; and of rigid bodies."""

from math import pi

import numpy as np

from trunnion.arrays import F8, System
from trunnion.model import Material, Model, Section

WATER = 1000.0  # contents of the hydrotest [kg/m3]
RIGID_INSULATION = 1.75  # insulation of a flange or valve, in that of the pipe of its length


def ring(outside: float, inside: float) -> float:
    """Return the area between two diameters."""
    return 0.25 * pi * (outside - inside) * (outside + inside)


def line_masses(section: Section, material: Material) -> tuple[float, float, float, float]:
    """Mass per length [kg/m] of metal and lining, of insulation, of contents and of water."""
    bore = section.od - 2.0 * section.wall
    free = bore - 2.0 * section.lining
    metal = material.density * ring(section.od, bore) + section.lining_density * ring(bore, free)
    cover = section.od + 2.0 * section.insulation
    insulation = section.insulation_density * ring(cover, section.od)
    hollow = ring(free, 0.0)
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
        if not pipe.rigid:
            empty = g * (metal + insulation) + section.weight
            rows.append((0.0, empty, g * fluid, g * water))
        elif pipe.weight > 0.0:
            empty = g * RIGID_INSULATION * insulation + section.weight
            rows.append((pipe.weight, empty, g * fluid, g * water))
        else:
            rows.append((0.0,) * 4)
    rows.append((0.0,) * 4)
    body, empty_row, fluid_row, water_row = np.array(rows)[system.source].T
    length = np.where(system.length > 0.0, system.length, 1.0)
    empty_row = empty_row + body / length
    return {"WNC": empty_row, "W": empty_row + fluid_row, "WW": empty_row + water_row}
