"""A thousand variants of one friction case in one study (module `study`), on one and two cores."""

from collections.abc import Callable

import study
from children import once
from experiment import Row, Scope
from worker import Job, Reply

import trunnion

FEW = ("MU=0.1:0.5:10", "GAP=1:6:5")  # of the quick run


def measure(scope: Scope) -> list[Row]:
    """A row for each number of processes."""
    rows = []
    for jobs in (1, 2):
        job = {
            "task": "variants",
            "jobs": jobs,
            "vary": study.VARY if scope.name == "full" else FEW,
        }
        rows.append({"deck": study.DECK.stem, **once(job, scope.patience)})
    return rows


def task(job: Job) -> Callable[[], Reply]:
    """Solve all variants, from the model in memory to loads, states and certificates."""
    model = trunnion.read(study.DECK)

    def run() -> Reply:
        row = study.timed(model, "FRIC1", list(job["vary"]), jobs=job["jobs"], warm=False, n=3)
        work = row.pop("work")
        return {**row, "analyse": work["analyse"], "factorise": work["factorise"]}

    return run
