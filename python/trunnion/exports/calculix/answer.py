"""What CalculiX printed, in the layout of a JSON report."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import F8, CaseResult
from trunnion.exports.calculix import groups, numbered
from trunnion.exports.calculix.numbering import Deck, hold_keys
from trunnion.exports.opensees.parts.laws import judge, relative
from trunnion.exports.opensees.tables import card_rows, held
from trunnion.exports.scene import Stand

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
    """Worst violation of the laws of contact and friction in CalculiX's own numbers, and where.

    Pulls relative to the largest force of a spring, travel to the largest movement.
    """
    assert case.loads is not None
    scene = deck.scene
    job = {"cards": card_rows(scene)}
    base = dict(enumerate(case.loads.base.tolist()))
    stated = {"base": base, **held(found)}
    moved = dict(zip(scene.system.labels, u.tolist(), strict=True))
    vectors = [
        [push * x for x in hold.normal] for hold, push in zip(found.holds, pushes, strict=True)
    ]
    worst = [judge(job, stated, moved, vectors, DIGITS)]
    most, reach = max([1.0, *map(abs, pushes)]), max(1e-12, float(np.abs(u[:, :3]).max()))
    for hold, push in zip(found.holds, pushes, strict=True):
        name = scene.cards[hold.card]
        if hold.closed == 0:
            travel = relative(job, stated, moved, hold.card)
            d = float(np.dot(hold.normal, travel[3:] if hold.turns else travel[:3]))
            worst.append((max(d - hold.plus, -d - hold.minus, 0.0) / reach, f"gap at {name}"))
        elif hold.closed != 2:
            worst.append((max(0.0, push * hold.closed) / most, f"pull at {name}"))
    return max(worst)
