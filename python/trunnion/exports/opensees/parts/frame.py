"""The domain of one case in OpenSees.

The modules of this folder are the text of every exported script, one after the other; nothing but
OpenSeesPy and Python's own library is used in them.
"""

from collections.abc import Mapping
from math import inf
from typing import Any

from trunnion.exports.opensees.parts.vectors import Vector

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
        self.nodes, self.elements = len(self.node), 0
        self.transforms: dict[tuple[float, ...], int] = {}
        self.springs: dict[tuple[float, ...], int] = {}
        self.straight: dict[str, int] = {}
        self.hinges: dict[str, list[int]] = {}
        self.hung: dict[str, list[int]] = {}  # chain -> nodes of its rigid parts
        self.link: dict[str, int] = {}
        self.held: list[tuple[int, int]] = []  # card, element of each spring of a support
        self.ground: dict[int, int] = {}  # card -> its ground
        self.moved: dict[int, Vector] = {}  # grounds that move
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

    def new_ground(self, label: str, moved: Vector) -> int:
        """Add a ground at a node: fixed, or moved with the loads."""
        tag = self.new_node(self.job["nodes"][label])
        if any(moved):
            self.moved[tag] = moved
        else:
            self.ops.fix(tag, *[1] * 6)
        return tag

    def analyse(self, algorithm: str, steps: int, balance: float, most: int) -> int:
        """Solve until the norm out of balance is small; 0: done."""
        self.ops.constraints("Transformation")
        self.ops.numberer("RCM")
        self.ops.system("UmfPack")
        self.ops.test("NormUnbalance", balance, most, 0)
        self.ops.algorithm(algorithm)
        self.ops.integrator("LoadControl", 1.0 / steps)
        self.ops.analysis("Static")
        return int(self.ops.analyze(steps))

    def load(self, node: int, six: Vector) -> None:
        """Add forces and moments at a node."""
        if any(six):
            self.largest = max(self.largest, *map(abs, six))
            self.ops.load(node, *six)
