"""Pipes as ribbons: as wide as their diameter, bends as arcs, round where they meet at an angle."""

import numpy as np
from matplotlib.colors import to_rgba
from numpy.typing import NDArray

from trunnion.arrays import F8, SPRING, System
from trunnion.frozen import frozen
from trunnion.report.centreline import Lines, cut, shape
from trunnion.report.plots.drawing import Frame
from trunnion.report.plots.paint import Paint
from trunnion.report.plots.palette import BODY, PIPE, RIM
from trunnion.results.balance import end_axes

Index = NDArray[np.intp]

POINTS = 24_000  # of all elements together, about: what a picture can show
PARTS = 20  # of a straight pipe
JOINT = 0.75  # radius of an expansion joint, of that of its pipes
FINE, COARSE = 5.0, 15.0  # degrees of a part of a bend; of large models
LEAST = 1.1  # half of the least width [pt]
SEEN = 1.4  # half width from which on the gap at a corner would be seen [pt]
SEAM = 0.9  # width of the edges that close the seams between parts [pt]
OUTLINE = 1.05  # around pipes [pt]
STRAIGHT_ON = 0.02  # sum of two unit tangents that leave a node: less is no corner


@frozen(eq=False)
class Course:
    """Points of the centre lines of a model with what a picture needs of them.

    at : (n, 3) places [m].  radius : (n,) [m]; 0 of springs.
    """

    lines: Lines
    at: F8
    radius: F8

    @property
    def parts(self) -> Index:
        """(n_part,) points after which a part of a line follows."""
        last = self.lines.first[1:] - 1
        keep = np.ones(len(self.at), bool)
        keep[last] = False
        return np.flatnonzero(keep)


def course(system: System) -> Course:
    """Cut a model into parts fit for a picture."""
    room = POINTS // max(len(system.kind), 1) - 1
    lines = cut(system, int(np.clip(room, 1, PARTS)), FINE if room > PARTS else COARSE)
    at, _, radius = shape(system, lines)
    return Course(lines, at, np.where(radius > 0.0, radius, _joints(system)[lines.element]))


def _joints(system: System) -> F8:
    """(n_elem,) radius of expansion joints: a little less than the pipes that they join."""
    widest = np.zeros(len(system.labels))
    for end in (0, 1):
        np.maximum.at(widest, system.ends[:, end], 0.5 * system.od)
    joint = (system.kind == SPRING) & (system.length > 0.0)
    found: F8 = np.where(joint, JOINT * widest[system.ends].min(axis=1), 0.0)
    return found


def paint_pipes(
    paint: Paint,
    frame: Frame,
    system: System,
    found: Course,
    at: F8,
    faces: F8,
    *,
    rim: str = RIM,
) -> None:
    """Add the pipes of a model.

    Parameters
    ----------
    at : (n, 3) places of the points, displaced or not [m].
    faces : (n_part, 4) colours of the parts.
    """
    flat, depth, parts = frame.flat(at), frame.view.depth(at), found.parts
    if not len(parts):
        return
    half = half_widths(frame, found.radius)
    normal = _normals(flat, parts, _joins(system, found.lines))
    outline = OUTLINE * frame.scale
    shade = np.tile(to_rgba(rim), (len(parts), 1))
    middle = 0.5 * (depth[parts] + depth[parts + 1])
    both = np.empty((2 * len(parts), 4, 2))
    both[0::2] = _quads(flat, normal, half + outline, parts)
    both[1::2] = _quads(flat, normal, half, parts)
    colours = np.empty((2 * len(parts), 4))
    colours[0::2], colours[1::2] = shade, faces
    paint.add(both, colours, np.repeat(middle, 2), colours, np.tile([0.0, SEAM], len(parts)))
    _corners(paint, frame, system, found, at, half, faces, shade[0])


def half_widths(frame: Frame, radius: F8) -> F8:
    """(n,) half widths on paper [m]: the pipe's own, or what can be seen; springs are thin."""
    least = np.where(radius > 0.0, LEAST, 0.5 * LEAST) * frame.scale
    found: F8 = np.maximum(radius, least)
    return found


def plain_faces(system: System, found: Course, pipe: str = PIPE, body: str = BODY) -> F8:
    """(n_part, 4) colours by what an element is: pipe, or stiff body and spring."""
    stiff = np.array([p.type not in ("pipe", "bend", "reducer") for p in system.parts], bool)
    stiff |= system.kind == SPRING
    colour = np.array([to_rgba(pipe), to_rgba(body)])
    own: F8 = colour[stiff.astype(int)[found.lines.element[found.parts]]]
    return own


def _leaving(system: System) -> tuple[F8, Index]:
    """(n_node, 3) sum of the unit tangents that leave each node; (n_node,) how many do."""
    out = end_axes(system)[:, :, 0] * np.array([1.0, -1.0])[:, None]
    total, count = np.zeros((len(system.labels), 3)), np.zeros(len(system.labels), np.intp)
    np.add.at(total, system.ends.ravel(), out.reshape(-1, 3))
    np.add.at(count, system.ends.ravel(), 1)
    return total, count


def _joins(system: System, lines: Lines) -> Index:
    """(n, 2, 2) pairs of line ends that go straight on at a node: point, and +1 where it begins.

    Ends of a line that begins at a node are +1, of one that ends there -1.
    """
    total, count = _leaving(system)
    on = (count == 2) & (np.linalg.norm(total, axis=1) <= STRAIGHT_ON)
    node = system.ends.ravel()
    order = np.argsort(node, kind="stable")
    order = order[on[node[order]]].reshape(-1, 2)
    points = np.stack([lines.first[:-1], lines.first[1:] - 1], axis=1).ravel()
    signs = np.tile([1, -1], len(system.ends))
    return np.stack([points[order], signs[order]], axis=2)


def _normals(flat: F8, parts: Index, joins: Index) -> F8:
    """(n, 2) unit normals on paper, halfway between the parts that meet at a point.

    Where one line goes on in another both have the normal between them, or a slit would show.
    """
    step = flat[parts + 1] - flat[parts]
    length = np.linalg.norm(step, axis=1, keepdims=True)
    step = np.divide(step, length, out=np.zeros_like(step), where=length > 0.0)
    tangent = np.zeros_like(flat)
    np.add.at(tangent, parts, step)
    np.add.at(tangent, parts + 1, step)
    point, sign = joins[..., 0], joins[..., 1]
    away = tangent[point] * sign[..., None]
    along = away[:, 0] - away[:, 1]
    tangent[point[:, 0]] = along * sign[:, :1]
    tangent[point[:, 1]] = -along * sign[:, 1:]
    size = np.linalg.norm(tangent, axis=1, keepdims=True)
    tangent = np.divide(tangent, size, out=np.zeros_like(tangent), where=size > 1e-12)
    normal: F8 = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    return normal


def _quads(flat: F8, normal: F8, half: F8, parts: Index) -> F8:
    """(n_part, 4, 2) corners of the parts."""
    left, right = flat + half[:, None] * normal, flat - half[:, None] * normal
    found: F8 = np.stack([left[parts], left[parts + 1], right[parts + 1], right[parts]], axis=1)
    return found


_ROUND = np.linspace(0.0, 2.0 * np.pi, 20, endpoint=False)
_CIRCLE = np.stack([np.cos(_ROUND), np.sin(_ROUND)], axis=1)


def _corners(
    paint: Paint,
    frame: Frame,
    system: System,
    found: Course,
    at: F8,
    half: F8,
    faces: F8,
    rim: F8,
) -> None:
    """Add discs where lines meet at an angle, and for lines that point at the reader."""
    lines, n_elem = found.lines, len(system.kind)
    ends = np.stack([lines.first[:-1], lines.first[1:] - 1], axis=1)
    part = np.stack([lines.first[:-1], lines.first[1:] - 2], axis=1) - np.arange(n_elem)[:, None]
    total, count = _leaving(system)
    bent = (count > 2) | ((count == 2) & (np.linalg.norm(total, axis=1) > STRAIGHT_ON))
    flat, depth = frame.flat(at), frame.view.depth(at)
    on_end = np.linalg.norm(flat[ends[:, 1]] - flat[ends[:, 0]], axis=1) < 0.5 * frame.scale
    wide = half[ends]
    pick = (bent[system.ends] | on_end[:, None]).ravel()
    pick &= (half[ends] > SEEN * frame.scale).ravel()
    if not pick.any():
        return
    where, width = flat[ends.ravel()[pick]], wide.ravel()[pick]
    near = depth[ends.ravel()[pick]]
    colour = faces[part.ravel()[pick]]
    grow = OUTLINE * frame.scale
    step = np.abs(depth[found.parts + 1] - depth[found.parts])[part.ravel()[pick]]
    for radius, paints, shift in (
        (width + grow, np.tile(rim, (len(where), 1)), -1),
        (width, colour, 1),
    ):
        discs = where[:, None] + radius[:, None, None] * _CIRCLE
        beyond = 0.51 * step + width + grow  # the parts that a disc covers lie within
        paint.add(discs, paints, near + shift * beyond, paints, 0.0)
