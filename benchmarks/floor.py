"""The floor: one CHOLMOD refactorisation and one solve of the full matrix of a rack.

The matrix holds every node and element, every support closed and every rest stuck: what a
program that condenses nothing would have to factor at least once.  Assembled by `frame`, factored
by the CHOLMOD that Trunnion uses, with the same settings.
"""

import time
from collections.abc import Callable

import numpy as np
from frame import build_frame
from programs.outcome import Outcome
from rack_line import Rack

from trunnion.kernels import SpdFactor


def floor(rack: Rack, case: str) -> Callable[[], Outcome]:
    """Analyse; what is returned refactors, solves once and times both."""
    frame = build_frame(rack)
    matrix = frame.matrix()
    n = matrix.shape[0]
    more = np.zeros(n)
    for node in rack["anchors"]:
        more[6 * node : 6 * node + 6] += rack["kn"]
    for s in rack["supports"]:
        at, direction = 6 * s["node"], np.abs(s["dir"])
        more[at : at + 3] += rack["kn"] * direction
        if s["mu"]:
            more[at : at + 3] += rack["kt"] * (1.0 - direction)
    from scipy.sparse import diags, tril

    lower = tril(matrix + diags(more), format="csc")
    lower.sort_indices()
    begin = time.perf_counter()
    factor = SpdFactor(lower.indptr.astype(np.int32), lower.indices.astype(np.int32))
    analysed = time.perf_counter() - begin
    load = frame.load.astype(np.float64)

    def run() -> Outcome:
        start = time.perf_counter()
        factor.factorise(lower.data)
        half = time.perf_counter()
        factor.solve(load)
        end = time.perf_counter()
        facts: dict[str, float | str] = {
            "analyse_seconds": analysed,
            "factor_seconds": half - start,
            "solve_seconds": end - half,
            "nnz": lower.nnz,
        }
        return Outcome(end - start, None, facts=facts)

    return run
