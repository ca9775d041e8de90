"""Solve a neutral pipe rack model (schema piperack-1) and write the answer as JSON.

    benchmarks/rack.py MODEL.json CASE [-o OUT.json] [--angle DEG]

CASE is lin (every support two-way, no gap, no friction), gap (real gaps, no friction), fric1
(friction, weight and temperature in one step) or fricK (K equal steps).  MODEL.json may be
gzipped.  The output has `displacements` [n][6] in m and rad, `supports` with the force on the
pipe along the support's direction (`normal`) and its `friction`, the `certificate`, the `work`
ledger, `seconds` (from arrays in memory to the certified result), `seconds_model` (from the
model's file in memory to the arrays) and `peak_mb`.
"""

import argparse
import gzip
import json
import math
import resource
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import trunnion
from trunnion.arrays import CaseResult, Results
from trunnion.cases.analysis import solve_system
from trunnion.certificate import certify
from trunnion.loads import case_loads
from trunnion.model import (
    Case,
    Direction,
    Material,
    Model,
    Node,
    Operation,
    Pipe,
    Section,
    Settings,
    Support,
    Term,
)
from trunnion.solver.steps import Plan
from trunnion.system import build_system

Rack = dict[str, Any]
SIGNED = {(True, True): "", (True, False): "+", (False, True): "-"}  # sides that hold


def read_rack(path: Path) -> Rack:
    """Read a model file, plain or gzipped."""
    raw = path.read_bytes()
    data: Rack = json.loads(gzip.decompress(raw) if raw[:2] == b"\x1f\x8b" else raw)
    if data.get("schema") != "piperack-1":
        raise ValueError(f"{path}: schema is not piperack-1")
    return data


def turned(rack: Rack, degrees: float) -> Rack:
    """Turn a model about the vertical."""
    turn = plan_rotation(degrees)
    supports = [{**s, "dir": (turn @ s["dir"]).tolist()} for s in rack["supports"]]
    return {**rack, "nodes": (np.array(rack["nodes"]) @ turn.T).tolist(), "supports": supports}


def plan_rotation(degrees: float) -> np.ndarray:
    """Rotation matrix about Y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def rack_model(rack: Rack, case: str) -> Model:
    """Describe a rack and one case of it in Trunnion's records.

    Supports come first and in the rack's order, the anchors after them.
    """
    pipe = rack["pipe"]
    hot = Operation(t={"1": pipe["dT"]}, tref=0.0)
    steel = Material(
        "STEEL", e=pipe["E"], nu=pipe["nu"], alpha=pipe["alpha"], density=pipe["rho_pipe"]
    )
    section = Section("PIPE", od=pipe["od"], wall=pipe["t"], fluid=pipe["rho_fluid"])
    return Model(
        title=f"{rack['name']} {case}",
        settings=Settings(k=rack["kn"], kr=rack["kn"], kf=rack["kt"], shear=False, g=pipe["g"]),
        materials={"STEEL": steel},
        sections={"PIPE": section},
        nodes=[Node(str(i), (x, y, z)) for i, (x, y, z) in enumerate(rack["nodes"])],
        pipes=[
            Pipe(str(i), str(j), None, "PIPE", "STEEL", operation=hot) for i, j in rack["elements"]
        ],
        supports=[_support(s, case) for s in rack["supports"]]
        + [Support(str(node), "anchor") for node in rack["anchors"]],
        cases=[_case(case)],
    )


def _support(support: Rack, case: str) -> Support:
    sides = (support["minus"], support["plus"])
    x, y, z = support["dir"]
    if case == "lin":
        sign, gap, mu = "", (0.0, 0.0), 0.0
    else:
        sign = SIGNED[sides[0] is not None, sides[1] is not None]
        gap = (sides[0] or 0.0, sides[1] or 0.0)
        mu = 0.0 if case == "gap" else support["mu"]
    word = f"{sign}({x:g},{y:g},{z:g})"
    direction = Direction(word, vector=(x, y, z), gap=gap, mu=mu)
    return Support(str(support["node"]), "support", (direction,))


def _case(name: str) -> Case:
    if name in ("lin", "gap"):
        steps = 1
    elif name.startswith("fric") and name[4:].isdigit() and int(name[4:]) > 0:
        steps = int(name[4:])
    else:
        raise ValueError(f"case {name} is not lin, gap, fric1 or fricK")
    return Case(name.upper(), (Term(1.0, "W"), Term(1.0, "T1")), steps=steps)


def solve_rack(rack: Rack, case: str) -> Results:
    """Solve one case of a rack."""
    return trunnion.solve(rack_model(rack, case))


def support_forces(result: CaseResult, rack: Rack) -> tuple[np.ndarray, np.ndarray]:
    """Force of each support on the pipe: along its direction (n,), and friction (n, 3) [N]."""
    system, state = result.system, result.state
    if state is None:
        raise ValueError(f"not converged: {result.cause}")
    normal, friction = np.zeros(len(system.cards)), np.zeros((len(system.cards), 3))
    along = np.array([*(s["dir"] for s in rack["supports"]), *([[0.0] * 3] * 2)])
    card = system.contacts.card
    held = card < len(rack["supports"])
    np.add.at(normal, card[held], np.sum(state.reaction[held] * along[card[held]], axis=1))
    np.add.at(friction, system.sliders.card, state.friction)
    n = len(rack["supports"])
    return normal[:n], friction[:n]


def node_displacements(result: CaseResult) -> np.ndarray:
    """Displacements [m, rad] in the order of the rack's nodes."""
    system, state = result.system, result.state
    if state is None:
        raise ValueError(f"not converged: {result.cause}")
    order = np.argsort([int(label) for label in system.labels])
    u: np.ndarray = (state.u + state.u_low)[order]
    return u


def certificate_seconds(result: CaseResult) -> float:
    """Median time of judging the answer, of seven [s]."""
    if result.state is None or result.loads is None:
        raise ValueError(f"not converged: {result.cause}")
    times = []
    for _ in range(7):
        start = time.perf_counter()
        certify(result.system, result.loads, result.state, correction_u=0.0, correction_r=0.0)
        times.append(time.perf_counter() - start)
    return sorted(times)[3]


def answer(rack: Rack, case: str) -> Rack:
    """Solve a case and describe the answer in plain data."""
    name = case.upper()
    start = time.perf_counter()
    model = rack_model(rack, case)
    system = build_system(model)
    loads = case_loads(model, system, _case(case))
    ready = time.perf_counter()
    results = solve_system(system, {name: loads}, {name: Plan(steps=_case(case).steps)})
    end = time.perf_counter()
    result = results[name]
    out: Rack = {
        "model": rack["name"],
        "case": case,
        "converged": result.converged,
        "work": results.work,
        "seconds": end - ready,
        "seconds_model": ready - start,
        "peak_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
    }
    if result.state is None:
        return {**out, "cause": result.cause}
    normal, friction = support_forces(result, rack)
    certificate = result.certificate
    return {
        **out,
        "seconds_certificate": certificate_seconds(result),
        "displacements": node_displacements(result).tolist(),
        "supports": [
            {"id": s["id"], "normal": float(n), "friction": f.tolist()}
            for s, n, f in zip(rack["supports"], normal, friction, strict=True)
        ],
        "certificate": certificate
        and {
            "passed": bool(certificate.passed),
            "worst": certificate.worst,
            "where": certificate.where,
            **{item.name: item.value for item in certificate.items},
        },
    }


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("case", help="lin, gap, fric1 or fricK")
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--angle", type=float, default=0.0, help="turn the rack in plan [deg]")
    args = parser.parse_args()
    rack = turned(read_rack(args.model), args.angle) if args.angle else read_rack(args.model)
    out = answer(rack, args.case)
    if args.output:
        args.output.write_text(json.dumps(out))
    certificate = out.get("certificate") or {}
    print(
        f"{out['model']} {out['case']}: worst {certificate.get('worst', out.get('cause'))}, "
        f"{out['seconds']:.3f} s, {out['peak_mb']:.0f} MB, {out['work']}"
    )
    return 0 if certificate.get("passed") else 1


if __name__ == "__main__":
    sys.exit(main())
