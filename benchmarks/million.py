"""One million nodes with friction, and a thousand beside it in the same run: opt-in."""

from children import side_by_side
from experiment import Row, Scope
from racks import numbers, verdict

SIZES = (1000, 1_000_000)
PATIENCE = 1800.0  # s


def measure(scope: Scope) -> list[Row]:
    """Floor and Trunnion at both sizes; there is no reference, the certificate judges."""
    rows: list[Row] = []
    for n in SIZES:
        jobs = [
            {"task": "solve", "program": program, "n": n, "case": "fric1"}
            for program in ("floor", "newton")
        ]
        budget = scope.budget if n == SIZES[0] else 0.0
        floor, own = side_by_side(jobs, [PATIENCE] * 2, budget, scope.most)
        for program, reply in (("floor", floor), ("newton", own)):
            row: Row = {"n": n, "case": "fric1", "program": program}
            row |= numbers(reply, floor.get("seconds"))
            row["verdict"], row["remark"] = verdict(program, reply)
            rows.append(row)
    return rows
