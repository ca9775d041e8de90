"""A factor in double-double for stiffnesses that the factor in doubles cannot solve.

It knows the same matrix as the residuals do: members' tip stiffnesses and contact tangents,
summed without rounding to doubles (`fortran/skyline.f90`).  Its cost grows with the square of the
bandwidth, so it has a limit.
"""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trunnion import kernels
from trunnion.arrays import F8, I4

if TYPE_CHECKING:
    from trunnion.solver.structure import Structure

MOST = 300_000_000  # multiplications of one factorisation, about ten seconds
SIX = 6


class ExtendedFactor:
    """L D L' of a structure's tangents in double-double."""

    def __init__(self, structure: "Structure") -> None:
        self.structure = structure
        self.place = _ordering(structure)
        rows = _row_lengths(structure, self.place)
        self.operations = int((rows.astype(np.float64) ** 2).sum())
        self.first = np.concatenate(([0], np.cumsum(rows))).astype(np.int32)
        self.hi = self.lo = np.zeros(0)

    @property
    def feasible(self) -> bool:
        """A factorisation takes seconds, not hours."""
        return self.operations <= MOST

    def factorise(self, tangent: F8, slider_tangent: F8, shift: float) -> float:
        """Factor these tangents; returns the smallest pivot relative to its diagonal.

        Raises
        ------
        NotPositiveDefiniteError
            A pivot is not positive.
        """
        s, m = self.structure, self.structure.members
        hi, lo = np.zeros(int(self.first[-1])), np.zeros(int(self.first[-1]))
        where = self.place, self.first
        if len(m.ends):
            kernels.skyline_members(m.k, m.axes, m.d, m.ends, *where, hi, lo)
        kernels.skyline_contacts(s.at, tangent, *where, hi, lo)
        kernels.skyline_contacts(s.slider_at, slider_tangent, *where, hi, lo)
        diagonal = self.first[1:] - 1
        row = (SIX * self.place[:, None] + np.arange(SIX))[s.absent]
        hi[diagonal[row]] = 1.0
        hi[diagonal] += shift
        least = kernels.skyline_factorise(self.first, hi, lo)
        self.hi, self.lo = hi, lo
        return least

    def solve(self, b: F8) -> F8:
        """Solve for rows (m, n_dof)."""
        return kernels.skyline_solve(self.place, self.first, self.hi, self.lo, b)


def _ordering(structure: "Structure") -> I4:
    """Place of each node in the elimination: reverse Cuthill-McKee, a small envelope."""
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    a, b = _pairs(structure)
    n = structure.n_node
    graph = csr_matrix((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, a])), shape=(n, n))
    place = np.empty(n, np.int32)
    place[reverse_cuthill_mckee(graph, symmetric_mode=True)] = np.arange(n, dtype=np.int32)
    return place


def _pairs(structure: "Structure") -> tuple[I4, I4]:
    """Nodes that a member, a contact or a slider joins."""
    at = (structure.at, structure.slider_at)
    a = np.concatenate([structure.members.ends[:, 0], *(x[:, 0] for x in at)])
    b = np.concatenate([structure.members.ends[:, 1], *(x[:, 1] for x in at)])
    joined = b >= 0
    return a[joined], b[joined]


def _row_lengths(structure: "Structure", place: I4) -> NDArray[np.int64]:
    """Entries of each row of the lower triangle, from its first to the diagonal."""
    a, b = (place[x] for x in _pairs(structure))
    leftmost = np.arange(structure.n_node)
    np.minimum.at(leftmost, np.maximum(a, b), np.minimum(a, b))
    c = np.arange(SIX)
    length: NDArray[np.int64] = (
        SIX * (np.arange(structure.n_node) - leftmost)[:, None] + c + 1
    ).ravel()
    return length
