"""What hangs together in a system: names of lines and branches for messages."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import System

Neighbours = list[list[int]]


def neighbours(system: System) -> Neighbours:
    """List the nodes that elements join to each node."""
    near: Neighbours = [[] for _ in system.labels]
    for a, b in system.ends.tolist():
        near[a].append(b)
        near[b].append(a)
    return near


def lines(system: System) -> list[list[int]]:
    """Nodes of each connected line, in rising number; a node without elements is its own line."""
    near = neighbours(system)
    seen = [False] * len(near)
    found: list[list[int]] = []
    for first in range(len(near)):
        if seen[first]:
            continue
        seen[first] = True
        line, ahead = [first], [first]
        while ahead:
            for b in near[ahead.pop()]:
                if not seen[b]:
                    seen[b] = True
                    line.append(b)
                    ahead.append(b)
        found.append(sorted(line))
    return found


def branches(system: System) -> list[list[int]]:
    """Chains of nodes between free ends and junctions, those at both ends included.

    Lines that close on themselves without a junction are one chain that starts and ends at their
    first node.
    """
    near = neighbours(system)
    knots = [n for n, at in enumerate(near) if len(at) not in (0, 2)]
    chains: list[list[int]] = []
    walked: set[tuple[int, int]] = set()  # first and last step of a chain, from its knots
    inside: set[int] = set()
    for knot in [*knots, *(n for n, at in enumerate(near) if len(at) == 2)]:
        if knot in inside:
            continue
        for step in near[knot]:
            if (knot, step) in walked:
                continue
            chain = [knot, step]
            while len(near[chain[-1]]) == 2 and chain[-1] != knot:
                a, b = near[chain[-1]]
                chain.append(b if a == chain[-2] else a)
            walked |= {(knot, step), (chain[-1], chain[-2])}
            inside.update(chain[1:-1])
            chains.append(chain)
    return chains


def line_name(system: System, line: list[int]) -> str:
    """Name a line by its first and its last free end (or node): "line 10-90", "node 20"."""
    if len(line) == 1:
        return f"node {system.labels[line[0]]}"
    count = np.bincount(system.ends.ravel(), minlength=len(system.labels))
    free = [n for n in line if count[n] == 1]
    ends = free if len(free) > 1 else line
    return f"line {system.labels[ends[0]]}-{system.labels[ends[-1]]}"


def branch_name(system: System, chain: list[int]) -> str:
    """Name a branch by its ends: "branch 30-55"."""
    return f"branch {system.labels[chain[0]]}-{system.labels[chain[-1]]}"


def line_of(system: System, node: int) -> str:
    """Name the line that a node belongs to."""
    return next(line_name(system, line) for line in lines(system) if node in line)


def moving_part(system: System, moves: NDArray[np.bool_] | Iterable[bool]) -> str:
    """Name the nodes that move: whole lines, else branches, else nodes ("node 20, node 30").

    Parameters
    ----------
    moves : (n_node,) the node moves (or turns) in the mechanism.
    """
    moving = {n for n, flag in enumerate(moves) if flag}
    names: list[str] = []
    for line in lines(system):
        if moving.issuperset(line):
            names.append(line_name(system, line))
            moving.difference_update(line)
    for chain in branches(system) if moving else ():
        inner = chain[1:-1]
        if inner and moving.issuperset(inner):
            names.append(branch_name(system, chain))
            moving.difference_update(chain)
    names += [f"node {system.labels[n]}" for n in sorted(moving)]
    shown = names if len(names) <= 4 else [*names[:3], f"{len(names) - 3} more"]
    return ", ".join(shown)
