"""The fixed pattern of the stiffness: lower triangle by columns, in blocks of six a node."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import I4, Contacts, Sliders

SIX = 6


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
    colptr, row = _columns(n, neighbours, begin, unique % n)
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


def _columns(
    n: int, neighbours: np.ndarray, begin: np.ndarray, higher: np.ndarray
) -> tuple[I4, I4]:
    """Column pointers and rows: each column of a node holds its block from its own row down."""
    blocks = np.empty(n + len(higher), np.int64)  # a node, then its higher neighbours
    own = np.arange(n) + begin[:-1]
    is_own = np.zeros(len(blocks), bool)
    is_own[own] = True
    blocks[own] = np.arange(n)
    blocks[~is_own] = higher
    rows = (SIX * blocks[:, None] + np.arange(SIX)).ravel()
    length = (SIX * (neighbours + 1))[:, None] - np.arange(SIX)
    colptr = np.concatenate(([0], np.cumsum(length.ravel())))
    start = (SIX * own)[:, None] + np.arange(SIX)
    index = np.arange(colptr[-1]) - np.repeat(colptr[:-1] - start.ravel(), length.ravel())
    return colptr.astype(np.int32), rows[index].astype(np.int32)
