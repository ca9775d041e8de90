"""OpenSees (openseespy) on a rack, set up as an expert would.

Elastic beams and consistent nodal loads as everyone else has, anchors as springs of 1e12 (the
references have them, too).  Without friction one fixed node serves as the ground of all supports
and the numbering is Plain: the line is numbered along its profile already.  The fastest
solver that works at every size: ProfileSPD (lin), SparseSYM (gap; with ProfileSPD it does not
converge at 100 000 nodes), UmfPack where the tangent is unsymmetric.  Rests are
elastic-no-tension springs, gaps multilinear ones.  With friction a rest is an implicit
zeroLengthContactASDimplex on a ground node of its own (flatSliderBearing does not converge even
at 50 nodes).

`opensees` asks for balance (NormUnbalance, 1e-3 N); `opensees_norm` for small steps
(NormDispIncr, 1e-6 m) with a line search, which is what many scripts do.
"""

import time
from collections.abc import Callable

import numpy as np
from frame import build_frame
from rack_line import Rack

from programs.outcome import Outcome

GROUND = 1
TRIES = 200  # iterations of a load step
BALANCE, SMALL = 1e-3, 1e-6  # norm out of balance [N, N m]; norm of the last step [m, rad]


def opensees(rack: Rack, case: str) -> Callable[[], Outcome]:
    """Ask for balance."""
    return prepared(rack, case, ("NormUnbalance", BALANCE, TRIES), ("Newton",))


def opensees_norm(rack: Rack, case: str) -> Callable[[], Outcome]:
    """Ask for small steps, searched."""
    return prepared(rack, case, ("NormDispIncr", SMALL, TRIES), ("NewtonLineSearch",))


def prepared(
    rack: Rack, case: str, test: tuple[object, ...], algorithm: tuple[str, ...]
) -> Callable[[], Outcome]:
    """Make the model; what is returned makes it afresh, analyses and times the analysis."""
    load = build_frame(rack).load.astype(np.float64).reshape(-1, 6)
    steps = int(case[4:]) if case.startswith("fric") else 1

    def run() -> Outcome:
        import openseespy.opensees as ops

        ops.wipe()
        ops.logFile("/dev/null", "-noEcho")  # a warning a support: the ground is elsewhere
        _model(ops, rack, case, load)
        ops.constraints("Plain")
        ops.numberer("Plain")
        ops.system({"lin": "ProfileSPD", "gap": "SparseSYM"}.get(case, "UmfPack"))
        if case == "lin":
            ops.algorithm("Linear")
        else:
            ops.test(*test)
            ops.algorithm(*algorithm)
        ops.integrator("LoadControl", 1.0 / steps)
        ops.analysis("Static")
        start = time.perf_counter()
        code = ops.analyze(steps)
        seconds = time.perf_counter() - start
        if code:
            return Outcome(seconds, None, f"analyze returns {code}")
        u = np.array([ops.nodeDisp(i + 2) for i in range(len(load))])
        return Outcome(seconds, u)

    return run


def _model(ops, rack: Rack, case: str, load: np.ndarray) -> None:  # type: ignore[no-untyped-def]
    pipe, section = rack["pipe"], rack["section"]
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(GROUND, 0.0, 0.0, 0.0)
    ops.fix(GROUND, *[1] * 6)
    for i, xyz in enumerate(rack["nodes"]):
        ops.node(i + 2, *xyz)
    ops.geomTransf("Linear", 1, 0.0, 0.0, 1.0)
    ops.geomTransf("Linear", 2, 0.0, 1.0, 0.0)
    xyz = np.array(rack["nodes"])
    form = section["A"], pipe["E"], section["G"], section["J"], section["I"], section["I"]
    for e, (i, j) in enumerate(rack["elements"]):
        along_z = abs(xyz[j, 2] - xyz[i, 2]) > 0.5
        ops.element("elasticBeamColumn", e + 1, i + 2, j + 2, *form, 2 if along_z else 1)
    materials = _materials(ops, rack)
    tag = len(rack["elements"]) + 1
    for node in rack["anchors"]:
        rigid = [materials["rigid"]] * 6
        ops.element("zeroLength", tag, GROUND, node + 2, "-mat", *rigid, "-dir", *range(1, 7))
        tag += 1
    for s in rack["supports"]:
        if case.startswith("fric") and s["type"] == "rest":
            _slider(ops, tag, s, rack)
        else:
            material = materials["rigid" if case == "lin" else s["type"]]
            axis = 1 + int(np.argmax(np.abs(s["dir"])))
            ops.element("zeroLength", tag, GROUND, s["node"] + 2, "-mat", material, "-dir", axis)
        tag += 1
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for i, force in enumerate(load):
        ops.load(i + 2, *force.tolist())


def _materials(ops, rack: Rack) -> dict[str, int]:  # type: ignore[no-untyped-def]
    """Tags of the laws in use."""
    kn = rack["kn"]
    tags = {"rigid": 1, "rest": 2}
    ops.uniaxialMaterial("Elastic", 1, kn)
    ops.uniaxialMaterial("ENT", 2, kn)
    for s in rack["supports"]:
        if s["type"] in tags:
            continue
        gap, tag = s["plus"], len(tags) + 1
        strain = (-gap - 1.0, -gap, gap, gap + 1.0)
        stress = (-kn, 0.0, 0.0, kn)
        ops.uniaxialMaterial("ElasticMultiLinear", tag, "-strain", *strain, "-stress", *stress)
        tags[s["type"]] = tag
    return tags


def _slider(ops, tag: int, s: Rack, rack: Rack) -> None:  # type: ignore[no-untyped-def]
    """A rest with friction: the pipe is the upper node."""
    ground = tag + len(rack["nodes"]) + 1
    ops.node(ground, *rack["nodes"][s["node"]])
    ops.fix(ground, *[1] * 6)
    stiff = rack["kn"], rack["kt"], s["mu"]
    way = "-orient", *s["dir"], "-intType", 0
    ops.element("zeroLengthContactASDimplex", tag, ground, s["node"] + 2, *stiff, *way)
