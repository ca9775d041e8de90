"""Run the benchmarks: tables and pictures into a folder.

    benchmarks/bench.py [--scope quick|full] [-o FOLDER] [--only PART ...] [--docs]

Parts: racks, passes, sweeps, many, variants, whole, time_spent, and million only where it is named;
`none` measures nothing.  Parts that are not run keep the tables they have.  With --docs the folder
is docs/benchmarks, and docs/benchmarks.md and the README's table are written anew from it.
"""

import argparse
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

import machine
import many
import million
import page
import passes
import pictures
import racks
import store
import sweeps
import tables
import targets
import time_spent
import variants
import whole
from experiment import Row, Scope, full, quick


def _racks(scope: Scope) -> dict[str, list[Row]]:
    return {"racks": racks.measure(scope)}


def _passes(scope: Scope) -> dict[str, list[Row]]:
    tolerances, curves = passes.measure(scope)
    return {"tolerances": tolerances, "passes": curves}


def _whole(scope: Scope) -> dict[str, list[Row]]:
    processes, reading = whole.measure(scope)
    return {"whole": processes, "reading": reading}


PARTS: dict[str, Callable[[Scope], dict[str, list[Row]]]] = {
    "racks": _racks,
    "passes": _passes,
    "sweeps": sweeps.measure,
    "many": lambda scope: {"many": many.measure(scope)},
    "variants": lambda scope: {"variants": variants.measure(scope)},
    "whole": _whole,
    "time_spent": lambda scope: {"time_spent": time_spent.measure(scope)},
    "million": lambda scope: {"million": million.measure(scope)},
}


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scope", choices=("quick", "full"), default="full")
    parser.add_argument("-o", "--output", type=Path, default=Path("build/bench"))
    parser.add_argument("--only", nargs="+", choices=(*PARTS, "none"), metavar="PART")
    parser.add_argument("--docs", action="store_true", help="refresh docs and README")
    args = parser.parse_args()
    if args.docs and args.scope == "quick":
        parser.error("the docs hold the full run")
    folder = page.DOCS if args.docs else args.output
    folder.mkdir(parents=True, exist_ok=True)
    references = page.ROOT / "build" / "references"
    scope = (quick if args.scope == "quick" else full)(references)
    begin = time.monotonic()
    for part in args.only or [name for name in PARTS if name != "million"]:
        if part == "none":
            break
        start = time.monotonic()
        for name, rows in PARTS[part](scope).items():
            store.save(rows, folder / f"{name}.csv")
        say(f"{part}: {time.monotonic() - start:.0f} s")
    kept = machine.load(folder)
    if args.only and kept:
        kept |= {f"commit of {part}": machine.commit() for part in args.only if part in PARTS}
        machine.save(kept, folder)
    else:
        machine.save(machine.note(args.scope), folder)
    found = tables.read(folder)
    store.save(targets.targets(found), folder / "targets.csv")
    pictures.draw(folder, found)
    if args.docs:
        page.refresh_docs()
    else:
        tables.write(folder, found, machine.load(folder))
        (folder / "report.md").write_text(page.render(folder, ""))
    say(tables.target_table(found))
    report = page.PAGE if args.docs else folder / "report.md"
    say(f"{time.monotonic() - begin:.0f} s; read {os.path.relpath(report)}")
    return 0


def say(text: str) -> None:
    """Print at once."""
    print(text, flush=True)


if __name__ == "__main__":
    sys.exit(main())
