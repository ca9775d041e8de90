"""Child processes seen from the parent: asked in turn, each with a time limit."""

import json
import os
import select
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from statistics import median
from typing import Any

Job = dict[str, Any]
Reply = dict[str, Any]
WORKER = Path(__file__).with_name("worker.py")
PINNED = dict.fromkeys(
    ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS"), "1"
)
LEAST = 3  # rounds of what is not too long
WARM = 1.0  # s; the first run counts only where it takes longer


class Child:
    """One worker and what it said last; `failure` once it can say nothing more."""

    def __init__(self, job: Job, limit: float) -> None:
        self.job, self.limit = job, limit
        self.failure: str | None = None
        self.kind = ""  # of the failure: missing, refused, or empty
        command = [sys.executable, str(WORKER), json.dumps(job)]
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **PINNED},
        )
        first = self._read(max(60.0, 3 * limit))
        for kind in ("missing", "refused"):
            if kind in first:
                self.kind = kind
                self._end(str(first[kind]))

    def ask(self) -> Reply:
        """One run; an empty reply where it failed (then `failure` says how)."""
        if self.failure is not None:
            return {}
        assert self.process.stdin is not None
        try:
            self.process.stdin.write(b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            self._died()
            return {}
        return self._read(self.limit)

    def _read(self, limit: float) -> Reply:
        stream = self.process.stdout
        assert stream is not None
        ready, _, _ = select.select([stream], [], [], limit)
        if not ready:
            self._end(f"no answer in {limit:g} s")
            return {}
        line = stream.readline()
        if not line:
            self._died()
            return {}
        reply: Reply = json.loads(line)
        return reply

    def _died(self) -> None:
        code = self.process.wait()
        self._end(f"killed by signal {-code}" if code < 0 else f"ends with exit code {code}")

    def _end(self, failure: str) -> None:
        self.failure = self.failure or failure
        self.close()

    def close(self) -> None:
        """End the process."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout):
            if stream is not None:
                with suppress(BrokenPipeError):
                    stream.close()


def once(job: Job, limit: float) -> Reply:
    """One run of one job in a process of its own; `failure` in the reply where there is none."""
    child = Child(job, limit)
    reply = child.ask()
    child.close()
    return reply if child.failure is None else {"failure": child.failure, "kind": child.kind}


def side_by_side(
    jobs: Sequence[Job], limits: Sequence[float], budget: float, most: int
) -> list[Reply]:
    """Run jobs in turn, round after round, so that the drift of the machine meets all alike.

    Parameters
    ----------
    limits : seconds that one run of each may take.
    budget : seconds for all; a job stops once it has had its share, but not before three rounds
        after the first, unless one run alone is longer than the budget.
    most : rounds after the first, at most.

    Returns
    -------
    The last reply of each job with the peak memory of its first, `seconds` replaced by the median
    over its runs, `runs`, `fastest` and `slowest`; or `failure` and `kind`.
    """
    children = [Child(job, limit) for job, limit in zip(jobs, limits, strict=True)]
    times: list[list[float]] = [[] for _ in jobs]
    replies: list[Reply] = [{} for _ in jobs]
    share = budget / 2
    for turn in range(most + 1):  # the first round warms up
        for i, child in enumerate(children):
            spent = sum(times[i])
            enough = (turn > LEAST and spent > share) or (turn > 0 and spent > budget)
            if enough or replies[i].get("failure"):
                continue  # what has failed fails the same way again
            reply = child.ask()
            if reply:
                if turn > 0:  # later runs find the memory of earlier ones in use
                    reply["peak_mb"] = replies[i].get("peak_mb", 0.0)
                replies[i] = reply
                times[i].append(float(reply.get("seconds", 0.0)))
    for i, child in enumerate(children):
        child.close()
        if child.failure is not None:
            replies[i] = {"failure": child.failure, "kind": child.kind}
        elif times[i]:
            counted = times[i][1:] if len(times[i]) > 1 and times[i][0] < WARM else times[i]
            replies[i] |= {
                "seconds": median(counted),
                "fastest": min(counted),
                "slowest": max(counted),
                "runs": len(counted),
            }
    return replies
