"""The pipe's own axis at a node, for GUIDE and LIMIT."""

from collections.abc import Mapping

import numpy as np

from trunnion.arrays import SPRING, Part
from trunnion.model import Model
from trunnion.system.bends import pipe_name
from trunnion.system.elements import Elements
from trunnion.system.vectors import Vec, cross, size

COLLINEAR = 1e-3  # pipes that turn by less than this at a node count as one line [rad]


class PipeAxes:
    """Tangents of the pipes at the nodes where a support asks for them."""

    def __init__(
        self,
        model: Model,
        elements: Elements,
        parts: tuple[Part, ...],
        index: Mapping[str, int],
        up: Vec,
    ) -> None:
        self.up = up
        self._index = index
        labels = {
            s.node for s in model.supports for d in s.directions if d.word in ("GUIDE", "LIMIT")
        }
        self._at: dict[int, list[tuple[tuple[str, ...], Vec]]] = {index[x]: [] for x in labels}
        if not labels:
            return
        asked = np.array(sorted(self._at))
        hits = np.argwhere(np.isin(elements.ends, asked) & (elements.kind != SPRING)[:, None])
        tangents = elements.tangents()[hits[:, 0], hits[:, 1]].tolist()
        nodes = elements.ends[hits[:, 0], hits[:, 1]].tolist()
        for (e, _), node, t in zip(hits.tolist(), nodes, tangents, strict=True):
            part = parts[e]
            names = [f"{part.start}-{part.end}"]
            if part.type != "bend":
                names.insert(0, pipe_name(model.pipes[elements.source[e]]))
            self._at[node].append((tuple(names), (t[0], t[1], t[2])))

    def at(self, label: str, along: str | None) -> Vec:
        """Axis of the pipe at a node; `along` ("30-40") chooses where pipes do not line up."""
        pipes = self._at[self._index[label]]
        names = ", ".join(names[0] for names, _ in pipes)
        if not pipes:
            raise ValueError(f"there is no pipe at node {label}")
        if along is not None:
            wanted = {along, "-".join(reversed(along.split("-")))}
            for known, axis in pipes:
                if wanted & set(known):
                    return axis
            raise ValueError(f"ALONG={along} is not a pipe at node {label}; there are {names}")
        axis = pipes[0][1]
        if any(size(cross(axis, other)) > COLLINEAR for _, other in pipes[1:]):
            raise ValueError(f"the pipes at node {label} turn there; say ALONG= one of {names}")
        return axis
