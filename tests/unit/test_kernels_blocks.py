"""Matrices of dense blocks of six, as the stiffness is, and what goes from supports to nodes."""

import numpy as np
import pytest
import scipy.sparse as sp

from trunnion import kernels
from trunnion.errors import NotPositiveDefiniteError
from trunnion.kernels import SpdFactor

SEEDS = range(6)


def random_graph(rng, n):
    """Edges (i < j) of a random connected graph, sorted by lower node."""
    edges = {(int(rng.integers(0, j)), j) for j in range(1, n)}
    edges |= {tuple(sorted(map(int, rng.choice(n, 2, replace=False)))) for _ in range(n // 2)}
    return sorted(edges)


def pattern_of(n, edges):
    """Column pointers and rows of the kernel for a graph."""
    low = np.array([i for i, _ in edges], np.int64)
    higher = np.array([j for _, j in edges], np.int32)
    begin = np.concatenate(([0], np.cumsum(np.bincount(low, minlength=n)))).astype(np.int32)
    return kernels.pattern_columns(begin, higher)


def definite(rng, n, edges):
    """A positive definite matrix with full blocks on a graph, as its lower triangle."""
    a = np.zeros((6 * n, 6 * n))
    for i, j in edges:
        block = rng.normal(size=(12, 12))
        both = np.r_[6 * i : 6 * i + 6, 6 * j : 6 * j + 6]
        a[np.ix_(both, both)] += block @ block.T
    return a + 1e-3 * np.eye(6 * n)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_pattern_is_the_lower_triangle_of_the_graphs_blocks(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 12))
    edges = random_graph(rng, n)
    colptr, row = pattern_of(n, edges)
    dense = np.kron(np.eye(n), np.ones((6, 6)))
    for i, j in edges:
        dense[6 * j : 6 * j + 6, 6 * i : 6 * i + 6] = 1.0
    want = sp.csc_matrix(np.tril(dense))
    want.sort_indices()
    assert np.array_equal(colptr, want.indptr)
    assert np.array_equal(row, want.indices)


def test_nodes_without_neighbours_have_blocks_of_their_own():
    colptr, row = pattern_of(2, [])
    assert len(row) == 42
    assert colptr.tolist() == [0, 6, 11, 15, 18, 20, 21, 27, 32, 36, 39, 41, 42]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("whole", [True, False])
def test_a_blocked_matrix_is_factored_and_counted_like_any_other(seed, whole):
    """With one entry missing the blocks are not dense, and the whole pattern is analysed."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 20))
    edges = random_graph(rng, n)
    a = definite(rng, n, edges)
    if not whole:
        i, j = 6 * edges[0][0], 6 * edges[0][1] + 3
        a[i, j] = a[j, i] = 0.0
    lower = sp.csc_matrix(np.tril(a))
    factor = SpdFactor(lower.indptr.astype(np.int32), lower.indices.astype(np.int32))
    factor.factorise(lower.data)
    b = rng.normal(size=(3, 6 * n))
    x = factor.solve(b)
    # backward stable: 1e-13 of what is summed, for some hundred freedoms
    assert np.abs(x @ a - b).max() <= 1e-13 * np.abs(a).max() * np.abs(x).max()
    assert np.array_equal(factor.solve(b[1]), x[1])
    shift = np.median(np.linalg.eigvalsh(a))
    moved = sp.csc_matrix(np.tril(a))
    moved.data[moved.indptr[:-1]] -= shift
    negative, r = factor.inertia(moved.data, b[0])
    assert negative == 3 * n
    assert np.abs(r).max() <= 1e-8 * np.abs(a).max()
    assert np.array_equal(factor.solve(b[1]), x[1])  # the factor stays as it was


def test_the_stuck_freedom_is_named_in_the_callers_order():
    rng = np.random.default_rng(3)
    n, edges = 9, random_graph(np.random.default_rng(3), 9)
    a = definite(rng, n, edges)
    for stuck in (0, 17, 53):
        bad = a.copy()
        bad[stuck, stuck] = -1.0
        lower = sp.csc_matrix(np.tril(bad))
        factor = SpdFactor(lower.indptr.astype(np.int32), lower.indices.astype(np.int32))
        with pytest.raises(NotPositiveDefiniteError) as found:
            factor.factorise(lower.data)
        assert found.value.where == stuck


def places(rng, n_node, n):
    """Rows of `at` of random contacts: some on ground, some turning."""
    node = rng.integers(0, n_node, n)
    cnode = np.where(rng.random(n) < 0.5, -1, (node + 1) % n_node)
    offset = np.where(rng.random(n) < 0.3, 3, 0)
    rest = np.zeros((3, n), int)
    return np.ascontiguousarray(np.stack([node, cnode, rest[0], offset, *rest[1:]], 1), np.int32)


@pytest.mark.parametrize("seed", SEEDS)
def test_scatter_is_the_transpose_of_gather(seed):
    rng = np.random.default_rng(seed)
    at = places(rng, 7, 20)
    p, force = rng.normal(size=(7, 6)), rng.normal(size=(20, 3))
    w = kernels.gather(at, p)
    for i, (node, cnode, _, offset, *_) in enumerate(at):
        other = p[cnode, offset : offset + 3] if cnode >= 0 else 0.0
        assert np.array_equal(w[i], p[node, offset : offset + 3] - other)
    r = np.zeros((7, 6))
    kernels.scatter(at, force, r)
    assert (force * w).sum() == pytest.approx((r * p).sum(), rel=1e-13)


@pytest.mark.parametrize("bent", [False, True])
def test_shares_of_end_forces_arrive_at_both_ends(bent):
    rng = np.random.default_rng(2)
    ends = np.array([[0, 1], [1, 2], [2, 0]], np.int32)
    f, d, shares = rng.normal(size=(3, 2, 6)), rng.normal(size=(3, 3)), (1.0, -2.0, 0.5)
    r = np.ones((3, 6))
    kernels.add_ends(ends, np.array(shares), d, bent, f, r)
    want = np.ones((3, 6))
    for share, pair, own, arm in zip(shares, ends, f, d, strict=True):
        want[pair[0]] += share * own[0]
        want[pair[1]] += share * own[1]
        if bent:
            want[pair[0], 3:] += share * np.cross(arm * (1.0, -0.75, -0.5), own[1, :3])
    assert np.allclose(r, want, rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_the_largest_movement_and_force_tell_of_what_is_no_number(bad):
    rng = np.random.default_rng(1)
    p, a, at = rng.normal(size=(9, 6)), rng.normal(size=(9, 3)), places(rng, 9, 9)
    turning = at[:, 3] == 3
    assert turning.any()
    assert not turning.all()
    assert kernels.largest_moves(p) == (np.abs(p[:, :3]).max(), np.abs(p[:, 3:]).max())
    assert kernels.largest_moves(np.zeros((0, 6))) == (0.0, 0.0)
    assert kernels.largest_forces(at, a) == (np.abs(a[~turning]).max(), np.abs(a[turning]).max())
    for where in range(9):
        q = p.copy()
        q[where, 1] = bad
        assert np.array_equal(kernels.largest_moves(q)[0], np.abs(bad), equal_nan=True)
        assert kernels.largest_moves(q)[1] == kernels.largest_moves(p)[1]
        b = a.copy()
        b[where, 2] = bad
        hit = kernels.largest_forces(at, b)[1 if turning[where] else 0]
        assert np.array_equal(hit, np.abs(bad), equal_nan=True)


def test_nodes_between_soft_and_stiff_elements_are_kept():
    """Bending stiffnesses EI/L^3 of 1, 1e4 and 1e6 N/m in a row, 1e5 apart is too much."""
    ends = np.array([[0, 1], [1, 2], [2, 3], [3, 4]], np.int32)
    rigidity = np.zeros((4, 4))
    rigidity[:, 2] = 1.0, 8e4, 1e6, 1e-3
    length = np.array([1.0, 2.0, 1.0, 1.0])
    for joins, want in (([1, 1, 1, 1], [0, 0, 0, 1, 0]), ([1, 1, 1, 0], [0, 0, 0, 0, 0])):
        keep = np.zeros(5, np.int32)
        kernels.keep_uneven(ends, np.array(joins, np.int32), rigidity, length, 1e5, keep)
        assert keep.tolist() == want
