"""Painter's order: polygons of everything solid, drawn from the farthest to the nearest."""

from dataclasses import dataclass, field
from math import sqrt

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba
from numpy.typing import NDArray

from trunnion.arrays import F8
from trunnion.report.plots.drawing import Frame

LIGHT = np.array([0.35, 0.85, 0.4])  # on paper: right, up, toward the reader


@dataclass(slots=True)
class Paint:
    """Polygons and wires collected for one drawing, in metres on paper."""

    polygons: list[F8] = field(default_factory=list)
    faces: list[tuple[float, ...]] = field(default_factory=list)
    edges: list[tuple[float, ...]] = field(default_factory=list)
    widths: list[float] = field(default_factory=list)
    depths: list[float] = field(default_factory=list)
    wires: list[F8] = field(default_factory=list)
    wire_colours: list[tuple[float, ...]] = field(default_factory=list)
    wire_widths: list[float] = field(default_factory=list)

    def add(
        self, polygons: F8 | list[F8], faces: F8, depths: F8, edges: F8, width: float | F8
    ) -> None:
        """Add polygons (n, m, 2) with colours (n, 4), nearness (n,), edge colours, widths."""
        self.polygons.extend(polygons)
        self.faces.extend(map(tuple, faces.tolist()))
        self.edges.extend(map(tuple, edges.tolist()))
        self.widths.extend(np.broadcast_to(width, len(polygons)).tolist())
        self.depths.extend(depths.tolist())

    def solid(
        self, frame: Frame, sides: list[F8], colour: str, *, nearer: float, filled: bool = True
    ) -> None:
        """Add the sides (m, 3) of a convex body that the reader sees, lit from above."""
        middles = [side.mean(axis=0) for side in sides]
        centre = sum(middles[1:], middles[0]) / len(sides)
        view, paint = frame.view, np.array(to_rgba(colour if filled else "#ffffff"))
        depth = float(view.depth(centre)) + nearer
        axes = np.stack([view.right, view.rise, view.toward])
        rim = np.array(to_rgba(colour)) * (0.62, 0.62, 0.62, 1.0) if filled else to_rgba(colour)
        for side, middle in zip(sides, middles, strict=True):
            normal = _normal(side)
            if normal @ (middle - centre) < 0.0:
                normal = -normal
            if normal @ view.toward < 1e-9:
                continue
            lit = max(float(axes @ normal @ LIGHT), 0.0)
            shade = paint.copy()
            shade[:3] = np.clip(paint[:3] * (0.72 + 0.33 * lit), 0.0, 1.0)
            self.polygons.append(view.flat(side))
            self.faces.append(tuple(shade))
            self.edges.append(tuple(rim))
            self.widths.append(0.5 if filled else 0.9)
            self.depths.append(depth)

    def wire(self, points: F8, colour: str, width: float) -> None:
        """Add a line through points (m, 2) on paper; wires lie above all polygons."""
        self.wires.append(points)
        self.wire_colours.append(to_rgba(colour))
        self.wire_widths.append(width)


def _normal(side: F8) -> F8:
    """(3,) unit normal of a flat side; zero of one without area."""
    (a, b, c), (d, e, f) = (side[1] - side[0]).tolist(), (side[2] - side[0]).tolist()
    normal = np.array([b * f - c * e, c * d - a * f, a * e - b * d])
    size = sqrt(float(normal @ normal))
    return normal / size if size > 0.0 else normal


def _ordered(polygons: list[F8], order: NDArray[np.intp]) -> F8 | list[F8]:
    """Sort polygons; those of one number of corners as an array, which is drawn much faster."""
    if len({len(polygon) for polygon in polygons}) == 1:
        found: F8 = np.stack(polygons)[order]
        return found
    return [polygons[i] for i in order]


def draw(frame: Frame, paint: Paint, *, zorder: float = 2.0, clip: bool = True) -> None:
    """Put everything on the frame's axes; what is not clipped may reach beyond them."""
    if paint.polygons:
        order = np.argsort(paint.depths, kind="stable")
        frame.axes.add_collection(
            PolyCollection(
                _ordered(paint.polygons, order),  # type: ignore[arg-type]
                facecolors=[paint.faces[i] for i in order],
                edgecolors=[paint.edges[i] for i in order],
                linewidths=[paint.widths[i] for i in order],
                joinstyle="round",
                zorder=zorder,
                clip_on=clip,
            ),
            autolim=False,
        )
    if paint.wires:
        frame.axes.add_collection(
            LineCollection(
                paint.wires,
                colors=paint.wire_colours,
                linewidths=paint.wire_widths,
                capstyle="round",
                joinstyle="round",
                zorder=zorder + 0.1,
                clip_on=clip,
            ),
            autolim=False,
        )
