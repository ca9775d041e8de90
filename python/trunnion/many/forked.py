"""Work in forked processes under supervision: one process a task, so a death costs one task.

The children inherit everything that the parent has made ready (modules, arrays, an analysed
factor), which takes milliseconds.  A child that dies (killed, out of memory) is named and its task
tried once more.  When the parent stops, however it stops, its children stop.
"""

import ctypes
import multiprocessing
import os
import signal
import sys
import warnings
from collections import deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from time import monotonic
from typing import Any, Generic, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

TRIES = 2  # of a task whose process dies
GRACE = 1.0  # for children to end by themselves [s]
PR_SET_PDEATHSIG = 1  # prctl(2)


@dataclass(frozen=True, slots=True)
class Ended(Generic[Result]):
    """How one task ended.

    index : of the task.
    result : what it gave; None when every process that tried it died.
    deaths : one sentence for each process that died at it.
    """

    index: int
    result: Result | None
    deaths: tuple[str, ...] = ()


@dataclass(slots=True)
class _Running:
    index: int
    process: BaseProcess
    pipe: Connection


def run_forked(
    tasks: Sequence[Task],
    work: Callable[[Task], Result],
    jobs: int,
    *,
    tick: Callable[[], None] | None = None,
    swept: Callable[[int], None] | None = None,
) -> Generator[Ended[Result], None, None]:
    """Give the ends of all tasks as they come; leaving early stops every child.

    Parameters
    ----------
    work : must not raise; what it gives is pickled.
    jobs : processes at a time.
    tick : called now and then while waiting.
    swept : called with the number of each process that died, to clear up behind it.
    """
    waiting = deque(range(len(tasks)))
    deaths: dict[int, list[str]] = {}
    running: dict[Connection, _Running] = {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                index = waiting.popleft()
                child = _start(index, tasks[index], work)
                running[child.pipe] = child
            ready = wait(list(running), timeout=0.25)
            if tick is not None:
                tick()
            for pipe in [pipe for pipe in running if pipe in ready]:
                child = running.pop(pipe)
                done, result, death = _finish(child)
                if done:
                    yield Ended(child.index, result, tuple(deaths.get(child.index, ())))
                    continue
                if swept is not None and child.process.pid is not None:
                    swept(child.process.pid)
                told = deaths.setdefault(child.index, [])
                told.append(death)
                if len(told) < TRIES:
                    waiting.append(child.index)
                else:
                    yield Ended(child.index, None, tuple(told))
    finally:
        _stop([child.process for child in running.values()], swept)


def _start(index: int, task: Any, work: Callable[[Any], Any]) -> _Running:
    """Fork a child for one task."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe(duplex=False)
    sys.stdout.flush()
    sys.stderr.flush()
    process = context.Process(target=_child, args=(task, work, theirs, os.getpid()), daemon=True)
    with warnings.catch_warnings():
        # from 3.12 on Python warns of threads: those of BLAS are idle here, and fork restarts them
        warnings.simplefilter("ignore", DeprecationWarning)
        process.start()
    theirs.close()
    return _Running(index, process, ours)


def _child(task: Any, work: Callable[[Any], Any], pipe: Connection, parent: int) -> None:
    """Do one task.  Ctrl-C is the parent's business; its death is this process's end."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != parent:  # it died before the line above
        return
    pipe.send(work(task))
    pipe.close()


def _finish(child: _Running) -> tuple[bool, Any, str]:
    """Take the result of a child that has one, or say how it died."""
    try:
        result = child.pipe.recv()
    except (EOFError, OSError):
        child.process.join()
        return False, None, _death(child.process)
    finally:
        child.pipe.close()
    child.process.join()
    return True, result, ""


def _death(process: BaseProcess) -> str:
    code = process.exitcode or 0
    if code >= 0:
        return f"worker process {process.pid} ended without an answer (exit {code})"
    try:
        name = signal.Signals(-code).name
    except ValueError:
        name = f"signal {-code}"
    return f"worker process {process.pid} was killed by {name}"


def _stop(processes: list[BaseProcess], swept: Callable[[int], None] | None) -> None:
    """End children: politely, so that they remove their temporary files, then by force."""
    for process in processes:
        process.terminate()
    until = monotonic() + GRACE
    for process in processes:
        process.join(max(0.0, until - monotonic()))
        if process.is_alive():
            process.kill()
            process.join()
        if swept is not None and process.pid is not None:
            swept(process.pid)
