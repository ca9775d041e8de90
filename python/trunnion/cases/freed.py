"""Anchors that the design of spring hangers frees vertically while the weight is balanced.

A hanger beside a nozzle shall carry the weight that the nozzle would take: its node is let go
upwards and downwards in the weight case of the design, and in no other.
"""

from dataclasses import replace

from trunnion.model import Direction, Displacement, Model, Support

_AXES = "XYZ"


def freed(model: Model) -> Model:
    """Give the model of the weight case: what FREE= of its hangers names is free vertically."""
    nodes = {n for s in model.supports if s.design is not None for n in s.design.freed}
    if not nodes:
        return model
    up = model.settings.up
    return replace(
        model,
        supports=[_support(s, up) if s.node in nodes else s for s in model.supports],
        displacements=[_moved(d, up) if d.node in nodes else d for d in model.displacements],
    )


def _support(s: Support, up: str) -> Support:
    """Give a support without its vertical direction; one with no other becomes nothing."""
    if s.kind == "anchor":
        moves = [Direction(a, k=s.k, mu=0.0) for a in _AXES if a != up]
        turns = [Direction(f"R{a}", k=s.kr) for a in _AXES]
        return replace(s, kind="support", directions=(*moves, *turns), k=None, kr=None)
    if s.kind != "support":
        return s
    kept = tuple(d for d in s.directions if d.word.lstrip("+-") != up)
    if kept:
        return replace(s, directions=kept)
    return Support(s.node, "hanger", (), s.cnode, s.name, 0.0, place=s.place)


def _moved(d: Displacement, up: str) -> Displacement:
    """Give an imposed displacement that holds nothing vertically."""
    return replace(d, d=tuple(None if i == _AXES.index(up) else x for i, x in enumerate(d.d)))
