"""The fixed pattern of the stiffness: lower triangle by columns, in blocks of six a node."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trunnion import kernels
from trunnion.arrays import I4, Contacts, Sliders


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Pattern:
    """Columns of the lower triangle and where each pair of nodes stands in it.

    colptr : (6 n_node + 1,) first entry of each column.
    row : (nnz,) row of each entry, ascending in a column.
    element_rank, contact_rank, slider_rank, snubber_rank : place of the higher node among the
        neighbours of the lower one, for items that join two nodes; 0 for items on ground.
    """

    colptr: I4
    row: I4
    element_rank: I4
    contact_rank: I4
    slider_rank: I4
    snubber_rank: I4

    @property
    def diagonal(self) -> I4:
        """Entry of each freedom's diagonal."""
        return self.colptr[:-1]


def build_pattern(
    n: int, ends: I4, contacts: Contacts, sliders: Sliders, snubbers: Contacts
) -> Pattern:
    """Pattern of all elements, contacts, sliders and snubbers, open or closed."""
    groups = (
        ends,
        np.column_stack((contacts.node, contacts.cnode)),
        np.column_stack((sliders.node, sliders.cnode)),
        np.column_stack((snubbers.node, snubbers.cnode)),
    )
    pairs = np.concatenate(groups).astype(np.int64)
    low, high = pairs.min(axis=1), pairs.max(axis=1)
    joined = low >= 0  # ground is -1
    key = low * n + high
    unique, inverse = _unique(key[joined])
    neighbours = np.bincount(unique // n, minlength=n)
    begin = np.concatenate(([0], np.cumsum(neighbours)))
    rank = np.zeros(len(pairs), np.int32)
    rank[joined] = (np.arange(len(unique)) - begin[unique // n])[inverse]
    higher = (unique % n).astype(np.int32)
    colptr, row = kernels.pattern_columns(begin.astype(np.int32), higher)
    cut = np.cumsum([len(g) for g in groups])[:-1]
    return Pattern(colptr, row, *np.split(rank, cut))


def _unique(key: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sorted keys, each once, and where each key went (np.unique would import numpy.ma)."""
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    first = np.ones(len(key), np.bool_)
    first[1:] = ordered[1:] != ordered[:-1]
    inverse = np.empty(len(key), np.int64)
    inverse[order] = np.cumsum(first) - 1
    return ordered[first], inverse
