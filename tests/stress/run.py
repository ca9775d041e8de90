"""The long stress run: `make stress N=20000`.

    python tests/stress/run.py 20000                 # random scenes, then N/10 manufactured ones
    python tests/stress/run.py 20000 --from 500000   # other seeds

Results go line by line to build/stress/; a run that was stopped goes on where it was.  The
tables at the end are those of docs/stability.md.  Exit 1 where a number is wrong, a scene ends in
a traceback or a refusal has no cause; the seeds are printed.
"""

import argparse
import json
import signal
import sys
import time
import traceback
import warnings
from collections import Counter
from dataclasses import asdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from outcome import GOOD, Outcome, of_invented, of_manufactured

PATIENCE = 60  # seconds of processor time after which a scene counts as hanging


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("n", type=int)
    parser.add_argument("--from", dest="start", type=int, default=0)
    parser.add_argument("-o", type=Path, default=Path("build/stress"))
    args = parser.parse_args()
    args.o.mkdir(parents=True, exist_ok=True)
    warnings.simplefilter("error")
    faults = 0
    for kind, of, n in (
        ("random", of_invented, args.n),
        ("manufactured", of_manufactured, max(args.n // 10, 1)),
    ):
        ends = follow(of, range(args.start, args.start + n), args.o / f"{kind}_{args.start}.jsonl")
        faults += table(kind, ends)
    return 1 if faults else 0


def follow(of, seeds: range, path: Path) -> list[Outcome]:
    """Ends of all seeds; those that stand in the file are not run again."""
    ends = [Outcome(**json.loads(line)) for line in path.read_text().splitlines()] if path.exists() else []
    done = {end.seed for end in ends}
    clock = time.monotonic()
    with path.open("a") as file:
        for seed in seeds:
            if seed in done:
                continue
            end = one(of, seed)
            ends.append(end)
            file.write(json.dumps(asdict(end)) + "\n")
            if end.fault:
                print(f"seed {seed}: {end.what}: {end.fault}", flush=True)
            if time.monotonic() - clock > 30.0:
                clock = time.monotonic()
                file.flush()
                print(f"{path.stem}: at seed {seed}", flush=True)
    return [end for end in ends if end.seed in seeds]


def one(of, seed: int) -> Outcome:
    """The end of one seed, whatever happens."""

    def hang(*_: object) -> None:
        raise TimeoutError(f"more than {PATIENCE} s")

    signal.signal(signal.SIGVTALRM, hang)
    signal.setitimer(signal.ITIMER_VIRTUAL, PATIENCE)
    try:
        return of(seed)
    except Exception as error:
        traceback.print_exc()
        return Outcome(seed, "TRACEBACK", f"{type(error).__name__}: {error}"[:200])
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)


def table(kind: str, ends: list[Outcome]) -> int:
    """Print a Markdown table by cause; returns the number of faults."""
    count = Counter(end.what for end in ends)
    print(f"\n| {kind} scenes: end | number | share |\n|---|---|---|")
    for what, n in count.most_common():
        print(f"| {what} | {n} | {100 * n / len(ends):.2f} % |")
    print(f"| all | {len(ends)} | |")
    good = [end for end in ends if end.what.startswith(GOOD)]
    if good:
        worst = max(good, key=lambda end: end.error)
        print(f"\nLargest error of a certified answer: {worst.error:.1e} (seed {worst.seed}).")
    return sum(bool(end.fault) for end in ends)


if __name__ == "__main__":
    sys.exit(main())
