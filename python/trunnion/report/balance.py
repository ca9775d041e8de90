"""Iterations of a case as numbers without unit, on one scale with its certificate."""

import numpy as np

from trunnion.arrays import F8, CaseResult
from trunnion.certificate.scales import Scale, measure
from trunnion.frozen import frozen


@frozen(eq=False)
class Balance:
    """How far each iteration was from the answer.

    value : (n,) before each: out of balance relative to `force` [N], or where `by_length` the last
        change relative to `length` [m].  raw : (n,) the same in N and m.
    """

    value: F8
    raw: F8
    by_length: np.ndarray
    force: float
    length: float


def balance(case: CaseResult) -> Balance:
    """Make the iterations of a case numbers without unit."""
    what = [str(record.get("what", "")) for record in case.history]
    said = [record.get("residual") for record in case.history]
    raw = np.array([float(x) if isinstance(x, float | int) else np.nan for x in said], np.float64)
    by_length = np.array([word.startswith("status") for word in what], bool)
    force, length = scales(case)
    return Balance(np.where(by_length, raw / length, raw / force), raw, by_length, force, length)


def scales(case: CaseResult) -> tuple[float, float]:
    """Force [N] and length [m] that are one: those of the certificate, or of the loads alone."""
    if case.state is not None and case.loads is not None:
        found: Scale = measure(case.system, case.loads, case.state)
        return found.force, found.length
    if case.loads is None:
        return 1.0, 1.0
    own = np.abs(case.loads.dist * case.system.length[:, None]).max(initial=0.0)
    return float(max(own, np.abs(case.loads.nodal[:, :3]).max(initial=0.0))) or 1.0, 1.0
