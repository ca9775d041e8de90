"""The rack family: every program on every size and case, side by side, against references."""

from collections.abc import Iterable

from children import Reply, once, side_by_side
from experiment import CASES, OURS, PEERS, Row, Scope

RIGHT = 1e-6  # m; a larger distance to the reference is a wrong answer
GIVE_UP = 2  # sizes in a row at which a program fails before larger ones are left out


def measure(scope: Scope) -> list[Row]:
    """All points; a row for each size, case and program."""
    rows: list[Row] = []
    failed: dict[tuple[str, str], list[int]] = {}
    for n in scope.sizes:
        for case in CASES:
            rows += _point(scope, n, case, failed)
    return rows


def reference(scope: Scope, n: int, case: str) -> Reply:
    """Make the answer to compare with; its `path` and `kind`."""
    scope.references.mkdir(parents=True, exist_ok=True)
    job = {"task": "reference", "n": n, "case": case, "folder": str(scope.references)}
    return once(job, scope.patience)


def _point(
    scope: Scope, n: int, case: str, failed: dict[tuple[str, str], list[int]]
) -> Iterable[Row]:
    made = reference(scope, n, case)
    programs = ["floor", *OURS, *PEERS]
    tried = [p for p in programs if len(failed.get((p, case), [])) < GIVE_UP]
    jobs = [
        {"task": "solve", "program": p, "n": n, "case": case, "reference": made.get("path")}
        for p in tried
    ]
    limits = [scope.patience if p in ("floor", "newton") else scope.limit for p in tried]
    replies = dict(zip(tried, side_by_side(jobs, limits, scope.budget, scope.most), strict=True))
    floor = replies["floor"].get("seconds")
    rows = []
    for program in programs:
        row: Row = {"n": n, "case": case, "program": program, "reference": made.get("kind", "none")}
        if program not in replies:
            sizes = " and ".join(str(size) for size in failed[program, case])
            row["verdict"], row["remark"] = "not tried", f"fails at {sizes} nodes"
        else:
            reply = replies[program]
            row |= numbers(reply, floor)
            row["verdict"], row["remark"] = verdict(program, reply)
            bad = row["verdict"] == "fails" or (row["verdict"] == "wrong" and program not in OURS)
            if bad:
                failed.setdefault((program, case), []).append(n)
            else:
                failed.pop((program, case), None)
        rows.append(row)
    return rows


def numbers(reply: Reply, floor: float | None) -> Row:
    """Columns of a row that come from a reply."""
    names = ("seconds", "fastest", "slowest", "runs", "peak_mb", "error", "worst")
    counts = ("factorise", "solve", "iterations", "refine", "nnz")
    parts = ("analyse_seconds", "factor_seconds", "solve_seconds")
    row = {name: reply[name] for name in (*names, *counts, *parts) if name in reply}
    if floor and "seconds" in reply:
        row["floors"] = reply["seconds"] / floor
    return row


def verdict(program: str, reply: Reply) -> tuple[str, str]:
    """What became of a run, in one word and in words."""
    if reply.get("failure"):
        kind = reply.get("kind")
        word = {"missing": "not installed", "refused": "cannot"}.get(str(kind), "fails")
        return word, str(reply["failure"])
    if program == "floor":
        return "floor", ""
    error = reply.get("error")
    if error is None:
        return "right", "certified; there is no reference" if "worst" in reply else "no reference"
    if error <= RIGHT:
        return "right", ""
    remark = f"reports success {1e3 * error:.3g} mm off"
    if program == "calculix":
        return "other model", f"{1e3 * error:.3g} mm off: solid elements, another beam theory"
    return "wrong", remark
