"""What passes between the solver's modules: loads, a point, a law of friction, a response."""

from dataclasses import dataclass

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, I4


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Inside:
    """Loads of elements and of all nodes: what members made of several elements hold inside.

    free, resultant : (n_elem, 6), nodal : (n_node, 6); as in `Forcing`.
    """

    free: F8
    resultant: F8
    nodal: F8

    def mixed(self, a: float, other: "Inside", b: float) -> "Inside":
        """A times these and b times others."""
        return Inside(
            a * self.free + b * other.free,
            a * self.resultant + b * other.resultant,
            a * self.nodal + b * other.nodal,
        )


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Forcing:
    """Loads as the kernels take them; linear, so that steps are mixtures of two.

    free : (n_member, 6) free tip deformation, member's axes [m, rad].
    resultant : (n_member, 6) of the distributed load, about the base [N, N m].
    nodal : (n_node, 6) at the nodes of the equations [N, N m].
    inside : loads of the elements that the members are made of.
    base : (n_contact, 3), slider_base : (n_slider, 3) movement under the supports.
    preload : (n_contact, 3) cold loads of hangers on the pipe [N].
    """

    free: F8
    resultant: F8
    nodal: F8
    inside: Inside
    base: F8
    slider_base: F8
    preload: F8
    mux: float

    def toward(self, other: "Forcing", t: float) -> "Forcing":
        """Loads a fraction t of the way to `other`; exactly `other` at 1."""
        if t == 1.0:
            return other
        return self._mixed(1.0 - t, other, t)

    def _mixed(self, a: float, other: "Forcing", b: float) -> "Forcing":
        inside = self.inside
        if not (inside.free is self.free and inside.nodal is self.nodal):
            inside = inside.mixed(a, other.inside, b)
        return Forcing(
            a * self.free + b * other.free,
            a * self.resultant + b * other.resultant,
            a * self.nodal + b * other.nodal,
            inside,
            a * self.base + b * other.base,
            a * self.slider_base + b * other.slider_base,
            a * self.preload + b * other.preload,
            other.mux,
        )


@dataclass(slots=True, eq=False, repr=False)
class Point:
    """Displacements in double-double: u + low, each (n_node, 6) [m, rad]."""

    u: F8
    low: F8

    @classmethod
    def zero(cls, n_node: int) -> "Point":
        """Undeformed."""
        return cls(np.zeros((n_node, 6)), np.zeros((n_node, 6)))

    def copy(self) -> "Point":
        """Same point in arrays of its own."""
        return Point(self.u.copy(), self.low.copy())

    def become(self, other: "Point") -> None:
        """Take over the displacements of another point."""
        self.u[:], self.low[:] = other.u, other.low

    def move(self, p: F8, step: float = 1.0) -> None:
        """Go step times p."""
        kernels.accumulate(p, step, self.u, self.low)


@dataclass(slots=True, eq=False, repr=False)
class Sliding:
    """What friction is, for one pass: capacities given, or `coupled` to the normal forces.

    capacity, kf, mu : (n_slider,) [N], [N/m], -.  datum : (n_slider, 3) committed [m].
    """

    capacity: F8
    kf: F8
    mu: F8
    datum: F8
    coupled: bool = False


@dataclass(slots=True, eq=False, repr=False)
class Response:
    """What supports answer to a displacement: forces, states and tangents; see `State`."""

    capacity: F8
    side: I4
    reaction: F8
    tangent: F8
    mode: I4
    friction: F8
    slide: F8
    slider_tangent: F8
    normal: F8
