"""Laws of supports whose states were held, judged in the other program's own numbers."""

from collections.abc import Mapping, Sequence
from math import sqrt
from typing import Any

from trunnion.exports.opensees.parts.vectors import Vector, add, cross, dot


def judge(
    job: Mapping[str, Any],
    case: Mapping[str, Any],
    moved: Mapping[str, Vector],
    pushes: Sequence[Vector],
    printed: float = 0.0,
) -> tuple[float, str]:
    """Worst violation of the laws that were held, and where.

    Coulomb's law relative to the largest normal force on which there is friction, gaps all round a
    pipe to the largest movement.

    Parameters
    ----------
    pushes : force on the pipe of every spring of a support, in the order of the job.
    printed : part of the largest movement to which movements are rounded.
    """
    found = [(0.0, "")]
    reach = max(1e-12, *(abs(x) for six in moved.values() for x in six[:3]))
    normals = [pressed(rub, pushes) for rub in case["rubs"]]
    for rub, normal in zip(case["rubs"], normals, strict=True):
        travel = add(relative(job, case, moved, rub["card"])[:3], [-x for x in rub["datum"]])
        error = coulomb(rub, rub["mu"] * normal, travel, printed * reach) / max(1.0, *normals)
        found.append((error, f"friction of {job['cards'][rub['card']][0]}"))
    for ring in case["rings"]:
        travel = relative(job, case, moved, ring["card"])[:3]
        across = [dot(travel, way) for way in ring["normals"]]
        beyond = sqrt(dot(across, across)) - ring["gap"]
        error = max(0.0, -beyond if ring["closed"] else beyond) / reach
        found.append((error, f"gap round the pipe at {job['cards'][ring['card']][0]}"))
    return max(found)


def pressed(rub: Mapping[str, Any], pushes: Sequence[Vector]) -> float:
    """Size of the force that presses on a friction element."""
    total = [0.0] * 3
    for i in rub["contacts"]:
        total = add(total, pushes[i][:3])
    return sqrt(dot(total, total))


def coulomb(rub: Mapping[str, Any], capacity: float, travel: Vector, rounded: float) -> float:
    """Force by which the friction that was held departs from Coulomb's law."""
    travel = [sum(dot(travel, way) * way[i] for way in rub["basis"]) for i in range(3)]
    slide, force = sqrt(dot(travel, travel)), sqrt(dot(rub["force"], rub["force"]))
    kf: float = rub["kf"]
    if rub["mode"] == "stick":
        return max(0.0, kf * (slide - rounded) - capacity)
    if rub["mode"] == "open":
        return capacity
    if dot(travel, rub["force"]) > 0.0:
        return force + capacity
    off = cross(travel, rub["force"])
    sine = sqrt(dot(off, off)) / (slide * force) if slide * force else 0.0
    return max(abs(force - capacity), sine * force, capacity - kf * (slide + rounded))


def relative(
    job: Mapping[str, Any], case: Mapping[str, Any], moved: Mapping[str, Vector], card: int
) -> list[float]:
    """Movement of a support's node against its base."""
    _, _, label, other = job["cards"][card]
    base = case["base"].get(card, (0.0,) * 6) if other is None else moved[other]
    return [a - b for a, b in zip(moved[label], base, strict=True)]
