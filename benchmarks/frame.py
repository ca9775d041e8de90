"""A rack as a frame of Euler-Bernoulli beams in NumPy: nothing of it comes from Trunnion.

It judges answers (residuals in extended precision, `exact`) and gives the full, uncondensed
matrix whose CHOLMOD factorisation is the floor (`floor`).  Extended precision is NumPy's
longdouble: 64 bits of mantissa on x86.  Beams: Przemieniecki, Theory of Matrix Structural
Analysis (1968), eq. 5.116.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rack_line import Rack

LD = np.longdouble
Extended = NDArray[np.longdouble]
I8 = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Frame:
    """Beams of a rack, those of one length and direction as one class.

    n : nodes.  freedom : (n_elem, 12) freedoms of the elements.  of : (n_elem,) class.
    k : (n_class, 12, 12) global stiffness.  load : (6 n,) weight and temperature [N, N m].
    """

    n: int
    freedom: I8
    of: I8
    k: Extended
    load: Extended

    def product(self, u: Extended) -> Extended:
        """Forces (6 n,) that hold displacements u (6 n,)."""
        out = np.zeros(6 * self.n, LD)
        for c, k in enumerate(self.k):
            at = self.freedom[self.of == c]
            force = u[at] @ k.T
            for half in (slice(0, 6), slice(6, 12)):  # no freedom twice in a half of a line
                np.add.at(out, at[:, half], force[:, half])
        return out

    def matrix(self) -> Any:
        """Stiffness of the beams alone, SciPy CSC in double."""
        from scipy.sparse import coo_matrix

        value = self.k.astype(np.float64)[self.of]
        row = np.repeat(self.freedom, 12, axis=1).ravel()
        column = np.tile(self.freedom, (1, 12)).ravel()
        size = 6 * self.n
        return coo_matrix((value.ravel(), (row, column)), shape=(size, size)).tocsc()


def build_frame(rack: Rack) -> Frame:
    """Classes of beams, their stiffness and the loads of weight and temperature."""
    xyz, ends = np.array(rack["nodes"], LD), np.array(rack["elements"], np.int64)
    arm = xyz[ends[:, 1]] - xyz[ends[:, 0]]
    kinds, of = np.unique(np.round(arm.astype(np.float64), 9), axis=0, return_inverse=True)
    of = of.ravel()
    k, load = zip(*(_beam(kind.astype(LD), rack) for kind in kinds), strict=True)
    freedom = (6 * ends[:, :, None] + np.arange(6)).reshape(len(ends), 12)
    total = np.zeros(6 * len(xyz), LD)
    np.add.at(total, freedom, np.array(load)[of])
    return Frame(len(xyz), freedom, of, np.array(k), total)


def _beam(arm: Extended, rack: Rack) -> tuple[Extended, Extended]:
    """Global stiffness (12, 12) and equivalent nodal loads (12,) of a beam along `arm`."""
    section, pipe = rack["section"], rack["pipe"]
    length = np.sqrt(arm @ arm)
    x = arm / length
    aside = np.array([0, 1, 0] if abs(x[1]) < 0.9 else [1, 0, 0], LD)
    z = np.cross(x, aside)
    z = z / np.sqrt(z @ z)
    axes = np.stack([x, np.cross(z, x), z])
    turn = np.kron(np.eye(4), axes)
    k = turn.T @ _stiffness(length, LD(pipe["E"]), section) @ turn
    down = np.array([0, -1, 0], LD) * LD(section["w"]) * length / 2
    lever = np.cross(arm, down) / 6  # q L^2 / 12 of the part across the pipe
    pull = x * LD(section["Fth"])
    return k, np.concatenate([down - pull, lever, down + pull, -lever])


def _stiffness(length: np.longdouble, e: np.longdouble, section: dict[str, float]) -> Extended:
    area, inertia, polar, g = (LD(section[name]) for name in ("A", "I", "J", "G"))
    k = np.zeros((12, 12), LD)
    for i, value in ((0, e * area / length), (3, g * polar / length)):
        k[i, i] = k[i + 6, i + 6] = value
        k[i, i + 6] = k[i + 6, i] = -value
    bend = e * inertia / length**3
    for v, r, s in ((1, 5, 1), (2, 4, -1)):  # deflection, rotation, sign of their product
        shape = np.array(
            [
                [12, s * 6 * length, -12, s * 6 * length],
                [s * 6 * length, 4 * length**2, -s * 6 * length, 2 * length**2],
                [-12, -s * 6 * length, 12, -s * 6 * length],
                [s * 6 * length, 2 * length**2, -s * 6 * length, 4 * length**2],
            ],
            LD,
        )
        at = np.array([v, r, v + 6, r + 6])
        k[np.ix_(at, at)] = bend * shape
    return k
