"""Eigenpairs of a pencil: by dense algebra, by Lanczos, and corrected to the last digits."""

import inspect
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8
from trunnion.solver.pencil import Pencil
from trunnion.solver.quantities import Point
from trunnion.threads import one_thread

CLUSTER = 1e-7  # relative distance of eigenvalues that are one
CORRECTIONS = 6
ENOUGH = 1e-12  # residual at which correction ends


def few(pencil: Pencil, k: int) -> tuple[F8, F8]:
    """Lowest k pairs from the flexibility of the freedoms with mass, all of them at once."""
    heavy, root = pencil.mass_root
    force = np.zeros((root.shape[1], len(pencil.heavy)))
    force[:, heavy] = root.T
    image = pencil.solve(force)
    a = image[:, heavy] @ root
    value, turn = np.linalg.eigh(0.5 * (a + a.T))
    value, turn = value[::-1][:k], turn[:, ::-1][:, :k]
    x = turn.T @ image
    return _ordered(pencil, 1.0 / value - pencil.shift, x)


def many(pencil: Pencil, k: int, known: F8) -> tuple[F8, F8]:
    """Lowest k pairs by ARPACK in shift-invert mode; those `known` are left out of the search.

    The start is fixed, so that the same deck gives the same bytes.
    """
    from scipy.sparse.linalg import LinearOperator, eigsh

    n = len(pencil.heavy)
    image = pencil.mass_product(known) if len(known) else known

    def solve(b: F8) -> F8:
        x = pencil.solve(b.reshape(1, n))
        without: F8 = _without(x, known, image)[0]
        return without

    more: dict[str, Any] = {}
    if "rng" in inspect.signature(eigsh).parameters:
        more["rng"] = np.random.default_rng(1)
    missing = k - len(known)
    start = np.random.default_rng(2).normal(size=n)
    with one_thread():  # SciPy has a BLAS of its own
        value, vector = eigsh(
            LinearOperator((n, n), matvec=solve, dtype=np.float64),  # its shape alone is used
            missing,
            M=pencil.mass_matrix,
            sigma=-pencil.shift,
            OPinv=LinearOperator((n, n), matvec=solve, dtype=np.float64),
            v0=solve(pencil.mass_product(start[None])[0]),
            ncv=min(n, 3 * missing + 20),
            tol=1e-11,
            maxiter=1000,
            **more,
        )
    del value
    x = np.concatenate((known, np.ascontiguousarray(vector.T)))
    x = pencil.solve(pencil.mass_product(x))  # takes out what has no mass
    return _ritz(pencil, x)


def _ritz(pencil: Pencil, x: F8) -> tuple[F8, F8]:
    """Best pairs in the span of x, which are images of the solve."""
    stiffness = pencil.stiffness_product([_point(v) for v in x])
    a, b = x @ stiffness.T, x @ pencil.mass_product(x).T
    size = 1.0 / np.sqrt(np.diag(b))
    a, b = (0.5 * (m + m.T) * size * size[:, None] for m in (a, b))
    root = np.linalg.cholesky(b)
    inverse = np.linalg.inv(root)
    value, turn = np.linalg.eigh(inverse @ a @ inverse.T)
    return _ordered(pencil, value, (turn.T @ inverse * size) @ x)


def _ordered(pencil: Pencil, value: F8, x: F8) -> tuple[F8, F8]:
    order = np.argsort(value, kind="stable")
    x = x[order]
    size = np.sqrt(np.einsum("ij,ij->i", x, pencil.mass_product(x)))
    return value[order], x / size[:, None]


def separate(pencil: Pencil, w2: F8, x: F8) -> F8:
    """Fix what eigenvalues leave open: the sign, and the turn among modes of one frequency.

    Among those, participation in X goes to the first, the rest of that in Y to the second, and
    so on; then the largest translation of a mode is positive.
    """
    n_node = x.shape[1] // 6
    unit = np.tile(np.eye(6)[:3], n_node)
    carried = pencil.mass_product(unit)
    x = x.copy()
    total = np.sqrt(np.einsum("ij,ij->i", unit, carried).max(initial=0.0))
    for first, behind in _clusters(pencil, w2):
        if behind - first > 1:
            take = x[first:behind] @ carried.T
            take = take[:, np.linalg.norm(take, axis=0) > 1e-5 * total]
            if take.size:
                turn, _ = np.linalg.qr(take, mode="complete")
                x[first:behind] = turn.T @ x[first:behind]
    size = np.sqrt(np.einsum("ij,ij->i", x, pencil.mass_product(x)))
    x /= size[:, None]
    for row in x:
        moved = row.reshape(-1, 6)[:, :3].ravel()
        if not np.abs(moved).max() > 1e-9 * np.abs(row).max():
            moved = row
        largest = np.flatnonzero(np.abs(moved) >= (1.0 - 1e-6) * np.abs(moved).max())[0]
        row *= np.sign(moved[largest])
    return x


def _clusters(pencil: Pencil, w2: F8) -> list[tuple[int, int]]:
    """Where runs of equal eigenvalues begin and end."""
    cut = np.flatnonzero(~_same(pencil, w2[1:], w2[:-1])) + 1
    edge = [0, *cut.tolist(), len(w2)]
    return list(pairwise(edge))


def _same(pencil: Pencil, a: F8, b: F8) -> NDArray[np.bool_]:
    """Eigenvalues that are one; rigid ones differ by noise."""
    size = np.maximum(np.maximum(np.abs(a), np.abs(b)), pencil.shift)
    same: NDArray[np.bool_] = np.abs(a - b) <= CLUSTER * size
    return same


def correct(pencil: Pencil, w2: F8, x: F8) -> tuple[F8, F8, F8, F8]:
    """Correct pairs by their residuals, formed from deformations, in double-double.

    Returns eigenvalues, vectors (high and low part) and |K x - w2 M x| / |w2 M x|.
    """
    points = [_point(v) for v in x]
    best = np.full(len(x), np.inf)
    kept = [p.copy() for p in points]
    value = w2.copy()
    for _ in range(CORRECTIONS):
        here = np.stack([p.u.ravel() for p in points])
        stiffness, mass = pencil.stiffness_product(points), pencil.mass_product(here)
        rayleigh = np.einsum("ij,ij->i", here, stiffness) / np.einsum("ij,ij->i", here, mass)
        r = rayleigh[:, None] * mass - stiffness
        size = _relative(pencil, rayleigh, r, mass)
        better = size < best
        for i in np.flatnonzero(better):
            kept[i] = points[i].copy()
        gained = bool((size < 0.5 * best).any())
        best, value = np.where(better, size, best), np.where(better, rayleigh, value)
        if not gained or best.max(initial=0.0) < ENOUGH:
            break
        step = _without(pencil.solve(r), here, mass) + _mixed(pencil, rayleigh, r, here)
        for point, move in zip(points, step, strict=True):
            point.move(np.ascontiguousarray(move.reshape(-1, 6)))
    order = np.argsort(value, kind="stable")
    for first, behind in _clusters(pencil, value[order]):  # these are in order already
        order[first:behind] = np.sort(order[first:behind])
    high = np.stack([kept[i].u.ravel() for i in order])
    low = np.stack([kept[i].low.ravel() for i in order])
    return np.sort(value), high, low, best[order]


def _mixed(pencil: Pencil, w2: F8, r: F8, x: F8) -> F8:
    """What takes each mode's share of the other modes found out of it."""
    apart = w2[:, None] - w2
    far = ~_same(pencil, w2[:, None], w2)
    share = np.divide(r @ x.T, apart, out=np.zeros_like(apart), where=far)
    step: F8 = -share @ x
    return step


def residuals(pencil: Pencil, w2: F8, x: F8, low: F8) -> F8:
    """(m,) |K x - w2 M x| / |w2 M x| of pairs whose vectors have low parts; rows of freedoms."""
    points = [
        Point(v.reshape(-1, 6).copy(), e.reshape(-1, 6).copy()) for v, e in zip(x, low, strict=True)
    ]
    mass = pencil.mass_product(x)
    return _relative(pencil, w2, w2[:, None] * mass - pencil.stiffness_product(points), mass)


def _relative(pencil: Pencil, w2: F8, r: F8, mass: F8) -> F8:
    """|r| / |w2 M x|; of rigid modes to the lowest elastic eigenvalue."""
    scale = np.abs(w2)
    rigid = scale <= 1e-6 * pencil.shift
    if rigid.any():
        scale[rigid] = scale[~rigid].min(initial=np.inf)
        scale[~np.isfinite(scale)] = pencil.shift
    found: F8 = np.linalg.norm(r, axis=1) / (scale * np.linalg.norm(mass, axis=1))
    return found


def _without(x: F8, known: F8, image: F8) -> F8:
    """Rows of x less their parts along `known`, mass-normalised, with M known = image."""
    return x - (x @ image.T) @ known if len(known) else x


def _point(v: F8) -> Point:
    u = v.reshape(-1, 6).copy()
    return Point(u, np.zeros_like(u))
