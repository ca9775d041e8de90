"""Reference answers by size and case: from tests/data, or made by `exact` and kept for one run."""

from pathlib import Path

import numpy as np
from exact import SLIP, STICK, Guess, Supports, solve_exactly, supports_of
from frame import LD, Frame, build_frame
from numpy.typing import NDArray
from programs.own import arrays
from rack import node_displacements, support_forces
from rack_line import Rack

from trunnion.arrays import CaseResult
from trunnion.cases.analysis import solve_system
from trunnion.solver.steps import Plan

DATA = Path(__file__).parents[1] / "tests" / "data"


def reference(rack: Rack, case: str, folder: Path) -> dict[str, object]:
    """Path and kind of the reference of a case; it is made where there is none yet.

    Kinds: `published` (an independent program, tests/data), `extended` (module `exact`), and
    `extended, last step` where the case has several steps: then the data committed before the
    last step are Trunnion's own, and only what follows from them is independent.
    """
    name = f"{rack['name']}_{case}.npy"
    path = folder / name
    stored = DATA / f"{rack['name']}.npz"
    if stored.exists():
        np.save(path, np.load(stored)[f"{case}_u"])
        return {"path": str(path), "kind": "published"}
    system, loads, steps = arrays(rack, case)
    result = solve_system(system, {case: loads}, {case: Plan(steps=steps)})[case]
    if result.state is None:
        return {"path": None, "kind": f"none: {result.cause}"}
    supports = laws(rack, case, result)
    found = solve_exactly(build_frame(rack), rack, supports, guess(rack, result))
    np.save(path, found.u.astype(np.float64))
    kind = "extended" if steps == 1 else "extended, last step"
    return {
        "path": str(path), "kind": kind, "residual": found.residual, "changed": found.changed,
    }  # fmt: skip


def laws(
    rack: Rack, case: str, result: CaseResult, kp: float | None = None, kf: float | None = None
) -> Supports:
    """Laws of a case with the states of an answer to begin with."""
    stiff = rack["kn"] if kp is None else kp
    stick = rack["kt"] if kf is None else kf
    s = supports_of(rack, case, stiff, stick)
    state, system = result.state, result.system
    assert state is not None
    card = system.contacts.card
    ours = card < len(s.node)
    s.side[card[ours]] = state.side[ours]
    mode = np.where(np.isin(state.mode, (STICK, SLIP)), state.mode, 0)
    s.mode[system.sliders.card] = mode
    s.datum[system.sliders.card] = state.datum
    return s


def guess(rack: Rack, result: CaseResult) -> Guess:
    """The answer's own numbers as a start."""
    normal, friction = support_forces(result, rack)
    u = node_displacements(result)
    return Guess(u.astype(LD), normal.astype(LD), friction.astype(LD))


def exact_displacements(
    frame: Frame, rack: Rack, case: str, result: CaseResult, kp: float, kf: float
) -> NDArray[np.longdouble]:
    """Displacements (n, 6) of the laws with other stiffnesses, from an answer's states."""
    found = solve_exactly(frame, rack, laws(rack, case, result, kp, kf), guess(rack, result))
    u: NDArray[np.longdouble] = found.u
    return u
