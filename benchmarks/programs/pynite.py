"""PyNite on a rack: linear, and gaps without friction (it has none).

Temperature and weight act as the consistent nodal loads of the beams, as everywhere here.  PyNite
closes and opens support springs until none changes (compression-only members it opens and never
closes again, which ends in wrong answers); a gap is a support spring at an extra node that a
preloaded spring keeps back from the pipe by the gap.
"""

import time
from collections.abc import Callable

import numpy as np
from frame import build_frame
from rack_line import Rack

from programs.outcome import Outcome

FREEDOMS = ("DX", "DY", "DZ", "RX", "RY", "RZ")
FORCES = ("FX", "FY", "FZ", "MX", "MY", "MZ")
PASSES = 200


def pynite(rack: Rack, case: str) -> Callable[[], Outcome]:
    """Make ready; what is returned builds the model afresh and times the analysis."""
    if case.startswith("fric"):
        raise NotImplementedError("has no friction")
    load = build_frame(rack).load.astype(np.float64).reshape(-1, 6)

    def run() -> Outcome:
        model = _model(rack, case, load)
        start = time.perf_counter()
        try:
            if case == "lin":
                model.analyze_linear(check_stability=False)
            else:
                model.analyze(check_stability=False, max_iter=PASSES)
        except Exception as error:  # PyNite raises plain Exception where it diverges
            return Outcome(time.perf_counter() - start, None, str(error))
        seconds = time.perf_counter() - start
        combo = next(iter(model.load_combos))
        nodes = (model.nodes[str(i)] for i in range(len(load)))
        u = [[getattr(node, name)[combo] for name in FREEDOMS] for node in nodes]
        return Outcome(seconds, np.array(u, np.float64))

    return run


def _model(rack: Rack, case: str, load: np.ndarray):  # type: ignore[no-untyped-def]
    from Pynite import FEModel3D

    pipe, section, kn = rack["pipe"], rack["section"], rack["kn"]
    model = FEModel3D()
    model.add_material("steel", pipe["E"], section["G"], pipe["nu"], pipe["rho_pipe"])
    model.add_section("pipe", section["A"], section["I"], section["I"], section["J"])
    for i, xyz in enumerate(rack["nodes"]):
        model.add_node(str(i), *xyz)
    for i, j in rack["elements"]:
        model.add_member(f"{i}-{j}", str(i), str(j), "steel", "pipe")
    for node in rack["anchors"]:
        for freedom in FREEDOMS:
            model.def_support_spring(str(node), freedom, kn)
    for s in rack["supports"]:
        node, axis = s["node"], int(np.argmax(np.abs(s["dir"])))
        if case == "lin":
            model.def_support_spring(str(node), FREEDOMS[axis], kn)
        elif s["type"] == "rest":
            model.def_support_spring(str(node), FREEDOMS[axis], kn, "-")
        else:
            for sign in (-1.0, 1.0):
                _gap(model, node, rack["nodes"][node], axis, sign, s["plus"], kn)
    for i, force in enumerate(load):
        for name, value in zip(FORCES, force.tolist(), strict=True):
            if value:
                model.add_node_load(str(i), name, value)
    return model


def _gap(model, node, xyz, axis, sign, gap, kn) -> None:  # type: ignore[no-untyped-def]
    """A one-way support spring at a node that follows the pipe, set back by the gap.

    Each of the two springs in series is twice as stiff as the support.
    """
    follower, freedom = f"{node} {axis} {sign:+g}", FREEDOMS[axis]
    place = list(xyz)
    place[axis] += sign
    model.add_node(follower, *place)
    model.def_support(follower, *[i != axis for i in range(6)])
    model.def_support_spring(follower, freedom, 2 * kn, "+" if sign > 0 else "-")
    model.add_spring(follower, str(node), follower, 2 * kn)
    back = -sign * 2 * kn * gap
    model.add_node_load(follower, FORCES[axis], back)
    model.add_node_load(str(node), FORCES[axis], -back)
