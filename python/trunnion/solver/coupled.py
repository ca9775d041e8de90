"""The consistent step of the coupled law: friction capacities follow the normal forces.

The tangent K - C has an unsymmetric part C of low rank (mu dN/du of the sliding supports).  It is
never factored: GMRES on the symmetric factor of K takes a few solves.
"""

from collections.abc import Callable
from math import hypot, sqrt

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, SLIP
from trunnion.solver.quantities import Response, Sliding
from trunnion.solver.structure import Structure

KRYLOV = 60  # most solves of one step
SHARP = 1e-12  # of the right-hand side


def coupled_step(structure: Structure, response: Response, sliding: Sliding, r: F8) -> F8:
    """Solve (K - C) p = r on the factor at hand; returns p (n_node, 6)."""
    if not (response.mode == SLIP).any():
        return structure.solve(r)

    def product(f: F8) -> F8:
        return f - structure.coupling(response, sliding, structure.solve(f))[0]

    return structure.solve(gmres(product, r, SHARP, KRYLOV))


def gmres(product: Callable[[F8], F8], b: F8, sharp: float, limit: int) -> F8:
    """Solve A x = b, A given by its product; Saad and Schultz (1986), modified Gram-Schmidt."""
    size = sqrt(kernels.inner(b, b))
    if size == 0.0:
        return np.zeros_like(b)
    basis = np.empty((limit + 1, b.size))
    basis[0] = b.ravel() / size
    h, g = np.zeros((limit + 1, limit)), [size]
    turns: list[tuple[float, float]] = []
    n = 0
    for j in range(limit):
        column = kernels.orthogonalise(
            j + 1, basis, product(basis[j].reshape(b.shape)).ravel()
        ).tolist()
        below, most = column[j + 1], max(map(abs, column))
        for i, (c, s) in enumerate(turns):
            column[i], column[i + 1] = (
                c * column[i] + s * column[i + 1],
                c * column[i + 1] - s * column[i],
            )
        length = hypot(column[j], column[j + 1])
        n = j + 1
        if length == 0.0:
            h[: j + 1, j] = column[: j + 1]
            break
        c, s = column[j] / length, column[j + 1] / length
        turns.append((c, s))
        column[j] = length
        h[: j + 1, j] = column[: j + 1]
        g[j], more = c * g[j], -s * g[j]
        g.append(more)
        if abs(more) <= sharp * size or below <= 1e-15 * most:
            break
    y = _back(h[:n, :n], g[:n])
    x = np.zeros(b.size)
    for value, v in zip(y, basis, strict=False):
        x += value * v
    return x.reshape(b.shape)


def _back(h: F8, g: list[float]) -> list[float]:
    """Solve a small upper triangle; what has no pivot is left out."""
    y = list(g)
    for i in reversed(range(len(g))):
        y[i] -= sum(float(h[i, j]) * y[j] for j in range(i + 1, len(g)))
        y[i] = y[i] / float(h[i, i]) if h[i, i] != 0.0 else 0.0
    return y
