"""Arrays of elements: axes, lengths, rigidities, factors of bends."""

from math import cos, pi, sin

import numpy as np

from trunnion.arrays import F8, I4, SPRING, TAPER
from trunnion.frozen import frozen
from trunnion.model import Joint, Material, Model, Section
from trunnion.system.bends import Corner, flexibility, stiffening_pressure
from trunnion.system.geometry import Geometry
from trunnion.system.numbering import Numbering
from trunnion.system.vectors import AXES, Vec, add, cross, dot, scale, size, sub, unit, upright

CONCENTRIC = 1e-9  # offset of a reducer below this part of its length is round-off
RIGID_WALL = 10.0  # wall of a rigid in walls of its pipe, at the same inside diameter
_VERTICAL = 1e-6  # as in vectors.upright


@frozen(eq=False)
class Elements:
    """The element arrays of a System, under the same names."""

    ends: I4
    kind: I4
    source: I4
    axes: F8
    length: F8
    radius: F8
    angle: F8
    rigidity: F8
    flex: F8
    spring: F8
    od: F8
    wall: F8
    taper: F8

    def tangents(self) -> F8:
        """Return unit tangents (n_elem, 2, 3) along the element at its ends."""
        ex, ey = self.axes[:, 0], self.axes[:, 1]
        turn = self.angle[:, None]
        return np.stack([ex, np.cos(turn) * ex + np.sin(turn) * ey], axis=1)


def build_elements(
    model: Model, geometry: Geometry, numbering: Numbering, xyz: F8, up: Vec
) -> Elements:
    """Describe the rows of `numbering` by arrays."""
    rows = numbering.rows
    n = len(rows.names)
    start, end, kind, source = (
        np.array(column, dtype=np.int32)
        for column in (rows.start, rows.end, rows.kind, rows.source)
    )
    ends = np.stack([start, end], axis=1)
    run = _runs(model, geometry, xyz, ends, source)
    length = np.linalg.norm(run, axis=1)
    axes = straight_axes(run, length, up)
    radius, angle, flex, spring = np.zeros(n), np.zeros(n), np.ones(n), np.zeros((n, 6))
    for e, (bend, first, last) in rows.arcs.items():
        c = geometry.corners[bend]
        axes[e] = _arc_axes(c, first * c.angle)
        radius[e], angle[e] = c.radius, (last - first) * c.angle
        length[e] = radius[e] * angle[e]
        flex[e] = _flex(model, c)
    springs = np.flatnonzero((kind == SPRING) & (source < 0)).tolist()
    for e, record in zip(springs, model.springs, strict=True):
        axes[e] = AXES if record.axis is None else upright(unit(record.axis), up)
        spring[e] = record.k
        length[e] = 0.0
    for e in np.flatnonzero((kind == SPRING) & (source >= 0)).tolist():
        joint = model.pipes[source[e]].joint
        if joint is None:  # the rigid arm of an offset
            axes[e], length[e] = AXES, 0.0
            spring[e] = np.repeat((model.settings.k, model.settings.kr), 3)
            continue
        if joint.axis is not None or not length[e] > 0.0:
            axes[e] = upright(unit(joint.axis or AXES[0]), up)
        spring[e] = joint_rates(joint, float(length[e]), model)
    taper = _tapers(model, np.flatnonzero(kind == TAPER).tolist(), source, run, axes, length)
    values = np.where((kind == SPRING)[:, None], 0.0, _properties(model)[source])
    return Elements(
        ends=ends,
        kind=kind,
        source=source,
        axes=axes,
        length=length,
        radius=radius,
        angle=angle,
        rigidity=np.ascontiguousarray(values[:, :4]),
        flex=flex,
        spring=spring,
        od=values[:, 4].copy(),
        wall=values[:, 5].copy(),
        taper=taper,
    )


def joint_rates(joint: Joint, length: float, model: Model) -> tuple[float, ...]:
    """Stiffnesses of an expansion joint at its middle, along and across its axis [N/m, N m/rad].

    The bellows is a uniform beam: V = lateral rate times offset with its ends kept parallel, 12
    EI/L3, and M = bending rate times relative rotation, EI/L.  About the middle of a uniform beam
    the two do not couple, so one follows from the other: bending = lateral L2/12.
    """
    lateral, bending = joint.lateral, joint.bending
    if lateral is None and bending is not None and length > 0.0:
        lateral = 12.0 * bending / length**2
    elif bending is None and lateral is not None and length > 0.0:
        bending = lateral * length**2 / 12.0
    k, kr = model.settings.k, model.settings.kr
    lateral = k if lateral is None else lateral
    bending = kr if bending is None else bending
    torsion = kr if joint.torsion is None else joint.torsion
    return joint.axial, lateral, lateral, torsion, bending, bending


def _tapers(model: Model, at: list[int], source: I4, run: F8, axes: F8, length: F8) -> F8:
    """Second ends of reducers; of eccentric ones the axes and the length along the pipes' axis."""
    if not at:
        return np.zeros((0, 3))
    taper = np.zeros((len(length), 3))
    for e in at:
        reducer = model.pipes[source[e]].reducer
        assert reducer is not None
        section = model.sections[reducer.section]
        taper[e, :2] = section.od, section.wall
        if reducer.axis is None:
            continue
        ex, d = unit(reducer.axis), tuple(run[e].tolist())
        along = dot(ex, d)
        aside = sub(d, scale(along, ex))
        offset = size(aside)
        if offset > CONCENTRIC * along:
            ey = unit(sub(aside, scale(dot(aside, ex), ex)))
            axes[e] = ex, ey, cross(ex, ey)
            taper[e, 2], length[e] = offset, along
    return taper


def straight_axes(run: F8, length: F8, up: Vec) -> F8:
    """Axes (n, 3, 3) of members along `run`; the rule of `vectors.upright`, vectorised."""
    ex = run / np.where(length > 0.0, length, 1.0)[:, None]
    ez = np.cross(ex, np.array(up))
    side = np.linalg.norm(ez, axis=1)
    upwards = side < _VERTICAL
    ez[upwards] = np.cross(ex[upwards], np.array(AXES[0]))
    ez /= np.where(length > 0.0, np.linalg.norm(ez, axis=1), 1.0)[:, None]
    return np.stack([ex, np.cross(ez, ex), ez], axis=1)


def _runs(model: Model, geometry: Geometry, xyz: F8, ends: I4, source: I4) -> F8:
    """Vectors from end to end.

    What the deck says is taken as it is, less the tangents of bends: the difference of large
    coordinates would cost digits.  Only a pipe that closes a loop not quite takes its nodes.
    """
    run = xyz[ends[:, 1]] - xyz[ends[:, 0]]
    taken = [0.0] * len(model.pipes)
    for c in geometry.corners.values():
        taken[c.legs.near] += c.tangent
        taken[c.legs.far] += c.tangent
    missing = (np.nan,) * 3  # as for springs, the last row
    given = np.array([*(p.delta or missing for p in model.pipes), missing], dtype=np.float64)
    full = np.linalg.norm(given, axis=1)
    left = 1.0 - np.append(taken, 0.0) / np.where(full > 0.0, full, np.inf)
    said = (given * left[:, None])[source]
    extent = float(np.ptp(xyz, axis=0).max()) if len(xyz) else 0.0
    tolerance = 1e-12 * (extent + float(np.abs(xyz).max(initial=0.0)))
    agree = np.linalg.norm(run - said, axis=1) <= tolerance  # False for nan
    return np.where(agree[:, None], said, run)


def _arc_axes(c: Corner, turned: float) -> tuple[Vec, Vec, Vec]:
    ex = add(scale(cos(turned), c.a), scale(sin(turned), c.c))
    ey = add(scale(cos(turned), c.c), scale(-sin(turned), c.a))
    return ex, ey, cross(ex, ey)


def _flex(model: Model, c: Corner) -> float:
    pipe = model.pipes[c.legs.near]
    section, material = model.sections[pipe.section], model.materials[pipe.material]
    pressure = stiffening_pressure(model.settings, pipe)
    return flexibility(c.legs.bend, c.radius, section, material, pressure)


def _properties(model: Model) -> F8:
    """EA, GJ, EI, GAs, od, wall of each pipe; the last row is for springs, all zero."""
    shear = model.settings.shear
    keys = [(pipe.section, pipe.material, pipe.rigid) for pipe in model.pipes]
    known: dict[tuple[str, str, bool], tuple[float, ...]] = {}
    joints = {i for i, pipe in enumerate(model.pipes) if pipe.joint}
    for key in set(keys):
        section, material = model.sections[key[0]], model.materials[key[1]]
        known[key] = section_rigidity(section, material, rigid=key[2], shear=shear)
    rows = np.array([*map(known.__getitem__, keys), (0.0,) * 6])
    rows[list(joints)] = 0.0  # an expansion joint is a spring
    return rows


def section_rigidity(
    section: Section, material: Material, *, rigid: bool, shear: bool
) -> tuple[float, ...]:
    """EA [N], GJ, EI [N m2], GAs [N] with shear area A/2, od and wall [m] of a pipe."""
    bore = section.od - 2.0 * section.wall
    wall = section.wall * (RIGID_WALL if rigid else 1.0)
    od = bore + 2.0 * wall
    area = pi * wall * (od - wall)  # differences of powers would cost a thin wall its digits
    second = area / 16.0 * (od**2 + bore**2)
    e, g = material.e, 0.5 * material.e / (1.0 + material.nu)
    return e * area, g * 2.0 * second, e * second, 0.5 * g * area if shear else 0.0, od, wall
