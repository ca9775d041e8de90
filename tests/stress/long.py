"""Run many scenes, write how they end: tests/stress/long.py N [FOLDER].

Every finished scene is a line of FOLDER/scenes.jsonl, so a run that was stopped goes on where it
stood.  FOLDER/stability.md is the table of docs/stability.md.  Half of the N scenes are
manufactured, half random; every processor takes its share.
"""

import json
import os
import sys
import time
from collections import Counter
from dataclasses import asdict
from multiprocessing import Pool
from pathlib import Path

from manufactured import manufactured
from outcome import ANOTHER, GIVEN_BACK, LAWFUL, outcome
from scenes import random_scene

GOOD = (GIVEN_BACK, ANOTHER, LAWFUL)
EVERY = 500  # scenes from one word of progress to the next


def main(n: int, folder: Path) -> int:
    """Run the scenes that are not done, print and write the tables."""
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "scenes.jsonl"
    lines = log.read_text().splitlines() if log.exists() else []
    done = {(r["make"], r["seed"]): r for r in map(json.loads, filter(_whole, lines))}
    every = [(("manufactured", "random")[i % 2], i // 2) for i in range(n)]
    todo = [key for key in every if key not in done]
    began = time.monotonic()
    with log.open("a") as out, Pool(len(os.sched_getaffinity(0))) as pool:
        for i, end in enumerate(pool.imap(one, todo, chunksize=4), 1):
            done[end["make"], end["seed"]] = end
            out.write(json.dumps(end) + "\n")
            out.flush()
            if i % EVERY == 0:
                wrong = sum(r["wrong"] for r in done.values())
                seconds = time.monotonic() - began
                print(f"{i} of {len(todo)} scenes, {wrong} wrong, {seconds:.0f} s", flush=True)
    chosen = [done[key] for key in every]
    text = tables(chosen)
    (folder / "stability.md").write_text(text)
    print(text)
    for r in chosen:
        if r["wrong"]:
            print(f"WRONG {r['make']} seed {r['seed']} ({r['kind']}): {r['word']}, {r['detail']}")
    return 1 if any(r["wrong"] for r in chosen) else 0


def one(key: tuple[str, int]) -> dict:
    """How one scene ends."""
    make, seed = key
    scene = manufactured(seed) if make == "manufactured" else random_scene(seed)
    return {"make": make, **asdict(outcome(scene))}


def _whole(line: str) -> bool:
    """A line that was written to its end."""
    return line.startswith("{") and line.endswith("}")


def tables(found: list[dict]) -> str:
    """How the scenes end, in Markdown."""
    text = []
    for make in ("manufactured", "random"):
        own = [r for r in found if r["make"] == make]
        if not own:
            continue
        text += ["", f"| {make} scenes | number | part |", "|---|---|---|"]
        count = Counter(r["word"] for r in own)
        order = sorted(count, key=lambda word: (word not in GOOD, -count[word]))
        text += [f"| {word} | {count[word]} | {count[word] / len(own):.2%} |" for word in order]
        again = sum("own capacities" in r["detail"] for r in own if r["word"] == ANOTHER)
        if make == "manufactured":
            part = sum(count[word] for word in GOOD) / len(own)
            text += ["", f"Certified: {part:.2%} of {len(own)}.  Of the other answers, which only "]
            text[-1] += f"friction has, {again} also give the chosen one from its own capacities."
    return "\n".join(text).lstrip() + "\n"


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), Path(sys.argv[2] if len(sys.argv) > 2 else "build/stress")))
