"""What CalculiX printed, in the layout of a JSON report."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import F8, CaseResult
from trunnion.exports.calculix import groups, numbered
from trunnion.exports.calculix.numbering import Deck, hold_keys
from trunnion.exports.scene import Rub, Stand

if TYPE_CHECKING:
    from trunnion.exports import Job

DIGITS = 1e-6  # of the largest: seven printed digits


def read_answer(
    job: "Job", folder: Path, stem: str, run: Callable[[Path, str], None]
) -> dict[str, Any]:
    """Run every input file of a job and read its steps.

    Parameters
    ----------
    run : runs the program on a file without its suffix, in a folder.
    """
    cases: dict[str, Any] = {}
    for name, own in groups(job.scene, stem).items():
        run(folder, name)
        steps = _blocks(folder / f"{name}.dat")
        deck, stands = numbered(job.scene, own)
        for i, (case, found) in enumerate(zip(own, stands, strict=True)):
            if i < len(steps):
                cases[case.name] = _case(deck, case, found, steps[i])
            else:
                cases[case.name] = {"converged": False, "cause": "CalculiX printed no answer"}
    return {"program": "CalculiX", "deck": job.source, "cases": cases}


def _blocks(path: Path) -> list[dict[str, dict[int, F8]]]:
    """Numbers by node of every printed set, one dictionary a step."""
    steps: list[dict[str, dict[int, F8]]] = []
    rows: dict[int, F8] = {}
    for line in path.read_text().splitlines() if path.exists() else ():
        words = line.split()
        if " for set " in line:
            name = words[words.index("set") + 1]
            if not steps or name in steps[-1]:
                steps.append({})
            rows = steps[-1][name] = {}
        elif len(words) > 1:
            rows[int(words[0])] = np.array([float(word) for word in words[1:]])
    return steps


def _case(
    deck: Deck, case: CaseResult, found: Stand, step: dict[str, dict[int, F8]]
) -> dict[str, Any]:
    s = deck.scene.system
    n = len(s.labels)
    u = np.zeros((n, 6))
    for i, body in enumerate(deck.bodies):
        u[i, :3] = step["PIPES"][body.node][:3]
        own = "PIPES" if body.turn == body.node else "TURNS"
        u[i, 3:] = step[own][body.turn][body.first - 1 : body.first + 2]
    grounds = [deck.grounds[key] for key in hold_keys(found.holds)]
    pushes = [float(step["GROUNDS"][ground.node][0]) for ground in grounds]
    force = np.zeros((len(s.cards), 6))
    assert case.loads is not None
    force[:, :3] += np.outer(case.loads.preload, s.up)
    for hold, push in zip(found.holds, pushes, strict=True):
        half = slice(3, 6) if hold.turns else slice(0, 3)
        force[hold.card, half] += push * np.array(hold.normal)
    for rub in found.rubs:
        if rub.mode == "slip":
            force[rub.card, :3] += rub.force
        for way in rub.basis if rub.mode == "stick" else ():
            push = float(step["GROUNDS"][deck.grounds[rub.slider, way].node][0])
            force[rub.card, :3] += push * np.array(way)
    law, where = _judge(deck, case, found, u, pushes)
    names = zip(deck.scene.cards, s.cards, strict=True)
    return {
        "converged": True,
        "nodes": dict(zip(s.labels, u.tolist(), strict=True)),
        "supports": [
            {"id": card_id, "name": card.name, "force": six[:3], "moment": six[3:]}
            for (card_id, card), six in zip(names, force.tolist(), strict=True)
        ],
        "law": law,
        "law_at": where,
    }


def _judge(
    deck: Deck, case: CaseResult, found: Stand, u: F8, pushes: list[float]
) -> tuple[float, str]:
    """Worst violation of the contact and friction laws in CalculiX's own numbers, and where.

    Pulls relative to the largest force of a spring, friction to the largest normal force on which
    there is some, travel to the largest movement.
    """
    most = max([1.0, *map(abs, pushes)])
    reach = max(1e-12, float(np.abs(u[:, :3]).max()))
    worst = [(0.0, "")]
    for hold, push in zip(found.holds, pushes, strict=True):
        part = slice(3, 6) if hold.turns else slice(0, 3)
        d = float(np.dot(hold.normal, _travel(deck, case, u, hold.card, part)))
        name = deck.scene.cards[hold.card]
        if hold.closed == 0:
            beyond = max(d - hold.plus, -d - hold.minus, 0.0)
            worst.append((beyond / reach, f"gap at {name}"))
        elif hold.closed != 2:
            worst.append((max(0.0, push * hold.closed) / most, f"pull at {name}"))
    normals = [_pressed(found, rub, pushes) for rub in found.rubs]
    for rub, normal in zip(found.rubs, normals, strict=True):
        travel = _travel(deck, case, u, rub.card, slice(0, 3)) - rub.datum
        error = _coulomb(rub, rub.mu * normal, travel, DIGITS * reach)
        worst.append((error / max(1.0, *normals), f"friction of {deck.scene.cards[rub.card]}"))
    for ring in found.rings:
        travel = _travel(deck, case, u, ring.card, slice(0, 3))
        across = float(np.linalg.norm([np.dot(travel, way) for way in ring.normals]))
        beyond = across - ring.gap
        error = max(0.0, -beyond if ring.closed else beyond)
        worst.append((error / reach, f"gap round the pipe at {deck.scene.cards[ring.card]}"))
    return max(worst)


def _pressed(found: Stand, rub: Rub, pushes: list[float]) -> float:
    """Size of the force that presses on a slider [N]."""
    parts = (pushes[i] * np.array(found.holds[i].normal) for i in rub.holds)
    return float(np.linalg.norm(sum(parts, np.zeros(3))))


def _coulomb(rub: Rub, capacity: float, travel: F8, printed: float) -> float:
    """Force by which the friction that was held departs from Coulomb's law [N].

    Parameters
    ----------
    capacity : mu N [N].  travel : (3,) from the datum [m].
    printed : how far a printed movement is rounded [m].
    """
    travel = sum((np.dot(travel, way) * np.array(way) for way in rub.basis), np.zeros(3))
    slide, force = float(np.linalg.norm(travel)), float(np.linalg.norm(rub.force))
    if rub.mode == "stick":
        return max(0.0, rub.kf * (slide - printed) - capacity)
    if rub.mode == "open":
        return capacity
    sine = float(np.linalg.norm(np.cross(travel, rub.force))) / max(slide * force, 1e-300)
    opposed = float(np.dot(travel, rub.force)) <= 0.0
    return max(abs(force - capacity), sine * force) if opposed else force + capacity


def _travel(deck: Deck, case: CaseResult, u: F8, card: int, part: slice) -> F8:
    """Movement of a support's node against its base (3,)."""
    assert case.loads is not None
    node, other = deck.cards[card]
    base = case.loads.base[card] if other < 0 else u[other]
    moved: F8 = u[node, part] - base[part]
    return moved
