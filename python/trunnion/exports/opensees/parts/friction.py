"""Friction elements of OpenSees itself, beside the friction that is held.

`zeroLengthContactASDimplex` has the law of a resting support: k_p, k_f, mu, sliding from where the
pipe lay.  A support that is closed on either side has two of them, a gap is a ground that stands
back.  Where a support follows another law (one slider for several directions, all round a riser)
or stands on another node, or a case begins after another, they are not tried.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from trunnion.exports.opensees.parts.frame import Frame
from trunnion.exports.opensees.parts.loads import add_loads
from trunnion.exports.opensees.parts.structure import add_elements, add_supports
from trunnion.exports.opensees.parts.vectors import Vector

PATIENCE = 60  # iterations
SETTLED = 1e-2  # norm out of balance [N, N m]: their tangent is a quotient of differences


def try_friction(job: Mapping[str, Any], name: str, held: Mapping[Any, Vector]) -> dict[str, Any]:
    """Solve a case with OpenSees' friction elements, from rest and from the answer held.

    Returns
    -------
    how far (of the largest movement) their answers are from that one, begun at `rest` and there
    (`kept`, of one step only); None where there is none.  Or `not_tried`: the supports (or what
    else) that keep them from being used.
    """
    case = job["cases"][name]
    cards = [job["cards"][rub["card"]] for rub in case["rubs"]]
    odd = [c[1] for rub, c in zip(case["rubs"], cards, strict=True) if not is_plain(rub, c)]
    if odd or not case["steps"]:
        return {"not_tried": ", ".join(odd) or "the case begins after another, or at events"}
    rest = _distance(job, case, held, {})
    return {"rest": rest, "kept": _distance(job, case, held, held) if case["steps"] == 1 else None}


def is_plain(rub: Mapping[str, Any], card: Sequence[Any]) -> bool:
    """Tell whether friction is nothing, or of one direction on ground.

    Between two nodes the element would take their distance for a gap.
    """
    if not rub["contacts"]:
        return bool(rub["mode"] == "open")
    return len(rub["contacts"]) == 1 and card[3] is None


def _distance(
    job: Mapping[str, Any],
    case: Mapping[str, Any],
    held: Mapping[Any, Vector],
    begin: Mapping[Any, Vector],
) -> float | None:
    """Solve from `begin`; the largest translation that differs, None where there is no answer."""
    frame = Frame(job, {**case, "rubs": ()})
    add_elements(frame)
    add_supports(frame, {i: rub for rub in case["rubs"] for i in rub["contacts"]})
    add_loads(frame)
    for key, tag in places(frame).items():
        for i, x in enumerate(begin.get(key, ()), 1):
            frame.ops.setNodeDisp(tag, i, x, "-commit")
    if frame.analyse("Newton", case["steps"], SETTLED, PATIENCE):
        return None
    reach = max(1e-12, *(abs(x) for six in held.values() for x in six[:3]))
    moved = {label: frame.ops.nodeDisp(tag) for label, tag in frame.node.items()}
    away = 0.0
    for label, six in moved.items():
        away = max(away, *(abs(x - y) for x, y in zip(six[:3], held[label][:3], strict=True)))
    return away / reach


def places(frame: Frame) -> dict[Any, int]:
    """Nodes by what they are: labels, and both sides of hinges and of joints."""
    ends = {name: [tag] for name, tag in frame.link.items()} | frame.hinges
    sides = {
        (name, i, side): tag
        for name, tags in ends.items()
        for i, element in enumerate(tags)
        for side, tag in enumerate(frame.ops.eleNodes(element))
    }
    return {**sides, **frame.node}
