"""How fast a deck is read and its model built: cards a second on pipe rack decks.

    benchmarks/reading.py [MODEL.json ...] [--repeat N]

A model is a neutral pipe rack (schema piperack-1, may be gzipped), written as a deck in memory.
`read` is deck text to Model, `build` is Model to numbered arrays.  Each time is the median of
the repeats.  tests/unit/test_reading_work.py guards the same by counts, which do not waver.
"""

import argparse
import statistics
import time
from pathlib import Path

from rack import Rack, read_rack
from rack_deck import lines

from trunnion.deck.reader import read_text
from trunnion.system import build_system

HEAD = """\
UNITS    mm N MPa C
DEFAULT  SHEAR=OFF G=9.81
MATERIAL STEEL   E={E} NU={nu} ALPHA={alpha} DENSITY={rho_pipe}
SECTION  PIPE    OD={od} WALL={t} FLUID={rho_fluid}
OPERATE  T1={dT} TREF=0
"""
TAIL = "\nCASE OPE = W + T1\n"


def deck_of(rack: Rack) -> str:
    """Write a rack as a deck without comments."""
    pipe = rack["pipe"]
    head = HEAD.format(
        **{**pipe, "E": pipe["E"] / 1e6, "od": 1e3 * pipe["od"], "t": 1e3 * pipe["t"]}
    )
    return head + "\n".join(lines(rack)) + TAIL


def measure(text: str, repeat: int) -> tuple[float, float]:
    """Median seconds of reading and of building."""
    reads, builds = [], []
    for _ in range(repeat):
        start = time.perf_counter()
        model = read_text(text)
        read = time.perf_counter()
        build_system(model)
        builds.append(time.perf_counter() - read)
        reads.append(read - start)
    return statistics.median(reads), statistics.median(builds)


def main() -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = Path(__file__).parents[1] / "tests/data/rack_1000.json.gz"
    parser.add_argument("models", type=Path, nargs="*", default=[default])
    parser.add_argument("--repeat", type=int, default=5)
    args = parser.parse_args()
    print(f"{'deck':16} {'cards':>8} {'read':>9} {'build':>9}   cards/s read, build, together")
    for path in args.models:
        rack = read_rack(path)
        text = deck_of(rack)
        cards = sum(1 for line in text.splitlines() if line.strip())
        read, build = measure(text, args.repeat)
        rates = (cards / read, cards / build, cards / (read + build))
        print(
            f"{rack['name']:16} {cards:8d} {read:7.3f} s {build:7.3f} s   "
            + " ".join(f"{rate:10,.0f}" for rate in rates)
        )


if __name__ == "__main__":
    main()
