"""Mass of a model for natural modes: along its pipes, of their sections, concentrated."""

from dataclasses import replace
from math import pi

import numpy as np

from trunnion.arrays import F8, I4, System
from trunnion.frozen import frozen
from trunnion.loads.components import joint_weights
from trunnion.loads.movements import node_numbers
from trunnion.loads.weights import between, line_weights
from trunnion.model import Material, Model, Pipe, Section


@frozen(eq=False)
class Masses:
    """What moves.

    line : (n_elem,) mass per length of axis, contents included [kg/m].
    inertia : (n_elem, 2) rotary inertia of the section per length, about the pipe's axis and
        across it [kg m].
    lump : (n_node,) concentrated masses [kg].
    """

    line: F8
    inertia: F8
    lump: F8

    def parted(self, part_of: I4, n_node: int) -> "Masses":
        """Give the masses of elements cut in parts; `part_of` tells whose each part is."""
        lump = np.concatenate((self.lump, np.zeros(n_node - len(self.lump))))
        return Masses(self.line[part_of], self.inertia[part_of], lump)

    def without_rotary(self, *, torsion: bool) -> "Masses":
        """Leave the sections' rotary inertia out; `torsion` keeps that about the pipe's axis."""
        return replace(self, inertia=self.inertia * np.array([float(torsion), 0.0]))


def model_masses(model: Model, system: System) -> Masses:
    """Masses of a model: all that weighs in W, and its MASS cards."""
    line = line_weights(model, system)["W"] / model.settings.g
    known: dict[tuple[str, str, bool, float], tuple[float, float]] = {}
    rows: list[tuple[float, float]] = []
    for pipe in model.pipes:
        key = (pipe.section, pipe.material, pipe.rigid, pipe.weight)
        if pipe.joint or pipe.reducer:
            rows.append(_component_inertia(model, pipe))
            continue
        if key not in known:
            section, material = model.sections[pipe.section], model.materials[pipe.material]
            known[key] = _section_inertia(pipe, section, material)
        rows.append(known[key])
    rows.append((0.0, 0.0))
    inertia = np.array(rows)[system.source]
    bodies = np.array([pipe.weight if pipe.rigid else 0.0 for pipe in model.pipes] + [0.0])
    length = np.where(system.length > 0.0, system.length, 1.0)
    own = bodies[system.source] / model.settings.g / length
    across = own * (system.od**2 + (system.od - 2.0 * system.wall) ** 2) / 16.0
    inertia = inertia + across[:, None] * np.array([2.0, 1.0])
    lump = joint_weights(model, system)["W"] / model.settings.g
    node = node_numbers(system)
    for mass in model.masses:
        lump[node[mass.node]] += mass.mass
    return Masses(line, np.ascontiguousarray(inertia), lump)


def _component_inertia(model: Model, pipe: Pipe) -> tuple[float, float]:
    """Rotary inertia of a reducer half way along it; an expansion joint has none."""
    if pipe.reducer is None:
        return 0.0, 0.0
    ends = (model.sections[name] for name in (pipe.section, pipe.reducer.section))
    return _section_inertia(pipe, between(*ends), model.materials[pipe.material])


def _section_inertia(pipe: Pipe, section: Section, material: Material) -> tuple[float, float]:
    """Rotary inertia per length about the axis and across it [kg m].

    Contents follow the pipe where it bends and stay where it twists.  The body of a rigid comes
    apart; the extra weight of a section has no size.
    """
    if pipe.rigid and pipe.weight <= 0.0:
        return 0.0, 0.0
    bore = section.od - 2.0 * section.wall
    free = bore - 2.0 * section.lining
    cover = section.od + 2.0 * section.insulation
    metal = 0.0 if pipe.rigid else material.density * _second(section.od, bore)
    solid = metal + section.insulation_density * _second(cover, section.od)
    if not pipe.rigid:
        solid += section.lining_density * _second(bore, free)
    return 2.0 * solid, solid + section.fluid * _second(free, 0.0)


def _second(outside: float, inside: float) -> float:
    """Second moment of area of a ring [m4]."""
    return pi / 64.0 * (outside**4 - inside**4)
