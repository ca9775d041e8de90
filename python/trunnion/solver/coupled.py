"""The consistent step of the coupled law: friction capacities follow the normal forces.

The tangent K - C has an unsymmetric part C of low rank (mu dN/du of the sliding supports).  It is
never factored: GMRES on the symmetric factor of K takes a few solves.
"""

import numpy as np

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


def gmres(product, b: F8, sharp: float, limit: int) -> F8:  # type: ignore[no-untyped-def]
    """Solve A x = b, A given by its product; Saad and Schultz (1986), modified Gram-Schmidt."""
    size = float(np.linalg.norm(b))
    if size == 0.0:
        return np.zeros_like(b)
    basis = [b / size]
    h = np.zeros((limit + 1, limit))
    g = np.zeros(limit + 1)
    g[0] = size
    turn: list[tuple[float, float]] = []
    n = 0
    for j in range(limit):
        w = product(basis[j])
        for i, v in enumerate(basis):
            h[i, j] = float(np.vdot(v, w))
            w -= h[i, j] * v
        h[j + 1, j] = float(np.linalg.norm(w))
        below = h[j + 1, j]
        for i, (c, s) in enumerate(turn):
            h[i, j], h[i + 1, j] = c * h[i, j] + s * h[i + 1, j], c * h[i + 1, j] - s * h[i, j]
        length = float(np.hypot(h[j, j], h[j + 1, j]))
        n = j + 1
        if length == 0.0:
            break
        c, s = h[j, j] / length, h[j + 1, j] / length
        turn.append((c, s))
        h[j, j], h[j + 1, j] = length, 0.0
        g[j], g[j + 1] = c * g[j], -s * g[j]
        if abs(g[j + 1]) <= sharp * size or below <= 1e-15 * size:
            break
        basis.append(w / below)
    y = np.linalg.lstsq(np.triu(h[:n, :n]), g[:n], rcond=None)[0]
    x = np.zeros_like(b)
    for value, v in zip(y, basis, strict=False):
        x += value * v
    return x
