"""Time a study: 1000 variants of a deck's case on one symbolic analysis.

    benchmarks/study.py [DECK] [--case FRIC1] [--vary ...] [-j 1 2] [--repeat 3] [-o OUT.json]

Without --vary: 50 coefficients of friction times 20 gaps.  `seconds` is the median of the repeats,
from the model in memory to all loads, states and certificates; beside it stand the processor time
of this process and its children, the work, and the time of the same cases each solved alone.
"""

import argparse
import json
import os
import statistics
import sys
import time
from pathlib import Path
from typing import Any

import trunnion
from trunnion.many.study import Study, study
from trunnion.model import Model

DECK = Path(__file__).parents[1] / "models/rack_200.inp"
VARY = ("MU=0.1:0.5:50", "GAP=1:6:20")


def processor_time() -> float:
    """Seconds of this process and of its children that have ended."""
    t = os.times()
    return t.user + t.system + t.children_user + t.children_system


def timed(model: Model, case: str, vary: list[str], *, jobs: int, warm: bool, n: int) -> Any:
    """Median of n runs of one study."""
    seconds, processor = [], []
    for _ in range(n):
        began, used = time.perf_counter(), processor_time()
        done = study(model, vary, cases=[case], jobs=jobs, warm=warm)
        seconds.append(time.perf_counter() - began)
        processor.append(processor_time() - used)
    count = len(done.names)
    return {
        "variants": count,
        "certified": int(done.good.sum()),
        "worst": float(done.answers.worst.max()),
        "jobs": jobs,
        "start": "the deck's answer" if warm else "rest",
        "seconds": statistics.median(seconds),
        "processor": statistics.median(processor),
        "ms_per_variant": 1e3 * statistics.median(seconds) / count,
        "work": done.work,
    }


def alone(model: Model, done: Study) -> float:
    """Seconds a variant, solved alone from its model: the mean of 20 of them."""
    from dataclasses import replace

    from trunnion.many.axes import combinations

    every = combinations(done.axes)
    chosen = every[:: max(1, len(every) // 20)][:20]
    own = replace(model, cases=[c for c in model.cases if c.name in done.cases])
    began = time.perf_counter()
    for combination in chosen:
        variant = own
        for axis, i in zip(done.axes, combination, strict=True):
            variant = axis.edit(variant, axis.values[i])
        trunnion.solve(variant)
    return (time.perf_counter() - began) / len(chosen)


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("deck", nargs="?", type=Path, default=DECK)
    parser.add_argument("--case", default="FRIC1")
    parser.add_argument("--vary", nargs="+", default=list(VARY))
    parser.add_argument("-j", dest="jobs", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("-o", dest="out", type=Path)
    a = parser.parse_args()
    model = trunnion.read(a.deck)
    few = study(model, a.vary, cases=[a.case], jobs=1)
    single = alone(model, few)
    rows = [
        timed(model, a.case, a.vary, jobs=jobs, warm=warm, n=a.repeat)
        for jobs in a.jobs
        for warm in (False, True)
    ]
    print(f"{a.deck.name} {a.case}, {' x '.join(a.vary)}; alone {1e3 * single:.2f} ms a variant")
    print(
        "variants certified    worst jobs start               s  processor s  ms/variant  analyse"
    )
    for row in rows:
        print(
            f"{row['variants']:8d} {row['certified']:9d} {row['worst']:8.1e} {row['jobs']:4d} "
            f"{row['start']:17s} {row['seconds']:5.2f} {row['processor']:12.2f} "
            f"{row['ms_per_variant']:11.2f} {row['work']['analyse']:8d}"
        )
    if a.out is not None:
        found = {"deck": a.deck.name, "case": a.case, "vary": a.vary, "alone_s": single}
        a.out.write_text(json.dumps({**found, "rows": rows}, indent=1) + "\n")
    sys.exit(any(row["certified"] < row["variants"] for row in rows))


if __name__ == "__main__":
    main()
