"""Build, solve and compare a job in OpenSees: the part that is the same in every exported script.

Straight pipe is one `ElasticTimoshenkoBeam` an element; bends and reducers are rigid pieces between
`zeroLength` hinges; supports are `zeroLength` springs, those with one side or a gap with a material
that carries nothing in the gap, so that OpenSees finds their states.  Where there is friction it
holds what Trunnion found: sticking supports are springs, sliding ones push with the force found;
`judge` then asks whether OpenSees' own numbers obey Coulomb's law.
"""

import argparse
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from math import inf, sqrt
from pathlib import Path
from typing import Any

from trunnion.exports.agreement import TOLERANCE, agrees, differences, laws, table, unanswered

Vector = Sequence[float]
TRIES = (("Newton", 1), ("NewtonLineSearch", 1), ("Newton", 10), ("NewtonLineSearch", 25))
BALANCE = 1e-9  # norm of what is out of balance, of the largest load [N, N m]
LEAST_BALANCE = 2e-5  # N: springs of 1e12 N/m know their force to no less
LOOSER = 1e3  # hinges that are rigid in shear (SHEAR=OFF) know theirs so much worse
ITERATIONS = 60
NOTHING: Mapping[str, Any] = {  # what a case does not say
    **{key: {} for key in ("modulus", "line", "vary", "strain", "growth", "curvature")},
    **{key: {} for key in ("nodal", "base", "preload")},
    **dict.fromkeys(("absent", "rubs", "rings"), ()),
}


class Frame:
    """The domain of one case in OpenSees, and the tags of what stands in it."""

    def __init__(self, job: Mapping[str, Any], case: Mapping[str, Any]) -> None:
        import openseespy.opensees as ops

        self.ops, self.job, self.case = ops, job, {**NOTHING, **case}
        self.node = {label: i for i, label in enumerate(job["nodes"], 1)}
        self.nodes, self.elements, self.materials = len(self.node), 0, 0
        self.transforms: dict[tuple[float, ...], int] = {}
        self.springs: dict[tuple[float, ...], int] = {}
        self.straight: dict[str, int] = {}
        self.hinges: dict[str, list[int]] = {}
        self.hung: dict[str, list[int]] = {}  # chain -> nodes of its rigid parts
        self.link: dict[str, int] = {}
        self.held: list[tuple[int, int]] = []  # card, element of each spring of a support
        self.ground: dict[int, int] = {}  # card -> its ground
        self.largest = 0.0  # load
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        for label, tag in self.node.items():
            ops.node(tag, *job["nodes"][label])
        for label, freedom in self.case["absent"]:
            ops.fix(self.node[label], *(int(i == freedom) for i in range(6)))

    def new_node(self, xyz: Vector) -> int:
        """Add a node that no label names."""
        self.nodes += 1
        self.ops.node(self.nodes, *xyz)
        return self.nodes

    def new_element(self, *words: object) -> int:
        """Add an element: its type, then what follows its tag."""
        self.elements += 1
        self.ops.element(words[0], self.elements, *words[1:])
        return self.elements

    def transform(self, z: Vector) -> int:
        """Tag of the linear transformation with this local z."""
        key = tuple(z)
        if key not in self.transforms:
            self.transforms[key] = len(self.transforms) + 1
            self.ops.geomTransf("Linear", self.transforms[key], *key)
        return self.transforms[key]

    def spring(self, k: float, minus: float = 0.0, plus: float = 0.0) -> int:
        """Tag of a spring of k that carries below -minus and above plus; inf: not on that side."""
        key = (k, minus, plus)
        if key not in self.springs:
            tag = self.springs[key] = len(self.springs) + 1
            if minus == plus == 0.0:
                self.ops.uniaxialMaterial("Elastic", tag, k)
            elif (minus, plus) == (0.0, inf):
                self.ops.uniaxialMaterial("ENT", tag, k)  # elastic, no tension
            else:
                points = [] if minus == inf else [(-minus - 1.0, -k), (-minus, 0.0)]
                points += [] if plus == inf else [(plus, 0.0), (plus + 1.0, k)]
                if minus == inf:
                    points.insert(0, (-1.0, 0.0))
                if plus == inf:
                    points.append((1.0, 0.0))
                strain, stress = zip(*points, strict=True)
                law = "-strain", *strain, "-stress", *stress
                self.ops.uniaxialMaterial("ElasticMultiLinear", tag, *law)
        return self.springs[key]

    def load(self, node: int, six: Vector) -> None:
        """Add forces and moments at a node."""
        if any(six):
            self.largest = max(self.largest, *map(abs, six))
            self.ops.load(node, *six)


# ------------------------------------------------------------------ the structure
def add_elements(frame: Frame) -> None:
    """Add pipe: straights, bends and reducers, joints and springs."""
    job, node, modulus = frame.job, frame.node, frame.case["modulus"]
    for name, start, end, e, g, area, polar, second, shear, z in job["straights"]:
        ratio = modulus.get(name, 1.0)
        where = node[start], node[end]
        if shear:
            what, form = "ElasticTimoshenkoBeam", [ratio * e, ratio * g, area]
            form += [polar, second, second, shear, shear]
        else:
            what, form = "elasticBeamColumn", [area, ratio * e, ratio * g, polar, second, second]
        frame.straight[name] = frame.new_element(what, *where, *form, frame.transform(z))
    for name, start, end, hinges, _ in job["chains"]:
        add_chain(frame, name, node[start], node[end], hinges)
    for name, start, end, axes, k in job["springs"]:
        add_link(frame, name, node[start], node[end], axes, k)


def add_chain(frame: Frame, name: str, start: int, end: int, hinges: Sequence[Any]) -> None:
    """Add rigid parts and the hinges between them; the last part hangs on the second end."""
    ratio, before = frame.case["modulus"].get(name, 1.0), start
    frame.hinges[name], frame.hung[name] = [], [start]
    for i, (xyz, axes, k, _) in enumerate(hinges):
        near, far = frame.new_node(xyz), frame.new_node(xyz)
        frame.ops.rigidLink("beam", before, near)
        if i + 1 == len(hinges):
            frame.ops.rigidLink("beam", end, far)
        frame.hinges[name].append(six_springs(frame, near, far, axes, [ratio * x for x in k]))
        before = far
        frame.hung[name].append(end if i + 1 == len(hinges) else far)


def add_link(frame: Frame, name: str, start: int, end: int, axes: Any, k: Vector) -> None:
    """Add six springs half way between two nodes, rigid to both."""
    a, b = (frame.ops.nodeCoord(tag) for tag in (start, end))
    if max(abs(x - y) for x, y in zip(a, b, strict=True)) > 0.0:
        middle = [0.5 * (x + y) for x, y in zip(a, b, strict=True)]
        near, far = frame.new_node(middle), frame.new_node(middle)
        frame.ops.rigidLink("beam", start, near)
        frame.ops.rigidLink("beam", end, far)
        start, end = near, far
    frame.link[name] = six_springs(frame, start, end, axes, k)


def six_springs(frame: Frame, near: int, far: int, axes: Any, k: Vector) -> int:
    """Add a zeroLength element with a spring in every direction that has a stiffness."""
    directions = [i for i in range(6) if k[i]]
    materials = [frame.spring(k[i]) for i in directions]
    way = "-dir", *(i + 1 for i in directions), "-orient", *axes[0], *axes[1]
    return frame.new_element("zeroLength", near, far, "-mat", *materials, *way)


def add_supports(frame: Frame) -> None:
    """Add the springs of all supports, each on the ground of its card or on its other node."""
    job, case = frame.job, frame.case
    for card, turns, normal, k, minus, plus in job["supports"][case["supports"]]:
        _, _, label, other = job["cards"][card]
        node = frame.node[label]
        base = ground(frame, card) if other is None else frame.node[other]
        if (minus, plus) == (inf, 0.0):  # ENT is for compression: turn it round
            normal, minus, plus = [-x for x in normal], plus, minus
        way = "-dir", 4 if turns else 1, "-orient", *normal, *aside(normal)
        law = frame.spring(k, minus, plus)
        frame.held.append((card, frame.new_element("zeroLength", base, node, "-mat", law, *way)))
    for rub in case["rubs"]:
        if rub["mode"] == "stick":
            _, _, label, other = job["cards"][rub["card"]]
            node = frame.node[label]
            base = ground(frame, rub["card"]) if other is None else frame.node[other]
            for way in rub["basis"]:
                words = "-mat", frame.spring(rub["kf"]), "-dir", 1, "-orient", *way, *aside(way)
                tag = frame.new_element("zeroLength", base, node, *words)
                frame.held.append((rub["card"], tag))


def ground(frame: Frame, card: int) -> int:
    """Node under a support: fixed, or moved as the case says."""
    if card not in frame.ground:
        label = frame.job["cards"][card][2]
        frame.ground[card] = frame.new_node(frame.job["nodes"][label])
        if not any(frame.case["base"].get(card, ())):
            frame.ops.fix(frame.ground[card], *[1] * 6)
    return frame.ground[card]


def aside(x: Vector) -> list[float]:
    """Any vector that is not along x."""
    least = min(range(3), key=lambda i: abs(x[i]))
    return [float(i == least) for i in range(3)]


# ------------------------------------------------------------------ the loads
def add_loads(frame: Frame) -> None:
    """Add the loads of the case: on nodes, on lengths of pipe, free strains, moved grounds."""
    ops, job, case = frame.ops, frame.job, frame.case
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for label, six in case["nodal"].items():
        frame.load(frame.node[label], six)
    for card, six in case["base"].items():
        if card in frame.ground and any(six):
            for i, moved in enumerate(six, 1):
                ops.sp(frame.ground[card], i, moved)
    for card, six in support_pushes(frame):
        _, _, label, other = job["cards"][card]
        frame.load(frame.node[label], six)
        if other is not None:
            frame.load(frame.node[other], [-x for x in six])
    for name, start, end, *_, z in job["straights"]:
        tag, x = frame.straight[name], axis(frame, start, end)
        if name in case["line"]:
            q = case["line"][name]
            y = cross(z, x)
            w = [dot(q, y), dot(q, z), dot(q, x)]
            frame.largest = max(frame.largest, *map(abs, w))
            ops.eleLoad("-ele", tag, "-type", "-beamUniform", *w)
    for node, six in strain_loads(frame):
        frame.load(node, six)
    for name, _, _, _, segments in job["chains"]:
        for tag, segment in zip(frame.hung[name], segments, strict=True):
            frame.load(tag, segment_load(case, name, segment))


def support_pushes(frame: Frame) -> Iterator[tuple[int, list[float]]]:
    """Yield forces on the pipe that are given: cold loads of hangers, friction, stuck datums."""
    for card, push in frame.case["preload"].items():
        yield card, [*push, 0.0, 0.0, 0.0]
    for rub in frame.case["rubs"]:
        if rub["mode"] == "slip":
            yield rub["card"], [*rub["force"], 0.0, 0.0, 0.0]
        elif rub["mode"] == "stick" and any(rub["datum"]):
            yield rub["card"], [*(rub["kf"] * x for x in rub["datum"]), 0.0, 0.0, 0.0]


def strain_loads(frame: Frame) -> Iterator[tuple[int, list[float]]]:
    """Yield the pairs of loads that stretch elements as their free strains would."""
    for name, node, six in strain_pairs(frame):
        del name
        yield node, six


def strain_pairs(frame: Frame) -> Iterator[tuple[str, int, list[float]]]:
    """Yield element, node and load of the free strains."""
    job, case = frame.job, frame.case
    for name, start, end, e, _, area, *_ in job["straights"]:
        if name in case["strain"]:
            pull = case["modulus"].get(name, 1.0) * e * area * case["strain"][name]
            along = [pull * x for x in axis(frame, start, end)]
            yield name, frame.node[start], [*(-x for x in along), 0.0, 0.0, 0.0]
            yield name, frame.node[end], [*along, 0.0, 0.0, 0.0]
    for name, _, _, hinges, _ in job["chains"]:
        strain, curvature = case["strain"].get(name, 0.0), case["curvature"].get(name, 0.0)
        if strain or curvature:
            ratio = case["modulus"].get(name, 1.0)
            for hinge, tag in zip(hinges, frame.hinges[name], strict=True):
                six = [ratio * x for x in hinge_load(hinge, strain, curvature)]
                near, far = frame.ops.eleNodes(tag)
                yield name, near, [-x for x in six]
                yield name, far, six
    for name, _, _, axes, k in job["springs"]:
        if name in case["growth"]:
            six = [*(k[0] * case["growth"][name] * x for x in axes[0]), 0.0, 0.0, 0.0]
            near, far = frame.ops.eleNodes(frame.link[name])
            yield name, near, [-x for x in six]
            yield name, far, six


def hinge_load(hinge: Any, strain: float, curvature: float) -> list[float]:
    """Force and moment, global, that move a hinge as its free strain would."""
    _, axes, k, (*along, length) = hinge
    push = [k[i] * along[i] * strain for i in range(3)]
    turn = k[5] * curvature * length
    force = [sum(push[i] * axes[i][j] for i in range(3)) for j in range(3)]
    return [*force, *(turn * x for x in axes[2])]


def segment_load(case: Mapping[str, Any], name: str, segment: Any) -> list[float]:
    """Force and moment of the load on a rigid part about its node."""
    loads = [case["line"].get(name, (0.0,) * 3), *case["vary"].get(name, ())]
    total = [0.0] * 6
    for q, (length, *lever) in zip(loads, segment, strict=False):
        total = add(total, [*(length * x for x in q), *cross(lever, q)])
    return total


def axis(frame: Frame, start: str, end: str) -> list[float]:
    """Unit vector from node to node."""
    d = [b - a for a, b in zip(frame.job["nodes"][start], frame.job["nodes"][end], strict=True)]
    size = sqrt(dot(d, d))
    return [x / size for x in d]


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a: Vector, b: Vector) -> list[float]:
    """Vector product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def add(a: Vector, b: Vector) -> list[float]:
    """Sum."""
    return [x + y for x, y in zip(a, b, strict=True)]


# ------------------------------------------------------------------ the answer
def solve(job: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Solve one case; where Newton's method cycles between contacts, try with more steps.

    Contact without friction has one answer, whatever the steps on the way to it.
    """
    cause = ""
    for looser, (algorithm, steps) in product((1.0, LOOSER), TRIES):
        frame = Frame(job, job["cases"][name])
        add_elements(frame)
        add_supports(frame)
        add_loads(frame)
        frame.ops.constraints("Transformation")
        frame.ops.numberer("RCM")
        frame.ops.system("UmfPack")
        balance = looser * max(BALANCE * frame.largest, LEAST_BALANCE)
        frame.ops.test("NormUnbalance", balance, ITERATIONS, 0)
        frame.ops.algorithm(algorithm)
        frame.ops.integrator("LoadControl", 1.0 / steps)
        frame.ops.analysis("Static")
        code = frame.ops.analyze(steps)
        if code == 0:
            return answer(frame)
        cause = f"OpenSees: analyze returns {code}"
    return {"converged": False, "cause": cause}


def answer(frame: Frame) -> dict[str, Any]:
    """Movements, support forces on the pipe, end forces on elements, and the laws held."""
    ops, job = frame.ops, frame.job
    moved = {label: ops.nodeDisp(tag) for label, tag in frame.node.items()}
    force = [[0.0] * 6 for _ in job["cards"]]
    for card, six in support_pushes(frame):
        force[card] = add(force[card], six)
    normal: list[list[float]] = []
    for card, tag in frame.held:
        push = [-x for x in ops.eleForce(tag)[6:12]]
        force[card] = add(force[card], push)
        normal.append(push)
    law, where = judge(frame, moved, normal)
    return {
        "converged": True,
        "nodes": moved,
        "supports": [
            {"id": card[0], "name": card[1], "force": six[:3], "moment": six[3:]}
            for card, six in zip(job["cards"], force, strict=True)
        ],
        "elements": end_forces(frame),
        "law": law if frame.case["rubs"] or frame.case["rings"] else None,
        "law_at": where,
    }


def end_forces(frame: Frame) -> list[dict[str, Any]]:
    """Forces and moments on the elements at their two ends."""
    pairs: dict[tuple[str, int], list[float]] = {}
    for name, node, six in strain_pairs(frame):
        pairs[name, node] = add(pairs.get((name, node), [0.0] * 6), six)
    found = {}
    for name, tag in frame.straight.items():
        both, ends = frame.ops.eleForce(tag), frame.ops.eleNodes(tag)
        found[name] = [
            add(both[at : at + 6], [-x for x in pairs.get((name, node), [0.0] * 6)])
            for at, node in ((0, ends[0]), (6, ends[1]))
        ]
    for name, start, end, _, segments in frame.job["chains"]:
        tags, case = frame.hinges[name], frame.case
        ends = []
        first, last = (start, tags[0], 0, segments[0]), (end, tags[-1], 1, segments[-1])
        for label, tag, half, part in (first, last):
            node = frame.ops.eleNodes(tag)[half]
            six = frame.ops.eleForce(tag)[6 * half : 6 * half + 6]
            six = add(six, [-x for x in pairs.get((name, node), [0.0] * 6)])
            six = carried(frame, six, node, frame.node[label])
            ends.append(add(six, [-x for x in segment_load(case, name, part)]))
        found[name] = ends
    for name, start, end, *_ in frame.job["springs"]:
        tag, ends = frame.link[name], []
        for half, label in enumerate((start, end)):
            node = frame.ops.eleNodes(tag)[half]
            six = frame.ops.eleForce(tag)[6 * half : 6 * half + 6]
            six = add(six, [-x for x in pairs.get((name, node), [0.0] * 6)])
            ends.append(carried(frame, six, node, frame.node[label]))
        found[name] = ends
    return [
        {"id": name, "force_from": found[name][0], "force_to": found[name][1]}
        for name in frame.job["elements"]
    ]


def carried(frame: Frame, six: Vector, here: int, there: int) -> list[float]:
    """A force and a moment at one node, about another."""
    a, b = (frame.ops.nodeCoord(tag) for tag in (here, there))
    arm = [x - y for x, y in zip(a, b, strict=True)]
    return [*six[:3], *add(six[3:], cross(arm, six[:3]))]


def judge(frame: Frame, moved: Mapping[str, Vector], normal: Sequence[Vector]) -> tuple[float, str]:
    """Worst violation of the laws that were held, in OpenSees' own numbers, and where.

    Coulomb's law relative to the largest normal force, directions as sines, gaps all round a pipe
    relative to the largest movement.
    """
    job, case = frame.job, frame.case
    worst, where = 0.0, ""
    pressed = []
    for rub in case["rubs"]:
        total = [0.0] * 3
        for i in rub["contacts"]:
            total = add(total, normal[i][:3])
        pressed.append(sqrt(dot(total, total)))
    most = max([1.0, *pressed])
    reach = max([1e-12, *(abs(x) for six in moved.values() for x in six[:3])])
    for rub, n in zip(case["rubs"], pressed, strict=True):
        travel = add(relative(frame, moved, rub["card"]), [-x for x in rub["datum"]])
        travel = [sum(dot(travel, way) * way[i] for way in rub["basis"]) for i in range(3)]
        slide, force = sqrt(dot(travel, travel)), rub["mu"] * n
        if rub["mode"] == "stick":
            error = max(0.0, rub["kf"] * slide - force) / most
        elif rub["mode"] == "slip":
            f = sqrt(dot(rub["force"], rub["force"]))
            off = cross(travel, rub["force"])
            sine = sqrt(dot(off, off)) / (slide * f) if slide * f else 0.0
            same_way = dot(travel, rub["force"]) > 0.0
            short = max(0.0, force - rub["kf"] * slide) / most
            error = max(abs(f - force) / most, sine * f / most, short, float(same_way and f > 0.0))
        else:
            error = force / most
        if error > worst:
            worst, where = error, f"friction of {job['cards'][rub['card']][0]}"
    for ring in case["rings"]:
        travel = relative(frame, moved, ring["card"])
        across = [dot(travel, way) for way in ring["normals"]]
        beyond = sqrt(dot(across, across)) - ring["gap"]
        error = max(0.0, -beyond if ring["closed"] else beyond) / reach
        if error > worst:
            worst, where = error, f"gap round the pipe at {job['cards'][ring['card']][0]}"
    return worst, where


def relative(frame: Frame, moved: Mapping[str, Vector], card: int) -> list[float]:
    """Movement of a support's node against its base."""
    _, _, label, other = frame.job["cards"][card]
    base = frame.case["base"].get(card, (0.0,) * 6) if other is None else moved[other]
    return [a - b for a, b in zip(moved[label][:3], base[:3], strict=True)]


# ------------------------------------------------------------------ the command line
def main(job: Mapping[str, Any], arguments: Sequence[str] | None = None) -> int:
    """Solve the cases, print and write them; compare with a JSON report of Trunnion if asked."""
    place = Path(sys.argv[0]).resolve()
    parser = argparse.ArgumentParser(description="Solve an exported piping job with OpenSees.")
    parser.add_argument("--case", action="append", choices=list(job["cases"]), help="only this")
    parser.add_argument("--compare", type=Path, metavar="LINE.json", help="report of trunnion run")
    parser.add_argument("--allow", type=float, default=TOLERANCE, help="of the largest")
    parser.add_argument("-o", type=Path, default=place.with_suffix(".json"), help="answer")
    chosen = parser.parse_args(arguments)
    import openseespy.opensees as ops

    ops.logFile("/dev/null" if sys.platform != "win32" else "NUL", "-noEcho")
    cases = {name: solve(job, name) for name in chosen.case or job["cases"]}
    ops.wipe()
    found = {"program": f"OpenSees {ops.version()}", "deck": job["deck"], "cases": cases}
    chosen.o.write_text(json.dumps(found, indent=1) + "\n")
    for name, case in cases.items():
        print(f"\n{name} = {job['cases'][name]['text']}")
        print_case(case)
    print(f"\nwrote {chosen.o}")
    if chosen.compare is None:
        return int(not all(case["converged"] for case in cases.values()))
    own = json.loads(chosen.compare.read_text())
    rows = differences(own, found)
    print("\n" + table(rows, "OpenSees", chosen.allow))
    for name, why in unanswered(own, found).items():
        print(f"{name}: not compared: {why}")
    good = agrees(rows, laws(found), chosen.allow) and not unanswered(own, found)
    print("they agree" if good else "they DIFFER")
    return int(not good)


def print_case(case: Mapping[str, Any]) -> None:
    """Print the support loads and the movements of a case."""
    if not case["converged"]:
        print(f"  not solved: {case['cause']}")
        return
    print("  force and moment on the pipe [N, N m]")
    for row in case["supports"]:
        numbers = "".join(f"{x:14.6g}" for x in (*row["force"], *row["moment"]))
        print(f"  {row['name'][:24]:24}{numbers}")
    print("  movement [m, rad]")
    for label, six in case["nodes"].items():
        print(f"  {label[:24]:24}" + "".join(f"{x:14.6g}" for x in six))
