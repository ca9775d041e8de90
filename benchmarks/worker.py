"""A child process that measures: one program on one model, a line of JSON for every run.

    benchmarks/worker.py '{"task": "solve", "program": "newton", "n": 1000, "case": "fric1"}'

It makes the model ready, says so, then runs once for every line on its input.  A crash, a hang or
a shortage of memory is the parent's to see (`children`).  Memory is the peak of this process
while it runs (VmHWM, reset before), the arrays of the model included.
"""

import json
import os
import resource
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

Job = dict[str, Any]
Reply = dict[str, Any]
MEMORY = 16 << 30  # bytes of address space that a program may take
TASKS = {  # task -> module and function: job -> function that runs once
    "solve": ("tasks", "solve"),
    "reference": ("tasks", "reference"),
    "many": ("many", "task"),
    "sweep": ("sweeps", "task"),
    "passes": ("passes", "task"),
    "variants": ("variants", "task"),
    "story": ("time_spent", "task"),
    "cards": ("whole", "task"),
}


def peak_mb() -> float:
    """Largest resident memory since `reset_peak` [MB]."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmHWM"):
            return float(line.split()[1]) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def reset_peak() -> None:
    """Forget the peak so far."""
    with suppress(OSError):  # else the peak includes the making of the model
        Path("/proc/self/clear_refs").write_text("5")


def main(text: str) -> None:
    """Make ready, then run and reply until the input ends."""
    replies = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what programs print is not a reply
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    _, most = resource.getrlimit(resource.RLIMIT_STACK)
    resource.setrlimit(resource.RLIMIT_STACK, (most, most))  # OpenSees recurses along the line
    job: Job = json.loads(text)
    module, function = TASKS[job["task"]]

    def say(reply: Reply) -> None:
        replies.write(json.dumps(reply) + "\n")
        replies.flush()

    try:
        run: Callable[[], Reply] = getattr(import_module(module), function)(job)
    except NotImplementedError as reason:
        say({"refused": str(reason)})
        return
    except ImportError as reason:
        say({"missing": str(reason)})
        return
    say({"ready": True})
    for _ in sys.stdin:
        reset_peak()
        say(run())


if __name__ == "__main__":
    main(sys.argv[1])
